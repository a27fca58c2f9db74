"""How much of a pixel a convex shape covers, in closed form; and lines: the ideal line and its area.

The area of a polygon inside a pixel is the integral of x, cut to the pixel, along its border (Green's theorem). On one
straight side x is linear in y, so the mean of the cut x has a closed form without cancellation.

References
----------
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (exact area).
"""

import numpy as np

from core.records.arrays import Floats, Integers

HALF_WIDTH = 0.5
"""Half the width of the ideal line, in pixels."""


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


def line_rectangles(ends: Floats) -> Floats:
    """Return the rectangles (L, 4, 2), counter-clockwise, one pixel wide around segments (L, 2, 2), ends cut square."""
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    along = along / np.where(length == 0, 1.0, length)[:, None]
    across = HALF_WIDTH * np.stack([-along[:, 1], along[:, 0]], axis=1)
    return np.stack(
        [ends[:, 0] - across, ends[:, 1] - across, ends[:, 1] + across, ends[:, 0] + across], axis=1
    )


def line_areas(ends: Floats, size: tuple[int, int]) -> tuple[Integers, Integers, Integers, Floats]:
    """Return owner, column, row (F,) and area (F,) of all pixels that the lines (L, 2, 2) one pixel wide touch.

    Parameters
    ----------
    ends : (L, 2, 2) float64
        Window x and y in pixels, pixel centres at halves.
    size : (width, height)
        Pixels outside are left out.
    """
    rectangles = line_rectangles(ends)
    parts = []
    for owner, rectangle in enumerate(rectangles):
        column, row = _pixels_near(ends[owner], rectangle, size)
        area = area_in_pixels(rectangle, column, row)
        touched = area > 0
        parts.append(
            (np.full(np.count_nonzero(touched), owner), column[touched], row[touched], area[touched])
        )
    if not parts:
        none = np.empty(0, np.int64)
        return none, none, none, np.empty(0)
    owners, columns, rows, areas = (np.concatenate(values) for values in zip(*parts, strict=True))
    return owners, columns, rows, areas


def _pixels_near(ends: Floats, rectangle: Floats, size: tuple[int, int]) -> tuple[Integers, Integers]:
    """Return column and row (F,) of the pixels in the box of one line that are not far from it."""
    low = np.maximum(np.floor(rectangle.min(axis=0)), 0).astype(np.int64)
    high = np.minimum(np.ceil(rectangle.max(axis=0)), size).astype(np.int64)
    row, column = np.mgrid[low[1] : max(high[1], low[1]), low[0] : max(high[0], low[0])]
    column, row = column.ravel(), row.ravel()
    along = ends[1] - ends[0]
    length = max(float(np.hypot(*along)), np.finfo(np.float64).tiny)
    offset = (column + 0.5 - ends[0, 0]) * along[1] - (row + 0.5 - ends[0, 1]) * along[0]
    near = np.abs(offset) <= length * (HALF_WIDTH + 1.0)
    return column[near], row[near]


def distance_from_line(
    ends: Floats, owner: Integers, column: Integers, row: Integers, intensity: Floats
) -> tuple[Floats, Integers]:
    """Compare the pixels of lines with the ideal line, step by step along the longer axis.

    Parameters
    ----------
    ends : (L, 2, 2) float64
        Window x and y in pixels, pixel centres at halves.
    owner, column, row : (P,) int64
    intensity : (P,) float64
        Several pixels of one step are one place: their mean, weighted with it.

    Returns
    -------
    distance : (S,) float64, pixels along the shorter axis between the drawn place and the ideal line
    step : (S,) int64, index of a pixel of each step
    """
    along = ends[:, 1] - ends[:, 0]
    is_steep = np.abs(along[:, 1]) > np.abs(along[:, 0])
    steep = is_steep[owner]
    major, minor = np.where(steep, row, column), np.where(steep, column, row)
    start = np.where(is_steep[:, None], ends[:, 0, ::-1], ends[:, 0])[owner] - 0.5
    run, rise = np.where(is_steep[:, None], along[:, ::-1], along)[owner].T

    # (minor - v0) - (major - u0) rise / run with one division: products of multiples of 1/1024 pixel are exact.
    offset = ((minor - start[:, 1]) * run - (major - start[:, 0]) * rise) / np.where(run == 0, 1.0, run)
    key = np.stack([owner, major], axis=1)
    _, step, of_pixel = np.unique(key, axis=0, return_index=True, return_inverse=True)
    of_pixel = of_pixel.ravel()
    weight = np.bincount(of_pixel, intensity, len(step))
    total = np.bincount(of_pixel, intensity * offset, len(step))
    return np.abs(total / np.where(weight == 0, 1.0, weight)), step.astype(np.int64)
