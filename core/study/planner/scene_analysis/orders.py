"""Whether the order in which triangles hide each other is beyond doubt, pixel by pixel.

Two triangles cannot hide each other where they do not overlap in the window: an edge of one has the other wholly on its
far side, decided exactly on the corners as they are snapped (a shared edge has both on its line, and its pixels are
drawn once). Where they overlap, their ranges of depth in the pixel must be apart.

References
----------
S. Gottschalk, M. Lin, D. Manocha, *OBBTree*, 1996 (the separating axis theorem; here in the plane).
"""

import numpy as np

from core.raster.edges.snapping import snap
from core.records.arrays import Flags, Floats, Integers
from core.study.planner.scene_analysis.conservative_coverage import MARGIN, Touched

MOST_LAYERS = 64
"""A pixel touched by more triangles than this is not looked into."""


def doubtful_pixels(
    touched: Touched, chosen: Flags, margin: float, side: int, rank: Integers | None = None
) -> Integers:
    """Return (D,) int64, the pixels where the order of some two of the ``chosen`` (Q,) pairs is in doubt.

    Parameters
    ----------
    touched : Touched
    chosen : (Q,) bool
    margin : float
        Depths closer than this are in doubt.
    side : int
        Samples on a side of a pixel: corners are snapped to 1/256 of a sample's square.
    rank : (P,) int64, optional
        Place of each primitive in the order of drawing: then not the order of depth must be beyond doubt but that the
        later one is the nearer.
    """
    index = np.flatnonzero(chosen & touched.is_drawn)
    if not len(index):
        return np.empty(0, np.int64)
    pixel = touched.pixel[index]
    starts = np.flatnonzero(np.diff(pixel, prepend=-1))
    layers = np.diff(np.append(starts, len(index)))
    doubtful = [pixel[starts[layers > MOST_LAYERS]]]
    for step in range(1, min(int(layers.max()), MOST_LAYERS)):
        first = np.flatnonzero(pixel[step:] == pixel[:-step])
        one, other = index[first], index[first + step]
        is_open = ~_is_ordered(touched, one, other, margin, rank)
        one, other = one[is_open], other[is_open]
        overlapping = overlap(touched, touched.primitive[one], touched.primitive[other], side)
        doubtful.append(touched.pixel[one[overlapping]])
    return np.unique(np.concatenate(doubtful))


def _is_ordered(
    touched: Touched, one: Integers, other: Integers, margin: float, rank: Integers | None
) -> Flags:
    least, most = depth_between(touched, one, other)
    one_nearer, other_nearer = least > margin, most < -margin
    if rank is None:
        return np.asarray(one_nearer | other_nearer)
    is_later = rank[touched.primitive[one]] > rank[touched.primitive[other]]
    return np.where(is_later, one_nearer, other_nearer)


def depth_between(touched: Touched, one: Integers, other: Integers) -> tuple[Floats, Floats]:
    """Return how much farther the pairs ``other`` (D,) are than ``one`` (D,), at least and at most in the square.

    Notes
    -----
    The difference of two planes is a plane, far less steep than either where they are nearly parallel. Depth that is
    limited to that of the corners differs from its plane by a hair, so the ranges are looked at as well.
    """
    a, b, c = (part[touched.primitive[other]] - part[touched.primitive[one]] for part in touched.depth_plane)
    middle, reach = a * touched.x[one] + b * touched.y[one] + c, (np.abs(a) + np.abs(b)) * (0.5 + MARGIN)
    least = np.fmax(middle - reach, touched.near[other] - touched.far[one])
    most = np.fmin(middle + reach, touched.far[other] - touched.near[one])
    return np.nan_to_num(least, nan=-np.inf), np.nan_to_num(most, nan=np.inf)


def overlap(touched: Touched, one: Integers, other: Integers, side: int) -> Flags:
    """Return (D,) bool: the insides of two primitives (D,) each may have a sample in common."""
    if not len(one):
        return np.empty(0, bool)
    count = np.int64(len(touched.geometry.primitives))
    pairs, place = np.unique(one * count + other, return_inverse=True)
    window = snap(touched.geometry.corners.window * side)[0]
    first, second = window[pairs // count], window[pairs % count]
    apart = np.zeros(len(pairs), bool)
    for edges, others in ((first, second), (second, first)):
        for corner in range(3):
            apart |= _is_beyond(edges, others, corner)
    return np.asarray(~apart[place.reshape(-1)])


def _is_beyond(edges: Floats, others: Floats, corner: int) -> Flags:
    """Return (D,) bool: an edge of ``edges`` (D, 3, 2) has its own triangle on one side and ``others`` on the other."""
    start, end, opposite = (edges[:, (corner + k) % 3] for k in range(3))
    way = end - start

    def side_of(point: Floats) -> Floats:
        return np.asarray(way[:, 0] * (point[:, 1] - start[:, 1]) - way[:, 1] * (point[:, 0] - start[:, 0]))

    own = side_of(opposite)
    rest = np.stack([side_of(others[:, k]) for k in range(3)])
    left, right = (own >= 0) & (rest <= 0).all(axis=0), (own <= 0) & (rest >= 0).all(axis=0)
    return np.asarray(left | right)
