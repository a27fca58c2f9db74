"""Types, values and names of GLSL: one array for each component, what is declared where, and what other languages say.

Every variable gets a name of its own, ``x·2`` where another is called ``x``, so that a function's variables need no
frame: GLSL has no recursion.
"""

from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem
from core.shaders.words import OTHER_FUNCTIONS

# Types and values of GLSL: one array for each component, so that every sum is written out.


VECTORS = {
    f"{letter}vec{count}": (scalar, count)
    for letter, scalar in (("", "float"), ("i", "int"), ("b", "bool"))
    for count in (2, 3, 4)
}
"""Type to the type and number of its components."""
SCALARS: dict[str, Any] = {"float": np.float32, "int": np.int32, "bool": np.bool_}
MATRICES = {f"mat{count}": count for count in (2, 3, 4)}
TYPES = (*SCALARS, *VECTORS, *MATRICES, "sampler2D")
_OF = {of: name for name, of in VECTORS.items()}
CONVERTS_NOTHING = " (GLSL converts nothing by itself: write 1.0 for 1, or float(...))"
COMPONENTS = ("xyzw", "rgba", "stpq")


class GlslValue:
    """A value: its type, and for each component an array () or (L,); of a matrix its columns, each (rows) of these."""

    __slots__ = ("of", "parts")

    def __init__(self, of: str, parts: tuple[Any, ...]) -> None:
        self.of, self.parts = of, parts


def split_type(of: str) -> tuple[str, int]:
    """Return the type and number of components; other types stand for themselves."""
    return VECTORS.get(of, (of, 1))


def vector_type(scalar: str, count: int) -> str:
    """Return the type of so many components, as ``vec3``."""
    return scalar if count == 1 else _OF[scalar, count]


def component_count(of: str) -> int:
    """Return how many numbers a value of a type has."""
    return MATRICES[of] ** 2 if of in MATRICES else split_type(of)[1]


def zero_of(of: str) -> GlslValue:
    """Return the value that stands for one that was never given."""
    if of in MATRICES:
        column = (np.zeros((), np.float32)[()],) * MATRICES[of]
        return GlslValue(of, (column,) * MATRICES[of])
    if of == "sampler2D":
        return GlslValue(of, (None,))
    scalar, count = split_type(of)
    return GlslValue(of, (np.zeros((), SCALARS[scalar])[()],) * count)


def picked(name: str, of: str, place: Place) -> list[int]:
    """Return which components a swizzle names."""
    count = split_type(of)[1]
    if of not in VECTORS:
        what = "a matrix has columns: write m[0]" if of in MATRICES else f"{of} is one number"
        raise Problem(place, f".{name} picks components of a vector, {what}")
    for letters in COMPONENTS:
        if set(name) <= set(letters):
            picks = [letters.index(letter) for letter in name]
            if len(picks) > 4:
                raise Problem(place, f".{name} picks {len(picks)} components, a vector has at most 4")
            if max(picks) >= count:
                missing = next(letter for letter in name if letters.index(letter) >= count)
                raise Problem(place, f".{name}: {of} has no component {missing}, only {letters[:count]}")
            return picks
    if set(name) <= set("".join(COMPONENTS)):
        raise Problem(place, f".{name} mixes letters: use xyzw, rgba or stpq, not letters of two of them")
    raise Problem(place, f".{name} is no component: a vector has x, y, z, w (or r, g, b, a)")


def from_rows(of: str, rows: Any) -> GlslValue:
    """Make a value of numbers: one, or (n,), of all lanes; (L, n) one a lane; a matrix (n, n), rows first."""
    if of in MATRICES:
        matrix = np.asarray(rows, np.float32)
        return GlslValue(of, tuple(tuple(column) for column in matrix.T))
    scalar, count = split_type(of)
    values = np.asarray(rows)
    if values.ndim == 0 or values.ndim == 1:
        return GlslValue(of, tuple(values.reshape(count).astype(SCALARS[scalar])))
    columns = np.ascontiguousarray(values[:, :count].T.astype(SCALARS[scalar]))
    return GlslValue(of, tuple(columns))


