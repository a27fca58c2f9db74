"""What a texture can look like somewhere in it: least and largest texels of blocks, and how its levels differ.

Every filter mixes texels with weights that sum to 1, so a colour lies between the least and the largest texel that the
filter reaches. Blocks of 2^k texels are kept for every k; nine of them around a place hold all within 2^k texels.
"""

from collections.abc import Callable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from core.fragments.mipmaps import mipmap_levels
from core.fragments.textures import texture_colors
from core.records.arrays import Floats, Integers, Singles
from core.scene import Texture
from core.study.planner.words.phrases import figure

_kept: WeakKeyDictionary[Texture, "TextureRanges"] = WeakKeyDictionary()
LONGEST_LEVEL = 14.0
"""Level of detail from which on a step is not told in numbers: it is longer than any texture that is worth telling."""


def step_text(level: float) -> str:
    """Return how long a step of 2^level texels is at most; bounds at grazing pixels are far longer than a texture."""
    if level > LONGEST_LEVEL:
        return f"not known to be shorter than {2**LONGEST_LEVEL:,.0f} texels"
    return f"{figure(2.0**level)} texels at most"


@dataclass(frozen=True, eq=False)
class TextureRanges:
    """Blocks of a texture of h x w texels, level k of blocks of 2^k texels each way."""

    low: tuple[Singles, ...]
    """(h_k, w_k, C) float32 each."""
    high: tuple[Singles, ...]
    neighbours: Floats
    """(C,) float64, largest difference within four texels around any place."""
    contrast: Floats
    """(C,) float64, largest less least texel."""
    level_low: Floats
    """(L, C) float64, the least texel of mipmap level k and all above it."""
    level_high: Floats
    """(L, C) float64, the largest."""


def texture_ranges(texture: Texture) -> TextureRanges:
    """Return the blocks of a texture; they are made once."""
    if texture not in _kept:
        _kept[texture] = _make(texture)
    return _kept[texture]


def _make(texture: Texture) -> TextureRanges:
    texels = texture.pixels
    low, high = [texels], [texels]
    while max(low[-1].shape[:2]) > 1:
        low.append(_pool(low[-1], np.minimum))
        high.append(_pool(high[-1], np.maximum))
    spread = _spread_of_four(texels)
    levels = [level.pixels for level in mipmap_levels(texture)]
    least, most = (np.stack([_each(level, choose) for level in levels]) for choose in (np.min, np.max))
    return TextureRanges(
        tuple(low),
        tuple(high),
        _each(spread, np.max),
        (high[-1] - low[-1].astype(np.float64))[0, 0],
        np.minimum.accumulate(least[::-1])[::-1],
        np.maximum.accumulate(most[::-1])[::-1],
    )


def _each(texels: Singles | Floats, choose: Callable[..., np.floating]) -> Floats:
    """Return the least or the largest (C,) float64 of texels (h, w, C), a channel at a time."""
    return np.array([choose(texels[..., channel]) for channel in range(texels.shape[2])], np.float64)


def _spread_of_four(texels: Singles) -> Floats:
    """Return (h, w, C) float64: how far apart each texel and those left of it and below it are."""
    low, high = texels, texels
    for axis in (0, 1):
        low = np.minimum(low, np.roll(low, 1, axis))
        high = np.maximum(high, np.roll(high, 1, axis))
    return np.subtract(high, low, dtype=np.float64)


def _pool(texels: Singles, choose: np.ufunc) -> Singles:
    if texels.shape[0] % 2:
        texels = np.concatenate([texels, texels[-1:]], axis=0)
    texels = choose(texels[::2], texels[1::2])
    if texels.shape[1] % 2:
        texels = np.concatenate([texels, texels[:, -1:]], axis=1)
    return np.asarray(choose(texels[:, ::2], texels[:, 1::2]))


def magnified_range(texture: Texture, low: Floats, high: Floats, wrap: str) -> tuple[Floats, Floats]:
    """Return the least and largest bilinear colours (Q, C) over texture coordinates from ``low`` to ``high`` (Q, 2).

    Notes
    -----
    A step of one texel changes a bilinear colour by no more than neighbouring texels differ, each way.
    """
    height, width, channels = texture.pixels.shape
    with np.errstate(invalid="ignore", over="ignore"):
        reach = ((high - low) / 2 * (width, height)).sum(axis=1)[:, None]
        spread = np.nan_to_num(reach * texture_ranges(texture).neighbours, nan=np.inf, posinf=np.inf)
    middle = texture_colors(texture, np.nan_to_num((low + high) / 2), "bilinear", wrap)[:, :channels]
    return middle - spread, middle + spread


def minified_range(texture: Texture, lod: Floats) -> tuple[Floats, Floats]:
    """Return the least and largest trilinear colours (Q, C) at a level of detail of ``lod`` (Q,) or more."""
    ranges = texture_ranges(texture)
    top = len(ranges.level_low) - 1
    level = np.clip(np.floor(np.nan_to_num(lod, nan=0.0, neginf=0.0, posinf=top)), 0, top).astype(np.int64)
    return ranges.level_low[level], ranges.level_high[level]


def range_around(
    texture: Texture, low: Floats, high: Floats, reach: Floats, wrap: str
) -> tuple[Floats, Floats]:
    """Return the least and largest colours (Q, C) of what filters read there.

    Parameters
    ----------
    low, high : (Q, 2) float64
        Range of the texture coordinates.
    reach : (Q,) float64
        How many texels around it are read.
    wrap : str
        Only ``repeat`` is looked at in parts; for the others it is the whole texture.
    """
    ranges = texture_ranges(texture)
    height, width = texture.pixels.shape[:2]
    scale = np.array([width, height])
    with np.errstate(invalid="ignore", over="ignore"):
        half = ((high - low) / 2 * scale).max(axis=1) + reach
        middle = (low + high) / 2 * scale
        level = np.ceil(np.log2(np.maximum(half, 1e-9)))
    top = len(ranges.low) - 1
    is_whole = ~(level < top - 1) | ~np.isfinite(middle).all(axis=1) | (wrap != "repeat")
    # Sides that are no power of two leave a smaller last block, and beyond it texels go on at the start.
    is_whole |= (height & (height - 1) != 0) or (width & (width - 1) != 0)
    least = np.broadcast_to(ranges.low[-1][0, 0], (len(low), texture.pixels.shape[2])).astype(np.float64)
    most = np.broadcast_to(ranges.high[-1][0, 0], least.shape).astype(np.float64)
    number = np.where(is_whole, -1, np.maximum(level, 0)).astype(np.int64)
    for k in np.unique(number[number >= 0]).tolist():
        chosen = np.flatnonzero(number == k)
        block = np.floor(middle[chosen] / 2.0**k).astype(np.int64)
        parts_low, parts_high = _nine(ranges.low[k], block), _nine(ranges.high[k], block)
        least[chosen], most[chosen] = parts_low.min(axis=0), parts_high.max(axis=0)
    return least, most


def _nine(blocks: Singles, place: Integers) -> Singles:
    """Return (9, Q, C): the blocks around places (Q, 2) of column and row; they repeat."""
    rows, columns = blocks.shape[:2]
    return np.stack(
        [
            blocks[(place[:, 1] + up) % rows, (place[:, 0] + right) % columns]
            for up in (-1, 0, 1)
            for right in (-1, 0, 1)
        ]
    )
