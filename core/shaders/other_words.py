"""Words that GLSL reserves, and those of other languages and versions: what is said of them."""

from core.shaders.function_names import OTHER_FUNCTIONS
from core.shaders.glsl_types import TYPES

OTHER_WORDS = {
    **OTHER_FUNCTIONS,
    "gl_FragColor": "GLSL ES 3.00 has no gl_FragColor: declare out vec4 outColor; and write to it",
    "gl_FragDepth": "gl_FragDepth is not supported here: the depth is the triangle's",
    "gl_PointSize": "gl_PointSize is not supported here: points are drawn by the method of the family line",
    "varying": "GLSL ES 3.00 has no varying: write out in the vertex shader and in in the fragment shader",
    "attribute": "GLSL ES 3.00 has no attribute: write in",
    "float2": "a vector of GLSL is vec2",
    "float3": "a vector of GLSL is vec3",
    "float4": "a vector of GLSL is vec4",
    "double": "GLSL ES has no double: write float",
    "string": "GLSL has no texts",
}
"""Of names that other versions and languages have."""
OTHER_TYPES = {
    "uint": "uint is not supported here: use int",
    "double": "GLSL ES has no double: write float",
    "half": "GLSL has no half: write float",
    "bit": "GLSL has no bit: write bool",
    "boolean": "GLSL calls it bool",
    "integer": "GLSL calls it int",
    "string": "GLSL has no texts",
    "var": "a variable needs its type: write float, vec3, ... before the name",
    "let": "a variable needs its type: write float, vec3, ... before the name",
    "auto": "a variable needs its type: write float, vec3, ... before the name",
    "float2": "a vector of GLSL is vec2",
    "float3": "a vector of GLSL is vec3",
    "float4": "a vector of GLSL is vec4",
    "samplerCube": "samplerCube is not supported here: only sampler2D is",
    "vec": "write how many components: vec2, vec3 or vec4",
    "mat": "write the size: mat2, mat3 or mat4",
    "varying": OTHER_WORDS["varying"],
    "attribute": OTHER_WORDS["attribute"],
    "struct": "struct is not supported here: use one variable for each part",
    "def": "a function begins with the type of its value, as float name(float x) { ... }",
    "function": "a function begins with the type of its value, as float name(float x) { ... }",
}
RESERVED = (
    frozenset(
        (
            *TYPES,
            "void",
            "in",
            "out",
            "inout",
            "uniform",
            "const",
            "flat",
            "smooth",
            "centroid",
            "highp",
            "mediump",
        )
    )
    | {
        "lowp",
        "precision",
        "layout",
        "if",
        "else",
        "for",
        "while",
        "do",
        "return",
        "break",
        "continue",
        "discard",
    }
    | {
        "true",
        "false",
        "struct",
        "switch",
        "case",
        "default",
        "varying",
        "attribute",
        "invariant",
        "uint",
        "input",
        "output",
        "sample",
        "filter",
        "common",
        "active",
        "half",
        "fixed",
        "double",
        "goto",
        "sizeof",
        "cast",
        "using",
    }
)
