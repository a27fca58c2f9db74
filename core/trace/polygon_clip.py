"""Trace of polygon clipping: the steps of the method on each polygon, before it is filled."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.geometry.ring_clipping.records import COLUMNS, Row
from core.methods import table
from core.records.listing import listing
from core.records.steps import Steps, ends_of
from core.stages.clipped_polygons import PolygonClip
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

PHASES = {"wa-ring": 0, "wa-crossing": 1, "wa-whole": 2}
"""Kinds of Weiler-Atherton that are one step of the level GROUP together; later, each ring of the result is."""


def trace_polygon_clip(source: TraceSource, clip: PolygonClip) -> StageTrace:
    """Return one row for every step of the method; a polygon of which nothing is left has them too."""
    method = table.get("polygon_clipping", source.settings.polygon_clipping)
    kinds = tuple(method.operations)
    rows = [row for clipped in clip.clipped for row in clipped.rows]
    polygon = np.repeat(np.arange(len(clip.clipped)), [len(clipped.rows) for clipped in clip.clipped])
    triangle = source.geometry.primitives.triangle[polygon]
    kind = np.array([kinds.index(row["kind"]) for row in rows], np.int64)
    assert method.listing is not None, f"{method.name} has no listing"
    own = {} if method.traits is None else method.traits.listings
    kept = _flags(rows, "is_kept")
    is_whole = np.array(["wa-" not in row["kind"] or row["kind"] == "wa-whole" for row in rows], bool)
    return StageTrace(
        stage="clip",
        method=f"polygon_clipping={method.name}",
        steps=Steps(
            kinds=kinds,
            kind=kind,
            operations=method.operations,
            triangle_ends=ends_of(triangle),
            group_ends=ends_of(triangle, np.array([_group(row) for row in rows], np.int64)),
        ),
        columns={name: _column(rows, name) for name in COLUMNS},
        triangle=triangle,
        pixel=no_pixels(len(rows)),
        listings=dict.fromkeys(kinds, listing(method.listing))
        | {kind: listing(of) for kind, of in own.items()},
        marks={"covered": is_whole & kept, "rejected": is_whole & ~kept, "tie": np.zeros(len(rows), bool)},
        extra={"polygon_clip": clip, "clipped": None, "inserted_for": ""},
    )


def _group(row: Row) -> int:
    """Return a number that neighbouring rows share where they are one step of the level GROUP."""
    if row["kind"] in PHASES:
        return PHASES[row["kind"]]
    if "result_ring" in row:
        return len(PHASES) + int(row["result_ring"])
    return int(row["ring"]) << 16 | int(row["region_edge"])


def _column(rows: list[Row], name: str) -> NDArray[Any]:
    """Return a number of all rows (R, ...); what it is where a row has none stands in `COLUMNS`."""
    missing = np.array(COLUMNS[name])
    if not rows:
        return np.empty((0, *missing.shape), missing.dtype)
    return np.array([row.get(name, missing) for row in rows], missing.dtype)


def _flags(rows: list[Row], name: str) -> NDArray[np.bool_]:
    return np.array([bool(row.get(name, False)) for row in rows], bool)
