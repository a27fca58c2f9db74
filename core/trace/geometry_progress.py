"""Which geometry there is after a step: the spaces that corners have reached, and the triangles that are dropped."""

import numpy as np

from core.geometry.culling import KEPT
from core.records.arrays import Flags, Integers
from core.stages.declared import STAGES
from core.trace import Trace
from core.trace.stage_trace import StageTrace

SPACES = ("object", "world", "camera", "clip", "NDC", "window")
"""Spaces of a corner, in the order in which it goes through them."""
CLIP, WINDOW = SPACES.index("clip"), SPACES.index("window")


def spaces_reached(trace: Trace, stage: str, position: int) -> Integers:
    """Return (T, k) int64, the space of `SPACES` that each of the k corners of a primitive is in after a step.

    A scene given in clip space starts there. A row counts when its last operation is done.
    """
    shape = len(trace.source.geometry.assembled), trace.source.scene.corner_count
    if stage != STAGES[0]:
        return np.full(shape, WINDOW)
    traced = trace.stage(stage)
    done = traced.steps.rows_done(position)
    if "statement" in traced.steps.kinds:
        return _behind_shader(traced, done, shape)
    first = 0 if trace.source.geometry.vertices.object is not None else CLIP
    rows = WINDOW - first
    reached: Integers = first + np.clip(done - rows * np.arange(shape[0] * shape[1]), 0, rows)
    return reached.reshape(shape)


def _behind_shader(traced: StageTrace, done: int, shape: tuple[int, int]) -> Integers:
    """Return the spaces (T, k) of corners that a vertex shader takes to clip space, after ``done`` rows."""
    runs = traced.steps.kind == traced.steps.kinds.index("statement")
    corner, count = traced.extra["corners"], shape[0] * shape[1]
    left = np.bincount(corner[done:][runs[done:]], minlength=count)
    divided = np.bincount(corner[:done][~runs[:done]], minlength=count)
    return np.where(left == 0, CLIP + divided, 0).reshape(shape)


def is_dropped(trace: Trace, stage: str, position: int) -> Flags:
    """Return (T,) bool, whether culling has dropped each assembled triangle by now."""
    geometry = trace.source.geometry
    if STAGES.index(stage) < STAGES.index("cull"):
        return np.zeros(len(geometry.assembled), bool)
    dropped: Flags = geometry.culled.verdict != KEPT
    if stage == "cull":
        steps = trace.stage(stage).steps
        # A triangle has its verdict when its last row is done; the first end is 0 where there are no rows.
        done = int(np.searchsorted(steps.triangle_ends, steps.rows_done(position), "right"))
        dropped = dropped & (np.arange(len(dropped)) < done)
    return dropped
