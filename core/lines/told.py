"""Lines of a wireframe: how each method chooses its pixels."""

import ast
import math
from fractions import Fraction

import numpy as np

from core.explain.formulas import HALF, Chain, Named, call, concludes, formula_of, named
from core.explain.listed_code import BEFORE, assignment, code_of, named_sum, symbols, value_of
from core.explain.listed_code import tested as tested_by
from core.explain.number_text import spoken
from core.explain.records import Asked, choice, number
from core.explain.step_values import REMARKS, Said, StepValues, explains
from core.lines.told_setup import MAJOR, MINOR, amount, axes, is_swapped, line_method, listed_ends, sum_name
from core.methods import table
from core.records.arrays import Flags, Integers
from core.records.listing import Columns
from core.records.terms import Term

RELATIONS_LATEX = {ast.Gt: ">", ast.GtE: r"\ge", ast.LtE: r"\le", ast.Lt: "<"}
ON_LINE = 1e-9
"""Pixels from a line within which a centre lies on it, but for the rounding of its ends."""


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


@explains("raster.dda-float32-start|dda-float32-off.sy")
def rounded_step(step: StepValues) -> Said:
    """The slope in the line's direction."""
    made, computed, value = assignment(step)
    return f"The step sy is {amount(computed, value)}, rounded to float32.", formula_of(made)


@explains("raster.dda-float32.advance")
def added_in_float32(step: StepValues) -> Said:
    """The slope added once more, and the sum rounded."""
    now, added = step.number("decision"), step.number("sy")
    text = f"Adding sy = {spoken(added)} to y and rounding the sum to float32 makes y = {spoken(now)}."
    return text, formula_of(assignment(step)[0])


@explains("raster.*.test", asks=will_step, decides=True)
def tested(step: StepValues) -> Said:
    """The decision whether the minor coordinate steps."""
    compared, value = comparison_of(step), step.number("decision")
    name, limit = symbols(compared.left), value_of(compared.comparators[0])
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
    test = named_sum(compared.left, value).compared(wanted, limit)
    return text, formula_of(concludes(yes, yes if is_yes else no, test))


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
    return f"{why} {minor} steps to {spoken(now)}{_though(near)}.", formula_of(assignment(step)[0])


@explains("raster.*.column")
def next_column(step: StepValues) -> Said:
    """The next column, or row of a steep line, that the line reaches."""
    (major, _), now = axes(step), step.named("major", MAJOR)
    word, before = "row" if step.flag("is_steep") else "column", step.named("major_before", MAJOR + BEFORE)
    if step.kind.endswith("-start") and line_method(step) == "diamond-exit":
        return f"The line's first pixel is in the {word} {major} = {now}."
    if math.isnan(before.value) or step.kind.endswith("-start"):
        low = named(rf"{MAJOR}_{{\min}}", min(end[0] for end in listed_ends(step)))
        text = f"The first {word} that the line reaches is {major} = {now}."
        return text, formula_of(now.equals(call("floor", low + HALF)))
    return f"The next {word} is {major} = {now}.", formula_of(now.equals(before + step.named("sx", "sx")))


@explains("raster.*.first-y")
def first_pixel(step: StepValues) -> Said:
    """The first pixel on the minor axis."""
    y, x = step.named("minor", MINOR), step.named("major", MAJOR)
    text = f"The nearest pixel centre at x = {x} is at y = {y}."
    return text, formula_of(y.equals(call("floor", _on_line(step, x) + HALF)))


def _on_line(step: StepValues, x: Named) -> Term:
    return step.named("slope", "m") * x + step.named("intercept", "b")


@explains("raster.*.correct|advance")
def added(step: StepValues) -> Said:
    """What is added to the sum, or taken off it."""
    made, computed, value = assignment(step)
    name, now = sum_name(step), step.number(step.explanation.changed[0])
    is_added = isinstance(code_of(step).op, ast.Add)  # type: ignore[union-attr]
    does = "Adding" if is_added else "Subtracting"
    return f"{does} {amount(computed, value)} makes {name} = {spoken(now)}.", formula_of(made)


@explains("raster.*.next")
def moved(step: StepValues) -> Said:
    """The next pixel on the major axis."""
    (major, _), now = axes(step), step.number("major")
    return f"The next pixel is at {major} = {spoken(now)}.", formula_of(assignment(step)[0])


