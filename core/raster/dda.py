"""Two lines in floats: the line equation evaluated in every column, and the same by adding the slope (DDA).

Both take any ends: they draw the columns (steep: rows) whose centre lies between the ends, a centre at the
first end included, one at the second end only with ``last_pixel``. They differ by rounding only: the DDA adds
the rounded slope again and again, so its error grows along the line.

References
----------
F. Pellacini, *Interactive Graphics*, lecture "Rasterization": midpoint line rasterization, DDA.
"""

from dataclasses import dataclass
from math import ceil, floor

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.methods import method
from core.raster.line_records import (
    LineRun,
    Segments,
    enumerate_steps,
    major_first,
    round_half_up,
    visible_range,
)

BATCH = 2**20
"""Sums held at one time while the DDA runs along lines that begin far outside the raster."""

Listed = list[tuple[int, int, float]]
"""Column, row and minor coordinate of each pixel, from a listing."""


@dataclass(frozen=True, eq=False)
class _Columns:
    """The columns (steep: rows) of L lines, in coordinates where pixel centres are whole numbers."""

    is_steep: Flags
    start: Integers
    """(L,) int64 first column."""
    step: Integers
    """(L,) int64, 1 or -1."""
    count: Integers
    """(L,) int64 columns of the whole line."""
    slope: Floats
    """(L,) float64 m; 0 where the ends coincide."""
    intercept: Floats
    """(L,) float64 b of v = m u + b."""


def _columns(segments: Segments, last_pixel: bool) -> _Columns:
    ends = segments.centered_ends
    length = np.abs(ends[:, 1] - ends[:, 0])
    is_steep = length[:, 1] > length[:, 0]
    ends = major_first(ends, is_steep)
    u, v, u_end, v_end = ends[:, 0, 0], ends[:, 0, 1], ends[:, 1, 0], ends[:, 1, 1]
    is_backward = u_end < u
    start = np.where(is_backward, np.floor(u), np.ceil(u))
    if last_pixel:
        stop = np.where(is_backward, np.ceil(u_end), np.floor(u_end))
    else:
        stop = np.where(is_backward, np.floor(u_end) + 1, np.ceil(u_end) - 1)
    step = np.where(is_backward, -1, 1)
    count = np.maximum(step * (stop - start).astype(np.int64) + 1, 0)
    du = u_end - u
    slope = (v_end - v) / np.where(du == 0, 1.0, du)
    return _Columns(is_steep, start.astype(np.int64), step, count, slope, v - slope * u)


def _run(columns: _Columns, owner: Integers, k: Integers, v: Floats, v_before: Floats) -> LineRun:
    """Round the minor coordinates (P,) of steps k and k - 1 to pixels."""
    minor, minor_before = round_half_up(v), round_half_up(v_before)
    major = columns.start[owner] + columns.step[owner] * k
    is_steep = columns.is_steep[owner]
    column, row = np.where(is_steep, minor, major), np.where(is_steep, major, minor)
    return LineRun(owner, k, column, row, v, (minor != minor_before) & (k > 0), v - np.floor(v) == 0.5)


def line_equation(u: Integers, slope: Floats, intercept: Floats) -> Floats:
    """Minor coordinate of the line in column u. (P,) each."""
    return slope * u + intercept


@method(
    "line",
    "midpoint",
    "Midpoint, line equation per column",
    source="Pellacini, Interactive Graphics, Midpoint line rasterization",
    exact_for="any ends: the pixel nearest to the line in every column, up to the rounding of m x + b",
    breaks_where="a tie always goes up (steep: right), so a mirrored line is not the mirror image; far from "
    "the origin m x + b loses digits",
)
def midpoint(segments: Segments, last_pixel: bool) -> LineRun:
    """Evaluate m x + b in every column and round it; ``decision`` is this coordinate (centres whole)."""
    columns = _columns(segments, last_pixel)
    v = line_equation(columns.start, columns.slope, columns.intercept)
    first, last = visible_range(
        segments,
        columns.is_steep,
        columns.start,
        columns.step,
        v,
        columns.step * columns.slope,
        columns.count,
    )
    owner, k = enumerate_steps(first, last)
    u, step = columns.start[owner] + columns.step[owner] * k, columns.step[owner]
    slope, intercept = columns.slope[owner], columns.intercept[owner]
    return _run(
        columns, owner, k, line_equation(u, slope, intercept), line_equation(u - step, slope, intercept)
    )


