"""Trace of polygon clipping: every edge of every polygon against every plane."""

import numpy as np

from core.geometry.culling import PLANES
from core.geometry.polygon_clipping.sutherland_hodgman import CASES, clip_edge, clip_edge_in_order
from core.records.listing import RETURN, listing
from core.records.operation import Operation
from core.records.steps import Steps, ends_of
from core.resolved import resolve
from core.trace.clip_divide import with_division
from core.trace.polygon_clip import trace_polygon_clip
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

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
