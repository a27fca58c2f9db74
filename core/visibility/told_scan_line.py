"""Scan-line visible surfaces, told step by step: active surfaces, spans, segments, their ends; and the active list."""

import math
from dataclasses import replace

import numpy as np

from core.explain.formulas import call, concludes, formula_of, named, upright
from core.explain.number_text import pair_text
from core.explain.records import Asked, Formula, choice
from core.explain.step_tables import NONE, FilledColumn, cell_texts, filled_table, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.records.arrays import Integers
from core.records.steps import Level, StepTable, TableCell, TableColumn
from core.records.words import counted
from core.trace.stage_trace import StageTrace
from core.visibility.told import NEAREST, NEW, doubted, measure, nearer

_VERDICTS = "scan-same|scan-pair|scan-halve"
_LAYERED = "layers-same|layers-pair|layers-halve"
_ENDS = "end-first|end|end-exact"
_LAYERS = "layer-first|layer|layer-exact"


def _row(step: StepValues) -> str:
    """Return the row of pixels at the beginning of a sentence, with its sample where a pixel has several."""
    if step.has("sample") and step.whole("sample") >= 0:
        return f"Row {step.pixel[1]}, sample {step.whole('sample')}"
    return f"Row {step.pixel[1]}"


def columns_text(left: int, right: int) -> str:
    """Return the columns from ``left`` to the one before ``right``."""
    return f"columns {left} to {right - 1}" if right - left > 1 else f"column {left}"


def _segment(step: StepValues) -> str:
    """Return the row and the columns of a segment, at the beginning of a sentence."""
    return f"{_row(step)}, {columns_text(step.whole('left'), step.whole('right'))}"


@explains("depth.scan-enter.enter")
def enters(step: StepValues) -> Said:
    """A surface that becomes active."""
    first, last = step.whole("row_first"), step.whole("row_last")
    until = "this row is its last, too" if first == last else f"it stays active up to row {last}"
    return (
        f"{_row(step)}: {step.name} enters the active list, as this is its first row with a pixel; {until}."
    )


@explains("depth.scan-leave.leave")
def leaves(step: StepValues) -> Said:
    """A surface that is no longer active."""
    return f"{_row(step)}: {step.name} leaves the active list, as this is its last row with a pixel."


@explains("depth.scan-span.span")
def spans(step: StepValues) -> Said:
    """The span of an active surface."""
    left, right = step.whole("left"), step.whole("right")
    text = f"{_row(step)}: the span of {step.name} has {columns_text(left, right)}."
    if step.whole("primitive") < 0:
        text = f"{_row(step)}: {step.name}, drawn before, is seen in {columns_text(left, right)}."
    slope = step.number("slope")
    if not math.isfinite(slope):
        return text
    a, d, width = step.named("a", "a"), step.named("d", "d"), step.named("width", "W")
    return text, formula_of(named(r"\Delta v / \Delta x", slope).equals(2 * a / (width * d)))


@explains("depth.scan-sort.sort")
def sorts(step: StepValues) -> Said:
    """The ends of all spans of a row, from left to right."""
    ends, count = step.whole("end_count"), step.whole("span_count")
    verb = "has" if count == 1 else "have"
    return (
        f"{_row(step)}: {counted(count, 'span')} {verb} {ends} different ends, sorted from left to right: "
        f"between two neighbours the same {step.nouns.many} are live."
    )


@explains("depth.scan-alone|scan-live.live")
def live(step: StepValues) -> Said:
    """How many surfaces are live in a segment."""
    count = step.whole("live_count")
    half = ", half of a longer segment" if step.whole("halvings") else ""
    if count == 1:
        return f"{_segment(step)}{half}: one {step.nouns.one} is live."
    pixel = step.whole("right") - step.whole("left") == 1
    where = "the segment's one centre" if pixel else "the segment's first and last centre"
    return f"{_segment(step)}{half}: {count} {step.nouns.many} are live, to be compared at {where}."


@explains("depth.scan-alone.alone")
def alone(step: StepValues) -> Said:
    """A segment of one surface."""
    return f"{_segment(step)}: {step.name} is alone, so it is seen without any depth."


def _end(step: StepValues) -> str:
    """Return which centre of its segment a comparison is about."""
    if step.whole("right") - step.whole("left") == 1:
        return "the only centre"
    return ("the first centre", "the last centre")[step.whole("end")]


@explains("depth.end-first.keep")
def first_live(step: StepValues) -> Said:
    """The first of the live surfaces."""
    return (
        f"{step.pixel_name}: {step.name} is the first of the live {step.nouns.many} at {_end(step)} of the segment, "
        "so it is the nearest so far."
    )


