"""Lines with intensities (Wu, Gupta-Sproull), rectangles, and the blending of both."""

import math

from core.explain.formulas import HALF, Chain, call, formula_of, named
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, number
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.lines.told_setup import MAJOR, MINOR, axes, line_method
from core.records.terms import Term, term
from core.records.words import counted


def _name(step: StepValues) -> str:
    column, row = step.pixel
    return f"pixel ({column}, {row})"


@explains("raster.rectangle-start.length")
def rectangle_length(step: StepValues) -> Said:
    """The length of a rectangle."""
    run, rise, length = step.number("run"), step.number("rise"), step.named("length", "L")
    text = (
        f"The ends, snapped to 1/256 pixel, are {spoken(run)} and {spoken(rise)} apart along the axes, so the "
        f"rectangle is {length} px long and reaches half a pixel to either side."
    )
    dx, dy = map(named, ("dx", "dy"), (rise, run) if step.flag("is_steep") else (run, rise))
    return text, formula_of(length.equals(call("sqrt", dx**2 + dy**2)))


def away(step: StepValues) -> Asked | None:
    """Ask how far a centre is from the line."""
    found = abs(step.number("decision"))
    return number(
        f"How many pixels is the centre of {_name(step)} away from the line?",
        found,
        f"It is {spoken(found)} px away, not more than 0.5: inside the rectangle.",
    )


@explains("raster.rectangle|rectangle-start.across", asks=away, decides=True)
def across(step: StepValues) -> Said:
    """The distance from the line, between the long sides."""
    a, away = step.named("decision", "a"), step.number("decision")
    text = f"The centre of {_name(step)} is {spoken(abs(away))} px to the {'left' if away > 0 else 'right'} of the line"
    if away == 0:
        text = f"The centre of {_name(step)} lies on the line, so it is between the rectangle's long sides."
    elif step.flag("is_tie"):
        text += ", exactly on a long side of the rectangle, which owns it by the tie rule."
    else:
        text += ", not more than 0.5, so it is between the rectangle's long sides."
    (x0, y0), (x1, y1) = step.vector("first_end"), step.vector("second_end")
    x, y = map(named, "xy", step.pixel)
    dx, dy = named("(x_1 - x_0)", x1 - x0), named("(y_1 - y_0)", y1 - y0)
    product = dx @ (y - named("y_0", y0)) - dy @ (x - named("x_0", x0))
    within = Chain((-HALF, a, HALF), (r"\le", r"\le"))
    return text, formula_of(within, a.equals(product / step.named("length", "L")))


@explains("raster.rectangle|rectangle-start.along")
def along(step: StepValues) -> Said:
    """The position along the line, between the short sides."""
    place, length = step.named("along", "s"), step.named("length", "L")
    text = f"It is {place} px along the line, between the short sides at 0 and {length}."
    return text, formula_of(Chain((term(0), place, length), (r"\le", "<")))


@explains("raster.*.share")
def share(step: StepValues) -> Said:
    """How much of a column the line spans."""
    part, x = step.named("share", "g"), step.named("major", MAJOR)
    word = "row" if step.flag("is_steep") else "column"
    text = f"The line ends in this {word} and spans {part} of it, which scales the intensities."
    if part.value == 1:
        text = f"The line spans the whole {word}."
    k = int(step.flag("is_steep"))
    ends = sorted((step.vector("first_end")[k], step.vector("second_end")[k]))
    low, high = (
        named(rf"{MAJOR}_{{\{bound}}}", end) for bound, end in zip(("min", "max"), ends, strict=True)
    )
    return text, formula_of(part.equals(call("min", x + HALF, high) - call("max", x - HALF, low)))


def intensity(step: StepValues) -> Asked | None:
    """Ask for the intensity of a pixel by Wu."""
    line, part, found = step.number("decision"), step.number("share"), step.number("intensity")
    (major, minor), at = axes(step), step.number("major")
    word = "row" if step.flag("is_steep") else "column"
    spans = "" if part == 1 else f" and spans {spoken(part)} of the {word}"
    return number(
        f"At {major} = {spoken(at)} the line has {minor} = {spoken(line)}{spans}. "
        f"Which intensity does {_name(step)} get?",
        found,
        f"The intensity is {spoken(found)}.",
    )


@explains("raster.*.pixel")
def pixel_of_column(step: StepValues) -> Said:
    """Which pixel of the column is looked at."""
    minor, line, is_wu = step.number("minor"), step.number("decision"), line_method(step) == "wu"
    y = step.named("decision", MINOR)
    first = math.floor(line) if is_wu else math.floor(line) + (line - math.floor(line) >= 0.5)
    sides = ("to the left of", "to the right of") if step.flag("is_steep") else ("below", "above")
    what = f"the next one {sides[minor > first]}" if minor != first else "the nearest to the line"
    if is_wu:
        what = f"{sides[minor > first]} the line" if minor != line else "on the line"
    pixel: Term = call("floor", y if is_wu else y + HALF)
    if minor != first:
        pixel = pixel + 1 if minor > first else pixel - 1
    return f"{_name(step).capitalize()} is {what}.", formula_of(named("Y", minor).equals(pixel))


