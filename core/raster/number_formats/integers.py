"""Edge functions in whole numbers of 1/256 pixel: int32, which wraps around soon, and int64, which does late.

Corners are 24.8 (or 56.8) fixed-point numbers, and so are a and b; products, c and the value have 16 fractional bits.
Two's complement arithmetic wraps modulo 2^n and forgets nothing else, so a value is right as long as it fits in the
end, whatever its terms did: below 2^15 square pixels in 32 bits, below 2^47 in 64. With all corners and pixels of a
triangle less than D pixels from each other along each axis, a value is below 2 D^2: right for D = 128 in 32 bits, and
for D = 8,388,608 in 64.

There is no w in these numbers: corners must lie in front of the eye (the pipeline clips for it), and a triangle with a
corner too far away for the format is not drawn.
"""

from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.raster.edges.snapping import SUBPIXELS, snap
from core.raster.number_formats.number_format import CornerPositions, FormatValue, NumberFormat
from core.records.arrays import Flags, Floats


@dataclass(frozen=True)
class FixedFormat(NumberFormat):
    """Whole numbers of 1/256 pixel in two's complement."""

    limit: float = 0.0
    """Pixels that a coordinate may be away from the origin."""

    def place(self, window: Floats) -> tuple[Floats, Flags]:
        """Return positions (P, 3, 2) on the 1/256-pixel grid, and where (P, 3) bool the format has them."""
        return snap(window, self.limit)

    def held_corners(self, corners: CornerPositions) -> tuple[FormatValue, FormatValue, FormatValue]:
        """Return x, y, w (3, P) in 1/256 pixel; w is 1, and all are 0 where a triangle cannot be drawn."""
        is_drawn = corners.is_projected.all(axis=1)
        held = np.where(is_drawn, corners.decided.transpose(2, 1, 0) * SUBPIXELS, 0).astype(self.held_as)
        w = np.broadcast_to(is_drawn, held.shape[1:]).astype(self.held_as)
        return held[0], held[1], w

    def of_pixels(self, position: Floats) -> FormatValue:
        """Return x or y of pixel centres, any shape, in 1/256 pixel."""
        return np.asarray(position * SUBPIXELS).astype(self.held_as)


FIXED_24_8 = FixedFormat(
    "fixed-24.8", np.int32, "snapped", "wrapped", "fixed-16.16", is_whole=True, limit=2.0**23 - 1
).scaled(-8, -16, -16)
INT64 = FixedFormat(
    "int64", np.int64, "snapped", "wrapped", "fixed-48.16", is_whole=True, limit=2.0**55
).scaled(-8, -16, -16)


@method(
    "coverage",
    "fixed-24.8",
    "Fixed point 24.8, int32",
    source="F. Giesen, Triangle rasterization in practice, 2013; fixed-point rasterizers of the 1990s",
    exact_for="triangles and pixels less than 128 pixels apart",
    breaks_where="values of 32,768 square pixels or more: they wrap around, so pixels are lost and others are "
    "drawn outside",
    needs=("projected",),
)
def fixed_24_8() -> NumberFormat:
    """Return whole numbers of 1/256 pixel in 32 bits."""
    return FIXED_24_8


@method(
    "coverage",
    "int64",
    "Whole 1/256 pixels, int64",
    source="F. Giesen, Triangle rasterization in practice, 2013; softpipe and llvmpipe",
    exact_for="triangles and pixels less than 8,388,608 pixels apart",
    breaks_where="values of 2^47 square pixels or more: they wrap around",
    needs=("projected",),
)
def int64() -> NumberFormat:
    """Return whole numbers of 1/256 pixel in 64 bits."""
    return INT64
