"""Parametric line clippers: entries and exits along a segment, by normals, in whole numbers, by inequalities.

Where D = P1 - P0 runs against the outward normal N the line potentially enters (PE), where it runs with it the line
potentially leaves (PL), both at t = N . (P0 - P_E) / (-N . D). The segment is inside from the largest t of an entry to
the least of an exit.

The lecture prints "if N . D is not 0 {ignore edges parallel to line}" and stops there, so a segment that is parallel to
an edge and outside it is kept. ``cyrus-beck`` looks at its side; ``cyrus-beck-lecture`` is as printed.

References
----------
M. Cyrus, J. Beck, *Generalized two- and three-dimensional clipping*, 1978.
M. I. Jubair, *Computer Graphics*, "Cyrus-Beck Parametric Line Clipping Algorithm".

A float64 is a whole number times a power of two, so the coordinates of all segments are whole numbers of one small
unit. Then N . D and N . (P0 - P_E) are whole numbers too, and two crossings a/b and c/d are compared by a d and c b.
The new end is one quotient of whole numbers, which Python rounds correctly. Segments inside the window, or
outside one edge of a rectangle, are decided by comparing coordinates, which is exact as it is.

References
----------
M. Cyrus, J. Beck, *Generalized two- and three-dimensional clipping*, 1978.
C. Yap, *Towards exact geometric computation*, 1997 (decisions by exact signs).

For the edges left, right, bottom and top p is how fast the segment runs outward and q how much room its first end
has. p < 0: it comes in through the edge's line at t = q/p; p > 0: it goes out there; p = 0: it runs along the edge, and
lies outside if q < 0. What is left runs from the last entry to the first exit.

References
----------
Y.-D. Liang, B. Barsky, *A new concept and method for line clipping*, 1984.
LMU, *Computer Graphics 1*, tutorial 5, "Liang-Barsky Algorithm".
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from math import nan
from typing import Any

import numpy as np

from core.lines.line_clipping import (
    ENTER,
    LEAVE,
    OUTSIDE,
    PARALLEL,
    ClippedLines,
    ClipWindow,
    EdgeWalk,
    clipped_lines,
    need_rectangle,
    points_at,
    rows_of_walk,
    walk_edges,
)
from core.methods import method
from core.records.arrays import Flags, Floats

# Cyrus-Beck: a segment against any convex window by the outward normals of its edges.


ListedByNormals = list[tuple[float, float, float, float, float]]
"""N . D, -N . (P0 - P_E), t, t_E and t_L of every edge looked at, from a listing."""


def cyrus_beck_listing(
    p0: Sequence[float], p1: Sequence[float], normals: Floats, points: Floats, ignores_parallel: bool
) -> tuple[list[Sequence[float]], ListedByNormals]:
    """Listing of Cyrus-Beck on one segment: the ends that are left (none: nothing is), and the numbers.

    With ``ignores_parallel`` as printed.
    """
    d = p1[0] - p0[0], p1[1] - p0[1]
    is_point = d[0] == 0 and d[1] == 0
    t_e, t_l, entry, exit = 0.0, 1.0, -1, -1
    seen: ListedByNormals = []
    for k, (n, p_e) in enumerate(zip(normals, points, strict=True)):
        t = nan
        to_start = p0[0] - p_e[0], p0[1] - p_e[1]
        along, room = n[0] * d[0] + n[1] * d[1], -(n[0] * to_start[0] + n[1] * to_start[1])  #: edges
        if along == 0:
            if room < 0 and (is_point or not ignores_parallel):  #: parallel
                return [], [*seen, (along, room, t, t_e, t_l)]  #: outside
        else:
            t = room / along  #: t
            if along < 0 and t > t_e:  #: entry
                t_e, entry = t, k  #: enter
            if along > 0 and t < t_l:  #: exit
                t_l, exit = t, k  #: leave
        seen.append((along, room, t, t_e, t_l))
    if t_e > t_l:
        return [], seen  #: empty
    first, second = (
        point_at(p0, d, t_e) if entry >= 0 else p0,
        point_at(p0, d, t_l) if exit >= 0 else p1,
    )  #: ends
    return [first, second], seen


def point_at(p0: Sequence[float], d: Sequence[float], t: float) -> list[float]:
    """Return P(t) = P0 + t D."""
    return [p0[0] + t * d[0], p0[1] + t * d[1]]


@method(
    "line_clipping",
    "cyrus-beck",
    "Cyrus-Beck",
    source="Cyrus and Beck 1978; Jubair, Cyrus-Beck Parametric Line Clipping Algorithm",
    exact_for="segments well inside or outside any convex window; otherwise new ends are within 4 ulp of the "
    "largest coordinate, unless the segment is nearly parallel to the edge",
    breaks_where="segments nearly parallel to a slanted edge. Rounding may put a new end beside the edge. A "
    "clipped Bresenham line may choose other pixels",
    listing=cyrus_beck_listing,
)
def cyrus_beck(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Clip segments (L, 2, 2) by the table of entries (PE) and exits (PL)."""
    return _clip(segments, window, None)


