"""Fills that test pixels or rows, told step by step: the decision, spans, and the scanline fill as LMU prints it."""

import math
from functools import partial

import numpy as np

from core.coverage.edges import is_inside
from core.coverage.number_formats import bit_pattern
from core.coverage.snapping import SUBPIXELS
from core.coverage.told_edges import in_format, number_format, on_edge, on_own_edges
from core.coverage.traced_rows import PRINTED
from core.explain.formulas import HALF, below, call, concludes, formula_of, named, upright
from core.explain.number_text import is_remainder, spoken
from core.explain.records import Asked, choice
from core.explain.step_values import REMARKS, Said, StepValues, explains
from core.explain.steps import CENTRE, COEFFICIENTS, VariableText, given, hides, shows
from core.records.arrays import Flags, Integers
from core.records.listing import Columns
from core.records.words import counted, joined
from core.spans.told import OF_LANE, OF_PASS, OF_SPANS

# Fills that test pixels or rows: edge functions at a centre, the decision, spans between crossings.


SIDES = ("first", "second")
SNAP_DISTANCE = 1 / SUBPIXELS
"""Largest distance in pixels at which snapping can reverse a decision."""


def covered(step: StepValues) -> Asked:
    """Ask whether a pixel is covered."""
    is_covered = step.flag("covered")
    values = ", ".join(spoken(step.number(f"value_{k}")) for k in range(3))
    return choice(
        f"Does triangle {step.triangle} cover {step.the_pixel}?",
        0 if is_covered else 1,
        f"{step.the_pixel} is {'inside' if is_covered else 'outside'}; E0, E1, E2 are {values}.",
    )


def _away(step: StepValues, edge: int) -> str:
    """Return a distance from an edge with its unit, or nothing where the edge is no line."""
    distance = step.vector("distance")[edge]
    return f"{spoken(distance)} px" if math.isfinite(distance) else ""


@explains("raster.test.edge")
def edge_value(step: StepValues) -> Said:
    """One edge function at a pixel's centre."""
    k, (x, y), (a, b, c) = step.edge, step.centre, step.plane(step.edge)
    value, away = step.number(f"value_{k}"), _away(step, k)
    text = f"{step.pixel_name}: E{k} of triangle {step.triangle} is {spoken(value)} at its centre ({x}, {y})"
    if math.isnan(value):
        text += f", which is not a number, so it is outside edge {k}."
    elif value == 0:
        text += f": it lies {on_edge(step, k)}."
    elif value > 0:
        text += f", so it is inside edge {k}{f', {away} away' if away else ''}{_scale(step, k)}."
    else:
        text += f", so it is outside edge {k}{f' ({away})' if away else ''}{_scale(step, k)}."
    return text, formula_of(in_format(step, named(f"E_{k}", value), a * x + b * y + c))


def _scale(step: StepValues, k: int) -> str:
    """Return the value of an edge function at the opposite corner, where it is twice the area."""
    slopes = [sum(step.vector(name)) for name in "ab"]
    area = sum(step.vector("c"))
    # Together they are 2A at every point, where all corners are projected and nothing is rounded.
    return f"; at corner {k} it is 2A = {spoken(area)}" if slopes == [0, 0] and area > 0 else ""


@explains("raster.step|climb.edge")
def added_value(step: StepValues) -> Said:
    """One edge function as the neighbour's and a coefficient."""
    k, is_right = step.edge, step.kind == "step"
    slope, where, neighbour = ("a", "to the left", "left") if is_right else ("b", "below", "below")
    value, before = step.number(f"value_{k}"), step.named(f"before_{k}", rf"E_{k}^{{\mathrm{{{neighbour}}}}}")
    added = named(f"{slope}_{k}", step.vector(slope)[k])
    text = (
        f"{step.pixel_name}: E{k} of triangle {step.triangle} is {spoken(value)}, from {before} at "
        f"the pixel {where} and {slope}{k} = {added}"
    )
    if math.isnan(value):
        text += f", which is not a number, so it is outside edge {k}."
    elif value == 0:
        text += f": it lies exactly on edge {k}."
    else:
        text += f", so it is {'inside' if value > 0 else 'outside'} edge {k}."
    return text, formula_of(in_format(step, named(f"E_{k}", value), before + added))


