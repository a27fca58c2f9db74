"""The functions of listings: a table, and nothing beside it can be called."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isqrt
from typing import Any

import numpy as np

from core.lanes.limits import LARGEST
from core.lanes.masks import Some
from core.lanes.problem import Place, Problem
from core.lanes.python_values import kind_of, number_kind

Numbers = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class Native:
    """A function on numbers."""

    rule: Numbers
    fewest: int = 1
    most: int = 1


def _chosen(is_better: Callable[[Any, Any], Any]) -> Numbers:
    """Return min or max of numbers: of equal ones the first, as Python takes it."""

    def best(*values: Any) -> Any:
        found = values[0]
        for value in values[1:]:
            better = is_better(value, found)
            if np.ndim(better):
                found = np.where(better, value, found)
            elif better:
                found = value
        return found

    return best


def _of_floats(rule: Callable[[Any], Any]) -> Numbers:
    def found(value: Any) -> Any:
        made = rule(value)
        return made if np.ndim(made) or isinstance(value, np.float32) else made.item()

    return found


def _absolute(value: Any) -> Any:
    return abs(value)


def _to_float(value: Any) -> Any:
    return value.astype(np.float64) if np.ndim(value) else float(value)


def _to_single(value: Any) -> Any:
    return value.astype(np.float32) if np.ndim(value) else np.float32(value)


def _root(value: Any) -> Any:
    if not np.ndim(value):
        return isqrt(max(int(value), 0))
    root = np.floor(np.sqrt(np.maximum(value, 0).astype(np.float64))).astype(np.int64)
    # The square root of a whole number near 2^53 may be rounded up.
    return root - (root * root > value)


def _parts_of_two(value: Any) -> Any:
    mantissa, exponent = np.frexp(value)
    if np.ndim(value):
        return [mantissa, exponent.astype(np.int64)]
    return [float(mantissa), int(exponent)]


def _scaled(mantissa: Any, exponent: Any) -> Any:
    made = np.ldexp(mantissa, exponent)
    return made if np.ndim(made) else float(made)


def _power(base: Any, exponent: Any) -> Any:
    """Return a power as floats: no whole number grows large, and a root of a negative number is NaN."""
    made = np.float_power(base, exponent)
    return made if np.ndim(made) else float(made)


NATIVE = {
    "abs": Native(_absolute),
    "min": Native(_chosen(lambda value, found: value < found), 1, 9),
    "max": Native(_chosen(lambda value, found: value > found), 1, 9),
    "sqrt": Native(_of_floats(np.sqrt)),
    "isqrt": Native(_root),
    "float": Native(_to_float),
    "float32": Native(_to_single),
    "isnan": Native(_of_floats(np.isnan)),
    "isfinite": Native(_of_floats(np.isfinite)),
    "frexp": Native(_parts_of_two),
    "ldexp": Native(_scaled, 2, 2),
    "pow": Native(_power, 2, 2),
}
"""Functions of numbers that give numbers."""

ROUNDING: dict[str, Callable[[Any], Any]] = {
    "floor": np.floor,
    "ceil": np.ceil,
    "round": np.rint,
    "int": np.trunc,
    "rint": np.rint,
}
"""Functions that give whole numbers."""


def rounded(name: str, value: Any, mask: Some, place: Place) -> Any:
    """Return a number rounded to a whole number, as Python rounds it; ``rint`` gives a float; the mask is (L,)."""
    if number_kind(value) != "f":
        return value.astype(np.int64) if np.ndim(value) else int(value)
    value = np.asarray(value)
    if name == "rint":
        return np.rint(value) if value.ndim else float(np.rint(value))
    is_bad = ~(np.abs(value) <= LARGEST)
    if (is_bad if mask is None or not value.ndim else is_bad & mask).any():
        raise Problem(place, f"{name} of a number that is not finite, or larger than 2 to the power 53")
    whole = ROUNDING[name](np.where(is_bad, 0, value))
    return whole.astype(np.int64) if whole.ndim else int(whole)


def applied(name: str, values: Sequence[Any], place: Place) -> Any:
    """Return what a function of `NATIVE` makes of numbers."""
    if name == "isqrt" and number_kind(values[0]) == "f":
        raise Problem(place, f"isqrt takes a whole number, not {kind_of(values[0])}")
    if name == "ldexp" and number_kind(values[1]) == "f":
        raise Problem(place, "ldexp takes a whole number as exponent")
    return NATIVE[name].rule(*values)
