"""Edge functions: coefficients from the 3x3 matrix of (x, y, w) rows as its adjugate, and the inside decision.

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

from core.methods import table
from core.raster.edges.one_ended import anchored_edges, leave_out_turned
from core.raster.number_formats.exact import EXACT
from core.raster.number_formats.number_format import (
    LAST,
    NEXT,
    CornerPositions,
    FormatValue,
    NumberFormat,
    cross,
)
from core.records.arrays import Flags, Floats, Integers
from core.records.cached import cached_property

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
    """Return the determinants (P,) of the (x, y, w) rows; the sign is right where a corner is projected."""
    x, y, w = _rows(corners.homogeneous)
    a, b, c = cross(x[NEXT], y[NEXT], w[NEXT], x[LAST], y[LAST], w[LAST])
    determinant: Floats = x[0] * a[0] + y[0] * b[0] + w[0] * c[0]
    rounding = DETERMINANT_ERROR * np.prod(np.abs([x, y, w]).sum(axis=0), axis=0)
    unsure = np.flatnonzero(corners.is_projected.any(axis=1) & (np.abs(determinant) <= rounding))
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