@explains("raster.test|step|climb.decide", asks=covered)
def decision(step: StepValues) -> Said:
    """Covered or not, and why; where a weight disagrees by snapping, the weight beside it."""
    values, owns, weights = step.vector("values"), step.flags("owns_tie"), step.vector("weights")
    differing = _disagreeing(values, weights, step.vector("distance"))
    notes = [
        f"E{k} ({number_format(step)}) decides, though weight λ{k} (unsnapped) is {spoken(weights[k])}"
        for k in differing
    ]
    reason = _why_covered(step, values) if step.flag("covered") else _why_outside(step, values, owns)
    tests = (named(f"E_{k}", values[k]).compared(r"\ge" if owns[k] else ">") for k in range(3))
    found = concludes("covered", "covered" if step.flag("covered") else "outside", *tests)
    of_weights = (named(rf"\lambda_{k}", weights[k]).compared() for k in differing)
    return f"{step.pixel_name} is {reason}{f'; {joined(notes)}' if notes else ''}.", formula_of(
        found, *of_weights
    )


def _disagreeing(values: list[float], weights: list[float], distance: list[float]) -> list[int]:
    """Return the edges whose snapped decision and unsnapped weight differ in sign, by snapping alone."""
    return [
        k
        for k in range(3)
        if abs(distance[k]) <= SNAP_DISTANCE
        and not is_remainder(weights[k])
        and (values[k] < 0 < weights[k] or weights[k] < 0 <= values[k])
    ]


def _why_covered(step: StepValues, values: list[float]) -> str:
    ties = [k for k in range(3) if values[k] == 0]
    if ties:
        lies = ", and ".join(on_edge(step, k) for k in ties)
        return f"covered by triangle {step.triangle}: its centre lies {lies}"
    distances = step.vector("distance")
    nearest = min(range(3), key=lambda k: distances[k] if math.isfinite(distances[k]) else math.inf)
    away = f"{_away(step, nearest)} from the nearest," if _away(step, nearest) else "nearest to"
    return (
        f"covered by triangle {step.triangle}: it is inside all three edges, {away} edge {nearest} "
        f"(E{nearest} = {spoken(values[nearest])})"
    )


def _why_outside(step: StepValues, values: list[float], owns: list[bool]) -> str:
    reasons = []
    for k in range(3):
        value, distance = spoken(values[k]), step.vector("distance")[k]
        if values[k] < 0:
            beyond = f"it lies {spoken(-distance)} px beyond edge {k} (E{k} = {value})"
            reasons.append(beyond if math.isfinite(distance) else f"edge {k} has E{k} = {value}")
        elif math.isnan(values[k]):
            reasons.append(f"E{k} is {value}, not a number")
    unowned = [on_edge(step, k) for k in range(3) if values[k] == 0 and not owns[k]]
    if not reasons:
        return f"not covered by triangle {step.triangle}: its centre lies {', and '.join(unowned)}"
    return f"outside triangle {step.triangle}: {joined(reasons + [f'it lies {text}' for text in unowned])}"


@explains("raster.accept.accept")
def accepted(step: StepValues) -> Said:
    """A pixel that is covered without a test."""
    is_block = all(math.isnan(step.number(f"crossing_{k}")) for k in range(3))
    what = "its whole block is inside"
    if not is_block:
        columns = columns_text(step.whole("start"), step.whole("stop"))
        what = f"it is in the span of row {step.whole('row')}, {columns}"
    values, owns = step.vector("values"), step.flags("owns_tie")
    outside = np.flatnonzero(~is_inside(np.array(values), np.array(owns))).tolist()
    text = f"{step.pixel_name} is covered by triangle {step.triangle} without a test of its own: {what}"
    if outside:
        listed = joined([f"E{k} = {spoken(values[k])}" for k in outside])
        if step.has("slope_0"):
            return f"{text}; the right algorithm leaves it out, since its centre is not inside ({listed})."
        return f"{text}; its own test would reject it ({listed})."
    return f"{text}{on_own_edges(step)}."


@explains("raster.span.edge")
def span_edge(step: StepValues) -> Said:
    """Where a row crosses an edge."""
    k, (a, b, c), y, row = step.edge, step.plane(step.edge), step.named("y", "y"), step.whole("row")
    if a.value == 0:
        value = b.value * y.value + c.value
        is_row_inside = is_inside(np.array(value), np.array(step.flags("owns_tie")[k]))
        text = (
            f"Row {row} of triangle {step.triangle} runs along edge {k}, and all of it is "
            f"{'inside' if is_row_inside else 'outside'} "
            f"(E{k} = {spoken(value)})."
        )
        return text, formula_of(named(f"E_{k}", value).equals(b * y + c))
    verb, limit = ("enters", "begins") if a.value > 0 else ("leaves", "ends")
    x = step.named(f"crossing_{k}", "x")
    text = (
        f"Row {row} of triangle {step.triangle} {verb} through edge {k} at x = {x}: the "
        f"span {limit} there, or farther inside."
    )
    return text, formula_of(x.equals(-((b * y + c) / a)))