explains("depth.end-exact|layer-exact.doubt")(doubted)


@explains("depth.layer-first.keep")
def farthest(step: StepValues) -> Said:
    """The first of the live surfaces from the back."""
    return f"{step.pixel_name}: sorted from back to front at {_end(step)} of the segment, {step.name} comes first."


@explains("depth.layer.compare")
def sorted_by_floats(step: StepValues) -> Said:
    """A surface in the sorted list that float64 tells from the one behind it."""
    new, old = step.number("nearness"), step.number("nearest_nearness")
    shown, shown_old = pair_text(new, old)
    text = (
        f"{step.pixel_name}: at {_end(step)} the next is {step.name}, as its {measure(step)}, {shown}, is larger than "
        f"the {shown_old} of {step.named_primitive(step.whole('nearest'))} behind it."
    )
    return text, formula_of(concludes("nearer", "nearer", named(NEW, new).compared(">", named(NEAREST, old))))


@explains("depth.layer-exact.exact")
def sorted_exactly(step: StepValues) -> Said:
    """A surface in the sorted list that whole numbers tell from the one behind it."""
    sign, behind = step.whole("sign"), step.named_primitive(step.whole("nearest"))
    found = "nearer" if sign > 0 else "equally near"
    text = f"in whole numbers, without any error, {step.name} is nearer than {behind}, so it is the next."
    if sign == 0:
        text = f"in whole numbers {step.name} is exactly as near as {behind}, and what is drawn first lies on top."
    side = named(rf"\mathrm{{sign}}({NEW} - {NEAREST})", sign)
    return f"{step.pixel_name}: {text}", formula_of(concludes("nearer", found, side.compared(">")))


@explains("depth.end.compare", asks=nearer, decides=True)
def compared(step: StepValues) -> Said:
    """A surface that float64 tells from the nearest so far."""
    new, old = step.number("nearness"), step.number("nearest_nearness")
    shown, shown_old = pair_text(new, old)
    found, than = ("nearer", "larger") if step.flag("passes") else ("farther", "smaller")
    text = (
        f"{step.pixel_name}: {step.name} is {found} at {_end(step)}, as its {measure(step)}, {shown}, is {than} than "
        f"the {shown_old} of {step.named_primitive(step.whole('nearest'))}, and by more than both errors together."
    )
    return text, formula_of(concludes("nearer", found, named(NEW, new).compared(">", named(NEAREST, old))))


@explains("depth.end-exact.exact", asks=nearer, decides=True)
def exact(step: StepValues) -> Said:
    """The comparison in whole numbers."""
    sign, nearest = step.whole("sign"), step.named_primitive(step.whole("nearest"))
    found = "nearer" if sign > 0 else "farther" if sign < 0 else "equally near"
    text = f"compared in whole numbers, without any error, {step.name} is {found} than {nearest}."
    if sign == 0:
        text = f"in whole numbers {step.name} is exactly as near as {nearest}, and a tie keeps what is drawn first."
    side = named(rf"\mathrm{{sign}}({NEW} - {NEAREST})", sign)
    return f"{step.pixel_name}: {text}", formula_of(concludes("nearer", found, side.compared(">")))


@explains(f"depth.{_VERDICTS}.first")
def nearest_first(step: StepValues) -> Said:
    """What is nearest where the segment begins."""
    return f"{_segment(step)}: {step.named_primitive(step.whole('first'))} is nearest at the first centre."


@explains(f"depth.{_VERDICTS}.last")
def nearest_last(step: StepValues) -> Said:
    """What is nearest where the segment ends."""
    if step.whole("right") - step.whole("left") == 1:
        return f"{_segment(step)}: the last centre is the first one."
    return f"{_segment(step)}: {step.named_primitive(step.whole('last'))} is nearest at the last centre."


def verdict(step: StepValues) -> Asked:
    """Ask whether a segment is decided by its ends."""
    first, last = step.whole("first"), step.whole("last")
    length = step.whole("right") - step.whole("left")
    if first == last:
        reveal = f"It is decided: {step.named_primitive(first)} is nearest at both ends, so it is between them, too."
    elif length == 2:
        reveal = "It is decided: it has two pixels, and each end is one of them."
    else:
        reveal = (
            "It is halved: different ones are nearest at its ends, so somewhere between another comes first."
        )
    return choice(
        f"The nearest at the first centre of {columns_text(step.whole('left'), step.whole('right'))} is "
        f"{step.named_primitive(first)}, at the last {step.named_primitive(last)}. Is the segment decided?",
        0 if first == last or length == 2 else 1,
        reveal,
    )


