"""Lines in floats: the line equation evaluated in every column, and the same by adding the slope (DDA).

They take any ends: they draw the columns (steep: rows) whose centre lies between the ends, a centre at the
first end included, one at the second end only with ``last_pixel``. They differ by rounding only: the DDA adds
the rounded slope again and again, so its error grows along the line: by some 1e-12 pixels in float64, where only
ties can tell, and by whole pixels in float32.

References
----------
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline": midpoint line rasterization, DDA.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import ceil, floor

import numpy as np

from core.lines.line_method import (
    DIRECTION,
    EVALUATE,
    FIRST_COLUMN,
    INTERCEPT,
    MINOR_MARGIN,
    NEXT,
    OCTANT,
    PLOT,
    ROUND,
    SLOPE,
    STEP_LIMIT,
    LineRun,
    LineTraits,
    Segments,
    advance,
    enumerate_steps,
    limited_steps,
    line_coefficients,
    line_rows,
    major_first,
    round_half_up,
    visible_range,
)
from core.methods import method
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.listing import Columns, Operation

BATCH = 2**20
"""Sums held at one time while the DDA runs along lines that begin far outside the raster."""

Listed = list[tuple[int, int, float]]
"""Column, row and minor coordinate of each pixel, from a listing."""

SET_UP = (OCTANT, SLOPE, INTERCEPT, DIRECTION, FIRST_COLUMN)
"""What the first row of a line does that any ends are given of."""
_ADDED = Operation("sy", "sy", ("sy",))
_ADVANCED = (replace(advance("y"), sets={"decision": "y"}), NEXT, ROUND, PLOT)

FLOAT32_ROUNDING = 2.0**-23
"""Most that one sum in float32 is off by, as a share of it, with room for the sums before it."""


@dataclass(frozen=True, eq=False)
class LineColumns:
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

    @property
    def first_minor(self) -> Floats:
        """(L,) float64 minor coordinate in the first column."""
        return line_equation(self.start, self.slope, self.intercept)

    @property
    def minor_step(self) -> Floats:
        """(L,) float64 change of the minor coordinate from a column to the next."""
        return self.step * self.slope

    def visible(
        self, segments: Segments, v: Floats, v_step: Floats, margin: Floats | float = MINOR_MARGIN
    ) -> tuple[Integers, Integers]:
        """Return the steps of `visible_range` for lines that begin at ``v`` (L,) and change by ``v_step`` (L,)."""
        return visible_range(segments, self.is_steep, self.start, self.step, v, v_step, self.count, margin)


def ends_by_column(segments: Segments) -> tuple[Floats, Flags]:
    """Return ends (L, 2, 2) u, v, the major axis first and pixel centres whole, and which lines (L,) are steep."""
    ends = segments.centered_ends
    length = np.abs(ends[:, 1] - ends[:, 0])
    is_steep = length[:, 1] > length[:, 0]
    return major_first(ends, is_steep), is_steep


def _columns(segments: Segments, last_pixel: bool) -> LineColumns:
    ends, is_steep = ends_by_column(segments)
    u, u_end = ends[:, 0, 0], ends[:, 1, 0]
    is_backward = u_end < u
    start = np.where(is_backward, np.floor(u), np.ceil(u))
    if last_pixel:
        stop = np.where(is_backward, np.ceil(u_end), np.floor(u_end))
    else:
        stop = np.where(is_backward, np.floor(u_end) + 1, np.ceil(u_end) - 1)
    step = np.where(is_backward, -1, 1)
    count = np.maximum(step * (stop - start).astype(np.int64) + 1, 0)
    return LineColumns(is_steep, start.astype(np.int64), step, count, *line_coefficients(ends))


def _run(
    columns: LineColumns,
    owner: Integers,
    k: Integers,
    v: Floats,
    v_before: Floats,
    round_minor: Callable[[Floats], Integers] = round_half_up,
) -> LineRun:
    """Round the minor coordinates (P,) of steps k and k - 1 to pixels."""
    is_first = k == 0
    minor, minor_before = round_minor(v), round_minor(v_before)
    major = columns.start[owner] + columns.step[owner] * k
    is_steep = columns.is_steep[owner]
    column, row = np.where(is_steep, minor, major), np.where(is_steep, major, minor)
    return LineRun(
        owner,
        k,
        column,
        row,
        v,
        (minor != minor_before) & ~is_first,
        v - np.floor(v) == 0.5,
        sum_before=np.where(is_first, np.nan, v_before),
        sum_advanced=v,
    )


def draw_nearest(segments: Segments, last_pixel: bool, round_minor: Callable[[Floats], Integers]) -> LineRun:
    """Evaluate m x + b in every column, and round it with ``round_minor``, (P,) float64 to (P,) int64."""
    columns = _columns(segments, last_pixel)
    first, last = columns.visible(segments, columns.first_minor, columns.minor_step)
    owner, k = enumerate_steps(first, last)
    u, step = columns.start[owner] + columns.step[owner] * k, columns.step[owner]
    slope, intercept = columns.slope[owner], columns.intercept[owner]
    return _run(
        columns,
        owner,
        k,
        line_equation(u, slope, intercept),
        line_equation(u - step, slope, intercept),
        round_minor,
    )


def line_equation(u: Integers, slope: Floats, intercept: Floats) -> Floats:
    """Minor coordinate of the line in column u. (P,) each."""
    return slope * u + intercept


def midpoint_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``midpoint`` on one segment; pixel centres are whole numbers."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    sx = -1 if x1 < x0 else 1  #: directions
    x = ceil(x0) if sx > 0 else floor(x0)  #: start
    pixels = []
    while (x1 - x) * sx > 0 or (last_pixel and x == x1):
        y = m * x + b  #: evaluate
        Y = floor(y) + (y - floor(y) >= 0.5)  #: round
        pixels.append((Y, x, y) if is_steep else (x, Y, y))  #: draw
        x += sx  #: next
    return pixels


@method(
    "line",
    "midpoint",
    "Midpoint, line equation per column",
    source="Pellacini, Midpoint line rasterization",
    exact_for="any ends: the pixel nearest to the line in every column, up to the rounding of m x + b",
    breaks_where="ties: they always go up (steep lines: right), so a mirrored line is not the mirror image. Far "
    "from the origin, m x + b loses digits",
    listing=midpoint_listing,
    operations=line_rows("midpoint", (*SET_UP, EVALUATE, ROUND, PLOT), (NEXT, EVALUATE, ROUND, PLOT)),
)
def midpoint(segments: Segments, last_pixel: bool) -> LineRun:
    """Evaluate m x + b in every column and round it; ``decision`` is this coordinate (centres whole)."""
    return draw_nearest(segments, last_pixel, round_half_up)


def dda_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``dda`` on one segment; pixel centres are whole numbers."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    sx = -1 if x1 < x0 else 1  #: directions
    x = ceil(x0) if sx > 0 else floor(x0)  #: start
    y = m * x + b  #: evaluate
    pixels = []
    while (x1 - x) * sx > 0 or (last_pixel and x == x1):
        Y = floor(y) + (y - floor(y) >= 0.5)  #: round
        pixels.append((Y, x, y) if is_steep else (x, Y, y))  #: draw
        y += m * sx  #: advance
        x += sx  #: next
    return pixels


@method(
    "line",
    "dda",
    "DDA, slope added per column",
    source="Pellacini, Optimizing midpoint line rasterization",
    exact_for="slopes that are short binary fractions, with any ends: the same pixels as midpoint",
    breaks_where="ties, and near ties on long lines: the rounding errors of the sums grow along the line, and the "
    "neighbouring pixel is drawn",
    listing=dda_listing,
    operations=line_rows("dda", (*SET_UP, EVALUATE, ROUND, PLOT), _ADVANCED),
)
def dda(segments: Segments, last_pixel: bool) -> LineRun:
    """Add the slope from column to column and round; ``decision`` is the sum so far (centres whole).

    Notes
    -----
    The sums are formed one after the other from the first column on, as the listing does, also where the line
    begins outside the raster.
    """
    columns = _columns(segments, last_pixel)
    v, v_step = columns.first_minor, columns.minor_step
    first, last = columns.visible(segments, v, v_step)
    owner, k = enumerate_steps(first, last)
    sums, sums_before = _running_sums(first, last, v, v_step)
    return _run(columns, owner, k, sums, sums_before)


def dda_float32_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``dda-float32`` on one segment; pixel centres are whole numbers."""
    is_steep = abs(y1 - y0) > abs(x1 - x0)  #: octant
    if is_steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0  #: slope
    b = y0 - m * x0  #: intercept
    sx = -1 if x1 < x0 else 1  #: directions
    x = ceil(x0) if sx > 0 else floor(x0)  #: start
    y = np.float32(m * x + b)  #: evaluate
    sy = np.float32(m * sx)  #: sy
    pixels = []
    while (x1 - x) * sx > 0 or (last_pixel and x == x1):
        Y = floor(y) + (float(y) - floor(y) >= 0.5)  #: round
        pixels.append((Y, x, float(y)) if is_steep else (x, Y, float(y)))  #: draw
        y = np.float32(y + sy)  #: advance
        x += sx  #: next
    return pixels


