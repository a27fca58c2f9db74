"""Corners on the grid of 1/256 pixel, as the coverage decision sees them, and edges with one end on it.

Notes
-----
GPUs decide coverage on a 1/256-pixel grid, and so do we: every product and sum of an edge function then
fits float64 exactly (see ``edge_functions``), so a pixel on a shared edge is drawn once. Which corners are snapped, and
in which numbers the edges are computed, is up to the number format (``number_format``).

One end is snapped. The other lies behind the eye, at w = 0, or too far away, and keeps its place. A line through the
snapped end and the other end would turn without bound as both come close in the window. So the edge runs through its
snapped end in the direction of the given edge, between both ends before snapping.

Bound
-----
The given edge runs through the end p, the decided edge through the snapped p', in the same direction. Their
distance is at most |p' - p|, and that is at most sqrt(2)/512 pixel: half a step along each axis. So no pixel centre
farther than sqrt(2)/512 pixel from the given edge is decided against it, wherever it lies. The direction is computed
from the clip positions with a relative error below 2^-50, whatever cancels (`difference_of_products`), and replaced by
whole numbers up to 2^26 for which every centre is on the same side (`whole_direction`). What is rounded on the way,
window positions before snapping among it, adds less than 2^-32 pixel.

Whole numbers
-------------
A pixel centre lies a whole number of 1/256 pixel from the snapped corner along each axis, less than 2^25 of them. On
which side of the edge it lies depends on how the edge's slope compares with such a fraction. Between the slope and the
whole numbers chosen for it, of the next Farey sequence, there is no such fraction: both compare alike with all of them.
With whole numbers below 2^27, corners up to 2^16 and centres up to 2^14 pixels in steps of 1/256, every product and sum
of an edge function fits the 53 bits of float64: nothing more is rounded.

Sharing
-------
The coefficients follow from the two ends and their order alone. With the ends exchanged all three change their sign
and nothing else: products commute, differences are antisymmetric, and whole numbers are chosen by size. So the two
triangles of an edge see values of equal size and opposite sign, and all edges that meet in a corner pass through it
exactly. The third corners decide only on which side of an edge a triangle lies, by the sign of the exact determinant.

The third edge
--------------
Let two corners be snapped and the third behind the eye. The triangle is the part beyond the edge between the snapped
corners of the wedge between its two other edges, which are only moved. Where both snapped corners lie inside the
opposite edges, the third edge bounds it only between them, and there it lies within the bound. Otherwise snapping has
turned the triangle over at that edge, where it is thinner than sqrt(2)/256 pixel, though it may open to any width
beyond. The edge then says nothing about what lies beyond and is left out (`leave_out_turned`): the whole wedge is
drawn. What that adds lies in a triangle whose least height is below sqrt(2)/256 pixel: its inscribed circle is smaller
than the bound, and so is the distance from an edge. In such a place alone, as where a snapped triangle turns over, a
pixel may be drawn twice or not at all.

References
----------
G. H. Hardy, E. M. Wright, *An introduction to the theory of numbers*, 1938, chapter III (Farey sequences).
M. Cornea, J. Harrison, P. T. P. Tang, *Scientific computing on Itanium-based systems*, 2002 (``a b - c d``).
C.-P. Jeannerod, *A radix-independent error analysis of the Cornea-Harrison-Tang method*, 2016 (its error bound).
T. J. Dekker, *A floating-point technique for extending the available precision*, 1971 (the exact product).
"""

from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from core.coverage.number_formats import LAST, NEXT, CornerPositions, NumberFormat
from core.methods import table
from core.records.arrays import Flags, Floats, Integers

# Window positions of the corners as the coverage decision sees them: snapped to 1/256 pixel, or as they
# are.


SUBPIXELS = 256
"""Steps of the 1/256-pixel grid in one pixel."""
SNAP_LIMIT = 2.0**16
"""Corners farther from the window's origin than this, in pixels, are not snapped."""


@dataclass(frozen=True, eq=False)
class WindowVertices:
    """M vertices in the window, placed once for all triangles that share them."""

    x: Floats
    """(M,) float64 pixels that coverage is decided on (snapped); NaN where the vertex cannot be projected."""
    y: Floats
    """(M,) float64, likewise."""
    is_projected: Flags
    """(M,) bool, where ``x`` and ``y`` hold."""


def place_corners(clip: Floats, size: tuple[int, int], coverage: str) -> CornerPositions:
    """Put corners on the grid of a coverage method.

    Parameters
    ----------
    clip : (P, 3, 4) float64
    size : (width, height)
    coverage : str
        A method of the family ``coverage``.
    """
    return place_corners_in(clip, size, table.get("coverage", coverage).function())


def place_corners_in(clip: Floats, size: tuple[int, int], numbers: NumberFormat) -> CornerPositions:
    """Put corners (P, 3, 4) on the grid of a number format; see `place_corners`."""
    x, y, w = clip[..., 0], clip[..., 1], clip[..., 3]
    homogeneous = _component_rows(w.shape, 3)
    homogeneous[..., 0] = (x + w) * (size[0] / 2)
    homogeneous[..., 1] = (y + w) * (size[1] / 2)
    homogeneous[..., 2] = w
    window = window_position(clip, size)
    decided, is_projected = numbers.place(window)
    return CornerPositions(homogeneous, window, decided, is_projected, clip, size, numbers)


