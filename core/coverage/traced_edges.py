"""Trace of the edge set-up and of binning: corners snapped, edge functions, boxes, and the verdict on every block."""

from math import ceil, floor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.binning import block_verdict
from core.coverage.edge_formats import inverse_coefficients, rounded_corner
from core.coverage.edges import edge_coefficients, edge_value
from core.coverage.pixel_runs import INSIDE, LEAF, OUTSIDE, SPLIT
from core.coverage.snapping import anchored_coefficients, edge_left_out, given_directions, snap_one
from core.interpolation.interpolation import perspective
from core.methods import table
from core.records.arrays import Floats
from core.records.listing import RETURN, Columns, Labels, Listing, Operation, listing
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

# Trace of the edge set-up: corners snapped, the area's sign, and the three edge functions.


EDGE_KINDS = (
    *("snapped", "homogeneous", "orientation", "edge", "anchored-edge", "left-out-edge", "rounded"),
    *("inverse-edge", "determinant"),
)


ROWS = 7
"""Rows of a primitive: three corners, the orientation, three edges."""


def known_edges(rows_done: int) -> tuple[int, int]:
    """Return the primitive that the last of ``rows_done`` rows is about, and how many of its edges are set up."""
    primitive = max(rows_done - 1, 0) // ROWS
    return primitive, max(rows_done - ROWS * primitive - 4, 0)


def half_plane(source: TraceSource, primitive: int, edge: int) -> Floats:
    """Return (H, W) float64, the value of an edge function at every pixel's centre, as a pixel's test shows it."""
    edges, raster = source.geometry.edges, source.raster
    first_column, first_row, end_column, end_row = raster.bounds
    x = edges.numbers.of_pixels(raster.along(np.arange(first_column, end_column)))
    y = edges.numbers.of_pixels(raster.along(np.arange(first_row, end_row)))
    a, b, c = (part[primitive, edge] for part in (edges.a, edges.b, edges.c))
    with np.errstate(over="ignore", invalid="ignore"):
        return edges.numbers.shown_values(edge_value(a, b, c, x, y[:, None]))


def weights_everywhere(source: TraceSource, primitive: int) -> Floats:
    """Return (3, H, W) float64, the perspective-correct weights of the corners at every pixel's centre."""
    raster = source.raster
    row, column = np.divmod(np.arange(raster.shape[0] * raster.shape[1]), raster.shape[1])
    left, bottom, _, _ = raster.bounds
    centers = raster.centers(column + left, row + bottom)
    weights: Floats = perspective(source.geometry.planes, np.full(len(row), primitive), *centers, 0, 0)
    return weights.T.reshape(3, *raster.shape)


def _tie_label(rule: Listing) -> str | Labels:
    """Return the line of a fill rule's listing that decides: the only one that returns, or that of a slanted edge."""
    if "right" not in rule.lines:
        return next(iter(rule.lines))
    return lambda columns, rows: np.where(columns["a"][rows] != 0, "right", "up")


