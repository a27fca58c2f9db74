"""Lines of a wireframe: how each method chooses its pixels, and interpolation along them."""

import math
from functools import partial

from core.explain.digits import number_latex, spoken, vector_text
from core.explain.equation import (
    Part,
    all_of,
    beside,
    comparison,
    conclusion,
    difference,
    equation,
    fraction,
    linear,
    relation,
)
from core.explain.records import Asked, Formula, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import GIVEN, PIXEL, VariableText, given, shows
from core.methods import table
from core.raster.lines.traits import line_traits
from core.records.words import counted


def line_method(step: StepValues) -> str:
    """Return the line method of a row."""
    return step.kind.removesuffix("-start")


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


def minor_direction(step: StepValues) -> int:
    """Return the way in which the shorter axis steps, 1 or −1."""
    major, minor = (1, 0) if step.flag("is_steep") else (0, 1)
    along, across = (step.vector("second_end")[k] - step.vector("first_end")[k] for k in (major, minor))
    if line_method(step) == "bresenham-lecture" and along < 0:
        across = -across
    return -1 if across < 0 else 1


def major_direction(step: StepValues) -> int:
    """Return the way in which the longer axis is followed, 1 or −1."""
    k = 1 if step.flag("is_steep") else 0
    return -1 if step.vector("second_end")[k] < step.vector("first_end")[k] else 1


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
    """The lengths along both axes and the first decision value."""
    major, minor = axes(step)
    run, rise = step.number("run"), step.number("rise")
    text = (
        f"The line goes {counted(int(run), 'pixel')} along {major} and {spoken(rise)} along {minor}, "
        f"so the decision value D starts at 2 · {spoken(rise)} − {spoken(run)} = {spoken(2 * rise - run)}."
    )
    across, along = (f"d{MINOR}", rise), (f"d{MAJOR}", run)
    return text, equation(("D", 2 * rise - run), "=", "2", r"\cdot", across, "-", along)


@explains("raster.bresenham-float-start.slope")
def error_slope(step: StepValues) -> Said:
    """The slope that is added to the error."""
    _, minor = axes(step)
    run, rise, m = (step.number(name) for name in ("run", "rise", "slope"))
    bars = fraction((f"d{MINOR}", rise), (f"d{MAJOR}", max(run, 1.0)))
    text = f"The slope m is {spoken(rise)} / {spoken(run)} = {spoken(m)}, the change along {minor} with every pixel."
    return text, equation(("m", m), "=", bars)


@explains("raster.*.slope")
def line_slope(step: StepValues) -> Said:
    """The equation of the line."""
    m, b = step.number("slope"), step.number("intercept")
    swapped = ", where x counts rows" if is_swapped(step) else ""
    text = (
        f"With pixel centres at whole numbers the line is "
        f"{MINOR} = {spoken(m)} · {MAJOR} {'−' if b < 0 else '+'} {spoken(abs(b))}{swapped}."
    )
    u, v = (1, 0) if step.flag("is_steep") else (0, 1)
    first, second = step.vector("first_end"), step.vector("second_end")
    above = difference((f"{MINOR}_1", second[v]), (f"{MINOR}_0", first[v]))
    below = difference((f"{MAJOR}_1", second[u]), (f"{MAJOR}_0", first[u]))
    quotient: list[Part] = ["=", fraction(above, below)] if second[u] != first[u] else []
    return text, equation(*beside([("m", m), *quotient], [("b", b)]))


@explains("raster.*.test")
def tested(step: StepValues) -> Said:
    """The decision whether the minor coordinate steps."""
    value, does, is_strict = step.number("decision"), _does(step), line_method(step) == "bresenham-lecture"
    if value == 0:
        text = (
            f"D is 0, a tie: the line passes exactly between two pixels, and by this version's rule {does}."
        )
    else:
        text = f"D is {spoken(value)}, {'above' if value > 0 else 'below'} 0, so {does}."
    return text, _decided(step, comparison("D", ">" if is_strict else r"\ge", value))


@explains("raster.bresenham-float.test")
def error_tested(step: StepValues) -> Said:
    """The decision by the error in float numbers."""
    value = step.number("decision")
    side = "above" if value > 0.5 else "not above" if value == 0.5 else "below"
    text = f"The error e plus the slope m is {spoken(value)}, {side} 0.5, so {_does(step)}."
    return text, _decided(step, comparison("e + m", ">", value, 0.5))


def _does(step: StepValues) -> str:
    _, minor = axes(step)
    return f"{minor} steps" if step.flag("has_stepped") else f"{minor} stays"


def _decided(step: StepValues, compared: list[Part]) -> Formula:
    return equation(*compared, *conclusion("step", "step" if step.flag("has_stepped") else "stay"))


