"""Liang-Barsky: a segment against a rectangle by four inequalities t p <= q.

For the edges left, right, bottom and top p is how fast the segment runs outward and q how much room its first end
has. p < 0: it comes in through the edge's line at t = q/p; p > 0: it goes out there; p = 0: it runs along the edge, and
lies outside if q < 0. What is left runs from the last entry to the first exit.

References
----------
Y.-D. Liang, B. Barsky, *A new concept and method for line clipping*, 1984.
LMU, *Computer Graphics 1*, tutorial 5, "Liang-Barsky Algorithm".
"""

from math import nan

import numpy as np

from core.geometry.line_clipping.edge_walk import clipped_lines, points_at, walk_edges
from core.geometry.line_clipping.records import ClippedLines, ClipWindow, need_rectangle
from core.methods import method
from core.records.arrays import Floats

Listed = list[tuple[float, float, float, float, float]]
"""p, q, t, t_enter and t_leave of every edge looked at, from a listing."""


def liang_barsky_listing(
    x0: float, y0: float, x1: float, y1: float, left: float, bottom: float, right: float, top: float
) -> tuple[list[list[float]], Listed]:
    """Listing of Liang-Barsky on one segment: the ends that are left (none: nothing is), and the numbers."""
    dx, dy = x1 - x0, y1 - y0
    edges = [(-dx, x0 - left), (dx, right - x0), (-dy, y0 - bottom), (dy, top - y0)]
    t_enter, t_leave, entry, exit = 0.0, 1.0, -1, -1
    seen: Listed = []
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
