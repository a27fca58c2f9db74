"""Resolving: weighted means of samples, sums over pieces of exact area, and display bytes.

Of many samples those of equal colour are one summand; of more than `MOST` colours the largest are written out.
"""

import math

from core.explain.channels import CHANNEL_LETTERS, in_channel, letter_of, outstanding
from core.explain.digits import remainder_note, spoken, vector_text
from core.explain.formulas import HALF, call, first_of, formula_of, named, slash
from core.explain.records import Asked, Formula, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, shows
from core.framebuffer.display import SRGB_LIMIT, SRGB_OFFSET, SRGB_SCALE, SRGB_SLOPE
from core.records.words import counted, noun_of

NAMES = "abcdefghijklmnopqrstuvwxyz"
"""Names of different samples: 0, 1 and 2 are corners."""
MOST = 4
"""Summands that are written out."""


def _channel(step: StepValues) -> int:
    """Return the channel in which the samples differ most."""
    kept = zip(step.rows("samples"), step.vector("sample_weights"), strict=True)
    rows = [row for row, weight in kept if weight > 0]
    spans = []
    for channel in range(3):
        finite = [row[channel] for row in rows if abs(row[channel]) < math.inf]
        spans.append(max(finite, default=0.0) - min(finite, default=0.0))
    return max(range(3), key=lambda channel: spans[channel])


def _weights(step: StepValues) -> list[tuple[float, float]]:
    """Return the weights of the different values of the channel, the greatest first."""
    found: dict[str, tuple[float, float]] = {}
    channel = _channel(step)
    for row, weight in zip(step.rows("samples"), step.vector("sample_weights"), strict=True):
        if weight > 0:
            value = row[channel] + 0.0
            known = found.get(repr(value), (0.0, value))
            found[repr(value)] = (known[0] + weight, known[1])
    return sorted(found.values(), key=lambda known: -known[0])


def _together(step: StepValues, whole: str, part: str) -> Formula:
    """Return the sum of weights, or of areas."""
    weights = [weight for weight, _ in _weights(step)]
    parts = [named(f"{part}_{{{NAMES[k % 26]}}}", weight) for k, weight in enumerate(weights)]
    return formula_of(named(whole, sum(weights)).equals(first_of(parts, MOST)))


@explains("resolve.average.samples")
def samples(step: StepValues) -> Said:
    """The samples of a pixel and their weights."""
    weights, triangles = step.vector("sample_weights"), step.vector("sample_triangle")
    kept = [triangle for weight, triangle in zip(weights, triangles, strict=True) if weight > 0]
    covered = sum(triangle >= 0 for triangle in kept)
    shown = sorted({int(triangle) for triangle in kept if triangle >= 0})
    names = ", ".join(map(str, shown[:6])) + (" …" if len(shown) > 6 else "")
    what = (
        f"{covered} of {counted(len(kept), 'sample')}" if covered < len(kept) else f"all {len(kept)} samples"
    )
    seen = (
        f"{what} show {noun_of(len(shown), step.nouns.one)} {names}"
        if covered
        else f"no sample shows a {step.nouns.one}"
    )
    text = f"{step.pixel_name}: {seen}; their weights add up to {spoken(sum(weights))}."
    return text, _together(step, "W", "w")


@explains("resolve.average.divide")
def averaged(step: StepValues) -> Said:
    """The weighted mean."""
    channel, color, weights = _channel(step), step.vector("linear"), _weights(step)
    text = f"{step.pixel_name}: the weighted mean of its samples is {vector_text(color)}, in linear light"
    text += f"{remainder_note(color)}."
    letter, whole = CHANNEL_LETTERS[channel], named("W", sum(weight for weight, _ in weights))
    terms = [
        named(f"w_{name}", weight) / whole * named(f"{letter}_{name}", value)
        for name, (weight, value) in zip(NAMES, weights, strict=False)
    ]
    return text, formula_of(letter_of(color, channel).equals(first_of(terms, MOST)))


