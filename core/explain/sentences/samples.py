"""What is said where samples, or pieces of exact area, become the colour of a pixel."""

from collections.abc import Callable, Mapping

from core.explain.number_text import counted, spoken, vector_text
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import StepValues


def samples(step: StepValues) -> str:
    """The samples of a pixel and what they weigh."""
    weights, triangles = step.vector("sample_weights"), step.vector("sample_triangle")
    kept = [triangle for weight, triangle in zip(weights, triangles, strict=True) if weight > 0]
    covered = sum(triangle >= 0 for triangle in kept)
    shown = sorted({int(triangle) for triangle in kept if triangle >= 0})
    names = ", ".join(map(str, shown[:6])) + (" …" if len(shown) > 6 else "")
    what = (
        f"{covered} of {counted(len(kept), 'sample')}" if covered < len(kept) else f"all {len(kept)} samples"
    )
    seen = (
        f"{what} show triangle{'s' if len(shown) > 1 else ''} {names}"
        if covered
        else "no sample shows a triangle"
    )
    total = sum(weights)
    return f"{pixel_name(step)}: {seen}; together they weigh {spoken(total)}."


def averaged(step: StepValues) -> str:
    """The weighted mean."""
    color = vector_text(step.vector("linear"))
    return f"{pixel_name(step)}: the sum of its weighted samples over that of the weights is {color}, in linear light."


def pieces(step: StepValues) -> str:
    """The pieces of a pixel and their areas."""
    areas, triangles = step.vector("sample_weights"), step.vector("sample_triangle")
    parts = [(area, int(triangle)) for area, triangle in zip(areas, triangles, strict=True) if area > 0]
    covered = sum(area for area, triangle in parts if triangle >= 0)
    whole = len(parts) == 1
    made = "it is one piece" if whole else f"edges cut it into {len(parts)} pieces"
    found = f"{pixel_name(step)}: {made}, and triangles cover {spoken(covered)} of its area."
    if step.has("untold_cuts"):
        found += " How they are cut is told of one triangle, or of a smaller part of the picture."
    return found


def summed(step: StepValues) -> str:
    """The sum of areas times colours."""
    color = vector_text(step.vector("linear"))
    return f"{pixel_name(step)}: the colours of its pieces, each times its area, add up to {color}, in linear light."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "resolve.average.samples": samples,
    "resolve.average.divide": averaged,
    "resolve.areas.samples": pieces,
    "resolve.areas.divide": summed,
}
