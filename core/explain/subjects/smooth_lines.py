"""Lines with intensities (Wu, Gupta-Sproull), rectangles, and the blending of both."""

import math

from core.explain.digits import number_latex, signed_latex, spoken, vector_text
from core.explain.equation import Part, beside, difference, equation, fraction
from core.explain.records import Asked, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.subjects.line_names import MAJOR, MINOR, axes, line_method
from core.explain.variable_text import VariableText, shows
from core.records.words import counted

_HALF = r"\frac{1}{2}"


def _name(step: StepValues) -> str:
    column, row = step.pixel
    return f"pixel ({column}, {row})"


@explains("raster.rectangle-start.length")
def rectangle_length(step: StepValues) -> Said:
    """The length of a rectangle."""
    run, rise, length = (step.number(name) for name in ("run", "rise", "length"))
    text = (
        f"The ends, snapped to 1/256 pixel, are {spoken(run)} and {spoken(rise)} apart along the axes, so the "
        f"rectangle is {spoken(length)} px long and reaches half a pixel to either side."
    )
    x, y = map(number_latex, (rise, run) if step.flag("is_steep") else (run, rise))
    return text, equation(("L", length), "=", (r"\sqrt{dx^2 + dy^2}", rf"\sqrt{{{x}^2 + {y}^2}}"))


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
    away, length = step.number("decision"), step.number("length")
    text = f"The centre of {_name(step)} is {spoken(abs(away))} px to the {'left' if away > 0 else 'right'} of the line"
    if away == 0:
        text = f"The centre of {_name(step)} lies on the line, so it is between the rectangle's long sides."
    elif step.flag("is_tie"):
        text += ", exactly on a long side of the rectangle, which owns it by the tie rule."
    else:
        text += ", not more than 0.5, so it is between the rectangle's long sides."
    (x0, y0), (x1, y1) = step.vector("first_end"), step.vector("second_end")
    x, y = step.pixel
    from_y, of_y = difference(("y", y), ("y_0", y0))
    from_x, of_x = difference(("x", x), ("x_0", x0))
    products = (
        rf"(x_1 - x_0) ({from_y}) - (y_1 - y_0) ({from_x})",
        rf"{signed_latex(x1 - x0)} \cdot ({of_y}) - {signed_latex(y1 - y0)} \cdot ({of_x})",
    )
    within: list[Part] = [f"-{_HALF}", r"\le", ("a", away), r"\le", _HALF]
    return text, equation(*beside(within, [("a", away), "=", fraction(products, ("L", length))]))


@explains("raster.rectangle|rectangle-start.along")
def along(step: StepValues) -> Said:
    """The position along the line, between the short sides."""
    place, length = step.number("along"), step.number("length")
    text = f"It is {spoken(place)} px along the line, between the short sides at 0 and {spoken(length)}."
    return text, equation("0", r"\le", ("s", place), "<", ("L", length))


@explains("raster.*.share")
def share(step: StepValues) -> Said:
    """How much of a column the line spans."""
    part, at = step.number("share"), number_latex(step.number("major"))
    word = "row" if step.flag("is_steep") else "column"
    text = f"The line ends in this {word} and spans {spoken(part)} of it, which scales the intensities."
    if part == 1:
        text = f"The line spans the whole {word}."
    k = int(step.flag("is_steep"))
    low, high = sorted((step.vector("first_end")[k], step.vector("second_end")[k]))
    symbols = rf"\min({MAJOR} + {_HALF}, {MAJOR}_{{\max}}) - \max({MAJOR} - {_HALF}, {MAJOR}_{{\min}})"
    numbers = rf"\min({at} + {_HALF}, {number_latex(high)}) - \max({at} - {_HALF}, {number_latex(low)})"
    return text, equation(("g", part), "=", (symbols, numbers))


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
    first = math.floor(line) if is_wu else math.floor(line) + (line - math.floor(line) >= 0.5)
    sides = ("to the left of", "to the right of") if step.flag("is_steep") else ("below", "above")
    what = f"the next one {sides[minor > first]}" if minor != first else "the nearest to the line"
    if is_wu:
        what = f"{sides[minor > first]} the line" if minor != line else "on the line"
    half = "" if is_wu else f" + {_HALF}"
    symbols, numbers = (rf"\lfloor {text}{half} \rfloor" for text in (MINOR, number_latex(line)))
    more: list[Part] = [] if minor == first else ["+" if minor > first else "-", "1"]
    text = f"{_name(step).capitalize()} is {what}."
    return text, equation(("Y", minor), "=", (symbols, numbers), *more)


