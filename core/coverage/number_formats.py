"""The numbers that edge functions are computed in: what one can be, and its bits.

A number format is a method of the family ``coverage``. It puts corners on its grid or leaves them where they are,
sets the edge functions up, and turns pixel centres into its own numbers. From there on the rules are the same for all
of them (``edge_functions``): `a x + (b y + c)`, larger than 0, or 0 and owned. The arrays of coefficients and values
are of the format's own type (float16, int32, whole numbers of any length ...), so every product and every sum is
rounded, or wraps around, as it does in a program that uses this type. What is shown of them is converted to float64
and pixels.

References
----------
IEEE 754-2019. F. Giesen, *Triangle rasterization in practice*, 2013 (how many bits an edge function takes).
D. Goldberg, *What every computer scientist should know about floating-point arithmetic*, 1991.
"""

import re
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.methods import table
from core.records.arrays import Flags, Floats, Integers

# The numbers that edge functions are computed in: what one number can be, and what every operation does to
# it.


FormatValue = NDArray[Any]
"""Numbers of a format, kept in an array of its own type."""
FIRST = np.array([0, 1, 2])
NEXT = np.array([1, 2, 0])
LAST = np.array([2, 0, 1])
"""Corner k itself, and the two that follow it counter-clockwise: the ends of edge k."""


@dataclass(frozen=True, eq=False)
class CornerPositions:
    """Corners of P triangles in the homogeneous window ``D clip``."""

    homogeneous: Floats
    """(P, 3, 3) float64 x, y, w as the vertex stage made them: attributes and depth come from these."""
    window: Floats
    """(P, 3, 2) float64 pixels, before snapping; NaN where w <= 0."""
    decided: Floats
    """(P, 3, 2) pixels that coverage is decided on (snapped); NaN where a corner cannot be projected."""
    is_projected: Flags
    """(P, 3) bool, where ``decided`` holds; elsewhere coverage uses the homogeneous position."""
    clip: Floats
    """(P, 3, 4) float64, what all of these were made from: exact coverage is decided on it."""
    size: tuple[int, int]
    """Width and height of the image in pixels."""
    numbers: "NumberFormat"
    """The numbers that edges are set up in."""
    shift: tuple[float, float] = (0.0, 0.0)
    """By how many pixels all but ``clip`` is moved, multiples of 1/256."""

    def take(self, at: Integers | slice) -> "CornerPositions":
        """Return the corners of the triangles ``at`` (C,)."""
        return replace(
            self,
            homogeneous=self.homogeneous[at],
            window=self.window[at],
            decided=self.decided[at],
            is_projected=self.is_projected[at],
            clip=self.clip[at],
        )

    def moved(self, x: float, y: float) -> "CornerPositions":
        """Return the corners ``x`` and ``y`` pixels further; what is snapped moves exactly by multiples of 1/256."""
        way = np.array([x, y])
        homogeneous = self.homogeneous.copy()
        homogeneous[..., :2] += way * self.homogeneous[..., 2:]
        return replace(
            self,
            homogeneous=homogeneous,
            window=self.window + way,
            decided=self.decided + way,
            shift=(self.shift[0] + x, self.shift[1] + y),
        )


class Coefficients(NamedTuple):
    """Edge functions of P triangles, inside positive, as a format holds them."""

    numbers: "NumberFormat"
    """The format, fitted to these triangles."""
    a: FormatValue
    """(P, 3)."""
    b: FormatValue
    c: FormatValue
    doubled_area: Floats
    """(P,) float64, twice the signed area or the determinant as the format sees it; 0: nothing is drawn."""


