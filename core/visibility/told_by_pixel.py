"""Ray casting in its own loops, told step by step: how much all rays ask, and what a ray does not meet."""

import math

from core.explain.formulas import concludes, formula_of, named, upright
from core.explain.number_text import spoken
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.words import capitalized, counted, joined


@explains("depth.ray-loops.count")
def loops(step: StepValues) -> Said:
    """How often both loops run: each pixel once, each primitive for every ray."""
    rays, primitives, hits = (step.whole(name) for name in ("ray_count", "primitive_count", "hit_count"))
    place = "sample" if step.has("sample") else "pixel"
    of_sample = (
        f"Sample {step.whole('sample')} of each pixel: "
        if step.has("sample") and step.whole("sample") >= 0
        else ""
    )
    focus, asked = step.whole("focus"), rays * primitives
    whom = counted(primitives, step.nouns.one, step.nouns.many)
    if focus >= 0:
        whom = f"{step.named_primitive(focus)}, which alone is traced"
    ask = "asks" if rays == 1 else "ask"
    text = f"{of_sample}in all {counted(rays, 'ray')}, one for each {place}, {ask} {whom}: {counted(asked, 'test')}"
    text += f", of which {hits:,} {'is a hit' if hits == 1 else 'are hits'}"
    if asked > hits and not step.flag("lists_misses"):
        text += "; only hits have rows"
    text += f"; each {place} is accessed once, each {step.nouns.one} {counted(rays, 'time')}."
    return capitalized(text), formula_of(
        named(upright("tests"), asked).equals(
            named(upright("rays"), rays) @ named(upright(step.nouns.many), primitives)
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
    reasons = [f"E{k} is {'not a number' if math.isnan(values[k]) else spoken(values[k])}" for k in outside]
    tests = (named(f"E_{k}", values[k]).compared(">") for k in outside)
    text += f", outside {joined([f'edge {k}' for k in outside])} ({joined(reasons)})."
    return text, formula_of(concludes("hit", "missed", *tests))


shows(
    "depth",
    {
        "edge_values": VariableText(
            "E#", "Edge function at the pixel's centre: positive inside of the edge.", spread="edges"
        )
    },
)
