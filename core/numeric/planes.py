"""Functions over the window in whole numbers, exact however they are evaluated: planes, quadratics, bytes in words.

A plane through the values at a triangle's corners is rounded to whole numbers: a step per column, a step per row, and
the value at the pixel of corner 0, from where it is carried to column 0, row 0 without rounding. Whole numbers wrap at
2^64 without losing anything, so ``origin + column * across + row * up`` is exact wherever the value itself fits.

A quadratic has a second difference that is the same everywhere, so it is walked pixel by pixel with two additions: the
step, and what the step changes by. Whole numbers wrap at 2^64 without losing anything, as in
``core.numeric.planes``.

A word has blue at bits 40 to 63 as 8.16 in fixed point, red at 20 to 39 and green at 0 to 19 as 8.12. Three
operations make a pixel of it: mask the three bytes, multiply so that they meet at bit 40, shift. In this order what the
product puts elsewhere lies below bit 40 or beyond bit 63.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Floats, Integers

# Planes over the window in whole numbers: exact however they are evaluated, several of them in one word.


@dataclass(frozen=True, eq=False)
class IntegerPlanes:
    """Whole numbers of P triangles over the window."""

    origin: Integers
    """(P,) int64, value at column 0, row 0 (modulo 2^64)."""
    across: Integers
    """(P,) int64, change per column."""
    up: Integers
    """(P,) int64, change per row."""

    def part(self, first: int, end: int) -> "IntegerPlanes":
        """Return the planes of triangles ``first`` to ``end``."""
        at = slice(first, end)
        return IntegerPlanes(self.origin[at], self.across[at], self.up[at])

    def at(self, triangle: Integers, column: Integers, row: Integers) -> Integers:
        """Return the values (F,) int64 of triangles (F,) at pixels."""
        value, change = self.origin.take(triangle), self.across.take(triangle)
        change *= column
        value += change
        self.up.take(triangle, out=change, mode="clip")
        change *= row
        value += change
        return value


class FieldPlane(NamedTuple):
    """What one field of a word holds, in its own units: (P,) float64 each."""

    value: Floats
    """At corner 0."""
    across: Floats
    up: Floats
    shift: int
    """Lowest bit of the field in the word."""


def window_slopes(
    x: Floats, y: Floats, doubled_area: Floats, first: Floats, second: Floats, third: Floats
) -> tuple[Floats, Floats]:
    """Return the change per column and per row of planes through values at the corners.

    Parameters
    ----------
    x, y : (3, P) float64
        Snapped window coordinates of the corners.
    doubled_area : (P,) float64
    first, second, third : (P,) or (k, P) float64
        Values at the corners.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        share = 1 / doubled_area
        dx1, dy1, dx2, dy2 = (side * share for side in (x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]))
        rise1, rise2 = second - first, third - first
        across = rise1 * dy2
        across -= rise2 * dy1
        rise2 *= dx1
        rise1 *= dx2
        rise2 -= rise1
        return across, rise2


def integer_planes(x: Floats, y: Floats, center: float, fields: Sequence[FieldPlane]) -> IntegerPlanes:
    """Round planes to whole numbers, and put those of all ``fields`` side by side in one word.

    Parameters
    ----------
    x, y : (P,) float64
        Snapped window coordinates of corner 0.
    center : float
        Offset of a pixel's centre.
    fields : sequence of FieldPlane
        Steps below 2^62 in size.
    """
    column, row = np.floor(x), np.floor(y)
    right, above = column + center - x, row + center - y
    origin, across, up = np.zeros((3, len(x)), np.int64)
    for field in fields:
        step, rise = np.rint(field.across), np.rint(field.up)
        at_pixel = np.rint(field.value + (right * step + above * rise))
        for word, values in ((origin, at_pixel), (across, step), (up, rise)):
            word += values.astype(np.int64) << field.shift
    origin -= column.astype(np.int64) * across
    origin -= row.astype(np.int64) * up
    return IntegerPlanes(origin, across, up)


# Quadratic functions over the window in whole numbers: exact however they are evaluated, several in one
# word.


class Quadratic(NamedTuple):
    """value + across i + up j + bend i (i - 1) / 2 + twist i j + arch j (j - 1) / 2, i columns and j rows from a pixel.

    (P,) float64 each, in the units of a field.
    """

    value: Floats
    across: Floats
    up: Floats
    bend: Floats
    twist: Floats
    arch: Floats


