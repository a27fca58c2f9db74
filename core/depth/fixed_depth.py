"""Depth in whole numbers of 2^-38, on integer planes: what packed words can carry, and keys with a triangle's number.

For a triangle the stored depth is ``origin + column * across + row * up``, all whole numbers, of the plane through its
corners *as snapped*, so that it never leaves the range of its corners' depths by more than rounding. It is a pure
function of triangle and pixel, the same however it is evaluated; integers wrap without loss.

Accuracy
--------
Slopes are rounded to 2^-39, so the error is at most (1 + columns + rows) 2^-39 for pixels that many columns and rows
from corner 0: below 2^-27 in a triangle of 2,048 pixels, an eighth of the spacing of float32 at 1.

A triangle that has no such plane gets its depth rounded pixel by pixel: a corner that cannot be snapped, one before
the near or behind the far plane, or a slope with terms of more than ``SLOPE_LIMIT`` a pixel.
"""

from dataclasses import dataclass

import numpy as np

from core.depth.depth import WINDOW_DEPTH, DepthFormat, Stored
from core.methods import method
from core.numeric.planes import FieldPlane, IntegerPlanes, integer_planes
from core.records.arrays import Flags, Floats, Integers

# Depth in whole numbers of 2^-38, on integer planes: what packed words can carry.


DEPTH_BITS = 38
SCALE = 2.0**DEPTH_BITS
SLACK = 1 << 20
"""How far rounding may take a depth out of 0 to 2^38; added to keys so that they are never negative."""
LEAST, GREATEST = -SLACK, (1 << DEPTH_BITS) + SLACK
"""Range of the depths on a plane: only fills and number formats that cover pixels outside a triangle reach its ends."""
UNDEFINED = (1 << (DEPTH_BITS + 1)) - 1
"""Key of a depth that is no number: farther than everything."""
SLOPE_LIMIT = 2.0**10
"""Depth a pixel, of each of the two terms of a slope: beyond belong to triangles seen edge-on, where the slope is
rounding; up to it the terms are within 2^-41."""


@dataclass(frozen=True, eq=False)
class FixedPlanes:
    """Stored depth of P triangles over the window."""

    planes: IntegerPlanes
    is_linear: Flags
    """(P,) bool, where the plane holds; elsewhere depth is rounded pixel by pixel."""

    def at(self, primitive: Integers, column: Integers, row: Integers) -> Floats:
        """Return the depths (F,) on the planes of primitives at pixels, ``LEAST`` to ``GREATEST``."""
        depth = self.planes.at(primitive, column, row)
        return np.clip(depth, LEAST, GREATEST).astype(np.float64)


def set_up_fixed_planes(
    x: Floats, y: Floats, depth: Floats, doubled_area: Floats, is_in_range: Flags, center: float
) -> FixedPlanes:
    """Return the planes of P triangles.

    Parameters
    ----------
    x, y : (3, P) float64
        Snapped window coordinates; NaN where a corner has none.
    depth : (3, P) float64
        Window depth of the corners.
    doubled_area : (P,) float64
    is_in_range : (P,) bool
        Every corner lies between the near and the far plane.
    center : float
        Offset of a pixel's centre.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        dx1, dx2, dy1, dy2 = x[1] - x[0], x[2] - x[0], y[1] - y[0], y[2] - y[0]
        dz1, dz2 = depth[1] - depth[0], depth[2] - depth[0]
        unit = SCALE / doubled_area
        right, left, above, below = dz1 * dy2, dz2 * dy1, dz2 * dx1, dz1 * dx2
        across, up = (right - left) * unit, (above - below) * unit
        # The terms, not only their differences: what cancels leaves its rounding.
        steepest = np.maximum(np.abs(right), np.abs(left))
        for term in (above, below):
            np.maximum(steepest, np.abs(term), out=steepest)
        is_linear = (steepest * np.abs(unit) <= SLOPE_LIMIT * SCALE) & is_in_range
    x, y, value = x[0], y[0], depth[0] * SCALE
    if not is_linear.all():
        x, y, value, across, up = (np.where(is_linear, of, 0) for of in (x, y, value, across, up))
    return FixedPlanes(integer_planes(x, y, center, [FieldPlane(value, across, up, 0)]), is_linear)


class FixedDepth(DepthFormat):
    """Depth in whole numbers, kept in float64, which holds them exactly."""

    stored_type = np.float64
    nearness_bits = 39
    is_planar = True

    def nearness_key(self, stored: Stored) -> Integers:
        """Return (F,) int64 keys, 0 or more, of depths from ``LEAST`` to ``GREATEST``."""
        undefined = np.isnan(stored)
        key: Integers = np.where(undefined, 0, stored).astype(np.int64) + SLACK
        key[undefined] = UNDEFINED
        return key

    def stored_of_key(self, key: Integers) -> Stored:
        """Return the stored values (F,) float64 of keys."""
        stored = np.subtract(key, SLACK, dtype=np.float64)
        undefined = key == UNDEFINED
        if undefined.any():
            stored[undefined] = np.nan
        return stored


def in_units(depth: Floats) -> Floats:
    """Round depths (F,) to whole numbers of 2^-38."""
    with np.errstate(invalid="ignore"):
        return np.rint(depth * SCALE)


@method(
    "depth",
    "fixed-38",
    "z on integer planes, 38 bits",
    source="OpenGL 4.6, DEPTH_COMPONENT32; planes through snapped corners as in Mesa's rasterizers",
    exact_for="depth order, to 2^-27 of z in triangles of up to 2,048 pixels, the same at every z",
    breaks_where="more than 16 million triangles. Surfaces closer to each other than 2^-27 of z: far from the eye "
    "z crowds towards 1, though farther away than with 24 bits",
)
def fixed_38() -> DepthFormat:
    """Store the window depth in units of 2^-38."""
    description = "Window depth z in steps of 2⁻³⁸, 2³⁸ of them where cleared: smaller is nearer."
    return FixedDepth(WINDOW_DEPTH, description, SCALE, False, in_units, SCALE, "× 2⁻³⁸")


# Listings of the depth test on packed keys: depth above, number of the triangle below, and the least key
# wins.


NUMBER_BITS = 24
"""Bits of a key that hold the triangle's number plus one; 0 is the empty buffer."""


def packed_depth_test(
    origin: int, across: int, up: int, column: int, row: int, number: int, old: int
) -> tuple[int, bool]:
    """Listing of the test where depth is an integer plane; ``old`` is the key in the buffer."""
    depth = min(max(origin + column * across + row * up, LEAST), GREATEST)  #: depth
    key = ((depth + SLACK) << NUMBER_BITS) | (number + 1)  #: key
    passes = key < old  #: minimum
    return min(key, old), passes  #: store


def rounded_depth_test(z: float, number: int, old: int, writes: bool = True) -> tuple[int, bool]:
    """Listing of the test where a triangle or line has no such plane: z in [0, 1] is rounded at every pixel."""
    depth = round(z * SCALE)  #: depth
    key = ((depth + SLACK) << NUMBER_BITS) | (number + 1)  #: key
    passes = key < old  #: minimum
    return min(key, old) if writes else old, passes  #: store