def columns_text(start: int, stop: int) -> str:
    """Return ``column 3``, or ``columns 3 to 8``."""
    return f"column {start}" if stop == start + 1 else f"columns {start} to {stop - 1}"


@explains("raster.span.span")
def span(step: StepValues) -> Said:
    """The columns of a span."""
    start = step.whole("start")
    stop = step.whole("stop")
    name = f"Row {step.whole('row')} of triangle {step.triangle}"
    text = f"{name} has no pixel centre inside all three edges."
    if stop > start:
        text = f"{name} is covered in {columns_text(start, stop)}: {counted(stop - start, 'pixel')}."
    return text, formula_of(named("n", stop - start).equals(step.upright("stop") - step.upright("start")))


def _crossing_label(step: StepValues, k: int) -> str:
    return f"x{k + 1}" if step.has(f"slope_{k}") else f"x on edge {k}"


def _value_label(step: StepValues, k: int) -> str:
    return f"E{k} ({number_format(step)})"


def _value_meaning(step: StepValues, k: int) -> str:
    """Return the meaning of a decision value, with its bits in the number format."""
    meaning = (
        "Decision value: above 0 is inside. Divided by the length of (a, b) it is the distance in pixels."
    )
    layout, value = step.explanation.values.get("value_layout"), step.number(f"value_{k}")
    if layout and math.isfinite(value):
        meaning += f" Its bits in {layout}: {bit_pattern(value, str(layout))}."
    return meaning


shows(
    "raster",
    {
        **{
            f"before_{k}": given(f"E{k} before", "Value at the neighbour that it is reached from.")
            for k in range(3)
        },
        **{
            f"value_{k}": VariableText(partial(_value_label, k=k), partial(_value_meaning, k=k), edge=k)
            for k in range(3)
        },
        "covered": VariableText("covered", "Whether the pixel is drawn."),
        "tie": VariableText("on edge #", "Whether the centre lies exactly on the edge.", spread="edges"),
        "weights": VariableText(
            "λ# (unsnapped)",
            "Weight of the corner, from the unsnapped corners; near an edge its sign may differ from that of E.",
            "covered",
            "edges",
        ),
        "distance": VariableText(
            "distance #", "From the edge, in pixels; below 0 is outside.", "covered", "edges"
        ),
        **{
            f"crossing_{k}": VariableText(
                partial(_crossing_label, k=k),
                "x where the row crosses the edge.",
                edge=k,
                previous=f"crossing_before_{k}",
            )
            for k in range(3)
        },
        **{
            f"slope_{k}": VariableText(
                f"m{k + 1}", f"How far the {side} side moves to the right a row upwards."
            )
            for k, side in enumerate(SIDES)
        },
        **CENTRE,
        **COEFFICIENTS,
        "owns_tie": given("owns ties on #", "Whether a centre exactly on the edge is inside.", "edges"),
    },
)
_BEFORE = {f"before_{k}" for k in range(3)}
hides("raster.test", OF_SPANS | _BEFORE)
hides("raster.step|climb|accept", OF_SPANS)
hides("raster.span", {"column", "x"} | OF_SPANS)
hides(f"raster.{'|'.join(PRINTED)}", {"column", "x", "y", "a", "b", "c", "owns_tie"})
hides("raster.lane", {"column", "row", "x", "y", "a", "b", "c", "owns_tie"} | (OF_SPANS - OF_LANE))
hides("raster.lane-row", {"column", "x", "a", "b", "c"} | OF_LANE | OF_PASS)
hides("raster.pass", (OF_SPANS - OF_PASS) | {"owns_tie"})


# The scanline fill as LMU prints it: its sides, its columns, and what the right algorithm draws there.


_PRINTED = "|".join(PRINTED)


def _is_upper(step: StepValues) -> bool:
    """Return whether a row is of the part above a level side, which is walked downwards."""
    return step.kind.startswith("top")


