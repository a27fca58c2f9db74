"""How often the listing of a line method adds, multiplies, compares, looks up: run on numbers that count.

A listing makes numbers of its own too: a loop's columns, a square root, an entry of a table, a number in float32. It is
run as it is, but with names that mean counting loops, roots and tables. What advances a ``for`` loop is not counted.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from math import isqrt, sqrt
from types import FunctionType, SimpleNamespace
from typing import Any

import numpy as np

from core.methods import table
from core.raster.lines.records import check_segments
from core.raster.lines.traits import line_set_up, line_traits
from core.records.arrays import Floats
from core.resolved import resolve
from core.settings import Settings
from core.study.accuracy.counted_numbers import CountedNumber, plain


class CountedRange:
    """A range whose whole numbers count what is done with them."""

    def __init__(self, steps: range, tally: Counter[str]) -> None:
        self._steps, self._tally = steps, tally

    def __iter__(self) -> Iterator[CountedNumber]:
        return (CountedNumber(step, self._tally) for step in self._steps)

    def __getitem__(self, part: slice) -> "CountedRange":
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