def place_vertices(clip: Floats, size: tuple[int, int], numbers: NumberFormat) -> WindowVertices:
    """Put vertices (M, 4) on the grid of a number format, as ``place_corners`` does with corners."""
    decided, is_projected = numbers.place(window_position(clip, size))
    return WindowVertices(decided[:, 0], decided[:, 1], is_projected)


def window_position(clip: Floats, size: tuple[int, int]) -> Floats:
    """Return where clip positions (..., 4) lie in the window, (..., 2) float64 pixels; NaN where w <= 0."""
    w = clip[..., 3]
    position = _component_rows(w.shape, 2)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for axis in range(2):
            along = position[..., axis]
            np.divide(clip[..., axis], w, out=along)
            along += 1
            along *= size[axis] / 2
    in_front = w > 0
    if not in_front.all():
        position[~in_front] = np.nan
    return position


def _component_rows(shape: tuple[int, ...], count: int) -> Floats:
    """Return an empty array (*shape, count) where every component of every corner is a contiguous row."""
    return np.empty((count, *reversed(shape))).T


def snap(window: Floats, limit: float = SNAP_LIMIT) -> tuple[Floats, Flags]:
    """Round to the nearest 1/256 pixel, half to even. (P, 3, 2) pixels to (P, 3, 2) and (P, 3) bool.

    Corners more than ``limit`` pixels away along an axis are not projected.
    """
    is_projected = (np.abs(window[..., 0]) <= limit) & (np.abs(window[..., 1]) <= limit)
    snapped = window.copy(order="K")
    if not is_projected.all():
        snapped[~is_projected] = np.nan
    snapped *= SUBPIXELS
    np.rint(snapped, out=snapped)
    snapped /= SUBPIXELS
    return snapped, is_projected


def snap_one(value: float) -> float:
    """Listing of one snapped coordinate."""
    return float(np.rint(value * SUBPIXELS) / SUBPIXELS)  #: snap


# Edges with one end on the grid: snapping moves such an edge and does not turn it.


FARTHEST = 2**25
"""Steps of 1/256 pixel: a pixel centre is less far than this from a snapped corner, along each axis."""
SLOPE_BITS = 62
"""Bits of the directions that whole numbers are chosen for."""
SPLITTER = 2.0**27 + 1
"""Splits a float64 into two halves of 26 bits."""

Number = TypeVar("Number", float, Floats)


def anchored_edges(corners: CornerPositions) -> tuple[Floats, Floats, Floats]:
    """Return a, b, c (3, P) of the edges of P triangles through their snapped end; NaN where no end is snapped."""
    a, b = whole_direction(*given_directions(corners))
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


def whole_direction(a: Floats | float, b: Floats | float) -> tuple[Any, Any]:
    """Return whole numbers below 2^27 that decide all vectors of whole numbers up to ``FARTHEST`` as a and b do.

    Parameters
    ----------
    a, b : float64, any shape
        ``a x + b y`` is above, below or equal to 0.

    Returns
    -------
    a, b : float64, any shape
        The same for all whole x and y up to ``FARTHEST`` in size.

    Notes
    -----
    The convergents of the continued fraction of the smaller over the larger number, up to the first denominator above
    ``FARTHEST``: of the last step only as much as that needs.
    """
    sizes = np.abs(np.stack([a, b]))
    _, exponent = np.frexp(sizes.max(axis=0))
    whole = np.rint(np.ldexp(sizes, SLOPE_BITS - exponent)).astype(np.int64)
    larger, smaller = whole.max(axis=0), whole.min(axis=0)
    zero, one = np.zeros_like(larger), np.ones_like(larger)
    before, found = np.stack([one, zero]), np.stack([zero, one])
    is_open = smaller > 0
    while is_open.any():
        quotient = larger // np.maximum(smaller, 1)
        steps = np.minimum(quotient, (FARTHEST - before[1]) // found[1] + 1)
        following = steps * found + before
        before, found = np.where(is_open, found, before), np.where(is_open, following, found)
        larger, smaller = smaller, larger - quotient * smaller
        is_open &= (smaller > 0) & (found[1] <= FARTHEST)
    is_steep = whole[0] < whole[1]
    return np.sign(a) * np.where(is_steep, *found), np.sign(b) * np.where(is_steep, *found[::-1])


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
        The triangles that have an area and a corner that is not projected.
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
    a = height / 2 * difference_of_products(y1, w2, w1, y2)
    b = width / 2 * difference_of_products(w1, x2, x1, w2)
    a, b = whole_direction(a, b)
    a = sign * a  #: a
    b = sign * b  #: b
    c = -(a * x + b * y)  #: c
    return a, b, c


def edge_left_out(first_value: float, second_value: float, w: float) -> tuple[float, float, float] | None:
    """Listing of an edge between two snapped corners: values of the opposite edges there, w of the third corner."""
    if first_value > 0 and second_value > 0:
        return None
    return 0.0, 0.0, -1.0 if w > 0 else 1.0  #: left-out
