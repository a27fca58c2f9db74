"""Scanline fills of triangles: exact, and as LMU's tutorial prints it.

The crossing of a row with an edge is computed in floats, and only proposes a column; the decision of
``edge_functions`` at that column and its neighbour confirms it, or a bisection finds the right one. So the spans
are exactly the pixels that the inside test covers, for corners behind the eye as well.

References
----------
LMU, *Computer Graphics 1*, tutorial 5 "Scan line algorithm for triangles", 2020.
W. Newman, R. Sproull, *Principles of interactive computer graphics*, 1979.

It is wrong by design, to be compared and shown: corners are rounded to whole pixels, both ends of a span are drawn, so
neighbours overlap; a triangle that arrives with a flat side may be lost; and when the first and the last corner are
level the printed code divides by zero (here the triangle is skipped, and the loss is visible).

The printed program also walks the rows outside of the picture. A corner may lie a million of them away, so they are
passed in one step here; inside the picture the slopes are added up from row to row as printed.

References
----------
LMU, *Computer Graphics 1*, tutorial 5 "Scan line algorithm for triangles", 2020.
"""

from dataclasses import dataclass, replace
from math import ceil, floor

import numpy as np

from core.coverage.edges import EdgeFunctions, edge_value, is_inside
from core.coverage.pixel_runs import Boxes, FillTraits, Raster, Runs, SideWalk, rows_of
from core.methods import method
from core.records.arrays import Flags, Floats, Integers

# Scanline fill, exact: in every row the inside pixels of each edge are a half-line, and their overlap is
# the span.