def _inverse_label(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line of the inverse's listing that returns: of a matrix without one, zeros."""
    return np.where(columns["doubled_area"][rows] == 0, "singular", "inverse")


def trace_edges(source: TraceSource) -> StageTrace:
    """Return seven rows for every triangle: three corners, orientation, three edges; lines have none."""
    geometry = source.geometry
    edges, corners, numbers = geometry.edges, geometry.edges.corners, geometry.edges.numbers
    ends = numbers.shown_ends(corners)
    count = len(edges) if geometry.vertices.corner_count == 3 else 0
    primitive = np.repeat(np.arange(count), ROWS)
    place = np.tile(np.arange(ROWS), count)
    index = np.array([0, 1, 2, 0, 0, 1, 2])[place]
    left_alone = EDGE_KINDS.index("rounded" if numbers.corner_kind == "rounded" else "homogeneous")
    corner_kind = np.where(corners.is_projected[primitive, index], EDGE_KINDS.index("snapped"), left_alone)
    edge_kind = EDGE_KINDS.index("inverse-edge" if numbers.divides else "edge")
    area_kind = EDGE_KINDS.index("determinant" if numbers.divides else "orientation")
    kind = np.where(place < 3, corner_kind, np.where(place == 3, area_kind, edge_kind))
    following, last = (index + 1) % 3, (index + 2) % 3
    from_corner, to_corner = corners.is_projected[primitive, following], corners.is_projected[primitive, last]
    a, b, c = (of[primitive, index] for of in (edges.shown_a, edges.shown_b, edges.shown_c))
    seen, direction = np.stack([ends, ends]), np.full((len(kind), 2), np.nan)
    if numbers.suits_spans:
        is_constant = (a == 0) & (b == 0) & (c != 0)
        anchored = np.flatnonzero((place > 3) & (from_corner != to_corner))
        kind[anchored] = EDGE_KINDS.index("anchored-edge")
        kind[(place > 3) & from_corner & to_corner & is_constant] = EDGE_KINDS.index("left-out-edge")
        given = np.stack(given_directions(corners), axis=2)
        direction[anchored] = given[index[anchored], primitive[anchored]]
        # A determinant is that of the corners before snapping.
        seen[1] = corners.homogeneous
    is_matrix = (place == 3) & ~corners.is_projected[primitive].all(axis=1)
    start, finish = (seen[is_matrix.astype(np.int64), primitive, end] for end in (following, last))
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
        "direction": direction,
        "a": a,
        "b": b,
        "c": c,
        "owns_tie": edges.owns_tie[primitive, index],
        "start": start,
        "finish": finish,
    }
    if numbers.divides:
        columns["inverse"] = np.stack([edges.shown_a, edges.shown_b, edges.shown_c], axis=1)[primitive]
    rule = table.get("fill_rule", source.settings.fill_rule).listing
    assert rule is not None, f"{source.settings.fill_rule} has no listing"
    fill_rule = listing(rule)
    coefficients = (
        *(Operation(name, name, (name,)) for name in "abc"),
        Operation("tie", _tie_label(fill_rule), {"owns_tie": RETURN}),
    )
    steps = Steps(
        kinds=EDGE_KINDS,
        kind=kind,
        operations={
            "snapped": (
                Operation("window", "", (), ("window",)),
                Operation("snap", "snap", {"snapped": RETURN}),
            ),
            "homogeneous": (Operation("keep", "", (), ("homogeneous",)),),
            "orientation": (Operation("area", "", (), ("doubled_area",)),),
            "edge": coefficients,
            "anchored-edge": coefficients,
            "left-out-edge": (
                Operation("leave-out", "left-out", dict.fromkeys("abc", RETURN), ("owns_tie",)),
            ),
            "rounded": (Operation("round", "round", {"rounded": RETURN}),),
            "inverse-edge": (
                *(Operation(name, _inverse_label, {name: RETURN}) for name in "abc"),
                coefficients[3],
            ),
            "determinant": (Operation("area", "determinant", {"doubled_area": "determinant"}),),
        },
        triangle_ends=ends_of(geometry.primitives.triangle[primitive]),
        group_ends=ends_of(primitive, np.array([0, 0, 0, 1, 2, 2, 2])[place]),
    )
    cross_product = listing(edge_coefficients)
    return StageTrace(
        stage="edges",
        method=f"coverage={source.settings.coverage}",
        steps=steps,
        columns=columns,
        triangle=geometry.primitives.triangle[primitive],
        pixel=no_pixels(len(primitive)),
        listings={
            "snapped": listing(snap_one),
            "edge": cross_product,
            "anchored-edge": listing(anchored_coefficients),
            "left-out-edge": listing(edge_left_out),
            "rounded": listing(rounded_corner),
            "inverse-edge": listing(inverse_coefficients),
            "determinant": listing(inverse_coefficients),
            **{f"{kind}.tie": fill_rule for kind in ("edge", "anchored-edge", "inverse-edge")},
        },
        marks={"rejected": (place == 3) & (edges.doubled_area[primitive] == 0)},
        extra={"edges": edges, "planes": geometry.planes},
        constants={
            "fill_rule": source.settings.fill_rule,
            "number_format": numbers.name,
            "rounding": numbers.rounding,
        },
    )


# Trace of binning: the box of every triangle and the verdict on every block.


BIN_KINDS = ("box", "behind", "whole-image", "block", "outer-box")
VERDICTS = ("outside", "inside", "split", "leaf")


