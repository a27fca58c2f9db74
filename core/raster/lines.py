"""Draw line segments one pixel wide with any method of the table, all segments in one pass.

Colour and depth are interpolated along the major axis: the parameter of a pixel is where its centre's major
coordinate lies between the (unrounded) ends. This is what OpenGL implementations do; OpenGL's text would
project the centre onto the segment at a right angle, which gives other values off the line.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core.arrays import Floats, Integers, checked, read_only
from core.methods import table
from core.raster.bresenham import bresenham_float_listing, bresenham_lecture_listing, bresenham_listing
from core.raster.dda import dda_listing, midpoint_listing
from core.raster.diamond_exit import diamond_exit_listing
from core.raster.line_records import LinePixels, LineSteps, check_segments

LISTINGS: dict[str, Callable[..., Any]] = {
    "bresenham": bresenham_listing,
    "bresenham-lecture": bresenham_lecture_listing,
    "bresenham-float": bresenham_float_listing,
    "midpoint": midpoint_listing,
    "dda": dda_listing,
    "diamond-exit": diamond_exit_listing,
}
"""The scalar listing of each method. Bresenham's take pixels, the others positions with centres on whole
numbers."""


def draw_lines(
    segments: ArrayLike,
    width: int,
    height: int,
    line: str = "bresenham",
    last_pixel: bool = False,
    pixel_center: str = "half",
) -> LinePixels:
    """Find the pixels of line segments, in drawing order: segment by segment, each along its major axis.

    Parameters
    ----------
    segments : (L, 2, 2) array_like of float
        First and second end of each segment, window x and y in pixels, y up.
    width, height : int
        Raster in pixels; what lies outside is not drawn.
    line : str
        A method of the family ``line``.
    last_pixel : bool
        Whether the pixel of the second end is drawn too. ``bresenham-lecture`` always draws it.
    pixel_center : {"half", "integer"}
        Whether the centre of pixel (i, j) is (i + 0.5, j + 0.5) or (i, j).

    Returns
    -------
    LinePixels
        Unpacks as ``pixels`` (P, 2) int64 columns and rows, ``intensities`` (P,) float64, ``owner`` (P,)
        int64; its ``steps`` keep the numbers that decided. The same pixels as on an unlimited raster,
        restricted to this one.

    Raises
    ------
    ValueError
        For a shape, method or raster that is not allowed, an end that is not finite or farther than
        `core.raster.line_records.COORDINATE_LIMIT` pixels from the origin.

    Notes
    -----
    The Bresenham methods move each end to the pixel it lies in (floor of the position where centres are at
    halves; nearest, half up, where they are whole). A segment without length draws nothing, or one pixel with
    ``last_pixel``.

    Examples
    --------
    >>> pixels, intensities, owner = draw_lines([[[0.5, 0.5], [5.5, 2.5]]], 6, 3)
    >>> for row in (2, 1, 0):
    ...     print("|" + "".join(".#"[[column, row] in pixels.tolist()] for column in range(6)) + "|")
    |....#.|
    |..##..|
    |##....|
    """
    checked_segments = check_segments(segments, width, height, pixel_center)
    run = table.get("line", line).function(checked_segments, last_pixel)
    on_raster = (run.column >= 0) & (run.column < width) & (run.row >= 0) & (run.row < height)
    pixels, owner = np.stack([run.column, run.row], axis=-1)[on_raster], run.owner[on_raster]
    centers = pixels + checked_segments.center
    none = np.full(len(owner), np.nan)
    steps = LineSteps(
        index=read_only(run.index[on_raster]),
        t=read_only(segment_parameter(centers, checked_segments.ends[owner])),
        decision=read_only(run.decision[on_raster]),
        has_stepped=read_only(run.has_stepped[on_raster]),
        is_tie=read_only(run.is_tie[on_raster]),
        exit_start=read_only(none if run.exit_start is None else run.exit_start[on_raster]),
        exit_end=read_only(none if run.exit_end is None else run.exit_end[on_raster]),
    )
    return LinePixels(read_only(pixels), read_only(np.ones(len(owner))), read_only(owner), steps)


def segment_parameter(centers: Floats, ends: Floats) -> Floats:
    """Place of pixel centres (P, 2) on their segments (P, 2, 2), along the longer axis: (P,) float64.

    0 at the first end, 1 at the second, 0 everywhere if they coincide (or are too close to divide by). A little
    below 0 or above 1 where a pixel is drawn whose centre lies beyond the end; OpenGL extrapolates there, and so
    do we.
    """
    start, length = ends[:, 0], ends[:, 1] - ends[:, 0]
    is_steep = np.abs(length[:, 1]) > np.abs(length[:, 0])
    along = np.where(is_steep, centers[:, 1] - start[:, 1], centers[:, 0] - start[:, 0])
    whole = np.where(is_steep, length[:, 1], length[:, 0])
    is_point = np.abs(whole) < np.finfo(np.float64).tiny
    return np.asarray(np.where(is_point, 0.0, along / np.where(is_point, 1.0, whole)))


def interpolate_line(owner: Integers, t: Floats, values: ArrayLike, w: ArrayLike | None = None) -> Floats:
    """Interpolate values of the ends to the pixels: ``(1 - t) first + t second``.

    Parameters
    ----------
    owner : (P,) int64
    t : (P,) float64
        ``LinePixels.owner`` and ``LineSteps.t``.
    values : (L, 2, K) array_like of float
        K numbers at both ends of each segment. Window depth is linear in the window: interpolate it without
        ``w``.
    w : (L, 2) array_like of float, optional
        Positive clip w of the ends, for perspective-correct values: t becomes ``(t / w1) / ((1 - t) / w0 + t
        / w1)``.

    Returns
    -------
    (P, K) float64

    Raises
    ------
    ValueError
        If shapes do not match or a w is not positive.
    """
    at_ends = checked("values", values, ("L", 2, "K"))
    if w is not None:
        w_ends = checked("w", w, ("L", 2))
        if len(w_ends) != len(at_ends):
            raise ValueError(f"w must be ({len(at_ends)}, 2), got {w_ends.shape}")
        if (w_ends <= 0).any():
            raise ValueError(f"w must be positive, got {w_ends[(w_ends <= 0).any(axis=1)][0].tolist()}")
        first, second = (1 - t) / w_ends[owner, 0], t / w_ends[owner, 1]
        t = second / (first + second)
    return np.asarray((1 - t)[:, None] * at_ends[owner, 0] + t[:, None] * at_ends[owner, 1])
