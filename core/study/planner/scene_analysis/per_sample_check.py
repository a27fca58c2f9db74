"""A closer look where pixels leave a doubt: every sample of everything on, in these pixels only.

At the outline of a closed mesh its fronts and backs meet, and no bound over a whole pixel can tell them apart. There
coverage is decided on the snapped corners and depth is computed, sample by sample; a few hundred pixels as a rule.
"""

from collections.abc import Iterator

import numpy as np

from core.raster.edges.snapping import snap
from core.records.arrays import Flags, Floats, Integers
from core.study.planner.scene_analysis.conservative_coverage import Touched
from core.study.planner.scene_analysis.sample_patterns import Pattern


def doubtful_backs(touched: Touched, pixels: Integers, margin: float, pattern: Pattern) -> Integers:
    """Return (D,) int64, those of the ``pixels`` in which a back face may be the nearest at a sample.

    Parameters
    ----------
    touched : Touched
    pixels : (N,) int64
    margin : float
        A front must be nearer by more than this window depth.
    pattern : Pattern
        The samples.
    """
    pairs, starts = pairs_of(touched, pixels)
    if not len(pairs):
        return np.empty(0, np.int64)
    is_back = touched.facing.take(touched.primitive[pairs]) < 0
    found = np.zeros(len(starts), bool)
    for is_sure, may_be, depth in sample_pairs(touched, pairs, pattern):
        front = _least(np.where(is_sure & ~is_back, depth, np.inf), starts)
        back = _least(np.where(may_be & is_back, depth, np.inf), starts)
        found |= (back < np.inf) & ~(front + margin < back)
    return touched.pixel[pairs][starts][found]


def doubtful_depths(
    touched: Touched, pixels: Integers, is_drawn: Flags, margin: float, pattern: Pattern
) -> Integers:
    """Return those of the ``pixels`` in which the two nearest of a sample are no more than ``margin`` apart.

    Only the pairs ``is_drawn`` (Q,) count.
    """
    pairs, starts = pairs_of(touched, pixels, is_drawn)
    if not len(pairs):
        return np.empty(0, np.int64)
    found = np.zeros(len(starts), bool)
    for is_sure, may_be, depth in sample_pairs(touched, pairs, pattern):
        nearest = _least(np.where(is_sure, depth, np.inf), starts)
        within = may_be & (depth <= np.repeat(nearest, np.diff(np.append(starts, len(pairs)))) + margin)
        # Without one that surely covers the sample, any two that may are a doubt.
        found |= np.add.reduceat(within.astype(np.int64), starts) > 1
    return touched.pixel[pairs][starts][found]


def pairs_of(touched: Touched, pixels: Integers, is_drawn: Flags | None = None) -> tuple[Integers, Integers]:
    """Return the pairs (R,) of the pixels (N,), and where those of each pixel begin (M,)."""
    wanted = np.zeros(touched.pixel_count, bool)
    wanted[pixels] = True
    chosen = wanted[touched.pixel] & touched.is_drawn
    if is_drawn is not None:
        chosen &= is_drawn
    pairs = np.flatnonzero(chosen)
    starts = np.flatnonzero(np.diff(touched.pixel[pairs], prepend=-1))
    return pairs, starts


def _least(values: Floats, starts: Integers) -> Floats:
    return np.asarray(np.minimum.reduceat(values, starts))


def sample_pairs(
    touched: Touched, pairs: Integers, pattern: Pattern
) -> Iterator[tuple[Flags, Flags, Floats]]:
    """Yield for every sample which pairs (R,) cover it surely, which may, and their depth (R,).

    Notes
    -----
    A centre on an edge belongs to the triangle that a point a hair to the right, then up, is in; all of that is exact.
    What is not sure is a triangle that snapping turns over: it is drawn as the other side, so it may be anything.
    """
    primitive = touched.primitive[pairs]
    corners = snap(touched.geometry.corners.window[primitive] * pattern.scale)[0]
    x, y = corners[..., 0].T, corners[..., 1].T
    sign = np.where(touched.facing[primitive] < 0, -1.0, 1.0)
    area = ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) * sign
    a, b, c = (part[primitive] for part in touched.depth_plane)
    least, most = (choose(touched.geometry.depth[:, primitive], axis=0) for choose in (np.min, np.max))
    left, bottom = touched.x[pairs] - 0.5, touched.y[pairs] - 0.5
    edges = []
    for k in range(3):
        across, along = (y[k] - y[k - 2]) * sign, (x[k - 2] - x[k]) * sign
        edges.append((x[k], y[k], across, along, (across > 0) | ((across == 0) & (along > 0))))
    for right, up in pattern.positions * pattern.scale:
        at_x, at_y = pattern.scale * left + right, pattern.scale * bottom + up
        is_sure = area > 0
        for start_x, start_y, across, along, has_ties in edges:
            inner = across * (at_x - start_x) + along * (at_y - start_y)
            is_sure &= (inner > 0) | ((inner == 0) & has_ties)
        may_be = is_sure | ~(area > 0)
        depth = a * (at_x / pattern.scale) + (b * (at_y / pattern.scale) + c)
        yield is_sure, may_be, np.clip(depth, least, most)
