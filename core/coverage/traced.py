"""Trace of coverage: every pixel that the fill looks at, and the spans of the fills that have them."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from core.coverage.binning import pixels_of_block
from core.coverage.fills import step_covers
from core.coverage.pixel_runs import Runs, fill_traits
from core.coverage.scanline import draw_bottom, draw_top, drawn_columns, span
from core.coverage.traced_polygons import trace_polygon_fill
from core.coverage.traced_rows import (
    FILL_OPERATIONS,
    PRINTED,
    RowTable,
    overdraw_track,
    printed_columns,
    right_spans,
    rows_of_runs,
)
from core.interpolation.interpolation import numerators
from core.lines.traced import trace_lines
from core.records.arrays import Flags
from core.records.listing import Listing, TypedText, listing
from core.records.steps import Steps, ends_of
from core.spans.lanes import tie_owners
from core.spans.traced import (
    SpanOrder,
    order_of_spans,
    pass_track,
    rows_of_spans,
    span_columns,
    span_constants,
    span_listings,
)
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def trace_raster(source: TraceSource) -> StageTrace:
    """Return one row for every pixel looked at; fills by spans have a row before the pixels of every span.

    The fill ``spans`` has one before every triangle too, for its lane. Of a wireframe, one row for every pixel of its
    lines; of polygons, the rows of their edge tables.
    """
    if source.geometry.outlines is not None:
        return trace_lines(source)
    if source.geometry.polygons is not None:
        return trace_polygon_fill(source)
    geometry, raster, fill = source.geometry, source.raster, source.fill
    constants: dict[str, float | int | str] = {
        "center": raster.center,
        "fill_rule": source.settings.fill_rule,
        "number_format": geometry.edges.numbers.name,
        "rounding": geometry.edges.numbers.rounding,
        "value_layout": geometry.edges.numbers.value_layout,
    }
    order = _order(source) if fill_traits(fill).has_lanes else None
    table = rows_of_runs(source) if order is None else rows_of_spans(source, order)
    columns, is_pixel = _columns(source, table), table.test >= 0
    buffers = _buffers(source, columns)
    if order is not None:
        columns |= span_columns(source, table, order)
        constants |= span_constants(source, order)
        buffers = (buffers[0], pass_track(source, columns), *buffers[1:])
    triangle = geometry.primitives.triangle[table.primitive]
    steps = Steps(
        kinds=tuple(FILL_OPERATIONS),
        kind=table.kind,
        operations=FILL_OPERATIONS,
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(table.primitive, table.group),
    )
    return StageTrace(
        stage="raster",
        method=f"fill={fill}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([columns["column"], np.where(is_pixel, table.row, -1)], axis=1),
        listings=_listings(source.runs, fill_traits(fill).test_listing),
        marks=_marks(columns, is_pixel),
        buffers=buffers,
        extra={
            "runs": source.runs,
            "boxes": source.boxes,
            "blocks": source.runs.blocks,
            "edges": geometry.edges,
            "span_order": order,
        },
        constants=constants,
    )


def _order(source: TraceSource) -> SpanOrder:
    owners = tie_owners(source.settings.fill_rule)
    return order_of_spans(source.geometry.edges, source.raster, owners)


def _columns(source: TraceSource, table: RowTable) -> dict[str, np.ndarray]:
    """Return the numbers that all fills have; -1, NaN or False where a row is about no pixel."""
    geometry, raster, tests = source.geometry, source.raster, source.tests
    edges, primitive, is_pixel = geometry.edges, table.primitive, table.test >= 0

    def of_pixel(values: np.ndarray, missing: float | bool) -> np.ndarray:
        if is_pixel.all():
            return values.take(table.test, axis=0)
        found = np.full((len(primitive), *values.shape[1:]), missing, values.dtype)
        found[is_pixel] = values[table.test[is_pixel]]
        return found

    def of_triangle(values: np.ndarray) -> np.ndarray:
        return values.take(primitive, axis=0)

    column = of_pixel(tests.column, -1)
    x, y = raster.centers(column, table.row)
    values = of_pixel(tests.values, np.nan)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        weights = np.stack(numerators(geometry.planes, primitive, x, y), axis=1)
        weights /= weights[:, :1] + weights[:, 1:2] + weights[:, 2:]
        distance = values / of_triangle(np.hypot(edges.shown_a, edges.shown_b))
    weights[~is_pixel] = np.nan
    columns = {
        "column": column,
        "row": table.row,
        "x": np.where(is_pixel, x, np.nan),
        "y": np.where(table.row >= 0, y, np.nan),
        "a": of_triangle(edges.shown_a),
        "b": of_triangle(edges.shown_b),
        "c": of_triangle(edges.shown_c),
        "owns_tie": of_triangle(edges.owns_tie),
        "values": values,
        "distance": distance,
        "weights": weights,
        "covered": of_pixel(tests.covered, False),
        "tie": of_pixel(tests.tie, False),
        "start": table.start,
        "stop": table.stop,
        "primitive": primitive,
    }
    if source.runs.stepping is not None:
        before = of_pixel(tests.before, np.nan)
        columns |= {f"before_{k}": before[:, k] for k in range(3)}
    if source.runs.walk is not None:
        columns |= printed_columns(source.runs.walk, table) | right_spans(source, table)
    columns |= {f"crossing_{k}": table.crossings[:, k] for k in range(3)}
    # The value of each edge is set by a step of its own.
    return columns | {f"value_{k}": values[:, k] for k in range(3)}


def _marks(columns: dict[str, np.ndarray], is_pixel: Flags) -> dict[str, Flags]:
    values, covered = columns["values"], columns["covered"]
    return {
        "covered": covered,
        "rejected": is_pixel & ~covered,
        "tie": is_pixel & any_edge(columns["tie"]) & ~any_edge(values < 0),
        "nan": is_pixel & any_edge(np.isnan(values)),
    }


def any_edge(flags: Flags) -> Flags:
    """Return (R,) bool, whether any of the three flags (R, 3) is set: twenty times as fast as asking along the axis."""
    found: Flags = flags[:, 0] | flags[:, 1] | flags[:, 2]
    return found


def _listings(runs: Runs, test: Callable[..., Any] | TypedText) -> dict[str, Listing]:
    stepping, of_row, printed = listing(step_covers), listing(span), listing(drawn_columns)
    accepted = listing(pixels_of_block) if runs.blocks is not None else of_row
    sides = {"top": listing(draw_top), "bottom": listing(draw_bottom)}
    return {
        "climb": stepping,
        "step": stepping,
        "test": listing(test),
        "accept": accepted if runs.walk is None else printed,
        "span": of_row,
        **{kind: sides[kind.removesuffix("-first")] for kind in PRINTED},
        **{f"{kind}.round": printed for kind in PRINTED},
        **span_listings(),
    }


def _buffers(source: TraceSource, columns: Mapping[str, np.ndarray]) -> tuple[BufferTrack, ...]:
    """Return coverage, the three edge functions, the three weights, and how often each pixel was covered."""
    shape = source.raster.shape
    rows = np.flatnonzero(columns["column"] >= 0)
    at = slice(None) if len(rows) == len(columns["column"]) else rows
    place = source.raster.index(columns["column"][at], columns["row"][at])
    unknown = np.full(shape, np.nan)
    covered = columns["covered"][at]

    # A pixel that one triangle covers stays covered when the next one misses it.
    first = np.full(shape[0] * shape[1], len(rows))
    np.minimum.at(first, place[covered], np.flatnonzero(covered))
    by_now = np.arange(len(rows)) >= first[place]
    tracks = [BufferTrack("coverage", unknown, rows, place, by_now.astype(float), "flags")]
    for name, column in (("edge", "values"), ("weight", "weights")):
        tracks += [
            BufferTrack(f"{name} {k}", unknown, rows, place, columns[column][at, k], "signed")
            for k in range(3)
        ]
    tracks.append(overdraw_track(source, rows[covered]))
    return tuple(tracks)
