"""Edited line methods and line clippers: all segments run in step, and what the text found draws."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from core.edits.typed import Typed
from core.lanes.problem import LISTING, Place, Problem, line_rounds
from core.lanes.python_values import Log, Many, at_lane, is_number, rows_put
from core.lines.bresenham import bresenham_float_listing
from core.lines.cohen_sutherland import cohen_sutherland_listing, join_passes
from core.lines.line_clipping import (
    ACCEPT,
    CUT,
    ENTER,
    LEAVE,
    OUTSIDE,
    PARALLEL,
    REJECT,
    ClippedLines,
    ClipWindow,
    EdgeWalk,
    OutcodeRows,
    clipped_lines,
    need_rectangle,
    rectangle_window,
)
from core.lines.line_method import BLENDING, LineRun, LineTraits, Segments
from core.lines.parametric_clipping import cyrus_beck_listing
from core.methods import Method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Columns

# Edited line methods: all segments run in step, and put their pixels to one list.


WORDS_OF_LINES = "the list of pixels"
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
        made = self.typed.run([*columns, bool(last_pixel)], len(ends), "list", WORDS_OF_LINES, limits)
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
    typed.checked([np.zeros(0, np.int64)] * 4 + [True], "list", WORDS_OF_LINES)


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


# Edited line clippers: all segments run in step, and what was found at each border is traced as ever.


WORDS_OF_CLIPPERS = "the ends that are left, and the numbers of each border"
SHAPE = ("list", "list")
BLOCK = 1024
"""Segments that run at once."""
PASS_NUMBERS, CUT_NUMBERS, BORDER_NUMBERS = 4, 6, 5
"""Numbers of a pass that decides, of one that moves an end, and of a border."""


@dataclass(frozen=True)
class TypedClipper:
    """A line clipper that runs a typed text for all segments together."""

    typed: Typed
    ignores_parallel: bool = False
    """Whether parallel edges are ignored, as a lecture prints it."""

    def __call__(self, segments: Floats, window: ClipWindow) -> ClippedLines:
        """Clip segments (L, 2, 2) to a window: a rectangle, but for Cyrus-Beck."""
        place = self.typed.program.functions[self.typed.program.name].place
        ends = np.full((len(segments), 2, 2), np.nan)
        found: list[list[Any]] = []
        for first in range(0, len(segments), BLOCK):
            part = segments[first : first + BLOCK]
            columns = [np.ascontiguousarray(column) for column in part.reshape(-1, 4).T]
            given = clipper_inputs(self.typed, columns, window, self.ignores_parallel)
            left, numbers = self.typed.run(given, len(part), SHAPE, WORDS_OF_CLIPPERS)
            for lane in range(len(part)):
                if kept := _kept_ends(at_lane(left, lane), place):
                    ends[first + lane] = kept
                found.append(at_lane(numbers, lane))
        if self.typed.of is cohen_sutherland_listing:
            return _passes(segments, ends, found, window, place)
        seen = np.full((5, len(window.points), len(segments)), np.nan)
        looked_at = np.zeros(len(segments), np.int64)
        for at, numbers in enumerate(found):
            rows = _rows(numbers, len(window.points), place)
            looked_at[at] = len(rows)
            seen[:, : len(rows), at] = np.array(rows, float).reshape(-1, 5).T
        return clipped_lines(segments, window, _walk(ends, seen, looked_at), ends)


def clipper_inputs(
    typed: Typed, ends: Sequence[Any], window: ClipWindow, ignores_parallel: bool
) -> list[Any]:
    """Return what the listing of a clipper is given: x and y of both ends, a number each or (L,), and the window."""
    if typed.of is cyrus_beck_listing:
        lists = window.normals.tolist(), window.points.tolist()
        return [list(ends[:2]), list(ends[2:]), *lists, ignores_parallel]
    need_rectangle(window, f"an edited {typed.of.__name__}")
    return [*ends, *window.borders]


def _passes(
    segments: Floats, ends: Floats, found: list[list[Any]], window: ClipWindow, place: Place
) -> ClippedLines:
    """Return what Cohen-Sutherland's passes have found, and the ends (L, 2, 2) that are left."""
    rows: list[tuple[Any, ...]] = []
    is_kept: Flags = np.asarray(np.isfinite(ends).all(axis=(1, 2)))
    cut_by = np.full((len(segments), 2), -1)
    for segment, passes in enumerate(found):
        now = segments[segment].copy()
        for number, made in enumerate(passes):
            _check_pass(made, len(passes) - number == 1, place)
            *codes, edge, end = (int(value) for value in made[:4])
            is_cut = len(made) == CUT_NUMBERS
            case = CUT if is_cut else ACCEPT if is_kept[segment] else REJECT
            point = np.array(made[4:], float) if is_cut else np.full(2, np.nan)
            rows.append((segment, case, now.copy(), codes, edge, end, point))
            if is_cut:
                now[end], cut_by[segment, end] = point, edge
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    listed = OutcodeRows(*columns) if rows else join_passes([])
    return ClippedLines(ends, is_kept, np.where(is_kept[:, None], cut_by, -1), window, lambda: listed)


