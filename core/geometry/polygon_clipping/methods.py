"""The methods of the family ``clipping``: which planes, before or after the division, and in which direction."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from core.geometry.polygon_clipping.after_divide import clip_divided
from core.geometry.polygon_clipping.segments import clip_segments
from core.geometry.polygon_clipping.sutherland_hodgman import (
    ALL_PLANES,
    DEPTH_PLANES,
    Clipped,
    clip_primitives,
)
from core.methods import method
from core.records.arrays import Floats
from core.records.primitives import Primitives


@dataclass(frozen=True)
class PolygonClipping:
    """A way to clip polygons."""

    planes: tuple[int, ...]
    """Indices of ``core.geometry.culling.PLANES``."""
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
