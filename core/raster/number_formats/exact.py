"""Exact edge functions: whole numbers of any length, made from the clip positions as they are.

Every float64 is a whole number times a power of two, so a triangle's corners are whole numbers of a small enough unit,
and so are its edge functions: nothing is rounded, for any signs of w. It is the referee of all formats that do not snap
(those that do have a grid of their own, where ``snapped`` is exact).

Whole numbers of this length cost about a hundred times as much as floats. So a float64 value is looked at first, with
a bound on its error; only where the bound leaves the sign open, the whole numbers decide (`decide_filtered`). The
picture has both, the trace only whole numbers: they decide alike.

References
----------
J. R. Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997 (the filter).
L. Kettner et al., *Classroom examples of robustness problems in geometric computations*, 2008.
"""

from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.raster.edges.snapping import SUBPIXELS
from core.raster.number_formats.number_format import Coefficients, CornerPositions, FormatValue, NumberFormat
from core.records.arrays import Flags, Floats, Integers

MANTISSA_BITS = 53
HALF_STEP_BITS = 7
"""Bits of half a pixel in steps of 1/256 pixel."""
ERROR_BOUND = 2.0**-50
"""Error of a value over the sum of its terms' sizes: of coefficients and three operations, with room to spare."""
SMALLEST = 2.0**-960
"""Sums of terms below this may have lost bits to underflow: the whole numbers decide."""


@dataclass(frozen=True)
class ExactFormat(NumberFormat):
    """Whole numbers of any length; positions are counted in half pixels."""

    def set_up(self, corners: CornerPositions) -> Coefficients:
        """Return the edge functions of P triangles, (P, 3) whole numbers each, in units that suit all corners."""
        shift = unit_shift(corners.clip) + (HALF_STEP_BITS if any(corners.shift) else 0)
        fitted = self.scaled(-2 * shift - 1, -2 * shift - 2, -3 * shift - 2)
        return NumberFormat.set_up(fitted, corners)

    def held_corners(self, corners: CornerPositions) -> tuple[FormatValue, FormatValue, FormatValue]:
        """Return x, y, w (3, P) of the homogeneous window in half pixels: (x + w) width, (y + w) height, w."""
        clip = corners.clip
        is_finite = np.isfinite(clip).all(axis=(1, 2), keepdims=True)
        x, y, w = whole_numbers(np.where(is_finite, clip[..., [0, 1, 3]], 0), unit_shift(clip)).transpose(
            2, 1, 0
        )
        width, height = corners.size
        x, y = (x + w) * width, (y + w) * height
        if not any(corners.shift):
            return x, y, w
        # Twice the position in 1/256 pixel, times w, is a whole number of the unit divided by 2^7.
        moved_x, moved_y = (int(SUBPIXELS * way) for way in corners.shift)
        x, y, unit = (
            (x << HALF_STEP_BITS) + moved_x * w,
            (y << HALF_STEP_BITS) + moved_y * w,
            w << HALF_STEP_BITS,
        )
        return x, y, unit

    def of_pixels(self, position: Floats) -> FormatValue:
        """Return x or y of pixel centres, any shape, in half pixels."""
        return np.asarray(position * 2).astype(np.int64).astype(object)

    def shown(self, held: FormatValue, exponent: int) -> Floats:
        """Return whole numbers of any shape as the nearest float64; what is not 0 stays so."""
        return np.asarray(_nearest_floats(held, exponent), np.float64)


def unit_shift(values: Floats) -> int:
    """Return how often all finite numbers of an array, any shape, must be doubled to be whole."""
    finite = values[np.isfinite(values) & (values != 0)]
    if not finite.size:
        return 0
    _, exponent = np.frexp(finite)
    return int(max(MANTISSA_BITS - exponent.min(), 0))


def whole_numbers(values: Floats, shift: int) -> FormatValue:
    """Return finite ``values`` (any shape) times 2^shift as whole numbers of any length."""
    mantissa, exponent = np.frexp(values)
    whole = np.ldexp(mantissa, MANTISSA_BITS).astype(np.int64).astype(object)
    places = np.where(values == 0, 0, exponent - MANTISSA_BITS + shift).astype(object)
    shifted: FormatValue = np.left_shift(whole, places)
    return shifted


def nearest_float(whole: int, exponent: int) -> float:
    """Return ``whole`` times 2^exponent as the nearest float64; what is not 0 stays so."""
    try:
        value = whole / (1 << -exponent) if exponent < 0 else float(whole << exponent)
    except OverflowError:
        return float(np.copysign(np.inf, 1 if whole > 0 else -1))
    if value == 0 and whole:
        return float(np.copysign(np.finfo(np.float64).smallest_subnormal, 1 if whole > 0 else -1))
    return value


_nearest_floats = np.frompyfunc(nearest_float, 2, 1)


def decide_filtered(
    approximate: tuple[Floats, Floats, Floats],
    exact: tuple[FormatValue, FormatValue, FormatValue],
    owns_tie: Flags,
    run: Integers,
    x: Floats,
    y: Floats,
) -> Flags:
    """Decide on which side of an edge pixel centres (F,) lie, one edge for every of R runs.

    Parameters
    ----------
    approximate : three (R,) float64
        a, b, c as `NumberFormat.shown` gives them.
    exact : three (R,) whole numbers
        The same in the units of the format.
    owns_tie : (R,) bool
    run : (F,) int64
    x, y : (F,) and (R,) float64
    """
    a, b, c = approximate
    with np.errstate(over="ignore", invalid="ignore"):
        slope, row_part = a.take(run), (b * y + c).take(run)
        value = slope * x + row_part
        size = np.abs(slope * x) + (np.abs(b * y) + np.abs(c)).take(run)
        is_sure = (np.abs(value) > ERROR_BOUND * size) & (size > SMALLEST)
    inside: Flags = value > 0
    open_pixels = np.flatnonzero(~is_sure)
    at = run.take(open_pixels)
    a, b, c = (numbers.take(at) for numbers in exact)
    across, up = (
        np.asarray(place * 2).astype(np.int64).astype(object) for place in (x.take(open_pixels), y.take(at))
    )
    decided = a * across + (b * up + c)
    inside[open_pixels] = (decided > 0) | ((decided == 0) & owns_tie.take(at))
    return inside


EXACT = ExactFormat("exact", object, "homogeneous", "exact", "", bounds_outward=True, is_whole=True)


@method(
    "coverage",
    "exact",
    "Not snapped, exact",
    source="J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997",
    exact_for="every triangle in clip space, and every shared edge",
)
def exact() -> NumberFormat:
    """Return whole numbers of any length on the corners as they are."""
    return EXACT
