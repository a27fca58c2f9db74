"""Lists of hits, told step by step: what is appended, how the list is sorted, and what of it is seen."""

import math
from dataclasses import replace

import numpy as np

from core.depth.told import held_name, quantity_of
from core.explain.formulas import concludes, formula_of, named
from core.explain.number_text import pair_text, spoken
from core.explain.records import Asked, choice, number
from core.explain.step_tables import FilledColumn, cell_texts, filled_table, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.records.arrays import Integers
from core.records.steps import StepTable, TableCell, TableColumn
from core.records.words import counted
from core.trace.stage_trace import StageTrace


def how_many(step: StepValues) -> Asked | None:
    """Ask how long the list is now."""
    length = step.whole("length")
    return number(
        f"How many hits are in the list of {step.the_pixel} now?", length, f"it has {counted(length, 'hit')}."
    )


@explains("depth.hit.append", asks=how_many)
def appended(step: StepValues) -> Said:
    """A hit at the end of its pixel's list."""
    length = step.whole("length")
    text = f"{step.pixel_name}: {step.name} is appended to the list, which now has {counted(length, 'hit')}"
    return text + ("; nothing is compared yet." if length > 1 else ".")


def is_kept(step: StepValues) -> Asked | None:
    """Ask whether a hit is blended, or seen."""
    what = "blended" if step.flag("shows_through") else "seen"
    outcome = "" if step.flag("passes") else "not "
    return choice(
        f"Is {step.name} {what} at {step.the_pixel}?",
        0 if step.flag("passes") else 1,
        f"it is {outcome}{what}.",
    )


@explains("depth.hit-beyond.beyond", asks=is_kept, decides=True)
def beyond(step: StepValues) -> Said:
    """A hit behind what the depth buffer holds from the start."""
    new, old = step.number("stored"), step.number("before")
    shown, shown_old = pair_text(new, old)
    if math.isnan(new) or math.isnan(old):
        return f"{step.pixel_name}: {step.name} is left out, as {shown} cannot be compared with {shown_old}."
    text = (
        f"{step.pixel_name}: {step.name} is left out, as its {quantity_of(step)[0]}, {shown}, is not nearer than the "
        f"{shown_old} that the depth buffer held before."
    )
    relation = ">" if step.flag("larger_is_nearer") else "<"
    symbols = (held_name(step, where)[0] for where in ("new", "buffer"))
    one, other = (named(symbol, value) for symbol, value in zip(symbols, (new, old), strict=True))
    return text, formula_of(concludes("appended", "left out", one.compared(relation, other)))


def who_is_in_front(step: StepValues) -> Asked | None:
    """Ask which triangle a sorted list begins with, where there are several."""
    if step.whole("length") < 2:
        return None
    answer = f"{step.name}, whose {quantity_of(step)[0]} is {spoken(step.number('stored'))}, is in front."
    return number(
        f"The {step.whole('length')} hits of {step.the_pixel} are sorted. What is the number of the "
        f"{step.nouns.one} in front?",
        step.triangle,
        answer,
    )


@explains("depth.list-front.sort", asks=who_is_in_front)
def sorted_to_front(step: StepValues) -> Said:
    """The front of a sorted list."""
    length, depth = step.whole("length"), spoken(step.number("stored"))
    if length == 1:
        return f"{step.pixel_name}: {step.name} is alone in the list, and there is nothing to sort."
    how = f"with {quantity_of(step)[0]} = {depth}"
    return f"{step.pixel_name}: sorted from front to back, {how}, {step.name} is the first of {length} hits."


@explains("depth.list-front.resolve", decides=True)
def front_seen(step: StepValues) -> Said:
    """What becomes of the front."""
    if step.flag("shows_through"):
        return f"{step.pixel_name}: {step.name} is to be blended, with nothing in front of it{_stored(step)}."
    if step.whole("length") == 1:
        return f"{step.pixel_name}: {step.name} is seen{_stored(step)}."
    return f"{step.pixel_name}: {step.name} is seen, as in opaque drawing the front hides the rest{_stored(step)}."


