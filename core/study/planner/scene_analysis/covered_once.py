"""Whether every sample is covered by one triangle at most, so that no two of them can hide each other.

Triangles that all turn the same way in the window, on their snapped corners, cover a point as often as their outline
winds around it: the edges that they share cancel, and what is left are closed loops. A level line that crosses the
loops once upwards and once downwards has points that are wound around once between the two, and none elsewhere. So it
is enough to count, for every height, how many edges of the outline are there: two at most. The same holds of columns.

Nothing of this is rounded: the corners are whole numbers of 1/256 of a sample, and covers are decided on them.

The fronts of a closed convex mesh are such: its outline in the window is a convex polygon, and snapping keeps the order
of heights. So are many other meshes from many sides; what is not sure counts as covered more than once.

References
----------
K. Weiler, *Polygon comparison using a graph representation*, 1980 (winding numbers of polygons).
"""

import numpy as np

from core.raster.edges.snapping import snap
from core.records.arrays import Floats, Integers
from core.study.planner.scene_analysis.conservative_coverage import Touched, is_cut

MOST_CROSSINGS = 2
"""Edges of the outline at one height: one up, one down."""


def is_covered_once(touched: Touched, culls_backs: bool, scale: int) -> bool:
    """Tell whether it is sure that no sample is covered by two triangles.

    Parameters
    ----------
    touched : Touched
    culls_backs : bool
        Whether only fronts are drawn.
    scale : int
        Corners are snapped to 1/256 of a pixel over this.

    Notes
    -----
    Of triangles that are cut at the view volume nothing is sure.
    """
    if is_cut(touched).any():
        return False
    corners, is_projected = snap(touched.geometry.corners.window * scale)
    if not is_projected.all():
        return False
    x, y = corners[..., 0].T, corners[..., 1].T
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    if not culls_backs and (area > 0).any() and (area < 0).any():
        return False
    # One without area winds around nothing, but its edges close the gaps that it would leave in the outline.
    kept = area >= 0 if culls_backs else slice(None)
    vertex = touched.vertex[kept]
    place = np.zeros((int(vertex.max(initial=0)) + 1, 2))
    place[vertex.reshape(-1)] = corners[kept].reshape(-1, 2)
    start, end = outline(vertex)
    return any(_most_crossings(place[start, axis], place[end, axis]) <= MOST_CROSSINGS for axis in (1, 0))


def outline(vertex: Integers) -> tuple[Integers, Integers]:
    """Return start and end (B,) of the edges of triangles (T, 3) that no other goes along the other way.

    An edge that is gone along twice in the same way is there twice.
    """
    start, end = vertex.reshape(-1), np.roll(vertex, -1, axis=1).reshape(-1)
    count = np.int64(vertex.max(initial=0)) + 1
    low, high = np.minimum(start, end), np.maximum(start, end)
    key, number = np.unique(low * count + high, return_inverse=True)
    balance = np.bincount(number, np.where(start < end, 1, -1), len(key)).astype(np.int64)
    low, high = np.divmod(key, count)
    start, end = np.where(balance > 0, low, high), np.where(balance > 0, high, low)
    return np.repeat(start, np.abs(balance)), np.repeat(end, np.abs(balance))


def _most_crossings(start: Floats, end: Floats) -> int:
    """Return how many edges from heights ``start`` (B,) to ``end`` are at one height at most."""
    heights = np.concatenate([np.minimum(start, end), np.maximum(start, end)])
    step = np.repeat([1, -1], len(start))
    # Where one ends and another begins at one height, the one ends first; level edges are nowhere.
    order = np.lexsort((step, heights))
    return int(np.cumsum(step[order]).max(initial=0))
