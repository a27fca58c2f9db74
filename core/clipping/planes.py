"""The methods of the family ``clipping``: which planes, before or after the division, and what they leave of segments.

A corner with w < 0 is divided like any other: x/w and y/w have the wrong sign, so it comes out mirrored through the
eye, and the edge to it runs the other way around. With w = 0 there is no quotient: the triangle is left out. All
numbers are linear in NDC once they are divided by w, so 1/|w| and the values over |w| go along and are divided again
afterwards: while all w > 0 the result is right.

References
----------
J. Blinn, M. Newell, *Clipping using homogeneous coordinates*, 1978.

References
----------
F. Pellacini, *Computer Graphics*, "line clipping": segment-plane clipping, against each plane in turn. What lies wholly
outside of one plane is culled before: the early rejection of common cases.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from core.clipping.sutherland_hodgman import (
    ALL_PLANES,
    DEPTH_PLANES,
    IN_OUT,
    OUT_IN,
    OUT_OUT,
    Clipped,
    ClipRows,
    clip_chosen,
    clip_primitives,
    distance_from,
    join_rows,
    new_corners,
)
from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import Primitives

# Clipping after the division by w, as a naive program does: the sign of w is lost before anything is cut.


def clip_divided(primitives: Primitives, distances: Floats, planes: tuple[int, ...]) -> Clipped:
    """Divide what reaches through a plane or behind the eye by w, and clip it there.

    Parameters
    ----------
    distances : (P, 3, 6) float64, see ``core.culling.culling.plane_distances``
    planes : indices of ``core.culling.culling.PLANES``; none: only divide
    """
    is_crossing = (distances[:, :, list(planes)] < 0).any(axis=(1, 2))
    chosen = np.flatnonzero(is_crossing | (primitives.clip[..., 3] <= 0).any(axis=1))
    polygon, is_defined = divide_corners(primitives.clip[chosen], primitives.varyings[chosen])
    count = np.where(is_defined, 3, 0)
    clipped = clip_chosen(primitives, chosen, polygon, count, planes, True, multiply_back)
    return replace(clipped, is_divided=True)


def divide_corners(clip: Floats, varyings: Floats) -> tuple[Floats, Flags]:
    """Divide corners by w.

    Parameters
    ----------
    clip : (Q, 3, 4) float64
    varyings : (Q, 3, K) float64

    Returns
    -------
    polygon : (Q, 3, 5 + K) float64
        x/w, y/w, z/w, 1, then 1/|w| and the values over |w|; 0 where not defined.
    is_defined : (Q,) bool
        Everything is finite; not so where a w is 0, or too small to divide by.
    """
    w = clip[..., 3:]
    with np.errstate(all="ignore"):
        inverse = 1 / np.abs(w)
        polygon = np.concatenate([clip[..., :3] / w, np.ones_like(w), inverse, varyings * inverse], axis=2)
    is_defined = np.isfinite(polygon).all(axis=(1, 2)) & (inverse[..., 0] > 0).all(axis=1)
    polygon[~is_defined] = 0
    return polygon, is_defined


def multiply_back(corners: Floats) -> tuple[Floats, Floats]:
    """Return the clip positions (C, 3, 4), all with w > 0, and values of divided corners (C, 3, 5 + K)."""
    w = 1 / corners[..., 4:5]
    return corners[..., :4] * w, corners[..., 5:] * w


def divide_corner(x: float, y: float, z: float, w: float) -> tuple[float, float, float] | None:
    """Listing of the division of one corner: its place in NDC, or nothing."""
    if w == 0:
        return None  #: undefined
    ndc = x / w, y / w, z / w  #: divide
    return ndc  #: keep


# Segments clipped in clip space, plane by plane: the case of each plane is that of an edge of a polygon.


def clip_segments(primitives: Primitives, distances: Floats, planes: tuple[int, ...]) -> Clipped:
    """Clip segments that a plane crosses, and drop those of which nothing is left.

    Parameters
    ----------
    primitives : Primitives
        Segments or points: corners 0 and 1 are the ends, corner 2 is corner 1 once more.
    distances : (P, 3, 6) float64, see ``core.culling.culling.plane_distances``
    planes : indices of ``core.culling.culling.PLANES``
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


