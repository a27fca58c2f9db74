"""Shading: light at a fragment, and its colour.

Formulas of colours have the channel that is strongest; the other channels follow the same law.
"""

from collections.abc import Sequence

from core.explain.digits import number_latex, signed_latex, spoken, vector_text
from core.explain.equation import (
    CHANNEL_LETTERS,
    Part,
    beside,
    channel_symbol,
    equation,
    outstanding,
    vector_latex,
)
from core.explain.records import Formula
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, shows
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
    return equation(
        (channel_symbol("colour", channel), color[channel]),
        "=",
        (channel_symbol("albedo", channel), albedo[channel]),
    )


@explains("shade.lit.albedo")
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
    return text, equation(
        *beside(*([(channel_symbol(name, channel), light[channel])] for name, light in lights))
    )


@explains("shade.*.normal")
def normal(step: StepValues) -> Said:
    """The normal made unit length."""
    n, v = step.vector("normal"), step.vector("to_eye")
    text = (
        f"{step.pixel_name}: made unit length, the normal N is {vector_text(n)} and the direction to the eye V is "
        f"{vector_text(v)}."
    )
    return text, equation(*beside([(r"N = \frac{n}{|n|}", vector_latex(n))], [("V", vector_latex(v))]))


def _dot(other: str, value: float, first: Sequence[float], second: Sequence[float]) -> list[Part]:
    """Return a product of two directions, term by term: a long line breaks between them."""
    parts: list[Part] = [(rf"N \cdot {other}", value), "="]
    for k, axis in enumerate("xyz"):
        parts += ["+"] if k else []
        parts.append(
            (rf"N_{axis} {other}_{axis}", rf"{number_latex(first[k])} \cdot {signed_latex(second[k])}")
        )
    return parts


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
            products = _dot("L", of_light, n, to_light), _dot("H", of_half, n, half)
    return f"{step.pixel_name}: {'; '.join(texts)}.", equation(*beside(*products))


@explains("shade.*.power")
def highlight(step: StepValues) -> Said:
    """The cosines of the highlights to the power of the shininess; the formula has that of the brightest."""
    powers, n_dot_h, n_dot_l = (step.vector(name) for name in ("power", "n_dot_h", "n_dot_l"))
    if not powers:
        return f"{step.pixel_name}: there is no light, so no highlight."
    listed = joined([f"{spoken(power)} (light {k})" for k, power in enumerate(powers)])
    text = f"{step.pixel_name}: {noun_of(len(powers), 'highlight')} {listed}, from N·H and the shininess."
    k = max(range(len(powers)), key=powers.__getitem__)
    if not n_dot_l[k] > 0:
        return text, equation(("p", powers[k]))
    base = (
        r"\max(N \cdot H, 0)^s",
        rf"{number_latex(max(n_dot_h[k], 0.0))}^{{{number_latex(step.number('shininess'))}}}",
    )
    return text, equation(("p", powers[k]), "=", base)


@explains("shade.*.specular")
def specular_sum(step: StepValues) -> Said:
    """The mirrored light of all lights."""
    specular, powers = step.vector("specular_light"), step.vector("power")
    text = f"{step.pixel_name}: the specular light is {vector_text(specular)}."
    channel = outstanding(specular)
    parts: list[Part] = [(channel_symbol("specular", channel), specular[channel])]
    for light, power in enumerate(powers):
        parts += [
            "+" if light else "=",
            (r"k_{\mathrm{specular}}", step.number("specular")),
            r"\cdot",
            ("p", power),
        ]
        parts += [r"\cdot", (rf"l_{{{CHANNEL_LETTERS[channel]}}}", step.rows("light_colors")[light][channel])]
    return text, equation(*parts)


@explains("shade.*.diffuse")
def diffuse_sum(step: StepValues) -> Said:
    """The ambient light, and the diffuse light of all lights."""
    diffuse, n_dot_l = step.vector("diffuse_light"), step.vector("n_dot_l")
    text = f"{step.pixel_name}: without lights, only the ambient light {vector_text(diffuse)} is left."
    if n_dot_l:
        text = f"{step.pixel_name}: over all lights the diffuse light is {vector_text(diffuse)}, ambient included."
    channel = outstanding(diffuse)
    parts: list[Part] = [(channel_symbol("diffuse", channel), diffuse[channel]), "="]
    parts.append((r"k_{\mathrm{ambient}}", step.number("ambient")))
    for light, cosine in enumerate(n_dot_l):
        colour = step.rows("light_colors")[light][channel]
        parts += ["+", (r"k_{\mathrm{diffuse}}", step.number("diffuse")), r"\cdot"]
        parts += [(r"\max(N \cdot L, 0)", max(cosine, 0.0)), r"\cdot"]
        parts.append((rf"l_{{{CHANNEL_LETTERS[channel]}}}", colour))
    return text, equation(*parts)


@explains("shade.*.product")
def product(step: StepValues) -> Said:
    """Albedo times diffuse light plus specular light."""
    color = step.vector("color")
    text = f"{step.pixel_name}: its colour is {vector_text(color)}, albedo times diffuse light plus specular light."
    channel = outstanding(color[:3])
    base, diffuse, specular = (
        (channel_symbol(name.removesuffix("_light"), channel), step.vector(name)[channel])
        for name in ("albedo", "diffuse_light", "specular_light")
    )
    return text, equation(
        (channel_symbol("colour", channel), color[channel]), "=", base, r"\cdot", diffuse, "+", specular
    )


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
