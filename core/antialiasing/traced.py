"""Trace of resolving: from the samples of a pixel to one colour, and from linear colour to display bytes."""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.exact_area import DrawnLayer, piece_painter, piece_sum
from core.antialiasing.fxaa import around_edges
from core.antialiasing.resolve import AROUND, filter_weights, grown, inner_of, reach_of, weighted_mean
from core.antialiasing.traced_areas import PixelCuts, cuts_of, with_cuts
from core.antialiasing.traced_fxaa import trace_filter
from core.antialiasing.traced_temporal import trace_temporal
from core.framebuffer.display import SRGB_LIMIT, encode_linear, encode_srgb, srgb, srgb_byte
from core.framebuffer.traced import trace_blend
from core.framebuffer.traced_presentation import with_presentation
from core.pipeline import draw
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.frame import StageCount
from core.records.listing import RETURN, Columns, Listing, Operation, listing
from core.records.steps import Steps, ends_of
from core.resolved import resolve
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.vertices import Before, process_geometry
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def _curve_label(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line of `srgb_byte` for the part of the curve that the strongest channel is on."""
    strongest = np.fmax.reduce(columns["clipped"][rows][:, :3], axis=1)
    return np.where(strongest <= SRGB_LIMIT, "straight-part", "power-part")


ENCODE = (
    Operation("clip", "clip", ("clipped",), ("linear",)),
    Operation("encode", _curve_label, ("encoded",)),
    Operation("round", "round", {"bytes": RETURN}),
)
OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "encode": ENCODE,
    "average": (
        Operation("samples", "samples", (), ("samples", "sample_weights")),
        Operation("divide", "divide", {"linear": RETURN}),
        *ENCODE,
    ),
    "areas": (
        Operation("samples", "samples", (), ("samples", "sample_weights")),
        Operation("divide", "store", {"linear": RETURN}),
        *ENCODE,
    ),
}
"""Kind of row to what it does: one sample a pixel, several, and pieces."""


class Parts(NamedTuple):
    """What the colours of pixels are made of, M parts each."""

    samples: Singles
    """(R, M, 4) float32, their colours."""
    weights: Floats
    """(R, M) float64, what they weigh; 0: there is no such part."""
    triangle: Integers
    """(R, M) int64, the triangle that each shows, -1: none."""


def trace_resolve(source: TraceSource) -> StageTrace:
    """Return one row for every pixel of the raster, to sRGB bytes, and the rows of the presentation of the picture."""
    return with_presentation(_trace_pixels(source), source)


def _trace_pixels(source: TraceSource) -> StageTrace:
    """Return one row for every pixel of the raster: its samples to a colour, linear colour to sRGB bytes."""
    parts, cuts, kind, method = None, None, "encode", ""
    if resolve(source.settings).sampling.is_filtered:
        wide = around_edges(source.raster)
        plain = replace(source.settings, antialiasing=Settings.antialiasing)
        color = draw(source.scene, plain, wide, last_drawn(source)).color
        return trace_filter(source, color, inner_of(wide, source.raster), ENCODE)
    if resolve(source.settings).sampling.is_temporal:
        return trace_temporal(source, last_drawn(source), ENCODE)
    if resolve(source.settings).sampling.is_plain:
        blend = trace_blend(source)
        linear = blend.buffers[0].at(blend.steps.row_count).reshape(-1, 4)
    elif resolve(source.settings).sampling.is_area:
        parts, cuts = _pieces(source)
        kind, method = "areas", f"antialiasing={source.settings.antialiasing}"
        linear = _piece_sums(parts)
    else:
        parts, kind = _samples(source), "average"
        method = f"resolve_filter={source.settings.resolve_filter}"
        linear = _means(parts)
    found = _rows(source, linear, parts, kind, method)
    return found if cuts is None else with_cuts(found, cuts)


def _rows(source: TraceSource, linear: Singles, parts: Parts | None, kind: str, method: str) -> StageTrace:
    count = len(linear)
    column, row = source.raster.position(np.arange(count))
    with np.errstate(invalid="ignore"):
        clipped = np.clip(np.nan_to_num(linear[:, :3].astype(float)), 0.0, 1.0)
    pixels = np.column_stack([encode_srgb(linear[:, :3]), encode_linear(linear[:, 3])])
    columns = {
        "column": column,
        "row": row,
        "linear": linear,
        "clipped": clipped,
        "encoded": srgb(clipped),
        "bytes": pixels,
    }
    every, place = np.arange(count), np.arange(count)
    buffers = [
        BufferTrack("display", np.zeros((*source.raster.shape, 4), np.uint8), every, place, pixels, "bytes")
    ]
    if parts is not None:
        columns |= {
            "samples": parts.samples,
            "sample_weights": parts.weights,
            "sample_triangle": parts.triangle,
        }
        unknown = np.full((*source.raster.shape, 4), np.nan, np.float32)
        buffers.append(BufferTrack("color", unknown, every, place, linear, "color"))
        seen = np.where(parts.weights > 0, parts.triangle >= 0, False)
        share = (seen * parts.weights).sum(axis=1) / parts.weights.sum(axis=1)
        nothing = np.full(source.raster.shape, np.nan)
        buffers.append(BufferTrack("covered part", nothing, every, place, share))
    return StageTrace(
        stage="resolve",
        method=method,
        steps=Steps(
            (kind,), np.zeros(count, np.int64), {kind: OPERATIONS[kind]}, np.array([count]), ends_of(row)
        ),
        columns=columns,
        triangle=np.full(count, -1),
        pixel=np.stack([column, row], axis=1),
        listings=_listings(kind),
        marks={"nan": np.any(np.isnan(linear), axis=1)},
        buffers=tuple(buffers),
    )


def _listings(kind: str) -> dict[str, Listing]:
    found = {kind: listing(srgb_byte)}
    rule = {"average": weighted_mean, "areas": piece_sum}.get(kind)
    if rule is not None:
        found |= {f"{kind}.samples": listing(rule), f"{kind}.divide": listing(rule)}
    return found


def last_drawn(source: TraceSource) -> Before | None:
    """Return what the buffers show after the last row; ``None``: all triangles."""
    if source.triangle is None:
        return None
    first = 0
    if source.before == "earlier":
        first = int(np.flatnonzero(source.order == source.triangle)[0])
    return Before(first, source.triangle)


def _samples(source: TraceSource) -> Parts:
    """Return the samples that every pixel is made of, in the order of the sum; those beyond the border weigh 0."""
    settings = source.settings
    weights = filter_weights(resolve(settings).sampling.position, settings.resolve_filter)
    wide = grown(source.raster, reach_of(weights))
    samples = draw(source.scene, settings, wide, last_drawn(source)).samples
    assert samples is not None
    rows, columns = inner_of(wide, source.raster)
    row, column = (part.ravel() for part in np.mgrid[rows, columns])
    height, width = wide.shape
    colors, shares, triangles = [], [], []
    for j, below in enumerate(AROUND):
        for i, left in enumerate(AROUND):
            exists: Flags = (
                (row + below >= 0) & (row + below < height) & (column + left >= 0) & (column + left < width)
            )
            at = np.where(exists, row + below, 0), np.where(exists, column + left, 0)
            for sample in np.flatnonzero(weights[j, i]):
                colors.append(np.where(exists[:, None], samples.color[sample][at], np.float32(0)))
                shares.append(np.where(exists, weights[j, i, sample], 0.0))
                triangles.append(np.where(exists, samples.primitive[sample][at], -1))
    return Parts(
        np.stack(colors, axis=1), np.stack(shares, axis=1), np.stack(triangles, axis=1).astype(np.int64)
    )


def _pieces(source: TraceSource) -> tuple[Parts, PixelCuts | None]:
    """Return the pieces that every pixel is made of, and how they were cut; outlines and polygons are not cut.

    They stand in the order of the sum; missing ones weigh 0.
    """
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(source.scene, source.settings, counts, last_drawn(source))
    count = source.raster.shape[0] * source.raster.shape[1]
    if not geometry.is_cut_to_pixels:
        frame = draw(source.scene, source.settings, source.raster, last_drawn(source))
        whole = np.ones((count, 1))
        shown = frame.primitive.reshape(-1, 1).astype(np.int64)
        return Parts(frame.color.reshape(-1, 1, 4), whole, shown), None
    painter = piece_painter(source.scene, geometry, source.raster, counts)
    layers: list[DrawnLayer] = []
    pieces = painter.draw(layers.append)
    order = np.argsort(pieces.pixel, kind="stable")
    pixel = pieces.pixel[order]
    place = np.arange(len(pixel)) - np.searchsorted(pixel, pixel)
    most = int(place.max(initial=0)) + 1
    samples, weights = np.zeros((count, most, 4), np.float32), np.zeros((count, most))
    triangle = np.full((count, most), -1)
    is_untouched = np.ones(count, bool)
    is_untouched[pieces.touched] = False
    untouched = np.flatnonzero(is_untouched)
    samples[untouched, 0], weights[untouched, 0] = source.scene.background, 1.0
    at = pixel, place
    samples[at], weights[at] = pieces.color[order], pieces.area[order]
    shown = pieces.primitive[order]
    triangle[at] = (
        np.where(shown >= 0, geometry.primitives.triangle[np.maximum(shown, 0)], -1) if len(shown) else -1
    )
    cuts = cuts_of(painter, layers, geometry.primitives.triangle, source.triangle)
    return Parts(samples, weights, triangle), cuts


def _means(parts: Parts) -> Singles:
    """Return the weighted means (R, 4) float32, sample by sample as the picture adds them up."""
    sums, total = np.zeros((len(parts.samples), 4)), np.zeros((len(parts.samples), 1))
    with np.errstate(invalid="ignore", over="ignore"):
        for color, weight in zip(np.moveaxis(parts.samples, 1, 0), parts.weights.T, strict=True):
            sums += weight[:, None] * color.astype(np.float64)
            total += weight[:, None]
        return np.asarray((sums / total).astype(np.float32))


def _piece_sums(parts: Parts) -> Singles:
    """Return the sums (R, 4) float32 of areas times colours, piece by piece."""
    sums = np.zeros((len(parts.samples), 4))
    with np.errstate(invalid="ignore", over="ignore"):
        for color, area in zip(np.moveaxis(parts.samples, 1, 0), parts.weights.T, strict=True):
            sums += area[:, None] * color.astype(np.float64)
        return sums.astype(np.float32)
