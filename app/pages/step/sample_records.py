"""Which triangle has which sample of a pixel after a step, as the pixel grid shows it."""

import numpy as np

from core import Trace
from core.records.arrays import Integers
from core.resolved import resolve
from core.trace import StageTrace
from widgets.grid.sample_dots import SampleDots

COVERED = ("interpolate", "shade")
"""Stages behind the raster that do not know yet what is hidden: every sample has the last triangle that covers it."""
SEEN = ("blend", "resolve")
"""Stages behind the depth test."""


def sample_dots(trace: Trace, stage: StageTrace, position: int, is_hidden: bool) -> SampleDots | None:
    """Return the samples after a step; ``None``: a pixel has one.

    Parameters
    ----------
    is_hidden : bool
        Whether the result is to be predicted: then no sample tells it.
    """
    source = trace.source
    count = resolve(source.settings).sampling.count
    if count == 1:
        return None
    done = stage.steps.rows_done(position)
    shown: Integers = np.full((count, *source.raster.shape), -1)
    if stage.stage == "raster":
        _mark_covered(shown, trace, stage, done)
    elif stage.stage in COVERED:
        raster = trace.stage("raster")
        _mark_covered(shown, trace, raster, raster.steps.row_count)
    elif stage.stage == "depth":
        tracks = {track.name: track for track in stage.buffers}
        for sample in range(count):
            shown[sample] = tracks[f"primitive {sample}" if sample else "primitive"].at(done)
    elif stage.stage in SEEN and not is_hidden:
        samples = source.picture.samples
        assert samples is not None
        shown[:] = samples.primitive
    return SampleDots(resolve(source.settings).sampling.position, shown)


def _mark_covered(shown: Integers, trace: Trace, raster: StageTrace, done: int) -> None:
    """Give samples (S, H, W) to the triangles that ``done`` rows have found to cover them, the last one of each."""
    covered = np.flatnonzero(raster.marks["covered"][:done] & (raster.pixel[:done, 0] >= 0))
    place = trace.source.raster.index(*raster.pixel[covered].T)
    of_sample = shown.reshape(len(shown), -1)
    of_sample[raster.columns["sample"][covered], place] = raster.triangle[covered]
