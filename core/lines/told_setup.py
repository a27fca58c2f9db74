"""What a line method computes before its first pixel, and what its numbers are called, told step by step."""

import ast

from core.explain.formulas import HALF, Conclusion, Named, call, concludes, formula_of, named
from core.explain.listed_code import assigned_name, assignment, code_of, symbols
from core.explain.listed_code import tested as tested_by
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, number
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.lines.line_method import OFF, line_of_kind, line_traits, minor_name
from core.methods import table
from core.records.terms import Leaf, Term
from core.records.words import counted, joined

# What the numbers of a line are called: as in its listing, which swaps x and y of a steep line.


def line_method(step: StepValues) -> str:
    """Return the line method of a row."""
    return line_of_kind(step.kind)


def is_swapped(step: StepValues) -> bool:
    """Return whether the listing has swapped x and y for a steep line."""
    line = line_method(step)
    is_steep = bool(step.explanation.values.get("is_steep", False))
    return is_steep and line in table.names("line") and line_traits(line).swaps_axes


MAJOR, MINOR = "x", "y"
"""Symbols, as in the listings, of the longer axis of the line and of the other: of a steep line x and y are swapped."""


def axes(step: StepValues) -> tuple[str, str]:
    """Return in words the longer axis of the line and the other: their symbols, and what they count if swapped."""
    return ("x (the row)", "y (the column)") if is_swapped(step) else (MAJOR, MINOR)


DECISIONS = {"rectangle": "a", "diamond-exit": f"{MINOR} − {MINOR} centre"}
"""Symbol of the number that chooses the pixel, where no test of the listing has it."""


def decision_name(step: StepValues) -> str:
    """Return the formula's symbol of the number that chooses the pixel: what is tested, or the line's y."""
    test = tested_by(code_of(step, "test"))
    return symbols(test.left) if test else DECISIONS.get(line_method(step), MINOR)


def sum_name(step: StepValues) -> str:
    """Return the symbol of the sum that a method adds up from pixel to pixel."""
    return assigned_name(code_of(step, "advance")) or MINOR


def _major_name(step: StepValues) -> str:
    return "row" if is_swapped(step) else MAJOR


def _minor_name(step: StepValues) -> str:
    line = line_method(step)
    if line not in table.names("line"):
        return MINOR
    return "column" if is_swapped(step) else minor_name(line)


for _line in table.names("line"):
    _kinds = table.get("line", _line).operations
    if any("minor" in done.sets for kind in _kinds.values() for done in kind):
        # The listing's own x and y are the pixel, one step after the other.
        hides(f"raster.{'|'.join(_kinds)}", ("column", "row"))
    hides(f"raster.{_line}{OFF}", ("column", "row"))
_X = "Pixel along the longer axis of the line."
_Y = "Pixel along the other axis."
_SUM = "The sum that decides, from pixel to pixel."
shows(
    "raster",
    {
        "major_before": VariableText(_major_name, _X),
        "major": VariableText(_major_name, _X),
        "minor_before": VariableText(_minor_name, _Y),
        "minor": VariableText(_minor_name, _Y),
        "sum_before": VariableText(sum_name, _SUM),
        "decision": VariableText(decision_name, "The number whose sign or rounding chooses the pixel."),
        "sum_corrected": VariableText(sum_name, _SUM),
        "sum_advanced": VariableText(sum_name, _SUM),
        "first_end": VariableText("first end", "Start of the line, as the method uses it."),
        "second_end": VariableText("second end", "End of the line, as the method uses it."),
        "is_steep": VariableText("steep", "Whether y is the major axis: one pixel in every row."),
        "dx": VariableText("dx", "Length along x, without sign; a steep line has x and y swapped."),
        "dy": VariableText("dy", "Length along y, without sign; a steep line has x and y swapped."),
        "sx": VariableText("sx", "The way along x, 1 or −1; a steep line has x and y swapped."),
        "sy": VariableText("sy", "What is added to y where it steps; a steep line has x and y swapped."),
        "slope": VariableText("m", "Slope: change of the minor coordinate with every step."),
        "intercept": VariableText("b", "Intercept: minor coordinate where the major one is 0."),
        "has_stepped": VariableText("stepped", "Whether the minor coordinate changed."),
        "is_tie": VariableText("tie", "Whether the line passes exactly between two pixels."),
        "exit_start": VariableText(
            "d₀", "How far the first end is through the diamond: below 0.5 is inside."
        ),
        "exit_end": VariableText(
            "d₁", "How far the second end is through the diamond: 0.5 or more is outside."
        ),
        "length": VariableText(
            lambda step: "n" if step.kind == "lane-row" else "L", "Length of the span or line, in pixels."
        ),
        "t": VariableText("t", "Position along the line: 0 at the first end, 1 at the second."),
    },
)


# What a line method computes before its first pixel: lengths, ways, slope, and the first sum.


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
    name = step.edge_name.capitalize()
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
    longer = named("|y_1 - y_0|", in_y).compared(wanted, named("|x_1 - x_0|", in_x))
    return text + end, formula_of(concludes("row by row", steps, longer))


