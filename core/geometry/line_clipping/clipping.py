"""Line clipping: what is left of segments in a window, by any method of the family ``line_clipping``."""

import numpy as np
from numpy.typing import ArrayLike

from core.geometry.line_clipping.records import (
    LINE_CLIP_LIMIT,
    ClippedLines,
    polygon_window,
    rectangle_window,
)
from core.methods import table
from core.records.arrays import checked


def clip_lines(segments: ArrayLike, window: ArrayLike, method: str = "liang-barsky") -> ClippedLines:
    """Clip line segments to a window.

    Parameters
    ----------
    segments : (L, 2, 2) array_like of float
        First and second end of each, x and y.
    window : (4,) or (M, 2) array_like of float
        Left, bottom, right and top of a rectangle, or the corners of a convex polygon, counter-clockwise. Its
        border is inside.
    method : str
        A method of the family ``line_clipping``; Cohen-Sutherland and Liang-Barsky need a rectangle.

    Returns
    -------
    ClippedLines

    Raises
    ------
    ValueError
        For a shape, window or method that is not allowed, and for a coordinate that is not finite or larger than
        `core.geometry.line_clipping.records.LINE_CLIP_LIMIT`.

    Notes
    -----
    A segment of no length is a point: kept inside and on the border, dropped outside.

    Examples
    --------
    >>> clipped = clip_lines([[[-2, 1], [6, 5]], [[5, 1], [6, 2]]], (0, 0, 4, 3))
    >>> clipped.segments[clipped.is_kept].tolist()
    [[[0.0, 2.0], [2.0, 3.0]]]
    >>> clipped.is_kept.tolist()
    [True, False]
    """
    ends = checked("segments", segments, ("L", 2, 2), limit=LINE_CLIP_LIMIT)
    is_rectangle = np.ndim(window) == 1
    region = rectangle_window(*checked("window", window, (4,))) if is_rectangle else polygon_window(window)
    clipped: ClippedLines = table.get("line_clipping", method).function(ends, region)
    return clipped
