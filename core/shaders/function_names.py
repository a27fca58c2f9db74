"""The functions of GLSL that shaders may call, and what is said of others."""

EACH = {
    "radians": 1, "degrees": 1, "sin": 1, "cos": 1, "tan": 1, "asin": 1, "acos": 1, "atan": 1, "exp": 1, "log": 1,
    "exp2": 1, "log2": 1, "sqrt": 1, "inversesqrt": 1, "abs": 1, "sign": 1, "floor": 1, "ceil": 1, "fract": 1,
    "round": 1, "trunc": 1, "pow": 2, "mod": 2, "min": 2, "max": 2, "step": 2, "clamp": 3, "mix": 3, "smoothstep": 3,
}  # fmt: skip
"""Functions of each component, with how many values they take; ``atan`` takes one or two."""
WHOLE = {
    "length": 1, "normalize": 1, "dot": 2, "distance": 2, "cross": 2, "reflect": 2, "faceforward": 3, "refract": 3,
}  # fmt: skip
"""Functions of whole vectors of floats."""
MATRIX = {"transpose": 1, "determinant": 1, "inverse": 1, "matrixCompMult": 2}
COMPARISONS = {
    "lessThan": "<", "lessThanEqual": "<=", "greaterThan": ">", "greaterThanEqual": ">=", "equal": "==",
    "notEqual": "!=",
}  # fmt: skip
FLAGS = ("any", "all", "not")
TEXTURES = {
    "texture": "sampler2D, vec2",
    "texelFetch": "sampler2D, ivec2, int",
    "textureSize": "sampler2D, int",
}
DERIVATIVES = ("dFdx", "dFdy", "fwidth")
FUNCTIONS = frozenset((*EACH, *WHOLE, *MATRIX, *COMPARISONS, *FLAGS, *TEXTURES, *DERIVATIVES))
ALSO_WHOLE = ("abs", "sign", "min", "max", "clamp")
"""Functions that take ints, too."""
MAY_BE_ONE = {
    "min": (1,),
    "max": (1,),
    "mod": (1,),
    "clamp": (1, 2),
    "mix": (2,),
    "step": (0,),
    "smoothstep": (0, 1),
}
"""Which values may be one float beside vectors; ``clamp`` and ``smoothstep`` both at once, or neither."""
OTHER_FUNCTIONS = {
    "texture2D": "GLSL ES 3.00 has no texture2D: write texture",
    "textureLod": "textureLod is not supported here: write texture, or texelFetch for one texel",
    "textureGrad": "textureGrad is not supported here: write texture",
    "texture2DLod": "GLSL ES 3.00 has no texture2DLod: write texture",
    "saturate": "GLSL has no saturate: write clamp(x, 0.0, 1.0)",
    "lerp": "GLSL calls it mix",
    "frac": "GLSL calls it fract",
    "fmod": "GLSL calls it mod",
    "rsqrt": "GLSL calls it inversesqrt",
    "ddx": "GLSL calls it dFdx",
    "ddy": "GLSL calls it dFdy",
    "tex2D": "GLSL calls it texture",
    "mul": "write a * b for matrices and vectors",
    "atan2": "GLSL calls it atan(y, x)",
    "ln": "GLSL calls it log",
    "log10": "GLSL has no log10: write log(x) / log(10.0)",
    "norm": "GLSL calls it length, or normalize for the unit vector",
    "magnitude": "GLSL calls it length",
    "printf": "a shader cannot print: click a variable to see it as a buffer",
    "noise": "GLSL ES has no noise function",
    "random": "GLSL has no random numbers",
    "rand": "GLSL has no random numbers",
    "fma": "fma is not in GLSL ES 3.00: write a * b + c",
    "isnan": "isnan is not supported here: x != x holds for NaN",
    "isinf": "isinf is not supported here",
    "modf": "modf is not supported here: it gives two values",
    "sinh": "sinh is not supported here",
    "cosh": "cosh is not supported here",
    "tanh": "tanh is not supported here",
}
"""Of functions that GLSL does not have, or this subset."""
