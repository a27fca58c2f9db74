"""Textures: texels around a place, the level of detail, mipmap levels and their mix.

Formulas of colours have the channel that is strongest; the other channels follow the same law.
"""

import math
from collections.abc import Sequence

from core.explain.formulas import (
    HALF,
    Chain,
    below,
    call,
    formula_of,
    in_channel,
    letter_of,
    named,
    outstanding,
    total,
)
from core.explain.number_text import spoken, vector_text
from core.explain.records import Formula
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.explain.term_latex import Written
from core.records.terms import Term
from core.records.words import joined

TEXELS = {"bl": "bottom left", "br": "bottom right", "tl": "top left", "tr": "top right"}
"""The four texels of bilinear filtering, in order."""
SLOPES = ("u_x", "v_x", "u_y", "v_y")
"""u_x is the change of u per pixel to the right."""


def _weighted(
    color: Sequence[float], weights: Sequence[float], colors: Sequence[Sequence[float]], which: str
) -> Formula:
    """Return the sum of the four texels times their weights."""
    channel = outstanding(color[:3])
    products = (
        named(below("s", name), weight) * letter_of(texel, channel, name)
        for name, weight, texel in zip(TEXELS, weights, colors, strict=True)
    )
    return formula_of(letter_of(color, channel, which).equals(total(products)))


def _listed(weights: Sequence[float]) -> str:
    return joined([f"{spoken(w)} ({name})" for w, name in zip(weights, TEXELS.values(), strict=True)])


@explains("shade.*.position")
def position(step: StepValues) -> Said:
    """Texture coordinates times the size of the texture."""
    (x, y), (u, v), (width, height) = (
        map(named, symbols, step.vector(name))
        for symbols, name in (("xy", "texel_position"), ("uv", "uv"), ("WH", "texture_size"))
    )
    text = (
        f"{step.pixel_name}: (u, v) = ({u}, {v}) is the place ({x}, {y}) in the texture of "
        f"{width} × {height} texels."
    )
    return text, formula_of(x.equals(u * width), y.equals(v * height))


@explains("shade.*.texels")
def texels(step: StepValues) -> Said:
    """The texel that contains the place, or the lower left one of the four around it."""
    found, place = step.rows("texels"), step.vector("texel_position")
    names = [f"({spoken(column)}, {spoken(row)})" for column, row in found]
    text = f"{step.pixel_name}: the centres of texels {joined(names)} surround the place."
    if len(found) == 1:
        color = vector_text(step.rows("texel_colors")[0])
        text = f"{step.pixel_name}: the place is in texel {names[0]}, whose colour is {color}."
    x, y = map(named, "xy", place)
    i, j = map(named, "ij", found[0])
    indices = (
        index.equals(call("wrap", call("floor", at - HALF if len(found) > 1 else at)))
        for index, at in ((i, x), (j, y))
    )
    return text, formula_of(*indices)


@explains("shade.*.fractions")
def fractions(step: StepValues) -> Said:
    """Where the place is between the centres of the four texels."""
    place, shares = step.vector("texel_position"), step.vector("mix")
    text = (
        f"{step.pixel_name}: from the left to the right texels it is {spoken(shares[0])} of the way, from the lower to "
        f"the upper ones {spoken(shares[1])}."
    )
    made = []
    for axis, letter, at, share in zip("xy", "uv", place, shares, strict=True):
        lower = named(rf"\lfloor {axis} - \frac{{1}}{{2}} \rfloor", math.floor(at - 0.5))
        made.append(named(f"w_{letter}", share).equals(named(axis, at) - HALF - lower))
    return text, formula_of(*made)


@explains("shade.*.filter")
def filtered(step: StepValues) -> Said:
    """The texels times their weights."""
    color, weights, colors = step.vector("texture_color"), step.vector("shares"), step.rows("texel_colors")
    if len(weights) > 1:
        text = f"{step.pixel_name}: the texture's colour is {vector_text(color)}, with weights {_listed(weights)}."
        return text, _weighted(color, weights, colors, "")
    text = f"{step.pixel_name}: the nearest texel alone gives the texture's colour, {vector_text(color)}."
    channel = outstanding(color[:3])
    return text, formula_of(letter_of(color, channel).equals(letter_of(colors[0], channel, "texel")))


