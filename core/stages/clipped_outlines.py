"""Outlines and line clipping joined: the edges of a wireframe are cut to the raster before a line method draws them.

What is interpolated along an edge still goes by its whole length: only the choice of pixels starts at the new ends.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.geometry.line_clipping.clipping import clip_lines
from core.geometry.line_clipping.records import ClippedLines
from core.raster.lines.wireframe import Outlines
from core.records.arrays import Floats, Integers
from core.records.cached import cached_property
from core.records.clip_region import region_in_window


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
