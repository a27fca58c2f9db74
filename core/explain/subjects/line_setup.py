"""What a line method computes before its first pixel: lengths, ways, slope, and the first sum."""

import ast

from core.explain.digits import number_latex, spoken, vector_text
from core.explain.equation import (
    Part,
    beside,
    conclusion,
    difference,
    equation,
    fraction,
    relation,
)
from core.explain.listed_code import (
    assignment,
    code_of,
    used_values,
)
from core.explain.records import Asked, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.subjects.line_names import (
    MAJOR,
    MINOR,
    axes,
    is_swapped,
    line_method,
    sum_name,
)
from core.explain.variable_text import given, shows
from core.raster.lines.traits import line_traits
from core.records.words import counted, joined


def listed_ends(step: StepValues) -> tuple[list[float], list[float]]:
    """Return both ends as the listing has them after its swaps."""
    first, second = step.vector("first_end"), step.vector("second_end")
    if is_swapped(step):
        first, second = first[::-1], second[::-1]
    return (second, first) if is_reversed(step) else (first, second)


def is_reversed(step: StepValues) -> bool:
    """Return whether the listing has swapped the ends."""
    k = int(step.flag("is_steep"))
    is_backward = step.vector("second_end")[k] < step.vector("first_end")[k]
    return line_traits(line_method(step)).swaps_ends and is_backward


@explains("raster.*.octant")
def octant(step: StepValues) -> Said:
    """Where an edge runs, and along which axis it is longer."""
    run, rise, is_steep = step.number("run"), step.number("rise"), step.flag("is_steep")
    traits, major = line_traits(line_method(step)), "y" if is_steep else "x"
    first, second = vector_text(step.vector("window_start")), vector_text(step.vector("window_end"))
    if traits.takes_pixels:
        first, second = (f"pixel {vector_text(step.vector(name))}" for name in ("first_end", "second_end"))
    name = f"Edge {step.whole('edge')} of triangle {step.triangle}"
    text = f"{name} runs from {first} to {second}"
    steps = "row by row" if is_steep else "column by column"
    level = "as long in x as in y" if run == rise else f"longer in {major}"
    swapped = "x and y are swapped and " if is_swapped(step) else ""
    end = f": it is {level}, so {swapped}it is drawn {steps}."
    if run == 0:
        end = ", so it has no length on the raster."
        text = f"{name} begins and ends in {first}" if traits.takes_pixels else text
    wanted = r"\ge" if traits.is_diagonal_steep else ">"
    in_x, in_y = (rise, run) if is_steep else (run, rise)
    return text + end, equation(
        ("|y_1 - y_0|", in_y),
        (wanted, relation(in_y, in_x)),
        ("|x_1 - x_0|", in_x),
        *conclusion("row by row", steps),
    )


@explains("raster.*.lengths")
def lengths(step: StepValues) -> Said:
    """The lengths along both axes."""
    major, minor = axes(step)
    (x0, y0), (x1, y1) = listed_ends(step)
    dx, dy = step.number("dx"), step.number("dy")
    text = f"The line goes {counted(int(dx), 'pixel')} along {major} and {spoken(dy)} along {minor}."
    bar = "|" if "abs" in ast.unparse(code_of(step) or ast.Pass()) else ""
    made: list[list[Part]] = []
    for axis, found, first, second in ((MAJOR, dx, x0, x1), (MINOR, dy, y0, y1)):
        symbols, numbers = difference((f"{axis}_1", second), (f"{axis}_0", first))
        made.append([(f"d{axis}", found), "=", (f"{bar}{symbols}{bar}", f"{bar}{numbers}{bar}")])
    return text, equation(*beside(*made))


@explains("raster.*.directions")
def directions(step: StepValues) -> Said:
    """The way in which the listing goes along the axes."""
    ways: list[str] = []
    made: list[list[Part]] = []
    for k, (axis, symbol) in enumerate(zip(axes(step), (MAJOR, MINOR), strict=True)):
        if f"s{symbol}" in step.explanation.changed:
            value, (first, second) = step.number(f"s{symbol}"), listed_ends(step)
            ways.append(f"{axis} {'grows' if value > 0 else 'falls'} by 1")
            compared: list[Part] = [
                (f"{symbol}_1", second[k]),
                (r"\ge", relation(second[k], first[k])),
                (f"{symbol}_0", first[k]),
            ]
            made.append([*compared, r"\Rightarrow", (f"s{symbol}", value)])
    text = f"From the first end to the second, {', and '.join(ways)}{' where it steps' * (len(ways) > 1)}."
    return text, equation(*beside(*made))


@explains("raster.*.start")
def started(step: StepValues) -> Said:
    """Where the line begins."""
    (major, minor), ((x0, y0), _) = axes(step), listed_ends(step)
    x = step.number("major")
    if "minor" not in step.explanation.changed:
        side, bracket = ("before", "ceil") if step.number("sx") > 0 else ("after", "floor")
        text = f"The line starts at {major} = {spoken(x)}, the first whole number not {side} {spoken(x0)}."
        whole = (rf"\l{bracket} {MAJOR}_0 \r{bracket}", rf"\l{bracket} {number_latex(x0)} \r{bracket}")
        return text, equation((MAJOR, x), "=", whole)
    swapped = f", its second end, so that {major} grows" if is_reversed(step) else ""
    text = f"The line starts at {major} = {spoken(x)} and {minor} = {spoken(y0)}{swapped}."
    return text, equation(
        *beside([(MAJOR, x), "=", (f"{MAJOR}_0", x0)], [(MINOR, y0), "=", (f"{MINOR}_0", y0)])
    )


