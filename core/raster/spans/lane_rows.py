"""The rows of all lanes in drawing order: triangle by triangle, from its lowest row up.

The engine walks level by level, so the rows of a triangle come out far from each other. Their places in drawing order
are known beforehand, since every triangle has a fixed number of rows: they are put there without being sorted.
"""

from dataclasses import dataclass

import numpy as np

from core.raster.edges.edge_functions import EdgeFunctions
from core.raster.pixel_runs import Raster
from core.raster.spans.lanes import TieOwners, TriangleSetup, set_up_lanes
from core.raster.spans.rows import Carried, bounds_of_rows
from core.raster.spans.scratch_buffers import ScratchBuffers
from core.records.arrays import Flags, Integers


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
    kinds = (a > 0, a < 0, level & (b > 0), level & (b < 0))
    return TieOwners(*(bool(owns[kind].all()) for kind in kinds))


def lanes_of_edges(
    edges: EdgeFunctions, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> TriangleSetup:
    """Put the triangles side by side whose corners are all projected; they live in the memory of ``scratch``."""
    x, y = (np.ascontiguousarray(edges.corners.decided[..., axis].T) for axis in range(2))
    area = np.where(is_in_lane(edges), edges.doubled_area, 0)
    return set_up_lanes(x, y, area, raster, owners, scratch)


def is_in_lane(edges: EdgeFunctions) -> Flags:
    """Return (P,) bool, whose corners are all projected: exact fractions need them on the lattice."""
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