@method(
    "fill",
    "scanline",
    "Scanline, exact spans",
    source="LMU 2020, Scan line algorithm; Newman and Sproull 1979",
    exact_for="every triangle",
    needs=("float64-edges",),
    traits=FillTraits(group_label="Span"),
)
def scanline(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Return the span of inside pixels of every row; a row without one has an empty run."""
    rows = rows_of(boxes, np.arange(len(edges)))
    start, stop = rows.start, rows.stop
    crossings = np.empty((len(rows), 3))
    y = raster.along(rows.row)
    for k in range(3):
        a, b, c = (coefficient[rows.triangle, k] for coefficient in (edges.a, edges.b, edges.c))
        owns_tie = edges.owns_tie[rows.triangle, k]
        column, crossings[:, k] = turning_column(a, b, c, owns_tie, y, rows.start, rows.stop, raster.center)
        level_outside = (a == 0) & ~is_inside(edge_value(a, b, c, np.zeros(len(a)), y), owns_tie)
        start = np.where(a > 0, np.maximum(start, column), start)
        stop = np.where(a < 0, np.minimum(stop, column), stop)
        stop = np.where(level_outside, start, stop)
    return replace(
        rows,
        start=start,
        stop=np.maximum(start, stop),
        accepted=np.ones(len(rows), bool),
        crossings=crossings,
    )


def turning_column(
    a: Floats,
    b: Floats,
    c: Floats,
    owns_tie: Flags,
    y: Floats,
    start: Integers,
    stop: Integers,
    center: float,
) -> tuple[Integers, Floats]:
    """Find the first column, from ``start`` to ``stop``, where the edge's side differs from the side left of it.

    Returns
    -------
    column : (R,) int64
        For a > 0 the first inside column, for a < 0 the first outside one.
    crossing : (R,) float64
        Where the row crosses the edge, in pixels; NaN where they are parallel.
    """

    def has_turned(column: Integers) -> Flags:
        return np.asarray(is_inside(edge_value(a, b, c, column + np.float64(center), y), owns_tie) == (a > 0))

    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        crossing = np.where(a != 0, -(b * y + c) / a, np.nan)
        proposed = np.ceil(crossing - center)
    column = np.clip(np.nan_to_num(proposed), start, stop).astype(np.int64)

    # Bisect where the neighbours do not confirm the proposal; the computed values are monotone along the row.
    is_right = ((column == start) | ~has_turned(column - 1)) & ((column == stop) | has_turned(column))
    if not (is_right | (a == 0)).all():
        low, high = start.copy(), stop.copy()
        while (low < high).any():
            middle = (low + high) // 2
            turned = has_turned(middle)
            high = np.where(turned & (low < high), middle, high)
            low = np.where(~turned & (low < high), middle + 1, low)
        column = np.where(is_right, column, low)
    return column, crossing


Edge = tuple[float, float, float, bool]
"""Coefficients a, b, c of an edge function, and whether the triangle owns pixel centres on the edge."""


def span(edges: list[Edge], y: float, first: int, end: int, center: float) -> list[int]:
    """Listing of one row: the three edges, columns from first to end; returns the columns inside."""
    starts, stops = [first], [end]
    for edge in edges:
        a, b, c, _ = edge
        if a == 0:  #: level
            if not inside_at(edge, 0.0, y):
                stops.append(first)
            continue
        crossing = -(b * y + c) / a  #: crossing
        column = ceil(min(max(first, crossing - center), end))
        while column > first and inside_at(edge, column - 1 + center, y) == (a > 0):
            column -= 1
        while column < end and inside_at(edge, column + center, y) != (a > 0):
            column += 1
        (starts if a > 0 else stops).append(column)
    start, stop = max(starts), min(stops)  #: span
    pixels = []
    for column in range(start, stop):
        pixels.append(column)  #: draw
    return pixels


def inside_at(edge: Edge, x: float, y: float) -> bool:
    """Return whether a place is on the inner side of an edge."""
    a, b, c, owns_tie = edge
    value = a * x + (b * y + c)
    return bool(value > 0 or (value == 0 and owns_tie))


# Scanline fill as LMU's tutorial prints it: rounded corners, flat top and flat bottom, accumulated inverse
# slopes.


SORTED = ((0, 1, 2), (0, 2, 1), (2, 0, 1), (1, 0, 2), (1, 2, 0), (2, 1, 0))
"""Orders of the corners as the printed comparisons produce them; the first that is strictly falling is taken."""


def round_half_up(value: Floats) -> Floats:
    """Round values (any shape) as JavaScript's ``Math.round``."""
    return np.asarray(np.floor(value + 0.5))


def draw_triangle(
    v1: tuple[float, float], v2: tuple[float, float], v3: tuple[float, float], height: int
) -> list[tuple[int, float, float]]:
    """Listing as printed, corners at whole pixels: returns row, x1, x2 of every line in ``height`` rows."""
    for order in SORTED:
        corners = [(v1, v2, v3)[k] for k in order]
        if corners[0][1] > corners[1][1] > corners[2][1]:
            v1, v2, v3 = corners
            break
    lines: list[tuple[int, float, float]] = []
    if v2[1] == v3[1]:
        lines = draw_bottom(v1, v2, v3, height)
    elif v1[1] == v2[1]:
        lines = draw_top(v1, v2, v3, height)
    elif v3[1] != v1[1]:
        v4 = (v1[0] + ((v2[1] - v1[1]) / (v3[1] - v1[1])) * (v3[0] - v1[0]), v2[1])
        lines = draw_top(v2, v4, v1, height) + draw_bottom(v3, v4, v2, height)
    return lines


def draw_bottom(
    v1: tuple[float, float], v2: tuple[float, float], v3: tuple[float, float], height: int
) -> list[tuple[int, float, float]]:
    """Listing of the part below a level side."""
    height2, height3 = v2[1] - v1[1], v3[1] - v1[1]
    slope1 = (v2[0] - v1[0]) / height2 if height2 else 0.0  #: slope1
    slope2 = (v3[0] - v1[0]) / height3 if height3 else 0.0  #: slope2
    row = max(v1[1], 0)
    x1, x2 = v1[0] + slope1 * (row - v1[1]), v1[0] + slope2 * (row - v1[1])  #: first
    lines = []
    while row <= v2[1] and row < height:
        lines.append((int(row), x1, x2))
        x1 += slope1  #: next1
        x2 += slope2  #: next2
        row += 1
    return lines


def draw_top(
    v1: tuple[float, float], v2: tuple[float, float], v3: tuple[float, float], height: int
) -> list[tuple[int, float, float]]:
    """Listing of the part above a level side."""
    height1, height2 = v3[1] - v1[1], v3[1] - v2[1]
    slope1 = (v3[0] - v1[0]) / height1 if height1 else 0.0  #: slope1
    slope2 = (v3[0] - v2[0]) / height2 if height2 else 0.0  #: slope2
    row = min(v3[1], height - 1)
    x1, x2 = v3[0] - slope1 * (v3[1] - row), v3[0] - slope2 * (v3[1] - row)  #: first
    lines = []
    while row > v1[1] and row >= 0:
        lines.append((int(row), x1, x2))
        x1 -= slope1  #: next1
        x2 -= slope2  #: next2
        row -= 1
    return lines


def drawn_columns(x1: float, x2: float) -> list[int]:
    """Listing of one line: the columns from one rounded side to the other, both of them drawn."""
    start, stop = floor(min(x1, x2) + 0.5), floor(max(x1, x2) + 0.5) + 1  #: round
    pixels = []
    for column in range(start, stop):
        pixels.append(column)  #: draw
    return pixels


@method(
    "fill",
    "scanline-lecture",
    "Scanline, as printed (LMU)",
    source="LMU 2020, Scan line algorithm for triangles",
    exact_for="no triangle in general: corners are rounded",
    breaks_where="shared edges (drawn twice), flat sides (lost), first and last corner at the same height "
    "(division by zero)",
    needs=("projected",),
    listing=draw_triangle,
    traits=FillTraits(group_label="Span"),
)
def scanline_lecture(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Return the spans that the printed program draws, limited to the raster.

    Notes
    -----
    A triangle with a corner that cannot be projected is left out.
    """
    first_column, _, end_column, _ = raster.bounds
    walk = walk_sides(edges, raster)
    ends = round_half_up(walk.sides)
    start = np.clip(ends.min(axis=0), first_column, end_column).astype(np.int64)
    stop = np.clip(ends.max(axis=0) + 1, first_column, end_column).astype(np.int64)
    return Runs(
        triangle=walk.triangle,
        row=walk.row,
        start=start,
        stop=np.maximum(start, stop),
        accepted=np.ones(len(walk), bool),
        group=np.arange(len(walk)),
        crossings=np.column_stack([*walk.sides, np.full(len(walk), np.nan)]),
        walk=walk,
    )


def walk_sides(edges: EdgeFunctions, raster: Raster) -> SideWalk:
    """Return the rows that the printed program draws of all triangles, limited to the raster's rows."""
    _, first_row, _, end_row = raster.bounds
    index = np.flatnonzero(edges.corners.is_projected.all(axis=1) & (edges.doubled_area != 0))
    corner = round_half_up(edges.corners.window[index] - raster.center)
    x, y = sort_corners(corner[..., 0], corner[..., 1])
    halves_of = halves(x, y)
    parts = [_part(raster.height, half) for half in halves_of]
    of, row, sides, before, step = (np.concatenate(column, axis=-1) for column in zip(*parts, strict=True))
    half = np.repeat([0, 1], [len(part[0]) for part in parts])

    # In the order in which the printed program draws: triangle, upper part before lower part, row after row.
    order = np.lexsort((step, half, of))
    order = order[(row[order] >= first_row) & (row[order] < end_row)]
    of, half = of[order], half[order]

    def of_half(name: str) -> Floats:
        return np.stack([getattr(each, name) for each in halves_of])[half, ..., of].T

    return SideWalk(
        triangle=index[of],
        row=row[order],
        sides=sides[:, order],
        before=before[:, order],
        slope=of_half("slope"),
        width=of_half("width"),
        height=of_half("height"),
        is_upper=half == 0,
        is_first=step[order] == 0,
        corner=of_half("corner"),
    )


def sort_corners(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Put corners (T, 3) in falling order of y by the printed comparisons: all strict, so level ones stay unsorted."""
    orders = np.array(SORTED)
    falling = [(y[:, i] > y[:, j]) & (y[:, j] > y[:, k]) for i, j, k in SORTED]
    chosen = np.where(np.any(falling, axis=0), np.argmax(falling, axis=0), 0)
    order = orders[chosen]
    return np.take_along_axis(x, order, axis=1), np.take_along_axis(y, order, axis=1)


@dataclass(frozen=True, eq=False)
class Half:
    """The part of T triangles above, or below, a level side."""

    corner: Floats
    """(2, T) float64, x and y of the corner opposite to the level side, where the walk begins."""
    width: Floats
    """(2, T) float64, of both other sides, from the lower to the upper end."""
    height: Floats
    """(2, T) float64."""
    count: Floats
    """(T,) float64, how many rows are walked."""
    direction: int
    """From row to row: 1 upwards, -1 downwards."""

    @property
    def slope(self) -> Floats:
        """(2, T) float64, how far a side goes to the right from one row to the next one above; 0: it has no height."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.where(self.height != 0, self.width / self.height, 0.0))


def halves(x: Floats, y: Floats) -> tuple[Half, Half]:
    """Return the upper and the lower part of triangles whose corners (T, 3) are sorted."""
    x1, x2, x3 = x.T
    y1, y2, y3 = y.T
    flat_bottom = y2 == y3
    flat_top = ~flat_bottom & (y1 == y2)
    general = ~flat_bottom & ~flat_top & (y1 != y3)
    with np.errstate(divide="ignore", invalid="ignore"):
        x4 = x1 + ((y2 - y1) / (y3 - y1)) * (x3 - x1)

    # drawTriangleTop(v2, v4, v1) or, where v1 and v2 are level, drawTriangleTop(v1, v2, v3).
    upper, level = np.where(flat_top, (x3, y3), (x1, y1)), np.where(flat_top, y1, y2)
    down = np.where(flat_top | general, np.maximum(upper[1] - level, 0), 0)
    width = np.where(flat_top, (x3 - x1, x3 - x2), (x1 - x2, x1 - x4))
    height = np.where(flat_top, (y3 - y1, y3 - y2), (y1 - y2, y1 - y2))
    above = Half(upper, width, height, down, -1)

    # drawTriangleBottom(v3, v4, v2) or, where v2 and v3 are level, drawTriangleBottom(v1, v2, v3).
    lower = np.where(flat_bottom, (x1, y1), (x3, y3))
    up = np.where(flat_bottom | general, np.maximum(y2 - lower[1] + 1, 0), 0)
    width = np.where(flat_bottom, (x2 - x1, x3 - x1), (x4 - x3, x2 - x3))
    height = np.where(flat_bottom, (y2 - y1, y3 - y1), (y2 - y3, y2 - y3))
    return above, Half(lower, width, height, up, 1)


def _part(height: int, half: Half) -> tuple[Integers, Integers, Floats, Floats, Integers]:
    """Walk all triangles down their rows together: triangle, row, x of both sides, the same a row before, step."""
    drawn = np.flatnonzero(half.count > 0)
    (x, row), count, direction = half.corner[:, drawn], half.count[drawn], half.direction
    slope = half.slope[:, drawn] * direction

    # The rows before the picture in one step, those behind it not at all.
    skipped = np.minimum(np.maximum(-row if direction > 0 else row - (height - 1), 0), count)
    row, sides = row + direction * skipped, x + slope * skipped
    count = np.minimum(count - skipped, height - row if direction > 0 else row + 1)

    parts = [(drawn[:0], np.empty(0, np.int64), np.empty((2, 0)), np.empty((2, 0)), np.empty(0, np.int64))]
    before = np.full_like(sides, np.nan)
    for step in range(int(count.max(initial=0))):
        active = count > step
        now = (row[active] + direction * step).astype(np.int64)
        parts.append((drawn[active], now, sides[:, active], before[:, active], np.full(len(now), step)))
        before, sides = sides, sides + slope
    triangle, rows, x, x_before, steps = (
        np.concatenate(column, axis=-1) for column in zip(*parts, strict=True)
    )
    return triangle, rows, x, x_before, steps
