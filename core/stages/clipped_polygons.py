"""Polygons and ring clipping joined: what is left of the polygons of a scene in its clip window."""

from dataclasses import dataclass

import numpy as np

from core.geometry.ring_clipping.records import ClippedPolygon
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


def region_rings_in_window(
    region: Floats | None, region_rings: Integers | None, size: tuple[int, int], center: float
) -> list[Floats]:
    """Return the rings (M, 2) of the region that polygons are clipped to, in pixels; see `clip_polygons`."""
    first = center - 0.5
    places = np.array([first, first, size[0] + first, size[1] + first])
    if region is not None:
        places = region_in_window(region, size)
    if places.ndim == 2:
        return np.split(places, region_rings[1:] if region_rings is not None else [])
    left, bottom, right, top = places
    return [np.array([[left, bottom], [right, bottom], [right, top], [left, top]])]


def clip_polygons(
    whole: Rings,
    count: int,
    method: str,
    size: tuple[int, int],
    center: float,
    region: Floats | None,
    region_rings: Integers | None,
) -> PolygonClip:
    """Clip polygons to the pixels of a raster, or to another region.

    Parameters
    ----------
    whole : Rings
    count : int
        P, polygons.
    method : str
        A method of the family ``polygon_clipping``.
    size : (width, height)
    center : float
        Coordinate of the centre of pixel 0: the raster begins half a pixel before it.
    region : (4,) or (M, 2) float64, optional
        ``clip_region`` of ``ClipScene``.
    region_rings : (R,) int64, optional

    Raises
    ------
    ValueError
        If the method refuses the polygon or the region: each says what it needs.
    """
    rings = region_rings_in_window(region, region_rings, size, center)
    rounded = Rings(np.round(whole.corners, DIGITS), whole.starts, whole.polygon)
    clip = table.get("polygon_clipping", method).function
    clipped = tuple(clip(rounded.rings_of(polygon), rings) for polygon in range(count))
    return PolygonClip(rounded, tuple(rings), clipped, join_rings([found.rings for found in clipped]))
