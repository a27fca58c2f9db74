"""Textures packed for the display: all three channels of a texel in one word, mixed in one go, as bytes at the end.

A picture whose fragments show nothing but a texture needs no more than a byte per channel. So a texel becomes one
64-bit word of three fields of 21 bits, each with 13 bits of linear colour; times a weight of 8 bits no field
overflows, and a bilinear mean is four look-ups, four products and three sums for red, green and blue together.
Weights of 8 bits are what graphics processors have.

How exact it is
---------------
Let c be the largest difference between neighbouring texels around a position. The position is rounded to 1/256 of
a texel (an error of c/256 at most), so is the product of the two weights (c/256), and colours are rounded twice to
1/8191 (half of it each time). So a linear value is at most ``c / 128 + 1 / 8191`` off (see `linear_error`), next to
what single-precision coordinates cost. Where a texture is even, or nearest is chosen, a picture file's own bytes
come back unchanged. In sRGB a small linear error shows where a picture is dark: beside a step from black to white a
byte may be off by several, elsewhere by none or one.

References
----------
M. Segal, K. Akeley, The OpenGL Graphics System 4.6, 2022, section 8.14.2 (subtexel precision is the implementation's).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats, Singles, read_only
from core.byte_words import FIELDS, OPAQUE, let_meet
from core.methods import table
from core.scene import Texture

Words = NDArray[np.uint32]
Fields = NDArray[np.uint64]
Bytes = NDArray[np.uint8]
Wholes = NDArray[np.int32]
Coordinates = Floats | Singles

LEVELS = 8192
"""Linear colours that a field can tell apart."""

BLOCK = 32768
"""Fragments that are looked up at once: enough to make the calls cheap, few enough for the processor's cache."""

_FIELD = 21
_SUBTEXELS = 256
_HALF = np.uint64(sum(1 << (low + fraction - 1) for low, fraction in FIELDS))
"""Half a byte in each field: cutting off the fraction rounds."""
_FARTHEST = 2.0**30
"""Positions in 1/256 of a texel that 32-bit numbers hold with room to spare."""


@dataclass(frozen=True, eq=False)
class PackedTexture:
    """A texture of ``width`` columns and ``height`` rows, a word each texel."""

    texels: Fields
    """(h * w,) uint64: red in bits 0 to 12, green from bit 21 on, blue from bit 42 on."""
    width: int
    height: int


@lru_cache(maxsize=16)
def is_packable(texture: Texture) -> bool:
    """Return whether a texture has no alpha and nothing brighter than 1 or darker than 0."""
    pixels = texture.pixels
    return pixels.shape[2] < 4 and bool(pixels.min() >= 0 and pixels.max() <= 1)


@lru_cache(maxsize=16)
def has_bytes(texture: Texture) -> bool:
    """Return whether every linear value of a packable texture is a byte, a 255th."""
    byte = np.rint(texture.pixels * np.float32(255)).astype(np.float32)
    return bool((byte / np.float32(255) == texture.pixels).all())


@lru_cache(maxsize=16)
def pack_bytes(texture: Texture) -> PackedTexture:
    """Return a texture of bytes packed so that sums of weights of 256 are words of ``core.byte_words``."""
    height, width, channels = texture.pixels.shape
    byte = np.rint(texture.pixels * np.float32(255)).astype(np.uint64)
    texels = np.zeros((height, width), np.uint64)
    for place, (low, fraction) in enumerate(FIELDS):
        texels |= byte[:, :, place % channels] << np.uint64(low + fraction - 8)
    return PackedTexture(read_only(texels.reshape(-1)), width, height)


@lru_cache(maxsize=16)
def pack(texture: Texture) -> PackedTexture:
    """Return a texture packed; see `is_packable`."""
    height, width, channels = texture.pixels.shape
    level = np.rint(texture.pixels.astype(np.float64) * (LEVELS - 1)).astype(np.uint64)
    texels = np.zeros((height, width), np.uint64)
    for place in range(3):
        texels |= level[:, :, place % channels] << np.uint64(_FIELD * place)
    return PackedTexture(read_only(texels.reshape(-1)), width, height)


def linear_levels() -> Singles:
    """Return (8192,) float32: the linear value that stands for each level; what lies above it is cut off.

    A mean that is cut off to its level lies half a step higher on average.
    """
    half_step = (_SUBTEXELS - 1) / (2 * _SUBTEXELS)
    return ((np.arange(LEVELS) + half_step) / (LEVELS - 1)).astype(np.float32)


def linear_error(contrast: float) -> float:
    """Return how far a linear value may be off where neighbouring texels differ by ``contrast`` at most."""
    return contrast * 2 / _SUBTEXELS + 1 / (LEVELS - 1)


