"""The fill ``spans``: the engine's spans as a schedule in drawing order, as every fill gives one.

Pictures draw the spans as they come (``packed``); traces, blending and the depth methods that packed words cannot
carry take them from here. Triangles with a corner that cannot be snapped have no lane: their spans are found row by
row from the homogeneous edge functions (``scanline``), by the same decisions.
"""

import numpy as np

from core.methods import method
from core.raster.edges.edge_functions import EdgeFunctions
from core.raster.fills.scanline import scanline
from core.raster.fills.traits import FillTraits
from core.raster.pixel_runs import Boxes, Raster, Runs
from core.raster.spans.lane_rows import is_in_lane, lane_rows, owners_of


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