@explains("raster.*.fraction")
def fraction_of_way(step: StepValues) -> Said:
    """How far the line passes from the lower pixel to the upper one."""
    (_, axis), y, part = axes(step), step.named("decision", MINOR), step.named("fraction", "f")
    below = math.floor(y.value)
    text = f"The line passes {part} of the way from {axis} = {spoken(below)} to {axis} = {spoken(below + 1)}."
    return text, formula_of(part.equals(y - call("floor", y)))


@explains("raster.*.divide", asks=intensity, decides=True)
def divided(step: StepValues) -> Said:
    """The intensity by Wu."""
    part, found, of_column = step.number("fraction"), step.number("intensity"), step.number("share")
    # The lower (steep: left) one of the two pixels that the line passes between.
    is_lower = step.number("minor") <= step.number("decision")
    law = f"1 − {spoken(part)}" if is_lower else spoken(part)
    scaled = "" if of_column == 1 else f" times the weight {spoken(of_column)}"
    result = "" if not is_lower and not scaled else f" = {spoken(found)}"
    text = f"{_name(step).capitalize()} gets the intensity {law}{scaled}{result}."
    f = step.named("fraction", "f")
    return text, formula_of(named("I", found).equals((1 - f if is_lower else f) * named("g", of_column)))


@explains("raster.*.cosine")
def line_cosine(step: StepValues) -> Said:
    """The cosine of the line's angle with its longer axis."""
    (_, axis), cosine, m = axes(step), step.named("cosine", "c"), step.named("slope", "m")
    text = f"A distance from the line is {cosine}, the cosine of the line's angle, times that along {axis}."
    return text, formula_of(cosine.equals(1 / call("sqrt", 1 + m**2)))


@explains("raster.*.distance", decides=True)
def distance(step: StepValues) -> Said:
    """The distance of a pixel's centre from the line."""
    (_, axis), pixel, y = axes(step), step.named("minor", "Y"), step.named("decision", MINOR)
    found = step.named("line_distance", "d")
    text = (
        f"The centre of {_name(step)} is {spoken(abs(pixel.value - y.value))} from the line along {axis}, which "
        f"gives a distance of {found} px."
    )
    return text, formula_of(found.equals(call("abs", pixel - y) * step.named("cosine", "c")))


def nearest_entry(step: StepValues) -> Asked | None:
    """Ask for the entry of the filter's table."""
    entry, found = step.number("entry"), step.number("line_distance")
    return number(
        f"The centre of {_name(step)} is {spoken(found)} px from the line. At how many sixteenths of a pixel does the "
        "filter's table have its value?",
        entry,
        f"The nearest entry is at {counted(int(entry), 'sixteenth')}.",
    )


@explains("raster.*.entry", asks=nearest_entry)
def entry_of_table(step: StepValues) -> Said:
    """Where the filter's table is looked up."""
    entry, d = step.upright("entry"), step.named("line_distance", "d")
    text = (
        f"The nearest entry of the filter's table is at {counted(int(entry.value), 'sixteenth')} of a pixel."
    )
    return text, formula_of(entry.equals(call("floor", term(16) @ d + HALF)))


@explains("raster.*.look-up")
def looked_up(step: StepValues) -> Said:
    """The value in the filter's table."""
    value = step.named("filtered", "T")
    return f"There the filter's table has {value}.", formula_of(value)


@explains("raster.*.filter")
def filtered(step: StepValues) -> Said:
    """The intensity by the filter's table."""
    of_column, found = step.named("share", "g"), step.named("intensity", "I")
    text = f"{_name(step).capitalize()} gets the intensity {found}, the value of the table."
    if of_column.value != 1:
        text = f"{_name(step).capitalize()} gets {of_column} of it, the intensity {found}."
    return text, formula_of(found.equals(step.named("filtered", "T") * of_column))


@explains("blend.*.weigh")
def weighed(step: StepValues) -> Said:
    """Alpha scaled by the line's intensity."""
    alpha, intensity = named(r"a_{\mathrm{shaded}}", step.vector("color")[3]), step.named("intensity", "I")
    source = named(r"a_{\mathrm{source}}", step.vector("source")[3])
    text = (
        f"{step.pixel_name}: the line's intensity {intensity} scales the alpha {alpha} of its colour "
        f"to {source}, to be blended with {vector_text(step.vector('before'))}."
    )
    return text, formula_of(source.equals(alpha * intensity))


shows(
    "raster",
    {
        "along": VariableText("s", "Position of the pixel's centre along the line, in pixels."),
        "cosine": VariableText(
            "c (cosine)", "Factor from a distance along the minor axis to the distance from the line."
        ),
        "share": VariableText("g (share)", "Part of the pixel's column or row that the line spans."),
        "fraction": VariableText(
            "f", "Position of the line between the lower pixel (0) and the upper one (1)."
        ),
        "line_distance": VariableText("d", "Distance of the pixel's centre from the line, in pixels."),
        "entry": VariableText("entry", "Index in the filter's table: the distance in sixteenths of a pixel."),
        "filtered": VariableText("T", "The filter's value at this distance."),
        "intensity": VariableText("I", "Intensity: fraction of the line's colour that the pixel gets."),
    },
)
