"""Trace of the edge set-up: corners snapped, the area's sign, and the three edge functions."""

import numpy as np

from core.raster.edges.edge_functions import anchored_coefficients, edge_coefficients
from core.raster.edges.snapping import snap_one
from core.raster.number_formats.floats import rounded_corner
from core.raster.number_formats.inverse import inverse_coefficients
from core.records.listing import listing
from core.records.operation import Operation
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

KINDS = (
    "snapped",
    "homogeneous",
    "orientation",
    "edge",
    "anchored-edge",
    "rounded",
    "inverse-edge",
    "determinant",
)


def trace_edges(source: TraceSource) -> StageTrace:
    """Return seven rows for every primitive: three corners, orientation, three edges."""
    geometry = source.geometry
    edges, corners, numbers = geometry.edges, geometry.edges.corners, geometry.edges.numbers
    ends = numbers.shown_ends(corners)
    count = len(edges)
    primitive = np.repeat(np.arange(count), 7)
    place = np.tile(np.arange(7), count)
    index = np.array([0, 1, 2, 0, 0, 1, 2])[place]
    left_alone = KINDS.index("rounded" if numbers.corner_kind == "rounded" else "homogeneous")
    corner_kind = np.where(corners.is_projected[primitive, index], KINDS.index("snapped"), left_alone)
    edge_kind = KINDS.index("inverse-edge" if numbers.divides else "edge")
    area_kind = KINDS.index("determinant" if numbers.divides else "orientation")
    kind = np.where(place < 3, corner_kind, np.where(place == 3, area_kind, edge_kind))
    following, last = (index + 1) % 3, (index + 2) % 3
    from_corner, to_corner = corners.is_projected[primitive, following], corners.is_projected[primitive, last]
    if numbers.suits_spans:
        kind[(place > 3) & (from_corner != to_corner)] = KINDS.index("anchored-edge")
    columns = {
        "corner": index,
        "edge": index,
        "homogeneous": corners.homogeneous[primitive, index],
        "window": corners.window[primitive, index],
        "snapped": corners.decided[primitive, index],
        "rounded": ends[primitive, index],
        "doubled_area": edges.doubled_area[primitive],
        "is_projected": from_corner & to_corner,
        "anchor": from_corner.astype(np.int64) - to_corner,
        "a": edges.shown_a[primitive, index],
        "b": edges.shown_b[primitive, index],
        "c": edges.shown_c[primitive, index],
        "owns_tie": edges.owns_tie[primitive, index],
        "start": ends[primitive, following],
        "finish": ends[primitive, last],
    }
    coefficients = (
        *(Operation(name, name, (name,)) for name in "abc"),
        Operation("tie", "c", ("owns_tie",)),
    )
    steps = Steps(
        kinds=KINDS,
        kind=kind,
        operations={
            "snapped": (Operation("window", "snap", ("window",)), Operation("snap", "back", ("snapped",))),
            "homogeneous": (Operation("keep", "snap", ("homogeneous",)),),
            "orientation": (Operation("area", "a", ("doubled_area",)),),
            "edge": coefficients,
            "anchored-edge": coefficients,
            "rounded": (Operation("round", "round", ("rounded",)),),
            "inverse-edge": tuple(Operation(done.name, "inverse", done.sets) for done in coefficients),
            "determinant": (Operation("area", "determinant", ("doubled_area",)),),
        },
        triangle_ends=ends_of(geometry.primitives.triangle[primitive]),
        group_ends=ends_of(primitive, np.array([0, 0, 0, 1, 2, 2, 2])[place]),
    )
    snapping, cross_product = listing(snap_one), listing(edge_coefficients)
    return StageTrace(
        stage="edges",
        method=f"coverage={source.settings.coverage}",
        steps=steps,
        columns=columns,
        triangle=geometry.primitives.triangle[primitive],
        pixel=no_pixels(len(primitive)),
        listings={
            "snapped": snapping,
            "homogeneous": snapping,
            "orientation": cross_product,
            "edge": cross_product,
            "anchored-edge": listing(anchored_coefficients),
            "rounded": listing(rounded_corner),
            "inverse-edge": listing(inverse_coefficients),
            "determinant": listing(inverse_coefficients),
        },
        marks={"rejected": (place == 3) & (edges.doubled_area[primitive] == 0)},
        extra={"edges": edges, "planes": geometry.planes},
        constants={
            "fill_rule": source.settings.fill_rule,
            "number_format": numbers.name,
            "rounding": numbers.rounding,
        },
    )