@explains("raster.*.fraction")
def fraction_of_way(step: StepValues) -> Said:
    """How far the line passes from the lower pixel to the upper one."""
    (_, axis), line, part = axes(step), step.number("decision"), step.number("fraction")
    below = math.floor(line)
    text = f"The line passes {spoken(part)} of the way from {axis} = {spoken(below)} to {axis} = {spoken(below + 1)}."
    shown = number_latex(line)
    made: Part = (rf"{MINOR} - \lfloor {MINOR} \rfloor", rf"{shown} - \lfloor {shown} \rfloor")
    return text, equation(("f", part), "=", made)


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
    shown: Part = ("(1 - f)", f"(1 - {number_latex(part)})") if is_lower else ("f", part)
    return text, equation(("I", found), "=", shown, r"\cdot", ("g", of_column))


@explains("raster.*.cosine")
def line_cosine(step: StepValues) -> Said:
    """The cosine of the line's angle with its longer axis."""
    (_, axis), cosine, m = axes(step), step.number("cosine"), signed_latex(step.number("slope"))
    text = f"A distance from the line is {spoken(cosine)}, the cosine of the line's angle, times that along {axis}."
    below = (r"\sqrt{1 + m^2}", rf"\sqrt{{1 + {m}^2}}")
    return text, equation(("c", cosine), "=", fraction(("1", 1.0), below))


@explains("raster.*.distance", decides=True)
def distance(step: StepValues) -> Said:
    """The distance of a pixel's centre from the line."""
    (_, axis), minor, line = axes(step), step.number("minor"), step.number("decision")
    found = step.number("line_distance")
    text = (
        f"The centre of {_name(step)} is {spoken(abs(minor - line))} from the line along {axis}, which gives a "
        f"distance of {spoken(found)} px."
    )
    apart = (rf"|Y - {MINOR}|", f"|{number_latex(minor)} - {signed_latex(line)}|")
    return text, equation(("d", found), "=", apart, r"\cdot", ("c", step.number("cosine")))


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
    entry, found = step.number("entry"), step.number("line_distance")
    text = f"The nearest entry of the filter's table is at {counted(int(entry), 'sixteenth')} of a pixel."
    made = (rf"\lfloor 16 d + {_HALF} \rfloor", rf"\lfloor 16 \cdot {number_latex(found)} + {_HALF} \rfloor")
    return text, equation((r"\mathrm{entry}", entry), "=", made)


@explains("raster.*.look-up")
def looked_up(step: StepValues) -> Said:
    """The value in the filter's table."""
    value = step.number("filtered")
    return f"There the filter's table has {spoken(value)}.", equation(("T", value))


@explains("raster.*.filter")
def filtered(step: StepValues) -> Said:
    """The intensity by the filter's table."""
    value, of_column, found = (step.number(name) for name in ("filtered", "share", "intensity"))
    text = f"{_name(step).capitalize()} gets the intensity {spoken(found)}, the value of the table."
    if of_column != 1:
        text = f"{_name(step).capitalize()} gets {spoken(of_column)} of it, the intensity {spoken(found)}."
    return text, equation(("I", found), "=", ("T", value), r"\cdot", ("g", of_column))


@explains("blend.*.weigh")
def weighed(step: StepValues) -> Said:
    """Alpha scaled by the line's intensity."""
    alpha, intensity, source = step.vector("color")[3], step.number("intensity"), step.vector("source")[3]
    text = (
        f"{step.pixel_name}: the line's intensity {spoken(intensity)} scales the alpha {spoken(alpha)} of its colour "
        f"to {spoken(source)}, to be blended with {vector_text(step.vector('before'))}."
    )
    product = (r"a_{\mathrm{shaded}}", alpha), r"\cdot", ("I", intensity)
    return text, equation((r"a_{\mathrm{source}}", source), "=", *product)


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
