"""Where the ray through a pixel centre meets the planes of triangles: in float64 with its error, and exactly.

The ray of the pixel centre x, y is the line x/w = X = m/W, y/w = Y = n/H in clip space, with the whole numbers
m = 2 x - W and n = 2 y - H of the centre. It meets a triangle's plane where the corners weigh as the cofactors of the
matrix of their x, y and w say; what is linear in space (1, or -z) over w is ``(a X + b Y + c) / d`` there, with the
matrix's determinant d. Larger is nearer.

Exactly: float64 corners are whole numbers times a power of two, so a, b, c and d are whole numbers in a common unit,
and two triangles are compared by the sign of one whole number. Nothing is snapped, clipped or limited.

References
----------
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997.
J. R. Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997 (first with an
error bound, then exactly).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf, isfinite, lcm
from typing import NamedTuple

import numpy as np

from core.records.arrays import Flags, Floats, Integers

RAY_UNIT = 128
"""Steps of m and n that are told apart: those of samples at multiples of 1/256 of a pixel."""
ROUNDING = 2.0**-49
"""Bound of the rounding in a sum of products, as a share of the sum of their sizes: sixteen roundings; nine occur."""
UNDERFLOW = 1e-250
"""More than what is lost where products fall below the range of float64."""


class ExactPlane(NamedTuple):
    """(a X + b Y + c) / d in whole numbers, d positive."""

    a: int
    b: int
    c: int
    d: int


@dataclass(frozen=True, eq=False)
class RayPlanes:
    """What tells how near T triangles are along the rays of a W x H raster; the numbers stand in the scene's order."""

    clip: Floats
    """(T, 3, 4) float64, clip space: whole triangles, whatever clipping makes of them."""
    size: tuple[int, int]
    by_w: bool
    """Whether 1/w tells which is nearer (w is the distance along the view), else -z/w does."""
    a: Floats
    """(T,) float64, change with X."""
    b: Floats
    """(T,) float64, change with Y."""
    c: Floats
    """(T,) float64."""
    d: Floats
    """(T,) float64, the determinant; 0 where the eye lies in the plane."""
    sizes: Floats
    """(T, 4) float64, sums of the sizes of the terms of a, b, c and d."""
    shift: tuple[float, float] = (0.0, 0.0)
    """By how many pixels the scene is moved against the raster, multiples of 1/256."""
    _exact: dict[int, ExactPlane | None] = field(default_factory=dict)

    def values(self, triangle: Integers, m: Floats, n: Floats) -> tuple[Floats, Floats]:
        """Return how near triangles (F,) are at the rays m, n (F,), in float64, and bounds of the error (F,).

        Notes
        -----
        The bound is infinite where the determinant may be 0; the value is 0 there.
        """
        x, y = m / self.size[0], n / self.size[1]
        a, b, c, d = (values.take(triangle) for values in (self.a, self.b, self.c, self.d))
        size_a, size_b, size_c, size_d = self.sizes.take(triangle, axis=0).T
        numerator = a * x + (b * y + c)
        error = ROUNDING * (size_a * np.abs(x) + (size_b * np.abs(y) + size_c)) + UNDERFLOW
        error_d = ROUNDING * size_d + UNDERFLOW
        least = np.abs(d) - error_d
        is_known: Flags = least > 0
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            value = numerator / d
            bound = (error + np.abs(value) * error_d) / least + ROUNDING * np.abs(value)
        is_known &= np.isfinite(value) & np.isfinite(bound)
        return np.where(is_known, value, 0.0), np.where(is_known, bound, np.inf)

    def rays(self, column: Integers, row: Integers, center: float) -> tuple[Floats, Floats]:
        """Return m and n (F,) float64 of pixels (F,) whose centres lie ``center``, 0 or 1/2, from their corners.

        Whole numbers; where the scene is moved against the raster, multiples of 1/128.
        """
        (width, height), (x, y) = self.size, self.shift
        m, n = np.float64(2 * (center - x) - width), np.float64(2 * (center - y) - height)
        return 2 * column + m, 2 * row + n

    def exact(self, triangle: int) -> ExactPlane | None:
        """Return the plane of a triangle; ``None``: the eye lies in it, and no point of it is on a ray."""
        if triangle not in self._exact:
            self._exact[triangle] = exact_plane(self.clip[triangle].tolist(), self.by_w)
        return self._exact[triangle]

    def compare(self, first: int, second: int, m: Sequence[float], n: Sequence[float]) -> list[int]:
        """Return exactly, for rays m, n: 1 where the ``first`` triangle is nearer, -1 the ``second``, 0 both alike."""
        one, other = self.exact(first), self.exact(second)
        if one is None or other is None:
            return [(one is not None) - (other is not None)] * len(m)
        width, height = self.size
        a = (one.a * other.d - other.a * one.d) * height
        b = (one.b * other.d - other.b * one.d) * width
        c = (one.c * other.d - other.c * one.d) * width * height
        if a == b == c == 0:
            return [0] * len(m)
        rays = ((int(RAY_UNIT * i), int(RAY_UNIT * j)) for i, j in zip(m, n, strict=True))
        differences = [a * i + b * j + c * RAY_UNIT for i, j in rays]
        return [(value > 0) - (value < 0) for value in differences]


