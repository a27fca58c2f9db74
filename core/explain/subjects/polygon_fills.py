"""Polygon fills: the edge table, the active edges of a row, and what lies between them."""

import math

from core.explain.digits import spoken
from core.explain.formulas import below, call, concludes, formula_of, named, relation, upright
from core.explain.records import Asked, Formula, choice
from core.explain.rows import Said, explains
from core.explain.statements import Chain
from core.explain.step_values import StepValues
from core.explain.term_latex import Written
from core.explain.variable_text import PIXEL, VariableText, given, hides, shows
from core.records.terms import term

_SHIFT = r"\frac{\Delta x}{\Delta y}"
_TABLE = "table-edge|table-level"
_ACTIVE = "active-leave|active-advance|active-enter"
_INTERVALS = "active-interval|active-inside"


def edge_name(step: StepValues) -> str:
    """Return the edge that a step is about, with its corners."""
    return f"edge {step.whole('edge')} (corner {step.whole('edge_start')} to {step.whole('edge_end')})"


@explains("raster.table-edge|table-level.rows")
def rows_of_edge(step: StepValues) -> Said:
    """In which rows an edge is active."""
    first, end = step.whole("row_first"), step.whole("row_end")
    lower, upper, center = step.vector("lower")[1], step.vector("upper")[1], step.number("center")
    c = named("", center)
    rows = f"rows {first} to {end - 1}" if end - first > 1 else f"row {first}"
    lies = f"the centres of {rows} lie on it" if end > first else "the centre of no row lies on it"
    way = "up" if step.whole("direction") > 0 else "down"
    text = (
        f"{edge_name(step).capitalize()} runs {way}, from y = {spoken(lower)} to y = {spoken(upper)} at its ends: "
        f"{lies}."
    )
    # The first row whose centre is not below y; nothing where the raster's border takes its place.
    made = [
        named(upright(name), row).equals(call("ceil", named("y", y) - c))
        for name, row, y in (("first", first, lower), ("end", end, upper))
        if math.ceil(y - center) == row
    ]
    return (text, formula_of(*made)) if made else text


@explains("raster.table-level.skip")
def level_edge(step: StepValues) -> Said:
    """An edge without a row."""
    lower, upper = step.vector("lower")[1], step.vector("upper")[1]
    reason = "it is level" if lower == upper else "it lies between two rows"
    return f"{edge_name(step).capitalize()} goes into no bucket: {reason}."


@explains("raster.table-edge.crossing")
def first_crossing(step: StepValues) -> Said:
    """Where an edge crosses its first row."""
    text = f"It crosses row {step.whole('row_first')} at x = {spoken(step.number('crossing'))}."
    return text, _crossing(step)


@explains("raster.table-edge.shift")
def shift_of_edge(step: StepValues) -> Said:
    """How far an edge moves from row to row."""
    (x0, y0), (x1, y1) = (
        (named(f"x_{k}", x), named(f"y_{k}", y))
        for k, (x, y) in enumerate(map(step.vector, ("lower", "upper")))
    )
    shift = step.named("shift", _SHIFT)
    return f"From row to row it moves by {shift} to the right.", formula_of(
        shift.equals((x1 - x0) / (y1 - y0))
    )


def _crossing(step: StepValues) -> Formula:
    """Return where an edge crosses its first row."""
    x0, y0 = map(named, ("x_0", "y_0"), step.vector("lower"))
    y = named(below("y", "row"), step.whole("row_first") + step.number("center"))
    return formula_of(step.named("crossing", "x").equals(x0 + (y - y0) * step.named("shift", _SHIFT)))


@explains("raster.table-edge.bucket")
def bucket(step: StepValues) -> Said:
    """Which list of the edge table an edge goes into."""
    return (
        f"{edge_name(step).capitalize()} goes into the bucket of row {step.whole('bucket')}, the first row that it "
        "crosses."
    )


@explains("raster.active-leave.leave")
def leaves(step: StepValues) -> Said:
    """An edge that is no longer active."""
    upper = step.vector("upper")[1]
    return (
        f"Row {step.whole('row')}: {edge_name(step)} leaves the active edges: it ends at y = {spoken(upper)}, "
        "not above the row's centre."
    )


@explains("raster.active-advance.advance")
def advances(step: StepValues) -> Said:
    """An active edge in the next row."""
    x, before = step.named("crossing", "x"), step.named("crossing_before", r"x^{\mathrm{before}}")
    text = f"Row {step.whole('row')}: {edge_name(step)} moves on, from x = {before} to {x}."
    return text, formula_of(x.equals(before + step.named("shift", _SHIFT)))


@explains("raster.active-enter.enter")
def enters(step: StepValues) -> Said:
    """An edge that becomes active."""
    return (
        f"Row {step.whole('row')}: {edge_name(step)} enters the active edges from the bucket of this row, "
        f"at x = {spoken(step.number('crossing'))}."
    ), _crossing(step)


