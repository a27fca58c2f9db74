"""Polygon fills, told step by step: the edge table, the active edges of a row, what lies between; and their tables."""

import math
from collections.abc import Callable

from core.explain.formulas import Chain, below, call, concludes, formula_of, named, relation, upright
from core.explain.number_text import spoken
from core.explain.records import Asked, Formula, Value, choice
from core.explain.step_tables import FilledColumn, filled_table, primitive_name, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import PIXEL, VariableText, given, hides, shows
from core.explain.term_latex import Written
from core.records.arrays import Integers
from core.records.steps import StepTable
from core.records.terms import term
from core.trace.stage_trace import StageTrace

# Polygon fills: the edge table, the active edges of a row, and what lies between them.


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


# The tables of polygons: the edge table, the active edges of each row, the crossings and walks of clipping.


def _pair(first: str, second: str, between: str) -> Callable[[StepValues], Value]:
    """Return what reads two whole numbers as one text."""
    return lambda step: f"{step.whole(first)}{between}{step.whole(second)}"


def _edges(trace: StageTrace, rows: Integers) -> list[str]:
    """Return the edge of every row (R,)."""
    return [str(edge) for edge in trace.columns["edge"][rows].tolist()]


_EDGE_TABLE = (
    FilledColumn(
        "corners", "Corners that the edge runs between.", _pair("edge_start", "edge_end", " → "), "row_first"
    ),
    FilledColumn("way", "Up: 1, down: −1.", lambda step: step.whole("direction"), "row_first"),
    FilledColumn(
        "first", "First row whose centre lies on it.", lambda step: step.whole("row_first"), "row_first"
    ),
    FilledColumn(
        "end", "First row whose centre lies above it.", lambda step: step.whole("row_end"), "row_first"
    ),
    FilledColumn("x", "Where it crosses its first row.", lambda step: step.number("crossing"), "crossing"),
    FilledColumn("Δx/Δy", "How far it moves from row to row.", lambda step: step.number("shift"), "shift"),
    FilledColumn("bucket", "Row whose list has it.", lambda step: step.whole("bucket"), "bucket"),
)


@tabulates("raster", ("table-edge", "table-level"))
def edge_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the edge table of a polygon: rows (R,) of a trace, as far as they are done."""
    title = f"Edge table of {primitive_name(trace, rows[0])}"
    return filled_table(trace, rows, position, title, "Edge", _edges(trace, rows), _EDGE_TABLE)


_DOES = {"active-leave": "leaves", "active-advance": "moves on", "active-enter": "enters"}
_INTERVAL_KINDS = ("active-interval", "active-inside")


def _of_edge(name: str) -> Callable[[StepValues], Value]:
    """Return what reads a number of an edge's row; an interval has none."""
    return lambda step: None if step.kind in (*_INTERVAL_KINDS, "active-leave") else step.number(name)


def _of_interval(name: str) -> Callable[[StepValues], Value]:
    """Return what reads a whole number of an interval's row; an edge has none."""
    return lambda step: step.whole(name) if step.kind in _INTERVAL_KINDS else None


def _columns_of(step: StepValues) -> Value:
    """Return the columns of an interval inside the polygon."""
    if step.kind != "active-inside":
        return None
    return (
        f"{step.whole('start')} to {step.whole('stop') - 1}"
        if step.whole("stop") > step.whole("start")
        else "none"
    )


def _found(step: StepValues) -> Value:
    """Return what a row does with an edge, or finds of an interval."""
    return _DOES.get(step.kind, "inside" if step.flag("is_inside") else "outside")


_ACTIVE_COLUMNS = (
    FilledColumn("does", "What the edge does in this row, or what lies right of it.", _found),
    FilledColumn("x", "Where the row crosses the edge.", _of_edge("crossing")),
    FilledColumn("Δx/Δy", "How far it moves from row to row.", _of_edge("shift")),
    FilledColumn("crossed", "Edges to the left.", _of_interval("crossed")),
    FilledColumn("winding", "Sum of their directions.", _of_interval("winding")),
    FilledColumn("columns", "Pixels of the interval, where it is inside.", _columns_of),
)


