"""Trace of clipping: every edge against every plane, the division before it where a method divides first, and rings."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.clipping.planes import divide_corner
from core.clipping.rings import COLUMNS, Row
from core.clipping.sutherland_hodgman import CASES, clip_edge, clip_edge_in_order
from core.culling.culling import PLANES
from core.methods import table
from core.records.arrays import Integers
from core.records.listing import RETURN, Operation, listing
from core.records.steps import Steps, ends_of
from core.resolved import resolve
from core.stages.primitives import PolygonClip
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, StageTrace, insert_rows, no_pixels

# Trace of the division that comes before the clipping where a method divides first: one row for every
# corner.


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


# Trace of polygon clipping: the steps of the method on each polygon, before it is filled.


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


# Trace of polygon clipping: every edge of every polygon against every plane.


KINDS = (*CASES, "untouched")
CROSSING = (
    (Operation("t", "t-out", ("t",)), Operation("corner", "leave", {"corner": RETURN})),
    (Operation("t", "t-in", ("t",)), Operation("corner", "enter", {"corner": RETURN})),
)
"""What an edge that leaves does, and one that enters, where new corners are computed from the inside end."""
CROSSING_IN_ORDER = (
    Operation("t-in-order", "t", ("t",)),
    Operation("corner-in-order", "corner", ("corner",)),
)
"""The same where they are computed from the edge's start."""


def trace_clip(source: TraceSource) -> StageTrace:
    """Return one row for every edge and plane; a triangle that no plane crosses has one row that says so."""
    geometry = source.geometry
    if geometry.polygon_clip is not None:
        return trace_polygon_clip(source, geometry.polygon_clip)
    clipped = geometry.clipped
    kept = geometry.kept
    crossed = clipped.clipped if clipped is not None else np.empty(0, np.int64)
    is_untouched = np.ones(len(kept), bool)
    is_untouched[crossed] = False
    untouched = np.flatnonzero(is_untouched)
    rows = clipped.rows if clipped is not None else None
    polygon = np.concatenate([crossed[rows.polygon] if rows is not None else crossed, untouched])
    order = np.argsort(polygon, kind="stable")

    def column(of_rows: np.ndarray | None, missing: np.ndarray) -> np.ndarray:
        joined = missing if of_rows is None else np.concatenate([of_rows, missing])
        return np.asarray(joined[order])

    def numbers(name: str, *shape: int) -> np.ndarray:
        found = None if rows is None else getattr(rows, name)
        # Of a position and the values that go along, the position.
        return column(
            found[..., :4] if found is not None and shape else found,
            np.full((len(untouched), *shape), np.nan),
        )

    kind = column(None if rows is None else rows.case, np.full(len(untouched), len(CASES)))
    plane = column(None if rows is None else rows.plane, np.full(len(untouched), -1))
    columns = {
        "plane": np.array([*PLANES, "none"])[plane],
        "edge": column(None if rows is None else rows.edge, np.zeros(len(untouched), np.int64)),
        "start": numbers("start", 4),
        "end": numbers("end", 4),
        "start_distance": numbers("start_distance"),
        "end_distance": numbers("end_distance"),
        "t": numbers("t"),
        "corner": numbers("corner", 4),
    }
    pieces = geometry.kept_pieces
    number = np.zeros(len(kept), np.int64) if pieces is None else pieces.number
    columns |= {"kept": polygon[order], "tree_piece": number[polygon[order]]}
    given = "plane", "start", "end", "start_distance", "end_distance"
    distances = Operation("distances", "in-in", (), given)
    clipping = resolve(source.settings).clipping
    is_canonical = clipping.is_canonical or bool(geometry.clipping_inserted)
    crossing = CROSSING if is_canonical else (CROSSING_IN_ORDER, CROSSING_IN_ORDER)
    steps = Steps(
        kinds=KINDS,
        kind=kind,
        operations={
            "in-in": (distances, Operation("keep", "keep")),
            "out-out": (distances, Operation("drop", "out-out")),
            "in-out": (distances, *crossing[0]),
            "out-in": (distances, *crossing[1]),
            "untouched": (Operation("keep", ""),),
        },
        triangle_ends=ends_of(polygon[order]),
        group_ends=ends_of(polygon[order], plane),
    )
    found = StageTrace(
        stage="clip",
        method=f"clipping={source.settings.clipping}",
        steps=steps,
        columns=columns,
        triangle=kept.triangle[polygon[order]],
        pixel=no_pixels(len(order)),
        listings=dict.fromkeys(CASES, listing(clip_edge if is_canonical else clip_edge_in_order)),
        marks={"rejected": kind == 0},
        extra={"clipped": clipped, "inserted_for": geometry.clipping_inserted},
    )
    return with_division(found, source, polygon[order], plane)
