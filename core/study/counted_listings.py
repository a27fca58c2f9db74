"""How often the listing of a line method adds, multiplies, compares: it is run on numbers that count this.

This counts what the algorithm does, not what NumPy does: the same on every machine.

A listing makes numbers of its own too: a loop's columns, a square root, an entry of a table, a number in float32. It is
run as it is, but with names that mean counting loops, roots and tables. What advances a ``for`` loop is not counted.
"""

from __future__ import annotations

import operator
from collections import Counter
from collections.abc import Callable, Iterator
from math import ceil, floor, isqrt, sqrt
from types import FunctionType, SimpleNamespace
from typing import Any

import numpy as np

from core.lines.line_method import check_segments, line_set_up, line_traits
from core.methods import table
from core.records.arrays import Floats
from core.resolved import resolve
from core.settings import Settings

# Numbers that count what is done with them: a listing is run on them, and its arithmetic is known.


KINDS = {bool: "integer", int: "integer", float: "float", np.float32: "float"}


class CountedNumber:
    """A number that notes every operation in a tally: ``integer additions``, ``float divisions`` and so on."""

    __slots__ = ("tally", "value")

    def __init__(self, value: Any, tally: Counter[str]) -> None:
        self.value, self.tally = value, tally

    def _done(self, name: str, rule: Callable[[Any, Any], Any], first: Any, second: Any) -> CountedNumber:
        result = rule(plain(first), plain(second))
        written = [each for each in (first, second) if not isinstance(each, CountedNumber)]
        if rule is operator.mul and type(result) is int and written == [2]:
            name = "doublings"  # A shift or an addition: Bresenham (1965) counts no multiplication.
        self.tally[f"{KINDS[type(result)]} {name}"] += 1
        return CountedNumber(result, self.tally)

    def _compared(self, rule: Callable[[Any, Any], bool], other: Any) -> bool:
        kinds = {KINDS[type(value)] for value in (self.value, plain(other))}
        self.tally[f"{'float' if 'float' in kinds else 'integer'} comparisons"] += 1
        return rule(self.value, plain(other))

    def __add__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.add, self, other)

    def __radd__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.add, other, self)

    def __sub__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.sub, self, other)

    def __rsub__(self, other: Any) -> CountedNumber:
        return self._done("additions", operator.sub, other, self)

    def __mul__(self, other: Any) -> CountedNumber:
        return self._done("multiplications", operator.mul, self, other)

    def __rmul__(self, other: Any) -> CountedNumber:
        return self._done("multiplications", operator.mul, other, self)

    def __truediv__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.truediv, other, self)

    def __floordiv__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.floordiv, self, other)

    def __mod__(self, other: Any) -> CountedNumber:
        return self._done("divisions", operator.mod, self, other)

    def __neg__(self) -> CountedNumber:
        return CountedNumber(-self.value, self.tally)

    def __abs__(self) -> CountedNumber:
        return CountedNumber(abs(self.value), self.tally)

    def __lt__(self, other: Any) -> bool:
        return self._compared(operator.lt, other)

    def __le__(self, other: Any) -> bool:
        return self._compared(operator.le, other)

    def __gt__(self, other: Any) -> bool:
        return self._compared(operator.gt, other)

    def __ge__(self, other: Any) -> bool:
        return self._compared(operator.ge, other)

    def __eq__(self, other: object) -> bool:
        return self._compared(operator.eq, other)

    def __hash__(self) -> int:
        return hash(self.value)

    def __bool__(self) -> bool:
        return bool(self.value)

    def __index__(self) -> int:
        return int(self.value)

    def __float__(self) -> float:
        return float(self.value)

    def __floor__(self) -> CountedNumber:
        return self._rounded(floor(self.value))

    def __ceil__(self) -> CountedNumber:
        return self._rounded(ceil(self.value))

    def __round__(self) -> CountedNumber:
        return self._rounded(round(self.value))

    def _rounded(self, result: int) -> CountedNumber:
        self.tally["roundings"] += 1
        return CountedNumber(result, self.tally)


def plain(number: Any) -> Any:
    """Return the value of a number, counted or not."""
    return number.value if isinstance(number, CountedNumber) else number


# How often the listing of a line method adds, multiplies, compares, looks up: run on numbers that count.


class CountedRange:
    """A range whose whole numbers count what is done with them."""

    def __init__(self, steps: range, tally: Counter[str]) -> None:
        self._steps, self._tally = steps, tally

    def __iter__(self) -> Iterator[CountedNumber]:
        return (CountedNumber(step, self._tally) for step in self._steps)

    def __getitem__(self, part: slice) -> CountedRange:
        return CountedRange(self._steps[part], self._tally)


class CountedTable:
    """A table of floats that counts how often it is looked up."""

    def __init__(self, entries: Floats, tally: Counter[str]) -> None:
        self._entries, self._tally = entries, tally

    def __getitem__(self, entry: CountedNumber) -> CountedNumber:
        self._tally["table look-ups"] += 1
        return CountedNumber(float(self._entries[plain(entry)]), self._tally)


def line_listing(line: str) -> FunctionType:
    """Return the listing of a line method."""
    listing = table.get("line", line).listing
    assert isinstance(listing, FunctionType), f"{line} has no listing"
    return listing


def used_names(listing: FunctionType) -> dict[str, Any]:
    """Return what the names mean that a listing takes from its module."""
    return {
        name: listing.__globals__[name] for name in listing.__code__.co_names if name in listing.__globals__
    }


def counting_listing(listing: FunctionType, tally: Counter[str]) -> Callable[..., Any]:
    """Return the same listing with loops, square roots and tables that make counted numbers."""

    def counted(name: str, rule: Callable[[Any], Any]) -> Callable[[Any], CountedNumber]:
        def done(number: Any) -> CountedNumber:
            tally[name] += 1
            return CountedNumber(rule(plain(number)), tally)

        return done

    def steps(*ends: Any) -> CountedRange:
        return CountedRange(range(*(plain(end) for end in ends)), tally)

    names = {
        "range": steps,
        "sqrt": counted("float square roots", sqrt),
        "isqrt": counted("integer square roots", isqrt),
        "np": SimpleNamespace(float32=counted("roundings to float32", np.float32)),
    }
    tables = {
        name: CountedTable(value, tally)
        for name, value in used_names(listing).items()
        if isinstance(value, np.ndarray)
    }
    return FunctionType(listing.__code__, {**listing.__globals__, **names, **tables})


def count_line_operations(segments: Floats, size: tuple[int, int], settings: Settings) -> dict[str, int]:
    """Run the listing of a line method on segments (L, 2, 2) and return how often it did what.

    Parameters
    ----------
    segments : (L, 2, 2) float64
        Window x and y in pixels.
    size : (width, height)
    settings : Settings
    """
    tally: Counter[str] = Counter()
    for ends in listing_ends(segments, size, settings):
        counting_listing(line_listing(settings.line), tally)(
            *(CountedNumber(end, tally) for end in ends), False
        )
    return dict(sorted(tally.items()))


def listing_ends(
    segments: Floats, size: tuple[int, int], settings: Settings
) -> list[list[int] | list[float]]:
    """Return x0, y0, x1, y1 of every segment (L, 2, 2) as the listing takes them: pixels, or positions."""
    checked = check_segments(segments, *size, resolve(settings).center)
    set_up = line_set_up(checked, settings.line)
    ends = np.column_stack([set_up["first_end"], set_up["second_end"]])
    listed: list[list[int] | list[float]] = ends.tolist()
    takes_pixels = line_traits(settings.line).takes_pixels
    return [[int(end) for end in each] for each in listed] if takes_pixels else listed
