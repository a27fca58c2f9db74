"""The fill ``spans``: lanes, crossings as fractions, columns, passes."""

import math

from core.coverage.told_edges import on_own_edges
from core.explain.formulas import Chain, below, call, concludes, formula_of, limited, named, upright
from core.explain.number_text import pair_text, spoken
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, shows
from core.records.terms import Term, term
from core.records.words import counted


@explains("raster.lane.first")
def first_lane_row(step: StepValues) -> Said:
    """The first row of a triangle."""
    heights, center, first = step.vector("corner_y"), step.number("center"), step.whole("first_row")
    nominal, where = math.ceil(min(heights) - center), "whose centre lies above that"
    corners = (named(f"y_{k}", y).of_vertex(k) for k, y in enumerate(heights))
    row = limited("max", call("ceil", call("min", *corners) - named("c", center)), nominal, "bottom", first)
    if nominal != first:
        where = "of the raster"
    text = f"Triangle {step.triangle} begins at y = {spoken(min(heights))}: row {first} is the first {where}."
    return text, formula_of(named(upright("first"), first).equals(row))


@explains("raster.lane.rows")
def lane_rows(step: StepValues) -> Said:
    """The rows of a triangle."""
    first, count = step.whole("first_row"), step.whole("row_count")
    heights = step.vector("corner_y")
    rows = f"row {first}" if count == 1 else f"rows {first} to {first + count - 1}"
    low, high = pair_text(min(heights), max(heights))
    text = (
        f"Triangle {step.triangle} reaches from y = {low} to {high}, and of the raster the centres of {rows} "
        f"lie between: {counted(count, 'row')}."
    )
    end = named(upright("end"), first + count)
    return text, formula_of(named(upright("count"), count).equals(end - named(upright("first"), first)))


@explains("raster.lane.lane")
def lane_place(step: StepValues) -> Said:
    """The lane of a triangle among all."""
    count, lane, lanes = step.whole("row_count"), step.whole("lane"), step.whole("lane_count")
    before = "no triangle is taller"
    if lane:
        verb = "comes" if lane == 1 else "come"
        before = f"{counted(lane, 'triangle')} as tall or taller {verb} before it"
    text = (
        f"With {counted(count, 'row')} triangle {step.triangle} gets lane {lane} of {lanes}: "
        f"lanes are sorted tallest first, and {before}."
    )
    return text, formula_of(Chain((named(upright("lane"), lane), named(upright("lanes"), lanes)), ("<",)))


@explains("raster.lane-row.edge")
def row_edge(step: StepValues) -> Said:
    """Where a row crosses an edge: the numerator, which grows by dx from level to level, over dy."""
    k, row, level = step.edge, step.whole("row"), step.number("level")
    dx, dy = step.vector("dx")[k], step.vector("dy")[k]
    if dy == 0:
        text = f"Row {row} of triangle {step.triangle}: edge {k} is level, so it bounds no row."
        return text, formula_of(concludes("level", "level", named(f"dy_{k}", 0.0).compared("=")))
    n, q = step.named(f"numerator_{k}", f"N_{k}"), step.named(f"quotient_{k}", f"q_{k}")
    text = (
        f"Row {row} (level {step.whole('level')}) crosses edge {k} of triangle {step.triangle}, on the "
        f"{'left' if dy < 0 else 'right'}, at column "
        f"{q}: the fraction {n} / {spoken(dy)}, of which only the division is rounded."
    )
    first = named(rf"N_{k}^{{\mathrm{{first}}}}", n.value - level * dx)
    grown = n.equals(first + named("r", level) * named(f"dx_{k}", dx))
    return text, formula_of(grown, q.equals(n / named(f"dy_{k}", dy)))


def _guard(guard: float, owns: bool) -> str:
    """Say what a guard does with a centre exactly on the bound."""
    sign = "−" if guard < 0 else "+"
    return f"a guard of {sign}2⁻³⁵ {'includes' if owns else 'excludes'} a centre exactly on it"


def _next_column(step: StepValues, side: str) -> tuple[int, Term]:
    """Return the next column after a crossing, and how it is computed."""
    crossing, guard = step.named(side, below("q", side)), step.number(f"{side}_guard")
    small = term(2) ** -35
    beyond = crossing + 1 - small if guard < 0 else crossing + 1 + small
    return math.floor(crossing.value + (1 + guard)), call("floor", beyond)


@explains("raster.lane-row.start")
def row_start(step: StepValues) -> Said:
    """The first column of a row, right of the left crossing."""
    start, guard = step.whole("start"), step.number("left_guard")
    nominal, column = _next_column(step, "left")
    limit = ", where the raster begins" if nominal < start else ""
    text = (
        f"Row {step.whole('row')} starts at column {start}{limit}: the left bound is {spoken(step.number('left'))}, "
        f"and {_guard(guard, guard < 0)}."
    )
    return text, formula_of(step.upright("start").equals(limited("max", column, nominal, "first", start)))


@explains("raster.lane-row.stop")
def row_stop(step: StepValues) -> Said:
    """The end of a row, right of the right crossing."""
    row, start, stop, guard = (*map(step.whole, ("row", "start", "stop")), step.number("right_guard"))
    left, right = (spoken(step.number(side)) for side in ("left", "right"))
    nominal, column = _next_column(step, "right")
    limit = ", where the raster ends" if nominal > stop else ""
    bound = ("min", "end") if nominal > stop else ("max", "start")
    text = f"Row {row} stops where it starts: no centre lies between the bounds {left} and {right}."
    if stop > start:
        text = f"Row {row} stops before column {stop}{limit}: the right bound is {right}"
        text += f", and {_guard(guard, guard > 0)}."
    return text, formula_of(step.upright("stop").equals(limited(bound[0], column, nominal, bound[1], stop)))


