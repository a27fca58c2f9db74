"""The formula of every step: one law in symbols, and the same with the numbers of the step put in."""

from collections.abc import Callable, Mapping

from core.explain.formulas import area_cuts as formulas_area_cuts
from core.explain.formulas import clip_order as formulas_clip_order
from core.explain.formulas import frame as formulas_frame
from core.explain.formulas import line_clipping as formulas_line_clipping
from core.explain.formulas import lines as formulas_lines
from core.explain.formulas import numbers as formulas_numbers
from core.explain.formulas import pixel as formulas_pixel
from core.explain.formulas import raster as formulas_raster
from core.explain.formulas import samples as formulas_samples
from core.explain.formulas import smooth_lines as formulas_smooth_lines
from core.explain.formulas import vertex as formulas_vertex
from core.explain.records import Formula
from core.explain.step_values import StepValues
from core.trace import Explanation

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
