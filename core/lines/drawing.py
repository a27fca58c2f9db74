"""Draw line segments and points one pixel wide with any method of the table, all segments in one pass.

Colour and depth are interpolated along the major axis: the parameter of a pixel is where its centre's major
coordinate lies between the (unrounded) ends. This is what OpenGL implementations do; OpenGL's text would
project the centre onto the segment at a right angle, which gives other values off the line.
"""

from collections.abc import Callable
from dataclasses import fields, replace
from functools import partial
from math import floor

import numpy as np
from numpy.typing import ArrayLike

from core.coverage.pixel_runs import Raster
from core.lines.line_method import LinePixels, LineRun, LineSteps, Segments, check_segments, line_traits
from core.methods import ReplacedName, table
from core.records.arrays import Flags, Floats, Integers, checked, read_only
from core.records.listing import Operation

# A point of the wireframe: the pixel that contains it, with every line method.


POINT = "point"
"""Kind of the row of a point."""
OPERATIONS = (
    Operation("pixel", "pixel", {"column": "column", "row": "row"}),
    Operation("plot", "draw", {"covered": "pixels"}),
)
"""What the row of a point does."""


def point_listing(x: float, y: float, center: float) -> list[tuple[int, int]]:
    """List the pixel that contains a point; on a border it is the one on the right, or above.

    ``center`` is where a pixel's centre lies from its number: 0.5, or 0.
    """
    pixels = []
    column, row = floor(x - center + 0.5), floor(y - center + 0.5)  #: pixel
    pixels.append((column, row))  #: draw
    return pixels