@explains("raster.lane-row.place")
def row_place(step: StepValues) -> Said:
    """The length of a span, which decides its place among all."""
    row, length, start, place = map(step.whole, ("row", "length", "start", "place"))
    spans, name = step.whole("span_count"), f"Row {row} of triangle {step.triangle}"
    stop = named(upright("stop"), start + length)
    made = step.named("length", "n").equals(stop - step.upright("start"))
    if length == 0:
        return f"{name} has no pixel centre inside, so it has no span.", formula_of(made)
    columns = f"column {start}" if length == 1 else f"columns {start} to {start + length - 1}"
    text = (
        f"{name} is covered in {columns}: {counted(length, 'pixel')}, which makes it span {place} of {spans}, "
        "sorted longest first."
    )
    order = Chain((step.upright("place"), step.named("span_count", upright("spans"))), ("<",))
    return text, formula_of(made, order)


@explains("raster.pass.pass")
def pixel_pass(step: StepValues) -> Said:
    """The pass that draws a pixel."""
    number, size = step.whole("pass_number"), step.whole("pass_size")
    at = "is the first of its span" if number == 0 else f"is {counted(number, 'pixel')} from its span's start"
    together = "alone, as no other span is as long"
    if size > 1:
        together = (
            f"together with one of each of {size - 1:,} others" if size > 2 else "with one of another span"
        )
    made = step.named("pass_number", "k").equals(step.upright("column") - step.upright("start"))
    return f"{step.pixel_name} {at}, so pass {number} draws it, {together}.", formula_of(made)


@explains("raster.pass.draw")
def pixel_drawn(step: StepValues) -> Said:
    """The place of a pixel in the order of execution."""
    rank, before, place = (step.whole(name) for name in ("rank", "drawn_before", "place"))
    text = (
        f"{step.pixel_name} is covered by triangle {step.triangle} without a test of its own, and its rank is {rank}: "
        f"{counted(before, 'pixel')} of earlier passes and {counted(place, 'pixel')} of this one are drawn before it"
        f"{on_own_edges(step)}."
    )
    earlier = step.named("drawn_before", r"\mathrm{before}_k")
    return text, formula_of(step.upright("rank").equals(earlier + step.upright("place")))


OF_LANE = frozenset({"corner_y", "first_row", "row_count", "lane", "lane_count"})
OF_LANE_ROW = frozenset({f"{name}_{k}" for name in ("numerator", "quotient") for k in range(3)}) | {
    *("dx", "dy", "left", "left_guard", "right", "right_guard", "length", "span_count")
}
OF_PASS = frozenset({"pass_number", "pass_size", "drawn_before", "rank"})
OF_SPANS = OF_LANE | (OF_LANE_ROW - {"length"}) | OF_PASS | {"level", "place"}
"""Variables that only rows of this fill use; ``start`` and ``stop`` are those of other fills' spans too."""

shows(
    "raster",
    {
        "corner_y": given("y#", "y of the corner, as used for coverage, in pixels.", "edges"),
        "first_row": VariableText("first", "Lowest row of pixel centres in the triangle and the raster."),
        "row_count": VariableText("rows", "Rows of pixel centres in the triangle and the raster."),
        "lane": VariableText("lane", "Index of the triangle among all, the tallest first."),
        "lane_count": VariableText("lanes", "Triangles that have rows.", "lane"),
        "level": given("r (level)", "Rows of the triangle below this one: all lanes go up level by level."),
        **{
            f"{name}_{k}": VariableText(f"{letter}{k}", meaning, edge=k)
            for k in range(3)
            for name, letter, meaning in (
                ("numerator", "N", "Numerator of the crossing, exact: the edge function at column 0."),
                ("quotient", "q", "Column at which the row crosses the edge: N over dy."),
            )
        },
        "left": VariableText("q left", "The larger crossing of the edges on the left, in columns."),
        "left_guard": VariableText(
            "left guard", "Keeps rounding from deciding, and ties with their owner.", "left"
        ),
        "start": VariableText("start", "First column of the span."),
        "right": VariableText("q right", "The smaller crossing of the edges on the right, in columns."),
        "right_guard": VariableText(
            "right guard", "Keeps rounding from deciding, and ties with their owner.", "right"
        ),
        "stop": VariableText("stop", "Column after the last of the span."),
        "place": VariableText("place", "Index of the span among all, the longest first; −1: none."),
        "span_count": VariableText("spans", "Spans of all triangles together.", "length"),
        "pass_number": VariableText(
            "k (pass)", "Index of the pixel in its span: pass k draws pixel k of every span."
        ),
        "pass_size": VariableText(
            "pixels in pass", "Spans that are long enough to have a pixel in this pass."
        ),
        "drawn_before": VariableText("before k", "Pixels that earlier passes have drawn.", "rank"),
        "rank": VariableText("rank", "Index of the pixel in the order of execution, over all triangles."),
    },
)
shows(
    "raster.lane-row",
    {
        "dx": given(
            "dx#", "Extent of the edge to the right: the numerator's change from row to row.", "edges"
        ),
        "dy": given("dy#", "Extent of the edge upwards: below 0 on the left side of the triangle.", "edges"),
    },
)