@explains("raster.*.step")
def stepped(step: StepValues) -> Said:
    """The pixel on the minor axis."""
    (_, minor), now = axes(step), step.number("minor")
    if step.flag("has_stepped"):
        text = f"The next pixel is nearer to the line, so {minor} steps to {spoken(now)}."
    else:
        text = f"The same pixel along {minor} is still nearest to the line, so {minor} stays {spoken(now)}."
    moved = float(step.flag("has_stepped") * minor_direction(step))
    before = (rf"{MINOR}_{{\mathrm{{before}}}}", now - moved)
    return text, equation((MINOR, now), "=", before, "+", ("s", moved))


@explains("raster.*.evaluate")
def evaluated(step: StepValues) -> Said:
    """The line equation at a column or row."""
    (major, minor), at, value = axes(step), step.number("major"), step.number("decision")
    text = f"At {major} = {spoken(at)} the line has {minor} = {spoken(value)}, with pixel centres at whole numbers."
    terms = [("m", step.number("slope")), ("b", step.number("intercept"))]
    return text, linear(MINOR, value, terms, (MAJOR, at))


@explains("raster.*.advance")
def advanced(step: StepValues) -> Said:
    """The slope added once more."""
    (major, minor), at, m = axes(step), step.number("major"), step.number("slope")
    value, previous, sign = step.number("decision"), step.number("previous"), float(major_direction(step))
    done = "added" if sign > 0 else "subtracted"
    text = (
        f"The slope {spoken(m)} is {done} for {major} = {spoken(at)}, which makes {minor} = {spoken(value)}."
    )
    if math.isnan(previous):
        return text, equation((MINOR, value))
    before = (rf"{MINOR}_{{\mathrm{{before}}}}", previous)
    return text, equation((MINOR, value), "=", before, "+", ("s", sign), r"\cdot", ("m", m))


@explains("raster.*.round")
def rounded(step: StepValues) -> Said:
    """The nearest pixel centre."""
    (_, minor), value, nearest = axes(step), step.number("decision"), step.number("minor")
    text = f"The nearest pixel centre to {minor} = {spoken(value)} is at {spoken(nearest)}."
    if step.flag("is_tie"):
        text = (
            f"The value {minor} = {spoken(value)} lies exactly between two pixel centres: "
            f"halves round up, to {spoken(nearest)}."
        )
    symbols = rf"\lfloor {MINOR} + \frac{{1}}{{2}} \rfloor"
    numbers = rf"\lfloor {number_latex(value)} + \frac{{1}}{{2}} \rfloor"
    return text, equation((rf"{MINOR}_{{\mathrm{{pixel}}}}", nearest), "=", (symbols, numbers))


@explains("raster.diamond-exit|diamond-exit-start.round")
def nearest_centre(step: StepValues) -> Said:
    """How far the line passes from the centre of the nearest pixel (diamond exit)."""
    height, is_steep = step.number("decision"), step.flag("is_steep")
    sides = ("to the left of", "to the right of") if is_steep else ("below", "above")
    passes = f"the line passes {spoken(abs(height))} px {sides[int(height > 0)]} its centre"
    if height == 0:
        passes = "the line passes through its centre"
    line = "row" if is_steep else "column"
    text = f"{step.pixel_name} is the nearest in this {line}: {passes}."
    if abs(height) == 0.5:
        text = (
            f"{step.pixel_name} ties with its neighbour in this {line}, and OpenGL's rule takes it: {passes}."
        )
    half, away = r"\frac{1}{2}", (rf"{MINOR} - {MINOR}_{{\mathrm{{centre}}}}", height)
    return text, equation(f"-{half}", r"\le", away, r"\le", half)


@explains("raster.diamond-exit|diamond-exit-start.leaves")
def leaves(step: StepValues) -> Said:
    """The diamond-exit test."""
    first, second = step.number("exit_start"), step.number("exit_end")
    tie = ", a tie that OpenGL's rule decides" if 0.5 in (first, second) else ""
    text = (
        f"{step.pixel_name}: its diamond ends at 0.5, the edge begins at {spoken(first)} and ends at {spoken(second)}, "
        f"so it leaves the diamond{tie}."
    )
    compared = [comparison("d_0", "<", first, 0.5), comparison("d_1", r"\ge", second, 0.5)]
    return text, all_of(compared, *conclusion("leaves", "leaves"))


@explains("raster.*.plot")
def plotted(step: StepValues) -> Said:
    """The pixel is drawn; its centre lies at t along the segment."""
    start, end = step.vector("window_start"), step.vector("window_end")
    k = 1 if abs(end[1] - start[1]) > abs(end[0] - start[0]) else 0
    axis, length = "xy"[k ^ is_swapped(step)], end[k] - start[k]
    center = (step.whole("column"), step.whole("row"))[k] + step.number("center")
    along = (center - start[k]) / length if length else 0.0
    intensity, edge = step.number("intensity"), f"edge {step.whole('edge')}"
    drawn = "is drawn" if intensity == 1 else f"is drawn with intensity {spoken(intensity)}"
    if not 0 <= along <= 1:
        end_name = "first" if along < 0 else "second"
        where = f"lies beyond the {end_name} end of {edge}, which stands for it"
    else:
        at = {0.0: "at the first end", 1.0: "at the second end"}.get(along, f"at t = {spoken(along)}")
        where = f"lies {at} of {edge}"
    text, t = f"{step.pixel_name} {drawn}: its centre {where}.", step.number("t")
    if not length:
        return (text, equation(("t", t))) if start != end else text
    above = difference((axis, center), (f"{axis}_0", start[k]))
    symbols, numbers = fraction(above, difference((f"{axis}_1", end[k]), (f"{axis}_0", start[k])))
    if along != t:
        bound = r"\max(0, " if along < 0 else r"\min(1, "
        symbols, numbers = f"{bound}{symbols})", f"{bound}{numbers})"
    return text, equation(("t", t), "=", (symbols, numbers))