# Draw line segments one pixel wide with any method of the table, all segments in one pass.


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
        Whether the pixel of the second end is drawn too. ``bresenham-lecture`` always draws it; methods with
        intensities draw both ends as far as the segment reaches.
    pixel_center : {"half", "integer"}
        Whether the centre of pixel (i, j) is (i + 0.5, j + 0.5) or (i, j).

    Returns
    -------
    LinePixels
        Unpacks as ``pixels`` (P, 2) int64 columns and rows, ``intensities`` (P,) float64 above 0 to 1, ``owner`` (P,)
        int64; its ``steps`` are the numbers that decided, found when asked for. The same pixels as on an
        unlimited raster, restricted to this one.

    Raises
    ------
    ValueError
        For a shape, method or raster that is not allowed, an end that is not finite or farther than
        `core.lines.line_method.COORDINATE_LIMIT` pixels from the origin.

    Notes
    -----
    The Bresenham methods move each end to the pixel it lies in (floor of the position where centres are at
    halves; nearest, half up, where they are whole). A segment without length draws nothing, or one pixel with
    ``last_pixel``; methods with intensities draw nothing.

    Examples
    --------
    >>> pixels, intensities, owner = draw_lines([[[0.5, 0.5], [5.5, 2.5]]], 6, 3)
    >>> for row in (2, 1, 0):
    ...     print("|" + "".join(".#"[[column, row] in pixels.tolist()] for column in range(6)) + "|")
    |....#.|
    |..##..|
    |##....|
    """
    center: float = table.get("pixel_center", pixel_center).function()
    return draw_segments(check_segments(segments, width, height, center), line, last_pixel)


def draw_segments(segments: Segments, line: str, last_pixel: bool) -> LinePixels:
    """Find the pixels of L checked segments; see `draw_lines`."""
    rule, find_pixels = table.get("line", line).function, line_traits(line).find_pixels
    if find_pixels is not None and not isinstance(line, ReplacedName):
        # The numbers that chose the pixels are found when they are asked for.
        ends, bounds = segments.pixel_indices.reshape(-1, 4), (0, 0, segments.width, segments.height)
        column, row, owner = find_pixels(ends, bounds, last_pixel)
        find_steps = partial(_run_steps, rule, segments, last_pixel)
        intensities = None
    else:
        run = rule(segments, last_pixel)
        seen = run.seen(segments)
        column, row, owner = run.column.take(seen), run.row.take(seen), run.owner.take(seen)
        find_steps = partial(_steps_of, segments, run, seen)
        intensities = None if run.intensity is None else read_only(run.intensity.take(seen))
    if intensities is None:
        intensities = np.broadcast_to(np.float64(1.0), owner.shape)
    return LinePixels(read_only(np.stack([column, row]).T), intensities, read_only(owner), find_steps)


def _run_steps(rule: Callable[..., LineRun], segments: Segments, last_pixel: bool) -> LineSteps:
    """Return the numbers that chose the pixels on the raster, running ``rule`` to find them."""
    run = rule(segments, last_pixel)
    return _steps_of(segments, run, run.seen(segments))


def _steps_of(segments: Segments, run: LineRun, seen: Integers) -> LineSteps:
    """Return the numbers that chose the pixels ``seen`` (Q,) of a run."""
    count = run.owner.shape

    def known(values: Floats | None, missing: float) -> Floats:
        return np.broadcast_to(np.float64(missing), count) if values is None else values

    every = LineSteps(
        index=run.index,
        t=segment_parameter(run.column, run.row, run.owner, segments.ends, segments.center),
        decision=run.decision,
        has_stepped=run.has_stepped,
        is_tie=run.is_tie,
        exit_start=known(run.exit_start, np.nan),
        exit_end=known(run.exit_end, np.nan),
        along=known(run.along, np.nan),
        line_distance=known(run.line_distance, np.nan),
        share=known(run.share, 1.0),
        intensity=known(run.intensity, 1.0),
        sum_before=known(run.sum_before, np.nan),
        sum_corrected=known(run.sum_corrected, np.nan),
        sum_advanced=known(run.sum_advanced, np.nan),
    )
    return every.select(seen)


def segment_parameter(
    column: Integers, row: Integers, owner: Integers, ends: Floats, center: float
) -> Floats:
    """Place of pixel centres on their segments, along the longer axis: (P,) float64.

    0 at the first end, 1 at the second, 0 everywhere if they coincide (or are too close to divide by). A little
    below 0 or above 1 where a pixel is drawn whose centre lies beyond the end; OpenGL extrapolates there, and so
    do we.

    Parameters
    ----------
    column, row, owner : (P,) int64
        Pixels and the segment of each.
    ends : (L, 2, 2) float64
        First and second end of each segment, window x and y in pixels.
    center : float
        Coordinate of the centre of pixel 0.
    """
    length = ends[:, 1] - ends[:, 0]
    is_steep = np.abs(length[:, 1]) > np.abs(length[:, 0])
    start = np.where(is_steep, ends[:, 0, 1], ends[:, 0, 0])
    whole = np.where(is_steep, length[:, 1], length[:, 0])
    is_point = np.abs(whole) < np.finfo(np.float64).tiny
    whole[is_point] = 1.0

    t = column + np.float64(center)
    np.add(row, center, out=t, where=is_steep.take(owner))
    t -= start.take(owner)
    t /= whole.take(owner)
    if is_point.any():
        t[is_point.take(owner)] = 0.0
    return t


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
        first, second = (1 - t) / w_ends[:, 0].take(owner), t / w_ends[:, 1].take(owner)
        t = second / (first + second)
    rest = 1 - t
    mixed = np.empty((at_ends.shape[2], len(t)))
    for value, (first, second) in zip(mixed, at_ends.transpose(2, 1, 0), strict=True):
        np.multiply(rest, first.take(owner), out=value)
        value += t * second.take(owner)
    return mixed.T


# Lines of which some draw their last pixel: those that were cut there, and those that no other line goes on
# from.


def draw_cut_lines(segments: Floats, draws_last: Flags, raster: Raster, line: str) -> LinePixels:
    """Find the pixels of segments (L, 2, 2) as ``draw_lines`` does, with the last one where ``draws_last`` (L,).

    Notes
    -----
    An outline leaves out the last pixel of each edge because the next edge begins there. No edge begins where the
    border of the raster cut one, and none where a segment by itself ends.
    """
    whole = check_segments(segments, raster.width, raster.height, raster.center)
    if not draws_last.any():
        return draw_segments(whole, line, last_pixel=False)
    of_part = [np.flatnonzero(~draws_last), np.flatnonzero(draws_last)]
    parts = [
        draw_segments(replace(whole, ends=whole.ends[index]), line, last_pixel)
        for last_pixel, index in zip((False, True), of_part, strict=True)
    ]
    owner = np.concatenate([index.take(part.owner) for index, part in zip(of_part, parts, strict=True)])
    order = np.argsort(owner, kind="stable")
    pixels = np.concatenate([part.pixels for part in parts]).take(order, axis=0)
    intensities = np.concatenate([part.intensities for part in parts]).take(order)
    return LinePixels(
        read_only(pixels), read_only(intensities), read_only(owner.take(order)), lambda: _join(parts, order)
    )


def _join(parts: list[LinePixels], order: Integers) -> LineSteps:
    """Return the numbers of the pixels of all parts, in the order of the segments."""
    return LineSteps(
        *(
            read_only(np.concatenate([getattr(part.steps, field.name) for part in parts]).take(order))
            for field in fields(LineSteps)
        )
    )
