"""What lines are measured against: the ideal line one pixel wide, by area, and the distance of pixels from the line.

The ideal line is the rectangle one pixel wide around the segment; a pixel's coverage is the area of the rectangle in
the pixel's square. It is summed over the rectangle's four sides, each with the area between it and the bottom of the
square, counted positive or negative by the side's direction: no polygon has to be clipped, and every pixel is
computed alike.

References
----------
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, SIGGRAPH 1978 (unweighted area).
"""

import numpy as np
from numpy.typing import ArrayLike

from core.raster.lines.records import Segments, check_segments, enumerate_steps
from core.records.arrays import Floats, Integers, read_only

HALF_WIDTH = 0.5
REACH = 1.5
"""Pixels from the segment's box to the farthest centre of a pixel that the rectangle touches, rounded up."""


def cover_ideal_lines(
    segments: ArrayLike, width: int, height: int, pixel_center: str = "half"
) -> tuple[Integers, Floats, Integers]:
    """Find the pixels that ideal lines touch, and how much of their area they cover.

    Parameters
    ----------
    segments : (L, 2, 2) array_like of float
        First and second end of each segment, window x and y in pixels, as `core.raster.lines.drawing.draw_lines`
        takes them.
    width, height : int
        Raster in pixels.
    pixel_center : {"half", "integer"}

    Returns
    -------
    pixels : (P, 2) int64
        Columns and rows on the raster, segment by segment, row by row.
    coverage : (P,) float64
        Area in square pixels, above 0 to 1; right to about 1e-15 times the size of the coordinates.
    owner : (P,) int64

    Notes
    -----
    A segment without length covers nothing. The sum over an unlimited raster is the segment's length.

    Examples
    --------
    >>> pixels, coverage, _ = cover_ideal_lines([[[0.0, 0.5], [2.5, 0.5]]], 4, 1)
    >>> pixels[:, 0].tolist(), coverage.tolist()
    ([0, 1, 2], [1.0, 1.0, 0.5])
    """
    checked = check_segments(segments, width, height, pixel_center)
    column, row, owner = _near_pixels(checked)
    corners = _rectangle_corners(checked.centered_ends)
    coverage = np.zeros(len(owner))
    for side in range(4):
        start, end = corners[owner, side], corners[owner, (side + 1) % 4]
        coverage += _area_below(start[:, 0] - column, start[:, 1] - row, end[:, 0] - column, end[:, 1] - row)
    kept = np.flatnonzero(coverage > 0)
    pixels = np.stack([column[kept], row[kept]], axis=1)
    return read_only(pixels), read_only(np.minimum(coverage[kept], 1.0)), read_only(owner[kept])


def _near_pixels(segments: Segments) -> tuple[Integers, Integers, Integers]:
    """List column, row and segment (Q,) of all pixels that a rectangle may touch, along the rows of its box."""
    ends = segments.centered_ends
    low, high = ends.min(axis=1), ends.max(axis=1)
    first_row = np.clip(np.ceil(low[:, 1] - REACH), 0, segments.height).astype(np.int64)
    last_row = np.clip(np.floor(high[:, 1] + REACH) + 1, 0, segments.height).astype(np.int64)
    owner, row = enumerate_steps(first_row, last_row)

    # Of each row the part where the line is within reach; a level line is near everywhere.
    way = ends[:, 1] - ends[:, 0]
    length = np.hypot(way[:, 0], way[:, 1])
    rise = np.where(way[:, 1] == 0, 1.0, way[:, 1])[owner]
    at = [(row + edge - ends[owner, 0, 1]) / rise * way[owner, 0] + ends[owner, 0, 0] for edge in (-0.5, 0.5)]
    with np.errstate(over="ignore", invalid="ignore"):
        spread = 1.0 + HALF_WIDTH * length[owner] / np.abs(rise)
        left = np.maximum(np.minimum(*at) - spread, low[owner, 0] - REACH)
        right = np.minimum(np.maximum(*at) + spread, high[owner, 0] + REACH)
    is_level = way[owner, 1] == 0
    left = np.where(is_level, low[owner, 0] - REACH, left)
    right = np.where(is_level, high[owner, 0] + REACH, right)
    first = np.clip(np.ceil(left), 0, segments.width).astype(np.int64)
    last = np.clip(np.floor(right) + 1, 0, segments.width).astype(np.int64)
    run, column = enumerate_steps(first, last)
    return column, row[run], owner[run]


