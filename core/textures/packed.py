"""Textures packed for the display: the channels of a texel in one word, found by the texels' place, mixed in integers.

A picture whose fragments show nothing but a texture needs no more than a byte per channel. So a texel becomes one
64-bit word of three fields of 21 bits, each with 13 bits of linear colour; times a weight of 8 bits no field
overflows, and a bilinear mean works on red, green and blue together. Weights of 8 bits are what graphics processors
have.

With weights s across and t up, in 256ths, the mean of the texels A, B (right of it), C (above) and D is

    (256 - s - t + st) A + (s - st) B + (t - st) C + st D  =  256 A + s (B - A) + t (C - A) + st (A - B - C + D)

and the four words on the right depend on the place of A alone: they are kept, as a table that knows what lies
beyond the border too. So there is one index for a fragment, and the differences may be negative: words are added
modulo 2^64, and the sum, whose fields are not negative, comes out right.

How exact it is
---------------
Let c be the largest difference between neighbouring texels around a position. The position is rounded to 1/256 of
a texel (an error of c/256 at most), so is the product of the two weights (c/256), and colours are rounded twice to
1/8191 (half of it each time). So a linear value is at most ``c / 128 + 1 / 8191`` off, next to what
single-precision coordinates cost. Where a texture is even, or nearest is chosen, a picture file's own bytes
come back unchanged. In sRGB a small linear error shows where a picture is dark: beside a step from black to white a
byte may be off by several, elsewhere by none or one.

References
----------
M. Segal, K. Akeley, The OpenGL Graphics System 4.6, 2022, section 8.14.2 (subtexel precision is the implementation's).
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.methods import table
from core.numeric.planes import FIELDS, OPAQUE, pack_pixels
from core.records.arrays import Floats, Integers, Singles, read_only
from core.scene import Texture

# Where the lower left of the texels around a fragment lies: few places, whatever the coordinate, and so a
# table.


Wholes = NDArray[np.int32]


@dataclass(frozen=True)
class AxisPlaces:
    """The different places that a lower left texel has along one axis, whatever the coordinate."""

    size: int
    """Texels."""
    first: int
    """Texel index of the first place."""
    count: int
    """Places; then they repeat, or the texture has ended."""
    repeats: bool

    def find(self, index: Wholes, place: Wholes) -> None:
        """Write the ``place`` (F,) of texel indices (F,), 0 to count - 1."""
        if not self.repeats:
            np.subtract(index, self.first, out=place)
            np.maximum(place, 0, out=place)
            np.minimum(place, self.count - 1, out=place)
        elif self.count & (self.count - 1):
            np.remainder(index, self.count, out=place)
        else:
            np.bitwise_and(index, self.count - 1, out=place)


PLACES = {
    "repeat": lambda size: AxisPlaces(size, 0, size, True),
    "mirror": lambda size: AxisPlaces(size, 0, 2 * size, True),
    "clamp": lambda size: AxisPlaces(size, -1, size + 1, False),
}
"""By wrap: the places along an axis of so many texels."""


def place_count(shape: tuple[int, ...], wrap: str) -> int:
    """Return at how many places a texture of ``shape`` (h, w, ...) may be looked up, whatever the coordinates."""
    rows, columns = (PLACES[wrap](size).count for size in shape[:2])
    return rows * columns


# Textures packed for the display: all three channels of a texel in one word, mixed in one go, as bytes at
# the end.


Words = NDArray[np.uint32]
Bytes = NDArray[np.uint8]
Coordinates = Floats | Singles

LEVELS = 8192
"""Linear colours that a field can tell apart."""

BLOCK = 32768
"""Fragments that are looked up at once: enough to make the calls cheap, few enough for the processor's cache."""
MOST_TEXELS = 1 << 22
"""Places that a texture may be looked up at: the tables have 32 bytes for each."""

_FIELD = 21
_SUBTEXELS = 256
_HALF = sum(1 << (low + fraction - 1) for low, fraction in FIELDS)
"""Half a byte in each field: cutting off the fraction rounds."""
FARTHEST = 2.0**30
"""Positions in 1/256 of a texel that 32-bit numbers hold with room to spare."""


@dataclass(frozen=True, eq=False)
class PackedTexture:
    """What bilinear means are made of."""

    words: Integers
    """(4 * rows.count * columns.count,) int64: of every place 256 A, B - A, C - A, A - B - C + D, side by side so that
    they come from memory together."""
    columns: AxisPlaces
    rows: AxisPlaces


