"""Edge functions: coefficients as an adjugate, values at pixel centres; and exactly, in whole numbers of any length.

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

Edge k lies opposite corner k. Its function is the cross product of the two other corners in the homogeneous
window, ``v1 x v2 = (a, b, c)``; at the pixel (x, y) it is ``a x + b y + c``, which is det times alpha/w. On the
triangle's plane alpha + beta + gamma = 1, so the three add up to det/w. Nothing is divided by w, so corners behind the
eye or at w = 0 need no clipping.

Exactness
---------
*Both ends projected*: snapped corners are multiples of 2^-8 up to 2^16 and pixel centres multiples of 2^-1 up
to 2^14, so a x, b y and c are multiples of 2^-16 below 2^34: every product and sum fits the 53 bits of float64
without rounding. *One end projected*: the edge runs through its snapped corner in the direction that it has before
snapping, in whole numbers that decide every centre as this direction does; again nothing is rounded in its values, and
all edges that meet in a corner pass through it exactly. It lies at most sqrt(2)/512 pixel beside the edge before
snapping (`one_ended` has the proof). *Neither*: IEEE multiplication commutes and subtraction is
antisymmetric, so ``v2 x v1`` is exactly ``-(v1 x v2)``; each coefficient is rounded. In all three cases the two
triangles of an edge see values of equal size and opposite sign: the decision belongs to the edge, not to the triangle,
and a shared edge has neither hole nor double hit. Only a triangle that snapping turns over draws pixels twice, and one
with a corner that is not projected may leave some out (`one_ended`, "The third edge").

*Monotone*: rounding never reverses an order, so the computed value is monotone in the column and in the row. A
block's least and greatest value stand at its corner pixels, and a row's inside pixels are one span: blocks and
spans decide exactly as the test at every pixel does.

References
----------
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997.
M. Zwicker, *Computergrafik*, lecture "Homogeneous rasterization", Bern 2016.
J. Pineda, *A parallel algorithm for polygon rasterization*, 1988.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from core.coverage.number_formats import (
    LAST,
    NEXT,
    Coefficients,
    CornerPositions,
    FormatValue,
    NumberFormat,
    cross,
)
from core.coverage.snapping import SUBPIXELS, anchored_edges, leave_out_turned
from core.methods import method, table
from core.records.arrays import Flags, Floats, Integers, cached_property

# Exact edge functions: whole numbers of any length, made from the clip positions as they are.


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
        x = (x << HALF_STEP_BITS) + moved_x * w
        y = (y << HALF_STEP_BITS) + moved_y * w
        unit = w << HALF_STEP_BITS
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


# Edge functions: coefficients from the 3x3 matrix of (x, y, w) rows as its adjugate, and the inside
# decision.


DETERMINANT_ERROR = 2.0**-48
"""Error of a determinant over the product of its rows' sums of sizes: of its numbers and of all operations."""
BLOCK = 16384
"""Triangles whose corners are gathered at once, so that their numbers stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class EdgeFunctions:
    """Edge functions of P triangles, positive inside, in the numbers that they are evaluated in."""

    a: FormatValue
    """(P, 3) in the format's own type and unit, change per column."""
    b: FormatValue
    """(P, 3), change per row."""
    c: FormatValue
    """(P, 3), value at the window's origin."""
    owns_tie: Flags
    """(P, 3) bool, whether a pixel centre exactly on the edge belongs to the triangle."""
    corners: CornerPositions
    doubled_area: Floats
    """(P,) float64: twice the signed area in pixels where all corners are projected, else the 3x3 determinant."""
    numbers: NumberFormat
    """What kind of numbers a, b, c and the values are."""
    rule: "PixelRule | None" = None
    """What decides on a pixel instead of `is_inside`: an edited listing."""

    def __len__(self) -> int:
        return len(self.a)

    @cached_property
    def shown_a(self) -> Floats:
        """(P, 3) float64, ``a`` per pixel."""
        return self.numbers.shown(self.a, self.numbers.slope_exponent)

    @cached_property
    def shown_b(self) -> Floats:
        """(P, 3) float64, ``b`` per pixel."""
        return self.numbers.shown(self.b, self.numbers.slope_exponent)

    @cached_property
    def shown_c(self) -> Floats:
        """(P, 3) float64, ``c``."""
        return self.numbers.shown_values(self.c)

    def part(self, first: int, end: int) -> "EdgeFunctions":
        """Return the edge functions of triangles ``first`` to ``end``."""
        return self.take(slice(first, end))

    def take(self, at: Integers | slice) -> "EdgeFunctions":
        """Return the edge functions of the triangles ``at`` (C,)."""
        parts = (self.a[at], self.b[at], self.c[at], self.owns_tie[at])
        return EdgeFunctions(*parts, self.corners.take(at), self.doubled_area[at], self.numbers, self.rule)

    def decide(self, primitive: Integers, x: Floats, y: Floats) -> tuple[FormatValue, Flags]:
        """Return the values (Q, 3) of triangles at pixel centres, and on which side (Q, 3) of each edge these lie.

        All three sides hold where a pixel is covered, and only there: of a rule of its own only the whole is known, so
        the edge with the least value stands for it.
        """
        owns_tie = self.owns_tie.take(primitive, axis=0)
        if self.rule is None:
            a, b, c = (part.take(primitive, axis=0) for part in (self.a, self.b, self.c))
            held_x, held_y = (self.numbers.of_pixels(place[:, None]) for place in (x, y))
            with np.errstate(over="ignore", invalid="ignore"):
                values = edge_value(a, b, c, held_x, held_y)
            return values, is_inside(values, owns_tie)
        values, covered = self._by_rule(primitive, x, y)
        sides = is_inside(values, owns_tie) | covered[:, None]
        left_out = np.flatnonzero(sides.all(axis=1) & ~covered)
        sides[left_out, np.argmin(values[left_out], axis=1)] = False
        return values, sides

    def covers(self, primitive: Integers, x: Floats, y: Floats) -> Flags:
        """Return (Q,) bool, whether triangles cover pixel centres: the same decision as that of `decide`."""
        if self.rule is not None:
            return self._by_rule(primitive, x, y)[1]
        sides = self.decide(primitive, x, y)[1]
        return np.asarray(sides[:, 0] & sides[:, 1] & sides[:, 2])

    def _by_rule(self, primitive: Integers, x: Floats, y: Floats) -> tuple[Floats, Flags]:
        assert self.rule is not None
        if self.numbers.held_as is not np.float64:
            raise ValueError(
                f"an edited inside test runs in float64, not in the numbers of coverage {self.numbers.name}"
            )
        return self.rule(self, primitive, x, y)