@explains("raster.top-first|bottom-first.slope-0|slope-1")
def side_slope(step: StepValues) -> Said:
    """How far a side of the printed scanline fill goes to the right from row to row."""
    k = int(step.operation[-1])
    slope = step.named(f"slope_{k}", f"m_{k + 1}")
    width = step.named(f"width_{k}", rf"\Delta x_{k + 1}")
    height = step.named(f"height_{k}", rf"\Delta y_{k + 1}")
    part = "above" if _is_upper(step) else "below"
    text = f"In the part {part} a level side, the {SIDES[k]} side moves by {slope} with each row upwards."
    if height.value == 0:
        text = f"The {SIDES[k]} side has no height: its slope is taken as 0, where the printed program divides by 0."
        return text, formula_of(slope)
    return text, formula_of(slope.equals(width / height))


@explains("raster.top-first|bottom-first.ends")
def first_sides(step: StepValues) -> Said:
    """Where both sides of a part are in its first row."""
    row, x, y = step.upright("row"), step.named("part_x", "x"), step.named("part_y", "y")
    sides = [step.named(f"crossing_{k}", f"x_{k + 1}") for k in range(2)]
    text = (
        f"Row {step.whole('row')}: the part begins at its corner ({x}, {y}), so here the sides are at "
        f"x = {sides[0]} and {sides[1]}."
    )
    slopes = (step.named(f"slope_{k}", f"m_{k + 1}") for k in range(2))
    made = (side.equals(x + slope * (row - y)) for side, slope in zip(sides, slopes, strict=True))
    return text, formula_of(*made)


@explains("raster.top|bottom.next-0|next-1")
def next_side(step: StepValues) -> Said:
    """One side in the next row: x of the row before and the slope."""
    k = int(step.operation[-1])
    x, slope = step.named(f"crossing_{k}", f"x_{k + 1}"), step.named(f"slope_{k}", f"m_{k + 1}")
    before = step.named(f"crossing_before_{k}", rf"x_{k + 1}^{{\mathrm{{before}}}}")
    text = f"Row {step.whole('row')}: the {SIDES[k]} side moves on, from x = {before} to {x}."
    return text, formula_of(x.equals(before - slope if _is_upper(step) else before + slope))


def _is_wrong(columns: Columns, rows: Integers) -> Flags:
    """Return of which rows (R,) the printed scanline draws other pixels than lie in the triangle."""
    if "right_start" not in columns:
        return np.zeros(len(rows), bool)
    start, stop, right_start, right_stop, left_out = (
        columns[name][rows] for name in ("start", "stop", "right_start", "right_stop", "left_out")
    )
    is_other = (start != right_start) | (stop != right_stop)
    wrong: Flags = is_other & ((stop > start) | (right_stop > right_start)) | (left_out > 0)
    return wrong


REMARKS[f"raster.{_PRINTED}.round"] = _is_wrong


def _right_of_printed(step: StepValues) -> str:
    """Return what the right algorithm draws where the printed scanline draws something else."""
    if not step.has("right_start"):
        return ""
    start, stop, right_start, right_stop = map(step.whole, ("start", "stop", "right_start", "right_stop"))
    text = ""
    if right_stop <= right_start < stop - start:
        text = "; the right algorithm draws nothing of it, as no centre is inside"
    elif right_stop > right_start and (start, stop) != (right_start, right_stop):
        centers = "centre is" if right_stop == right_start + 1 else "centres are"
        text = f"; the right algorithm draws {columns_text(right_start, right_stop)}, whose {centers} inside"
    if count := step.whole("left_out"):
        text += f"; {counted(count, 'row')} of triangle {step.triangle} that the right algorithm draws "
        text += f"{'is' if count == 1 else 'are'} never drawn here"
    return text


@explains(f"raster.{_PRINTED}.round")
def line_rounded(step: StepValues) -> Said:
    """The columns that the printed scanline fill draws: both sides rounded."""
    start, stop, row = step.whole("start"), step.whole("stop"), step.whole("row")
    text = f"Row {row}: rounded, both sides lie outside the raster, so nothing is drawn."
    if stop > start:
        columns = f"{columns_text(start, stop)}: {counted(stop - start, 'pixel')}"
        text = f"Row {row}: the sides are rounded and both ends drawn, {columns}."
    text = text.removesuffix(".") + f"{_right_of_printed(step)}."
    crossings = [step.named(f"crossing_{k}", f"x_{k + 1}") for k in range(2)]
    made = (
        named(below(upright("column"), name), math.floor(x.value + 0.5)).equals(call("floor", x + HALF))
        for name, x in zip(SIDES, crossings, strict=True)
    )
    return text, formula_of(*made)