def _verdict_label(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line of `block_verdict` that returns."""
    return np.where(columns["verdict"][rows] == "outside", "outside", "verdict")


def bounding_box(
    x: np.ndarray, y: np.ndarray, center: float, bounds: tuple[int, int, int, int]
) -> tuple[int, int, int, int]:
    """Listing of the box: corners (3,) in pixels; bounds and result are column, row, end column, end row."""
    column, row = max(ceil(min(x) - center), bounds[0]), max(ceil(min(y) - center), bounds[1])  #: low
    right, top = floor(max(x) - center) + 1, floor(max(y) - center) + 1
    column_end, row_end = min(right, bounds[2]), min(top, bounds[3])  #: high
    return column, row, column_end, row_end


def outer_box(
    x: np.ndarray, y: np.ndarray, center: float, bounds: tuple[int, int, int, int]
) -> tuple[int, int, int, int]:
    """Listing of the box around corners (3,) that are not snapped: outward to whole pixels, then as every box."""
    left, bottom = floor(min(x)), floor(min(y))
    column, row = max(ceil(left - center), bounds[0]), max(ceil(bottom - center), bounds[1])  #: low
    right, top = floor(ceil(max(x)) - center) + 1, floor(ceil(max(y)) - center) + 1
    column_end, row_end = min(right, bounds[2]), min(top, bounds[3])  #: high
    return column, row, column_end, row_end


def trace_bin(source: TraceSource) -> StageTrace:
    """Return one row for the box of every primitive, followed by one for every block that is looked at."""
    geometry, boxes, blocks = source.geometry, source.boxes, source.runs.blocks
    corners = geometry.edges.corners
    count = len(geometry.edges) if geometry.vertices.corner_count == 3 else 0
    is_outer = geometry.edges.numbers.bounds_outward
    owner = np.arange(count)
    node = np.full(count, -1)
    if blocks is not None:
        owner = np.concatenate([owner, blocks.triangle])
        node = np.concatenate([node, np.arange(len(blocks.triangle))])
    order = np.argsort(owner, kind="stable")
    owner, node = owner[order], node[order]
    is_block = node >= 0

    def of_block(name: str, missing: float) -> np.ndarray:
        found = np.full(len(owner), missing)
        if blocks is not None:
            found[is_block] = getattr(blocks, name)[node[is_block]]
        return found

    def bounds(name: str) -> np.ndarray:
        return np.asarray(getattr(boxes, name)[owner])

    low, high = np.full((2, len(owner), 3), np.nan)
    if blocks is not None:
        low[is_block], high[is_block] = blocks.low[node[is_block]], blocks.high[node[is_block]]
    verdict = of_block("verdict", LEAF).astype(np.int64)
    size = of_block("size", 0).astype(np.int64)
    columns = {
        "column": np.where(is_block, of_block("column", 0).astype(np.int64), bounds("column")),
        "row": np.where(is_block, of_block("row", 0).astype(np.int64), bounds("row")),
        "column_end": np.where(is_block, of_block("column", 0).astype(np.int64) + size, bounds("column_end")),
        "row_end": np.where(is_block, of_block("row", 0).astype(np.int64) + size, bounds("row_end")),
        "size": size,
        "low": low,
        "high": high,
        "verdict": np.array(VERDICTS)[verdict],
        "rejected_by": of_block("rejected_by", -1).astype(np.int64),
        "corners": (corners.window if is_outer else corners.decided)[owner],
        "a": geometry.edges.shown_a[owner],
        "b": geometry.edges.shown_b[owner],
        "c": geometry.edges.shown_c[owner],
        "node": node,
    }
    box_kind = BIN_KINDS.index("outer-box" if is_outer else "box")
    kind = np.where(is_block, BIN_KINDS.index("block"), np.array([box_kind, 1, 2])[boxes.case[owner]])
    top = node.copy()
    if blocks is not None:
        parent = blocks.parent[node[is_block]]
        top[is_block] = np.where(parent >= 0, parent, node[is_block])
    steps = Steps(
        kinds=BIN_KINDS,
        kind=kind,
        operations={
            "box": (
                Operation("low", "low", ("column", "row"), ("corners",)),
                Operation("high", "high", ("column_end", "row_end")),
            ),
            "outer-box": (
                Operation("low", "low", ("column", "row"), ("corners",)),
                Operation("high", "high", ("column_end", "row_end")),
            ),
            "behind": (Operation("drop", ""),),
            "whole-image": (Operation("keep", "", (), ("column", "row", "column_end", "row_end")),),
            "block": (
                Operation("high", "high", ("high",), ("rejected_by",)),
                Operation("low", "low", ("low",)),
                Operation("verdict", _verdict_label, {"verdict": RETURN}),
            ),
        },
        triangle_ends=ends_of(geometry.primitives.triangle[owner]),
        group_ends=ends_of(owner, top),
    )
    box, block = listing(bounding_box), listing(block_verdict)
    return StageTrace(
        stage="bin",
        method=f"fill={source.fill}",
        steps=steps,
        columns=columns,
        triangle=geometry.primitives.triangle[owner],
        pixel=no_pixels(len(owner)),
        listings={"outer-box": listing(outer_box), "box": box, "block": block},
        marks={"rejected": is_block & (verdict == OUTSIDE), "covered": is_block & (verdict == INSIDE)},
        extra={"blocks": blocks, "boxes": boxes, "is_split": verdict == SPLIT},
        constants={
            "center": source.raster.center,
            "number_format": geometry.edges.numbers.name,
            "rounding": geometry.edges.numbers.rounding,
        },
    )
