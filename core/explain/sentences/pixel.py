"""What is said from interpolation to display bytes: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import joined, spoken, vector_text
from core.explain.sentences import corrected as sentences_corrected
from core.explain.sentences import depth as sentences_depth
from core.explain.sentences import mipmaps as sentences_mipmaps
from core.explain.sentences import packed as sentences_packed
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import TEXEL_NAMES, StepValues

ATTRIBUTE_NAMES = {
    "color": "colour",
    "uv": "texture coordinates",
    "position": "world position",
    "normal": "normal",
    "diffuse_light": "diffuse light",
    "specular_light": "specular light",
}


def _listed(step: StepValues, name: str) -> str:
    return joined([spoken(value) for value in step.vector(name)])


def numerators(step: StepValues) -> str:
    """The unsnapped edge functions at the pixel."""
    text = (
        f"{pixel_name(step)}: the edge functions of the unsnapped corners are {_listed(step, 'numerators')}"
    )
    if step.kind == "affine":
        return f"{text}, each multiplied by the w of its corner to leave perspective out."
    return f"{text} there, each the determinant times weight / w."


def total(step: StepValues) -> str:
    """Their sum."""
    text = f"{pixel_name(step)}: together they are {spoken(step.number('total'))}"
    inverse_w = spoken(step.number("inverse_w"))
    if step.kind == "affine":
        return f"{text}, the whole that the three parts are shares of (1/w is {inverse_w} here)."
    return f"{text}, the determinant times 1/w, and 1/w is {inverse_w} here."


def weights(step: StepValues) -> str:
    """The weights of the corners."""
    values = step.vector("weights")
    if step.kind == "flat":
        corner = max(range(3), key=lambda k: values[k])
        return f"{pixel_name(step)}: corner {corner} alone counts, the others have weight 0."
    text = f"{pixel_name(step)}: corners 0, 1 and 2 weigh {_listed(step, 'weights')}, their shares of the sum"
    below = [str(k) for k in range(3) if values[k] < 0]
    if below:
        return (
            f"{text}; weight {joined(below)} is below 0, as coverage was decided on moved corners and "
            "weights come from the corners as they are."
        )
    if any(map(math.isnan, values)):
        return f"{text}; NaN means that the sum is 0."
    return text + "."


def attribute(step: StepValues) -> str:
    """An interpolated value."""
    name = step.operation.removeprefix("value-")
    values = step.vector(name)
    shown = spoken(values[0]) if len(values) == 1 else vector_text(values)
    title = ATTRIBUTE_NAMES.get(name, name.replace("_", " "))
    how = "as at that one corner" if step.kind == "flat" else "the corners' values mixed by the weights"
    verb = "are" if name == "uv" else "is"
    return f"{pixel_name(step)}: its {title} {verb} {shown}, {how}."


def plain(step: StepValues) -> str:
    """Colour without texture and light."""
    return f"{pixel_name(step)}: its colour is {vector_text(step.vector('color'))}, as interpolated."


def texel_position(step: StepValues) -> str:
    """Texture coordinates in texels."""
    position = vector_text(step.vector("texel_position"))
    if step.has("uv", "texture_size"):
        width, height = step.vector("texture_size")
        uv = vector_text(step.vector("uv"))
        return (
            f"{pixel_name(step)}: (u, v) = {uv} is the place {position} "
            f"in the texture of {spoken(width)} × {spoken(height)} texels."
        )
    return f"{pixel_name(step)}: counted in texels, its place in the texture is {position}."


def texels(step: StepValues) -> str:
    """Which texels are read."""
    found = [f"({spoken(column)}, {spoken(row)})" for column, row in step.rows("texels")]
    if len(found) == 1:
        color = vector_text(step.rows("texel_colors")[0])
        return f"{pixel_name(step)}: the place is in texel {found[0]}, whose colour is {color}."
    return f"{pixel_name(step)}: the centres of texels {joined(found)} surround the place."


def filtered(step: StepValues) -> str:
    """The mix of the texels."""
    color, shares = vector_text(step.vector("texture_color")), step.vector("shares")
    if len(shares) == 1:
        return f"{pixel_name(step)}: the nearest texel alone gives the texture's colour, {color}."
    listed = joined([f"{spoken(share)} ({TEXEL_NAMES[k]})" for k, share in enumerate(shares)])
    return f"{pixel_name(step)}: the texture's colour is {color}, with the shares {listed}."


def albedo(step: StepValues) -> str:
    """The colour before lighting."""
    color = vector_text(step.vector("albedo"))
    if step.kind.startswith("textured"):
        return f"{pixel_name(step)}: its albedo is {color}, the texture's colour times the interpolated one."
    return f"{pixel_name(step)}: its albedo is {color}, the interpolated colour."


def interpolated_light(step: StepValues) -> str:
    """Light that was computed at the corners or for the face."""
    diffuse, specular = (vector_text(step.vector(name)) for name in ("diffuse_light", "specular_light"))
    return (
        f"{pixel_name(step)}: diffuse light {diffuse} and specular light {specular} "
        "were computed before, at the corners or for the whole face."
    )


def normal(step: StepValues) -> str:
    """The unit normal."""
    n, to_eye = (vector_text(step.vector(name)) for name in ("normal", "to_eye"))
    return f"{pixel_name(step)}: made unit length, the normal N is {n} and the way to the eye V is {to_eye}."


def cosines(step: StepValues) -> str:
    """The cosines of every light."""
    if not step.vector("n_dot_l"):
        return f"{pixel_name(step)}: there is no light, so no cosine to compute."
    texts = []
    for number, (n_dot_l, n_dot_h) in enumerate(
        zip(step.vector("n_dot_l"), step.vector("n_dot_h"), strict=True)
    ):
        side = "" if n_dot_l > 0 else ", so it does not reach this side"
        texts.append(f"light {number} has N·L = {spoken(n_dot_l)} and N·H = {spoken(n_dot_h)}{side}")
    return f"{pixel_name(step)}: {'; '.join(texts)}."


def light_sums(step: StepValues) -> str:
    """The two sums over the lights."""
    diffuse, specular = (vector_text(step.vector(name)) for name in ("diffuse_light", "specular_light"))
    powers = [f"{spoken(power)} (light {k})" for k, power in enumerate(step.vector("power"))]
    if not powers:
        return f"{pixel_name(step)}: without lights, the ambient light {diffuse} is all there is."
    highlight = f"highlight power{'s' if len(powers) > 1 else ''} {joined(powers)}"
    return (
        f"{pixel_name(step)}: over all lights the diffuse light is {diffuse}, ambient included, "
        f"and the specular light {specular}, from {highlight}."
    )


def product(step: StepValues) -> str:
    """Albedo times diffuse light plus specular light."""
    return (
        f"{pixel_name(step)}: its colour is {vector_text(step.vector('color'))}, "
        "albedo times diffuse light plus specular light."
    )


def shaded(step: StepValues) -> str:
    """Colour of an unlit textured fragment."""
    return f"{pixel_name(step)}: its colour is {vector_text(step.vector('color'))}, as no light is computed."


def opaque(step: StepValues) -> str:
    """A colour that replaces another."""
    after, before = (vector_text(step.vector(name)) for name in ("after", "before"))
    return f"{pixel_name(step)}: the fragment's colour {after} replaces {before}."


def over_source(step: StepValues) -> str:
    """The alpha of a fragment."""
    alpha = step.vector("source")[3]
    before = vector_text(step.vector("before"))
    return (
        f"{pixel_name(step)}: the fragment's alpha is {spoken(alpha)}, "
        f"so {spoken(1 - alpha)} of what is there, {before}, shows through."
    )


def over_color(step: StepValues) -> str:
    """The mix of fragment and buffer."""
    return f"{pixel_name(step)}: fragment over buffer gives {vector_text(step.vector('after'))}."


def over_written(step: StepValues) -> str:
    """The mix in the buffer."""
    after, before = (vector_text(step.vector(name)) for name in ("after", "before"))
    return f"{pixel_name(step)}: the colour buffer now holds {after} instead of {before}."


def additive_source(step: StepValues) -> str:
    """The light that a fragment adds."""
    alpha, before = spoken(step.vector("source")[3]), vector_text(step.vector("before"))
    return (
        f"{pixel_name(step)}: the fragment's colour counts by its alpha, {alpha}, "
        f"and all of what is there, {before}, stays."
    )


def additive_color(step: StepValues) -> str:
    """The sum of fragment and buffer."""
    after = step.vector("after")
    above = ", more than the display can show" if max(after[:3]) > 1 else ""
    return f"{pixel_name(step)}: fragment plus buffer gives {vector_text(after)}{above}."


def display_clipped(step: StepValues) -> str:
    """Colours cut off at 0 and 1."""
    linear, clipped = step.vector("linear"), vector_text(step.vector("clipped"))
    if any(map(math.isnan, linear)):
        return (
            f"{pixel_name(step)}: the colour {vector_text(linear)} has a NaN, which is shown as 0: {clipped}."
        )
    if min(linear[:3]) < 0 or max(linear[:3]) > 1:
        return f"{pixel_name(step)}: the colour {vector_text(linear)} is cut off at 0 and 1: {clipped}."
    return f"{pixel_name(step)}: the linear colour {clipped} is between 0 and 1 already."


def encoded(step: StepValues) -> str:
    """The sRGB curve."""
    color = vector_text(step.vector("encoded"))
    return f"{pixel_name(step)}: the sRGB curve turns the linear colour into {color}."


def rounded(step: StepValues) -> str:
    """Display bytes."""
    *color, alpha = step.vector("bytes")
    return f"{pixel_name(step)} is displayed as the bytes {vector_text(color)}, with alpha {spoken(alpha)}."


_TEXTURE: Mapping[str, Callable[[StepValues], str]] = {
    "position": texel_position,
    "texels": texels,
    "filter": filtered,
    "albedo": albedo,
}
_LIGHT: Mapping[str, Callable[[StepValues], str]] = {
    "interpolated": interpolated_light,
    "normal": normal,
    "cosines": cosines,
    "sums": light_sums,
    "product": product,
}

RESOLVED = ("encode", "average", "areas")
"""Kinds of pixels that are resolved: of one sample, of several, of pieces."""
SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **{f"interpolate.{kind}.numerators": numerators for kind in ("perspective", "affine")},
    **{f"interpolate.{kind}.total": total for kind in ("perspective", "affine")},
    **{f"interpolate.{kind}.weights": weights for kind in ("perspective", "affine", "flat")},
    **{f"interpolate.{kind}.value": attribute for kind in ("perspective", "affine", "affine-n", "flat")},
    **sentences_corrected.SENTENCES,
    **sentences_mipmaps.SENTENCES,
    "shade.plain.color": plain,
    "shade.textured.color": shaded,
    **{
        f"shade.{kind}.{name}": say for kind in ("textured", "textured-lit") for name, say in _TEXTURE.items()
    },
    "shade.lit.albedo": albedo,
    **{f"shade.{kind}.{name}": say for kind in ("lit", "textured-lit") for name, say in _LIGHT.items()},
    **sentences_depth.SENTENCES,
    **sentences_packed.SENTENCES,
    "blend.opaque.write": opaque,
    "blend.over.source": over_source,
    "blend.over.color": over_color,
    "blend.over.write": over_written,
    "blend.additive.source": additive_source,
    "blend.additive.color": additive_color,
    "blend.additive.write": over_written,
    **{f"resolve.{kind}.clip": display_clipped for kind in RESOLVED},
    **{f"resolve.{kind}.encode": encoded for kind in RESOLVED},
    **{f"resolve.{kind}.round": rounded for kind in RESOLVED},
}
