"""Bresenham's line in three versions: integers, integers as printed (LMU), and a float error.

After i steps along the major axis the line has climbed ``i dv / du``; the pixel is the nearest one. The
decision value D = 2 du (climb at the next step - pixels climbed - 1/2) needs no fraction, and tells by its
sign whether the minor coordinate must step. A tie is D = 0.

Both integer versions also have a closed form, ``floor((2 dv i + du) / (2 du))`` steps after i. The vectorised
rules use it, so a line may begin at any i; the listings step, as the lectures do; both give the same numbers.

References
----------
J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4(1), 1965.
LMU, *Computer Graphics 1*, tutorial "Rasterization", Bresenham Algorithm and Task 1 g).
"""

from collections.abc import Mapping
from math import nan

import numpy as np

from core.lines.line_method import (
    DIRECTIONS,
    NEXT,
    OCTANT,
    PLOT,
    SLOPE,
    START,
    STEP_LIMIT,
    Coefficients,
    LineRun,
    LineTraits,
    Segments,
    advance,
    correct,
    enumerate_steps,
    first_sum,
    limited_steps,
    line_rows,
    major_first,
    visible_range,
)
from core.lines.many_lines import find_line_pixels
from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Operation

Listed = list[tuple[int, int, float]]
"""Column and row of each pixel, and D or e when it is drawn, from a listing."""

LENGTHS = Operation("lengths", "lengths", ("dx", "dy"))
STEP = Operation("step", "step", {"minor": "y"})
TEST = Operation("test", "test", takes=("is_tie", "has_stepped"))
ERROR_TEST = Operation("test", "test", takes=("decision", "is_tie", "has_stepped"))
_SET_UP = (OCTANT, LENGTHS, DIRECTIONS)


def _rows(
    line: str, first: tuple[Operation, ...], test: Operation, name: str
) -> Mapping[str, tuple[Operation, ...]]:
    """Return the rows of a version, whose sum the listing calls ``name``."""
    moved = (advance(name), NEXT, PLOT)
    start = (*first, START, first_sum(name), PLOT)
    return line_rows(line, start, (test, *moved), (test, STEP, correct(name), *moved))


def no_coefficients(ends: Floats) -> Coefficients:
    """Return NaN (L,) twice: the integer versions have no slope. ``ends`` (L, 2, 2), the major axis first."""
    return np.full(len(ends), nan), np.full(len(ends), nan)


def error_slope(ends: Floats) -> Coefficients:
    """Return the slope (L,) that is added to the error, between 0 and 1, of ends (L, 2, 2) u, v; no intercept."""
    run, rise = np.abs(ends[:, 1] - ends[:, 0]).T
    return rise / np.maximum(run, 1), np.full(len(ends), nan)


def climb(i: Integers, du: Integers, dv: Integers) -> Integers:
    """Minor steps after i major steps when the minor coordinate steps at D >= 0. (P,) int64 each, du > 0."""
    return (2 * dv * i + du) // (2 * du)


def climb_lecture(i: Integers, du: Integers, dv: Integers) -> Integers:
    """Minor steps after i major steps when it steps at D > 0 only. (P,) int64 each, du > 0."""
    return (2 * dv * i + du - 1) // (2 * du)


def decision_value(i: Integers, du: Integers, dv: Integers, climbed: Integers) -> Integers:
    """D that chooses pixel i, after ``climbed`` minor steps up to pixel i - 1. (P,) int64 each."""
    return 2 * dv * i - du - 2 * du * climbed


def _integer_run(
    pixels: Integers, is_steep: Flags, segments: Segments, last_pixel: bool, steps_at_tie: bool
) -> LineRun:
    """Run an integer version between ``pixels``, (L, 2, 2) int64 with the major axis first."""
    (u, v), (u_end, v_end) = np.moveaxis(pixels[:, 0], 1, 0), np.moveaxis(pixels[:, 1], 1, 0)
    u_step, v_step = np.where(u_end < u, -1, 1), np.where(v_end < v, -1, 1)
    length, dv = np.abs(u_end - u), np.abs(v_end - v)
    du = np.maximum(length, 1)
    slope = v_step * (dv / du)
    first, last = visible_range(segments, is_steep, u, u_step, v.astype(float), slope, length + last_pixel)
    owner, i = enumerate_steps(first, last)

    # Pixel i, pixel i - 1, and the decision between them.
    du, dv, length = du[owner], dv[owner], length[owner]
    rule = climb if steps_at_tie else climb_lecture
    climbed, climbed_before = rule(i, du, dv), rule(i - 1, du, dv)
    decision = decision_value(i, du, dv, climbed_before)
    is_start = i == 0
    has_stepped = (climbed > climbed_before) & ~is_start
    corrected = decision - 2 * du * has_stepped
    major, minor = u[owner] + u_step[owner] * i, v[owner] + v_step[owner] * climbed
    is_steep = is_steep[owner]
    return LineRun(
        owner,
        i,
        np.where(is_steep, minor, major),
        np.where(is_steep, major, minor),
        np.where(is_start, np.nan, decision),
        has_stepped,
        (decision == 0) & ~is_start,
        sum_before=np.where(is_start, np.nan, decision),
        sum_corrected=np.where(has_stepped, corrected, np.nan),
        sum_advanced=decision_value(i + 1, length, dv, climbed).astype(float),
    )


