"""Texture look-up in mipmaps: bilinear in one or two levels, and the mix of both."""

from dataclasses import dataclass

import numpy as np

from core.fragments.color_rule import ColorRule
from core.fragments.coordinates import finite_coordinates
from core.fragments.level_of_detail import LevelChoice, choose_levels
from core.fragments.mipmaps import mipmap_levels
from core.fragments.textures import TextureSamples, sample_texture, texture_colors
from core.methods import table
from core.records.arrays import Floats, Integers, read_only
from core.scene import Texture

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
