"""The level of detail: how many texels a step of one pixel is long, and which mipmap levels that calls for.

OpenGL leaves the details to its implementations. Measured on llvmpipe (Mesa 22.3) with the same levels: triangles of
one w choose the same level at every pixel, and trilinear colours differ by 0.015 of the range at most, since its
logarithm is an approximation; under perspective the quads' slopes shift the level a little, by 0.065 of the range at
most on a floor up to the horizon, 0.005 on average. Its own levels equal ours where all sizes are powers of two.

References
----------
L. Williams, *Pyramidal parametrics*, SIGGRAPH 1983.
M. Segal, K. Akeley, *The OpenGL Graphics System 4.6*, 2022, sections 8.14.1 (level of detail) and 8.14.3 (filters).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, floor, sqrt

import numpy as np
from numpy import log2 as binary_logarithm

from core.fragments.textures import bilinear_color, uses_mipmaps
from core.methods import method, table
from core.records.arrays import Floats, Integers
from core.records.listing import RETURN
from core.records.operation import Operation

_CHOICE = (
    Operation("slopes", "slopes", {"uv_slopes": "slopes"}),
    Operation("lengths", "lengths", {"lengths": "right up"}),
    Operation("lod", "lod", ("lod",)),
    Operation("level", "level", ("level",)),
)
_NEAR = ("near_position", "near_texels", "near_colors", "near_shares")
_FAR = tuple(name.replace("near", "far") for name in _NEAR)


@dataclass(frozen=True, eq=False)
class LevelChoice:
    """The mipmap levels that F fragments read."""

    lengths: Floats
    """(2, F) float64 texels of level 0: how far a pixel to the right, and one up, leads in the texture."""
    lod: Floats
    """(F,) float64, lambda = log2 of the longer one; -inf where both are 0, NaN where they are not defined."""
    level: Floats
    """(F,) float64, lambda within the levels that there are: from 0 to the number of the last."""
    near: Integers
    """(F,) int64, the finer of the two levels."""
    far: Integers
    """(F,) int64, the coarser one; the same at the top, and for filters that read one level."""
    fraction: Floats
    """(F,) float64, share of the coarser one, below 1."""


def mipmap_color(
    levels: Sequence[Sequence[Sequence[Sequence[float]]]], u: float, v: float, lod: float, wrap: str
) -> tuple[float, ...]:
    """Return the mix of two levels ``levels[k][row][column]`` at (u, v) (listing of trilinear)."""
    level = min(lod, len(levels) - 1) if lod > 0 else 0.0  #: level
    near, far = floor(level), min(floor(level) + 1, len(levels) - 1)  #: levels
    fraction = level - near  #: fraction
    fine = bilinear_color(levels[near], u, v, wrap)  #: near
    coarse = bilinear_color(levels[far], u, v, wrap)  #: far
    return tuple(c * (1 - fraction) + d * fraction for c, d in zip(fine, coarse, strict=True))  #: color


@method(
    "texture_filter",
    "trilinear",
    "Trilinear (two mipmap levels)",
    source="Williams 1983, Pyramidal parametrics; OpenGL 4.6, LINEAR_MIPMAP_LINEAR",
    exact_for="footprints of one colour; square footprints approximately",
    breaks_where="long and narrow footprints: the longer side decides, so the picture is blurred",
    needs=("mipmaps",),
    listing=mipmap_color,
    operations={
        "texture": (
            *_CHOICE,
            Operation("levels", "levels", {"levels": "near far"}, ("level_sizes",)),
            Operation("fraction", "fraction", {"level_fraction": "fraction"}),
            Operation("near", "near", {"near_color": "fine"}, _NEAR),
            Operation("far", "far", {"far_color": "coarse"}, _FAR),
            Operation("mix", "color", {"texture_color": RETURN}),
        )
    },
)
def trilinear(level: Floats, top: int) -> tuple[Integers, Integers, Floats]:
    """Choose the two levels around each level of detail, and mix them by nearness.

    Parameters
    ----------
    level : (F,) float64 array
        From 0 to ``top``.
    top : int
        Number of the level that is a single texel.

    Returns
    -------
    near, far : (F,) int64
    fraction : (F,) float64
    """
    near = np.floor(level)
    whole = near.astype(np.int64)
    return whole, np.minimum(whole + 1, top), level - near


def nearest_mipmap_color(
    levels: Sequence[Sequence[Sequence[Sequence[float]]]], u: float, v: float, lod: float, wrap: str
) -> tuple[float, ...]:
    """Return the colour of the nearest of ``levels[k][row][column]`` at (u, v) (listing of mipmap-nearest)."""
    level = min(lod, len(levels) - 1) if lod > 0 else 0.0  #: level
    nearest = ceil(level + 0.5) - 1  #: levels
    color = bilinear_color(levels[nearest], u, v, wrap)  #: near
    return color


@method(
    "texture_filter",
    "mipmap-nearest",
    "Bilinear in the nearest mipmap level",
    source="Williams 1983, Pyramidal parametrics; OpenGL 4.6, LINEAR_MIPMAP_NEAREST",
    exact_for="footprints of one colour; square footprints approximately",
    breaks_where="changes of the mipmap level: a line is visible. Long and narrow footprints, as with trilinear",
    needs=("mipmaps",),
    listing=nearest_mipmap_color,
    operations={
        "texture": (
            *_CHOICE,
            Operation("levels", "levels", {"levels": "nearest"}, ("level_sizes", "level_fraction")),
            Operation("near", "near", {"near_color": "color", "texture_color": "color"}, _NEAR),
        )
    },
)
def mipmap_nearest(level: Floats, top: int) -> tuple[Integers, Integers, Floats]:
    """Choose the level nearest to each level of detail, halfway the finer one; see `trilinear`."""
    near = (np.ceil(level + 0.5) - 1).astype(np.int64)
    return near, near, np.zeros_like(level)


@np.errstate(divide="ignore", invalid="ignore", over="ignore")
def choose_levels(
    slopes: Floats, size: tuple[int, int], level_count: int, texture_filter: str
) -> LevelChoice:
    """Return the levels to be read.

    Parameters
    ----------
    slopes : (4, F) float64 array
        du/dx, dv/dx, du/dy, dv/dy, see ``core.fragments.uv_slopes``.
    size : tuple of int
        Width and height of level 0.
    level_count : int
        How many levels there are.
    texture_filter : str
        A filter that uses mipmaps.

    Raises
    ------
    ValueError
        For another filter.

    Notes
    -----
    Magnified (lambda at or below 0), and where the slopes are not defined, level 0 is read; endlessly long slopes read
    the top.
    """
    if not uses_mipmaps(texture_filter):
        raise ValueError(f"texture_filter must be one that reads mipmaps, got {texture_filter}")
    width, height = np.float64(size[0]), np.float64(size[1])
    right_u, right_v = slopes[0] * width, slopes[1] * height
    up_u, up_v = slopes[2] * width, slopes[3] * height
    right = np.sqrt(right_u * right_u + right_v * right_v)
    up = np.sqrt(up_u * up_u + up_v * up_v)
    lod = np.log2(np.where(up > right, up, right))
    top = level_count - 1
    choose: Callable[[Floats, int], tuple[Integers, Integers, Floats]]
    choose = table.get("texture_filter", texture_filter).function
    level = np.where(lod > 0, np.minimum(lod, top), 0.0)
    return LevelChoice(np.stack([right, up]), lod, level, *choose(level, top))


def level_of_detail(
    du_dx: float, dv_dx: float, du_dy: float, dv_dy: float, width: int, height: int
) -> tuple[float, float, float]:
    """Listing of the level of detail: how far a pixel to the right and one up lead, in texels, and lambda."""
    right_u, right_v = du_dx * width, dv_dx * height
    up_u, up_v = du_dy * width, dv_dy * height
    right, up = sqrt(right_u * right_u + right_v * right_v), sqrt(up_u * up_u + up_v * up_v)  #: lengths
    lod = binary_logarithm(max(right, up))  #: lod
    return right, up, lod
