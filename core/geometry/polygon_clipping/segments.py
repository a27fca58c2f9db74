"""Segments clipped in clip space, plane by plane: the case of each plane is that of an edge of a polygon.

References
----------
F. Pellacini, *Computer Graphics*, "line clipping": segment-plane clipping, against each plane in turn. What lies wholly
outside of one plane is culled before: the early rejection of common cases.
"""

import numpy as np

from core.geometry.polygon_clipping.sutherland_hodgman import (
    IN_OUT,
    OUT_IN,
    OUT_OUT,
    Clipped,
    ClipRows,
    distance_from,
    join_rows,
    new_corners,
)
from core.records.arrays import Floats, Integers
from core.records.primitives import Primitives


def clip_segments(primitives: Primitives, distances: Floats, planes: tuple[int, ...]) -> Clipped:
    """Clip segments that a plane crosses, and drop those of which nothing is left.

    Parameters
    ----------
    primitives : Primitives
        Segments or points: corners 0 and 1 are the ends, corner 2 is corner 1 once more.
    distances : (P, 3, 6) float64, see ``core.geometry.culling.plane_distances``
    planes : indices of ``core.geometry.culling.PLANES``
    """
    clipped = np.flatnonzero(np.any(distances[:, :, list(planes)] < 0, axis=(1, 2)))
    ends = np.concatenate([primitives.clip[clipped], primitives.varyings[clipped]], axis=2)[:, :2]
    is_left = np.ones(len(clipped), bool)
    lines, counts, rows = [ends], [np.full(len(clipped), 2)], []
    for plane in planes:
        ends, row = clip_ends(ends, np.flatnonzero(is_left), plane)
        is_left[row.polygon[row.case == OUT_OUT]] = False
        lines.append(ends)
        counts.append(np.where(is_left, 2, 0))
        rows.append(row)

    keeps = np.ones(len(primitives), bool)
    keeps[clipped[~is_left]] = False
    result = primitives.take(np.flatnonzero(keeps))
    at = (np.cumsum(keeps) - 1)[clipped[is_left]]
    corners = ends[is_left][:, [0, 1, 1]]
    result.clip[at], result.varyings[at] = corners[..., :4], corners[..., 4:]
    return Clipped(result, clipped, planes, join_rows(rows, ends.shape[2]), tuple(lines), tuple(counts))


def clip_ends(ends: Floats, index: Integers, plane: int) -> tuple[Floats, ClipRows]:
    """Clip the segments ``index`` (S,) of Q ends (Q, 2, 4 + K) against one plane, new ends from the inside end."""
    start, end = ends[index, 0], ends[index, 1]
    start_distance, end_distance = distance_from(start, plane), distance_from(end, plane)
    case = 2 * (start_distance >= 0) + (end_distance >= 0)
    leaves, enters = case == IN_OUT, case == OUT_IN
    t, corner = new_corners(start, end, start_distance, end_distance, leaves | enters, leaves)
    result = ends.copy()
    result[index[enters], 0], result[index[leaves], 1] = corner[enters], corner[leaves]
    rows = ClipRows(
        polygon=index,
        plane=np.full(len(index), plane),
        edge=np.zeros(len(index), np.int64),
        case=case,
        start=start,
        end=end,
        start_distance=start_distance,
        end_distance=end_distance,
        t=t,
        corner=corner,
    )
    return result, rows
