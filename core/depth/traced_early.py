"""Shading with the early depth test: a fragment that is hidden already has a row that says so, and is not shaded."""

from dataclasses import replace

import numpy as np

from core.depth.early_depth import LEFT, shade_if_left, shade_if_passed
from core.records.listing import Operation, listing
from core.records.steps import Steps
from core.stages.hidden_surfaces import shades
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

SKIPPED = "skipped"
SKIPPED_OPERATIONS = (Operation("skip", "test", (), ("stored", "before")),)
"""What the row of a fragment does that is not shaded."""


def without_hidden(source: TraceSource, found: StageTrace) -> StageTrace:
    """Return the rows of shading with one operation alone for each fragment that is not shaded.

    They write no buffer. The buffer ``times shaded`` counts those that are shaded.
    """
    shaded = source.shaded
    rows, place = np.flatnonzero(shaded), source.place
    order = np.argsort(place[rows], kind="stable")
    times = np.empty(len(rows), np.int64)
    times[order] = 1 + np.arange(len(rows)) - np.searchsorted(place[rows][order], place[rows][order])
    empty = np.zeros(source.raster.shape, np.int64)
    counted = BufferTrack("times shaded", empty, rows, place[rows], times, "count", True)
    if shaded.all():
        return replace(found, buffers=(*found.buffers, counted))
    _, keeps, stored = source.depths
    # An edited test, and one for every sample, compare something else than these two.
    has_own_test = source.is_tested_alone and source.depth_format.test_listing is None
    is_compared = ~shaded & keeps & has_own_test
    before, is_prepass = source.depth_tests.before, shades(source.scene, source.geometry) == LEFT
    if is_prepass:
        # That of a sample is not looked up: its sentence does without.
        left = source.picture.depth.reshape(-1).take(place) if type(source) is TraceSource else np.nan
        before = np.where(source.geometry.drawing.decides is None, left, np.nan)
    columns = {
        "stored": np.where(is_compared, stored, np.nan),
        "before": np.where(is_compared, before, np.nan),
        "is_in_range": keeps,
    }
    steps = Steps(
        (*found.steps.kinds, SKIPPED),
        np.where(shaded, found.steps.kind, len(found.steps.kinds)),
        {**found.steps.operations, SKIPPED: SKIPPED_OPERATIONS},
        found.steps.triangle_ends,
        found.steps.group_ends,
    )
    return replace(
        found,
        steps=steps,
        columns={**found.columns, **columns},
        listings={**found.listings, SKIPPED: listing(shade_if_left if is_prepass else shade_if_passed)},
        marks={**{name: flags & shaded for name, flags in found.marks.items()}, "depth-failed": ~shaded},
        buffers=(*(_of_shaded(track, shaded) for track in found.buffers), counted),
        constants={
            **found.constants,
            "is_prepass": is_prepass,
            "casts_rays": source.geometry.drawing.decides is not None,
            "larger_is_nearer": source.depth_format.larger_is_nearer,
        },
    )


def _of_shaded(track: BufferTrack, shaded: np.ndarray) -> BufferTrack:
    """Return the writes of shaded rows."""
    writes = shaded[track.rows]
    return replace(track, rows=track.rows[writes], places=track.places[writes], values=track.values[writes])
