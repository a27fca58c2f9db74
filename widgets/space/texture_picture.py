"""What the texture view shows: a texture, a triangle laid over it, and the footprints of pixels."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class TexelFootprint:
    """A pixel in texture space; x and y in texels, (0, 0) the lower left corner of the texture."""

    corners: NDArray[np.float64] = field(repr=False)
    """(4, 2) float64, the pixel's corners in turn; not finite where it has none (at the horizon)."""
    center: NDArray[np.float64] = field(repr=False)
    """(2,) float64, the pixel's centre: the place that is looked up."""
    reads: NDArray[np.integer] = field(repr=False)
    """(K, 2) integers, columns and rows that are read, before wrapping, shifted like the centre."""
    texels: NDArray[np.integer] = field(repr=False)
    """(K, 2) integers, the texels that these are after wrapping."""
    shares: NDArray[np.float64] = field(repr=False)
    """(K,) float64, share of each in the colour."""
    label: str = ""
    is_pinned: bool = False
    """A pinned pixel has a solid outline, a hovered one a dashed one."""

    def __post_init__(self) -> None:
        if self.corners.shape != (4, 2) or self.center.shape != (2,):
            raise ValueError(
                f"corners and center must be (4, 2) and (2,), got {self.corners.shape} and {self.center.shape}"
            )
        if not self.reads.shape == self.texels.shape == (len(self.shares), 2):
            raise ValueError(f"reads and texels must be ({len(self.shares)}, 2), got {self.reads.shape}")


@dataclass(frozen=True, eq=False)
class TexturePicture:
    """A texture with what is marked in it."""

    pixels: NDArray[np.float32] = field(repr=False)
    """(h, w, C) linear colours, row 0 at the bottom."""
    period: int = 1
    """Textures after which the plane repeats; 2: every second is a mirror image; 0: the border texels go on."""
    triangle: NDArray[np.float64] | None = field(default=None, repr=False)
    """(3, 2) float64, corners of a triangle in texels, or None."""
    footprints: tuple[TexelFootprint, ...] = ()
    caption: str = ""

    def __post_init__(self) -> None:
        if self.pixels.ndim != 3 or self.pixels.shape[2] not in (1, 3, 4) or 0 in self.pixels.shape:
            raise ValueError(f"pixels must be (h, w, 1, 3 or 4) and not empty, got {self.pixels.shape}")
        if self.period not in (0, 1, 2):
            raise ValueError(f"period must be 0, 1 or 2, got {self.period}")
        if self.triangle is not None and self.triangle.shape != (3, 2):
            raise ValueError(f"triangle must be (3, 2), got {self.triangle.shape}")

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in texels."""
        return int(self.pixels.shape[1]), int(self.pixels.shape[0])
