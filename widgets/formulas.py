"""The formula of every step: one law in symbols, and the same with the numbers of the step put in."""

from collections.abc import Callable, Mapping

from core.trace import Explanation
from widgets import (
    formulas_area_cuts,
    formulas_clip_order,
    formulas_frame,
    formulas_line_clipping,
    formulas_lines,
    formulas_numbers,
    formulas_pixel,
    formulas_raster,
    formulas_samples,
    formulas_smooth_lines,
    formulas_vertex,
)
from widgets.formula import Formula
from widgets.step_values import StepValues

FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **formulas_vertex.FORMULAS,
    **formulas_clip_order.FORMULAS,
    **formulas_raster.FORMULAS,
    **formulas_numbers.FORMULAS,
    **formulas_lines.FORMULAS,
    **formulas_line_clipping.FORMULAS,
    **formulas_pixel.FORMULAS,
    **formulas_frame.FORMULAS,
    **formulas_smooth_lines.BLEND_FORMULAS,
    **formulas_area_cuts.FORMULAS,
    **formulas_samples.FORMULAS,
}
"""``stage.kind.operation`` to the maker of its formula; all interpolated values share one, ``value``."""

WITHOUT_FORMULA = frozenset(
    {
        "cull.kept.verdict",
        "clip.in-in.keep",
        "clip.out-out.drop",
        "clip.untouched.keep",
        "edges.homogeneous.keep",
        "bin.whole-image.keep",
        "raster.accept.accept",
        "shade.plain.color",
        "shade.textured.color",
        "depth.test.write",
        "depth.store.write",
        "depth.ray-first.keep",
        "depth.ray.write",
        "depth.ray-exact.write",
        "blend.opaque.write",
        "blend.over.write",
        "blend.line-over.write",
        "blend.line-additive.write",
        "blend.additive.write",
    }
)
"""Operations that hand on, keep or store what is there, and compute nothing."""


def formula(explanation: Explanation) -> Formula | None:
    """Return the formula of a step, or ``None`` where it computes nothing."""
    step = StepValues(explanation)
    make = FORMULAS.get(step.key)
    return make(step) if make is not None else None
