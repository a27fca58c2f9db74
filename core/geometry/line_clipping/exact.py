"""Line clipping in whole numbers: every decision is the sign of an exact integer, every new end is correctly rounded.

A float64 is a whole number times a power of two, so the coordinates of all segments are whole numbers of one small
unit. Then N . D and N . (P0 - P_E) are whole numbers too, and two crossings a/b and c/d are compared by a d and c b.
The new end is one quotient of whole numbers, which Python rounds correctly. Segments inside the window, or
outside one edge of a rectangle, are decided by comparing coordinates, which is exact as it is.

References
----------
M. Cyrus, J. Beck, *Generalized two- and three-dimensional clipping*, 1978.
C. Yap, *Towards exact geometric computation*, 1997 (decisions by exact signs).
"""

import math
from fractions import Fraction
from typing import Any

import numpy as np

from core.geometry.line_clipping.edge_walk import EdgeWalk, rows_of_walk
from core.geometry.line_clipping.records import ENTER, LEAVE, OUTSIDE, PARALLEL, ClippedLines, ClipWindow
from core.methods import method
from core.records.arrays import Flags, Floats

Wholes = np.ndarray[Any, Any]
"""Arrays of Python's whole numbers, of any size."""
Listed = list[tuple[float, ...]]
"""N . D, -N . (P0 - P_E), t, t_E and t_L of every edge looked at, rounded, from a listing."""


def exact_listing(
    p0: list[float], p1: list[float], normals: list[list[Fraction]], points: list[list[float]]
) -> tuple[list[list[float]], Listed]:
    """Listing of exact clipping on one segment: the ends that are left (none: nothing is), and the numbers."""
    x, y, x1, y1 = (Fraction(value) for value in (*p0, *p1))
    dx, dy = x1 - x, y1 - y
    t_e, t_l, entry, exit = Fraction(0), Fraction(1), -1, -1
    seen: Listed = []
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
