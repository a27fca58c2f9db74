"""Lines of a wireframe: how each method chooses its pixels, and interpolation along them."""

import ast
import math
from fractions import Fraction

from core.explain.digits import number_latex, signed_latex, spoken, vector_text
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
from core.explain.listed_code import (
    BEFORE,
    assigned_name,
    assignment,
    code_of,
    number_of,
    symbols,
    symbols_latex,
    used_values,
)
from core.explain.listed_code import tested as tested_by
from core.explain.records import Asked, choice, number
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, given, hides, shows
from core.methods import table
from core.raster.lines.traits import line_of_kind, line_traits, minor_name
from core.records.words import counted, joined


def line_method(step: StepValues) -> str:
    """Return the line method of a row."""
    return line_of_kind(step.kind)


def is_swapped(step: StepValues) -> bool:
    """Return whether the listing has swapped x and y for a steep line."""
    line = line_method(step)
    is_steep = bool(step.explanation.values.get("is_steep", False))
    return is_steep and line in table.names("line") and line_traits(line).swaps_axes


RELATIONS_LATEX = {ast.Gt: ">", ast.GtE: r"\ge", ast.LtE: r"\le", ast.Lt: "<"}
ON_LINE = 1e-9
"""Pixels from a line within which a centre lies on it, but for the rounding of its ends."""
MAJOR, MINOR = "x", "y"
"""Symbols, as in the listings, of the longer axis of the line and of the other: of a steep line x and y are swapped."""


def axes(step: StepValues) -> tuple[str, str]:
    """Return in words the longer axis of the line and the other: their symbols, and what they count if swapped."""
    return ("x (the row)", "y (the column)") if is_swapped(step) else (MAJOR, MINOR)


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


def nearness(step: StepValues) -> int:
    """Compare the pixel that was taken with the other one: -1 where it is nearer to the line, 0 as near, 1 farther."""
    u = int(step.flag("is_steep"))
    first, second = ([Fraction(x) for x in step.vector(name)] for name in ("first_end", "second_end"))
    run, rise = second[u] - first[u], second[1 - u] - first[1 - u]
    line = first[1 - u] + (Fraction(step.number("major")) - first[u]) * rise / run if run else first[1 - u]
    taken = Fraction(step.number("minor"))
    other = taken + Fraction(step.number("sy")) * (-1 if step.flag("has_stepped") else 1)
    mine, its = abs(taken - line), abs(other - line)
    return (mine > its) - (mine < its)


def comparison_of(step: StepValues) -> ast.Compare:
    """Return the comparison by which the listing of a step decides whether the minor coordinate steps."""
    found = tested_by(code_of(step, "test"))
    assert found is not None, f"{step.explanation.key} tests nothing"
    return found


def will_step(step: StepValues) -> Asked:
    """Ask for the decision."""
    compared, (_, minor), has_stepped = comparison_of(step), axes(step), step.flag("has_stepped")
    name = symbols(compared.left)
    value = f"{name if name[0].isupper() else f'The value of {name}'} is {spoken(step.number('decision'))}"
    return choice(
        f"{value}, and the listing tests {symbols(compared)}. Does {minor} step?",
        int(not has_stepped),
        f"{value}, so {_does(step)}: {step.the_pixel} is next.",
    )


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
    return f"The first {name} is {_amount(computed, value)}.", equation(*made)


def _amount(computed: str, value: float) -> str:
    """Return what was computed, and its number."""
    return spoken(value) if computed[0].isdigit() and " " not in computed else f"{computed} = {spoken(value)}"


@explains("raster.bresenham-float-start.slope")
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


@explains("raster.dda-float32-start.sy")
def rounded_step(step: StepValues) -> Said:
    """The slope in the line's direction."""
    made, computed, value = assignment(step)
    return f"The step sy is {_amount(computed, value)}, rounded to float32.", equation(*made)


@explains("raster.dda-float32.advance")
def added_in_float32(step: StepValues) -> Said:
    """The slope added once more, and the sum rounded."""
    now, added = step.number("decision"), step.number("sy")
    text = f"Adding sy = {spoken(added)} to y and rounding the sum to float32 makes y = {spoken(now)}."
    return text, equation(*assignment(step)[0])


@explains("raster.*.test", asks=will_step, decides=True)
def tested(step: StepValues) -> Said:
    """The decision whether the minor coordinate steps."""
    compared, value = comparison_of(step), step.number("decision")
    name, limit = symbols(compared.left), number_of(compared.comparators[0], {})
    near, does = nearness(step), _does(step)
    side = "above" if value > limit else "below"
    if value == limit:
        side = "not above" if isinstance(compared.ops[0], ast.Gt | ast.LtE) else "not below"
    shown = name if name[0].isupper() else f"The value of {name}"
    text = f"{shown} is {spoken(value)}, {side} {spoken(limit)}, so {does}{_though(near)}."
    if value == limit and near == 0:
        text = (
            f"{shown} is {spoken(value)}, a tie: the line passes exactly between two pixels, "
            f"and by this version's rule {does}."
        )
    wanted = RELATIONS_LATEX[type(compared.ops[0])]
    is_yes = step.flag("has_stepped") != isinstance(compared.ops[0], ast.LtE)
    yes, no = ("stay", "step") if isinstance(compared.ops[0], ast.LtE) else ("step", "stay")
    return text, equation(
        *comparison(symbols_latex(compared.left), wanted, value, limit),
        *conclusion(yes, yes if is_yes else no),
    )


def _though(near: int) -> str:
    """Return what must be said where the pixel that is taken is not the nearer one."""
    return ", though the other pixel is nearer to the line" if near > 0 else ""


