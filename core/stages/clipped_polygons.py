"""Polygons and ring clipping joined: what is left of the polygons of a scene in its clip window."""

from dataclasses import dataclass

import numpy as np

from core.geometry.ring_clipping.records import ClippedPolygon
from core.geometry.vertex_stage import VertexStage
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.clip_region import DIGITS, region_in_window
from core.records.rings import Rings, join_rings


@dataclass(frozen=True, eq=False)
class PolygonClip:
    """P polygons in the window and what clipping left of them."""

    whole: Rings
    """The rings before, corners rounded as those of the region are."""
    region: tuple[Floats, ...]
    """The rings (M, 2) of the region, in pixels."""
    clipped: tuple[ClippedPolygon, ...]
    """(P,) what is left of each."""
    rings: Rings
    """All that is left, in the window."""


def region_in_pixels(vertices: VertexStage, center: float) -> list[Floats]:
    """Return the rings (M, 2) of the region that polygons are clipped to, in pixels; see `clip_polygons`."""
    if vertices.clip_region is None:
        first = center - 0.5
        places = np.array([first, first, vertices.size[0] + first, vertices.size[1] + first])
    else:
        places = region_in_window(vertices.clip_region, vertices.size)
    if places.ndim == 2:
        return np.split(places, [] if vertices.region_rings is None else vertices.region_rings[1:])
    left, bottom, right, top = places
    return [np.array([[left, bottom], [right, bottom], [right, top], [left, top]])]


def polygons_in_pixels(vertices: VertexStage, polygon: Integers) -> Rings:
    """Return the rings of polygons (P,) in pixels, corners rounded as those of the region are."""
    whole = vertices.rings_of(polygon)
    return Rings(np.round(whole.corners, DIGITS), whole.starts, whole.polygon)


def clip_polygons(vertices: VertexStage, polygon: Integers, method: str, center: float) -> PolygonClip:
    """Clip polygons to the clip window of their scene, or else to the pixels of the raster.

    Parameters
    ----------
    polygon : (P,) int64
        Which of its polygons.
    method : str
        A method of the family ``polygon_clipping``.
    center : float
        Coordinate of the centre of pixel 0: the raster begins half a pixel before it.
    """
    region, rounded = region_in_pixels(vertices, center), polygons_in_pixels(vertices, polygon)
    clip = table.get("polygon_clipping", method).function
    clipped = tuple(clip(rounded.rings_of(number), region) for number in range(len(polygon)))
    return PolygonClip(rounded, tuple(region), clipped, join_rings([found.rings for found in clipped]))