@explains("depth.scan-same.same", asks=verdict, decides=True)
def same(step: StepValues) -> Said:
    """A segment whose ends show the same surface."""
    seen = step.named_primitive(step.whole("seen"))
    if step.whole("right") - step.whole("left") == 1:
        return f"{_segment(step)}: {seen} is seen."
    return (
        f"{_segment(step)}: {seen} is nearest at both ends, and as the nearness of every plane is linear along a "
        "row, the whole segment shows it."
    )


@explains("depth.scan-pair.pair", asks=verdict, decides=True)
def pair(step: StepValues) -> Said:
    """Two pixels with a surface each."""
    first, last = (step.named_primitive(step.whole(name)) for name in ("first", "last"))
    return f"{_segment(step)}: the segment has two pixels; the left one shows {first}, the right one {last}."


@explains("depth.scan-halve.halve", asks=verdict, decides=True)
def halves(step: StepValues) -> Said:
    """A segment that is halved."""
    text = (
        f"{_segment(step)}: different {step.nouns.many} are nearest at its ends, so another one comes to the front "
        f"in between, and it is halved at column {step.whole('middle')}."
    )
    return text, _middle_of(step)


def _middle_of(step: StepValues) -> Formula:
    """Return the column at which a segment is halved."""
    left, right, middle = (step.named(name, upright(name)) for name in ("left", "right", "middle"))
    return formula_of(middle.equals(call("floor", (left + right) / 2)))


def _placed(step: StepValues, name: str, centre: str) -> str:
    """Return which surface has the place that is told of, at one centre."""
    place, who = step.whole("from_front"), step.named_primitive(step.whole(name))
    if place == 1:
        return f"{_segment(step)}: {who} is in front at the {centre} centre."
    return f"{_segment(step)}: {who} is number {place} from the front at the {centre} centre."


@explains(f"depth.{_LAYERED}.first")
def order_first(step: StepValues) -> Said:
    """The order where the segment begins."""
    return _placed(step, "first", "first")


@explains(f"depth.{_LAYERED}.last")
def order_last(step: StepValues) -> Said:
    """The order where the segment ends."""
    if step.whole("right") - step.whole("left") == 1:
        return nearest_last(step)
    return _placed(step, "last", "last")


def same_order(step: StepValues) -> Asked:
    """Ask whether a segment is decided by the order at its ends."""
    first, last = (step.named_primitive(step.whole(name)) for name in ("first", "last"))
    length = step.whole("right") - step.whole("left")
    place = "In front" if step.whole("from_front") == 1 else f"As number {step.whole('place')} from the front"
    is_decided = first == last or length == 2
    reveal = "It is halved: the order changes somewhere between its ends."
    if first == last:
        reveal = "It is decided: the order is the same at both ends, so it is the same between them."
    elif length == 2:
        reveal = "It is decided: it has two pixels, and each end is one of them."
    at_ends = f"{first} at both ends, as everywhere in the order" if first == last else f"{first} and {last}"
    return choice(
        f"{place} {columns_text(step.whole('left'), step.whole('right'))} has {at_ends}. Is the segment decided?",
        0 if is_decided else 1,
        reveal,
    )


def _drawn(step: StepValues) -> str:
    """Return what is drawn of a segment whose order is known."""
    if step.flag("over_picture"):
        return (
            "what lies in front of the picture before is drawn over it, and what lies behind it is left out"
        )
    return f"its {step.whole('live_count')} {step.nouns.many} are drawn from back to front"


@explains("depth.layers-same.same", asks=same_order, decides=True)
def same_layers(step: StepValues) -> Said:
    """A segment whose ends show the same order."""
    drawn = _drawn(step)
    if step.whole("right") - step.whole("left") == 1:
        return f"{_segment(step)}: {drawn}."
    return (
        f"{_segment(step)}: the order is the same at both ends, and as the nearness of every plane is linear along a "
        f"row, it is the same between them: {drawn}."
    )


@explains("depth.layers-pair.pair", asks=same_order, decides=True)
def pair_of_layers(step: StepValues) -> Said:
    """Two pixels with an order each."""
    return f"{_segment(step)}: the segment has two pixels with an order each: {_drawn(step)}."


@explains("depth.layers-halve.halve", asks=same_order, decides=True)
def halves_layers(step: StepValues) -> Said:
    """A segment that is halved as the order changes."""
    text = (
        f"{_segment(step)}: the orders at its ends differ, so two {step.nouns.many} change places in between, and it "
        f"is halved at column {step.whole('middle')}."
    )
    return text, _middle_of(step)


@explains("depth.layer-pixel.draw")
def draws_layer(step: StepValues) -> Said:
    """A pixel of a layer of a segment."""
    columns, below = columns_text(step.whole("left"), step.whole("right")), step.whole("layer")
    over = f"over the {counted(below, 'layer')} behind it" if below else "as the farthest layer"
    return f"{step.pixel_name}: {step.name} is drawn {over}; the segment has {columns}."


