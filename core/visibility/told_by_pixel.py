"""Ray casting in its own loops, told step by step: how much all rays ask, and what a ray does not meet."""

import math

from core.explain.formulas import concludes, formula_of, named, upright
from core.explain.number_text import spoken
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.words import counted, joined


@explains("depth.ray-loops.count")
def loops(step: StepValues) -> Said:
    """How often both loops run: each pixel once, each primitive for every ray."""
    rays, primitives, hits = (step.whole(name) for name in ("ray_count", "primitive_count", "hit_count"))
    place = "sample" if step.has("sample") else "pixel"
    whose = f"Every {place}'s ray"
    if step.has("sample") and step.whole("sample") >= 0:
        whose = f"The ray of sample {step.whole('sample')} of every pixel"
    focus, asked = step.whole("focus"), rays * primitives
    whom = counted(primitives, step.nouns.one, step.nouns.many)
    if focus >= 0:
        whom = f"{step.named_primitive(focus)}, which alone is traced"
    text = f"{whose} asks {whom}: {counted(asked, 'test')}, {counted(hits, 'hit')}"
    if asked > hits and not step.flag("lists_misses"):
        text += ", and only hits have rows"
    text += f"; each {place} is accessed once, each {step.nouns.one} {counted(rays, 'time')}"
    return f"{text}.", formula_of(
        named(upright("tests"), asked).equals(
            named(upright("rays"), rays) * named(upright(step.nouns.many), primitives)
        )
    )


@explains("depth.ray-missed.miss")
def missed(step: StepValues) -> Said:
    """A triangle that a ray does not meet, and the edges that its pixel lies outside of."""
    values = step.vector("edge_values")
    outside = [k for k, is_outside in enumerate(step.flags("is_outside")) if is_outside]
    text = f"{step.pixel_name}: its ray misses {step.name}"
    if not outside:
        return f"{text}, which does not cover the pixel."
    reasons = [f"E{k} is {_shown(values[k])}" for k in outside]
    tests = (named(f"E_{k}", values[k]).compared(">") for k in outside)
    text += f", outside {joined([f'edge {k}' for k in outside])} ({joined(reasons)})."
    return text, formula_of(concludes("hit", "missed", *tests))


def _shown(value: float) -> str:
    """Return an edge function that does not let a pixel in, in words where it is no negative number."""
    if math.isnan(value):
        return "not a number"
    return "0, a tie that the edge does not own" if value == 0 else spoken(value)


shows(
    "depth",
    {
        "edge_values": VariableText(
            "E#", "Edge function at the pixel's centre: positive inside of the edge.", spread="edges"
        )
    },
)
