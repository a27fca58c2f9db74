"""Shadows, told: where a point lies in the map of the light, what it is compared with, and what arrives."""

import math

from core.explain.formulas import below, formula_of, named, upright
from core.explain.number_text import pair_text, spoken
from core.explain.records import Asked, choice
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.words import joined


@explains("shade.*.light-space")
def light_space(step: StepValues) -> Said:
    """The place of the fragment as the light sees it."""
    u, v, depth = (step.number(name) for name in ("lamp_u", "lamp_v", "lamp_depth"))
    text = (
        f"{step.pixel_name}: as light {step.whole('lamp')} sees it, the point lies at column {spoken(u)} and row "
        f"{spoken(v)}, at the depth {spoken(depth)}."
    )
    return text, formula_of(named("u", u), named("v", v), named("d", depth))


@explains("shade.*.map-texel")
def map_texel(step: StepValues) -> Said:
    """The texels that it is compared with."""
    texels, stored = step.rows("lamp_texels"), step.vector("lamp_stored")
    if len(texels) == 1:
        (column, row), depth = texels[0], stored[0]
        what = f"stores {spoken(depth)}" if math.isfinite(depth) else "lies outside of the map"
        return f"{step.pixel_name}: in the shadow map that is texel ({column:.0f}, {row:.0f}), which {what}."
    parts = [
        f"{spoken(depth) if math.isfinite(depth) else 'nothing'} at ({column:.0f}, {row:.0f})"
        for (column, row), depth in zip(texels, stored, strict=True)
    ]
    return f"{step.pixel_name}: the four nearest texels of the shadow map store {joined(parts)}."


def is_lit(step: StepValues) -> Asked | None:
    """Ask whether one texel lets the light pass."""
    stored, lit = step.vector("lamp_stored"), step.flags("texel_is_lit")
    if len(stored) != 1 or not math.isfinite(stored[0]):
        return None
    mine, most = pair_text(step.number("lamp_depth"), stored[0] + step.number("lamp_bias"))
    return choice(
        f"The shadow map and its bias allow a depth of {most}. {step.pixel_name} has {mine}. Is it lit?",
        0 if lit[0] else 1,
        f"{mine} is {'no more' if lit[0] else 'more'} than {most}: it is {'lit' if lit[0] else 'in the shadow'}.",
    )


@explains("shade.*.compare", asks=is_lit, decides=True)
def compare(step: StepValues) -> Said:
    """Whether the point is farther from the light than the map says."""
    stored, lit = step.vector("lamp_stored"), step.flags("texel_is_lit")
    depth, bias = step.number("lamp_depth"), step.number("lamp_bias")
    if len(stored) > 1:
        return (
            f"{step.pixel_name}: each texel is compared by itself with the depth less the bias, "
            f"{spoken(depth - bias)}: {sum(lit)} of {len(lit)} store no less, and let the light pass."
        )
    if not math.isfinite(stored[0]):
        return f"{step.pixel_name}: outside of the map nothing is known to stand in the light, so the point is lit."
    limit = stored[0] + bias
    mine, most = pair_text(depth, limit)
    word, verdict = ("no more than", "it is lit") if lit[0] else ("more than", "it is in the shadow")
    text = f"{step.pixel_name}: its depth {mine} is {word} {most}, which the map stores with the bias: {verdict}."
    sides = named("d", depth), named(f"{below('d', 'map')} + b", limit)
    return text, formula_of(sides[0].compared(r"\le", sides[1]))


@explains("shade.*.shadow-ray", decides=True)
def shadow_ray(step: StepValues) -> Said:
    """What the ray to the light meets."""
    blocker = step.whole("blocker")
    if blocker < 0:
        return f"{step.pixel_name}: its ray to light {step.whole('lamp')} meets no triangle."
    there, depth = pair_text(step.number("blocker_depth"), step.number("lamp_depth"))
    return (
        f"{step.pixel_name}: its ray to light {step.whole('lamp')} meets triangle {blocker} at the depth {there}, "
        f"before its own, {depth}."
    )


@explains("shade.*.share")
def share(step: StepValues) -> Said:
    """What arrives of the light."""
    light, share = step.whole("lamp"), step.number("light_share")
    if share == 1:
        text = f"all of light {light} arrives."
    elif share == 0:
        text = f"nothing of light {light} arrives: the other lights and the ambient light are left."
    else:
        text = f"{spoken(share)} of light {light} arrives."
    text, lit = f"{step.pixel_name}: {text}", step.flags("texel_is_lit") if step.has("texel_is_lit") else []
    if len(lit) < 2:
        return text
    return text, formula_of(named(upright("share"), share).equals(named("n", sum(lit)) / len(lit)))


shows(
    "shade",
    {
        "lamp_u": VariableText("u", "Column of the point in the map, in texels."),
        "lamp_v": VariableText("v", "Row of the point in the map, in texels."),
        "lamp_depth": VariableText("d", "Depth of the point from the light."),
        "lamp_stored": VariableText("d map #", "Depth that the map stores in the texel.", spread="parts"),
        "lamp_bias": VariableText("b", "How far behind the stored depth a point may lie and still be lit."),
        "blocker": VariableText("blocker", "The triangle that the ray to the light meets first; -1: none."),
        "blocker_depth": VariableText("d blocker", "Depth from the light at which it does."),
        "light_share": VariableText("share", "Share of the light that arrives."),
    },
)