@explains("depth.scan-pixel.draw")
def draws(step: StepValues) -> Said:
    """A pixel of a segment."""
    columns = columns_text(step.whole("left"), step.whole("right"))
    return (
        f"{step.pixel_name} shows {step.name}: its segment has {columns}; its depth is stored for other views of "
        "the picture, and no later step reads it."
    )


shows(
    "depth",
    {
        "row_first": VariableText("first row", "First row with a pixel of the triangle."),
        "row_last": VariableText("last row", "Last row with a pixel of the triangle."),
        "left": given("left", "First column of the span or segment."),
        "right": given("right", "Column after the last one."),
        "slope": VariableText("Δv/Δx", "Change of the nearness per column."),
        "span_count": VariableText("spans", "Spans of the row.", "end_count"),
        "end_count": VariableText("ends", "Different ends of the row's spans."),
        "live_count": VariableText("live", "Triangles whose spans contain the segment."),
        "halvings": given("halvings", "How often the segment was halved to get this part."),
        "first": VariableText("first", "The nearest triangle at the first centre."),
        "last": VariableText("last", "The nearest triangle at the last centre."),
        "middle": VariableText("middle", "First column of the right half."),
        "from_front": VariableText("from front", "Place in the order, counted from the front."),
        "layer": VariableText("layer", "Layers of the pixel that are drawn already."),
        "seen": VariableText("seen", "The triangle that the segment shows, or its left pixel."),
    },
)
shows(
    f"depth.{_ENDS}",
    {
        "passes": VariableText(
            "nearer", "Whether the triangle is nearer than those compared before it at this centre."
        )
    },
)
shows(
    f"depth.{_LAYERS}",
    {"passes": VariableText("nearer", "Whether the triangle is nearer than the one behind it in the order.")},
)
shows(
    f"depth.{_VERDICTS}|{_LAYERED}",
    {"passes": VariableText("decided", "Whether the segment is drawn, and not halved.")},
)
_OF_SEGMENTS = ("left", "right", "halvings")
hides("depth.scan-enter|scan-leave|scan-sort|out-of-range|discarded", _OF_SEGMENTS)
hides("depth.scan-span|scan-pixel|layer-pixel", ("halvings",))
hides("depth.scan-pixel|layer-pixel", "mnabcd")


_ACTIVE = (
    FilledColumn("left", "First column of its span.", lambda step: step.whole("left"), "left"),
    FilledColumn("right", "Column after the last one.", lambda step: step.whole("right"), "right"),
    FilledColumn("Δv/Δx", "Change of its nearness per column.", lambda step: step.number("slope"), "slope"),
)
_AT_ENDS = (
    TableColumn("v first", "Its nearness at the first centre of the present segment."),
    TableColumn("v last", "Its nearness at the last centre of the present segment."),
)


@tabulates("depth", ("scan-span",), Level.TRIANGLE)
def active_list(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the spans (R,) of a row, and how near the live ones are at the ends of the present segment."""
    title = f"Active list of row {int(trace.columns['row'][rows[0]])}"
    labels = [str(number) for number in trace.triangle[rows].tolist()]
    table = filled_table(trace, rows, position, title, "Triangle", labels, _ACTIVE, note=" ")
    steps, columns = trace.steps, trace.columns
    current, _ = steps.row_at(position)
    part = int(columns["part"][current]) if current >= 0 else -1
    cells = [[*line, None, None] for line in table.cells]
    at, made = table.row, set(table.made)
    if part >= 0:
        for line in cells:
            line[-2:] = [NONE, NONE]
        live = np.flatnonzero((columns["part"] == part) & (columns["end"] >= 0))
        for row in live.tolist():
            is_its = (columns["primitive"][rows] == columns["primitive"][row]) & (
                trace.triangle[rows] == trace.triangle[row]
            )
            is_its &= (columns["left"][rows] <= columns["left"][row]) & (
                columns["right"][row] <= columns["right"][rows]
            )
            place, end = int(np.flatnonzero(is_its)[0]), len(_ACTIVE) + int(columns["end"][row])
            known = int(steps.starts[row]) + 1
            cells[place][end] = None
            if position >= known:
                cells[place][end] = TableCell(*cell_texts(float(columns["nearness"][row])), known)
            if position == known:
                made.add((place, end))
            if row == current:
                at = place
    return replace(
        table,
        columns=(*table.columns, *_AT_ENDS),
        cells=tuple(tuple(line) for line in cells),
        made=frozenset(made),
        row=at,
        note="",
    )