@tabulates("raster", (*_DOES, *_INTERVAL_KINDS))
def active_edges(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the active edges of a row of pixels, and the intervals between them: rows (R,) of a trace."""
    names = [
        f"right of {edge}" if trace.kind_of(row) in _INTERVAL_KINDS else f"{edge}"
        for edge, row in zip(_edges(trace, rows), rows.tolist(), strict=True)
    ]
    title = f"Active edges of row {int(trace.columns['row'][rows[0]])}"
    return filled_table(trace, rows, position, title, "Edge", names, _ACTIVE_COLUMNS, grows=True)


_CROSSINGS = (
    FilledColumn("edge", "Ring and edge of the polygon, as 0.2.", _pair("ring", "edge", "."), "t"),
    FilledColumn(
        "window", "Ring and edge of the clip window, as 0.2.", _pair("region_ring", "region_edge", "."), "t"
    ),
    FilledColumn("t", "Where it lies on the polygon's edge.", lambda step: step.number("t"), "t"),
    FilledColumn(
        "u", "Where it lies on the window's edge.", lambda step: step.number("region_t"), "region_t"
    ),
    FilledColumn("place", "Where it lies, in pixels.", lambda step: tuple(step.vector("point")), "point"),
    FilledColumn(
        "list",
        "Entering: a walk may start here.",
        lambda step: "entering" if step.flag("is_entering") else "leaving",
        "is_entering",
    ),
)


@tabulates("clip", ("wa-crossing",))
def crossings_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the entering and leaving crossings of Weiler-Atherton: rows (R,) of a trace."""
    labels = [str(number) for number in range(len(rows))]
    title = f"Crossings of {primitive_name(trace, rows[0])}"
    return filled_table(trace, rows, position, title, "Crossing", labels, _CROSSINGS)


def _along(step: StepValues) -> Value:
    """Return along which of the two a step of the walk goes."""
    if step.kind == "wa-start":
        return "start"
    return "clip window" if step.flag("on_region") else "polygon"


_WALK = (
    FilledColumn("along", "The polygon or the clip window.", _along),
    FilledColumn("to", "Where the step leads, in pixels.", lambda step: tuple(step.vector("point"))),
    FilledColumn(
        "crossing",
        "Number of the crossing; a corner has none.",
        lambda step: step.whole("crossing") if step.whole("crossing") >= 0 else None,
    ),
)


@tabulates("clip", ("wa-start", "wa-corner", "wa-switch", "wa-close"))
def walk_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the walk around one ring of the result: rows (R,) of a trace."""
    title = f"Walk around ring {int(trace.columns['result_ring'][rows[0]])} of the result"
    labels = [str(number) for number in range(len(rows))]
    return filled_table(trace, rows, position, title, "Step", labels, _WALK, grows=True)


_SIDE = (
    FilledColumn(
        "d0", "Side of the start: above 0 is inside.", lambda step: step.number("start_side"), "start_side"
    ),
    FilledColumn(
        "d1", "Side of the end: above 0 is inside.", lambda step: step.number("end_side"), "end_side"
    ),
    FilledColumn("t", "Where the edge crosses.", lambda step: step.number("t"), "t"),
    FilledColumn("corner", "The new corner, in pixels.", lambda step: tuple(step.vector("point")), "point"),
    FilledColumn(
        "end", "Whether its end is kept.", lambda step: "kept" if step.flag("is_kept") else "dropped"
    ),
)


@tabulates("clip", ("sh-in-in", "sh-out-out", "sh-in-out", "sh-out-in"))
def side_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return one side of the clip window of Sutherland-Hodgman: rows (R,) of a trace, one for each edge."""
    ring, side = (int(trace.columns[name][rows[0]]) for name in ("ring", "region_edge"))
    title = f"Ring {ring} against edge {side} of the clip window"
    return filled_table(
        trace, rows, position, title, "Edge", _edges(trace, rows), _SIDE, note="This side is done."
    )
