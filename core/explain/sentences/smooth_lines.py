"""What is said while lines with intensities, and rectangles, are drawn and blended: one sentence for every key."""

from collections.abc import Callable, Mapping

from core.explain.number_text import counted, spoken, vector_text
from core.explain.sentences.pixel import SENTENCES as PIXEL_SENTENCES
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import StepValues

LINE_BLENDS = tuple(
    key for key in PIXEL_SENTENCES if key.startswith("blend.") and not key.startswith("blend.opaque.")
)
"""What blending does with any fragment; opaque lines with intensities are blended over."""


def column_word(step: StepValues) -> str:
    """Return what the line has pixels in, step by step."""
    return "row" if step.flag("is_steep") else "column"


def minor_axis(step: StepValues) -> str:
    """Return the name of the line's shorter axis."""
    return "x" if step.flag("is_steep") else "y"


def rectangle_length(step: StepValues) -> str:
    """The length of a rectangle."""
    run, rise = spoken(step.number("run")), spoken(step.number("rise"))
    return (
        f"The ends, snapped to 1/256 pixel, are {run} and {rise} apart along the axes, so the rectangle is "
        f"{spoken(step.number('length'))} px long and reaches half a pixel to either side."
    )


def across(step: StepValues) -> str:
    """The distance from the line that the rectangle is around."""
    away = step.number("decision")
    if away == 0:
        return f"The centre of {_name(step)} lies on the line, so it is between the rectangle's long sides."
    side = "left" if away > 0 else "right"
    text = f"The centre of {_name(step)} is {spoken(abs(away))} px to the {side} of the line"
    if step.flag("is_tie"):
        return f"{text}, exactly on a long side of the rectangle, which owns it by the tie rule."
    return f"{text}, not more than 0.5, so it is between the rectangle's long sides."


def along(step: StepValues) -> str:
    """The place along the line."""
    place, length = spoken(step.number("along")), spoken(step.number("length"))
    return f"It is {place} px along the line, between the short sides at 0 and {length}."


def share(step: StepValues) -> str:
    """How much of a column the line spans."""
    word, part = column_word(step), step.number("share")
    if part == 1:
        return f"The line spans the whole {word}."
    return f"The line ends in this {word} and spans {spoken(part)} of it: the intensities are scaled by that."


def divided(step: StepValues) -> str:
    """The intensity by Wu."""
    fraction, minor = step.number("fraction"), step.whole("minor")
    axis, is_lower = minor_axis(step), _is_lower(step)
    below = minor if is_lower else minor - 1
    part = f"1 − {spoken(fraction)}" if is_lower else spoken(fraction)
    scaled = "" if step.number("share") == 1 else f" times the share {spoken(step.number('share'))}"
    result = "" if not is_lower and not scaled else f" = {spoken(step.number('intensity'))}"
    return (
        f"The line passes {spoken(fraction)} of the way from {axis} = {spoken(below)} to {axis} = {spoken(below + 1)}, "
        f"so {_name(step)} gets the intensity {part}{scaled}{result}."
    )


def line_cosine(step: StepValues) -> str:
    """From distances along an axis to distances from the line."""
    axis = minor_axis(step)
    return f"A distance from the line is {spoken(step.number('cosine'))} of that along {axis}: the cosine of its angle."


def distance(step: StepValues) -> str:
    """The distance of a pixel's centre from the line."""
    apart = abs(step.number("minor") - step.number("decision"))
    return (
        f"The centre of {_name(step)} is {spoken(apart)} from the line along {minor_axis(step)}, which makes a "
        f"distance of {spoken(step.number('line_distance'))} px."
    )


def filtered(step: StepValues) -> str:
    """The intensity by the filter's table."""
    entry, value = counted(step.whole("entry"), "sixteenth"), spoken(step.number("filtered"))
    text = f"The table has {value} for the nearest distance in it, {entry} of a pixel"
    if step.number("share") == 1:
        return f"{text}: this is the intensity of {_name(step)}."
    scaled = f"{spoken(step.number('share'))} of it is {spoken(step.number('intensity'))}"
    return f"{text}: {scaled}, the intensity of {_name(step)}."


def weighed(step: StepValues) -> str:
    """Alpha scaled by the line's intensity."""
    alpha, intensity = step.vector("color")[3], step.number("intensity")
    return (
        f"{pixel_name(step)}: the line's intensity {spoken(intensity)} scales the alpha {spoken(alpha)} of its colour "
        f"to {spoken(step.vector('source')[3])}, to be blended with {vector_text(step.vector('before'))}."
    )


def _name(step: StepValues) -> str:
    column, row = step.pixel
    return f"pixel ({column}, {row})"


def _is_lower(step: StepValues) -> bool:
    """Tell whether the pixel is the lower (steep: left) one of the two that the line passes between."""
    return step.number("minor") <= step.number("decision")


RECTANGLE: Mapping[str, Callable[[StepValues], str]] = {"across": across, "along": along}
WU: Mapping[str, Callable[[StepValues], str]] = {"share": share, "divide": divided}
GUPTA_SPROULL: Mapping[str, Callable[[StepValues], str]] = {
    "share": share,
    "distance": distance,
    "filter": filtered,
}

BLEND_SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **{key.replace("blend.", "blend.line-"): PIXEL_SENTENCES[key] for key in LINE_BLENDS},
    **{f"blend.line-{key.split('.')[1]}.weigh": weighed for key in LINE_BLENDS},
}
"""Sentences of blending where the fragment is a line's: weighed first, then as any other."""
