"""Cohen-Sutherland: a segment against a rectangle by the outcodes of its ends.

An outcode has one bit for each edge that a point lies outside of. Both codes 0: the segment is inside. A bit in both:
it is outside that edge as a whole. Else an end that is outside moves to where the segment crosses the first edge that
its code names, and the codes are compared again.

References
----------
D. Cohen, I. Sutherland, 1967, in W. Newman, R. Sproull, *Principles of Interactive Computer Graphics*, 1973.
LMU, *Computer Graphics 1*, tutorial 5, "Cohen & Sutherland algorithm".
"""

from dataclasses import fields
from math import frexp

import numpy as np

from core.lines.line_clipping import (
    ACCEPT,
    CUT,
    REJECT,
    ClippedLines,
    ClipWindow,
    OutcodeRows,
    need_rectangle,
)
from core.methods import method
from core.records.arrays import Flags, Floats, Integers

Listed = list[tuple[int, int, int, int] | tuple[int, int, int, int, float, float]]
"""Both outcodes, the edge and the end that moves to it (-1: none), and where it moves, of every pass of a listing."""
FIRST_EDGE = np.array([-1, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0])
"""(16,) int64, the first edge that an outcode names; -1: none."""


def cohen_sutherland_listing(
    x0: float, y0: float, x1: float, y1: float, left: float, bottom: float, right: float, top: float
) -> tuple[list[list[float]], Listed]:
    """Listing of Cohen-Sutherland on one segment: the ends that are left (none: nothing is), and the passes."""
    ends, done = [[x0, y0], [x1, y1]], [0, 0]
    passes: Listed = []
    while True:
        codes = [
            (x < left) | (x > right) << 1 | (y < bottom) << 2 | (y > top) << 3 for x, y in ends
        ]  #: outcodes
        if codes[0] | codes[1] == 0:
            return ends, [*passes, (0, 0, -1, -1)]  #: accept
        if codes[0] & codes[1] != 0:  #: reject
            return [], [*passes, (codes[0], codes[1], -1, -1)]
        end = 0 if codes[0] != 0 else 1  #: end
        edge = frexp(codes[end] & -codes[end])[1] - 1  #: edge
        if edge < 2:
            border = left if edge == 0 else right
            t = (border - x0) / (x1 - x0)
            x, y = border, y0 + (y1 - y0) * t
        else:
            border = bottom if edge == 2 else top
            t = (border - y0) / (y1 - y0)
            x, y = x0 + (x1 - x0) * t, border
        x = max(x, left) if done[end] & 1 != 0 else min(x, right) if done[end] & 2 != 0 else x
        y = max(y, bottom) if done[end] & 4 != 0 else min(y, top) if done[end] & 8 != 0 else y
        ends[end] = [x, y]  #: move
        done[end] |= codes[end] & -codes[end]
        passes.append((codes[0], codes[1], edge, end, x, y))