@explains("shade.*.slopes")
def slopes(step: StepValues) -> Said:
    """How u and v change from pixel to pixel; the formula has the largest of the four slopes."""
    values = step.vector("uv_slopes")
    right, up, k = vector_text(values[:2]), vector_text(values[2:]), outstanding(values)
    if step.has("length"):
        along = up if step.flag("is_steep") else right
        text = f"along the line (u, v) change by {along} per pixel, across it they do not change."
        return f"{step.pixel_name}: {text}", _line_slope(step, k)
    if step.has("slope_rule"):
        return _edited_slopes(step, k)
    if not step.has("slope_n"):
        text = "u and v are those of one corner everywhere, so they change neither to the right nor upwards."
        return f"{step.pixel_name}: {text}", formula_of(*(named(name, 0.0) for name in SLOPES))
    text = f"{step.pixel_name}: per pixel to the right (u, v) change by {right}, per pixel upwards by {up}."
    letter, coefficient = "uv"[k % 2], "a" if k < 2 else "b"
    here, rises = named(letter, step.vector("uv")[k % 2]), step.vector(f"slope_{coefficient}")
    changes = total(
        named(f"{coefficient}_{i}", rises[i]) @ (named(f"{letter}_{i}", row[k % 2]) - here)
        for i, row in enumerate(step.rows("corner_uv"))
    )
    return text, formula_of(
        named(SLOPES[k], values[k]).equals(changes / named("n", sum(step.vector("slope_n"))))
    )