class PixelRule(Protocol):
    """Decides on pixels by itself."""

    def __call__(
        self, edges: EdgeFunctions, primitive: Integers, x: Floats, y: Floats
    ) -> tuple[Floats, Flags]:
        """Return three values (Q, 3) and what is covered (Q,), of triangles at pixel centres (Q,)."""


def orient(corners: CornerPositions) -> Floats:
    """Return (P,) twice the signed area of what coverage sees; positive: counter-clockwise, the front.

    Notes
    -----
    Where a corner is not projected it is the determinant of the (x, y, w) matrix before snapping, whose sign is that of
    the area times the product of the signs of w. Zero: nothing is drawn.
    """
    x, y = _rows(corners.decided)
    area: Floats = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    unprojected = np.flatnonzero(~corners.is_projected.all(axis=1))
    if len(unprojected):
        area[unprojected] = _determinants(corners.take(unprojected))
    return area


def _determinants(corners: CornerPositions) -> Floats:
    """Return the determinants (P,) of the (x, y, w) rows; exact coverage and a projected corner ask for its sign."""
    x, y, w = _rows(corners.homogeneous)
    a, b, c = cross(x[NEXT], y[NEXT], w[NEXT], x[LAST], y[LAST], w[LAST])
    determinant: Floats = x[0] * a[0] + y[0] * b[0] + w[0] * c[0]
    rounding = DETERMINANT_ERROR * np.prod(np.abs([x, y, w]).sum(axis=0), axis=0)
    is_signed = corners.is_projected.any(axis=1) | isinstance(corners.numbers, ExactFormat)
    unsure = np.flatnonzero(is_signed & (np.abs(determinant) <= rounding))
    if len(unsure):
        determinant[unsure] = EXACT.set_up(corners.take(unsure)).doubled_area
    return determinant


def doubled_areas(x: Floats, y: Floats, corner: Integers) -> Floats:
    """Return twice the signed area (P,) of triangles with the corners (3, P) among vertices at x, y (M,).

    The same numbers as ``orient`` where all corners are projected, else NaN.
    """
    count = corner.shape[1]
    area = np.empty(count)
    scratch = np.empty((5, min(count, BLOCK)))
    for start in range(0, count, BLOCK):
        first, second, third = corner[:, start : start + BLOCK]
        x0, y0, dx, dy, other = scratch[:, : len(first)]
        result = area[start : start + BLOCK]
        x.take(first, out=x0, mode="clip")
        y.take(first, out=y0, mode="clip")
        x.take(second, out=dx, mode="clip")
        y.take(third, out=dy, mode="clip")
        dx -= x0
        dy -= y0
        np.multiply(dx, dy, out=result)
        x.take(third, out=dx, mode="clip")
        y.take(second, out=dy, mode="clip")
        dx -= x0
        dy -= y0
        np.multiply(dx, dy, out=other)
        result -= other
    return area