def _check_pass(made: Any, is_last: bool, place: Place) -> None:
    """Raise `Problem` for a pass that is none."""
    is_cut = _has_numbers(made, CUT_NUMBERS) and made[2] in range(4) and made[3] in (0, 1)
    if not is_cut and not (is_last and _has_numbers(made, PASS_NUMBERS)):
        raise Problem(
            place, "a pass must be (code, code, edge, end, x, y), the last one (code, code, -1, -1)"
        )


def _has_numbers(made: Any, count: int) -> bool:
    return isinstance(made, list) and len(made) == count and all(map(is_number, made))


def _kept_ends(left: list[Any], place: Place) -> list[Any]:
    if left and not (len(left) == 2 and all(_has_numbers(end, 2) for end in left)):
        raise Problem(place, "the ends that are left must be two, each (x, y), or none")
    return left


def _rows(numbers: list[Any], borders: int, place: Place) -> list[Any]:
    if len(numbers) > borders or not all(_has_numbers(row, BORDER_NUMBERS) for row in numbers):
        raise Problem(
            place,
            f"the numbers of a border must be (p, q, t, t_enter, t_leave), of {borders} borders at most",
        )
    return numbers


def _walk(ends: Floats, seen: Floats, looked_at: np.ndarray) -> EdgeWalk:
    """Return the walk along M borders of what was found, (5, M, L), at the first ``looked_at`` (L,) of them."""
    along, room, t, enter, leave = seen
    is_kept = np.asarray(np.isfinite(ends).all(axis=(1, 2)))
    borders = seen.shape[1]
    border = np.arange(borders)[:, None]
    is_seen = border < looked_at
    is_last = (border == looked_at - 1) & ~is_kept
    is_outside = (along == 0) & (room < 0) & is_last
    case = np.select([is_outside, along == 0, along < 0, along > 0], [OUTSIDE, PARALLEL, ENTER, LEAVE], -1)
    bounds = []
    for bound, begins in ((enter, 0.0), (leave, 1.0)):
        held = np.concatenate([np.full((1, bound.shape[1]), begins), bound])
        for k in range(1, borders + 1):
            held[k] = np.where(is_seen[k - 1], held[k], held[k - 1])
        bounds.append(held)
    cut_by = np.stack([_last_change(held) for held in bounds], axis=1)
    return EdgeWalk(
        np.where(is_seen, case, -1), along, room, t, bounds[0][1:], bounds[1][1:], is_kept, cut_by
    )


def _last_change(held: Floats) -> np.ndarray:
    """Return the last border (L,) at which a bound (M + 1, L), with its beginning, has changed; -1: none."""
    changes = np.diff(held, axis=0) != 0
    last = len(changes) - 1 - np.argmax(changes[::-1], axis=0)
    return np.where(changes.any(axis=0), last, -1)


def check_clipper(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    given = clipper_inputs(typed, [np.zeros(0)] * 4, rectangle_window(0.0, 0.0, 1.0, 1.0), False)
    typed.checked(given, SHAPE, WORDS_OF_CLIPPERS)


def edited_clipper(method: Method, typed: Typed) -> Method:
    """Return a line clipper that runs a text."""
    rule = TypedClipper(typed, method.name == "cyrus-beck-lecture")
    return replace(method, function=rule, listing=typed)
