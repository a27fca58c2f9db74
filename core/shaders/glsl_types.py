"""Types and values of GLSL: one array for each component, so that every sum is written out."""

from typing import Any

import numpy as np

from core.lanes.problem import Place, Problem

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
