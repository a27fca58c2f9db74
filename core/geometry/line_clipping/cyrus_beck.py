"""Cyrus-Beck: a segment against any convex window by the outward normals of its edges.

Where D = P1 - P0 runs against the outward normal N the line potentially enters (PE), where it runs with it the line
potentially leaves (PL), both at t = N . (P0 - P_E) / (-N . D). The segment is inside from the largest t of an entry to
the least of an exit.

The lecture prints "if N . D is not 0 {ignore edges parallel to line}" and stops there, so a segment that is parallel to
an edge and outside it is kept. ``cyrus-beck`` looks at its side; ``cyrus-beck-lecture`` is as printed.

References
----------
M. Cyrus, J. Beck, *Generalized two- and three-dimensional clipping*, 1978.
M. I. Jubair, *Computer Graphics*, "Cyrus-Beck Parametric Line Clipping Algorithm".
"""

from collections.abc import Sequence
from math import nan

from core.geometry.line_clipping.edge_walk import clipped_lines, points_at, walk_edges
from core.geometry.line_clipping.records import ClippedLines, ClipWindow
from core.methods import method
from core.records.arrays import Flags, Floats

Listed = list[tuple[float, float, float, float, float]]
"""N . D, -N . (P0 - P_E), t, t_E and t_L of every edge looked at, from a listing."""


def cyrus_beck_listing(
    p0: Sequence[float], p1: Sequence[float], normals: Floats, points: Floats, ignores_parallel: bool
) -> tuple[list[Sequence[float]], Listed]:
    """Listing of Cyrus-Beck on one segment: the ends that are left (none: nothing is), and the numbers.

    With ``ignores_parallel`` as printed.
    """
    d = p1[0] - p0[0], p1[1] - p0[1]
    is_point = d[0] == 0 and d[1] == 0
    t_e, t_l, entry, exit = 0.0, 1.0, -1, -1
    seen: Listed = []
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
