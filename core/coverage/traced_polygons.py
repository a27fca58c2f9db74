"""Trace of a polygon's fill: the edge table; then, row by row, the active edges, the intervals and the pixels."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.active_edges import OPERATIONS, Crossings, EdgeTable, edge_table, find_crossings
from core.coverage.pixel_runs import Raster, expand
from core.coverage.snapping import SUBPIXELS
from core.coverage.traced_rows import overdraw_track
from core.methods import table as method_table
from core.records.arrays import Integers
from core.records.listing import listing
from core.records.steps import Steps, ends_of
from core.resolved import resolve
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

KINDS = tuple(OPERATIONS)
EDGE, LEVEL, LEAVE, ADVANCE, ENTER, OUTSIDE, INSIDE, PIXEL = range(len(KINDS))


@dataclass(frozen=True, eq=False)
class FillRows:
    """R rows of a fill before their numbers, in the order in which they are done."""

    kind: Integers
    """(R,) int64, index of `KINDS`."""
    polygon: Integers
    """(R,) int64, index of the primitive."""
    row: Integers
    """(R,) int64, row of pixels; -1 while the table is filled."""
    edge: Integers
    """(R,) int64, the edge that the row is about; of an interval and a pixel the one on their left."""
    crossing: Integers
    """(R,) int64, index of the crossing on the left of an interval or pixel; -1: none."""
    column: Integers
    """(R,) int64, of a pixel; -1: none."""


def fill_rows(table: EdgeTable, found: Crossings, raster: Raster) -> FillRows:
    """List what a fill does: the edge table of each polygon, then for every row its edges, intervals and pixels."""
    left, _, right, top = raster.bounds
    every = np.arange(len(table.polygon))
    has_rows = table.end_row > table.first_row
    edge, row = found.edge, found.row
    is_new = row == table.first_row[edge]
    polygon = table.polygon[edge]
    # An edge leaves in the row after its last one; above the raster nothing is left to do.
    leaving = np.flatnonzero(has_rows & (table.end_row < top))
    start, stop = np.clip(found.column, left, right), np.clip(found.stop, left, right)
    intervals = np.flatnonzero(~found.is_last)
    length = np.where(found.is_inside, np.maximum(stop - start, 0), 0)
    of_pixel, place = expand(length)
    crossing = np.arange(len(edge))
    none = np.full(len(every), -1)
    parts = [
        (np.where(has_rows, EDGE, LEVEL), table.polygon, none, every, every, none, none),
        (
            np.full(len(leaving), LEAVE),
            table.polygon[leaving],
            table.end_row[leaving],
            leaving,
            leaving,
            none[leaving],
            none[leaving],
        ),
        (
            np.where(is_new, ENTER, ADVANCE),
            polygon,
            row,
            crossing + len(edge) * is_new,
            edge,
            np.full(len(edge), -1),
            np.full(len(edge), -1),
        ),
        (
            np.where(found.is_inside[intervals], INSIDE, OUTSIDE),
            polygon[intervals],
            row[intervals],
            intervals,
            edge[intervals],
            intervals,
            np.full(len(intervals), -1),
        ),
        (
            np.full(len(of_pixel), PIXEL),
            polygon[of_pixel],
            row[of_pixel],
            of_pixel,
            edge[of_pixel],
            of_pixel,
            start[of_pixel] + place,
        ),
    ]
    kind, owner, line, order, its_edge, its_crossing, column = (
        np.concatenate([part[k] for part in parts]) for k in range(7)
    )
    phase = np.array([0, 0, 1, 2, 2, 3, 3, 3])[kind]
    sort = np.lexsort((column, order, phase, line, owner))
    return FillRows(*(values[sort] for values in (kind, owner, line, its_edge, its_crossing, column)))


def trace_polygon_fill(source: TraceSource) -> StageTrace:
    """Return one row for every edge of the table, and in each row of pixels for every change, interval and pixel."""
    geometry, raster = source.geometry, source.raster
    assert geometry.polygons is not None
    table = edge_table(geometry.polygons, raster)
    found = find_crossings(table, resolve(source.settings).polygon_fill)
    rows = fill_rows(table, found, raster)
    kind, is_pixel = rows.kind, rows.kind == PIXEL
    columns = _columns(source, table, found, rows)
    triangle = geometry.primitives.triangle[rows.polygon]
    method = method_table.get("polygon_fill", source.settings.polygon_fill)
    assert method.listing is not None, f"{method.name} has no listing"
    writes = np.flatnonzero(is_pixel)
    place = raster.index(rows.column[writes], rows.row[writes])
    unknown = np.full(raster.shape, np.nan)
    return StageTrace(
        stage="raster",
        method=f"polygon_fill={method.name}",
        steps=Steps(
            kinds=KINDS,
            kind=kind,
            operations=method.operations,
            triangle_ends=ends_of(triangle),
            group_ends=ends_of(triangle, rows.row),
        ),
        columns=columns,
        triangle=triangle,
        pixel=np.stack([rows.column, np.where(is_pixel, rows.row, -1)], axis=1),
        listings=dict.fromkeys(KINDS, listing(method.listing)),
        marks={
            "covered": is_pixel,
            "rejected": np.zeros(len(kind), bool),
            "tie": is_pixel & (columns["interval_left"] == rows.column + raster.center),
            "nan": np.zeros(len(kind), bool),
        },
        buffers=(
            BufferTrack("coverage", unknown, writes, place, np.ones(len(writes)), "flags"),
            BufferTrack("crossed", unknown, writes, place, columns["crossed"][writes].astype(float), "count"),
            BufferTrack(
                "winding", unknown, writes, place, columns["winding"][writes].astype(float), "signed"
            ),
            overdraw_track(source, writes),
        ),
        extra={
            "runs": source.runs,
            "boxes": source.boxes,
            "blocks": None,
            "edges": geometry.edges,
            "edge_table": table,
        },
        constants={"center": raster.center, "polygon_fill": method.name},
    )


def _columns(
    source: TraceSource, table: EdgeTable, found: Crossings, rows: FillRows
) -> dict[str, NDArray[Any]]:
    """Return the numbers of every row; -1, NaN or False where it has none."""
    edge, at, kind = rows.edge, rows.crossing, rows.kind
    polygons = source.geometry.polygons
    assert polygons is not None
    first = polygons.starts[np.searchsorted(polygons.polygon, rows.polygon)]
    has_interval, has_rows = at >= 0, table.end_row[edge] > table.first_row[edge]
    line = np.where(rows.row >= 0, rows.row, table.first_row[edge])
    is_known = has_rows & (kind != LEAVE)

    def of_crossing(values: NDArray[Any], missing: float) -> NDArray[Any]:
        return np.where(has_interval, values[at] if len(values) else missing, missing)

    crossing = np.full(len(edge), np.nan)
    crossing[is_known] = table.crossing(edge[is_known], line[is_known])
    before = np.full(len(edge), np.nan)
    advanced = kind == ADVANCE
    before[advanced] = table.crossing(edge[advanced], line[advanced] - 1)
    following = np.append(found.x[1:], np.nan)
    return {
        "column": rows.column,
        "row": rows.row,
        "primitive": rows.polygon,
        "covered": kind == PIXEL,
        "edge": edge - first,
        "edge_start": table.corner[edge] - first,
        "edge_end": table.following[edge] - first,
        "lower": table.lower[edge] / SUBPIXELS,
        "upper": table.upper[edge] / SUBPIXELS,
        "direction": table.direction[edge],
        "row_first": table.first_row[edge],
        "row_end": table.end_row[edge],
        "bucket": np.where(has_rows, table.first_row[edge], -1),
        "shift": table.slope[edge],
        "crossing": crossing,
        "crossing_before": before,
        "crossed": of_crossing(found.crossed, -1).astype(np.int64),
        "winding": of_crossing(found.winding, 0).astype(np.int64),
        "is_inside": of_crossing(found.is_inside, 0).astype(bool),
        "interval_left": of_crossing(found.x, np.nan),
        "interval_right": of_crossing(following, np.nan),
        "start": of_crossing(found.column, -1).astype(np.int64),
        "stop": of_crossing(found.stop, -1).astype(np.int64),
    }
