"""Planes over the window in whole numbers: exact however they are evaluated, several of them in one word.

A plane through the values at a triangle's corners is rounded to whole numbers: a step per column, a step per row, and
the value at the pixel of corner 0, from where it is carried to column 0, row 0 without rounding. Whole numbers wrap at
2^64 without losing anything, so ``origin + column * across + row * up`` is exact wherever the value itself fits.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.records.arrays import Floats, Integers


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