@method(
    "line_clipping",
    "cyrus-beck-lecture",
    "Cyrus-Beck, as printed (Jubair)",
    source="Jubair, Cyrus-Beck Algorithm",
    exact_for="segments parallel to no edge",
    breaks_where="segments parallel to an edge and outside it: they are kept",
    listing=cyrus_beck_listing,
)
def cyrus_beck_lecture(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Clip segments (L, 2, 2) as the lecture prints it: parallel edges are ignored, points are clipped as points."""
    ignores: Flags = (segments[:, 0] != segments[:, 1]).any(axis=1)
    return _clip(segments, window, ignores)


def _clip(segments: Floats, window: ClipWindow, ignores: Flags | None) -> ClippedLines:
    (x, y), (dx, dy) = segments[:, 0].T, (segments[:, 1] - segments[:, 0]).T
    (nx, ny), (ex, ey) = window.normals.T[..., None], window.points.T[..., None]
    along = nx * dx + ny * dy
    room = -(nx * (x - ex) + ny * (y - ey))
    walk = walk_edges(along, room, stops_early=False, ignores=ignores)
    return clipped_lines(segments, window, walk, points_at(segments, walk))


# Line clipping in whole numbers: every decision is the sign of an exact integer, every new end is correctly
# rounded.


Wholes = np.ndarray[Any, Any]
"""Arrays of Python's whole numbers, of any size."""
ListedExactly = list[tuple[float, ...]]
"""N . D, -N . (P0 - P_E), t, t_E and t_L of every edge looked at, rounded, from a listing."""


def exact_listing(
    p0: list[float], p1: list[float], normals: list[list[Fraction]], points: list[list[float]]
) -> tuple[list[list[float]], ListedExactly]:
    """Listing of exact clipping on one segment: the ends that are left (none: nothing is), and the numbers."""
    x, y, x1, y1 = (Fraction(value) for value in (*p0, *p1))
    dx, dy = x1 - x, y1 - y
    t_e, t_l, entry, exit = Fraction(0), Fraction(1), -1, -1
    seen: ListedExactly = []
    for k, (nx, ny) in enumerate(normals):
        ex, ey = points[k]
        t = None
        along, room = nx * dx + ny * dy, -(nx * (x - Fraction(ex)) + ny * (y - Fraction(ey)))  #: edges
        if along == 0:
            if room < 0:  #: parallel
                return [], [*seen, (0.0, float(room), math.nan, float(t_e), float(t_l))]  #: outside
        else:
            t = room / along  #: t
            if along < 0 and t > t_e:  #: entry
                t_e, entry = t, k  #: enter
            if along > 0 and t < t_l:  #: exit
                t_l, exit = t, k  #: leave
        crossing = math.nan if t is None else rounded_quotient(*t.as_integer_ratio())
        seen.append((float(along), float(room), crossing, float(t_e), float(t_l)))
        if t_e > t_l:
            return [], seen  #: empty
    ends = [list(p0), list(p1)]  #: uncut
    for end, (at, k) in enumerate([(t_e, entry), (t_l, exit)]):
        if k >= 0:
            ends[end] = [float(x + at * dx), float(y + at * dy)]  #: ends
    return ends, seen


@method(
    "line_clipping",
    "exact",
    "Exact signs",
    source="Yap 1997, exact geometric computation; Cyrus and Beck 1978",
    exact_for="every segment and every convex window, including ties and corners; new ends are correctly "
    "rounded",
    breaks_where="clipped Bresenham lines: they start at another pixel and may choose other pixels",
    listing=exact_listing,
)
def exact_clipping(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Clip segments (L, 2, 2) with decisions by exact signs; touching the window in one point keeps that point."""
    kept, cut_by = segments.copy(), np.full((len(segments), 2), -1)
    is_kept, is_open = decide_by_coordinates(segments, window)
    walk, ends = exact_walk(segments[is_open], window)
    is_kept[is_open] = walk.is_kept
    kept[is_open], cut_by[is_open] = ends, walk.cut_by
    kept[~is_kept], cut_by[~is_kept] = np.nan, -1
    return ClippedLines(
        kept, is_kept, cut_by, window, lambda: rows_of_walk(exact_walk(segments, window)[0], kept)
    )


def decide_by_coordinates(segments: Floats, window: ClipWindow) -> tuple[Flags, Flags]:
    """Decide what needs no arithmetic: segments (L, 2, 2) inside a rectangle, or outside the box of any window.

    Returns
    -------
    is_inside, is_open : (L,) bool
        Kept as they are; to be decided by signs.
    """
    low, high = window.corners.min(axis=0), window.corners.max(axis=0)
    is_below, is_above = segments < low, segments > high
    is_outside = (is_below.all(axis=1) | is_above.all(axis=1)).any(axis=1)
    is_inside = ~(is_below | is_above).any(axis=(1, 2)) & window.is_rectangle
    return is_inside, ~(is_outside | is_inside)


def exact_walk(segments: Floats, window: ClipWindow) -> tuple[EdgeWalk, Floats]:
    """Walk along the edges with exact signs.

    Returns
    -------
    walk : EdgeWalk
        Its numbers are the exact ones, rounded.
    ends : (L, 2, 2) float64
    """
    count, edge_count = len(segments), len(window.normals)
    shift = unit_exponent(np.concatenate([segments.ravel(), window.corners.ravel()]))
    (x, y), (x1, y1) = (whole_numbers(segments[:, k], shift).T for k in (0, 1))
    dx, dy = x1 - x, y1 - y
    (nx, ny), normal_shift = _normals(window, shift)
    points = whole_numbers(window.points, shift)
    is_alive = np.ones(count, bool)
    enter, leave = (np.zeros(count, object), np.ones(count, object)), (np.ones(count, object),) * 2
    cut_by = np.full((count, 2), -1)
    case = np.full((edge_count, count), -1)
    along, room, t, enters, leaves = np.full((5, edge_count, count), np.nan)
    for edge in range(edge_count):
        toward: Wholes = nx[edge] * dx + ny[edge] * dy
        offset: Wholes = -(nx[edge] * (x - points[edge, 0]) + ny[edge] * (y - points[edge, 1]))
        is_parallel = is_alive & (toward == 0).astype(bool)
        is_outside = is_parallel & (offset < 0).astype(bool)
        is_entry, is_exit = is_alive & (toward < 0).astype(bool), is_alive & (toward > 0).astype(bool)
        case[edge] = np.select(
            [is_outside, is_parallel, is_entry, is_exit], [OUTSIDE, PARALLEL, ENTER, LEAVE], -1
        )
        # t = numerator / denominator, with a denominator above 0; 1 stands where there is no t.
        denominator = np.where(toward == 0, 1, abs(toward))
        numerator = np.where(toward < 0, -offset, offset)
        later = is_entry & is_less(enter, (numerator, denominator))
        sooner = is_exit & is_less((numerator, denominator), leave)
        enter = _chosen(later, (numerator, denominator), enter)
        leave = _chosen(sooner, (numerator, denominator), leave)
        cut_by[later, 0], cut_by[sooner, 1] = edge, edge
        along[edge], room[edge] = (_scaled(values, shift + normal_shift) for values in (toward, offset))
        t[edge] = np.where(toward == 0, np.nan, quotient(numerator, denominator))
        enters[edge], leaves[edge] = quotient(*enter), quotient(*leave)
        is_alive &= ~is_outside & ~is_less(leave, enter)
    walk = EdgeWalk(case, along, room, t, enters, leaves, is_alive, cut_by)
    ends = segments.copy()
    for end, (numerator, denominator) in enumerate((enter, leave)):
        is_cut = np.flatnonzero(cut_by[:, end] >= 0)
        for axis, (start, length) in enumerate(((x, dx), (y, dy))):
            top = start[is_cut] * denominator[is_cut] + numerator[is_cut] * length[is_cut]
            ends[is_cut, end, axis] = quotient(top, denominator[is_cut] << shift)
    return walk, ends


def unit_exponent(values: Floats) -> int:
    """Return the least k >= 0 for which all values (K,) are whole numbers of 2**-k."""
    denominators = [value.as_integer_ratio()[1].bit_length() - 1 for value in values.tolist()]
    return max(denominators, default=0)


def whole_numbers(values: Floats, shift: int) -> Wholes:
    """Return values, of any shape, as whole numbers of 2**-shift."""
    found = np.empty(values.size, object)
    ratios = (value.as_integer_ratio() for value in values.ravel().tolist())
    found[:] = [(numerator << shift) // denominator for numerator, denominator in ratios]
    return found.reshape(values.shape)


def is_less(first: tuple[Wholes, Wholes], second: tuple[Wholes, Wholes]) -> Flags:
    """Compare fractions (L,) with denominators above 0, exactly."""
    return (first[0] * second[1] < second[0] * first[1]).astype(bool)


def quotient(numerator: Wholes, denominator: Wholes) -> Floats:
    """Divide whole numbers (L,), correctly rounded."""
    return np.asarray(np.frompyfunc(rounded_quotient, 2, 1)(numerator, denominator)).astype(float)


def rounded_quotient(numerator: int, denominator: int) -> float:
    """Divide one whole number by another above 0, correctly rounded; infinite beyond the largest float64."""
    try:
        return numerator / denominator
    except OverflowError:
        return math.copysign(math.inf, numerator)


def _scaled(values: Wholes, shift: int) -> Floats:
    """Return whole numbers (L,) of 2**-shift as float64, correctly rounded."""
    return quotient(values, np.full(values.shape, 1 << shift, object))


def _normals(window: ClipWindow, shift: int) -> tuple[Wholes, int]:
    """Return the outward normals (2, M) as whole numbers, and how many binary digits they have after the point."""
    if window.is_rectangle:
        return whole_numbers(window.normals, 0).T, 0
    corners = whole_numbers(window.corners, shift)
    along = np.roll(corners, -1, axis=0) - corners
    return np.stack([along[:, 1], -along[:, 0]]), shift


def _chosen(
    flags: Flags, first: tuple[Wholes, Wholes], second: tuple[Wholes, Wholes]
) -> tuple[Wholes, Wholes]:
    """Return the fractions ``first`` where ``flags`` (L,) hold, else ``second``."""
    return np.where(flags, first[0], second[0]), np.where(flags, first[1], second[1])


# Liang-Barsky: a segment against a rectangle by four inequalities t p <= q.


ListedByInequalities = list[tuple[float, float, float, float, float]]
"""p, q, t, t_enter and t_leave of every edge looked at, from a listing."""


def liang_barsky_listing(
    x0: float, y0: float, x1: float, y1: float, left: float, bottom: float, right: float, top: float
) -> tuple[list[list[float]], ListedByInequalities]:
    """Listing of Liang-Barsky on one segment: the ends that are left (none: nothing is), and the numbers."""
    dx, dy = x1 - x0, y1 - y0
    edges = [(-dx, x0 - left), (dx, right - x0), (-dy, y0 - bottom), (dy, top - y0)]
    t_enter, t_leave, entry, exit = 0.0, 1.0, -1, -1
    seen: ListedByInequalities = []
    for k, (p, q) in enumerate(edges):  #: edges
        t = nan
        if p == 0:
            if q < 0:  #: parallel
                return [], [*seen, (p, q, t, t_enter, t_leave)]  #: outside
        else:
            t = q / p  #: t
            if p < 0 and t > t_enter:  #: entry
                t_enter, entry = t, k  #: enter
            if p > 0 and t < t_leave:  #: exit
                t_leave, exit = t, k  #: leave
        seen.append((p, q, t, t_enter, t_leave))
        if t_enter > t_leave:
            return [], seen  #: empty
    ends = [[x0, y0], [x1, y1]]  #: uncut
    for end, (t, k) in enumerate([(t_enter, entry), (t_leave, exit)]):
        if k >= 0:
            ends[end] = [x0 + t * dx, y0 + t * dy]  #: ends
            ends[end][k // 2] = [left, right, bottom, top][k]
    return ends, seen


@method(
    "line_clipping",
    "liang-barsky",
    "Liang-Barsky",
    source="Liang and Barsky 1984; LMU 2020, Liang-Barsky Algorithm",
    exact_for="segments entirely inside or outside; otherwise new ends are within 4 ulp of the largest "
    "coordinate",
    breaks_where="segments that pass a corner within rounding. A clipped Bresenham line starts at another pixel "
    "and may choose other pixels",
    needs=("rectangle",),
    listing=liang_barsky_listing,
)
def liang_barsky(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Clip segments (L, 2, 2) by p, q and t; one that would leave before it enters is given up at once.

    Notes
    -----
    The coordinate of the edge that cuts is taken from the edge, not from P(t): the new end lies on it exactly.
    """
    need_rectangle(window, "liang-barsky")
    left, bottom, right, top = window.borders
    (x0, y0), (x1, y1) = segments[:, 0].T, segments[:, 1].T
    dx, dy = x1 - x0, y1 - y0
    p = np.stack([-dx, dx, -dy, dy])
    q = np.stack([x0 - left, right - x0, y0 - bottom, top - y0])
    walk = walk_edges(p, q, stops_early=True)
    return clipped_lines(segments, window, walk, on_borders(points_at(segments, walk), walk.cut_by, window))


def on_borders(ends: Floats, cut_by: np.ndarray, window: ClipWindow) -> Floats:
    """Return ends (L, 2, 2) with the coordinate of the edge that cut each, ``cut_by`` (L, 2), set to that edge's."""
    axis = np.array([0, 0, 1, 1, -1])[cut_by]
    border = np.array([*window.points[[0, 1], 0], *window.points[[2, 3], 1], np.nan])[cut_by]
    return np.where(axis[..., None] == np.arange(2), border[..., None], ends)