def set_up_edges(corners: CornerPositions, fill_rule: str) -> EdgeFunctions:
    """Return the edge functions of P triangles, turned so that inside is positive, in the corners' number format."""
    return edge_functions(corners, table.get("fill_rule", fill_rule).function)


def edge_functions(
    corners: CornerPositions, owns_tie: Callable[..., Flags], rule: PixelRule | None = None
) -> EdgeFunctions:
    """Return those of P triangles; ``owns_tie`` takes a and b (P, 3), as functions of the family ``fill_rule`` do."""
    numbers, a, b, c, doubled_area = corners.numbers.set_up(corners)
    return EdgeFunctions(a, b, c, owns_tie(a, b), corners, doubled_area, numbers, rule)


def set_up_per_edge(corners: CornerPositions) -> tuple[Floats, Floats, Floats, Floats]:
    """Return a, b, c (P, 3) and the doubled area (P,) in float64, each edge by whether its ends are projected."""
    x, y = _rows(corners.decided)
    a, b, c = cross(x[NEXT], y[NEXT], 1.0, x[LAST], y[LAST], 1.0)
    unprojected = np.flatnonzero(~corners.is_projected.all(axis=1))
    if len(unprojected):
        a[:, unprojected], b[:, unprojected], c[:, unprojected] = _unprojected_edges(
            corners.take(unprojected)
        )

    # Turn clockwise triangles over, so that one inside test serves both facings.
    doubled_area = orient(corners)
    sign = np.sign(doubled_area)
    a, b, c = sign * a, sign * b, sign * c
    unprojected = unprojected[doubled_area[unprojected] != 0]
    if len(unprojected):
        leave_out_turned(corners, unprojected, a, b, c)
    return a.T, b.T, c.T, doubled_area


def _unprojected_edges(corners: CornerPositions) -> tuple[Floats, ...]:
    """Return a, b, c (3, P) of triangles with a corner that is not projected."""
    (x, y), (far_x, far_y, w) = _rows(corners.decided), _rows(corners.homogeneous)
    first, second = corners.is_projected.T[NEXT], corners.is_projected.T[LAST]
    ways = (
        cross(x[NEXT], y[NEXT], 1.0, x[LAST], y[LAST], 1.0),
        anchored_edges(corners),
        cross(far_x[NEXT], far_y[NEXT], w[NEXT], far_x[LAST], far_y[LAST], w[LAST]),
    )
    return tuple(
        np.select([first & second, first | second], [both, one], neither)
        for both, one, neither in zip(*ways, strict=True)
    )


def _rows(positions: Floats) -> Floats:
    """Return (k, 3, P): the components of positions (P, 3, k), a row for each corner."""
    return positions.transpose(2, 1, 0)


def edge_value(a: FormatValue, b: FormatValue, c: FormatValue, x: FormatValue, y: FormatValue) -> FormatValue:
    """Evaluate edge functions at pixel centres, all (F,) or (F, 3); the part of the row is summed first.

    All numbers are of one format, and so is the value: see ``number_format``.
    """
    value: FormatValue = a * x + (b * y + c)
    return value


def is_inside(value: FormatValue, owns_tie: Flags) -> Flags:
    """Decide on which side of an edge pixel centres (F,) lie; on it, the fill rule decides."""
    return np.asarray((value > 0) | ((value == 0) & owns_tie))


def covers(a: Floats, b: Floats, c: Floats, owns_tie: Flags, x: float, y: float) -> tuple[list[float], bool]:
    """Listing of the inside test at one pixel: coefficients (3,) of the three edges."""
    values = []
    inside = []
    for k in range(3):
        value = a[k] * x + (b[k] * y + c[k])  #: value
        values.append(value)
        inside.append(bool(value > 0 or (value == 0 and owns_tie[k])))
    return values, all(inside)  #: covered


def edge_coefficients(
    x1: float, y1: float, w1: float, x2: float, y2: float, w2: float, sign: float
) -> tuple[float, float, float]:
    """Listing of one edge function: the cross product of its two ends, turned inward."""
    a = sign * (y1 * w2 - w1 * y2)  #: a
    b = sign * (w1 * x2 - x1 * w2)  #: b
    c = sign * (x1 * y2 - y1 * x2)  #: c
    return a, b, c
