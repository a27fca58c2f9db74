"""Trace of blending."""

import numpy as np

from core.depth.depth import stack_fragments
from core.framebuffer.traced_from_front import trace_from_front
from core.lines.wireframe_fragments import intensities_of, weigh_alpha, weighed_color
from core.records.arrays import Floats
from core.records.listing import Operation, listing
from core.records.steps import PIXEL_BY_PIXEL, ROW_BY_ROW, Steps, ends_of
from core.resolved import resolve
from core.stages.hidden_surfaces import resolves_from_front
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def trace_blend(source: TraceSource) -> StageTrace:
    """Return one row for every fragment that passed the depth test, in the order of drawing."""
    if resolves_from_front(source.geometry):
        return trace_from_front(source)
    chosen = source.drawn
    fragments = source.fragments.take(chosen)
    place, triangle = source.place[chosen], source.triangle_of_fragment[chosen]
    shaded = source.surface.color[chosen]
    colors, intensity = weigh_alpha(shaded, fragments), intensities_of(fragments)
    method = resolve(source.settings).blend_method
    mode, rule = method.name, method.function
    # The colours before and after, one layer after another.
    before, after = np.empty((2, len(colors), 4), np.float32)
    stacks = stack_fragments(place)
    there = source.start.color.reshape(-1, 4).take(stacks.pixel, axis=0)
    for count, fragment in stacks.layers():
        before[fragment] = there[:count]
        after[fragment] = there[:count] = rule(colors.take(fragment, axis=0), there[:count])
    kind = np.zeros(len(fragments), np.int64)
    name, weighed, operations = mode, dict[str, Floats](), dict(method.operations)
    listings = {} if method.listing is None else {mode: listing(method.listing)}
    if intensity is not None:
        # The fragment of a line is weighed before it is blended.
        name, weighed = f"line-{mode}", {"color": shaded, "intensity": intensity}
        operations[name] = (
            Operation("weigh", "weigh", {"source": "alpha"}, ("color", "intensity")),
            *operations[mode],
        )
        listings = {name: listings[mode], f"{name}.weigh": listing(weighed_color)}
    by_rows = source.exact_tests is not None and source.exact_tests.turn is not None
    ends = ends_of(triangle), ends_of(fragments.primitive, fragments.row)
    order = PIXEL_BY_PIXEL if source.geometry.drawing.resolves_lists else ROW_BY_ROW
    if by_rows:
        within = fragments.column if order.is_by_pixel else triangle
        ends = ends_of(fragments.row), ends_of(fragments.row, within)
    return StageTrace(
        stage="blend",
        method=f"blend={mode}",
        steps=Steps((name,), kind, operations, *ends),
        columns={
            "column": fragments.column,
            "row": fragments.row,
            "source": colors,
            "before": before,
            "after": after,
            "primitive": fragments.primitive,
            **weighed,
        },
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings=listings,
        marks={"covered": np.ones(len(fragments), bool), "nan": np.any(np.isnan(after), axis=1)},
        buffers=(
            BufferTrack("color", source.start.color, np.arange(len(fragments)), place, after, "color", True),
        ),
        order=order if by_rows else None,
    )
