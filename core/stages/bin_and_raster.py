"""Bin and raster joined: which pixels the triangles, outlines or polygons of a geometry cover, in batches."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from core.coverage.binning import bound
from core.coverage.edges import EdgeFunctions
from core.coverage.fills import Fragments, cover
from core.coverage.pixel_runs import Boxes, Raster, Runs, rows_of
from core.lines.wireframe import draw_outlines
from core.records.arrays import Integers
from core.records.frame import StageCount
from core.resolved import resolve
from core.settings import Settings
from core.stages.geometry import Geometry

CHUNK = 1 << 22
"""Pixels of bounding boxes that are scheduled in one go."""

Counts = dict[str, StageCount]


def schedule(
    edges: EdgeFunctions, settings: Settings, raster: Raster, boxes: Boxes | None = None
) -> tuple[Boxes, Runs]:
    """Bin triangles and list the runs of pixels that the fill looks at: none where only outlines are drawn."""
    resolved, boxes = resolve(settings), bound(edges, raster) if boxes is None else boxes
    if resolved.is_outlined:
        return boxes, rows_of(boxes, np.empty(0, np.int64))
    return boxes, resolved.fill(edges, boxes, raster, settings.block_size)


def covered(
    geometry: Geometry, raster: Raster, counts: Counts, chosen: Integers | None = None
) -> Iterator[Fragments]:
    """Bin and raster: yield the fragments of the ``chosen`` (C,) primitives, or all, in batches."""
    settings, resolved = geometry.settings, resolve(geometry.settings)
    counts["raster"].note = "" if resolved.fill_name == settings.fill else settings.fill
    with counts["bin"] as count:
        edges = geometry.edges if chosen is None else geometry.edges.take(chosen)
        count.incoming += len(edges.a)
        boxes = bound(edges, raster)
        area = (boxes.row_end - boxes.row) * (boxes.column_end - boxes.column)
        if resolved.looks_everywhere:
            area[:] = raster.shape[0] * raster.shape[1]
        ends = np.flatnonzero(np.diff(np.cumsum(area) // CHUNK, append=-1)) + 1
    for first, end in zip([0, *ends.tolist()][:-1], ends.tolist(), strict=True):
        with count:
            part, its_boxes = edges, boxes
            if len(ends) > 1:
                part, its_boxes = edges.take(slice(first, end)), Boxes(*(of[first:end] for of in boxes))
            _, runs = schedule(part, settings, raster, its_boxes)
            count.outgoing += int(runs.lengths.sum())
        batches = cover(part, runs, raster)
        while True:
            with counts["raster"] as count_raster:
                fragments, tested = next(batches, (None, 0))
            if fragments is None:
                break
            count_raster.incoming += tested
            count_raster.outgoing += len(fragments.primitive)
            if first:
                fragments = replace(fragments, primitive=fragments.primitive + first)
            yield (
                fragments
                if chosen is None
                else replace(fragments, primitive=chosen.take(fragments.primitive))
            )


def outlined(geometry: Geometry, raster: Raster, counts: Counts) -> Iterator[Fragments]:
    """Raster a wireframe: yield the pixels of the outlines of all primitives, which have no bins."""
    assert geometry.outlines is not None
    counts["bin"].incoming = len(geometry.edges)
    return _without_bins(draw_outlines(geometry.outlines, raster, geometry.settings.line), counts)


def filled(geometry: Geometry, raster: Raster, counts: Counts) -> Iterator[Fragments]:
    """Raster polygons from their edge tables: yield the pixels of all spans, which have no bins."""
    from core.coverage.active_edges import fill_rings

    assert geometry.polygons is not None
    counts["bin"].incoming = len(geometry.primitives)
    with counts["raster"]:
        runs = fill_rings(geometry.polygons, raster, resolve(geometry.settings).polygon_fill)
    return _without_bins(cover(geometry.edges, runs, raster), counts)


def _without_bins(batches: Iterator[tuple[Fragments, Any]], counts: Counts) -> Iterator[Fragments]:
    """Yield fragments in batches: all that come in go out."""
    while True:
        with counts["raster"] as count:
            fragments, _ = next(batches, (None, None))
        if fragments is None:
            return
        for of_stage in (counts["bin"], count):
            of_stage.outgoing += len(fragments)
        count.incoming += len(fragments)
        yield fragments


def fragments_of(geometry: Geometry, raster: Raster, counts: Counts) -> Iterator[Fragments]:
    """Bin and raster what the scene has: areas, outlines or polygons; yield the fragments in batches."""
    if geometry.vertices.rings is not None:
        return filled(geometry, raster, counts)
    return (covered if geometry.outlines is None else outlined)(geometry, raster, counts)