@explains("interpolate.line-perspective.parts")
def parts(step: StepValues) -> Said:
    """Both ends' parts of 1/w."""
    t, w, (start, end) = step.number("t"), step.vector("end_w"), step.vector("parts")
    text = (
        f"{step.fragment_name}: at t = {spoken(t)} between ends with w = {spoken(w[0])} and w = {spoken(w[1])}, "
        f"the first end gives {spoken(start)} of 1/w and the second {spoken(end)}."
    )
    first = fraction(("1 - t", f"1 - {number_latex(t)}"), (step.of_end("w", 0), w[0]))
    second = fraction(("t", t), (step.of_end("w", 1), w[1]))
    return text, equation(*beside([("p_0", start), "=", first], [("p_1", end), "=", second]))


@explains("interpolate.line-perspective.total")
def total(step: StepValues) -> Said:
    """1/w along the line."""
    (start, end), whole = step.vector("parts"), step.number("total")
    text = f"{step.fragment_name}: both parts add up to 1/w = {spoken(whole)}."
    return text, linear(r"\frac{1}{w}", whole, [("p_0", start), ("p_1", end)])


def second_weight(step: StepValues) -> Asked | None:
    """Ask for the weight of the second end."""
    s = step.number("s")
    return number(f"What is s, the weight of the second end, at {step.the_pixel}?", s, f"s is {spoken(s)}.")


@explains("interpolate.*.weight", asks=second_weight)
def weight(step: StepValues) -> Said:
    """The weights of the ends."""
    s, is_affine = step.number("s"), step.kind == "line-affine"
    how = "its place along the line in the window" if is_affine else "the second part over 1/w"
    text = f"{step.fragment_name}: the second end has weight {spoken(s)}, {how}, and the first end {spoken(1 - s)}."
    if is_affine:
        return text, equation(("s", s), "=", ("t", step.number("t")))
    return text, equation(
        ("s", s), "=", fraction(("p_1", step.vector("parts")[1]), ("1/w", step.number("total")))
    )


DECISIONS = {
    "bresenham": "D",
    "bresenham-lecture": "D",
    "bresenham-float": "e + m",
    "rectangle": "a",
    "diamond-exit": f"{MINOR} − {MINOR} centre",
}
"""Symbol of the number that chooses the pixel; of other methods the line's coordinate along the minor axis."""


def decision_name(step: StepValues) -> str:
    """Return the formula's symbol of the number that chooses the pixel."""
    return DECISIONS.get(line_method(step), MINOR)


def _pixel_label(step: StepValues, word: str, symbol: str) -> str:
    """Return a coordinate's word, or its symbol where it is the line method's own coordinate."""
    line = line_method(step)
    is_own = line in table.names("line") and line_traits(line).takes_pixels
    return symbol if is_own and not is_swapped(step) else word


shows(
    "raster",
    {
        name: VariableText(partial(_pixel_label, word=name, symbol=symbol), PIXEL[name].meaning, GIVEN)
        for name, symbol in (("column", "x"), ("row", "y"))
    },
)
shows(
    "raster",
    {
        "first_end": VariableText("first end", "Start of the line, as the method uses it."),
        "second_end": VariableText("second end", "End of the line, as the method uses it."),
        "is_steep": VariableText("steep", "Whether y is the major axis: one pixel in every row."),
        "dx": VariableText("dx", "Length along x, without sign; a steep line has x and y swapped.", "run"),
        "dy": VariableText("dy", "Length along y, without sign; a steep line has x and y swapped.", "run"),
        "slope": VariableText("m", "Slope: change of the minor coordinate with every step."),
        "intercept": VariableText("b", "Intercept: minor coordinate where the major one is 0."),
        "decision": VariableText(decision_name, "The number whose sign or rounding chooses the pixel."),
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

shows(
    "interpolate",
    {
        "t": given("t", "Position along the line: 0 at the first end, 1 at the second."),
        "end_w": given("w of the ends", "w of the line's first and second end."),
        "parts": VariableText("p₀, p₁", "Weight of each end over its w."),
        "s": VariableText("s", "Weight of the second end in the value."),
        "end_values": VariableText("at end #", "All values at the line's end, in order.", "s", "parts"),
    },
)