@dataclass(frozen=True, eq=False)
class QuadraticPlanes:
    """Whole numbers of P triangles over the window."""

    origin: Integers
    """(P,) int64, value at column 0, row 0 (modulo 2^64)."""
    across: Integers
    """(P,) int64, change from column 0 to column 1 in row 0."""
    up: Integers
    """(P,) int64, change from row 0 to row 1 in column 0."""
    bend: Integers
    """(P,) int64, what the change per column grows by from column to column."""
    twist: Integers
    """(P,) int64, what the change per column grows by from row to row."""
    arch: Integers
    """(P,) int64, what the change per row grows by from row to row."""

    @property
    def words(self) -> tuple[Integers, ...]:
        """All six, in their order."""
        return self.origin, self.across, self.up, self.bend, self.twist, self.arch

    def part(self, first: int, end: int) -> "QuadraticPlanes":
        """Return the planes of triangles ``first`` to ``end``."""
        return QuadraticPlanes(*(word[first:end] for word in self.words))

    def at(self, triangle: Integers, column: Integers, row: Integers) -> tuple[Integers, Integers]:
        """Return the values (F,) int64 of triangles (F,) at pixels, and their changes to the next column."""
        bend, twist = self.bend.take(triangle), self.twist.take(triangle)
        step = self.across.take(triangle) + row * twist
        value = self.origin.take(triangle) + row * self.up.take(triangle)
        value += (row * (row - 1) >> 1) * self.arch.take(triangle)
        value += column * step + (column * (column - 1) >> 1) * bend
        step += column * bend
        return value, step


def quadratic_planes(
    column: Integers, row: Integers, fields: Iterable[tuple[Quadratic, int]]
) -> QuadraticPlanes:
    """Round quadratics to whole numbers, and put those of all ``fields`` side by side in one word.

    Parameters
    ----------
    column, row : (P,) int64
        The pixels that they are counted from.
    fields : iterable of (Quadratic, int)
        Each with the lowest bit of its field in the word.
    """
    words = np.zeros((6, len(column)), np.int64)
    for quadratic, shift in fields:
        for word, of_field in zip(words, quadratic, strict=True):
            word += np.rint(of_field).astype(np.int64) << shift
    value, across, up, bend, twist, arch = words
    value -= column * across + row * up
    value += (column * (column + 1) >> 1) * bend + column * row * twist + (row * (row + 1) >> 1) * arch
    across -= column * bend + row * twist
    up -= row * arch + column * twist
    return QuadraticPlanes(value, across, up, bend, twist, arch)


# Three bytes in one 64-bit word with room for fractions between them, and how they meet in a pixel.


Words = NDArray[np.uint32]

FIELDS = ((20, 12), (0, 12), (40, 16))
"""Lowest bit, and bits of the fraction, of red, green and blue."""
OPAQUE = np.uint32(0xFF000000)
"""A pixel with alpha 255 and no colour."""
DRIFT = 2.0**-13
"""Bytes that a value is off at most after one step: half of the last bit of the shortest fraction."""
_INTEGER_BITS = np.uint64(0xFF << 12 | 0xFF << 32 | 0xFF << 56)
_MEETING = np.uint64(1 + (1 << 8) + (1 << 36))
_SHIFT = np.uint64(40)


def pack_pixels(words: NDArray[np.uint64], wide: NDArray[np.uint64], pixels: NDArray[np.uint32]) -> None:
    """Write the whole parts of ``words`` (F,) as opaque ``pixels`` (F,); ``wide`` (F,) is memory, or ``words``."""
    np.bitwise_and(words, _INTEGER_BITS, out=wide)
    wide *= _MEETING
    wide >>= _SHIFT
    np.copyto(pixels, wide, casting="unsafe")
    pixels |= OPAQUE


def unpack(word: Integers, scratch: ScratchBuffers) -> Words:
    """Return words (F,) as opaque pixels (F,) uint32; each has half a byte more, so that cutting off rounds."""
    pixels: Words = scratch("unpacked_pixels", len(word), dtype=np.uint32)
    pack_pixels(word.view(np.uint64), scratch("unpacked", len(word), dtype=np.uint64), pixels)
    return pixels


def pack_level(pixels: Words) -> Integers:
    """Return the words (P,) int64 that `unpack` turns into ``pixels`` (P,), whatever their alpha."""
    words = np.zeros(len(pixels), np.int64)
    for channel, (shift, bits) in enumerate(FIELDS):
        byte = (pixels.astype(np.int64) >> 8 * channel) & 0xFF
        words += byte << (shift + bits)
    return words
