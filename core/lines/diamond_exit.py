"""OpenGL's line: a pixel is drawn where the segment leaves the diamond around the pixel's centre.

The diamond of a pixel holds the points with ``|x - xc| + |y - yc| < 1/2``. A line that is nowhere steeper
than 45 degrees meets at most one diamond in a column: that of the centre nearest to it there. The segment
leaves this diamond if its second end is through it and its first end is not, where "through" is one
comparison: ``s (u - uc) + |v - vc| >= 1/2``, s = 1 or -1 for the direction along the major axis.

All decisions are exact integers. The line that chooses the pixel of a column goes through the ends snapped to
1/256 pixel, as coverage does; the ends' own comparisons use them unsnapped. Ties are decided as OpenGL says,
by moving the segment an infinitesimal step left, then down (the samples right, then up: the rule of shared
edges).

References
----------
OpenGL 4.6 (core profile), 14.5.1 "Basic Line Segment Rasterization".
"""

from dataclasses import dataclass

import numpy as np

from core.coverage.snapping import SUBPIXELS
from core.lines.line_method import (
    COLUMN,
    OCTANT,
    PLOT,
    LineRun,
    Segments,
    enumerate_steps,
    line_rows,
    major_first,
    visible_range,
)
from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Operation

END_SUBPIXELS = 2**32
"""The same for the ends' own comparisons: so fine that hardly a float64 end is moved."""

Listed = list[tuple[int, int, float]]
"""Column, row, and the line's height above the pixel's centre, from a listing."""

_EXIT = (
    COLUMN,
    Operation("round", "round", {"minor": "y"}, ("decision", "is_tie", "has_stepped")),
    Operation("leaves", "leaves", takes=("exit_start", "exit_end")),
    PLOT,
)


@dataclass(frozen=True, eq=False)
class _Course:
    """L segments, major axis first, in coordinates where pixel centres are whole multiples of the grid."""

    is_steep: Flags
    step: Integers
    """(L,) int64 s, 1 or -1."""
    start: Integers
    """(L,) int64 first column that the segment may draw in."""
    count: Integers
    """(L,) int64 columns from the first to the last."""
    snapped: Integers
    """(L, 2) int64 first end in 1/256 pixel."""
    run: Integers
    """(L,) int64 length along the major axis in 1/256 pixel, at least 1."""
    rise: Integers
    """(L,) int64 change of the minor coordinate over ``run``, in 1/256 pixel."""
    ends: Integers
    """(L, 2, 2) int64 both ends in 2**-32 pixel."""


@dataclass(frozen=True, eq=False)
class _Verdict:
    """Decisions about P (segment, column) pairs."""

    minor: Integers
    is_drawn: Flags
    offset: Floats
    is_tie: Flags
    exit_start: Floats
    exit_end: Floats


def _grid(segments: Segments, subpixels: int) -> Integers:
    """(L, 2, 2) int64 ends in 1/subpixels, half to even, with pixel centres on whole pixels."""
    return np.rint(segments.ends * subpixels).astype(np.int64) - int(segments.center * subpixels)