def _rectangle_corners(ends: Floats) -> Floats:
    """Return the corners (L, 4, 2) of the rectangles around segments (L, 2, 2), counterclockwise."""
    way = ends[:, 1] - ends[:, 0]
    length = np.hypot(way[:, 0], way[:, 1])
    length = np.where(length == 0, 1.0, length)
    left = np.stack([-way[:, 1], way[:, 0]], axis=1) * (HALF_WIDTH / length)[:, None]
    return np.stack([ends[:, 0] - left, ends[:, 1] - left, ends[:, 1] + left, ends[:, 0] + left], axis=1)


def _area_below(x0: Floats, y0: Floats, x1: Floats, y1: Floats) -> Floats:
    """Area between a side and the bottom of the square from -1/2 to 1/2 on both axes, (Q,) float64 each.

    Above 0 where the side runs to the left, so that the sides of a counterclockwise polygon add up to its area.
    """
    x0, y0, x1, y1 = x0 + 0.5, y0 + 0.5, x1 + 0.5, y1 + 0.5
    run, rise = x1 - x0, y1 - y0
    upright, level = run == 0, rise == 0
    slope, inverse = rise / np.where(upright, 1.0, run), run / np.where(level, 1.0, rise)

    # The part of the side over the square, then that between the square's bottom and top.
    low, high = np.clip(np.minimum(x0, x1), 0.0, 1.0), np.clip(np.maximum(x0, x1), 0.0, 1.0)
    at_bottom, at_top = x0 - y0 * inverse, x0 + (1.0 - y0) * inverse
    first, last = np.minimum(at_bottom, at_top), np.maximum(at_bottom, at_top)
    is_between = (y0 >= 0) & (y0 <= 1)
    first = np.where(level, np.where(is_between, low, high), np.clip(first, low, high))
    last = np.where(level, high, np.clip(last, low, high))
    middle = np.clip(y0 + ((first + last) / 2 - x0) * slope, 0.0, 1.0)
    slanted = (last - first) * middle

    # Beyond it the side is above the square, and counts whole, or below it, and counts nothing.
    starts_above = np.where(level, y0 > 1, slope < 0)
    ends_above = np.where(level, y0 > 1, slope > 0)
    whole = np.where(starts_above, first - low, 0.0) + np.where(ends_above, high - last, 0.0)
    area = np.where(upright, 0.0, slanted + whole)
    return np.asarray(np.where(run < 0, area, -area))


def line_distance(
    pixels: Integers, owner: Integers, segments: ArrayLike, pixel_center: str = "half"
) -> Floats:
    """Distance of pixel centres from the unlimited lines through segments, in pixels, 0 or more.

    Parameters
    ----------
    pixels : (P, 2) int64
        Columns and rows.
    owner : (P,) int64
        The segment that each is measured from.
    segments : (L, 2, 2) array_like of float
    pixel_center : {"half", "integer"}

    Returns
    -------
    (P,) float64
        From the end where a segment has no length.
    """
    ends = check_segments(segments, 1, 1, pixel_center).centered_ends[owner]
    way, offset = ends[:, 1] - ends[:, 0], pixels - ends[:, 0]
    length = np.hypot(way[:, 0], way[:, 1])
    cross = way[:, 0] * offset[:, 1] - way[:, 1] * offset[:, 0]
    is_point = length == 0
    from_line = np.abs(cross) / np.where(is_point, 1.0, length)
    return np.asarray(np.where(is_point, np.hypot(offset[:, 0], offset[:, 1]), from_line))
