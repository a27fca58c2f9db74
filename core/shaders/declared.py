"""What is declared for a shader: GLSL's own variables, and those that three.js adds."""

from core.lanes.problem import Place
from core.shaders.parser import GlobalVariable

ATTRIBUTES = {"position": "vec3", "normal": "vec3", "uv": "vec2", "color": "vec3"}
"""What a mesh gives its vertices; ``color`` may be declared vec4, too."""
UNIFORMS = {
    "modelMatrix": "mat4",
    "modelViewMatrix": "mat4",
    "projectionMatrix": "mat4",
    "viewMatrix": "mat4",
    "normalMatrix": "mat3",
    "cameraPosition": "vec3",
    "isOrthographic": "bool",
}
"""What the scene gives a shader."""
_OWN = {
    "vertex": (("gl_Position", "vec4", "out"), ("gl_VertexID", "int", "in")),
    "fragment": (("gl_FragCoord", "vec4", "in"), ("gl_FrontFacing", "bool", "in")),
}
_MATERIAL = {
    "vertex": (
        *((name, of, "in") for name, of in ATTRIBUTES.items()),
        *((name, of, "uniform") for name, of in UNIFORMS.items()),
    ),
    "fragment": tuple(
        (name, UNIFORMS[name], "uniform") for name in ("viewMatrix", "cameraPosition", "isOrthographic")
    ),
}


def declared_for(stage: str, dialect: str) -> tuple[GlobalVariable, ...]:
    """Return the variables that a shader of a stage finds declared."""
    rows = _OWN[stage] + (_MATERIAL[stage] if dialect == "shader-material" else ())
    return tuple(GlobalVariable(name, of, qualifier, False, Place(1)) for name, of, qualifier in rows)


def declared_elsewhere(stage: str, dialect: str) -> dict[str, str]:
    """Return names that only ShaderMaterial declares, with the declarations that a shader may write itself."""
    if dialect == "shader-material":
        return {}
    return {name: f"{qualifier} {of} {name}" for name, of, qualifier in _MATERIAL[stage]}
