"""Ray casting: at every pixel centre the triangle that its ray meets first, decided exactly.

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

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import DrawingOrder
from core.visibility.ray_planes import RayPlanes, exact_plane

FIRST, BY_FLOATS, EXACTLY = 0, 1, 2
"""How a hit was decided: nothing was hit before, by the float64 values, or by whole numbers."""


@method(
    "visibility",
    "ray-casting",
    "Ray casting (exact)",
    source="Appel 1968; Pellacini, hidden surface removal: raycasting",
    exact_for="opaque triangles in any order: depths are compared exactly, without a depth buffer",
    breaks_where="coplanar triangles: a tie keeps the first one drawn",
)
def ray_casting(clip: Floats) -> DrawingOrder:
    """Take the triangles as given; a hit is kept where it is nearer than the nearest so far."""
    return DrawingOrder(np.arange(len(clip)), True, casts_rays=True)


@dataclass(frozen=True, eq=False)
class RayTests:
    """F hits of rays in drawing order."""

    before: Integers
    """(F,) int64, the triangle that was the nearest so far, -1: none."""
    passes: Flags
    """(F,) bool, the hit is nearer than that."""
    how: Integers
    """(F,) int64, ``FIRST``, ``BY_FLOATS`` or ``EXACTLY``."""
    sign: Integers
    """(F,) int64: 1 nearer, -1 farther, 0 equally near, which is not nearer."""


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
