"""Shading: light at a fragment, and its colour.

Formulas of colours have the channel that is strongest; the other channels follow the same law.
"""

from core.culling.told import by_axes
from core.explain.formulas import (
    CHANNEL_LETTERS,
    Named,
    below,
    formula_of,
    in_channel,
    named,
    outstanding,
    total,
)
from core.explain.number_text import spoken, vector_text
from core.explain.records import Formula
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.words import joined, noun_of


@explains("shade.plain.color")
def plain(step: StepValues) -> Said:
    """Colour without texture and light."""
    text = f"{step.pixel_name}: its colour is the interpolated {vector_text(step.vector('color'))}."
    return text, _without_light(step)


@explains("shade.textured.color")
def unlit(step: StepValues) -> Said:
    """Colour of an unlit textured fragment."""
    text = f"{step.pixel_name}: its colour is {vector_text(step.vector('color'))}, as no light is computed."
    return text, _without_light(step)


def _without_light(step: StepValues) -> Formula:
    """Return the colour that is the albedo."""
    color, albedo = step.vector("color"), step.vector("albedo")
    channel = outstanding(color[:3])
    return formula_of(in_channel("colour", color, channel).equals(in_channel("albedo", albedo, channel)))


@explains("shade.lit|mirror.albedo")
def albedo(step: StepValues) -> Said:
    """The colour before lighting."""
    return f"{step.pixel_name}: its albedo is the interpolated colour, {vector_text(step.vector('albedo'))}."


@explains("shade.*.interpolated")
def interpolated_light(step: StepValues) -> Said:
    """Light that was computed at the corners or for the face."""
    diffuse, specular = step.vector("diffuse_light"), step.vector("specular_light")
    text = (
        f"{step.pixel_name}: diffuse light {vector_text(diffuse)} and specular light {vector_text(specular)} "
        "were computed before, at the corners or for the whole face."
    )
    channel = outstanding(diffuse)
    lights = (("diffuse", diffuse), ("specular", specular))
    return text, formula_of(*(in_channel(name, light, channel) for name, light in lights))


@explains("shade.*.normal")
def normal(step: StepValues) -> Said:
    """The normal made unit length."""
    n, v = step.vector("normal"), step.vector("to_eye")
    text = (
        f"{step.pixel_name}: made unit length, the normal N is {vector_text(n)} and the direction to the eye V is "
        f"{vector_text(v)}."
    )
    return text, formula_of(named(r"N = \frac{n}{|n|}", n), named("V", v))


@explains("shade.*.cosines")
def cosines(step: StepValues) -> Said:
    """The cosines of every light; the formula has those of the light that stands highest."""
    n, n_dot_l, n_dot_h = (step.vector(name) for name in ("normal", "n_dot_l", "n_dot_h"))
    if not n_dot_l:
        return f"{step.pixel_name}: there is no light, so no cosine to compute."
    texts, highest = [], max(range(len(n_dot_l)), key=n_dot_l.__getitem__)
    lights = zip(n_dot_l, n_dot_h, step.rows("to_light"), step.rows("half"), strict=True)
    for number, (of_light, of_half, to_light, half) in enumerate(lights):
        side = "" if of_light > 0 else ", so it does not reach this side"
        texts.append(f"light {number} has N·L = {spoken(of_light)} and N·H = {spoken(of_half)}{side}")
        if number == highest:
            products = (
                named(rf"N \cdot {letter}", cosine).equals(by_axes("N", n, letter, direction))
                for letter, cosine, direction in (("L", of_light, to_light), ("H", of_half, half))
            )
    return f"{step.pixel_name}: {'; '.join(texts)}.", formula_of(*products)


