"""The fill ``spans``: all triangles at once, as a schedule in drawing order; and its listings, one triangle at a time.

Pictures draw the spans as they come (``packed``); traces, blending and the depth methods that packed words cannot
carry take them from here. Triangles with a corner that cannot be snapped have no lane: their spans are found row by
row from the homogeneous edge functions (``scanline``), by the same decisions.

The engine walks level by level, so the rows of a triangle come out far from each other. Their places in drawing order
are known beforehand, since every triangle has a fixed number of rows: they are put there without being sorted.
"""

from dataclasses import dataclass
from math import ceil, floor

import numpy as np

from core.coverage.edges import EdgeFunctions
from core.coverage.pixel_runs import Boxes, FillTraits, Raster, Runs
from core.methods import method
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Flags, Integers
from core.spans.lanes import (
    ROUNDING_MARGIN,
    SUBPIXEL_GUARD,
    Carried,
    TieOwners,
    TriangleSetup,
    bounds_of_rows,
    set_up_lanes,
)

# Listings of the span engine: what it does with one triangle, one row, one pixel, to be read and executed.


def rows_of_triangle(
    y: list[float], center: float, bounds: tuple[int, int], owns_bottom: bool, owns_top: bool
) -> tuple[int, int]:
    """Listing of the rows of a triangle: corners at y (3,) in pixels, bounds of the raster to first row and count."""
    low = min(y) - center - (SUBPIXEL_GUARD if owns_bottom else -SUBPIXEL_GUARD)
    high = max(y) - center - (-SUBPIXEL_GUARD if owns_top else SUBPIXEL_GUARD)
    first = min(max(ceil(low), bounds[0]), bounds[1])  #: first
    count = max(min(max(ceil(high), bounds[0]), bounds[1]) - first, 0)  #: count
    return first, count


def place_by_size(sizes: list[int], number: int) -> int:
    """Listing of the order of lanes (sizes (L,) in rows) and spans (in pixels): largest first, equals as they came."""
    own, before = sizes[number], 0
    for other, size in enumerate(sizes):
        before += size > own or (size == own and other < number)  #: place
    return before


def span_of_row(
    sides: list[tuple[float, float, float, float, bool]], y: float, start: int, stop: int, center: float
) -> tuple[int, int]:
    """Listing of one row: sides (x0, y0, x1, y1, owns tie), counter-clockwise, in pixels; columns start to stop."""
    for x0, y0, x1, y1, owns_tie in sides:
        dx, dy = x1 - x0, y1 - y0
        if dy == 0:  #: level
            continue
        crossing = ((x0 - center) * dy + (y - y0) * dx) * (1 / dy)  #: crossing
        is_left = dy < 0
        guard = ROUNDING_MARGIN
        if owns_tie == is_left:
            guard = -guard
        column = floor(crossing + (1 + guard))
        if is_left:
            start = max(start, column)  #: start
        else:
            stop = min(stop, column)  #: stop
    return start, max(start, stop)


def order_of_pixels(spans: list[tuple[int, int, int]]) -> list[tuple[int, int]]:
    """Listing of the passes: spans (row, start, stop), longest first, to pixels (column, row) as they are drawn."""
    drawn = []
    longest = spans[0][2] - spans[0][1] if spans else 0
    for k in range(longest):  #: pass
        for row, start, stop in spans:
            if start + k >= stop:
                break
            drawn.append((start + k, row))  #: draw
    return drawn


# The fill ``spans``: the engine's spans as a schedule in drawing order, as every fill gives one.


@method(
    "fill",
    "spans",
    "Spans of all triangles at once",
    source="Wylie et al. 1967 (spans); Pineda 1988 and Fuchs et al. 1985 (linear expressions in parallel)",
    exact_for="every triangle",
    needs=("float64-edges",),
    traits=FillTraits(has_lanes=True, group_label="Lane or span"),
)
def spans(edges: EdgeFunctions, boxes: Boxes, raster: Raster, block_size: int) -> Runs:
    """Return the span of inside pixels of every row that has one."""
    rows = lane_rows(edges, raster, owners_of(edges))
    has_lane = is_in_lane(edges)
    triangle, row, start, stop = rows.triangle, rows.row, rows.start, rows.stop
    crossings = np.full((len(triangle), 3), np.nan)
    if not has_lane.all():
        from core.coverage.scanline import scanline  # Few pictures have such triangles.

        rest = boxes._replace(column_end=np.where(has_lane, boxes.column, boxes.column_end))
        others = scanline(edges, rest, raster, block_size)
        assert others.crossings is not None
        order = np.argsort(np.concatenate([triangle, others.triangle]), kind="stable")
        triangle, row, start, stop, crossings = (
            np.concatenate(both)[order]
            for both in (
                (triangle, others.triangle),
                (row, others.row),
                (start, others.start),
                (stop, others.stop),
                (crossings, others.crossings),
            )
        )
    inside = np.flatnonzero(start < stop)
    return Runs(
        triangle=triangle.take(inside),
        row=row.take(inside),
        start=start.take(inside),
        stop=stop.take(inside),
        accepted=np.ones(len(inside), bool),
        group=np.arange(len(inside)),
        crossings=crossings.take(inside, axis=0),
    )


