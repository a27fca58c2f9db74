"""Scanline fill as LMU's tutorial prints it: rounded corners, flat top and flat bottom, accumulated inverse slopes.

It is wrong by design, to be compared and shown: corners are rounded to whole pixels, both ends of a span are drawn, so
neighbours overlap; a triangle that arrives with a flat side may be lost; and when the first and the last corner are
level the printed code divides by zero (here the triangle is skipped, and the loss is visible).

The printed program also walks the rows outside of the picture. A corner may lie a million of them away, so they are
passed in one step here; inside the picture the slopes are added up from row to row as printed.

References
----------
LMU, *Computer Graphics 1*, tutorial 5 "Scan line algorithm for triangles", 2020.
"""

import numpy as np

from core.methods import method
from core.raster.edges.edge_functions import EdgeFunctions
from core.raster.fills.traits import FillTraits
from core.raster.pixel_runs import Boxes, Raster, Runs
from core.records.arrays import Flags, Floats, Integers

SORTED = ((0, 1, 2), (0, 2, 1), (2, 0, 1), (1, 0, 2), (1, 2, 0), (2, 1, 0))
"""Orders of the corners as the printed comparisons produce them; the first that is strictly falling is taken."""


def round_half_up(value: Floats) -> Floats:
    """Round values (any shape) as JavaScript's ``Math.round``."""
    return np.asarray(np.floor(value + 0.5))


def draw_triangle(
    v1: tuple[float, float], v2: tuple[float, float], v3: tuple[float, float], height: int
) -> list[tuple[int, float, float]]:
    """Listing as printed, corners at whole pixels: returns row, x1, x2 of every line in ``height`` rows."""
    for order in SORTED:  #: sort
        corners = [(v1, v2, v3)[k] for k in order]
        if corners[0][1] > corners[1][1] > corners[2][1]:
            v1, v2, v3 = corners
            break
    lines: list[tuple[int, float, float]] = []
    if v2[1] == v3[1]:  #: flat-bottom
        lines = draw_bottom(v1, v2, v3, height)
    elif v1[1] == v2[1]:  #: flat-top
        lines = draw_top(v1, v2, v3, height)
    elif v3[1] != v1[1]:  #: division-by-zero
        v4 = (v1[0] + ((v2[1] - v1[1]) / (v3[1] - v1[1])) * (v3[0] - v1[0]), v2[1])  #: split
        lines = draw_top(v2, v4, v1, height) + draw_bottom(v3, v4, v2, height)
    return lines  #: draw