def set_up_ray_planes(
    clip: Floats, size: tuple[int, int], by_w: bool, shift: tuple[float, float] = (0.0, 0.0)
) -> RayPlanes:
    """Return the planes of triangles (T, 3, 4) in clip space over a raster of ``size``; see `RayPlanes`."""
    x, y, z, w = (clip[..., k].T for k in range(4))
    values = np.ones_like(z) if by_w else -z
    following, last = [1, 2, 0], [2, 0, 1]
    terms = (
        (y[following] * w[last], w[following] * y[last]),
        (w[following] * x[last], x[following] * w[last]),
        (x[following] * y[last], y[following] * x[last]),
    )
    cofactors = [first - second for first, second in terms]
    sizes = [np.abs(first) + np.abs(second) for first, second in terms]
    a, b, c = (_sum_of(cofactor * values) for cofactor in cofactors)
    d = _dot(cofactors, (x, y, w))
    of_d = _dot(sizes, (np.abs(x), np.abs(y), np.abs(w)))
    largest = [*(_sum_of(size * np.abs(values)) for size in sizes), of_d]
    return RayPlanes(clip, size, by_w, a, b, c, d, np.stack(largest, axis=1), shift)


def _dot(rows: Sequence[Floats], of: Sequence[Floats]) -> Floats:
    """Return the sums (T,) of products of the first of three rows each."""
    products = [part[0] * values[0] for part, values in zip(rows, of, strict=True)]
    return np.asarray(products[0] + products[1] + products[2])


def _sum_of(rows: Floats) -> Floats:
    """Return the sum (T,) of three rows."""
    return np.asarray(rows[0] + rows[1] + rows[2])


def hit_value(
    plane: Sequence[float], sizes: Sequence[float], m: int, n: int, width: int, height: int
) -> tuple[float, float]:
    """Listing of where a ray meets a plane (a, b, c, d), and of a bound of the error; larger is nearer."""
    a, b, c, d = plane
    size_a, size_b, size_c, size_d = sizes
    x, y = m / width, n / height
    error_d = ROUNDING * size_d + UNDERFLOW
    least = abs(d) - error_d
    value = (a * x + (b * y + c)) / d if least > 0 else 0.0  #: value
    error = ROUNDING * (size_a * abs(x) + (size_b * abs(y) + size_c)) + UNDERFLOW
    bound = (error + abs(value) * error_d) / least + ROUNDING * abs(value) if least > 0 else inf  #: bound
    return (value, bound) if isfinite(bound) else (0.0, inf)


def exact_plane(corners: Sequence[Sequence[float]], by_w: bool) -> ExactPlane | None:
    """Return the plane of three corners (x, y, z, w) in whole numbers; ``None`` where the determinant is 0."""
    ratios = [[float(number).as_integer_ratio() for number in corner] for corner in corners]
    unit = lcm(*(denominator for corner in ratios for _, denominator in corner))
    whole = [[numerator * (unit // denominator) for numerator, denominator in corner] for corner in ratios]
    a = b = c = d = 0
    for k in range(3):
        x0, y0, z0, w0 = whole[k]
        x1, y1, _, w1 = whole[k - 2]
        x2, y2, _, w2 = whole[k - 1]
        value = unit if by_w else -z0
        across, up, rest = y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
        a, b, c = a + across * value, b + up * value, c + rest * value
        if k == 0:
            d = x0 * across + y0 * up + w0 * rest
    if d == 0:
        return None
    return ExactPlane(a, b, c, d) if d > 0 else ExactPlane(-a, -b, -c, -d)
