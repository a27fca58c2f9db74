"""Edges with one end on the grid: snapping moves such an edge and does not turn it.

One end is snapped. The other lies behind the eye, at w = 0, or too far away, and keeps its place. A line through the
snapped end and the other end would turn without bound as both come close in the window. So the edge runs through its
snapped end in the direction of the edge as it is given, between both ends before snapping.

Bound
-----
The edge as it is given runs through the end p, the decided edge through the snapped p', in the same direction. Their
distance is at most |p' - p|, and that is at most sqrt(2)/512 pixel: half a step along each axis. So no pixel centre
farther than sqrt(2)/512 pixel from the given edge is decided against it, wherever it lies. The direction is computed
from the clip positions with a relative error below 2^-50 (`difference_of_products`), whatever cancels, and rounded to
whole numbers of 26 bits, which turns it by less than 2^-25: at D pixels from the corner the bound grows by D/2^25
pixel, a hundredth of it at 1,024 pixels.

Sharing
-------
The coefficients follow from the two ends and their order alone. With the ends exchanged all three change their sign
and nothing else: products commute, differences are antisymmetric, and rounding is symmetric around 0. a, b, the
snapped corner and pixel centres are whole numbers of 2^-8 small enough that nothing else is rounded (see
``edge_functions``): the two triangles of an edge see values of equal size and opposite sign, and all edges that meet in
a corner pass through it exactly. The third corners decide only on which side of an edge a triangle lies, by the sign of
its exact determinant.

Turned over
-----------
Where a triangle's two snapped corners lie on the wrong side of the opposite edges, snapping has turned it over there:
it is thinner than sqrt(2)/256 pixel at that place, though it may open to any width behind it. The edge between the
snapped corners then says nothing about the rest of the triangle, and is left out (`leave_out_turned`). What differs
from the given triangle lies within the bound of one of its three edges: two are only moved, and a place beside the
third is inside a triangle whose least height is below sqrt(2)/256, so its inscribed circle is below the bound. In such
a place alone, as in a snapped triangle that turns over, a pixel may be drawn twice or not at all.

References
----------
M. Cornea, J. Harrison, P. T. P. Tang, *Scientific computing on Itanium-based systems*, 2002 (``a b - c d``).
C.-P. Jeannerod, *A radix-independent error analysis of the Cornea-Harrison-Tang method*, 2016 (its error bound).
T. J. Dekker, *A floating-point technique for extending the available precision*, 1971 (the exact product).
"""

from typing import TypeVar

import numpy as np

from core.raster.number_formats.number_format import LAST, NEXT, CornerPositions
from core.records.arrays import Floats, Integers

DIRECTION_BITS = 26
"""Bits of the direction of an edge that is anchored in one snapped corner."""
SPLITTER = 2.0**27 + 1
"""Splits a float64 into two halves of 26 bits."""

Number = TypeVar("Number", float, Floats)


def anchored_edges(corners: CornerPositions) -> tuple[Floats, Floats, Floats]:
    """Return a, b, c (3, P) of the edges of P triangles through their snapped end; NaN where no end is snapped."""
    a, b = given_directions(corners)
    _, exponent = np.frexp(np.maximum(np.abs(a), np.abs(b)))
    unit = np.ldexp(1.0, exponent - DIRECTION_BITS)
    a, b = np.rint(a / unit), np.rint(b / unit)
    place = corners.decided.transpose(2, 1, 0)
    x, y = np.where(corners.is_projected.T[NEXT], place[:, NEXT], place[:, LAST])
    return a, b, -(a * x + b * y)


def given_directions(corners: CornerPositions) -> tuple[Floats, Floats]:
    """Return a and b (3, P) of the edges of P triangles as they are given, before snapping."""
    x, y, w = corners.clip[..., [0, 1, 3]].transpose(2, 1, 0)
    width, height = corners.size
    a = height / 2 * difference_of_products(y[NEXT], w[LAST], w[NEXT], y[LAST])
    b = width / 2 * difference_of_products(w[NEXT], x[LAST], x[NEXT], w[LAST])
    return a, b


def difference_of_products(a: Number, b: Number, c: Number, d: Number) -> Number:
    """Return a b - c d with a relative error below 2^-51, whatever cancels.

    Notes
    -----
    The products are rounded, their errors are exact floats again, and the difference of the errors is added. No
    product may overflow, nor its error underflow; clip positions are at most 1e60 in size.
    """
    first, second = a * b, c * d
    return (first - second) + (_error(a, b, first) - _error(c, d, second))


def _error(x: Number, y: Number, product: Number) -> Number:
    """Return the exact x y less the rounded ``product``."""
    x_high, y_high = SPLITTER * x - (SPLITTER * x - x), SPLITTER * y - (SPLITTER * y - y)
    x_low, y_low = x - x_high, y - y_high
    return x_low * y_low - (((product - x_high * y_high) - x_low * y_high) - x_high * y_low)


def leave_out_turned(
    corners: CornerPositions, unprojected: Integers, a: Floats, b: Floats, c: Floats
) -> None:
    """Leave out edges between two snapped corners that do not lie inside the opposite edges.

    Parameters
    ----------
    corners : CornerPositions
        Of P triangles.
    unprojected : (U,) int64
        The triangles with a corner that is not projected.
    a, b, c : (3, P) float64
        Edge functions, inside positive. An edge left out becomes 1 everywhere; but -1, so that nothing is drawn, if
        the third corner is in front and only too far away: the given triangle is thin as a whole then.
    """
    triangle = unprojected[corners.is_projected[unprojected].sum(axis=1) == 2]
    edge = np.argmin(corners.is_projected[triangle], axis=1)
    is_inside = np.ones(len(triangle), bool)
    for step in (1, 2):
        k = (edge + step) % 3
        x, y = corners.decided[triangle, k].T
        is_inside &= a[k, triangle] * x + (b[k, triangle] * y + c[k, triangle]) > 0
    edge, triangle = edge[~is_inside], triangle[~is_inside]
    a[edge, triangle] = b[edge, triangle] = 0
    c[edge, triangle] = np.where(corners.homogeneous[triangle, edge, 2] > 0, -1.0, 1.0)


def anchored_coefficients(
    x: float,
    y: float,
    start: tuple[float, float, float],
    finish: tuple[float, float, float],
    size: tuple[int, int],
    sign: float,
) -> tuple[float, float, float]:
    """Listing of an edge with a snapped end at (x, y), whose ends in clip space are (x, y, w)."""
    (x1, y1, w1), (x2, y2, w2) = start, finish
    width, height = size
    a = height / 2 * difference_of_products(y1, w2, w1, y2)  #: direction
    b = width / 2 * difference_of_products(w1, x2, x1, w2)
    _, exponent = np.frexp(max(abs(a), abs(b)))
    unit = np.ldexp(1.0, exponent - DIRECTION_BITS)  #: unit
    a = sign * np.rint(a / unit)  #: a
    b = sign * np.rint(b / unit)  #: b
    c = -(a * x + b * y)  #: c
    return a, b, c


def edge_left_out(first_value: float, second_value: float, w: float) -> tuple[float, float, float] | None:
    """Listing of an edge between two snapped corners: values of the opposite edges there, w of the third corner."""
    if first_value > 0 and second_value > 0:  #: keep
        return None
    return 0.0, 0.0, -1.0 if w > 0 else 1.0  #: left-out
