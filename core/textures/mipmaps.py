"""Mipmaps: the level of detail of a fragment, the levels, and look-up in one or two of them.

Level k + 1 has floor(size / 2) texels of level k each way, but at least one, as OpenGL has it. Its texels are means of
the exact area that each covers, in linear light: two texels each way where the size is even, and where it is odd,
2 m + 1 texels becoming m, three with the weights m - i, m and i + 1 over 2 m + 1 for texel i. So the mean of every
level is the mean of the texture. Alpha is straight, and colours are averaged as they are, like bilinear filtering does.

References
----------
L. Williams, *Pyramidal parametrics*, SIGGRAPH 1983.
S. Guthe, P. Heckbert, *Non-power-of-two mipmapping*, NVIDIA 2005 (the three weights).
M. Segal, K. Akeley, *The OpenGL Graphics System 4.6*, 2022, section 8.14.3.

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
from weakref import WeakKeyDictionary

import numpy as np
from numpy import log2 as binary_logarithm

from core.methods import method, table
from core.records.arrays import Floats, Integers, read_only
from core.records.listing import RETURN, Operation
from core.scene import Texture
from core.textures.look_up import (
    ColorRule,
    TextureSamples,
    bilinear_color,
    finite_coordinates,
    sample_texture,
    texture_colors,
    uses_mipmaps,
)

# Mipmaps: a texture at half, a quarter ... of its size, so that a pixel reads about one texel at any
# distance.


_smaller: WeakKeyDictionary[Texture, tuple[Texture, ...]] = WeakKeyDictionary()
"""The levels below each texture; they go when the texture goes."""


def mipmap_levels(texture: Texture) -> tuple[Texture, ...]:
    """Return the levels of a texture, level 0 first: the texture itself, down to a single texel.

    Notes
    -----
    They are made once for every texture and kept as long as it is. Each is made from the level above it in float64 and
    rounded to float32 once.

    Examples
    --------
    >>> board = Texture(np.array([[[0.0], [1.0], [1.0]], [[1.0], [0.0], [0.0]]]))
    >>> [level.pixels[..., 0].tolist() for level in mipmap_levels(board)]
    [[[0.0, 1.0, 1.0], [1.0, 0.0, 0.0]], [[0.5]]]
    """
    if texture not in _smaller:
        _smaller[texture] = tuple(_make_levels(texture))
    return (texture, *_smaller[texture])


def _make_levels(texture: Texture) -> list[Texture]:
    levels: list[Texture] = []
    pixels = texture.pixels.astype(np.float64)
    while max(pixels.shape[:2]) > 1:
        pixels = halve(halve(pixels).swapaxes(0, 1)).swapaxes(0, 1)
        levels.append(Texture(pixels.astype(np.float32), f"{texture.name}, level {len(levels) + 1}"))
    return levels


def halve(rows: Floats) -> Floats:
    """Return the means of rows (N, ...) float64 by area: (floor(N / 2), ...), or the single row as it is."""
    count = len(rows) // 2
    if not count:
        return rows
    first, second = rows[0 : 2 * count : 2], rows[1 : 2 * count : 2]
    if len(rows) % 2 == 0:
        return np.asarray((first + second) * 0.5)
    third = rows[2 : 2 * count + 1 : 2]
    number = np.arange(count, dtype=np.float64).reshape(-1, *[1] * (rows.ndim - 1))
    return np.asarray((first * (count - number) + second * count + third * (number + 1)) / len(rows))


# The level of detail: how many texels a step of one pixel is long, and which mipmap levels that calls for.


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
        du/dx, dv/dx, du/dy, dv/dy, see ``core.textures.footprints``.
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


# Texture look-up in mipmaps: bilinear in one or two levels, and the mix of both.


_BLOCK = 8192
"""Fragments of a picture that are looked up at once, so that their numbers stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class LevelSamples:
    """What F fragments read of one mipmap level each."""

    level: Integers
    """(F,) int64."""
    size: Integers
    """(F, 2) int64, width and height of the level."""
    samples: TextureSamples
    """Bilinear, in texels of that level."""


