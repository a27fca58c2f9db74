"""The words of a shader, each with its place, and the names of GLSL's functions."""

import re
from dataclasses import dataclass

from core.lanes.problem import SHADER, Place, Problem

# The words of a shader, each with its place.


_TOKEN = re.compile(
    r"(?P<space>[ \t\r\f\v]+|//[^\n]*)|(?P<newline>\n)|(?P<comment>/\*.*?\*/)"
    r"|(?P<number>(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?\w*)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign>\+\+|--|<<=|>>=|<<|>>|[-+*/%&|^]=|==|!=|<=|>=|&&|\|\||\^\^|[-+*/%<>=!?:;,.(){}\[\]&|^~#])",
    re.DOTALL,
)
_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(?P<word>\w*)(?P<rest>[^\n]*)")
BRACKETS = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True, slots=True)
class Token:
    """A word of a shader: its kind is ``number``, ``name``, ``sign`` or ``end``."""

    kind: str
    text: str
    place: Place
    is_first: bool = False
    """Whether it is the first of its line."""


def read_tokens(source: str) -> tuple[list[Token], list[str]]:
    """Split a shader into its tokens, the last of kind ``end``, and say what was read and ignored.

    Raises
    ------
    Problem
        A character that GLSL does not have, a directive other than ``#version 300 es``, or a limit of the text.
    """
    if len(source) > SHADER.characters:
        raise Problem(
            Place(1), f"a shader may have {SHADER.characters:,} characters, this one has {len(source):,}"
        )
    tokens: list[Token] = []
    notes: list[str] = []
    at, line, begin, is_first = 0, 1, 0, True
    while at < len(source):
        place = Place(line, at - begin + 1)
        if is_first and (directive := _DIRECTIVE.match(source, at)):
            _check_directive(directive["word"], directive["rest"], place)
            at = directive.end()
            continue
        found = _TOKEN.match(source, at)
        if source.startswith("/*", at) and (found is None or found.lastgroup != "comment"):
            raise Problem(place, "this comment never ends: write */ behind it")
        if found is None:
            raise Problem(place, f"GLSL has no character {source[at]!r}")
        text = found[0]
        if found.lastgroup == "newline" or (found.lastgroup == "comment" and "\n" in text):
            line, begin, is_first = line + text.count("\n"), at + text.rindex("\n") + 1, True
        elif found.lastgroup in ("number", "name", "sign"):
            tokens.append(Token(found.lastgroup or "", text, place, is_first))
            is_first = False
        at = found.end()
    if not source.lstrip().startswith("#version"):
        notes.append("The first line should be #version 300 es.")
    tokens.append(Token("end", "", Place(line, max(at - begin, 0) + 1), True))
    _check_brackets(tokens)
    return tokens, notes


def _check_directive(word: str, rest: str, place: Place) -> None:
    if word == "version":
        if rest.split() != ["300", "es"]:
            raise Problem(place, f"this is GLSL ES 3.00: write #version 300 es, not #version{rest.rstrip()}")
        if place.line > 1:
            raise Problem(place, "#version 300 es must be the first line")
    elif word == "define":
        raise Problem(place, "#define is not supported here: write const float NAME = 1.0; instead")
    else:
        raise Problem(place, f"#{word} is not supported here: of the directives only #version 300 es is")


def _check_brackets(tokens: list[Token]) -> None:
    """Say which bracket has no partner, and where brackets are nested too deep."""
    opened: list[Token] = []
    for token in tokens:
        if token.kind != "sign":
            continue
        if token.text in BRACKETS:
            opened.append(token)
            if len(opened) > SHADER.brackets:
                raise Problem(token.place, f"brackets may be nested {SHADER.brackets} deep")
        elif token.text in BRACKETS.values():
            if not opened:
                raise Problem(token.place, f"this {token.text} closes nothing: no bracket is open here")
            last = opened.pop()
            if BRACKETS[last.text] != token.text:
                raise Problem(
                    last.place if last.place.line < token.place.line and last.text != "{" else token.place,
                    f"the {last.text} of line {last.place.line} must be closed by {BRACKETS[last.text]}, "
                    f"here comes {token.text} in line {token.place.line}",
                )
    if opened:
        last = opened[-1]
        raise Problem(last.place, f"this {last.text} is never closed: {BRACKETS[last.text]} is missing")


def joined_words(words: list[str]) -> str:
    """Return ``a, b or c``."""
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


# The functions of GLSL that shaders may call, and what is said of others.


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
