"""Trace of the division that comes before the clipping where a method divides first: one row for every corner."""

import numpy as np

from core.geometry.culling import PLANES
from core.geometry.polygon_clipping.after_divide import divide_corner
from core.records.arrays import Integers
from core.records.listing import listing
from core.records.operation import Operation
from core.trace.inserted_rows import InsertedRows, insert_rows
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace

DIVIDE_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "divided": (Operation("divide", "divide", ("ndc",)),),
    "mirrored": (Operation("divide", "divide", ("ndc",)), Operation("sign", "keep")),
    "undefined": (Operation("drop", "undefined"),),
}
"""Kind of row to what it does: a corner with w > 0, with w < 0, and one of a triangle that cannot be divided."""


def with_division(found: StageTrace, source: TraceSource, polygon: Integers, plane: Integers) -> StageTrace:
    """Return the trace of clipping with the divisions before it, if there are any.

    Parameters
    ----------
    polygon, plane : (R,) int64
        Which of the kept triangles, and which plane (-1: none), the rows are about.
    """
    geometry = source.geometry
    clipped = geometry.clipped
    if clipped is None or not clipped.is_divided:
        return found
    owner = np.repeat(clipped.clipped, 3)
    corner = np.tile(np.arange(3), len(clipped.clipped))
    clip = geometry.kept.clip[owner, corner]
    is_defined = np.repeat(clipped.counts[0] > 0, 3)
    ndc = clipped.polygons[0][:, :3, :3].reshape(-1, 3)
    kind = np.where(is_defined, np.where(clip[:, 3] > 0, 0, 1), 2)
    width = len(PLANES) + 1
    rows = InsertedRows(
        before=np.searchsorted(polygon, owner),
        group=width * owner,
        triangle=geometry.kept.triangle[owner],
        kinds=tuple(DIVIDE_OPERATIONS),
        kind=kind,
        operations=DIVIDE_OPERATIONS,
        columns={"number": corner, "clip": clip, "ndc": np.where(is_defined[:, None], ndc, np.nan)},
        listings=dict.fromkeys(DIVIDE_OPERATIONS, listing(divide_corner)),
    )
    return insert_rows(found, width * polygon + plane + 1, rows)
