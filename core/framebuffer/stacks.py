"""Fragments stacked on their pixels: what has to be done in drawing order is done one layer after another.

A layer has at most one fragment of a pixel: the first of every pixel, the second, and so on. So it can be tested and
blended as one array, and the result is that of drawing the fragments one by one.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.numeric.sorting import largest_first, radix_order
from core.records.arrays import Integers


@dataclass(frozen=True, eq=False)
class PixelStacks:
    """F fragments on the U pixels that they fall on."""

    fragment: Integers
    """(F,) int64, index of the fragments, pixel by pixel, in drawing order on each."""
    pixel: Integers
    """(U,) int64, the pixels; those with most fragments first."""
    bottom: Integers
    """(U,) int64, place in ``fragment`` of the first fragment of each pixel."""
    higher: list[int]
    """Element k: how many pixels have more than k fragments."""

    def layers(self) -> Iterator[tuple[int, Integers]]:
        """Yield from the bottom up: n, and for the first n pixels their fragment (n,) in this layer."""
        for layer, count in enumerate(self.higher):
            yield count, self.fragment.take(self.bottom[:count] + layer)


def stack_fragments(pixel: Integers) -> PixelStacks:
    """Stack fragments on pixels (F,) int64, which are given in drawing order."""
    order = radix_order(pixel)
    return stacks_of(pixel.take(order), order)


def stacks_of(pixel: Integers, fragment: Integers) -> PixelStacks:
    """Return the stacks of fragments (F,) that are sorted by pixel (F,), then by drawing order."""
    begins = np.empty(len(pixel), bool)
    begins[:1] = True
    np.not_equal(pixel[1:], pixel[:-1], out=begins[1:])
    bottom = np.flatnonzero(begins)
    height = np.diff(bottom, append=len(pixel))
    order, higher = largest_first(height)
    bottom = bottom.take(order)
    return PixelStacks(fragment, pixel.take(bottom), bottom, higher)
