"""The region that lines and polygons are clipped to: a rectangle or a polygon, in NDC: it scales with the raster."""

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from core.records.arrays import Floats, checked

REGION_REACH = 8.0
"""How far from the middle a region of polygons may reach, in halves of the raster."""
DIGITS = 9
"""Decimal places of a pixel that a region is rounded to in the window: typed numbers come back unchanged."""


def checked_region(region: ArrayLike, size: tuple[int, int]) -> Floats:
    """Return a region as a read-only array, or say what was wanted and what came.

    Parameters
    ----------
    region : (4,) or (M, 2) array_like of float
        Left, bottom, right and top of a rectangle, or the corners of a polygon, in NDC.
    size : (width, height)
        The raster on which a polygon must be convex.

    Raises
    ------
    ValueError
        If a rectangle has no area, or a polygon is not convex and counter-clockwise.
    """
    if np.ndim(region) == 2:
        corners = checked("clip_region", region, ("M", 2))
        check_convex(region_in_window(corners, size))
        return corners
    return _checked_rectangle(region)


def checked_polygon_region(region: ArrayLike) -> Floats:
    """Return what polygons are clipped to as a read-only array: a rectangle (4,), or corners (M, 2) of any rings.

    Raises ValueError if a rectangle has no area, or a corner lies farther than `REGION_REACH`.
    """
    if np.ndim(region) == 2:
        return checked("clip_region", region, ("M", 2), limit=REGION_REACH)
    return _checked_rectangle(region)


def _checked_rectangle(region: ArrayLike) -> Floats:
    borders = checked("clip_region", region, (4,))
    left, bottom, right, top = borders.tolist()
    if left >= right or bottom >= top:
        raise ValueError("the clip window must have an area: left below right, and bottom below top")
    return borders


def check_convex(points: Floats) -> None:
    """Raise ValueError unless a polygon (M, 2) is convex and counter-clockwise, decided exactly, and has an area."""
    count = len(points)
    if count < 3:
        raise ValueError(f"window must have at least three corners, got {count}")
    exact = [(Fraction(x), Fraction(y)) for x, y in points.tolist()]
    has_area = False
    for k in range(count):
        (x0, y0), (x1, y1) = exact[k], exact[(k + 1) % count]
        if (x0, y0) == (x1, y1):
            raise ValueError(f"window must have no two equal corners in turn, got {points[k].tolist()} twice")
        sides = [(x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) for x, y in exact]
        if min(sides) < 0:
            raise ValueError(
                "window must be convex and counter-clockwise, "
                f"got corner {sides.index(min(sides))} outside the edge from corner {k}"
            )
        has_area |= max(sides) > 0
    if not has_area:
        raise ValueError("window must have an area, got corners on one line")


def is_convex(points: Floats) -> bool:
    """Return whether a polygon (M, 2) has an area and is convex, in either direction."""
    for direction in (1, -1):
        try:
            check_convex(points[::direction])
        except ValueError:
            continue
        return True
    return False


def region_in_window(region: Floats, size: tuple[int, int]) -> Floats:
    """Return a region, (4,) or (M, 2) in NDC, in pixels of a raster of ``size`` (width, height)."""
    window = (region.reshape(-1, 2) + 1) * (np.array(size) / 2)
    return np.asarray(np.round(window, DIGITS).reshape(region.shape))


def region_of_window(window: Floats, size: tuple[int, int]) -> Floats:
    """Return a region, (4,) or (M, 2) in pixels of a raster of ``size`` (width, height), in NDC."""
    return np.asarray((window.reshape(-1, 2) / (np.array(size) / 2) - 1).reshape(window.shape))