@explains("raster.*.lengths")
def lengths(step: StepValues) -> Said:
    """The lengths along both axes."""
    major, minor = axes(step)
    dx, dy = step.named("dx", "dx"), step.named("dy", "dy")
    text = f"The line goes {counted(int(dx.value), 'pixel')} along {major} and {dy} along {minor}."
    across, up = _extents(step)
    if "abs" in ast.unparse(code_of(step) or ast.Pass()):
        across, up = call("abs", across), call("abs", up)
    return text, formula_of(dx.equals(across), dy.equals(up))


def _named_ends(step: StepValues) -> tuple[tuple[Named, Named], ...]:
    """Return both ends as the listing has them: x and y of each with their symbols."""
    return tuple(
        (named(f"{MAJOR}_{end}", x), named(f"{MINOR}_{end}", y))
        for end, (x, y) in enumerate(listed_ends(step))
    )


def _extents(step: StepValues) -> tuple[Term, Term]:
    """Return how far the ends are apart along both axes."""
    (x0, y0), (x1, y1) = _named_ends(step)
    return x1 - x0, y1 - y0


@explains("raster.*.directions")
def directions(step: StepValues) -> Said:
    """The way in which the listing goes along the axes."""
    ways: list[str] = []
    made: list[Conclusion] = []
    for axis, symbol, first, second in zip(axes(step), (MAJOR, MINOR), *_named_ends(step), strict=True):
        if f"s{symbol}" in step.explanation.changed:
            way = step.named(f"s{symbol}", f"s{symbol}")
            ways.append(f"{axis} {'grows' if way.value > 0 else 'falls'} by 1")
            made.append(Conclusion((second.compared(r"\ge", first),), way))
    text = f"From the first end to the second, {', and '.join(ways)}{' where it steps' * (len(ways) > 1)}."
    return text, formula_of(*made)


@explains("raster.*.start")
def started(step: StepValues) -> Said:
    """Where the line begins."""
    (major, minor), ((x0, y0), _) = axes(step), _named_ends(step)
    x = step.named("major", MAJOR)
    if "minor" not in step.explanation.changed:
        side, rounding = ("before", "ceil") if step.number("sx") > 0 else ("after", "floor")
        text = f"The line starts at {major} = {x}, the first whole number not {side} {x0}."
        return text, formula_of(x.equals(call(rounding, x0)))
    swapped = f", its second end, so that {major} grows" if is_reversed(step) else ""
    text = f"The line starts at {major} = {x} and {minor} = {y0}{swapped}."
    return text, formula_of(x.equals(x0), named(MINOR, y0.value).equals(y0))


def starting_sum(step: StepValues) -> Asked | None:
    """Ask for the first value of the sum, where it is computed."""
    name, (made, computed, value) = sum_name(step), assignment(step)
    if isinstance(made.sides[1], Leaf):
        return None
    known = joined(
        sorted({f"{leaf.symbol} = {leaf}" for leaf in made.sides[1].every() if isinstance(leaf, Named)})
    )
    return number(
        f"With {known}, what is the first {name}?",
        value,
        f"The first {name} is {computed} = {spoken(value)}.",
    )


@explains("raster.*.first-sum", asks=starting_sum)
def first_sum(step: StepValues) -> Said:
    """The first value of the sum that decides."""
    name, (made, computed, value) = sum_name(step), assignment(step)
    return f"The first {name} is {amount(computed, value)}.", formula_of(made)


def amount(computed: str, value: float) -> str:
    """Return what was computed, and its number."""
    return spoken(value) if computed[0].isdigit() and " " not in computed else f"{computed} = {spoken(value)}"


@explains("raster.bresenham-float-start|bresenham-float-off.slope")
def error_slope(step: StepValues) -> Said:
    """The slope that is added to the error."""
    if "d" not in ast.unparse(code_of(step) or ast.Pass()):
        return line_slope(step)
    _, minor = axes(step)
    run, rise, m = step.number("run"), step.named("rise", f"d{MINOR}"), step.named("slope", "m")
    text = f"The slope m is {rise} / {spoken(run)} = {m}, the change along {minor} with every pixel."
    return text, formula_of(m.equals(rise / named(f"d{MAJOR}", max(run, 1.0))))


@explains("raster.*.slope")
def line_slope(step: StepValues) -> Said:
    """The slope of the line."""
    m, (major, minor), (run, rise) = step.named("slope", "m"), axes(step), _extents(step)
    text = f"The slope m is {m}, the change along {minor} for every 1 along {major}."
    (x0, _), (x1, _) = listed_ends(step)
    return text, formula_of(m.equals(rise / run) if x0 != x1 else m)


@explains("raster.*.intercept")
def line_intercept(step: StepValues) -> Said:
    """The equation of the line."""
    m, b, ((x0, y0), _) = step.named("slope", "m"), step.named("intercept", "b"), _named_ends(step)
    swapped = ", where x counts rows" if is_swapped(step) else ""
    text = (
        f"With pixel centres at whole numbers the line is "
        f"{MINOR} = {m} · {MAJOR} {'−' if b.value < 0 else '+'} {spoken(abs(b.value))}{swapped}."
    )
    return text, formula_of(b.equals(y0 - m * x0))


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
    c = step.named("center", "c")
    if 0.5 in (column + c.value - x, row + c.value - y):
        text += ", as the left and the lower border of a pixel belong to it"
    return f"{text}.", formula_of(
        step.upright("column").equals(call("floor", named("x", x) - c + HALF)),
        step.upright("row").equals(call("floor", named("y", y) - c + HALF)),
    )


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
