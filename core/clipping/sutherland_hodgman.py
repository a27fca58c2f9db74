"""Polygon clipping in clip space, plane by plane, with all attributes.

Notes
-----
A new corner is computed from the inside end to the outside end, so that the two triangles of an
edge get the same corner; `clip_edge_in_order` does without. Positions and attributes are linear in clip space:
one t serves both.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
F. Pellacini, *Computer Graphics*, "polygon clipping".
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import Primitives

OUT_OUT, OUT_IN, IN_OUT, IN_IN = range(4)
CASES = ("out-out", "out-in", "in-out", "in-in")
ALL_PLANES = (0, 1, 2, 3, 4, 5)
DEPTH_PLANES = (0, 1)
"""Near and far: between them every corner has w >= 0 and can be projected."""


@dataclass(frozen=True, eq=False)
class ClipRows:
    """R edges of polygons against planes, in the order they are looked at."""

    polygon: Integers
    """(R,) int64, index among the clipped primitives."""
    plane: Integers
    """(R,) int64, index of ``core.culling.culling.PLANES``."""
    edge: Integers
    """(R,) int64, number of the edge in the polygon as it came to this plane."""
    case: Integers
    """(R,) int64, index of ``CASES``."""
    start: Floats
    """(R, 4 + K) float64, clip position and varyings of the edge's start."""
    end: Floats
    """(R, 4 + K)."""
    start_distance: Floats
    """(R,) float64, signed distance from the plane; inside is 0 or more."""
    end_distance: Floats
    t: Floats
    """(R,) float64, where the new corner lies, from the inside end (0) to the outside end (1), or, where new corners
    are computed in the polygon's order, from the start to the end; NaN: there is none."""
    corner: Floats
    """(R, 4 + K), the new corner; NaN where there is none."""


@dataclass(frozen=True, eq=False)
class Clipped:
    """Result of clipping Q primitives, those that a plane crosses."""

    primitives: Primitives
    """All primitives afterwards: the untouched ones and the pieces, in drawing order."""
    clipped: Integers
    """(Q,) int64, which of the incoming primitives were clipped."""
    planes: tuple[int, ...]
    rows: ClipRows
    polygons: tuple[Floats, ...]
    """Polygons before the first and after each plane: (Q, M, 4 + K) float64."""
    counts: tuple[Integers, ...]
    """Corners of each of those polygons: (Q,) int64."""
    is_divided: bool = False
    """Polygons and rows hold (x/w, y/w, z/w, 1), not clip positions, and three rows of the division come first."""


def clip_primitives(
    primitives: Primitives, distances: Floats, planes: tuple[int, ...], is_canonical: bool = True
) -> Clipped:
    """Clip what crosses a plane and cut the polygons into fans.

    Parameters
    ----------
    distances : (P, 3, 6) float64, see ``core.culling.culling.plane_distances``
    planes : indices of ``core.culling.culling.PLANES``
    is_canonical : bool
        Whether a new corner is computed from the inside end, whichever way the edge is gone along.
    """
    crossing = np.any(distances[:, :, list(planes)] < 0, axis=(1, 2))
    clipped = np.flatnonzero(crossing)
    polygon = np.concatenate([primitives.clip[clipped], primitives.varyings[clipped]], axis=2)
    count = np.full(len(clipped), 3)
    return clip_chosen(primitives, clipped, polygon, count, planes, is_canonical, _split_corners)


def clip_chosen(
    primitives: Primitives,
    clipped: Integers,
    polygon: Floats,
    count: Integers,
    planes: tuple[int, ...],
    is_canonical: bool,
    split: Callable[[Floats], tuple[Floats, Floats]],
) -> Clipped:
    """Clip polygons that stand for some primitives and put the pieces in their places.

    Parameters
    ----------
    clipped : (Q,) int64
        The primitives that the polygons stand for, ascending.
    polygon : (Q, 3, 4 + K) float64
        Position and values of the corners.
    count : (Q,) int64
        Corners of each polygon: 3, or 0 for one that is left out.
    planes, is_canonical
        See `clip_primitives`.
    split : callable
        Turns corners (C, 3, 4 + K) of pieces into clip positions (C, 3, 4) and varyings.
    """
    polygons, counts, rows = [polygon], [count], []
    for plane in planes:
        polygon, count, plane_rows = clip_polygons(polygon, count, plane, is_canonical)
        polygons.append(polygon)
        counts.append(count)
        rows.append(plane_rows)

    # Fans (0, k, k + 1), each piece in its triangle's place.
    crossing = np.zeros(len(primitives), bool)
    crossing[clipped] = True
    piece_count = np.where(crossing, 0, 1)
    piece_count[clipped] = np.maximum(count - 2, 0)
    source = np.repeat(np.arange(len(primitives)), piece_count)
    place = np.arange(len(source)) - np.repeat(np.cumsum(piece_count) - piece_count, piece_count)
    result = primitives.take(source)
    of_clipped = np.flatnonzero(crossing[source])
    if len(of_clipped):
        at = np.searchsorted(clipped, source[of_clipped])
        k = place[of_clipped]
        corners = np.stack([polygon[at, 0], polygon[at, k + 1], polygon[at, k + 2]], axis=1)
        result.clip[of_clipped], result.varyings[of_clipped] = split(corners)
    return Clipped(result, clipped, planes, join_rows(rows, polygon.shape[2]), tuple(polygons), tuple(counts))


