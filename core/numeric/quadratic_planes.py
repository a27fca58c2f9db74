"""Quadratic functions over the window in whole numbers: exact however they are evaluated, several in one word.

A quadratic has a second difference that is the same everywhere, so it is walked pixel by pixel with two additions: the
step, and what the step changes by. Whole numbers wrap at 2^64 without losing anything, as in
``core.numeric.integer_planes``.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.records.arrays import Floats, Integers


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