@explains(f"raster.{_INTERVALS}.count")
def counts(step: StepValues) -> Said:
    """What lies to the left of an interval between two active edges."""
    crossed, winding = step.whole("crossed"), step.whole("winding")
    left, right = step.number("interval_left"), step.number("interval_right")
    direction = "up" if step.whole("direction") > 0 else "down"
    return (
        f"Row {step.whole('row')}, from x = {spoken(left)} to {spoken(right)}: {crossed} edge"
        f"{'s lie' if crossed > 1 else ' lies'} to the left, and {edge_name(step)}, which runs {direction}, makes the "
        f"winding number {spoken(winding)}."
    )


def inside(step: StepValues) -> Asked:
    """Ask whether an interval is inside the polygon."""
    is_inside = step.flag("is_inside")
    reason = _reason(step)
    left, right = step.number("interval_left"), step.number("interval_right")
    return choice(
        f"Is row {step.whole('row')} inside the polygon from x = {spoken(left)} to {spoken(right)}?",
        0 if is_inside else 1,
        f"{'Yes' if is_inside else 'No'}: {reason}.",
    )


def _reason(step: StepValues) -> str:
    """Say why an interval is inside or not."""
    if step.text("polygon_fill") == "non-zero":
        return f"the winding number is {spoken(step.whole('winding'))}"
    crossed = step.whole("crossed")
    return f"the number of edges to the left, {crossed}, is {'odd' if crossed % 2 else 'even'}"


@explains(f"raster.{_INTERVALS}.decide", asks=inside, decides=True)
def decides(step: StepValues) -> Said:
    """Whether an interval is inside."""
    found = "inside" if step.flag("is_inside") else "outside"
    if step.text("polygon_fill") == "non-zero":
        winding = step.upright("winding")
        test = Chain((winding, term(0)), ((r"\ne", r"\ne" if winding.value else "="),))
    else:
        crossed, remainder = step.whole("crossed"), r"\; \mathrm{mod} \; 2"
        of_two = Written(rf"\mathrm{{crossed}} {remainder}", f"{crossed} {remainder}")
        test = Chain((of_two, named("1", crossed % 2)), ("=",))
    left, right = step.number("interval_left"), step.number("interval_right")
    between = f"from x = {spoken(left)} to {spoken(right)}"
    text = f"Row {step.whole('row')} is {found} {between}, since {_reason(step)}."
    return text, formula_of(concludes("inside", found, test))


@explains("raster.active-inside.span")
def columns_inside(step: StepValues) -> Said:
    """The pixels of an interval."""
    start, stop, center = step.whole("start"), step.whole("stop"), step.named("center", "c")
    columns = f"columns {start} to {stop - 1}" if stop - start > 1 else f"column {start}"
    text = f"The centres of {columns} lie there." if stop > start else "No centre lies there."
    made = (
        step.upright(name).equals(call("ceil", step.named(f"interval_{side}", below("x", side)) - center))
        for name, side in (("start", "left"), ("stop", "right"))
    )
    return text, formula_of(*made)


@explains("raster.active-pixel.draw")
def draws(step: StepValues) -> Said:
    """A pixel of a span."""
    left, right = (step.named(f"interval_{side}", below("x", side)) for side in ("left", "right"))
    x = named("x", step.pixel[0] + step.number("center"))
    tie = ", exactly on the left edge, which owns it" if x.value == left.value else ""
    text = f"{step.pixel_name} is covered: its centre x = {x} lies from {left} to {right}{tie}."
    relations = (r"\le", relation(left.value, x.value)), ("<", relation(x.value, right.value))
    return text, formula_of(Chain((left, x, right), relations))


shows(
    "raster",
    {
        "lower": VariableText("lower end", "Lower end of the edge, in pixels, snapped to 1/256.", ""),
        "upper": VariableText("upper end", "Upper end of the edge, in pixels, snapped to 1/256.", ""),
        "direction": given(
            "direction", "1 where the ring runs upwards along the edge, -1 where it runs downwards."
        ),
        "row_first": VariableText("first", "First row whose centre lies on the edge."),
        "row_end": VariableText("end", "First row whose centre lies above the edge."),
        "shift": VariableText("Δx/Δy", "How far to the right the edge goes from row to row."),
        "crossing": VariableText(
            "x", "Where the row crosses the edge, in pixels.", previous="crossing_before"
        ),
        "bucket": VariableText("bucket", "Row whose list in the edge table has the edge."),
        "interval_left": given("left", "Where the interval begins, in pixels."),
        "interval_right": given("right", "Where the interval ends, in pixels."),
        "crossed": VariableText("crossed", "Active edges to the left of the interval."),
        "winding": VariableText("winding", "Sum of the directions of the edges to the left."),
        "is_inside": VariableText("inside", "Whether the interval is inside, by the rule."),
    },
)
_OF_EDGES = ("lower", "upper", "direction", "row_first", "row_end", "shift", "crossing", "bucket")
_OF_INTERVALS = ("interval_left", "interval_right", "crossed", "winding", "is_inside", "start", "stop")
hides(f"raster.{_TABLE}", (*_OF_INTERVALS, *PIXEL))
hides(f"raster.{_ACTIVE}", (*_OF_INTERVALS, "column"))
hides(f"raster.{_INTERVALS}", ("column", *(name for name in _OF_EDGES if name != "direction")))
hides("raster.active-pixel", (*_OF_EDGES, "crossed", "winding", "is_inside"))