def _float32_step(columns: Columns) -> dict[str, Floats | Integers]:
    return {"sy": (columns["slope"] * columns["sx"]).astype(np.float32).astype(float)}


@method(
    "line",
    "dda-float32",
    "DDA, slope added in float32",
    source="Pellacini, Optimizing midpoint line rasterization, in 32 bits",
    exact_for="short lines near the origin, except at ties",
    breaks_where="long lines: all sums between two powers of two are rounded alike, so the line drifts by whole "
    f"pixels over thousands of columns, more so far from the origin. More than {STEP_LIMIT} steps are "
    "refused",
    listing=dda_float32_listing,
    operations=line_rows("dda-float32", (*SET_UP, EVALUATE, _ADDED, ROUND, PLOT), _ADVANCED),
    traits=LineTraits(columns=_float32_step),
)
def dda_float32(segments: Segments, last_pixel: bool) -> LineRun:
    """Add the slope in float32 and round; ``decision`` is the sum so far (centres whole).

    Raises
    ------
    ValueError
        If a segment needs more than `STEP_LIMIT` steps before it leaves the raster.

    Notes
    -----
    The first sum and the slope are those of ``dda``, rounded once to float32.
    """
    columns = _columns(segments, last_pixel)
    v, v_step = columns.first_minor.astype(np.float32), columns.minor_step.astype(np.float32)
    # How far the sums can be off where the line leaves the raster, at the latest.
    size = np.where(columns.is_steep, segments.height, segments.width)
    leaves = np.where(columns.step > 0, size - columns.start, columns.start + 1)
    steps = np.clip(leaves, 0, columns.count)
    reach = np.abs(v) + steps * np.abs(v_step) + 1.0
    margin = MINOR_MARGIN + (np.minimum(steps, STEP_LIMIT) + 1) * reach * FLOAT32_ROUNDING
    first, last = columns.visible(segments, v.astype(float), v_step.astype(float), margin)
    last, _ = limited_steps("dda-float32", first, last)
    owner, k = enumerate_steps(first, last)
    sums, sums_before = _running_sums(first, last, v, v_step)
    return _run(columns, owner, k, sums, sums_before)


def _running_sums(
    first: Integers, last: Integers, v: Floats | Singles, v_step: Floats | Singles
) -> tuple[Floats, Floats]:
    """Add ``v_step`` to ``v`` k times: (P,) sums at the steps first <= k < last, and one step before each.

    They are added in the type of ``v`` and returned as float64.
    """
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
