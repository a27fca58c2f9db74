"""How much of a pixel a convex shape covers, in closed form.

The area of a polygon inside a pixel is the integral of x, cut to the pixel, along its border (Green's theorem). On one
straight side x is linear in y, so the mean of the cut x has a closed form without cancellation.

References
----------
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (exact area).
"""

import numpy as np

from core.records.arrays import Floats, Integers


def area_in_pixels(polygon: Floats, column: Integers, row: Integers) -> Floats:
    """Return the area (F,) float64 of polygons inside the unit squares of pixels.

    Parameters
    ----------
    polygon : (M, 2) or (F, M, 2) float64
        Corners in pixels, counter-clockwise; one for all pixels, or one each.
    column, row : (F,) int64
        The square reaches from (column, row) to (column + 1, row + 1).
    """
    corners = np.broadcast_to(polygon, (len(column), *polygon.shape[-2:]))
    x, y = corners[..., 0] - column[:, None], corners[..., 1] - row[:, None]
    area = np.zeros(len(column))
    for k in range(corners.shape[1]):
        area += _under_side(x[:, k - 1], y[:, k - 1], x[:, k], y[:, k])
    return np.clip(area, 0.0, 1.0)


def _under_side(x0: Floats, y0: Floats, x1: Floats, y1: Floats) -> Floats:
    """Return the integral (F,) of x cut to [0, 1] over the part of y in [0, 1] along one side, signed."""
    bottom, top = np.clip(y0, 0.0, 1.0), np.clip(y1, 0.0, 1.0)
    height = y1 - y0
    is_level = height == 0
    slope = (x1 - x0) / np.where(is_level, 1.0, height)
    first, second = x0 + (bottom - y0) * slope, x0 + (top - y0) * slope
    return np.where(is_level, 0.0, (top - bottom) * _mean_of_cut(first, second))


def _mean_of_cut(first: Floats, second: Floats) -> Floats:
    """Return the mean (F,) of x cut to [0, 1] while x runs evenly from ``first`` to ``second``."""
    low, high = np.minimum(first, second), np.maximum(first, second)
    cut_low, cut_high = np.clip(low, 0.0, 1.0), np.clip(high, 0.0, 1.0)
    above = np.maximum(high - 1.0, 0.0) - np.maximum(low - 1.0, 0.0)
    length = high - low
    is_point = length == 0
    total = (cut_high - cut_low) * (cut_high + cut_low) / 2 + above
    return np.where(is_point, cut_low, total / np.where(is_point, 1.0, length))