@explains("shade.*.power")
def highlight(step: StepValues) -> Said:
    """The cosines of the highlights to the power of the shininess; the formula has that of the brightest."""
    powers, n_dot_h, n_dot_l = (step.vector(name) for name in ("power", "n_dot_h", "n_dot_l"))
    if not powers:
        return f"{step.pixel_name}: there is no light, so no highlight."
    listed = joined([f"{spoken(power)} (light {k})" for k, power in enumerate(powers)])
    text = f"{step.pixel_name}: {noun_of(len(powers), 'highlight')} {listed}, from N·H and the shininess."
    k = max(range(len(powers)), key=powers.__getitem__)
    p = named("p", powers[k])
    if not n_dot_l[k] > 0:
        return text, formula_of(p)
    cosine = named(r"\max(N \cdot H, 0)", max(n_dot_h[k], 0.0))
    return text, formula_of(p.equals(cosine ** step.named("shininess", "s")))


@explains("shade.*.specular")
def specular_sum(step: StepValues) -> Said:
    """The mirrored light of all lights."""
    specular, powers = step.vector("specular_light"), step.vector("power")
    text = f"{step.pixel_name}: the specular light is {vector_text(specular)}."
    channel = outstanding(specular)
    light, k = in_channel("specular", specular, channel), step.named("specular", below("k", "specular"))
    products = [
        k * named("p", power) * of_light
        for power, of_light in zip(powers, _lights(step, channel), strict=True)
    ]
    return text, formula_of(light.equals(total(products)) if products else light)


def _lights(step: StepValues, channel: int) -> list[Named]:
    """Return one channel of the colours of all lights."""
    return [
        named(rf"l_{{{CHANNEL_LETTERS[channel]}}}", color[channel]) for color in step.rows("light_colors")
    ]


@explains("shade.*.diffuse")
def diffuse_sum(step: StepValues) -> Said:
    """The ambient light, and the diffuse light of all lights."""
    diffuse, n_dot_l = step.vector("diffuse_light"), step.vector("n_dot_l")
    text = f"{step.pixel_name}: without lights, only the ambient light {vector_text(diffuse)} is left."
    if n_dot_l:
        text = f"{step.pixel_name}: over all lights the diffuse light is {vector_text(diffuse)}, ambient included."
    channel = outstanding(diffuse)
    ambient, k = (step.named(name, below("k", name)) for name in ("ambient", "diffuse"))
    products = (
        k * named(r"\max(N \cdot L, 0)", max(cosine, 0.0)) * light
        for cosine, light in zip(n_dot_l, _lights(step, channel), strict=False)
    )
    return text, formula_of(in_channel("diffuse", diffuse, channel).equals(total([ambient, *products])))


@explains("shade.*.product")
def product(step: StepValues) -> Said:
    """Albedo times diffuse light plus specular light."""
    text = f"{step.pixel_name}: its colour is {vector_text(step.vector('color'))}, {LIT}."
    return text, sum_of_light(step, "color")


LIT = "albedo times diffuse light plus specular light"


def sum_of_light(step: StepValues, name: str) -> Formula:
    """Return the colour ``name``, or ``own_color``, as what the light gives."""
    color = step.vector(name)
    channel = outstanding(color[:3])
    base, diffuse, specular = (
        in_channel(name.removesuffix("_light"), step.vector(name), channel)
        for name in ("albedo", "diffuse_light", "specular_light")
    )
    word = "colour" if name == "color" else "own"
    return formula_of(in_channel(word, color, channel).equals(base * diffuse + specular))


shows(
    "shade",
    {
        "normal": VariableText("N", "Unit normal, in world space."),
        "to_eye": VariableText("V", "Unit vector to the eye, in world space."),
        "n_dot_l": VariableText("N·L, light #", "Cosine between normal and light.", spread="parts"),
        "n_dot_h": VariableText("N·H, light #", "Cosine between normal and halfway vector.", spread="parts"),
        "to_light": VariableText("L, light #", "Unit vector to the light.", "n_dot_l", "parts"),
        "half": VariableText("H, light #", "Unit vector halfway to the eye.", "n_dot_h", "parts"),
        "power": VariableText("highlight, light #", "Cosine to the power of the shininess.", spread="parts"),
        "diffuse_light": VariableText("diffuse light", "Ambient and diffuse light: red, green, blue."),
        "specular_light": VariableText("specular light", "Mirrored light: red, green, blue."),
        "color": VariableText("colour", "Colour of the fragment: linear red, green, blue, alpha."),
    },
)
