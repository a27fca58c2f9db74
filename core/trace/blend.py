"""Trace of blending."""

import numpy as np

from core.framebuffer.blending import over_pixel
from core.framebuffer.stacks import stack_fragments
from core.listing import listing
from core.methods import table
from core.steps import Operation, Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def trace_blend(source: TraceSource) -> StageTrace:
    """Return one row for every fragment that passed the depth test."""
    passes = source.depth_tests.passes
    fragments = source.fragments.select(passes)
    place, triangle = source.place[passes], source.triangle_of_fragment[passes]
    colors = source.surface.color[passes]
    mode = source.settings.blend
    rule = table.get("blend", mode).function

    # The colours before and after, one layer after another.
    before, after = np.empty((2, len(colors), 4), np.float32)
    stacks = stack_fragments(place)
    there = source.start.color.reshape(-1, 4).take(stacks.pixel, axis=0)
    for count, fragment in stacks.layers():
        before[fragment] = there[:count]
        after[fragment] = there[:count] = rule(colors.take(fragment, axis=0), there[:count])
    kind = np.zeros(len(fragments), np.int64)
    operations = {
        "opaque": (Operation("write", "store", ("source", "before", "after")),),
        "over": (
            Operation("source", "color", ("source", "before")),
            Operation("color", "color", ("after",)),
            Operation("write", "store", ("after",)),
        ),
    }
    return StageTrace(
        stage="blend",
        method=f"blend={mode}",
        steps=Steps(
            (mode,), kind, operations, ends_of(triangle), ends_of(fragments.primitive, fragments.row)
        ),
        columns={
            "column": fragments.column,
            "row": fragments.row,
            "source": colors,
            "before": before,
            "after": after,
            "primitive": fragments.primitive,
        },
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings={"over": listing(over_pixel)},
        marks={"covered": np.ones(len(fragments), bool), "nan": np.any(np.isnan(after), axis=1)},
        buffers=(
            BufferTrack("color", source.start.color, np.arange(len(fragments)), place, after, "color", True),
        ),
    )