@explains("depth.list-next.sort")
def sorted_behind(step: StepValues) -> Said:
    """A hit behind another in the sorted list."""
    new, ahead = step.number("stored"), step.number("front_depth")
    in_front, place = step.named_primitive(step.whole("in_front")), step.whole("place")
    if new == ahead:
        text = (
            f"as near as {in_front}, which was drawn first and stays in front: {step.name} has place {place}."
        )
        return f"{step.pixel_name}: {text}"
    shown, shown_ahead = pair_text(new, ahead)
    quantity, symbol, _ = quantity_of(step)
    text = f"with {quantity} = {shown}, {step.name} has place {place}, behind {in_front} with {shown_ahead}."
    relation = "<" if step.flag("larger_is_nearer") else ">"
    behind = named(f"{symbol}_{{{place}}}", new).compared(relation, named(f"{symbol}_{{{place - 1}}}", ahead))
    return f"{step.pixel_name}: {text}", formula_of(concludes("behind", "behind", behind))


@explains("depth.list-next.resolve", asks=is_kept, decides=True)
def rest_seen(step: StepValues) -> Said:
    """What becomes of a hit that is not in front."""
    if step.flag("shows_through"):
        return f"{step.pixel_name}: {step.name} is to be blended, too{_stored(step)}."
    return f"{step.pixel_name}: {step.name} is not seen, as in opaque drawing the front hides the rest."


def _stored(step: StepValues) -> str:
    """Return what the depth buffer gets, as the end of a sentence."""
    return "; the depth buffer gets its depth" if step.flag("is_stored") else ""


shows(
    "depth",
    {
        "length": VariableText("hits", "Hits in the list of the pixel or sample."),
        "place": VariableText("place", "Place in the drawing order, counted from 0."),
        "in_front": VariableText("in front", "The triangle just in front of it in the sorted list."),
        "front_depth": VariableText(
            "in front: depth", "What the depth format stores of that one.", "in_front"
        ),
    },
)
shows("depth.list-front|list-next", {"place": VariableText("place", "Place in the sorted list, 1 in front.")})
shows(
    "depth.hit|hit-beyond",
    {"before": given("before", "What the depth buffer held before the first hit.")},
)
hides("depth.hit|hit-beyond", ("place", "in_front", "front_depth"))
hides("depth.out-of-range|discarded", ("length", "place", "in_front", "front_depth"))
hides("depth.list-front", ("in_front", "front_depth"))


_APPENDED = (
    FilledColumn(
        "depth", "What the depth format stores of the hit.", lambda step: step.number("stored"), "stored"
    ),
)
_PLACE = TableColumn("place", "Place in the sorted list, 1 in front.")


@tabulates("depth", ("hit",))
def list_of_pixel(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the list of a pixel or sample, rows (R,) of its hits: as appended, then with places."""
    steps, columns = trace.steps, trace.columns
    column, row = trace.pixel[rows[0]].tolist()
    own, place = trace.rows_at_pixel(column, row), f"pixel ({column}, {row})"
    if "sample" in columns:
        current, _ = steps.row_at(position)
        sample = int(columns["sample"][current if current in own else rows[0]])
        own, place = own[columns["sample"][own] == sample], f"sample {sample} of {place}"
        rows = rows[np.isin(rows, own)]
    is_sorted = np.isin(steps.kind[own], [steps.kinds.index(kind) for kind in ("list-front", "list-next")])
    ranked = own[is_sorted]
    labels = [str(number) for number in trace.triangle[rows].tolist()]
    note = f"{counted(len(ranked), 'hit')}, {trace.triangle[ranked[0]]} in front."
    table = filled_table(
        trace,
        rows,
        position,
        f"List of {place}",
        "Triangle",
        labels,
        _APPENDED,
        closing=int(ranked[-1]),
        note=note,
        grows=True,
    )
    cells = [[*line, None] for line in table.cells]
    at, made = table.row, set(table.made)
    order = {primitive: k for k, primitive in enumerate(columns["primitive"][rows].tolist())}
    for rank, of in enumerate(ranked.tolist(), start=1):
        line, known = order[int(columns["primitive"][of])], int(steps.starts[of]) + 1
        if position >= known:
            cells[line][-1] = TableCell(*cell_texts(rank), known)
            at = line
        if position == known:
            made.add((line, 1))
    return replace(
        table,
        columns=(*table.columns, _PLACE),
        cells=tuple(tuple(line) for line in cells),
        made=frozenset(made),
        row=at,
    )
