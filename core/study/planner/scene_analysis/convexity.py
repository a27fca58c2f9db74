"""Whether a mesh is convex: a proof, not a look at some of its points.

A closed mesh whose faces all have one point on their inner side, whose edges all bend inwards, and of whose faces a ray
from that point goes through one only, is the surface of a convex solid: seen from the point it covers every direction
equally often, once, so it does not wind or pass through itself, and bent inwards at every edge it is convex. Edges and
Euler's formula alone are not enough: the great icosahedron has 12 - 30 + 20 = 2 and only inward edges, and its rays
go through seven faces.

References
----------
K. Mehlhorn, S. Naeher, M. Seel, R. Seidel, T. Schilz, S. Schirra, C. Uhrig, *Checking geometric programs or
verification of geometric structures*, 1996.
"""

import numpy as np

from core.records.arrays import Floats, Integers
from core.stages.closed_meshes import welded

HAIR = 1e-6
"""Part of a mesh's size that a vertex may stand out: rounded coordinates are never quite convex."""


def is_convex(positions: Floats, triangles: Integers) -> bool:
    """Tell whether a mesh is the surface of a convex solid, wound so that its faces look outwards.

    Parameters
    ----------
    positions : (N, 3) float64
    triangles : (T, 3) int64

    Notes
    -----
    Up to `HAIR` of its size; triangles without area count for nothing.
    """
    vertex = welded(positions, triangles)
    corner = positions[triangles]
    middle = corner.reshape(-1, 3).mean(axis=0) if len(corner) else np.zeros(3)
    corner = corner - middle
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    length = np.sqrt((normal * normal).sum(axis=1))
    size = np.abs(corner).max(initial=0.0)
    has_area = length > 0
    if np.count_nonzero(has_area) < 4:
        return False
    vertex, corner = vertex[has_area], corner[has_area]
    normal = normal[has_area] / length[has_area][:, None]
    height = (normal * corner[:, 0]).sum(axis=1)
    if not (height > HAIR * size).all():
        return False
    faces = _neighbours(vertex)
    if faces is None:
        return False
    first, second = faces
    rise = (normal[first][:, None] * corner[second]).sum(axis=2) - height[first][:, None]
    return bool((rise <= HAIR * size).all()) and _faces_on_ray(corner) == 1


def _edge_key(start: Integers, end: Integers) -> Integers:
    """Return a number (E,) int64 for every edge between two vertices, whichever way it goes."""
    count = np.int64(max(start.max(initial=0), end.max(initial=0))) + 1
    return np.asarray(np.minimum(start, end) * count + np.maximum(start, end))


def _neighbours(vertex: Integers) -> tuple[Integers, Integers] | None:
    """Return the two faces (E,) of every edge; ``None``: an edge has not just two, one each way."""
    start, end = vertex.reshape(-1), np.roll(vertex, -1, axis=1).reshape(-1)
    order = np.lexsort((start < end, _edge_key(start, end)))
    if len(order) % 2:
        return None
    one, other = order[::2], order[1::2]
    if (start[one] != end[other]).any() or (end[one] != start[other]).any() or (start == end).any():
        return None
    if (np.diff(_edge_key(start, end)[one]) == 0).any():
        return None
    return one // 3, other // 3


def _faces_on_ray(corner: Floats) -> int:
    """Return how many faces (T, 3, 3) the ray from 0 through the middle of the first may meet; in doubt it does."""
    way = corner[0].mean(axis=0)
    volumes = np.stack([(np.cross(corner[:, k], corner[:, (k + 1) % 3]) * way).sum(axis=1) for k in range(3)])
    doubt = 1e-12 * np.abs(corner).max() ** 2 * np.abs(way).max()
    return int(np.count_nonzero((volumes >= -doubt).all(axis=0)))