def rows_of(value: GlslValue, lanes: int) -> Any:
    """Return a vector's or scalar's components, (L, n)."""
    return np.stack([np.broadcast_to(part, (lanes,)) for part in value.parts], axis=1)


# Words that GLSL reserves, and those of other languages and versions: what is said of them.


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
        *("lowp", "precision", "layout", "if", "else", "for", "while", "do", "return", "break"),
        *("continue", "discard"),
    }
    | {
        *("true", "false", "struct", "switch", "case", "default", "varying", "attribute", "invariant"),
        *("uint", "input", "output", "sample", "filter", "common", "active", "half", "fixed", "double"),
        *("goto", "sizeof", "cast", "using"),
    }
)


# The names of a shader: what is declared where, and what is said of one that is not.


MARK = "·"
"""Between the typed name and a number, where several variables have it."""


@dataclass(frozen=True, slots=True)
class Variable:
    """A declared variable."""

    name: str
    """Its own, which no other has."""
    of: str
    """Its type."""
    read_only: str = ""
    """Why it cannot be assigned to: ``in``, ``uniform``, ``const``; empty: it can."""


def typed_name(name: str) -> str:
    """Return a variable's name as it was typed."""
    return name.partition(MARK)[0]


class Scopes:
    """The scopes that are open, the outermost first."""

    def __init__(self) -> None:
        self._open: list[dict[str, Variable]] = [{}]
        self._taken: dict[str, int] = {}
        self.declared_elsewhere: dict[str, str] = {}
        """Names that only ShaderMaterial declares, with their declarations."""
        self.predeclared: frozenset[str] = frozenset()

    def begin(self) -> None:
        """Open a scope."""
        self._open.append({})

    def end(self) -> None:
        """Close the innermost one."""
        self._open.pop()

    @property
    def is_global(self) -> bool:
        """Whether no function's scope is open."""
        return len(self._open) == 1

    def declare(self, name: str, of: str, place: Place, read_only: str = "") -> Variable:
        """Declare a variable in the innermost scope."""
        if name in self._open[-1]:
            if self.is_global and name in self.predeclared:
                raise Problem(
                    place,
                    f"ShaderMaterial declares {name} already: delete this line, or switch to RawShaderMaterial",
                )
            raise Problem(place, f"{name} is declared twice")
        number = self._taken[name] = self._taken.get(name, 0) + 1
        own = name if number == 1 else f"{name}{MARK}{number}"
        variable = self._open[-1][name] = Variable(own, of, read_only)
        return variable

    def find(self, name: str, place: Place, functions: dict[str, str]) -> Variable:
        """Return the variable of a name; ``functions`` are those that would be proposed beside variables."""
        for scope in reversed(self._open):
            if name in scope:
                return scope[name]
        if name in OTHER_WORDS:
            raise Problem(place, OTHER_WORDS[name])
        if name in self.declared_elsewhere:
            declaration = self.declared_elsewhere[name]
            raise Problem(
                place,
                f"{name} is not declared: only ShaderMaterial declares it. Switch to it, or write {declaration};",
            )
        if name in functions:
            other = proposal(name, self.names()).removeprefix(": did you mean ").removesuffix("?")
            more = f", or did you mean {other}?" if other else ""
            raise Problem(place, f"{name} is a function: write {name}(...){more}")
        raise Problem(place, f"{name} is not declared{proposal(name, self.names())}")

    def names(self) -> list[str]:
        """Return all names that are declared here."""
        return [name for scope in self._open for name in scope]


def proposal(name: str, known: list[str]) -> str:
    """Return ``: did you mean ...?`` where a known name is close, else nothing."""
    same = [other for other in known if other.lower() == name.lower() and other != name]
    close = same or (get_close_matches(name, known, 1, 0.7) if len(name) > 2 else [])
    return f": did you mean {close[0]}?" if close else ""
