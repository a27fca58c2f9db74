"""Ray casting: at every pixel centre the triangle that its ray meets first, decided exactly, in float64 where it can.

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

It is the referee for hidden surfaces. Which pixels a triangle covers, and what lies before the near or behind the far
plane, is decided as for every other method; only which of two is nearer is not read from a buffer of rounded depths:
they are compared in float64 where their difference is larger than the error it can have, and in whole numbers where
it is not (``ray_planes``). A tie keeps the triangle that came first.

The rays of a picture are cast together: triangle after triangle, as in the loop over all triangles for one ray, but for
the pixels of a layer at once (``run_ray_tests``). What a ray has met so far is a triangle's number.

References
----------
A. Appel, *Some techniques for shading machine renderings of solids*, 1968.
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "hidden surface removal – raycasting": for each ray, the
closest surface.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import inf, isfinite, lcm
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import DrawingOrder
from core.visibility.exact_case import ExactCase, ExactTests

if TYPE_CHECKING:
    from core.visibility.rays_in_tree import TreeWalk

# Where the ray through a pixel centre meets the planes of triangles: in float64 with its error, and
# exactly.


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


def ray_constants(planes: RayPlanes) -> dict[str, float]:
    """Return what the sentences of hits take that is the same for all of them."""
    return {"by_w": planes.by_w, "width": planes.size[0], "height": planes.size[1]}


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


# Ray casting: at every pixel centre the triangle that its ray meets first, decided exactly.


FIRST, BY_FLOATS, EXACTLY = 0, 1, 2
"""How a hit was decided: nothing was hit before, by the float64 values, or by whole numbers."""


@method(
    "visibility",
    "ray-casting",
    "Ray casting (exact)",
    source="Appel 1968; Pellacini, hidden surface removal: raycasting",
    exact_for="opaque triangles in any order: depths are compared exactly, without a depth buffer",
    breaks_where="coplanar triangles: a tie keeps the first one drawn",
    takes=("depth_test_time",),
    traits="exact",
)
def ray_casting(clip: Floats) -> DrawingOrder:
    """Take the triangles as given; a hit is kept where it is nearer than the nearest so far."""
    return DrawingOrder(np.arange(len(clip)), True, decide_hits)


@dataclass(frozen=True, eq=False)
class RayTests:
    """F hits of rays in drawing order."""

    tracer: ClassVar[str] = "core.visibility.traced.trace_rays"
    before: Integers
    """(F,) int64, the triangle that was the nearest so far, -1: none."""
    passes: Flags
    """(F,) bool, the hit is nearer than that."""
    how: Integers
    """(F,) int64, ``FIRST``, ``BY_FLOATS`` or ``EXACTLY``."""
    sign: Integers
    """(F,) int64: 1 nearer, -1 farther, 0 equally near, which is not nearer."""
    walk: "TreeWalk | None" = None
    """What rays have asked in a tree of boxes; ``None``: they ask all triangles."""

    @property
    def work(self) -> dict[str, int]:
        """Nothing but one comparison for each hit."""
        return {}

    @property
    def turn(self) -> None:
        """Hits are drawn as they stand."""

    def told(self) -> tuple[NDArray[Any], dict[str, Integers]]:
        """Return what is said of F hits of one pixel in its history: a key (F,) each, and its numbers (F,)."""
        keys = np.array(["ray-tied", "ray-nearer", "ray-farther"])
        if self.walk is None:
            return keys[self.sign], {}
        walk = self.walk
        found = keys[np.where(walk.wins, 1, np.where(walk.ties, 0, -1))]
        numbers = {"against": np.where(walk.wins, -1, walk.winner), "node": walk.hidden_in}
        return np.where(walk.hidden_in >= 0, "ray-hidden", found), numbers


def decide_hits(case: ExactCase) -> tuple[Flags, ExactTests]:
    """Compare each hit with the nearest of its pixel so far."""
    initial = case.initial.take(case.stacks.pixel)
    tests = run_ray_tests(case.planes, case.triangle, *case.rays, case.stacks.layers(), initial, case.writes)
    return tests.passes, tests


def run_ray_tests(
    planes: RayPlanes,
    triangle: Integers,
    m: Floats,
    n: Floats,
    layers: Iterator[tuple[int, Integers]],
    initial: Integers,
    writes: Flags | None = None,
) -> RayTests:
    """Compare hits with the nearest so far, one layer after another.

    Parameters
    ----------
    triangle : (F,) int64
        In the order of drawing.
    m, n : (F,) float64
        The rays that meet them.
    layers : iterator
        Hits (F,) of which no two are of one pixel: how many, and their numbers; those of U pixels in their order.
    initial : (U,) int64
        The nearest triangle of these pixels before the first hit, -1: none.
    writes : (F,) bool, optional
        Hits that later ones are compared with if they pass; ``None``: all.
    """
    before, how, sign = np.empty((3, len(triangle)), np.int64)
    there = initial.copy()
    for count, hit in layers:
        nearest = there[:count]
        before[hit] = nearest
        sign[hit], how[hit] = compare_hits(planes, triangle.take(hit), nearest, m.take(hit), n.take(hit))
        is_nearer = sign.take(hit) > 0
        np.copyto(
            nearest, triangle.take(hit), where=is_nearer if writes is None else is_nearer & writes.take(hit)
        )
    return RayTests(before, sign > 0, how, sign)


def compare_hits(
    planes: RayPlanes, new: Integers, old: Integers, m: Floats, n: Floats
) -> tuple[Integers, Integers]:
    """Return which of the triangles ``new`` and ``old`` (F,) is nearer at rays m, n (F,), and how it was decided.

    Returns
    -------
    sign : (F,) int64
        1 where ``new`` is nearer or there is no other (``old`` is -1), -1 where it is farther, 0: equally near.
    how : (F,) int64
    """
    value, error = planes.values(new, m, n)
    other = np.maximum(old, 0)
    there, there_error = planes.values(other, m, n)
    is_clear = np.abs(value - there) > (error + there_error) * (1 + 2.0**-50)
    how = np.where(old < 0, FIRST, np.where(is_clear, BY_FLOATS, EXACTLY))
    sign = np.where((old < 0) | (value > there), 1, -1)
    doubtful = np.flatnonzero(how == EXACTLY)
    if len(doubtful):
        sign[doubtful] = _compare_exactly(planes, new[doubtful], old[doubtful], m[doubtful], n[doubtful])
    return sign, how


def _compare_exactly(planes: RayPlanes, new: Integers, old: Integers, m: Floats, n: Floats) -> Integers:
    """Return the signs (F,) of the doubtful ones, the rays of each pair of triangles together."""
    order = np.lexsort((old, new))
    new, old = new[order], old[order]
    starts = np.flatnonzero((np.diff(new, prepend=-1) != 0) | (np.diff(old, prepend=-1) != 0))
    sign = np.empty(len(new), np.int64)
    for first, end in zip(starts.tolist(), [*starts[1:].tolist(), len(new)], strict=True):
        rays = order[first:end]
        sign[rays] = planes.compare(int(new[first]), int(old[first]), m[rays].tolist(), n[rays].tolist())
    return sign


def hit_is_nearer(
    value: float,
    error: float,
    corners: list[list[float]],
    nearest_value: float,
    nearest_error: float,
    nearest_corners: list[list[float]] | None,
    x: tuple[int, int],
    y: tuple[int, int],
    by_w: bool,
) -> bool:
    """Listing of one hit: is it nearer than the nearest so far? The ray is X = m/W, Y = n/H."""
    if nearest_corners is None:
        return True  #: first
    if abs(value - nearest_value) > (error + nearest_error) * (1 + 2.0**-50):  #: margin
        return value > nearest_value  #: floats
    new = exact_plane(corners, by_w)
    old = exact_plane(nearest_corners, by_w)
    if new is None or old is None:
        return new is not None and old is None
    (m, width), (n, height) = x, y
    a = (new.a * old.d - old.a * new.d) * height
    b = (new.b * old.d - old.b * new.d) * width
    c = (new.c * old.d - old.c * new.d) * width * height
    return a * m + b * n + c > 0  #: exact


def depth_of_nearest(new: float, old: float, is_nearer: bool, writes: bool) -> float:
    """Listing of the depth buffer after a hit: that of the nearest hit that is kept."""
    return new if is_nearer and writes else old  #: store
