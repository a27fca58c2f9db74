"""One case of the comparison with OpenGL: triangles or lines in clip space, and how to draw them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core.raster.edges.snapping import SUBPIXELS
from core.records.arrays import Floats, Singles
from core.scene import Texture
from core.settings import Settings

STEP = 1 / SUBPIXELS
"""Pixels between two places of the grid that coverage is decided on."""


@dataclass(frozen=True, eq=False)
class Case:
    """Triangles or lines in clip space, and how to draw them; nothing else takes part in the picture."""

    family: str
    clip: Singles
    """(T, 3, 4) or, for lines, (L, 2, 4) float32 clip x, y, z, w."""
    attributes: Singles
    """(T, 3, K) or (L, 2, K) float32; the colour, or the first two texture coordinates."""
    size: tuple[int, int]
    """(width, height) in pixels."""
    texture: Texture | None = None
    cull: str = "none"
    depth_test: bool = False
    """Nearer wins and a tie keeps what is there; else what is drawn last wins, and its depth is stored."""
    interpolation: str = "perspective"
    provoking: str = "last"
    texture_filter: str = "nearest"
    wrap: str = "clamp"
    guard: int = 1
    """How many times farther out the clip planes of x and y are: nothing within is clipped. A power of two;
    if it is above 1, width and height must be even."""

    def __post_init__(self) -> None:
        if self.guard > 1 and (self.size[0] % 2 or self.size[1] % 2):
            raise ValueError(f"size must be even for a guard of {self.guard}, got {self.size}")

    @property
    def is_lines(self) -> bool:
        """Whether the primitives are line segments."""
        return bool(self.clip.shape[1] == 2)

    def settings(self, fill: str = "hierarchy") -> Settings:
        """Return how the core draws the triangles of this case, with one of the fills."""
        return Settings(
            cull=self.cull,
            fill=fill,
            interpolation=self.interpolation,
            provoking=self.provoking,
            texture_filter=self.texture_filter,
            wrap=self.wrap,
            shading="unlit",
            visibility="z-buffer" if self.depth_test else "last-drawn",
        )


def clip_positions(window: Floats, depth: ArrayLike, w: ArrayLike, size: tuple[int, int]) -> Singles:
    """Put corners at places in the window.

    Parameters
    ----------
    window : (..., 2) float64
        Pixels.
    depth, w : (...) array_like
        Window depth from 0 to 1, and clip w.
    size : (width, height)

    Returns
    -------
    (..., 4) float32, clip space
    """
    weight = np.broadcast_to(np.asarray(w, float), window.shape[:-1])[..., None]
    ndc = window * 2 / np.array(size) - 1
    z = np.broadcast_to(np.asarray(depth, float), window.shape[:-1])[..., None] * 2 - 1
    return np.concatenate([ndc * weight, z * weight, weight], axis=-1).astype(np.float32)


def settle(clip: Singles, size: tuple[int, int]) -> Singles:
    """Move clip positions (..., 4) float32, all w > 0, to where float32 rounding cannot turn the snap.

    That is by less than 1/1024 pixel, to at most 0.3 steps from the middle of a step of the grid.
    """
    w = clip[..., 3].astype(float)
    steps = (clip[..., :2] / w[..., None] + 1) * np.array(size) / 2 / STEP
    whole = np.rint(steps)
    window = (whole + np.clip(steps - whole, -0.3, 0.3)) * STEP
    return clip_positions(window, (clip[..., 2] / w + 1) / 2, w, size)
