"""Trace of the fill ``spans``: lane, rows and pixels of every triangle, and in which order the engine draws.

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

from core.coverage.edges import EdgeFunctions, edge_value
from core.coverage.pixel_runs import Raster
from core.coverage.traced_rows import KIND, RowTable
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Listing, listing
from core.spans.fill import (
    LaneRows,
    height_of_lanes,
    is_in_lane,
    lane_rows,
    lanes_of_edges,
    order_of_pixels,
    place_by_size,
    rows_of_triangle,
    span_of_row,
)
from core.spans.lanes import Carried, TieOwners, tie_owners, walk_rows
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack

# In which order the engine draws, for all rows of lanes in drawing order: lane, level, span, pass.


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


# Trace of the fill ``spans``: lane, rows and pixels of every triangle, and when the engine draws each of
# them.


Columns = dict[str, np.ndarray]


def rows_of_spans(source: TraceSource, order: SpanOrder) -> RowTable:
    """Return one row for every lane, for every row of it, and for every pixel, in drawing order.

    Triangles without a lane have rows as the fill ``scanline`` gives them.
    """
    runs, tests, rows = source.runs, source.tests, order.rows
    has_lane = is_in_lane(source.geometry.edges)
    assert runs.crossings is not None

    # Rows of pixels: those of lanes, and the spans of triangles that have none.
    in_lane = has_lane[runs.triangle]
    others = np.flatnonzero(~in_lane)
    triangle = np.concatenate([rows.triangle, runs.triangle[others]])
    line_order = np.argsort(triangle, kind="stable")
    triangle = triangle[line_order]
    row, start, stop = (
        np.concatenate([getattr(rows, name), getattr(runs, name)[others]])[line_order]
        for name in ("row", "start", "stop")
    )
    line_kind = np.repeat([KIND["lane-row"], KIND["span"]], [len(rows.row), len(others)])[line_order]
    missing = np.full((len(rows.row), 3), np.nan)
    crossings = np.concatenate([missing, runs.crossings[others]])[line_order]
    line_of_run = np.flatnonzero((start < stop) | (line_kind == KIND["span"]))

    # A triangle's lane stands before its rows, a row before its pixels.
    lanes = np.flatnonzero(order.row_count)
    line = np.concatenate([np.full(len(lanes), -1), np.arange(len(triangle)), line_of_run[tests.run]])
    primitive = np.concatenate([lanes, triangle, tests.primitive])
    test = np.concatenate([np.full(len(lanes) + len(triangle), -1), np.arange(len(tests.run))])
    pixel_kind = np.where(has_lane[tests.primitive], KIND["pass"], KIND["accept"])
    kind = np.concatenate([np.full(len(lanes), KIND["lane"]), line_kind, pixel_kind])
    sorting = np.lexsort((test, line, primitive))
    line = line[sorting]

    def of_line(values: np.ndarray, none: float) -> np.ndarray:
        found = np.full((len(line), *values.shape[1:]), none, values.dtype)
        found[line >= 0] = values[line[line >= 0]]
        return found

    return RowTable(
        kind=kind[sorting],
        primitive=primitive[sorting],
        group=line,
        row=of_line(row, -1),
        start=of_line(start, -1),
        stop=of_line(stop, -1),
        crossings=of_line(crossings, np.nan),
        run=np.full(len(line), -1),
        test=test[sorting],
    )


def span_columns(source: TraceSource, table: RowTable, order: SpanOrder) -> Columns:
    """Return the numbers of lanes, rows and passes; -1 or NaN where a row of the trace has no use for them."""
    edges, kind, primitive = source.geometry.edges, table.kind, table.primitive
    is_row, is_pass = kind == KIND["lane-row"], kind == KIND["pass"]
    in_lane = is_row | is_pass | (kind == KIND["lane"])

    # Which of the rows of all lanes it is, or lies in: a row stands before its pixels.
    lane_row = np.where(is_row | is_pass, np.cumsum(is_row) - 1, -1)

    def of_lane_row(values: Integers) -> Integers:
        return np.append(values, -1)[lane_row]

    def of_triangle(values: Integers) -> Integers:
        return np.where(in_lane, values[primitive], -1)

    columns: Columns = {
        "corner_y": np.where(in_lane[:, None], edges.corners.decided[primitive, :, 1], np.nan),
        "first_row": of_triangle(order.first_row),
        "row_count": of_triangle(order.row_count),
        "lane": of_triangle(order.lane),
        "level": of_lane_row(order.level),
        "length": of_lane_row(order.rows.stop - order.rows.start),
        "place": of_lane_row(order.place),
        "dx": edges.b[primitive] + 0.0,
        "dy": 0.0 - edges.a[primitive],
    }
    columns |= _crossings(source, table, columns["dy"], is_row)
    return columns | _passes(source, table, columns["place"], order, is_pass)


def _crossings(source: TraceSource, table: RowTable, dy: Floats, is_row: Flags) -> Columns:
    """Return where rows of lanes cross the edges, in columns, as fractions.

    The edge function is linear and grows by -dy from column to column, so its value at the centre of column 0, over dy,
    is the column at which it is 0. The engine computes the same numerator from the corners; neither is rounded.
    """
    edges, primitive = source.geometry.edges, table.primitive
    y = source.raster.along(table.row)[:, None]
    at_column_0 = np.full((len(y), 3), source.raster.center)
    numerator = edge_value(edges.a[primitive], edges.b[primitive], edges.c[primitive], at_column_0, y)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        quotient = numerator * (1 / dy)
    is_crossed = is_row[:, None] & (dy != 0)
    numerator, quotient = np.where(is_row[:, None], numerator, np.nan), np.where(is_crossed, quotient, np.nan)
    found: Columns = {f"numerator_{k}": numerator[:, k] for k in range(3)}
    found |= {f"quotient_{k}": quotient[:, k] for k in range(3)}
    left, right = (np.where(side & is_crossed, quotient, np.nan) for side in (dy < 0, dy > 0))
    found["left"] = np.fmax(np.fmax(left[:, 0], left[:, 1]), left[:, 2])
    found["right"] = np.fmin(np.fmin(right[:, 0], right[:, 1]), right[:, 2])
    return found


def _passes(
    source: TraceSource, table: RowTable, place: Integers, order: SpanOrder, is_pass: Flags
) -> Columns:
    """Return pass and rank of every pixel; triangles without a lane are drawn after all that have one."""
    is_pixel = table.test >= 0
    column = np.append(source.tests.column, -1)[table.test]
    number = np.where(is_pass, column - table.start, -1)
    before = np.where(is_pass, order.drawn_before[number], -1)
    others = is_pixel & ~is_pass
    rank = np.where(is_pass, before + place, -1)
    rank[others] = order.drawn_before[-1] + np.arange(np.count_nonzero(others))
    return {
        "pass_number": number,
        "pass_size": np.where(is_pass, np.append(order.longer, -1)[number], -1),
        "drawn_before": before,
        "rank": rank,
    }


def span_constants(source: TraceSource, order: SpanOrder) -> dict[str, float | int]:
    """Return what is the same in all rows."""
    owners = tie_owners(source.settings.fill_rule)
    return {
        "lane_count": order.lane_count,
        "span_count": order.span_count,
        "left_guard": owners.left_guard,
        "right_guard": owners.right_guard,
    }


def span_listings() -> dict[str, Listing]:
    """Return the listings of lanes, rows and passes."""
    in_order, passes = listing(place_by_size), listing(order_of_pixels)
    return {
        "lane": listing(rows_of_triangle),
        "lane.lane": in_order,
        "lane-row": listing(span_of_row),
        "lane-row.place": in_order,
        "pass": passes,
    }


def pass_track(source: TraceSource, columns: Columns) -> BufferTrack:
    """Return the buffer of passes: which one drew each pixel, the last in drawing order.

    ``columns`` are those of the trace, (R, ...) arrays.
    """
    rows = np.flatnonzero(columns["pass_number"] >= 0)
    place = source.raster.index(columns["column"][rows], columns["row"][rows])
    unknown = np.full(source.raster.shape, np.nan)
    return BufferTrack("pass", unknown, rows, place, columns["pass_number"][rows].astype(float), "count")
