"""Operators and functions of GLSL on components: float32 and int32, every operation rounded.

Notes
-----
Sums of products go from the last component to the first, and ``normalize`` multiplies by the inverse square root; a
matrix times a vector adds columns from the first to the last. Mesa (llvmpipe)
does the same, so that all of these give the same bits.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

F = np.float32
ONE, TWO, THREE, ZERO = F(1), F(2), F(3), F(0)
Part = Any
Rule = Callable[..., Part]


def sum_of_products(a: Sequence[Part], b: Sequence[Part]) -> Part:
    """Return the dot product of the components, summed from the last to the first."""
    total = a[-1] * b[-1]
    for x, y in zip(reversed(a[:-1]), reversed(b[:-1]), strict=True):
        total = total + x * y
    return total


def matrix_times_vector(columns: Sequence[Sequence[Part]], vector: Sequence[Part]) -> tuple[Part, ...]:
    """Return the sum of the columns times the components, from the first to the last."""
    made = []
    for row in range(len(columns[0])):
        total = columns[0][row] * vector[0]
        for column, component in zip(columns[1:], vector[1:], strict=True):
            total = total + column[row] * component
        made.append(total)
    return tuple(made)


def whole_quotient(a: Part, b: Part) -> Part:
    """Divide whole numbers and drop the fraction; by 0 it gives 0, which GLSL leaves open."""
    wide, by = np.asarray(a, np.int64), np.asarray(b, np.int64)
    by = np.where(by == 0, 1, by)
    quotient = np.sign(wide) * np.sign(by) * (np.abs(wide) // np.abs(by))
    return np.where(np.asarray(b) == 0, 0, quotient).astype(np.int32)[()]


def whole_remainder(a: Part, b: Part) -> Part:
    """Return what is left of the division of whole numbers, with the sign of ``a``."""
    wide = np.asarray(a, np.int64)
    return (wide - np.asarray(b, np.int64) * whole_quotient(a, b)).astype(np.int32)[()]


def rounded_to_int(part: Part) -> Part:
    """Return floats as whole numbers, cut off; what no int32 holds becomes the nearest one, NaN 0."""
    whole = np.nan_to_num(
        np.trunc(np.asarray(part, np.float64)), nan=0.0, posinf=2.0**31 - 1, neginf=-(2.0**31)
    )
    return np.clip(whole, -(2.0**31), 2.0**31 - 1).astype(np.int32)[()]


def inverse_square_root(a: Part) -> Part:
    """Return 1 / sqrt(a)."""
    return ONE / np.sqrt(a)


def _smoothstep(low: Part, high: Part, a: Part) -> Part:
    t = np.minimum(np.maximum((a - low) / (high - low), ZERO), ONE)
    return t * t * (THREE - TWO * t)


def _atan(y: Part, x: Part | None = None) -> Part:
    return np.arctan(y) if x is None else np.arctan2(y, x)


EACH_RULES: dict[str, Rule] = {
    "radians": lambda a: a * F(np.pi / 180),
    "degrees": lambda a: a * F(180 / np.pi),
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": _atan,
    "exp": np.exp,
    "log": np.log,
    "exp2": np.exp2,
    "log2": np.log2,
    "sqrt": np.sqrt,
    "inversesqrt": inverse_square_root,
    "abs": np.abs,
    "sign": np.sign,
    "floor": np.floor,
    "ceil": np.ceil,
    "round": np.rint,
    "trunc": np.trunc,
    "fract": lambda a: a - np.floor(a),
    "pow": np.power,
    "mod": lambda a, b: a - b * np.floor(a / b),
    "min": np.minimum,
    "max": np.maximum,
    "clamp": lambda a, low, high: np.minimum(np.maximum(a, low), high),
    "mix": lambda a, b, t: a * (ONE - t) + b * t,
    "step": lambda edge, a: np.where(a < edge, ZERO, ONE),
    "smoothstep": _smoothstep,
}


def _length(a: Sequence[Part]) -> Part:
    return np.abs(a[0]) if len(a) == 1 else np.sqrt(sum_of_products(a, a))


def _normalize(a: Sequence[Part]) -> tuple[Part, ...]:
    if len(a) == 1:
        return (np.sign(a[0]),)
    scale = inverse_square_root(sum_of_products(a, a))
    return tuple(x * scale for x in a)


def _cross(a: Sequence[Part], b: Sequence[Part]) -> tuple[Part, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _reflect(i: Sequence[Part], n: Sequence[Part]) -> tuple[Part, ...]:
    twice = TWO * sum_of_products(n, i)
    return tuple(x - twice * y for x, y in zip(i, n, strict=True))


def _refract(i: Sequence[Part], n: Sequence[Part], eta: Sequence[Part]) -> tuple[Part, ...]:
    cosine, ratio = sum_of_products(n, i), eta[0]
    k = ONE - ratio * ratio * (ONE - cosine * cosine)
    along = ratio * cosine + np.sqrt(np.maximum(k, ZERO))
    return tuple(np.where(k < ZERO, ZERO, ratio * x - along * y) for x, y in zip(i, n, strict=True))


def _faceforward(n: Sequence[Part], i: Sequence[Part], reference: Sequence[Part]) -> tuple[Part, ...]:
    is_in_front = sum_of_products(reference, i) < ZERO
    return tuple(np.where(is_in_front, x, -x) for x in n)


WHOLE_RULES: dict[str, Rule] = {
    "dot": lambda a, b: (sum_of_products(a, b),),
    "length": lambda a: (_length(a),),
    "distance": lambda a, b: (_length([x - y for x, y in zip(a, b, strict=True)]),),
    "normalize": _normalize,
    "cross": _cross,
    "reflect": _reflect,
    "refract": _refract,
    "faceforward": _faceforward,
}
"""Of components to components; ``dot``, ``length`` and ``distance`` give one."""


def determinant(columns: Sequence[Sequence[Part]]) -> Part:
    """Return the determinant, by the first column."""
    if len(columns) == 1:
        return columns[0][0]
    total: Part = None
    for row in range(len(columns)):
        term = columns[0][row] * determinant(_without(columns, 0, row))
        signed = term if row % 2 == 0 else -term
        total = signed if total is None else total + signed
    return total


def inverse(columns: Sequence[Sequence[Part]]) -> tuple[tuple[Part, ...], ...]:
    """Return the inverse by cofactors; not finite where there is none."""
    count, whole = len(columns), determinant(columns)
    return tuple(
        tuple(
            (ONE if (row + column) % 2 == 0 else -ONE) * determinant(_without(columns, row, column)) / whole
            for row in range(count)
        )
        for column in range(count)
    )


def _without(columns: Sequence[Sequence[Part]], column: int, row: int) -> list[list[Part]]:
    return [[part for j, part in enumerate(of) if j != row] for k, of in enumerate(columns) if k != column]
