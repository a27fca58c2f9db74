"""Scanline fill, exact: in every row the inside pixels of each edge are a half-line, and their overlap is the span.

The crossing of a row with an edge is computed in floats, and only proposes a column; the decision of
``edge_functions`` at that column and its neighbour confirms it, or a bisection finds the right one. So the spans
are exactly the pixels that the inside test covers, for corners behind the eye as well.

References
----------
LMU, *Computer Graphics 1*, tutorial 5 "Scan line algorithm for triangles", 2020.
W. Newman, R. Sproull, *Principles of interactive computer graphics*, 1979.
"""

from dataclasses import replace
from math import ceil

import numpy as np

from core.methods import method
from core.raster.edges.edge_functions import EdgeFunctions, edge_value, is_inside
from core.raster.fills.traits import FillTraits
from core.raster.pixel_runs import Boxes, Raster, Runs, rows_of
from core.records.arrays import Flags, Floats, Integers


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