@explains("raster.*.evaluate")
def evaluated(step: StepValues) -> Said:
    """The line equation at a column or row."""
    (major, minor), x, y = axes(step), step.named("major", MAJOR), step.named("decision", MINOR)
    text = f"At {major} = {x} the line has {minor} = {y}, with pixel centres at whole numbers."
    return text, formula_of(y.equals(_on_line(step, x)))


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
    (_, minor), y, nearest = axes(step), step.named("decision", MINOR), step.named("minor", "Y")
    text = f"The nearest pixel centre to {minor} = {y} is at {nearest}."
    if step.flag("is_tie"):
        text = (
            f"The value {minor} = {y} lies exactly between two pixel centres: halves round up, to {nearest}."
        )
    return text, formula_of(nearest.equals(call("floor", y + HALF)))


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
    away = named(rf"{MINOR} - {MINOR}_{{\mathrm{{centre}}}}", height)
    return text, formula_of(Chain((-HALF, away, HALF), (r"\le", r"\le")))


@explains("raster.diamond-exit|diamond-exit-start.leaves", decides=True)
def leaves(step: StepValues) -> Said:
    """The diamond-exit test."""
    first, second = step.named("exit_start", "d_0"), step.named("exit_end", "d_1")
    tie = ", a tie that OpenGL's rule decides" if 0.5 in (first.value, second.value) else ""
    text = (
        f"{step.pixel_name}: its diamond ends at 0.5, the {step.nouns.edge} begins at {first} and ends at {second}, "
        f"so it leaves the diamond{tie}."
    )
    tests = first.compared("<", 0.5), second.compared(r"\ge", 0.5)
    return text, formula_of(concludes("leaves", "leaves", *tests))


def _is_other(columns: Columns, rows: Integers) -> Flags:
    """Return at which pixels (R,) of a line as printed the right method draws something else."""
    if "right_pixel" not in columns:
        return np.zeros(len(rows), bool)
    here = np.stack([columns["column"][rows], columns["row"][rows]], axis=1)
    other: Flags = (columns["right_pixel"][rows] != here).any(axis=1) | (columns["left_out"][rows] >= 0).any(
        axis=1
    )
    return other


REMARKS["raster.*.plot"] = _is_other


def _right_of_printed(step: StepValues) -> str:
    """Return what the right method draws where a line as printed has another pixel."""
    if not step.has("right_pixel"):
        return ""
    name = table.get("line", step.text("right_method")).title.partition(",")[0]
    (x, y), (left_x, left_y) = (map(int, step.vector(of)) for of in ("right_pixel", "left_out"))
    text = ""
    if x < 0:
        text = f"; the right method ({name}) does not draw it"
    elif (x, y) != step.pixel:
        is_tie = _away_from_line(step, *step.pixel) == _away_from_line(step, x, y)
        text = f"; the right method ({name}) draws ({x}, {y}) instead"
        text = f"; at this tie the other rule ({name}) draws ({x}, {y})" if is_tie else text
    if left_x >= 0:
        text += f"; the right method ({name}) goes on to ({left_x}, {left_y})"
    return text


def _away_from_line(step: StepValues, column: int, row: int) -> Fraction:
    """Return how far the centre of a pixel lies from the line along the minor axis, exactly."""
    u = int(step.flag("is_steep"))
    first, second = ([Fraction(x) for x in step.vector(name)] for name in ("first_end", "second_end"))
    run, rise = second[u] - first[u], second[1 - u] - first[1 - u]
    line = first[1 - u] + ((column, row)[u] - first[u]) * rise / run if run else first[1 - u]
    return abs((column, row)[1 - u] - line)


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
    intensity = step.number("intensity")
    edge = {2: "the segment", 3: step.edge_name}.get(
        step.explanation.corner_count, f"edge {step.whole('edge')}"
    )
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
    text, t = f"{step.pixel_name} {drawn}: its centre {where}{_right_of_printed(step)}.", step.named("t", "t")
    if not length:
        return (text, formula_of(t)) if start != end else text
    first, second = named(f"{axis}_0", start[k]), named(f"{axis}_1", end[k])
    place: Term = (named(axis, center) - first) / (second - first)
    if along != t.value:
        place = call("max", 0, place) if along < 0 else call("min", 1, place)
    return text, formula_of(t.equals(place))
