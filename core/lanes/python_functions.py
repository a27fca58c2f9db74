"""The functions of listings, also those on lists, ranges and flags: a table, and nothing beside it can be called."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isqrt
from typing import Any

import numpy as np

from core.lanes.problem import LARGEST, Place, Problem, counted
from core.lanes.python_values import Many, Range, Table, is_number, kind_of, number_kind, operator_rule
from core.lanes.run import Dialect, Run, Some

# The functions of listings: a table, and nothing beside it can be called.


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


# The functions of listings on lists, ranges and flags.


ANY_COUNT = ("zip", "range", "slice of")
"""Functions of any number of values."""


class ListFunctions:
    """The table of these functions; those whose names have a blank are forms of the language."""

    def __init__(self, dialect: Dialect) -> None:
        self._dialect = dialect
        self._functions: dict[str, Callable[..., Any]] = {
            "all": self._every,
            "any": self._every,
            "len": self._length,
            "tuple": self._listed,
            "list": self._listed,
            "zip": self._zipped,
            "enumerate": self._enumerated,
            "pairwise": self._pairs,
            "reversed": self._turned,
            "sorted": self._sorted,
            "sum": self._total,
            "range": self._range,
            "bool": self._truth,
            "is None": self._is_none,
            "in": self._is_in,
            "slice of": self._slice,
            "range by": self._range_by,
            "raise": self._raise,
        }

    def __contains__(self, name: str) -> bool:
        return name in self._functions

    @property
    def typed(self) -> tuple[str, ...]:
        """Names of those that may be typed."""
        return tuple(name for name in self._functions if name.isidentifier() and name not in ("in", "raise"))

    def call(self, name: str, values: Sequence[Any], mask: Some, place: Place, run: Run) -> Any:
        """Return what one of them makes of values."""
        wanted = 2 if name in ("in", "range by") else 1
        if name not in ANY_COUNT and len(values) != wanted:
            raise Problem(place, f"{name} takes {counted(wanted, 'value')}, got {len(values)}")
        return self._functions[name](values, mask, place, run, name)

    def _every(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        found: Any = name == "all"
        for part in self._dialect.elements(values[0], mask, place, run):
            truth = self._dialect.truth(part, place)
            found = found & truth if name == "all" else found | truth
        return found

    def _length(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        if isinstance(values[0], Table):
            return values[0].length
        return len(self._dialect.elements(values[0], mask, place, run))

    def _listed(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        return self._made(self._dialect.elements(values[0], mask, place, run), mask, place, run)

    def _zipped(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        lists = [self._dialect.elements(value, mask, place, run) for value in values]
        if len({len(parts) for parts in lists}) > 1:
            lengths = " and ".join(str(len(parts)) for parts in lists)
            raise Problem(place, f"zip takes lists of one length, these have {lengths} elements")
        return self._made([Many(parts) for parts in zip(*lists, strict=True)], mask, place, run)

    def _enumerated(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        parts = self._dialect.elements(values[0], mask, place, run)
        return self._made([Many([k, part]) for k, part in enumerate(parts)], mask, place, run)

    def _pairs(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        parts = self._dialect.elements(values[0], mask, place, run)
        return self._made([Many(pair) for pair in pairwise(parts)], mask, place, run)

    def _turned(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        return self._made(self._dialect.elements(values[0], mask, place, run)[::-1], mask, place, run)

    def _slice(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        whole, first, end = values
        return self._made(self._dialect.elements(whole, mask, place, run)[first:end], mask, place, run)

    def _sorted(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        parts = self._dialect.elements(values[0], mask, place, run)
        if not all(is_number(part) for part in parts):
            raise Problem(place, "sorted takes numbers only")
        if any(np.ndim(part) for part in parts):
            return self._made(list(np.sort(np.stack(np.broadcast_arrays(*parts)), axis=0)), mask, place, run)
        return self._made(sorted(parts), mask, place, run)

    def _total(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        add, total = operator_rule("+", place), 0
        for part in self._dialect.elements(values[0], mask, place, run):
            total = add(total, part, mask, run)
        return total

    def _range(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        if not 1 <= len(values) <= 3:
            raise Problem(place, f"range takes 1 to 3 values, got {len(values)}")
        for value in values:
            if not is_number(value) or number_kind(value) == "f":
                raise Problem(place, f"range takes whole numbers, not {kind_of(value)}")
        whole = [value.astype(np.int64) if np.ndim(value) else int(value) for value in values]
        if len(whole) == 3 and (np.asarray(whole[2]) == 0).any():
            raise Problem(place, "the step of a range cannot be 0")
        return Range(0, whole[0], 1) if len(whole) == 1 else Range(*whole, *([1] if len(whole) == 2 else []))

    def _range_by(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        whole, step = values
        if not isinstance(whole, Range) or not is_number(step) or number_kind(step) != "i":
            raise Problem(place, "only a range can be turned round by [::step]")
        if (np.abs(np.asarray(step)) != 1).any() or (np.abs(np.asarray(whole.step)) != 1).any():
            raise Problem(place, "a range is turned round by [::-1], or left by [::1]")
        ways = (step, whole.start, whole.stop, whole.step)
        if not any(np.ndim(part) for part in ways):
            kept = range(whole.start, whole.stop, whole.step)[::step]
            return Range(kept.start, kept.stop, kept.step)
        stays = np.asarray(step) > 0
        # Of no number, the turned range must stay without one.
        return Range(
            np.where(stays, whole.start, whole.stop - whole.step),
            np.where(stays, whole.stop, whole.start - whole.step),
            np.where(stays, whole.step, -np.asarray(whole.step)),
        )

    def _truth(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        return self._dialect.truth(values[0], place)

    def _is_none(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        return values[0] is None

    def _is_in(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        found: Any = False
        same = operator_rule("==", place)
        for part in self._dialect.elements(values[1], mask, place, run):
            found = found | same(part, values[0], mask, run)
        return found

    def _raise(self, values: Sequence[Any], mask: Some, place: Place, run: Run, name: str) -> Any:
        if not run.is_checking:
            raise Problem(place, str(values[0]))
        return None

    def _made(self, parts: Sequence[Any], mask: Some, place: Place, run: Run) -> Any:
        return self._dialect.many(parts, [False] * len(parts), mask, place, run)