@method(
    "line_clipping",
    "cohen-sutherland",
    "Cohen-Sutherland",
    source="Newman and Sproull 1973 (Cohen, Sutherland 1967); LMU 2020, Clipping",
    exact_for="segments entirely inside, or outside one edge; otherwise new ends are within 4 ulp of the "
    "largest coordinate",
    breaks_where="segments that cross an edge within rounding of a corner: the rounded new end decides. A clipped "
    "Bresenham line starts at another pixel and may choose other pixels",
    needs=("rectangle",),
    listing=cohen_sutherland_listing,
)
def cohen_sutherland(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Clip segments (L, 2, 2) by outcodes, an end and an edge at a time.

    Notes
    -----
    A new end is computed from the segment's own ends, so that errors do not add up, and it is held inside the edges
    that have moved it before: rounding cannot carry it out again, so there are at most eight passes.
    """
    need_rectangle(window, "cohen-sutherland")
    count = len(segments)
    ends = segments.copy()
    done = np.zeros((count, 2), np.int64)
    cut_by = np.full((count, 2), -1)
    is_kept = np.zeros(count, bool)
    passes: list[OutcodeRows] = []
    active = np.arange(count)
    while len(active):
        row = _one_pass(segments[active], ends[active], done[active], active, window)
        passes.append(row)
        is_kept[active[row.case == ACCEPT]] = True
        cuts = row.case == CUT
        active = active[cuts]
        end, edge = row.end[cuts], row.edge[cuts]
        ends[active, end] = row.point[cuts]
        done[active, end] |= 1 << edge
        cut_by[active, end] = edge
    kept = np.where(is_kept[:, None, None], ends, np.nan)
    return ClippedLines(
        kept, is_kept, np.where(is_kept[:, None], cut_by, -1), window, lambda: join_passes(passes)
    )


def outcode(points: Floats, window: ClipWindow) -> Integers:
    """Return the outcodes (..., ) int64 of points (..., 2): bits left 1, right 2, bottom 4, top 8."""
    left, bottom, right, top = window.borders
    x, y = points[..., 0], points[..., 1]
    return (x < left) | (x > right) << 1 | (y < bottom) << 2 | ((y > top) << 3).astype(np.int64)


def _one_pass(
    whole: Floats, ends: Floats, done: Integers, segment: Integers, window: ClipWindow
) -> OutcodeRows:
    """Look once at every segment (A, 2, 2) that is not decided."""
    codes = outcode(ends, window)
    is_inside: Flags = (codes == 0).all(axis=1)
    is_outside: Flags = (codes[:, 0] & codes[:, 1]) != 0
    case = np.select([is_inside, is_outside], [ACCEPT, REJECT], CUT)
    end = np.where(case == CUT, np.where(codes[:, 0] != 0, 0, 1), -1)
    edge = np.where(case == CUT, FIRST_EDGE[codes[np.arange(len(codes)), end]], -1)
    point = hold_inside(crossing(whole, edge, window), done[np.arange(len(codes)), end], window)
    point = np.where((case == CUT)[:, None], point, np.nan)
    return OutcodeRows(segment, case, ends, codes, edge, end, point)


def crossing(segments: Floats, edge: Integers, window: ClipWindow) -> Floats:
    """Return where the lines of segments (A, 2, 2) cross the edges (A,) of a rectangle, (A, 2)."""
    border = np.array([*window.points[[0, 1], 0], *window.points[[2, 3], 1]])[edge]
    is_level = edge >= 2
    u, v = (np.where(is_level[:, None], segments[:, :, 1 - k], segments[:, :, k]) for k in (0, 1))
    with np.errstate(all="ignore"):
        other = v[:, 0] + (v[:, 1] - v[:, 0]) * ((border - u[:, 0]) / (u[:, 1] - u[:, 0]))
    return np.where(is_level[:, None], np.stack([other, border], axis=1), np.stack([border, other], axis=1))


def hold_inside(points: Floats, done: Integers, window: ClipWindow) -> Floats:
    """Return points (A, 2), none of them outside the edges whose bits are set in ``done`` (A,)."""
    left, bottom, right, top = window.borders
    low = np.where((done[:, None] & [1, 4]) != 0, [left, bottom], -np.inf)
    high = np.where((done[:, None] & [2, 8]) != 0, [right, top], np.inf)
    return np.minimum(np.maximum(points, low), high)


def join_passes(passes: list[OutcodeRows]) -> OutcodeRows:
    """Put the passes of all segments in order: segment by segment."""
    if not passes:
        none, empty = np.empty(0, np.int64), np.empty((0, 2))
        return OutcodeRows(none, none, np.empty((0, 2, 2)), np.empty((0, 2), np.int64), none, none, empty)
    columns = [np.concatenate([getattr(row, f.name) for row in passes]) for f in fields(OutcodeRows)]
    order = np.argsort(columns[0], kind="stable")
    return OutcodeRows(*(values[order] for values in columns))