def _split_corners(corners: Floats) -> tuple[Floats, Floats]:
    """Return the clip position and the values of corners (C, 3, 4 + K)."""
    return corners[..., :4], corners[..., 4:]


def clip_polygons(
    polygon: Floats, count: Integers, plane: int, is_canonical: bool = True
) -> tuple[Floats, Integers, ClipRows]:
    """Clip Q polygons (Q, M, 4 + K) with ``count`` (Q,) corners against one plane.

    With ``is_canonical`` new corners are computed from the inside end to the outside end, else as the edge is gone
    along.

    Returns
    -------
    polygon : (Q, M + 1, 4 + K) float64
        Wider where distances that were rounded (coordinates of very different sizes) cross the plane more than twice.
    count : (Q,) int64
    rows : ClipRows
    """
    total, corners, _ = polygon.shape
    place = np.arange(corners)
    exists = place < count[:, None]
    following = np.where(place + 1 < count[:, None], place + 1, 0)
    distance = distance_from(polygon, plane)
    end_distance = np.take_along_axis(distance, following, axis=1)
    end = np.take_along_axis(polygon, following[..., None], axis=1)
    case = np.where(exists, 2 * (distance >= 0) + (end_distance >= 0), OUT_OUT)

    # The new corner, from the inside end to the outside end, or in the polygon's order.
    crosses = (case == OUT_IN) | (case == IN_OUT)
    leaving = (case == IN_OUT) | (not is_canonical)
    t, corner = new_corners(polygon, end, distance, end_distance, crosses, leaving)

    # Emit the new corner where the edge crosses, then the edge's end where that is inside.
    keeps_end = (case == OUT_IN) | (case == IN_IN)
    emitted = crosses.astype(np.int64) + keeps_end
    position = np.cumsum(emitted, axis=1) - emitted
    kept_count = emitted.sum(axis=1)
    result = np.zeros((total, max(corners + 1, kept_count.max(initial=0)), polygon.shape[2]))
    which, edge = np.nonzero(crosses)
    result[which, position[which, edge]] = corner[which, edge]
    which, edge = np.nonzero(keeps_end)
    result[which, position[which, edge] + crosses[which, edge]] = end[which, edge]
    which, edge = np.nonzero(exists)
    at = (which, edge)
    rows = ClipRows(
        which,
        np.full(len(which), plane),
        edge,
        case[at],
        polygon[at],
        end[at],
        distance[at],
        end_distance[at],
        t[at],
        corner[at],
    )
    return result, kept_count, rows


def new_corners(
    start: Floats, end: Floats, start_distance: Floats, end_distance: Floats, crosses: Flags, leaving: Flags
) -> tuple[Floats, Floats]:
    """Return t (...) and the new corners (..., 4 + K) of edges that cross a plane, NaN where they do not.

    They are computed from the start where ``leaving`` (...), else from the end.
    """
    d_in, d_out = np.where(leaving, (start_distance, end_distance), (end_distance, start_distance))
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(crosses, d_in / (d_in - d_out), np.nan)
    inner, outer = np.where(leaving[..., None], (start, end), (end, start))
    return t, inner + t[..., None] * (outer - inner)


def distance_from(position: Floats, plane: int) -> Floats:
    """Return the signed distance of clip positions (..., 4 or more) from one plane: w plus or minus a coordinate."""
    coordinate = (2, 2, 0, 0, 1, 1)[plane]
    sign = 1.0 if plane % 2 == 0 else -1.0
    return np.asarray(position[..., 3] + sign * position[..., coordinate])


def join_rows(parts: list[ClipRows], width: int) -> ClipRows:
    """Put the rows of all planes in order: polygon by polygon, plane by plane."""
    if not parts:
        none, empty = np.empty(0, np.int64), np.empty(0)
        wide = np.empty((0, width))
        return ClipRows(none, none, none, none, wide, wide, empty, empty, empty, wide)
    columns = {name: np.concatenate([getattr(part, name) for part in parts]) for name in vars(parts[0])}
    order = np.argsort(columns["polygon"], kind="stable")
    return ClipRows(**{name: values[order] for name, values in columns.items()})


def clip_edge(start: Floats, end: Floats, d_start: float, d_end: float) -> list[Floats]:
    """Listing of one edge against one plane: the corners it outputs."""
    if d_start >= 0 and d_end >= 0:  #: in-in
        return [end]  #: keep
    if d_start >= 0:
        t = d_start / (d_start - d_end)  #: t-out
        return [start + t * (end - start)]  #: leave
    if d_end >= 0:
        t = d_end / (d_end - d_start)  #: t-in
        return [end + t * (start - end), end]  #: enter
    return []  #: out-out


def clip_edge_in_order(start: Floats, end: Floats, d_start: float, d_end: float) -> list[Floats]:
    """Listing of one edge against one plane, new corners always computed from its start."""
    if d_start >= 0 and d_end >= 0:  #: in-in
        return [end]  #: keep
    if d_start < 0 and d_end < 0:
        return []  #: out-out
    t = d_start / (d_start - d_end)  #: t
    corner = start + t * (end - start)  #: corner
    return [corner] if d_end < 0 else [corner, end]