@explains("resolve.areas.samples")
def pieces(step: StepValues) -> Said:
    """The pieces of a pixel and their areas."""
    areas, triangles = step.vector("sample_weights"), step.vector("sample_triangle")
    parts = [(area, int(triangle)) for area, triangle in zip(areas, triangles, strict=True) if area > 0]
    covered = sum(area for area, triangle in parts if triangle >= 0)
    made = "it is one piece" if len(parts) == 1 else f"edges cut it into {len(parts)} pieces"
    text = f"{step.pixel_name}: {made}, and {step.nouns.many} cover {spoken(covered)} of its area"
    if step.has("untold_cuts"):
        text += f"; to step through the cuts, trace one {step.nouns.one} or a smaller part of the picture"
    return f"{text}.", _together(step, "A", "A")


@explains("resolve.areas.divide")
def summed(step: StepValues) -> Said:
    """The sum of areas times colours."""
    channel, color = _channel(step), step.vector("linear")
    text = (
        f"{step.pixel_name}: the colours of its pieces, each times its area, add up to {vector_text(color)}, "
        "in linear light."
    )
    letter = CHANNEL_LETTERS[channel]
    terms = [
        named(f"A_{name}", area) * named(f"{letter}_{name}", value)
        for name, (area, value) in zip(NAMES, _weights(step), strict=False)
    ]
    return text, formula_of(letter_of(color, channel).equals(first_of(terms, MOST)))


@explains("resolve.*.clip")
def clipped(step: StepValues) -> Said:
    """Colours clamped to 0 to 1."""
    linear, clamped = step.vector("linear"), step.vector("clipped")
    shown, result = vector_text(linear), vector_text(clamped)
    text = f"the linear colour {result} is between 0 and 1 already"
    if any(map(math.isnan, linear)):
        text = f"the colour {shown} has a NaN, which is shown as 0: {result}"
    elif min(linear[:3]) < 0 or max(linear[:3]) > 1:
        text = f"the colour {shown} is clamped to 0 to 1: {result}"
    channel = outstanding(clamped)
    limited = call("min", call("max", letter_of(linear, channel), 0), 1)
    made = named(f"c_{CHANNEL_LETTERS[channel]}", clamped[channel]).equals(limited)
    return f"{step.pixel_name}: {text}{remainder_note(clamped)}.", formula_of(made)


@explains("resolve.*.encode")
def encoded(step: StepValues) -> Said:
    """The sRGB curve, the part that the value is on."""
    color, clamped = step.vector("encoded"), step.vector("clipped")
    text = f"{step.pixel_name}: the sRGB curve turns the linear colour into {vector_text(color)}"
    text += f"{remainder_note(color)}."
    channel = outstanding(clamped)
    letter = CHANNEL_LETTERS[channel]
    s, c = named(f"s_{letter}", color[channel]), named(f"c_{letter}", clamped[channel])
    if c.value <= SRGB_LIMIT:
        return text, formula_of(s.equals(SRGB_SLOPE * c))
    return text, formula_of(s.equals(SRGB_SCALE * c ** slash(1, 2.4) - SRGB_OFFSET))


def red_byte(step: StepValues) -> Asked | None:
    """Ask for the byte of red."""
    byte = step.vector("bytes")[0]
    return number(f"Which byte does red become at {step.the_pixel}?", byte, f"red is {int(byte)}.")


@explains("resolve.*.round", asks=red_byte)
def rounded(step: StepValues) -> Said:
    """Display bytes."""
    *color, alpha = stored = step.vector("bytes")
    text = f"{step.pixel_name} is displayed as the bytes {vector_text(color)}, with alpha {spoken(alpha)}."
    channel = outstanding(step.vector("clipped"))
    s = named(f"s_{CHANNEL_LETTERS[channel]}", step.vector("encoded")[channel])
    return text, formula_of(in_channel("byte", stored, channel).equals(call("floor", 255 * s + HALF)))


shows(
    "resolve",
    {
        "samples": VariableText(
            "colour #", "Linear red, green, blue, alpha of the sample or piece.", spread="parts"
        ),
        "sample_weights": VariableText(
            "weight #", "Weight of the sample, or the area of the piece.", spread="parts"
        ),
        "linear": VariableText("linear", "Linear red, green, blue, alpha of the colour buffer."),
        "clipped": VariableText("c (clamped)", "Red, green, blue between 0 and 1."),
        "encoded": VariableText("s (sRGB)", "Red, green, blue on the sRGB curve."),
        "bytes": VariableText("bytes", "Red, green, blue, alpha from 0 to 255."),
    },
)