@method(
    "line",
    "dda",
    "DDA, slope added per column",
    source="Pellacini, Interactive Graphics, Optimizing midpoint line rasterization",
    exact_for="any ends whose slope is a short binary fraction: then equal to midpoint",
    breaks_where="the rounding errors of the sums grow along the line: at ties, and on long lines near them, "
    "the neighbour is drawn",
)
def dda(segments: Segments, last_pixel: bool) -> LineRun:
    """Add the slope from column to column and round; ``decision`` is the sum so far (centres whole).

    Notes
    -----
    The sums are formed one after the other from the first column on, as the listing does, also where the line
    begins outside the raster.
    """
    columns = _columns(segments, last_pixel)
    v = line_equation(columns.start, columns.slope, columns.intercept)
    v_step = columns.step * columns.slope
    first, last = visible_range(
        segments, columns.is_steep, columns.start, columns.step, v, v_step, columns.count
    )
    owner, k = enumerate_steps(first, last)
    sums, sums_before = _running_sums(first, last, v, v_step)
    return _run(columns, owner, k, sums, sums_before)


def _running_sums(first: Integers, last: Integers, v: Floats, v_step: Floats) -> tuple[Floats, Floats]:
    """Add ``v_step`` to ``v`` k times: (P,) sums at the steps first <= k < last, and one step before each."""
    counts = last - first
    place = np.cumsum(counts) - counts
    sums, sums_before = np.empty(counts.sum()), np.empty(counts.sum())
    order = np.argsort(last, kind="stable")
    order = order[counts[order] > 0]
    while len(order):
        # Lines of about equal length side by side, the longest of those left first.
        length = int(last[order[-1]])
        batch, order = np.split(order[::-1], [max(BATCH // length, 1)])
        order = order[::-1]
        terms = np.repeat(v_step[batch][:, None], length, axis=1)
        terms[:, 0] = v[batch]
        table = np.add.accumulate(terms, axis=1)
        line, k = enumerate_steps(first[batch], last[batch])
        at = place[batch][line] + k - first[batch][line]
        sums[at] = table[line, k]
        sums_before[at] = table[line, np.maximum(k - 1, 0)]
    return sums, sums_before


def midpoint_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``midpoint`` on one segment; pixel centres are whole numbers."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1  #: swap-axes
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    x_step = -1 if x1 < x0 else 1  #: directions
    x = ceil(x0) if x_step > 0 else floor(x0)  #: start
    pixels = []
    while (x1 - x) * x_step > 0 or (last_pixel and x == x1):
        y = m * x + b  #: evaluate
        row = floor(y) + (y - floor(y) >= 0.5)  #: round
        pixels.append((row, x, y) if is_steep else (x, row, y))  #: draw
        x += x_step  #: next
    return pixels


def dda_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``dda`` on one segment; pixel centres are whole numbers."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1  #: swap-axes
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    x_step = -1 if x1 < x0 else 1  #: directions
    x = ceil(x0) if x_step > 0 else floor(x0)  #: start
    y = m * x + b  #: evaluate
    pixels = []
    while (x1 - x) * x_step > 0 or (last_pixel and x == x1):
        row = floor(y) + (y - floor(y) >= 0.5)  #: round
        pixels.append((row, x, y) if is_steep else (x, row, y))  #: draw
        y += m * x_step  #: advance
        x += x_step  #: next
    return pixels
