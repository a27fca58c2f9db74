"""Edited line clippers: all segments run in step, and what was found at each border is traced as ever."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.edits.typed import Typed
from core.geometry.line_clipping.cohen_sutherland import cohen_sutherland_listing, join_passes
from core.geometry.line_clipping.cyrus_beck import cyrus_beck_listing
from core.geometry.line_clipping.edge_walk import EdgeWalk, clipped_lines
from core.geometry.line_clipping.records import (
    ACCEPT,
    CUT,
    ENTER,
    LEAVE,
    OUTSIDE,
    PARALLEL,
    REJECT,
    ClippedLines,
    ClipWindow,
    OutcodeRows,
    need_rectangle,
    rectangle_window,
)
from core.lanes.problem import Place, Problem
from core.lanes.python_values import at_lane, is_number
from core.methods import Method
from core.records.arrays import Flags, Floats

WORDS = "the ends that are left, and the numbers of each border"
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
            left, numbers = self.typed.run(given, len(part), SHAPE, WORDS)
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
    typed.checked(given, SHAPE, WORDS)


def edited_clipper(method: Method, typed: Typed) -> Method:
    """Return a line clipper that runs a text."""
    rule = TypedClipper(typed, method.name == "cyrus-beck-lecture")
    return replace(method, function=rule, listing=typed)
