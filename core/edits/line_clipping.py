"""Edited line clippers: all segments run in step, and what was found at each border is traced as ever."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.edits.typed import Typed
from core.geometry.line_clipping.edge_walk import EdgeWalk, clipped_lines
from core.geometry.line_clipping.records import (
    ENTER,
    LEAVE,
    OUTSIDE,
    PARALLEL,
    ClippedLines,
    ClipWindow,
    need_rectangle,
)
from core.lanes.problem import Place, Problem
from core.lanes.python_values import at_lane
from core.methods import Method
from core.records.arrays import Floats

WORDS = "the ends that are left, and the numbers of each border"
SHAPE = ("list", "list")
BLOCK = 1024
"""Segments that run at once."""
BORDERS = 4


@dataclass(frozen=True)
class TypedClipper:
    """A line clipper that runs a typed text for all segments together."""

    typed: Typed

    def __call__(self, segments: Floats, window: ClipWindow) -> ClippedLines:
        """Clip segments (L, 2, 2) to a rectangle."""
        need_rectangle(window, "an edited Liang-Barsky")
        count, place = len(segments), self.typed.program.functions[self.typed.program.name].place
        ends = np.full((count, 2, 2), np.nan)
        seen = np.full((5, BORDERS, count), np.nan)
        looked_at = np.zeros(count, np.int64)
        for first in range(0, count, BLOCK):
            part = segments[first : first + BLOCK]
            columns = [np.ascontiguousarray(column) for column in part.reshape(-1, 4).T]
            left, numbers = self.typed.run([*columns, *window.borders], len(part), SHAPE, WORDS)
            for lane in range(len(part)):
                at = first + lane
                if kept := _kept_ends(at_lane(left, lane), place):
                    ends[at] = kept
                rows = _rows(at_lane(numbers, lane), place)
                looked_at[at] = len(rows)
                seen[:, : len(rows), at] = np.array(rows, float).reshape(-1, 5).T
        return clipped_lines(segments, window, _walk(ends, seen, looked_at), ends)


def _kept_ends(left: list[Any], place: Place) -> list[Any]:
    if left and np.shape(left) != (2, 2):
        raise Problem(place, "the ends that are left must be two, each (x, y), or none")
    return left


def _rows(numbers: list[Any], place: Place) -> list[Any]:
    if len(numbers) > BORDERS or any(np.shape(row) != (5,) for row in numbers):
        raise Problem(
            place, "the numbers of a border must be (p, q, t, t_enter, t_leave), of four borders at most"
        )
    return numbers


def _walk(ends: Floats, seen: Floats, looked_at: np.ndarray) -> EdgeWalk:
    """Return the walk along the borders of what was found, (5, 4, L), at the first ``looked_at`` (L,) borders."""
    along, room, t, enter, leave = seen
    is_kept = np.asarray(np.isfinite(ends).all(axis=(1, 2)))
    border = np.arange(BORDERS)[:, None]
    is_seen = border < looked_at
    is_last = (border == looked_at - 1) & ~is_kept
    is_outside = (along == 0) & (room < 0) & is_last
    case = np.select([is_outside, along == 0, along < 0, along > 0], [OUTSIDE, PARALLEL, ENTER, LEAVE], -1)
    bounds = []
    for bound, begins in ((enter, 0.0), (leave, 1.0)):
        held = np.concatenate([np.full((1, bound.shape[1]), begins), bound])
        for k in range(1, BORDERS + 1):
            held[k] = np.where(is_seen[k - 1], held[k], held[k - 1])
        bounds.append(held)
    cut_by = np.stack([_last_change(held) for held in bounds], axis=1)
    return EdgeWalk(
        np.where(is_seen, case, -1), along, room, t, bounds[0][1:], bounds[1][1:], is_kept, cut_by
    )


def _last_change(held: Floats) -> np.ndarray:
    """Return the last border (L,) at which a bound (5, L), with its beginning, has changed; -1: none."""
    changes = np.diff(held, axis=0) != 0
    last = BORDERS - 1 - np.argmax(changes[::-1], axis=0)
    return np.where(changes.any(axis=0), last, -1)


def check_clipper(typed: Typed) -> None:
    """Raise `Problem` for a text that cannot run."""
    typed.checked([np.zeros(0)] * 4 + [0.0, 0.0, 1.0, 1.0], SHAPE, WORDS)


def edited_clipper(method: Method, typed: Typed) -> Method:
    """Return a line clipper that runs a text."""
    return replace(method, function=TypedClipper(typed), listing=typed)
