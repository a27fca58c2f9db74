"""Trace of binning: the box of every triangle and the verdict on every block."""

from math import ceil, floor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.raster.binning import block_verdict
from core.raster.pixel_runs import INSIDE, LEAF, OUTSIDE, SPLIT
from core.records.listing import RETURN, listing
from core.records.operation import Columns, Operation
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

KINDS = ("box", "behind", "whole-image", "block", "outer-box")
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
    box_kind = KINDS.index("outer-box" if is_outer else "box")
    kind = np.where(is_block, KINDS.index("block"), np.array([box_kind, 1, 2])[boxes.case[owner]])
    top = node.copy()
    if blocks is not None:
        parent = blocks.parent[node[is_block]]
        top[is_block] = np.where(parent >= 0, parent, node[is_block])
    steps = Steps(
        kinds=KINDS,
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
        listings={
            "outer-box": listing(outer_box),
            "box": box,
            "block": block,
        },
        marks={"rejected": is_block & (verdict == OUTSIDE), "covered": is_block & (verdict == INSIDE)},
        extra={"blocks": blocks, "boxes": boxes, "is_split": verdict == SPLIT},
        constants={
            "center": source.raster.center,
            "number_format": geometry.edges.numbers.name,
            "rounding": geometry.edges.numbers.rounding,
        },
    )
