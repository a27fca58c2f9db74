"""The tables of polygons: the edge table, the active edges of each row, the crossings and walks of clipping."""

from collections.abc import Callable

from core.explain.records import Value
from core.explain.step_tables import FilledColumn, filled_table, primitive_name, tabulates
from core.explain.step_values import StepValues
from core.records.arrays import Integers
from core.records.tables import StepTable
from core.trace import StageTrace


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
_INTERVALS = ("active-interval", "active-inside")


def _of_edge(name: str) -> Callable[[StepValues], Value]:
    """Return what reads a number of an edge's row; an interval has none."""
    return lambda step: None if step.kind in (*_INTERVALS, "active-leave") else step.number(name)


def _of_interval(name: str) -> Callable[[StepValues], Value]:
    """Return what reads a whole number of an interval's row; an edge has none."""
    return lambda step: step.whole(name) if step.kind in _INTERVALS else None


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


_ACTIVE = (
    FilledColumn("does", "What the edge does in this row, or what lies right of it.", _found),
    FilledColumn("x", "Where the row crosses the edge.", _of_edge("crossing")),
    FilledColumn("Δx/Δy", "How far it moves from row to row.", _of_edge("shift")),
    FilledColumn("crossed", "Edges to the left.", _of_interval("crossed")),
    FilledColumn("winding", "Sum of their directions.", _of_interval("winding")),
    FilledColumn("columns", "Pixels of the interval, where it is inside.", _columns_of),
)


@tabulates("raster", (*_DOES, *_INTERVALS))
def active_edges(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the active edges of a row of pixels, and the intervals between them: rows (R,) of a trace."""
    names = [
        f"right of {edge}" if trace.kind_of(row) in _INTERVALS else f"{edge}"
        for edge, row in zip(_edges(trace, rows), rows.tolist(), strict=True)
    ]
    title = f"Active edges of row {int(trace.columns['row'][rows[0]])}"
    return filled_table(trace, rows, position, title, "Edge", names, _ACTIVE, grows=True)


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
