"""Where the samples of a method lie in a pixel, and how finely corners are snapped for them."""

from dataclasses import dataclass

from core.framebuffer.sample_positions import ROTATED_GRID, grid_positions
from core.records.arrays import Floats


@dataclass(frozen=True, eq=False)
class Pattern:
    """S samples of a pixel."""

    positions: Floats
    """(S, 2) float64, from the pixel's lower left corner, 0 to 1."""
    scale: int
    """Corners are snapped to 1/256 of a pixel over this."""
    side: int
    """Samples on a side that a texture is looked up at: its steps are so many times shorter than a pixel's."""
    stays_inside: bool = True
    """Whether attributes are taken at the samples; else at the pixel's centre, which may be beyond the triangle."""


PATTERNS = {
    "none": Pattern(grid_positions(1), 1, 1),
    "msaa-4": Pattern(ROTATED_GRID, 1, 1, stays_inside=False),
    "ssaa-4": Pattern(grid_positions(2), 2, 2),
    "ssaa-16": Pattern(grid_positions(4), 4, 4),
}
"""By the name of the method of antialiasing; exact areas have no samples."""
EVERYTHING = PATTERNS["ssaa-16"]