def _course(segments: Segments) -> _Course:
    ends = _grid(segments, END_SUBPIXELS)
    length = np.abs(ends[:, 1] - ends[:, 0])
    is_steep = length[:, 1] > length[:, 0]
    ends = major_first(ends, is_steep)
    snapped = major_first(_grid(segments, SUBPIXELS), is_steep)
    step = np.where(ends[:, 1, 0] < ends[:, 0, 0], -1, 1)

    # Columns whose diamonds reach to the segment.
    low, high = ends[..., 0].min(axis=1), ends[..., 0].max(axis=1)
    lowest = -((END_SUBPIXELS // 2 - low) // END_SUBPIXELS)
    highest = (high + END_SUBPIXELS // 2) // END_SUBPIXELS

    # Snapping may turn a very short segment; it stays within 45 degrees of its major axis.
    run = step * (snapped[:, 1, 0] - snapped[:, 0, 0])
    rise = np.clip(snapped[:, 1, 1] - snapped[:, 0, 1], -run, run)
    start = np.where(step > 0, lowest, highest)
    return _Course(is_steep, step, start, highest - lowest + 1, snapped[:, 0], np.maximum(run, 1), rise, ends)


def nearest_minor(
    u: Integers, snapped: Integers, run: Integers, rise: Integers, step: Integers, is_steep: Flags
) -> tuple[Integers, Floats, Flags]:
    """Choose the pixel of column u whose centre is nearest to the line.

    Parameters
    ----------
    u, run, rise, step : (P,) int64
        Column; the line's run > 0, rise and direction in 1/256 pixel.
    snapped : (P, 2) int64
        A point of the line in 1/256 pixel.
    is_steep : (P,) bool

    Returns
    -------
    minor : (P,) int64
    offset : (P,) float64
        Height of the line above the pixel's centre, in pixels, from -1/2 to 1/2.
    is_tie : (P,) bool
        The line passes exactly between two pixels. A rising line takes the upper one, any other the lower
        one; a steep line the left one.
    """
    numerator = (snapped[:, 1] + SUBPIXELS // 2) * run + (SUBPIXELS * u - snapped[:, 0]) * rise * step
    denominator = SUBPIXELS * run
    minor = numerator // denominator
    rest = numerator - minor * denominator
    is_tie = rest == 0
    moves_down = is_tie & (is_steep | (rise * step <= 0))
    offset = (2 * rest - denominator) / (2 * denominator)
    return minor - moves_down, offset + moves_down, is_tie


def _judge(course: _Course, owner: Integers, k: Integers, last_pixel: bool) -> _Verdict:
    """Decide column k of segment ``owner``, both (P,) int64."""
    step, is_steep = course.step[owner], course.is_steep[owner]
    u = course.start[owner] + step * k
    minor, offset, is_tie = nearest_minor(
        u, course.snapped[owner], course.run[owner], course.rise[owner], step, is_steep
    )

    # Which ends are through the diamond; at a tie the infinitesimal move decides.
    half = END_SUBPIXELS // 2
    along = step[:, None] * (course.ends[owner, :, 0] - END_SUBPIXELS * u[:, None])
    across = course.ends[owner, :, 1] - END_SUBPIXELS * minor[:, None]
    through = along + np.abs(across)
    is_edge = through == half
    goes_through = np.where(is_steep[:, None], across <= 0, step[:, None] < 0)
    is_through = (through > half) | (is_edge & goes_through)
    is_drawn = ~is_through[:, 0] & is_through[:, 1]
    if last_pixel:
        # Also the diamond that the segment ends in: reached by the second end, not yet left.
        reach = np.abs(across[:, 1]) - along[:, 1]
        is_reached = (reach < half) | ((reach == half) & np.where(is_steep, across[:, 1] > 0, step < 0))
        is_drawn |= ~is_through[:, 0] & is_reached
    exits = through / END_SUBPIXELS
    return _Verdict(minor, is_drawn, offset, is_tie | is_edge.any(axis=1), exits[:, 0], exits[:, 1])


def diamond_exit_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``diamond-exit`` on one segment, in whole numbers; pixel centres are whole numbers."""
    u0, v0, u1, v1 = [round(end * END_SUBPIXELS) for end in (x0, y0, x1, y1)]
    a, b, c, d = [round(end * SUBPIXELS) for end in (x0, y0, x1, y1)]
    is_steep = abs(v1 - v0) > abs(u1 - u0)  #: octant
    if is_steep:
        u0, v0, u1, v1 = v0, u0, v1, u1
        a, b, c, d = b, a, d, c
    s = -1 if u1 < u0 else 1
    run, rise = (c - a, d - b) if c > a else (a - c, b - d) if c < a else (1, 0)
    rise = min(max(rise, -run), run)
    pixels = []
    first = -((END_SUBPIXELS - 2 * min(u0, u1)) // (2 * END_SUBPIXELS))
    last = (2 * max(u0, u1) + END_SUBPIXELS) // (2 * END_SUBPIXELS)
    for x in range(first, last + 1)[::s]:  #: column
        height, unit = b * run + (x * SUBPIXELS - a) * rise, SUBPIXELS * run
        is_lower = (2 * height + unit) % (2 * unit) == 0 and (is_steep or rise <= 0)
        y = (2 * height + unit) // (2 * unit) - (1 if is_lower else 0)  #: round
        u, v = x * END_SUBPIXELS, y * END_SUBPIXELS
        begins = not is_through(u0 - u, v0 - v, s, is_steep)
        leaves = begins and is_through(u1 - u, v1 - v, s, is_steep)
        ends_here = last_pixel and begins and is_reached(u1 - u, v1 - v, s, is_steep)
        if leaves or ends_here:  #: leaves
            above = (height - y * unit) / unit
            pixels.append((y, x, above) if is_steep else (x, y, above))  #: draw
    return pixels


def is_through(across: int, up: int, s: int, is_steep: bool) -> bool:
    """Return whether an end, so far from a pixel's centre, lies behind its diamond; in 1/END_SUBPIXELS pixel."""
    through = 2 * (s * across + abs(up))
    on_border = up <= 0 if is_steep else s < 0
    return on_border if through == END_SUBPIXELS else through > END_SUBPIXELS


def is_reached(across: int, up: int, s: int, is_steep: bool) -> bool:
    """Return whether the line enters the diamond of a pixel's centre before such an end."""
    reach = 2 * (abs(up) - s * across)
    on_border = up > 0 if is_steep else s < 0
    return on_border if reach == END_SUBPIXELS else reach < END_SUBPIXELS


@method(
    "line",
    "diamond-exit",
    "Diamond exit (OpenGL)",
    source="OpenGL 4.6, 14.5.1 Basic Line Segment Rasterization",
    exact_for="any ends: OpenGL's rule for the line through the ends snapped to 1/256 pixel. Both directions "
    "take the same pixel at a tie",
    breaks_where="ties: they follow the window's axes, so a mirrored line is not the mirror image. Snapping may "
    "turn segments of a few 1/256 pixel, and they are lost",
    listing=diamond_exit_listing,
    operations=line_rows("diamond-exit", (OCTANT, *_EXIT), _EXIT),
)
def diamond_exit(segments: Segments, last_pixel: bool) -> LineRun:
    """Draw the pixels whose diamond the segment leaves; ``decision`` is the line's height above the centre.

    With ``last_pixel`` also the pixel whose diamond it ends in.
    """
    course = _course(segments)
    slope = course.rise / course.run
    distance = course.step * (course.start - course.snapped[:, 0] / SUBPIXELS)
    v = course.snapped[:, 1] / SUBPIXELS + distance * slope
    first, last = visible_range(segments, course.is_steep, course.start, course.step, v, slope, course.count)
    owner, k = enumerate_steps(first, last)
    verdict = _judge(course, owner, k, last_pixel)

    # The line's first pixel is in its first column or in the next; pixels are counted from it.
    everyone = np.arange(len(course.start))
    begins_late = ~_judge(course, everyone, np.zeros_like(everyone), last_pixel).is_drawn
    index = k - begins_late[owner]
    step, is_steep = course.step[owner], course.is_steep[owner]
    major = course.start[owner] + step * k
    before, _, _ = nearest_minor(
        major - step, course.snapped[owner], course.run[owner], course.rise[owner], step, is_steep
    )
    column, row = np.where(is_steep, verdict.minor, major), np.where(is_steep, major, verdict.minor)
    drawn = verdict.is_drawn
    return LineRun(
        owner[drawn],
        index[drawn],
        column[drawn],
        row[drawn],
        verdict.offset[drawn],
        ((verdict.minor != before) & (index > 0))[drawn],
        verdict.is_tie[drawn],
        verdict.exit_start[drawn],
        verdict.exit_end[drawn],
    )