def _edited_slopes(step: StepValues, k: int) -> Said:
    """Return how the slopes of an edited listing come about: those of the method, and how far its values are apart."""
    values, of_method = step.vector("uv_slopes"), step.vector("slope_rule")
    right, up = vector_text(values[:2]), vector_text(values[2:])
    text = (
        f"{step.pixel_name}: by your listing (u, v) change by {right} per pixel to the right, by {up} upwards: "
        "the method's slopes, and how much more your values change than its values from half a pixel before to "
        "half a pixel behind."
    )
    letter, (ahead, behind) = "uv"[k % 2], (("right", "left"), ("up", "down"))[k // 2]
    own = named(rf"{SLOPES[k]}^{{\mathrm{{method}}}}", of_method[k])
    more, less = (
        named(rf"\Delta {below(letter, side)}", step.vector(f"slope_{side}")[k % 2])
        for side in (ahead, behind)
    )
    return text, formula_of(named(SLOPES[k], values[k]).equals(own + (more - less)))


def _line_slope(step: StepValues, k: int) -> Formula:
    """Return the slope along a line: change of the value over length, corrected where w changes."""
    letter, ends = "uv"[k % 2], [row[k % 2] for row in step.rows("end_uv")]
    start, end = (named(below(letter, name), at) for name, at in zip(("start", "end"), ends, strict=True))
    length: Term = step.named("length", "L")
    if step.has("end_w"):
        t, (first, second) = step.number("t"), step.vector("end_w")
        inverse_w = named(r"\frac{1}{w}", (1 - t) / first + t / second)
        length = (
            length
            @ named(below("w", "start"), first)
            @ named(below("w", "end"), second)
            @ inverse_w
            @ inverse_w
        )
    return formula_of(named(SLOPES[k], step.vector("uv_slopes")[k]).equals((end - start) / length))


@explains("shade.*.lengths")
def pixel_lengths(step: StepValues) -> Said:
    """The lengths of a pixel in texels; the formula has the longer one."""
    lengths, slope, size = step.vector("lengths"), step.vector("uv_slopes"), step.vector("texture_size")
    text = f"{step.pixel_name}: a pixel to the right is {spoken(lengths[0])} texels long, one up {spoken(lengths[1])}."
    longer = 1 if lengths[1] > lengths[0] else 0
    name = "xy"[longer]
    across, up = (
        (named(f"{letter}_{name}", change) @ named(side, texels)) ** 2
        for letter, side, change, texels in zip("uv", "WH", slope[2 * longer :], size, strict=False)
    )
    return text, formula_of(named(rf"\rho_{name}", lengths[longer]).equals(call("sqrt", across + up)))


@explains("shade.*.lod")
def level_of_detail(step: StepValues) -> Said:
    """The logarithm of the longer length."""
    lengths, lod = step.vector("lengths"), step.number("lod")
    text = f"{step.pixel_name}: the logarithm of the longer length is the level of detail, λ = {spoken(lod)}"
    if math.isnan(lod):
        text = f"{step.pixel_name}: the level of detail λ is NaN, and level 0 is used"
    elif lod == -math.inf:
        text = f"{step.pixel_name}: the level of detail λ is −∞: the place stays the same"
    elif lod <= 0:
        text += ": a pixel is no larger than a texel"
    logarithm = call("log2", call("max", *map(named, (r"\rho_x", r"\rho_y"), lengths)))
    # Of a place that stays the same, 0 texels long, the logarithm has no value.
    sign = ("=", r"\to") if lod == -math.inf else "="
    return f"{text}.", formula_of(Chain((named(r"\lambda", lod), logarithm), (sign,)))


def _level_name(step: StepValues, place: int) -> str:
    number = spoken(step.vector("levels")[place])
    width, height = step.vector("level_sizes")[2 * place : 2 * place + 2]
    return f"level {number} of {spoken(width)} × {spoken(height)} texels"


@explains("shade.*.level")
def clamped_level(step: StepValues) -> Said:
    """Lambda within the levels that there are."""
    lod, level = step.number("lod"), step.number("level")
    text = f"{step.pixel_name}: λ = {spoken(lod)} is a level of the texture, l = {spoken(level)}."
    if not lod > 0:
        text = f"{step.pixel_name}: the texture is not reduced here, so l = {spoken(level)}."
    elif lod > level:
        text = f"{step.pixel_name}: λ = {spoken(lod)} is beyond the last level, so l = {spoken(level)}."
    clamped = call("clamp", named(r"\lambda", lod) if math.isfinite(lod) else Written(r"\lambda"))
    return text, formula_of(named("l", level).equals(clamped))


@explains("shade.*.levels")
def levels(step: StepValues) -> Said:
    """The level, or the two, that lambda selects among those of the texture."""
    lod, level, part = (step.number(name) for name in ("lod", "level", "level_fraction"))
    near, far = step.vector("levels")
    name, has_two = _level_name(step, 0), step.has("far_color")
    if not lod > 0:
        text = f"the texture is not reduced here, so only {name} is read, the texture itself"
    elif lod > level:
        text = f"λ is beyond the last level, so {name} is read"
    elif not has_two:
        text = f"the nearest to λ = {spoken(lod)} is {name}"
    elif part == 0 or near == far:
        text = f"λ = {spoken(lod)} is {name} exactly"
    else:
        text = f"λ = {spoken(lod)} is between {name} and {_level_name(step, 1)}"
    of_level = named("l", level)
    chosen = call("floor", of_level) if has_two else call("ceil", of_level + HALF) - 1
    return f"{step.pixel_name}: {text}.", formula_of(named("k", near).equals(chosen))


@explains("shade.*.fraction")
def level_share(step: StepValues) -> Said:
    """How much of the coarser level is mixed in."""
    part, near = step.named("level_fraction", "f"), named("k", step.vector("levels")[0])
    text = f"{step.pixel_name}: the coarser level has weight {part}."
    return text, formula_of(part.equals(step.named("level", "l") - near))


@explains("shade.*.near|far")
def level_color(step: StepValues) -> Said:
    """The four texels of a level times their weights."""
    which = step.operation
    number = spoken(step.vector("levels")[0 if which == "near" else 1])
    place, color, weights = (step.vector(f"{which}_{name}") for name in ("position", "color", "shares"))
    text = (
        f"{step.pixel_name}: in level {number} the place is {vector_text(place)}, and the four texels around it give "
        f"{vector_text(color)}, with weights {_listed(weights)}."
    )
    return text, _weighted(color, weights, step.rows(f"{which}_colors"), which)


@explains("shade.*.mix")
def mix(step: StepValues) -> Said:
    """The mix of both levels."""
    part, color = step.number("level_fraction"), step.vector("texture_color")
    first, second = map(spoken, step.vector("levels"))
    mixed = f"{spoken(1 - part)} of level {first} and {spoken(part)} of level {second}"
    if part == 0:
        mixed = f"that of level {first} alone"
    text = f"{step.pixel_name}: the texture's colour is {vector_text(color)}, {mixed}."
    channel = outstanding(color[:3])
    near, far = (letter_of(step.vector(f"{name}_color"), channel, name) for name in ("near", "far"))
    mixed_in = named("(1 - f)", 1 - part) * near + named("f", part) * far
    return text, formula_of(letter_of(color, channel).equals(mixed_in))


@explains("shade.textured|textured-lit|textured-mirror.albedo")
def albedo(step: StepValues) -> Said:
    """Texture colour times interpolated colour, if the corners have one."""
    values, texture = step.vector("albedo"), step.vector("texture_color")
    channel, has_color = outstanding(values[:3]), step.has("vertex_color")
    times = " times the interpolated one" if has_color else ""
    text = f"{step.pixel_name}: its albedo is {vector_text(values)}, the texture's colour{times}."
    made: Term = in_channel("texture", texture, channel)
    if has_color:
        made = made * in_channel("colour", step.vector("vertex_color"), channel)
    return text, formula_of(in_channel("albedo", values, channel).equals(made))


def _level_variables(name: str, which: str) -> dict[str, VariableText]:
    return {
        f"{name}_position": VariableText(f"{which}: place", "Texture coordinates in texels of this level."),
        f"{name}_texels": VariableText(f"{which}: texel #", "Column and row in the level.", spread="parts"),
        f"{name}_colors": VariableText(
            f"{which}: colour #", "Linear red, green, blue, alpha.", spread="parts"
        ),
        f"{name}_shares": VariableText(
            f"{which}: weight #", "Weight of the texel in the level's colour.", spread="parts"
        ),
        f"{name}_color": VariableText(f"{which}: colour", "Result of bilinear filtering in this level."),
    }


shows(
    "shade",
    {
        "uv": given("u, v", "Texture coordinates."),
        "texture_size": given("W, H", "Texels from left to right and from bottom to top."),
        "texel_position": VariableText("x, y in texels", "Texture coordinates times the texture's size."),
        "texels": VariableText("texel #", "Column and row in the texture.", spread="parts"),
        "texel_colors": VariableText("texel colour #", "Linear red, green, blue, alpha.", spread="parts"),
        "mix": VariableText("fractions", "Position between the left and right, and lower and upper texels."),
        "shares": VariableText("weight #", "Weight of the texel in the colour.", spread="parts"),
        "slope_a": VariableText(
            "a#", "Change of the numerator n per pixel to the right.", "uv_slopes", "edges"
        ),
        "slope_b": VariableText("b#", "Change of the numerator n per pixel upwards.", "uv_slopes", "edges"),
        "slope_n": VariableText("n#", "Numerator of the corner's weight.", "uv_slopes", "edges"),
        "slope_rule": VariableText("slopes of the method", "Of its own u and v.", "uv_slopes"),
        **{
            f"slope_{side}": VariableText(
                f"apart {side}",
                f"u and v of your listing less the method's, half a pixel {side}.",
                "uv_slopes",
            )
            for side in ("right", "left", "up", "down")
        },
        "corner_uv": VariableText("u, v at corner #", "Texture coordinates there.", "uv_slopes", "edges"),
        "length": VariableText("L", "Pixels of the line along its major axis.", "uv_slopes"),
        "end_uv": VariableText("u, v at end #", "Texture coordinates there.", "uv_slopes", "parts"),
        "t": VariableText("t", "Position along the line: 0 at the first end, 1 at the second.", "uv_slopes"),
        "end_w": VariableText("w of the ends", "w of the line's first and second end.", "uv_slopes"),
        "uv_slopes": VariableText("slopes", "Changes of u and v to the right, then of u and v upwards."),
        "lengths": VariableText("ρx, ρy", "Length in texels of a pixel to the right, and of one up."),
        "lod": VariableText("λ", "Level of detail: logarithm to base 2 of the greater length."),
        "level": VariableText("l", "λ clamped to the levels of the texture."),
        "levels": VariableText("levels", "Numbers of the finer and the coarser level."),
        "level_sizes": VariableText("level sizes", "Width and height of both, in texels."),
        "level_fraction": VariableText("f", "Weight of the coarser level in the colour."),
        **_level_variables("near", "finer"),
        **_level_variables("far", "coarser"),
        "texture_color": VariableText("texture colour", "Linear red, green, blue, alpha."),
        "albedo": VariableText("albedo", "Colour before lighting: linear red, green, blue, alpha."),
    },
)
hides("shade.plain|lit|mirror", ("uv", "texture_size"))
