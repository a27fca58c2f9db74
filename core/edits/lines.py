"""Edited line methods: all segments run in step, and put their pixels to one list."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from core.edits.typed import Typed
from core.lanes.limits import LISTING, line_rounds
from core.lanes.problem import Place, Problem
from core.lanes.python_values import Log, Many, is_number, rows_put
from core.methods import Method
from core.raster.lines.bresenham import bresenham_float_listing
from core.raster.lines.records import BLENDING, LineRun, Segments
from core.raster.lines.traits import LineTraits
from core.records.arrays import Flags, Floats, Integers
from core.records.operation import Columns

WORDS = "the list of pixels"
NUMBERS_A_ROUND = 16
"""Numbers that a round of the loop may store of a line: up to three pixels, and what chose them."""


@dataclass(frozen=True)
class TypedLines:
    """The rule of a line method that runs a typed text for all segments together."""

    typed: Typed
    traits: LineTraits = field(compare=False)
    is_smooth: bool
    """Whether its pixels have intensities."""
    decides_by_sum: bool = True
    """Of a Bresenham method, whether the sum that it lists decides by its sign; else with the slope added."""

    def __call__(self, segments: Segments, last_pixel: bool) -> LineRun:
        """Run the text for L segments.

        Raises
        ------
        ValueError
            If a segment is longer than the loop of a line may go on.
        """
        rounds = line_rounds(segments.width, segments.height)
        ends = segments.pixel_indices if self.traits.takes_pixels else self.traits.ends(segments)
        size = np.abs(np.diff(ends, axis=1))[:, 0]
        longest = int(np.ceil(size.max(initial=0))) + 2
        if longest > rounds:
            raise ValueError(
                f"an edited line takes at most {rounds:,} steps in a raster of this size, got {longest:,} "
                f"(segment {int(np.argmax(size.max(axis=1)))}): choose a line clipping"
            )
        count = max(LISTING.stored // (NUMBERS_A_ROUND * longest), 1)
        runs = [
            self._run(ends[first : first + count].reshape(-1, 4), last_pixel, rounds, first)
            for first in range(0, max(len(ends), 1), count)
        ]
        parts = [np.concatenate(part) for part in zip(*runs, strict=True)]
        return self._line_run(parts, size)

    def _run(self, ends: np.ndarray, last_pixel: bool, rounds: int, first: int) -> list[np.ndarray]:
        """Return owner, column, row, decision and intensity (P,) of the pixels of some segments, line by line."""
        columns = [np.ascontiguousarray(column) for column in ends.T]
        limits = replace(LISTING, rounds=rounds)
        made = self.typed.run([*columns, bool(last_pixel)], len(ends), "list", WORDS, limits)
        place = self.typed.program.functions[self.typed.program.name].place
        log = made if isinstance(made, Log) else Log([(None, value) for value in made])
        place = log.place or place
        _, put = rows_put(log, len(ends))
        found = [self._pixels(lanes, value, len(ends), place) for lanes, value in put]
        if not found:
            return [np.zeros(0, np.int64)] * 3 + [np.zeros(0)] * 2
        owner, *others = (np.concatenate(part) for part in zip(*found, strict=True))
        order = np.argsort(owner, kind="stable")
        return [owner[order] + first, *(other[order] for other in others)]

    def _pixels(self, lanes: Integers, value: Any, count: int, place: Place) -> list[np.ndarray]:
        """Return what one entry of the list puts for each of its lanes."""
        wanted = (4,) if self.is_smooth else (2, 3)
        form = "(x, y, decision, intensity)" if self.is_smooth else "(x, y) or (x, y, decision)"
        if not isinstance(value, Many) or len(value) not in wanted or not all(map(is_number, value)):
            raise Problem(place, f"a pixel of the list must be {form}")
        numbers = [np.broadcast_to(number, (count,)).take(lanes) for number in value]
        if any(number.dtype.kind == "f" for number in numbers[:2]):
            raise Problem(place, "the x and y of a pixel must be whole numbers")
        column, row = (number.astype(np.int64) for number in numbers[:2])
        decision = numbers[2].astype(float) if len(numbers) > 2 else np.full(len(lanes), np.nan)
        intensity = numbers[3].astype(float) if len(numbers) > 3 else np.ones(len(lanes))
        return [lanes, column, row, decision, intensity]

    def _line_run(self, parts: list[np.ndarray], size: Floats) -> LineRun:
        owner, column, row, decision, intensity = parts
        number = np.arange(len(owner)) - np.searchsorted(owner, owner)
        is_first = number == 0
        moved = [(values != np.roll(values, 1)) & ~is_first for values in (column, row)]
        is_steep = (size[:, 1] > size[:, 0])[owner]
        has_stepped: Flags = np.where(is_steep, moved[0], moved[1])
        if self.traits.takes_pixels:
            return self._bresenham_run(owner, number, column, row, decision, has_stepped)
        is_tie = decision - np.floor(decision) == 0.5
        if not self.is_smooth:
            return LineRun(owner, number, column, row, decision, has_stepped, is_tie)
        index = _index_in_columns(
            number, np.where(is_steep, moved[1], moved[0]), self.traits.pixels_in_column
        )
        return LineRun(owner, index, column, row, decision, has_stepped, is_tie, intensity=intensity)

    def _bresenham_run(
        self,
        owner: Integers,
        number: Integers,
        column: Integers,
        row: Integers,
        after: Floats,
        stepped: Flags,
    ) -> LineRun:
        """Return the run of a listing that lists the sum after a pixel: the one before has chosen it."""
        before = np.where(number == 0, np.nan, np.roll(after, 1))
        chosen_by = before if self.decides_by_sum else np.full(len(before), np.nan)
        run = LineRun(owner, number, column, row, chosen_by, stepped, chosen_by == 0)
        return replace(run, sum_before=before, sum_advanced=after)


def _index_in_columns(number: Integers, is_next_column: Flags, in_column: int) -> Integers:
    """Return the index (P,) of pixels along their lines where so many are counted for each column."""
    is_first = number == 0
    column = np.cumsum(is_next_column, dtype=np.int64)
    lengths = np.diff(np.append(np.flatnonzero(is_first), len(number)))
    column = column - np.repeat(column[is_first], lengths)
    begins = np.flatnonzero(is_first | is_next_column)
    place = np.arange(len(number)) - np.repeat(begins, np.diff(np.append(begins, len(number))))
    return np.asarray(in_column * column + np.minimum(place, in_column - 1))


def check_line(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run; positions and pixels are both tried as floats."""
    typed.checked([np.zeros(0, np.int64)] * 4 + [True], "list", WORDS)


def _unknown_columns(own: Callable[[Columns], dict[str, Any]], columns: Columns) -> dict[str, Any]:
    """Return the columns of a method by name, NaN: a typed text says nothing of them."""
    names = own({name: values[:0] for name, values in columns.items()})
    count = len(columns["row"])
    return {name: np.full((count, *values.shape[1:]), np.nan) for name, values in names.items()}


def edited_line(method: Method, typed: Typed) -> Method:
    """Return a line method that runs a text."""
    traits = method.traits if isinstance(method.traits, LineTraits) else LineTraits()
    decides_by_sum = typed.of is not bresenham_float_listing
    rule = TypedLines(typed, traits, BLENDING in method.needs, decides_by_sum)
    kept = replace(traits, find_pixels=None, columns=partial(_unknown_columns, traits.columns))
    return replace(method, function=rule, listing=typed, traits=kept)