# The methods of the family ``clipping``: which planes, before or after the division, and in which
# direction.


@dataclass(frozen=True)
class PolygonClipping:
    """A way to clip polygons."""

    planes: tuple[int, ...]
    """Indices of ``core.culling.culling.PLANES``."""
    clip_by: Callable[[Primitives, Floats, tuple[int, ...]], Clipped] = clip_primitives
    """Clips primitives, given the distances of their corners, against planes."""
    is_canonical: bool = True
    """Whether new corners are computed alike from A to B and from B to A, so that neighbours get the same."""
    divides: bool = False
    """Whether corners are divided by w first, whatever its sign."""

    @property
    def is_any(self) -> bool:
        """Whether anything is done at all."""
        return bool(self.planes) or self.divides

    def clip(self, primitives: Primitives, distances: Floats, corner_count: int) -> Clipped:
        """Clip primitives whose corners have ``distances`` (P, 3, 6) from the six planes."""
        by = self.clip_by if corner_count == 3 else clip_segments
        return by(primitives, distances, self.planes)


DEPTH_CLIPPING = PolygonClipping(DEPTH_PLANES)
"""What is inserted where a method needs corners in front of the eye."""


@method(
    "clipping",
    "homogeneous",
    "None (homogeneous rasterization)",
    source="Zwicker 2016, Homogeneous rasterization; Olano and Greer 1997",
    exact_for="any signs of w; an edge that crosses w = 0 moves with its snapped end, by at most sqrt(2)/512 pixel",
)
def no_clipping() -> PolygonClipping:
    """Return how polygons are clipped: not at all."""
    return PolygonClipping(())


@method(
    "clipping",
    "sutherland-hodgman",
    "Sutherland-Hodgman, six planes",
    source="Sutherland and Hodgman 1974; Pellacini, polygon clipping",
    exact_for="any signs of w",
    breaks_where="new corners, which are snapped again: edges turn by up to 1/256 pixel",
)
def six_planes() -> PolygonClipping:
    """Return how polygons are clipped: against all six planes, new corners from the inside end."""
    return PolygonClipping(ALL_PLANES)


@method(
    "clipping",
    "sutherland-hodgman-lecture",
    "Sutherland-Hodgman, in sequence",
    source="Sutherland and Hodgman 1974; Pellacini, polygon clipping: clip each point in sequence",
    exact_for="any signs of w, up to rounding",
    breaks_where="shared edges: two triangles clip them in opposite directions, so their new corners differ by "
    "rounding. At the border between two snapping steps, this makes a crack or a double hit",
)
def in_sequence() -> PolygonClipping:
    """Return how polygons are clipped: against all six planes, new corners from the edge's start."""
    return PolygonClipping(ALL_PLANES, partial(clip_primitives, is_canonical=False), is_canonical=False)


@method(
    "clipping",
    "after-divide",
    "After the division by w",
    source="the naive order; Blinn and Newell, Clipping using homogeneous coordinates, 1978, on why not",
    exact_for="triangles with all w > 0",
    breaks_where="w < 0: the division mirrors the corner through the eye, and the wrong part of the triangle is "
    "drawn. w = 0: the triangle is dropped",
    needs=("positive-w",),
)
def after_division() -> PolygonClipping:
    """Return how polygons are clipped: as x/w, y/w, z/w against the cube."""
    return PolygonClipping(ALL_PLANES, clip_divided, divides=True)


@method(
    "clipping",
    "project-first",
    "Project first, no clipping",
    source="the naive order without clipping; Zwicker 2016, on w through 0",
    exact_for="triangles with all w > 0",
    breaks_where="w < 0: the corner is mirrored through the eye, and the wrong triangle is drawn. w = 0: the "
    "triangle is dropped",
    needs=("positive-w",),
)
def project_first() -> PolygonClipping:
    """Return how polygons are clipped: not at all, but every corner is divided by its w."""
    return PolygonClipping((), clip_divided, divides=True)