@dataclass(frozen=True, eq=False)
class LaneRows:
    """R rows of the triangles that have a lane, those without pixels among them, in drawing order."""

    triangle: Integers
    """(R,) int64, index of the triangle."""
    row: Integers
    """(R,) int64."""
    start: Integers
    """(R,) int64, first inside column."""
    stop: Integers
    """(R,) int64, column after the last; ``start`` where no centre is inside."""


def owners_of(edges: EdgeFunctions) -> TieOwners:
    """Return who owns ties on each kind of edge; a kind that does not occur decides nothing."""
    a, b, owns = edges.a, edges.b, edges.owns_tie
    level = a == 0
    return TieOwners(
        left=bool(owns[a > 0].all()),
        right=bool(owns[a < 0].all()),
        bottom=bool(owns[level & (b > 0)].all()),
        top=bool(owns[level & (b < 0)].all()),
    )


def lanes_of_edges(
    edges: EdgeFunctions, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> TriangleSetup:
    """Put the triangles side by side whose corners are all projected; they live in the memory of ``scratch``."""
    x, y = np.ascontiguousarray(edges.corners.decided.T)
    area = np.where(is_in_lane(edges), edges.doubled_area, 0)
    return set_up_lanes(x, y, area, raster, owners, scratch)


def is_in_lane(edges: EdgeFunctions) -> Flags:
    """Return (P,) bool, whose corners are all projected: exact fractions need them on the grid."""
    return np.asarray(edges.corners.is_projected.all(axis=1))


def height_of_lanes(lanes: TriangleSetup) -> Integers:
    """Return the number of rows (L,) int64 of every lane."""
    shortest_first = np.array(lanes.taller[::-1], np.int64)
    return len(lanes.taller) - np.searchsorted(shortest_first, np.arange(len(lanes.triangle)), side="right")


def lane_rows(edges: EdgeFunctions, raster: Raster, owners: TieOwners) -> LaneRows:
    """Walk the rows of all triangles that have a lane."""
    scratch = ScratchBuffers()
    return rows_in_order(lanes_of_edges(edges, raster, owners, scratch), len(edges), raster, owners, scratch)


def rows_in_order(
    lanes: TriangleSetup, triangle_count: int, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> LaneRows:
    """Walk the rows of lanes of ``triangle_count`` triangles and put them in drawing order; the lanes are used up."""
    if len(lanes.triangle) == 1:
        _, start, length = bounds_of_rows(lanes, raster, owners, (), scratch)
        row = int(lanes.first_row[0]) + np.arange(len(start))
        return _as_rows(np.repeat(lanes.triangle, len(start)), row, start, length)
    height, first_row = height_of_lanes(lanes), lanes.first_row.astype(np.int64)
    carried = (Carried(np.arange(len(first_row)), 0), Carried(first_row.copy(), 1))
    (lane, row), start, length = bounds_of_rows(lanes, raster, owners, carried, scratch)

    # A triangle's rows stand behind those of all triangles drawn before it.
    count = np.zeros(triangle_count, np.int64)
    count[lanes.triangle] = height
    before = (np.cumsum(count) - count).take(lanes.triangle)
    level = row - first_row.take(lane)
    is_own = level < height.take(lane)  # levels walked together run over the end of some lanes
    walked = np.empty(int(count.sum()), np.int64)
    walked[(before.take(lane) + level)[is_own]] = np.flatnonzero(is_own)
    triangle = np.repeat(np.arange(triangle_count), count)
    return _as_rows(triangle, row.take(walked), start.take(walked), length.take(walked))


def pixels_of_rows(rows: LaneRows, raster: Raster) -> tuple[Integers, Integers]:
    """Return place in the buffer and triangle of all pixels of rows (R,), (F,) int64 each, in the order of the rows.

    Notes
    -----
    A place is one more than the one before it, but for the first of a row: a running sum of these steps.
    """
    length = rows.stop - rows.start
    inside = np.flatnonzero(length)
    length, first = length.take(inside), raster.index(rows.start, rows.row).take(inside)
    ends = np.cumsum(length)
    place = np.ones(int(ends[-1]) if len(ends) else 0, np.int64)
    if len(place):
        place[0] = first[0]
        place[ends[:-1]] = first[1:] - (first[:-1] + length[:-1] - 1)
    return np.cumsum(place, out=place), np.repeat(rows.triangle.take(inside), length)


def _as_rows(triangle: Integers, row: Integers, start: Integers, length: Integers) -> LaneRows:
    """Return rows (R,) that have pixels where the length is positive."""
    begin = start.astype(np.int64)
    return LaneRows(triangle, row, begin, begin + np.maximum(length, 0))