@lru_cache(maxsize=16)
def is_packable(texture: Texture, wrap: str) -> bool:
    """Return whether a texture has no alpha, nothing brighter than 1 or darker than 0, and tables of bearable size."""
    pixels = texture.pixels
    if wrap not in PLACES or place_count(pixels.shape, wrap) > MOST_TEXELS:
        return False
    return pixels.shape[2] < 4 and bool(pixels.min() >= 0 and pixels.max() <= 1)


@lru_cache(maxsize=16)
def has_bytes(texture: Texture) -> bool:
    """Return whether every linear value of a packable texture is a byte, a 255th."""
    byte = np.rint(texture.pixels * np.float32(255)).astype(np.float32)
    return bool((byte / np.float32(255) == texture.pixels).all())


@lru_cache(maxsize=4)
def pack_bytes(texture: Texture, wrap: str) -> PackedTexture:
    """Return a texture of bytes packed so that means, half a byte more, are words of ``core.numeric.planes``."""
    byte = np.rint(texture.pixels * np.float32(255)).astype(np.int64)
    return _pack(byte, [low + fraction - 8 for low, fraction in FIELDS], _HALF, wrap)


@lru_cache(maxsize=4)
def pack_levels(texture: Texture, wrap: str) -> PackedTexture:
    """Return a texture packed: red in bits 0 to 12, green from bit 21 on, blue from bit 42 on, times 256 in means."""
    level = np.rint(texture.pixels.astype(np.float64) * (LEVELS - 1)).astype(np.int64)
    return _pack(level, [_FIELD * place for place in range(3)], 0, wrap)


def _pack(values: Integers, shifts: list[int], offset: int, wrap: str) -> PackedTexture:
    """Return the tables of texels (h, w, C) whose three channels go to ``shifts``; ``offset`` is added to all means."""
    texels = np.zeros(values.shape[:2], np.int64)
    for place, shift in enumerate(shifts):
        texels |= values[:, :, place % values.shape[2]] << shift
    rows, columns = (PLACES[wrap](size) for size in values.shape[:2])
    wrapped = table.get("wrap", wrap).function

    def lower_and_upper(places: AxisPlaces) -> tuple[Integers, Integers]:
        index = places.first + np.arange(places.count)
        return wrapped(index, places.size), wrapped(index + 1, places.size)

    (bottom, top), (left, right) = lower_and_upper(rows), lower_and_upper(columns)
    a, b, c, d = (texels[row][:, column] for row in (bottom, top) for column in (left, right))
    words = np.stack((a * _SUBTEXELS + offset, b - a, c - a, a - b - c + d), axis=2)
    return PackedTexture(read_only(words.reshape(-1)), columns, rows)


def linear_levels() -> Singles:
    """Return (8192,) float32: the linear value that stands for each level; what lies above it is cut off.

    A mean that is cut off to its level lies half a step higher on average.
    """
    half_step = (_SUBTEXELS - 1) / (2 * _SUBTEXELS)
    return ((np.arange(LEVELS) + half_step) / (LEVELS - 1)).astype(np.float32)


@dataclass(frozen=True)
class SubtexelAxis:
    """How a texture coordinate becomes a position in 1/256 of a texel, whose whole part is taken.

    For means positions count from the centre of the first texel, half a unit on: rounding down is to the nearest.
    """

    scale: float
    offset: float


