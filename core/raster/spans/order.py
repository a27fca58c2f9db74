"""In which order the engine draws, for all rows of lanes in drawing order: lane, level, span, pass.

    lane    place of the triangle among all, the tallest first
    level   how many rows of its triangle lie below; the engine walks level by level
    place   place of the row's span among all spans, the longest first
    pass    number k of a pixel in its span: pass k draws the k-th pixel of every span that has one
    rank    how many pixels are drawn before this one: those of the passes before, and in its pass those before it

The pixels of one pass are drawn by one array operation, and so are all that is left of fewer than ``packed.FEW`` spans:
their ranks are the order in which they stand in memory. The least word wins whatever the order.
"""

from dataclasses import dataclass

import numpy as np

from core.numeric.buffers import ScratchBuffers
from core.raster.edges.edge_functions import EdgeFunctions
from core.raster.pixel_runs import Raster
from core.raster.spans.fill import LaneRows, height_of_lanes, lane_rows, lanes_of_edges
from core.raster.spans.lanes import TieOwners
from core.raster.spans.rows import Carried, walk_rows
from core.records.arrays import Integers


@dataclass(frozen=True, eq=False)
class SpanOrder:
    """P triangles, their R rows in drawing order, and where both stand in the order of execution."""

    lane: Integers
    """(P,) int64, -1: the triangle has no lane."""
    lane_count: int
    first_row: Integers
    """(P,) int64, row of level 0, -1: no lane."""
    row_count: Integers
    """(P,) int64, 0: no lane."""
    rows: LaneRows
    level: Integers
    """(R,) int64."""
    place: Integers
    """(R,) int64, -1: the row has no pixel and so no span."""
    longer: Integers
    """(K,) int64, how many spans have more than k pixels: the pixels of pass k."""

    @property
    def span_count(self) -> int:
        """Spans of all lanes together."""
        return int(self.longer[0]) if len(self.longer) else 0

    @property
    def drawn_before(self) -> Integers:
        """(K + 1,) int64, pixels that are drawn before each pass, and all of them."""
        return np.concatenate([[0], np.cumsum(self.longer)]).astype(np.int64)


def order_of_spans(edges: EdgeFunctions, raster: Raster, owners: TieOwners) -> SpanOrder:
    """Walk the rows of all lanes and sort their spans as pictures do."""
    scratch, count = ScratchBuffers(), len(edges)
    rows = lane_rows(edges, raster, owners)
    lanes = lanes_of_edges(edges, raster, owners, scratch)
    lane, first_row = np.full(count, -1), np.full(count, -1)
    lane[lanes.triangle] = np.arange(len(lanes.triangle))
    first_row[lanes.triangle] = lanes.first_row
    row_count = np.zeros(count, np.int64)
    row_count[lanes.triangle] = height_of_lanes(lanes)
    before = np.cumsum(row_count) - row_count

    # The spans, longest first, and where their rows stand in drawing order.
    carried = Carried(lanes.first_row.astype(np.int64), 1)
    spans = walk_rows(lanes, raster, owners, (carried,), scratch)
    triangle = lanes.triangle.take(spans.lane)
    place = np.full(len(rows.row), -1)
    place[before[triangle] + spans.carried[0] - first_row[triangle]] = np.arange(len(spans))
    return SpanOrder(
        lane=lane,
        lane_count=len(lanes.triangle),
        first_row=first_row,
        row_count=row_count,
        rows=rows,
        level=rows.row - first_row[rows.triangle],
        place=place,
        longer=np.array(spans.longer, np.int64),
    )