def draw_bottom(
    v1: tuple[float, float], v2: tuple[float, float], v3: tuple[float, float], height: int
) -> list[tuple[int, float, float]]:
    """Listing of the part below a level side."""
    height2, height3 = v2[1] - v1[1], v3[1] - v1[1]
    slope1 = (v2[0] - v1[0]) / height2 if height2 else 0.0  #: slope1
    slope2 = (v3[0] - v1[0]) / height3 if height3 else 0.0  #: slope2
    row = max(v1[1], 0)  #: first-row
    x1, x2 = v1[0] + slope1 * (row - v1[1]), v1[0] + slope2 * (row - v1[1])
    lines = []
    while row <= v2[1] and row < height:  #: rows
        lines.append((int(row), x1, x2))  #: line
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
    row = min(v3[1], height - 1)  #: first-row
    x1, x2 = v3[0] - slope1 * (v3[1] - row), v3[0] - slope2 * (v3[1] - row)
    lines = []
    while row > v1[1] and row >= 0:  #: rows
        lines.append((int(row), x1, x2))  #: line
        x1 -= slope1  #: next1
        x2 -= slope2  #: next2
        row -= 1
    return lines


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
    traits=FillTraits(group_label="Span", span_row="line"),
)
def scanline_lecture(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Return the spans that the printed program draws, limited to the raster.

    Notes
    -----
    A triangle with a corner that cannot be projected is left out.
    """
    first_column, first_row, end_column, end_row = raster.bounds
    drawable = edges.corners.is_projected.all(axis=1) & (edges.doubled_area != 0)
    index = np.flatnonzero(drawable)
    corner = round_half_up(edges.corners.window[index] - raster.center)
    x, y = sort_corners(corner[..., 0], corner[..., 1])
    parts = [_part(index, raster.height, *half) for half in halves(x, y)]
    triangle, row, left, right, step = (np.concatenate(column) for column in zip(*parts, strict=True))
    half = np.repeat([0, 1], [len(part[0]) for part in parts])

    # In the order in which the printed program draws: triangle, upper part before lower part, row after row.
    order = np.lexsort((step, half, triangle))
    triangle, row, left, right = triangle[order], row[order], left[order], right[order]
    inside = (row >= first_row) & (row < end_row)
    triangle, row, left, right = triangle[inside], row[inside], left[inside], right[inside]
    ends = round_half_up(np.stack([left, right]))
    start = np.clip(ends.min(axis=0), first_column, end_column).astype(np.int64)
    stop = np.clip(ends.max(axis=0) + 1, first_column, end_column).astype(np.int64)
    return Runs(
        triangle=triangle,
        row=row,
        start=start,
        stop=np.maximum(start, stop),
        accepted=np.ones(len(row), bool),
        group=np.arange(len(row)),
        crossings=np.stack([left, right, np.full(len(row), np.nan)], axis=1),
    )


def sort_corners(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Put corners (T, 3) in falling order of y by the printed comparisons: all strict, so level ones stay unsorted."""
    orders = np.array(SORTED)
    falling = [(y[:, i] > y[:, j]) & (y[:, j] > y[:, k]) for i, j, k in SORTED]
    chosen = np.where(np.any(falling, axis=0), np.argmax(falling, axis=0), 0)
    order = orders[chosen]
    return np.take_along_axis(x, order, axis=1), np.take_along_axis(y, order, axis=1)


def halves(x: Floats, y: Floats) -> list[tuple[Floats, ...]]:
    """Return for the upper and lower parts of triangles (T, 3): start row, direction, start x, both slopes, rows."""
    x1, x2, x3 = x.T
    y1, y2, y3 = y.T
    flat_bottom = y2 == y3
    flat_top = ~flat_bottom & (y1 == y2)
    general = ~flat_bottom & ~flat_top & (y1 != y3)
    with np.errstate(divide="ignore", invalid="ignore"):
        x4 = x1 + ((y2 - y1) / (y3 - y1)) * (x3 - x1)
        # drawTriangleTop(v2, v4, v1) or, where v1 and v2 are level, drawTriangleTop(v1, v2, v3).
        upper = (
            np.where(flat_top, y3, y1),
            np.where(flat_top, y1, y2),
            np.where(flat_top, x3, x1),
            np.where(flat_top, _slope(x3 - x1, y3 - y1), _slope(x1 - x2, y1 - y2)),
            np.where(flat_top, _slope(x3 - x2, y3 - y2), _slope(x1 - x4, y1 - y2)),
            flat_top | general,
        )
        # drawTriangleBottom(v3, v4, v2) or, where v2 and v3 are level, drawTriangleBottom(v1, v2, v3).
        lower = (
            np.where(flat_bottom, y1, y3),
            y2,
            np.where(flat_bottom, x1, x3),
            np.where(flat_bottom, _slope(x2 - x1, y2 - y1), _slope(x4 - x3, y2 - y3)),
            np.where(flat_bottom, _slope(x3 - x1, y3 - y1), _slope(x2 - x3, y2 - y3)),
            flat_bottom | general,
        )
    down = np.where(upper[5], np.maximum(upper[0] - upper[1], 0), 0)
    up = np.where(lower[5], np.maximum(lower[1] - lower[0] + 1, 0), 0)
    return [(*upper[:1], -np.ones(len(x)), *upper[2:5], down), (*lower[:1], np.ones(len(x)), *lower[2:5], up)]


def _slope(width: Floats, height: Floats) -> Floats:
    """Return how far a side goes to the right a row (T,); 0 where it has no height."""
    return np.asarray(np.where(height != 0, width / height, 0.0))


def _part(
    index: Integers,
    height: int,
    row: Floats,
    direction: Floats,
    x: Floats,
    slope1: Floats,
    slope2: Floats,
    count: Floats,
) -> tuple[Integers, Integers, Floats, Floats, Integers]:
    """Walk all triangles down their rows together: triangle, row, both x, step (the slopes are added up)."""
    drawn = np.flatnonzero(count > 0)
    index = index.take(drawn)
    row, direction, x, slope1, slope2, count = (
        values.take(drawn) for values in (row, direction, x, slope1, slope2, count)
    )
    slope1, slope2 = slope1 * direction, slope2 * direction

    # The rows before the picture in one step, those behind it not at all.
    skipped = np.minimum(np.maximum(np.where(direction > 0, -row, row - (height - 1)), 0), count)
    row, left, right = row + direction * skipped, x + slope1 * skipped, x + slope2 * skipped
    count = np.minimum(count - skipped, np.where(direction > 0, height - row, row + 1))

    triangles, rows, lefts, rights, steps = [], [], [], [], []
    active: Flags = np.ones(len(index), bool)
    for step in range(int(count.max(initial=0))):
        active = count > step
        triangles.append(index[active])
        rows.append((row[active] + direction[active] * step).astype(np.int64))
        lefts.append(left[active])
        rights.append(right[active])
        steps.append(np.full(len(triangles[-1]), step))
        left[active] += slope1[active]
        right[active] += slope2[active]
    if not triangles:
        return np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0), np.empty(0), np.empty(0, np.int64)
    return (
        np.concatenate(triangles),
        np.concatenate(rows),
        np.concatenate(lefts),
        np.concatenate(rights),
        np.concatenate(steps),
    )
