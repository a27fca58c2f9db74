"""Trace of coverage: every pixel that the fill looks at, and the spans of the scanline fills."""

import numpy as np

from core.arrays import Integers
from core.fragments.interpolation import numerators
from core.listing import Listing, listing
from core.raster.edge_functions import covers
from core.raster.scanline import span
from core.raster.scanline_lecture import draw_triangle
from core.steps import Steps, ends_of
from core.trace.lines import trace_lines
from core.trace.raster_rows import FILL_OPERATIONS, overdraw_track
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def trace_raster(source: TraceSource) -> StageTrace:
    """Return one row for every pixel looked at; scanline fills have a row before the pixels of every span.

    Of a wireframe, one row for every pixel of its lines.
    """
    if source.geometry.outlines is not None:
        return trace_lines(source)
    geometry, runs, tests, raster = source.geometry, source.runs, source.tests, source.raster
    edges = geometry.edges

    # Spans stand before their pixels.
    has_spans = runs.crossings is not None
    headers = np.arange(len(runs)) if has_spans else np.empty(0, np.int64)
    run = np.concatenate([headers, tests.run])
    test = np.concatenate([np.full(len(headers), -1), np.arange(len(tests.run))])
    order = np.argsort(run, kind="stable")
    run, test = run[order], test[order]
    is_pixel = test >= 0

    def of_pixel(values: np.ndarray, missing: float | bool) -> np.ndarray:
        found = np.full((len(run), *values.shape[1:]), missing, values.dtype)
        found[is_pixel] = values[test[is_pixel]]
        return found

    primitive = runs.triangle[run]
    column, row = of_pixel(tests.column, -1), runs.row[run]
    x, y = raster.centers(column, row)
    values = of_pixel(tests.values, np.nan)
    covered, tie = of_pixel(tests.covered, False), of_pixel(tests.tie, False)
    accepted = of_pixel(tests.accepted, False)
    with np.errstate(divide="ignore", invalid="ignore"):
        weights = np.stack(numerators(geometry.planes, primitive, x, y), axis=1)
        weights = weights / (weights[:, :1] + weights[:, 1:2] + weights[:, 2:])
        distance = values / np.hypot(edges.a[primitive], edges.b[primitive])
    weights[~is_pixel] = np.nan
    crossings = runs.crossings[run] if runs.crossings is not None else np.full((len(run), 3), np.nan)
    columns = {
        "column": column,
        "row": row,
        "x": np.where(is_pixel, x, np.nan),
        "y": y,
        "a": edges.a[primitive],
        "b": edges.b[primitive],
        "c": edges.c[primitive],
        "owns_tie": edges.owns_tie[primitive],
        "values": values,
        "distance": distance,
        "weights": weights,
        "covered": covered,
        "tie": tie,
        "start": runs.start[run],
        "stop": runs.stop[run],
        "primitive": primitive,
    }
    for k in range(3):
        columns[f"value_{k}"], columns[f"crossing_{k}"] = values[:, k], crossings[:, k]
    is_lecture = source.settings.fill == "scanline-lecture"
    kind = np.where(is_pixel, np.where(accepted, 1, 0), 3 if is_lecture else 2)
    triangle = geometry.primitives.triangle[primitive]
    steps = Steps(
        kinds=tuple(FILL_OPERATIONS),
        kind=kind,
        operations=FILL_OPERATIONS,
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(primitive, runs.group[run] if not has_spans else run),
    )
    is_tie = tie.any(axis=1) & ~(values < 0).any(axis=1)
    return StageTrace(
        stage="raster",
        method=f"fill={source.settings.fill}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([column, np.where(is_pixel, row, -1)], axis=1),
        listings=_listings(),
        marks={
            "covered": covered,
            "rejected": is_pixel & ~covered,
            "tie": is_pixel & is_tie,
            "nan": is_pixel & np.isnan(values).any(axis=1),
        },
        buffers=_buffers(source, np.flatnonzero(is_pixel), columns),
        extra={"runs": runs, "boxes": source.boxes, "blocks": runs.blocks, "edges": edges},
        constants={"center": raster.center, "fill_rule": source.settings.fill_rule},
    )


def _listings() -> dict[str, Listing]:
    inside = listing(covers)
    return {"test": inside, "accept": inside, "span": listing(span), "line": listing(draw_triangle)}


def _buffers(source: TraceSource, rows: Integers, columns: dict[str, np.ndarray]) -> tuple[BufferTrack, ...]:
    """Return coverage, the three edge functions, the three weights, and how often each pixel was covered."""
    shape = source.raster.shape
    place = source.raster.index(columns["column"][rows], columns["row"][rows])
    unknown = np.full(shape, np.nan)
    covered = columns["covered"][rows]

    # A pixel that one triangle covers stays covered when the next one misses it.
    first = np.full(shape[0] * shape[1], len(rows))
    np.minimum.at(first, place[covered], np.flatnonzero(covered))
    by_now = np.arange(len(rows)) >= first[place]
    tracks = [BufferTrack("coverage", unknown, rows, place, by_now.astype(float), "flags")]
    for name, column in (("edge", "values"), ("weight", "weights")):
        tracks += [
            BufferTrack(f"{name} {k}", unknown, rows, place, columns[column][rows, k], "signed")
            for k in range(3)
        ]
    tracks.append(overdraw_track(source, rows[covered]))
    return tuple(tracks)
