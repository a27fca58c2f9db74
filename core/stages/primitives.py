"""From geometry to fragments: outlines and polygons cut to the window, and the pixels that primitives cover.

What is interpolated along an edge still goes by its whole length: only the choice of pixels starts at the new ends.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.clipping.rings import ClippedPolygon
from core.lines.line_clipping import ClippedLines, clip_lines
from core.lines.wireframe import Outlines
from core.methods import table
from core.records.arrays import Floats, Integers, cached_property
from core.records.clip_region import DIGITS, region_in_window
from core.records.primitives import Rings, join_rings
from core.transform.vertex_stage import VertexStage

# Outlines and line clipping joined: the edges of a wireframe are cut to the raster before a line method
# draws them.


@dataclass(frozen=True, eq=False)
class OutlineClip:
    """L edges of a wireframe and what is left of them on the raster."""

    whole: Outlines
    """(L) edges as they were."""
    lines: ClippedLines
    """What line clipping did to them."""

    @cached_property
    def kept(self) -> Integers:
        """(K,) int64, the edges of which something is left."""
        return np.flatnonzero(self.lines.is_kept)

    @cached_property
    def outlines(self) -> Outlines:
        """(K) edges to be drawn; ``window`` is still the whole edge."""
        kept = Outlines(*(values.take(self.kept, axis=0) for values in vars(self.whole).values()))
        return replace(
            kept,
            drawn=self.lines.segments.take(self.kept, axis=0),
            draws_last=(self.whole.draws_last | (self.lines.cut_by[:, 1] >= 0)).take(self.kept),
        )


def clip_outlines(
    whole: Outlines,
    method: str,
    size: tuple[int, int],
    center: float,
    region: Floats | None = None,
    reach: float = 0.0,
) -> OutlineClip:
    """Clip outlines to the pixels of a raster, or to another region.

    Parameters
    ----------
    method : str
        A method of the family ``line_clipping``.
    size : (width, height)
    center : float
        Coordinate of the centre of pixel 0: the raster begins half a pixel before it.
    region : (4,) or (M, 2) float64, optional
        Another region in NDC, see ``ClipScene``.
    reach : float
        Pixels around the raster that are kept, where the lines there reach into it.
    """
    if region is not None:
        return OutlineClip(whole, clip_lines(whole.window, region_in_window(region, size), method))
    low, high = center - 0.5 - reach, center - 0.5 + reach
    border = (low, low, size[0] + high, size[1] + high)
    return OutlineClip(whole, clip_lines(whole.window, border, method))


# Polygons and ring clipping joined: what is left of the polygons of a scene in its clip window.


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
