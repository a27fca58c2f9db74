"""Outcodes: on which side of which plane a vertex lies, one byte a vertex.

A triangle whose corners share a bit is outside that plane as a whole; one whose corners have a bit between them
crosses it, or is outside. So bytes are gathered and joined for a triangle, not six distances of each corner.

References
----------
R. Sproull, I. Sutherland, *A clipping divider*, 1968.
"""

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Floats, Integers

Outcodes = NDArray[np.uint8]

PLANE_BITS = 0b0011_1111
"""Bit k: outside plane k of ``core.geometry.culling.PLANES``, its distance is negative."""
BEHIND_BIT = 0b0100_0000
"""w <= 0: the vertex is not in front of the eye."""
RANGE_BIT = 0b1000_0000
"""Not between the near and the far plane in front of the eye."""


def outcodes(clip: Floats) -> Outcodes:
    """Return the outcodes (M,) uint8 of clip positions (M, 4).

    Notes
    -----
    ``w + z < 0`` is the same as ``z < -w`` in floating point: a sum is rounded to 0 only where it is 0.
    """
    x, y, z, w = clip.T
    farthest = np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z))
    if ((farthest <= w) & (w > 0)).all():
        return np.zeros(len(clip), np.uint8)
    opposite = -w
    is_behind = w <= 0
    is_in_range = (w > 0) & (z >= opposite) & (z <= w)
    flags = (z < opposite, z > w, x < opposite, x > w, y < opposite, y > w, is_behind, ~is_in_range)
    code = np.zeros(len(clip), np.uint8)
    for bit, flag in enumerate(flags):
        code |= flag.view(np.uint8) << np.uint8(bit)
    return code


def shared_bits(code: Outcodes, corner: Integers) -> Outcodes:
    """Return (P,) uint8: the bits that all corners (3, P) of a triangle have."""
    return _of_corners(np.bitwise_and, code, corner)


def joined_bits(code: Outcodes, corner: Integers) -> Outcodes:
    """Return (P,) uint8: the bits that any corner (3, P) of a triangle has."""
    return _of_corners(np.bitwise_or, code, corner)


def _of_corners(combine: np.ufunc, code: Outcodes, corner: Integers) -> Outcodes:
    if not code.any():
        return np.zeros(corner.shape[1], np.uint8)
    first, second, third = (code.take(index) for index in corner)
    combined: Outcodes = combine(combine(first, second), third)
    return combined


def has_bits(code: Outcodes, bits: int) -> Flags:
    """Return (P,) bool: one of ``bits`` is set."""
    found: Flags = (code & np.uint8(bits)) != 0
    return found