def bresenham_listing(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """List the pixels of ``bresenham`` between two pixels."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    dx, dy = abs(x1 - x0), abs(y1 - y0)  #: lengths
    sx, sy = (-1 if x1 < x0 else 1), (-1 if y1 < y0 else 1)  #: directions
    x, y = x0, y0  #: start
    D = 2 * dy - dx  #: first-sum
    pixels: Listed = []
    for _ in range(dx + last_pixel):
        pixels.append((y, x, D) if is_steep else (x, y, D))  #: draw
        if D >= 0:  #: test
            y += sy  #: step
            D -= 2 * dx  #: correct
        D += 2 * dy  #: advance
        x += sx  #: next
    return pixels


@method(
    "line",
    "bresenham",
    "Bresenham, integers",
    source="J. E. Bresenham, Algorithm for computer control of a digital plotter, 1965",
    exact_for="ends on pixel centres: always the nearest pixel. A tie takes the diagonal step",
    breaks_where="other ends: they move to the centre of their pixel. Drawn backwards, a tie takes the other pixel",
    listing=bresenham_listing,
    operations=_rows("bresenham", _SET_UP, TEST, "D"),
    traits=LineTraits(takes_pixels=True, coefficients=no_coefficients, find_pixels=find_line_pixels),
)
def bresenham(segments: Segments, last_pixel: bool) -> LineRun:
    """Draw from the first end to the second, stepping where D >= 0; ``decision`` is D."""
    pixels = segments.pixel_indices
    length = np.abs(pixels[:, 1] - pixels[:, 0])
    is_steep = length[:, 1] > length[:, 0]
    return _integer_run(major_first(pixels, is_steep), is_steep, segments, last_pixel, steps_at_tie=True)


def bresenham_lecture_listing(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """List the pixels of ``bresenham-lecture`` between two pixels; the last one is always drawn."""
    is_steep = not abs(y1 - y0) < abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    if x0 > x1:
        x0, y0, x1, y1 = x1, y1, x0, y0
    dx, dy = x1 - x0, abs(y1 - y0)  #: lengths
    sx, sy = 1, (-1 if y1 < y0 else 1)  #: directions
    x, y = x0, y0  #: start
    D = 2 * dy - dx  #: first-sum
    pixels: Listed = []
    while x <= x1:
        pixels.append((y, x, D) if is_steep else (x, y, D))  #: draw
        if D > 0:  #: test
            y += sy  #: step
            D -= 2 * dx  #: correct
        D += 2 * dy  #: advance
        x += sx  #: next
    return pixels


@method(
    "line",
    "bresenham-lecture",
    "Bresenham, as printed (LMU)",
    source="LMU, Computer Graphics 1, Task 1 g) Bresenham (complete version)",
    exact_for="ends on pixel centres: always a nearest pixel, the same in both directions",
    breaks_where="mirrored lines: ends are swapped to run left to right or bottom to top, and a tie takes the "
    "straight step (D > 0), so the line is not the mirror image. Lines that share an end: the last "
    "pixel is always drawn, so both draw it",
    listing=bresenham_lecture_listing,
    operations=_rows("bresenham-lecture", _SET_UP, TEST, "D"),
    traits=LineTraits(
        takes_pixels=True,
        is_diagonal_steep=True,
        swaps_ends=True,
        coefficients=no_coefficients,
        right="bresenham",
    ),
)
def bresenham_lecture(segments: Segments, last_pixel: bool) -> LineRun:
    """Draw from left to right (steep: bottom to top), stepping where D > 0; ``decision`` is D.

    The last pixel is drawn whatever ``last_pixel`` says; ``index`` counts in the order of drawing.
    """
    pixels = segments.pixel_indices
    length = np.abs(pixels[:, 1] - pixels[:, 0])
    is_steep = length[:, 1] >= length[:, 0]
    pixels = major_first(pixels, is_steep)
    is_backward = pixels[:, 0, 0] > pixels[:, 1, 0]
    pixels = np.where(is_backward[:, None, None], pixels[:, ::-1], pixels)
    return _integer_run(pixels, is_steep, segments, last_pixel=True, steps_at_tie=False)


def bresenham_float_listing(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """List the pixels of ``bresenham-float`` between two pixels."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    dx, dy = abs(x1 - x0), abs(y1 - y0)  #: lengths
    sx, sy = (-1 if x1 < x0 else 1), (-1 if y1 < y0 else 1)  #: directions
    m = dy / max(dx, 1)  #: slope
    x, y = x0, y0  #: start
    e = 0.0  #: first-sum
    pixels: Listed = []
    for _ in range(dx + last_pixel):
        pixels.append((y, x, e) if is_steep else (x, y, e))  #: draw
        if e + m > 0.5:  #: test
            y += sy  #: step
            e -= 1  #: correct
        e += m  #: advance
        x += sx  #: next
    return pixels


@method(
    "line",
    "bresenham-float",
    "Bresenham, float error",
    source="LMU, Computer Graphics 1, Bresenham Algorithm: error e and slope m",
    exact_for="ends on pixel centres: a nearest pixel, up to the rounding of e. A tie takes the straight step",
    breaks_where="ties: e accumulates rounding errors, so a tie may go either way. Other ends move to the centre "
    f"of their pixel. More than {STEP_LIMIT} steps are refused",
    listing=bresenham_float_listing,
    operations=_rows("bresenham-float", (*_SET_UP, SLOPE), ERROR_TEST, "e"),
    traits=LineTraits(takes_pixels=True, coefficients=error_slope),
)
def bresenham_float(segments: Segments, last_pixel: bool) -> LineRun:
    """Draw from the first end to the second, stepping where e + m > 0.5; ``decision`` is e + m.

    Raises
    ------
    ValueError
        If a segment needs more than `STEP_LIMIT` steps before it leaves the raster.

    Notes
    -----
    Each error is rounded from the one before, so the steps of one line run one after the other, for all lines
    together; those before the raster are run too.
    """
    pixels = segments.pixel_indices
    lengths = np.abs(pixels[:, 1] - pixels[:, 0])
    is_steep = lengths[:, 1] > lengths[:, 0]
    pixels = major_first(pixels, is_steep)
    (u, v), (u_end, v_end) = np.moveaxis(pixels[:, 0], 1, 0), np.moveaxis(pixels[:, 1], 1, 0)
    u_step, v_step = np.where(u_end < u, -1, 1), np.where(v_end < v, -1, 1)
    length = np.abs(u_end - u)
    slope = np.abs(v_end - v) / np.maximum(length, 1)
    first, last = visible_range(
        segments, is_steep, u, u_step, v.astype(float), v_step * slope, length + last_pixel
    )
    last, longest = limited_steps("bresenham-float", first, last)
    owner, i = enumerate_steps(first, last)
    climbed, decision, error = _float_errors(first, last, slope, longest)

    is_start = i == 0
    has_stepped = (decision > 0.5) & ~is_start
    corrected = error - has_stepped
    major, minor = u[owner] + u_step[owner] * i, v[owner] + v_step[owner] * climbed
    is_steep = is_steep[owner]
    column, row = np.where(is_steep, minor, major), np.where(is_steep, major, minor)
    return LineRun(
        owner,
        i,
        column,
        row,
        decision,
        has_stepped,
        decision == 0.5,
        sum_before=error,
        sum_corrected=np.where(has_stepped, corrected, nan),
        sum_advanced=np.where(is_start, 0.0, corrected + slope[owner]),
    )


def _float_errors(
    first: Integers, last: Integers, slope: Floats, longest: int
) -> tuple[Integers, Floats, Floats]:
    """Run L errors side by side: (P,) minor steps, e + m and the e before it, at the steps first <= i < last."""
    counts = last - first
    place = np.cumsum(counts) - counts - first
    climbed_at, decision_at, error_at = (np.empty(counts.sum(), kind) for kind in (np.int64, float, float))

    # Longest lines first: those that still run are a prefix.
    order = np.argsort(-np.where(counts > 0, last, 0), kind="stable")
    first, last, slope, place = first[order], last[order], slope[order], place[order]
    running = np.searchsorted(-np.where(counts[order] > 0, last, 0), -np.arange(longest), side="left")
    error, climbed = np.zeros(len(order)), np.zeros(len(order), np.int64)
    decision, error_before = np.full(len(order), nan), np.full(len(order), nan)
    earliest = int(first[: running[0]].min()) if longest else 0
    for i in range(longest):
        n = int(running[i])
        if i >= earliest:
            is_seen = first[:n] <= i
            at = place[:n][is_seen] + i
            climbed_at[at], decision_at[at] = climbed[:n][is_seen], decision[:n][is_seen]
            error_at[at] = error_before[:n][is_seen]
        error_before[:n] = error[:n]
        decision[:n] = error[:n] + slope[:n]
        has_stepped = decision[:n] > 0.5
        climbed[:n] += has_stepped
        error[:n] = (error[:n] - has_stepped) + slope[:n]
    return climbed_at, decision_at, error_at