class PackedSampler:
    """Looks coordinates up in a packable texture, in memory of its own.

    Parameters
    ----------
    texture_filter, wrap : str
        Names of methods of these families: ``bilinear`` or ``nearest``.
    level_bytes : (8192,) uint8 array, optional
        The byte that is shown for each of `linear_levels`: sRGB, or linear. ``None``: the texture is one of bytes
        (`has_bytes`), and these are mixed.
    """

    def __init__(self, texture: Texture, texture_filter: str, wrap: str, level_bytes: Bytes | None) -> None:
        self._packed = (pack_bytes if level_bytes is None else pack_levels)(texture, wrap)
        self._is_bilinear = texture_filter == "bilinear"
        offset = 0.5 - _SUBTEXELS / 2 if self._is_bilinear else 0.0
        columns, rows = self._packed.columns.size, self._packed.rows.size
        self.axes = (SubtexelAxis(columns * _SUBTEXELS, offset), SubtexelAxis(rows * _SUBTEXELS, offset))
        """Of u and of v."""
        self._byte_words: list[Words] = []
        if level_bytes is not None:
            self._byte_words = [level_bytes.astype(np.uint32) << np.uint32(8 * place) for place in range(3)]
        self._memory = {
            np.dtype(kind): np.empty((count, BLOCK), kind)
            for kind, count in ((np.int32, 5), (np.int64, 4), (np.uint32, 1))
        }

    def write_words(self, u: Coordinates, v: Coordinates, words: Words) -> None:
        """Write the colours at texture coordinates as the words of four bytes, 0xAABBGGRR; alpha is 255.

        Parameters
        ----------
        u, v : (F,) float32 or float64 arrays
            (0, 0) is the bottom left corner, (1, 1) the top right one; NaN reads as 0.
        words : (F,) uint32 array
            Is written.
        """
        x, y = (
            axis.scale * self._brought_near(coordinate, axis) + axis.offset
            for coordinate, axis in zip((u, v), self.axes, strict=True)
        )
        self.write_words_at(x, y, words)

    def write_words_at(self, x: Coordinates, y: Coordinates, words: Words) -> None:
        """Write the colours at positions in units of 1/256 of a texel.

        Parameters
        ----------
        x, y : (F,) float32 or float64 arrays
            ``scale * coordinate + offset`` of `axes`, none of them beyond `FARTHEST`; used up.
        words : (F,) uint32 array
            Is written.
        """
        for start in range(0, len(x), BLOCK):
            part = slice(start, start + BLOCK)
            column, row = self._rows(np.int32, len(x[part]))[:2]
            for position, subtexel in ((x[part], column), (y[part], row)):
                np.floor(position, out=position)
                np.copyto(subtexel, position, casting="unsafe")
            self._write_bytes(self._means(column, row), words[part])

    def _rows(self, kind: Any, count: int) -> NDArray[Any]:
        """Return the memory for numbers of a type, cut to ``count``."""
        return self._memory[np.dtype(kind)][:, :count]

    def _means(self, column: Wholes, row: Wholes) -> Integers:
        """Return the means of the texels around positions (F,) in 256ths, or the texels they lie in, as words.

        Words are those of texels times 256; the positions are used up.
        """
        across, up, place = self._rows(np.int32, len(column))[2:]
        mean: Integers
        index, mean, part, factor = self._rows(np.int64, len(column))
        packed = self._packed
        if self._is_bilinear:
            np.bitwise_and(column, _SUBTEXELS - 1, out=across)
            np.bitwise_and(row, _SUBTEXELS - 1, out=up)
        column >>= 8
        row >>= 8
        packed.rows.find(row, place)
        place *= packed.columns.count
        packed.columns.find(column, row)
        place += row
        place *= 4
        np.copyto(index, place)

        packed.words.take(index, out=mean, mode="clip")
        if not self._is_bilinear:
            return mean
        for kind, weight in enumerate((across, up), start=1):
            packed.words[kind:].take(index, out=part, mode="clip")
            np.copyto(factor, weight)
            part *= factor
            mean += part
        across *= up
        across += _SUBTEXELS // 2
        across >>= 8
        packed.words[3:].take(index, out=part, mode="clip")
        np.copyto(factor, across)
        part *= factor
        mean += part
        return mean

    def _brought_near(self, coordinate: Coordinates, axis: SubtexelAxis) -> Coordinates:
        """Return (F,) coordinates of which those too far away are moved to where the texels are the same.

        That is a whole number of periods nearer, or to the border of the texture. NaN is 0.
        """
        limit = FARTHEST / axis.scale
        if coordinate.min(initial=0) >= -limit and coordinate.max(initial=0) <= limit:
            return coordinate
        defined = np.nan_to_num(coordinate, nan=0.0)
        near = np.clip(defined, -1, 2) if not self._packed.columns.repeats else np.remainder(defined, 2)
        return np.where(np.abs(defined) <= limit, defined, near)

    def _write_bytes(self, means: Integers, words: Words) -> None:
        """Turn weighted sums (F,) into words of bytes."""
        if not self._byte_words:
            pack_pixels(means.view(np.uint64), means.view(np.uint64), words)
            return
        (byte,), index = self._rows(np.uint32, len(means)), self._rows(np.int64, len(means))[0]
        words[:] = OPAQUE
        for place, byte_word in enumerate(self._byte_words):
            np.right_shift(means.view(np.uint64), _FIELD * place + 8, out=index.view(np.uint64))
            index &= LEVELS - 1
            words |= byte_word.take(index, out=byte, mode="clip")