def starting_sum(step: StepValues) -> Asked | None:
    """Ask for the first value of the sum, where it is computed."""
    name, (made, computed, value) = sum_name(step), assignment(step)
    if len(made) == 3:
        return None
    known = joined([f"{symbol} = {spoken(number)}" for symbol, number in used_values(step).items()])
    return number(
        f"With {known}, what is the first {name}?",
        value,
        f"The first {name} is {computed} = {spoken(value)}.",
    )


@explains("raster.*.first-sum", asks=starting_sum)
def first_sum(step: StepValues) -> Said:
    """The first value of the sum that decides."""
    name, (made, computed, value) = sum_name(step), assignment(step)
    return f"The first {name} is {amount(computed, value)}.", equation(*made)


def amount(computed: str, value: float) -> str:
    """Return what was computed, and its number."""
    return spoken(value) if computed[0].isdigit() and " " not in computed else f"{computed} = {spoken(value)}"


@explains("raster.bresenham-float-start|bresenham-float-off.slope")
def error_slope(step: StepValues) -> Said:
    """The slope that is added to the error."""
    if "d" not in ast.unparse(code_of(step) or ast.Pass()):
        return line_slope(step)
    _, minor = axes(step)
    run, rise, m = (step.number(name) for name in ("run", "rise", "slope"))
    bars = fraction((f"d{MINOR}", rise), (f"d{MAJOR}", max(run, 1.0)))
    text = f"The slope m is {spoken(rise)} / {spoken(run)} = {spoken(m)}, the change along {minor} with every pixel."
    return text, equation(("m", m), "=", bars)


@explains("raster.*.slope")
def line_slope(step: StepValues) -> Said:
    """The slope of the line."""
    m, (_, minor) = step.number("slope"), axes(step)
    text = f"The slope m is {spoken(m)}, the change along {minor} for every 1 along {axes(step)[0]}."
    (x0, y0), (x1, y1) = listed_ends(step)
    above = difference((f"{MINOR}_1", y1), (f"{MINOR}_0", y0))
    below = difference((f"{MAJOR}_1", x1), (f"{MAJOR}_0", x0))
    quotient: list[Part] = ["=", fraction(above, below)] if x0 != x1 else []
    return text, equation(("m", m), *quotient)


@explains("raster.*.intercept")
def line_intercept(step: StepValues) -> Said:
    """The equation of the line."""
    m, b, ((x0, y0), _) = step.number("slope"), step.number("intercept"), listed_ends(step)
    swapped = ", where x counts rows" if is_swapped(step) else ""
    text = (
        f"With pixel centres at whole numbers the line is "
        f"{MINOR} = {spoken(m)} · {MAJOR} {'−' if b < 0 else '+'} {spoken(abs(b))}{swapped}."
    )
    return text, equation(("b", b), "=", (f"{MINOR}_0", y0), "-", ("m", m), r"\cdot", (f"{MAJOR}_0", x0))


@explains("raster.*.skip")
def skipped(step: StepValues) -> Said:
    """The pixels of a line before the first one on the raster."""
    word = "row" if step.flag("is_steep") else "column"
    count = step.whole("skipped")
    noun = f"first {word} lies" if count == 1 else f"first {count} {word}s lie"
    return f"The line's {noun} outside the raster, so the steps shown begin after {'it' if count == 1 else 'them'}."


def column_of_point(step: StepValues) -> Asked | None:
    """Ask for the column of the pixel that contains a point."""
    x, column = step.vector("window_start")[0], step.whole("column")
    text = f"Point {step.triangle} has x = {spoken(x)}. In which column is its pixel?"
    return number(text, column, f"x = {spoken(x)} lies in column {column}.")


@explains("raster.point.pixel", asks=column_of_point, decides=True)
def pixel_of_point(step: StepValues) -> Said:
    """The pixel that contains a point."""
    x, y = step.vector("window_start")
    column, row = step.whole("column"), step.whole("row")
    text = f"Point {step.triangle} at {vector_text([x, y])} lies in pixel ({column}, {row})"
    center = step.number("center")
    if 0.5 in (column + center - x, row + center - y):
        text += ", as the left and the lower border of a pixel belong to it"
    found: list[list[Part]] = []
    for name, found_at, axis, at in (("column", column, "x", x), ("row", row, "y", y)):
        inside = f"{axis} - c", f"{number_latex(at)} - {number_latex(center)}"
        symbols, numbers = (rf"\lfloor {of} + \frac{{1}}{{2}} \rfloor" for of in inside)
        found.append([(rf"\mathrm{{{name}}}", float(found_at)), "=", (symbols, numbers)])
    return f"{text}.", equation(*beside(*found))


@explains("raster.point.plot")
def point_drawn(step: StepValues) -> Said:
    """The pixel of a point is drawn."""
    return f"{step.pixel_name} is drawn: it contains point {step.triangle}."


shows(
    "raster.point",
    {
        "window_start": given("x, y", "The point in the window, in pixels."),
        "center": given("c", "Where a pixel's centre lies from its number: 0.5, or 0."),
    },
)