class PackedSampler:
    """Looks coordinates up in a packable texture, in memory of its own.

    Parameters
    ----------
    texture : Texture
    texture_filter, wrap : str
        Names of methods of these families: ``bilinear`` or ``nearest``.
    level_bytes : (8192,) uint8 array, optional
        The byte that is shown for each of `linear_levels`: sRGB, or linear. ``None``: the texture is one of bytes
        (`has_bytes`), and these are mixed.
    """

    def __init__(self, texture: Texture, texture_filter: str, wrap: str, level_bytes: Bytes | None) -> None:
        self._packed = pack_bytes(texture) if level_bytes is None else pack(texture)
        self._write_means = {"bilinear": self._write_bilinear, "nearest": self._write_nearest}[texture_filter]
        self._wrap: Callable[[Wholes, int], Wholes] = table.get("wrap", wrap).function
        self._is_clamped, self._is_repeated = wrap == "clamp", wrap == "repeat"
        self._byte_words: list[Words] = []
        if level_bytes is not None:
            self._byte_words = [level_bytes.astype(np.uint32) << np.uint32(8 * place) for place in range(3)]
        self._means, self._product, self._factor = np.empty((3, BLOCK), np.uint64)
        self._index = np.empty(BLOCK, np.int64)
        self._texel, self._weight = np.empty((2, BLOCK), np.int32)
        self._byte = np.empty(BLOCK, np.uint32)

    def write_words(self, u: Coordinates, v: Coordinates, words: Words) -> None:
        """Write the colours at texture coordinates as the words of four bytes, 0xAABBGGRR; alpha is 255.

        Parameters
        ----------
        u, v : (F,) float32 or float64 arrays
            (0, 0) is the bottom left corner, (1, 1) the top right one; NaN reads as 0.
        words : (F,) uint32 array
            Is written.
        """
        for start in range(0, len(u), BLOCK):
            part = slice(start, start + BLOCK)
            means = self._means[: len(u[part])]
            self._write_means(u[part], v[part], means)
            self._write_bytes(means, words[part])

    def _write_nearest(self, u: Coordinates, v: Coordinates, means: Fields) -> None:
        """Write the texels at (F,) coordinates, times 256 as all means are."""
        column = self._wrap(self._subtexel(u, self._packed.width, 0.0) >> 8, self._packed.width)
        row = self._wrap(self._subtexel(v, self._packed.height, 0.0) >> 8, self._packed.height)
        self._read(row * self._packed.width, column, means)
        means *= _SUBTEXELS

    def _write_bilinear(self, u: Coordinates, v: Coordinates, means: Fields) -> None:
        """Write the weighted sums of the four texels around (F,) coordinates; the weights add up to 256."""
        left, right, across = self._neighbours(u, self._packed.width)
        bottom, top, up = self._neighbours(v, self._packed.height)
        bottom, top = bottom * self._packed.width, top * self._packed.width
        # The four weights follow from those of the axes and their product, which is rounded.
        both = across * up
        both += _SUBTEXELS // 2
        both >>= 8
        product, weight = self._product[: len(u)], self._weight[: len(u)]
        self._read(top, right, means)
        self._weigh(means, both)
        self._read(bottom, right, product)
        means += self._weigh(product, np.subtract(across, both, out=weight))
        self._read(top, left, product)
        means += self._weigh(product, np.subtract(up, both, out=weight))
        self._read(bottom, left, product)
        both -= across
        both -= up
        means += self._weigh(product, np.add(both, _SUBTEXELS, out=weight))

    def _neighbours(self, coordinate: Coordinates, size: int) -> tuple[Wholes, Wholes, Wholes]:
        """Return the texels before and behind (F,) coordinates of an axis, and the weight of the second, 0 to 255."""
        # Half a texel back, from its border to its centre, and half a unit on, so that rounding down is to the nearest.
        index = self._subtexel(coordinate, size, 0.5 - _SUBTEXELS / 2)
        weight = index & (_SUBTEXELS - 1)
        index >>= 8
        following = index + 1
        if self._is_repeated and size & (size - 1) == 0:
            index &= size - 1
            following &= size - 1
            return index, following, weight
        if index.min() >= 0 and index.max() < size - 1:
            return index, following, weight
        return self._wrap(index, size), self._wrap(following, size), weight

    def _subtexel(self, coordinate: Coordinates, size: int, offset: float) -> Wholes:
        """Return (F,) coordinates of an axis in 1/256 of a texel, moved by ``offset`` of these and rounded down."""
        limit = _FARTHEST / (size * _SUBTEXELS)
        if not (coordinate.min() >= -limit and coordinate.max() <= limit):
            coordinate = self._brought_near(coordinate, limit)
        position = coordinate * (size * _SUBTEXELS)
        position += offset
        np.floor(position, out=position)
        return position.astype(np.int32)

    def _brought_near(self, coordinate: Coordinates, limit: float) -> Coordinates:
        """Return (F,) coordinates of which those beyond ``limit`` are moved to where the texels are the same.

        That is a whole number of periods nearer, or to the border of the texture. NaN is 0.
        """
        defined = np.nan_to_num(coordinate, nan=0.0)
        near = np.clip(defined, -1, 2) if self._is_clamped else np.remainder(defined, 2)
        return np.where(np.abs(defined) <= limit, defined, near)

    def _read(self, row_start: Wholes, column: Wholes, texels: Fields) -> None:
        """Write the words of ``texels`` (F,) at columns of rows that begin at ``row_start``."""
        texel, index = self._texel[: len(column)], self._index[: len(column)]
        np.add(row_start, column, out=texel)
        np.copyto(index, texel)
        self._packed.texels.take(index, out=texels, mode="clip")

    def _weigh(self, texels: Fields, weight: Wholes) -> Fields:
        """Multiply all fields of ``texels`` (F,) by their weights, and return them."""
        factor = self._factor[: len(weight)]
        np.copyto(factor, weight, casting="unsafe")
        texels *= factor
        return texels

    def _write_bytes(self, means: Fields, words: Words) -> None:
        """Turn weighted sums (F,) into words of bytes."""
        if not self._byte_words:
            means += _HALF
            let_meet(means, means, words)
            return
        byte, index = self._byte[: len(means)], self._index[: len(means)]
        words[:] = OPAQUE
        for place, byte_word in enumerate(self._byte_words):
            np.right_shift(means, _FIELD * place + 8, out=index.view(np.uint64))
            index &= LEVELS - 1
            words |= byte_word.take(index, out=byte, mode="clip")