def _does(step: StepValues) -> str:
    _, minor = axes(step)
    return f"{minor} steps" if step.flag("has_stepped") else f"{minor} stays"


@explains("raster.*.step")
def stepped(step: StepValues) -> Said:
    """The pixel on the minor axis."""
    (_, minor), now, near = axes(step), step.number("minor"), nearness(step)
    why = "The next pixel is nearer to the line, so"
    if near == 0:
        why = "Both pixels are equally near the line, and by this version's rule"
    elif near > 0:
        why = "By this version's rule"
    return f"{why} {minor} steps to {spoken(now)}{_though(near)}.", equation(*assignment(step)[0])


@explains("raster.*.column")
def next_column(step: StepValues) -> Said:
    """The next column, or row of a steep line, that the line reaches."""
    (major, _), now = axes(step), step.number("major")
    word, before = "row" if step.flag("is_steep") else "column", step.number("major_before")
    if step.kind.endswith("-start") and line_method(step) == "diamond-exit":
        return f"The line's first pixel is in the {word} {major} = {spoken(now)}."
    if math.isnan(before) or step.kind.endswith("-start"):
        low = number_latex(min(end[0] for end in listed_ends(step)))
        symbols, numbers = (
            rf"\lfloor {text} + \frac{{1}}{{2}} \rfloor" for text in (rf"{MAJOR}_{{\min}}", low)
        )
        text = f"The first {word} that the line reaches is {major} = {spoken(now)}."
        return text, equation((MAJOR, now), "=", (symbols, numbers))
    made: list[Part] = [(MAJOR, now), "=", (MAJOR + BEFORE, before), "+", ("sx", step.number("sx"))]
    return f"The next {word} is {major} = {spoken(now)}.", equation(*made)


@explains("raster.*.first-y")
def first_pixel(step: StepValues) -> Said:
    """The first pixel on the minor axis."""
    first, m, b, x = (step.number(name) for name in ("minor", "slope", "intercept", "major"))
    line = rf"m \cdot {MAJOR} + b", rf"{number_latex(m)} \cdot {signed_latex(x)} + {signed_latex(b)}"
    symbols, numbers = (rf"\lfloor {text} + \frac{{1}}{{2}} \rfloor" for text in line)
    return f"The nearest pixel centre at x = {spoken(x)} is at y = {spoken(first)}.", equation(
        (MINOR, first), "=", (symbols, numbers)
    )


@explains("raster.*.correct|advance")
def added(step: StepValues) -> Said:
    """What is added to the sum, or taken off it."""
    made, computed, value = assignment(step)
    name, now = sum_name(step), step.number(step.explanation.changed[0])
    is_added = isinstance(code_of(step).op, ast.Add)  # type: ignore[union-attr]
    does = "Adding" if is_added else "Subtracting"
    return f"{does} {_amount(computed, value)} makes {name} = {spoken(now)}.", equation(*made)


@explains("raster.*.next")
def moved(step: StepValues) -> Said:
    """The next pixel on the major axis."""
    (major, _), now = axes(step), step.number("major")
    return f"The next pixel is at {major} = {spoken(now)}.", equation(*assignment(step)[0])


@explains("raster.*.evaluate")
def evaluated(step: StepValues) -> Said:
    """The line equation at a column or row."""
    (major, minor), at, value = axes(step), step.number("major"), step.number("decision")
    text = f"At {major} = {spoken(at)} the line has {minor} = {spoken(value)}, with pixel centres at whole numbers."
    terms = [("m", step.number("slope")), ("b", step.number("intercept"))]
    return text, linear(MINOR, value, terms, (MAJOR, at))


def nearest_pixel(step: StepValues) -> Asked | None:
    """Ask for the pixel that a column or row gets."""
    (major, minor), at, nearest = axes(step), step.number("major"), step.number("minor")
    line = step.number("decision") + (nearest if line_method(step) == "diamond-exit" else 0.0)
    word = "column" if step.flag("is_steep") else "row"
    return number(
        f"At {major} = {spoken(at)} the line has {minor} = {spoken(line)}. In which {word} is the pixel?",
        nearest,
        f"{word.capitalize()} {spoken(nearest)} is nearest to {spoken(line)}.",
    )


@explains("raster.*.round", asks=nearest_pixel, decides=True)
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
    return text, equation(("Y", nearest), "=", (symbols, numbers))


@explains("raster.diamond-exit|diamond-exit-start.round", asks=nearest_pixel, decides=True)
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


@explains("raster.diamond-exit|diamond-exit-start.leaves", decides=True)
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
    center, beside_it = (
        (step.whole("column"), step.whole("row"))[n] + step.number("center") for n in (k, 1 - k)
    )
    along = (center - start[k]) / length if length else 0.0
    away = beside_it - start[1 - k] - along * (end[1 - k] - start[1 - k])
    intensity, edge = step.number("intensity"), f"edge {step.whole('edge')}"
    drawn = "is drawn" if intensity == 1 else f"is drawn with intensity {spoken(intensity)}"
    side = (("below", "above"), ("to the left of", "to the right of"))[k][away > 0]
    if not 0 <= along <= 1:
        end_name = "first" if along < 0 else "second"
        where = f"lies beyond the {end_name} end of {edge}, which stands for it"
    elif abs(away) > ON_LINE:
        at = {0.0: "level with the first end", 1.0: "level with the second end"}.get(
            along, f"at t = {spoken(along)}"
        )
        where = f"is {at} of {edge}, {spoken(abs(away))} px {side} the line"
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