@dataclass(frozen=True)
class NumberFormat:
    """One kind of numbers, and how corners become edge functions in it."""

    name: str
    held_as: Any
    """Type of the arrays, as ``numpy.float16``."""
    corner_kind: str
    """What happens to a corner first: ``snapped``, ``homogeneous`` (left alone) or ``rounded`` to the format."""
    rounding: str
    """``exact`` (as far as is promised), ``rounded`` (to nearest after each operation) or ``wrapped`` (modulo 2^n)."""
    value_layout: str
    """What `bit_pattern` calls the value of an edge function; empty: it has no fixed length."""
    suits_spans: bool = False
    """Whether closed-form spans give its pixels: values are monotone along rows and computed in float64."""
    bounds_outward: bool = False
    """Whether the box of a triangle is rounded outward to whole pixels, since its corners are not on a grid."""
    divides: bool = False
    """Whether edges are rows of an inverse matrix, divided by a determinant."""
    is_whole: bool = False
    """Whether values are whole numbers: as long as they fit, none is rounded."""
    slope_exponent: int = 0
    """Power of two that one unit of a and b is worth, in value per pixel."""
    value_exponent: int = 0
    """The same of c and of the value."""
    area_exponent: int = 0

    def place(self, window: Floats) -> tuple[Floats, Flags]:
        """Return positions (P, 3, 2) on the format's grid, and where (P, 3) bool there are any.

        There are none unless the format says so: coverage uses the homogeneous positions then.
        """
        return np.full(window.shape, np.nan), np.zeros(window.shape[:-1], bool)

    def held_corners(self, corners: CornerPositions) -> tuple[FormatValue, FormatValue, FormatValue]:
        """Return x, y, w (3, P) of the corners in the format's own units."""
        x, y, w = corners.homogeneous.transpose(2, 1, 0)
        return x.astype(self.held_as), y.astype(self.held_as), w.astype(self.held_as)

    def shown_ends(self, corners: CornerPositions) -> Floats:
        """Return (P, 3, 3) float64 the corners as edges see them: (x, y, 1) on the grid, else (x, y, w)."""
        snapped = np.concatenate([corners.decided, np.ones((*corners.decided.shape[:2], 1))], axis=2)
        return np.where(corners.is_projected[..., None], snapped, corners.homogeneous)

    def set_up(self, corners: CornerPositions) -> Coefficients:
        """Return the edge functions of P triangles: cross products of the corners (P, 3, 3), turned inward.

        What overflows becomes infinite or NaN in floats, and comparisons with NaN are false: nothing is drawn.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            x, y, w = self.held_corners(corners)
            a, b, c = cross(x[NEXT], y[NEXT], w[NEXT], x[LAST], y[LAST], w[LAST])
            area = x[0] * a[0] + y[0] * b[0] + w[0] * c[0]
            sign = np.sign(area)
            shown = self.shown(area, self.area_exponent)
            return Coefficients(self, (sign * a).T, (sign * b).T, (sign * c).T, shown)

    def of_pixels(self, position: Floats) -> FormatValue:
        """Return x or y of pixel centres, any shape, in the format's own units."""
        if self.held_as is np.float64:
            return position
        return position.astype(self.held_as)

    def shown(self, held: FormatValue, exponent: int) -> Floats:
        """Return numbers of any shape as float64, in pixels; ``exponent`` is what one unit is worth."""
        if held.dtype == np.float64:
            return held
        return np.ldexp(held.astype(np.float64), exponent)

    def shown_values(self, held: FormatValue) -> Floats:
        """Return values of edge functions, any shape, as float64."""
        return self.shown(held, self.value_exponent)

    def spacing(self, size: Floats) -> Floats:
        """Return the units in the last place of numbers of this size, any shape."""
        with np.errstate(over="ignore", invalid="ignore"):
            return np.spacing(size)

    def scaled(self, slope: int, value: int, area: int) -> "NumberFormat":
        """Return the same format with other units."""
        return replace(self, slope_exponent=slope, value_exponent=value, area_exponent=area)


def cross(x1: Any, y1: Any, w1: Any, x2: Any, y2: Any, w2: Any) -> tuple[Any, Any, Any]:
    """Return the cross products (3, P) of (x1, y1, w1) and (x2, y2, w2): lines through two homogeneous points.

    Every product and sum is one of the numbers' own type.
    """
    return y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2


def number_format(coverage: str) -> NumberFormat:
    """Return the number format that a method of the family ``coverage`` computes in."""
    found: NumberFormat = table.get("coverage", coverage).function()
    return found


# The bits of a number in its format, field by field, as they stand in memory from the highest to the
# lowest.


FLOATS = {
    "float16": (np.float16, np.uint16, 5, 10),
    "float32": (np.float32, np.uint32, 8, 23),
    "float64": (np.float64, np.uint64, 11, 52),
}
"""Name of a floating-point format to its type, an integer of the same size, and the bits of exponent and fraction."""
FIXED = re.compile(r"fixed-(?P<whole>\d+)\.(?P<fraction>\d+)")


def bit_pattern(value: float, layout: str) -> str:
    """Return the bits of a number, its fields apart.

    Parameters
    ----------
    value : float
        It is rounded to the format first, as storing it would do.
    layout : str
        ``float16``, ``float32``, ``float64``: sign, exponent, fraction; or ``fixed-n.m``: two's complement, n bits
        before the point and m behind it, where what does not fit wraps around.

    Raises
    ------
    ValueError
        For another layout, or a number that is not finite in fixed point.

    Examples
    --------
    >>> bit_pattern(-1.5, "float16")
    '1 01111 1000000000'
    >>> bit_pattern(-0.5, "fixed-4.4")
    '1111.1000'
    """
    if layout in FLOATS:
        number, integer, exponent_bits, fraction_bits = FLOATS[layout]
        with np.errstate(over="ignore"):
            bits = int(np.array(value, number).view(integer))
        text = f"{bits:0{1 + exponent_bits + fraction_bits}b}"
        return f"{text[0]} {text[1 : 1 + exponent_bits]} {text[1 + exponent_bits :]}"
    found = FIXED.fullmatch(layout)
    if found is None:
        raise ValueError(f"layout must be one of {', '.join(FLOATS)} or fixed-n.m, got {layout}")
    if not np.isfinite(value):
        raise ValueError(f"a number in {layout} must be finite, got {value}")
    whole, fraction = int(found["whole"]), int(found["fraction"])
    numerator, denominator = float(value).as_integer_ratio()
    # Half to even, in whole numbers: a float may have more digits than the layout.
    units, rest = divmod(numerator << fraction, denominator)
    units += 2 * rest > denominator or (2 * rest == denominator and units % 2 == 1)
    text = f"{units % (1 << (whole + fraction)):0{whole + fraction}b}"
    return f"{text[:whole]}.{text[whole:]}"