@dataclass(frozen=True, eq=False)
class MipmapSamples:
    """What F fragments read from a texture's mipmaps."""

    choice: LevelChoice
    near: LevelSamples
    far: LevelSamples
    color: Floats
    """(F, 4) float64, linear, straight alpha."""


def mipmap_colors(
    texture: Texture, uv: Floats, slopes: Floats, texture_filter: str = "trilinear", wrap: str = "repeat"
) -> Floats:
    """Return the (F, 4) float64 colours of `sample_mipmaps`, bit for bit, without the record.

    Parameters
    ----------
    uv : (F, 2) float64 array
        Texture coordinates.
    slopes : (4, F) float64 array
        du/dx, dv/dx, du/dy, dv/dy: how they change with a pixel to the right and with one up.
    texture_filter, wrap : str
        Names of methods of these families; a filter that uses mipmaps.

    Notes
    -----
    A level's colours are those of ``bilinear`` in it. Where the coarser level has no share it is not read.
    """
    rule = table.get("texture_filter", texture_filter).function
    if isinstance(rule, ColorRule):
        return rule.colors(
            texture, finite_coordinates(uv), _choose(texture, slopes, texture_filter).lod, wrap
        ).T
    color = np.empty((4, len(uv)))
    for start in range(0, len(uv), _BLOCK):
        part = slice(start, start + _BLOCK)
        choice = _choose(texture, slopes[:, part], texture_filter)
        color[:, part] = _level_colors(texture, uv[part], choice.near, wrap)
        mixed = np.flatnonzero(choice.fraction > 0)
        if len(mixed):
            far = _level_colors(texture, uv[part].take(mixed, axis=0), choice.far.take(mixed), wrap)
            share, rows = choice.fraction.take(mixed), color[:, part]
            rows[:, mixed] = rows[:, mixed] * (1 - share) + far * share
    return color.T


def sample_mipmaps(
    texture: Texture, uv: Floats, slopes: Floats, texture_filter: str = "trilinear", wrap: str = "repeat"
) -> MipmapSamples:
    """Look ``uv`` (F, 2) up in mipmaps and keep everything that took part; see `mipmap_colors`."""
    choice = _choose(texture, slopes, texture_filter)
    near, far = (_sample_levels(texture, uv, level, wrap) for level in (choice.near, choice.far))
    color = mipmap_colors(texture, uv, slopes, texture_filter, wrap)
    return MipmapSamples(choice, near, far, read_only(color))


def _choose(texture: Texture, slopes: Floats, texture_filter: str) -> LevelChoice:
    height, width, _ = texture.pixels.shape
    return choose_levels(slopes, (width, height), len(mipmap_levels(texture)), texture_filter)


def _level_colors(texture: Texture, uv: Floats, level: Integers, wrap: str) -> Floats:
    """Return the colours (4, F) of fragments that each read one level (F,)."""
    color = np.empty((4, len(uv)))
    for number, of_level in enumerate(mipmap_levels(texture)):
        chosen = np.flatnonzero(level == number)
        if len(chosen):
            color[:, chosen] = texture_colors(of_level, uv.take(chosen, axis=0), "bilinear", wrap).T
    return color


def _sample_levels(texture: Texture, uv: Floats, level: Integers, wrap: str) -> LevelSamples:
    """Return the record of fragments that each read one level (F,)."""
    levels = mipmap_levels(texture)
    sizes = np.array([of_level.pixels.shape[1::-1] for of_level in levels])
    order = np.argsort(level, kind="stable")
    parts = [
        sample_texture(of_level, uv[level == number], "bilinear", wrap)
        for number, of_level in enumerate(levels)
    ]
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    joined = {
        name: read_only(np.concatenate([getattr(part, name) for part in parts]).take(place, axis=0))
        for name in vars(parts[0])
    }
    return LevelSamples(level, sizes[level], TextureSamples(**joined))
