"""What is said while the fill ``spans`` walks lanes, rows and passes: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import counted, pair_text, spoken
from core.explain.step_values import StepValues


def lane_rows(step: StepValues) -> str:
    """The rows of a triangle."""
    first, count = step.whole("first_row"), step.whole("row_count")
    heights = step.vector("corner_y")
    rows = f"row {first}" if count == 1 else f"rows {first} to {first + count - 1}"
    low, high = pair_text(min(heights), max(heights))
    return (
        f"Triangle {step.triangle} reaches from y = {low} to {high}, and of the raster the centres of {rows} "
        f"lie between: {counted(count, 'row')}."
    )


def lane_place(step: StepValues) -> str:
    """The lane of a triangle."""
    count, lane, lanes = step.whole("row_count"), step.whole("lane"), step.whole("lane_count")
    text = f"With {counted(count, 'row')} triangle {step.triangle} gets lane {lane} of {lanes}"
    if lane == 0:
        return f"{text}: lanes stand tallest first, and no triangle is taller."
    before = counted(lane, "triangle")
    return f"{text}: lanes stand tallest first, and {before} as tall or taller {_verb(lane)} before it."


def _verb(count: int) -> str:
    return "stands" if count == 1 else "stand"


def row_edge(step: StepValues) -> str:
    """Where a row crosses an edge, as a fraction."""
    k = int(step.operation.removeprefix("edge-"))
    row, dy = step.whole("row"), step.vector("dy")[k]
    if dy == 0:
        return f"Row {row} of triangle {step.triangle}: edge {k} is level, so it bounds no row."
    side = "left" if dy < 0 else "right"
    numerator, quotient = spoken(step.number(f"numerator_{k}")), spoken(step.number(f"quotient_{k}"))
    return (
        f"Row {row} (level {step.whole('level')}) crosses edge {k}, on the {side}, at column {quotient}: "
        f"the fraction {numerator} / {spoken(dy)}, of which only the division is rounded."
    )


def row_start(step: StepValues) -> str:
    """The first column of a row."""
    row, start, left, guard = (
        step.whole("row"),
        step.whole("start"),
        step.number("left"),
        step.number("left_guard"),
    )
    limit = ", where the raster begins" if math.floor(left + (1 + guard)) < start else ""
    return (
        f"Row {row} starts at column {start}{limit}: the left bound is {spoken(left)}, and a guard of "
        f"{_guard(guard)} {_tie(guard < 0)}."
    )


def row_stop(step: StepValues) -> str:
    """The end of a row."""
    row, start, stop, right, guard = (
        step.whole("row"),
        step.whole("start"),
        step.whole("stop"),
        step.number("right"),
        step.number("right_guard"),
    )
    if stop <= start:
        left = spoken(step.number("left"))
        return (
            f"Row {row} stops where it starts: no centre lies between the bounds {left} and {spoken(right)}."
        )
    limit = ", where the raster ends" if math.floor(right + (1 + guard)) > stop else ""
    return (
        f"Row {row} stops before column {stop}{limit}: the right bound is {spoken(right)}, and a guard of "
        f"{_guard(guard)} {_tie(guard > 0)}."
    )


def _guard(guard: float) -> str:
    return "−2⁻³⁵" if guard < 0 else "+2⁻³⁵"


def _tie(owns: bool) -> str:
    """Say what a guard does with a centre exactly on the bound."""
    return "counts a centre exactly on it in" if owns else "leaves a centre exactly on it out"


def row_place(step: StepValues) -> str:
    """The place of a span among all."""
    row, length, start = step.whole("row"), step.whole("length"), step.whole("start")
    if length == 0:
        return f"Row {row} of triangle {step.triangle} has no pixel centre inside, so it has no span."
    columns = f"column {start}" if length == 1 else f"columns {start} to {start + length - 1}"
    place, spans = step.whole("place"), step.whole("span_count")
    return (
        f"Row {row} of triangle {step.triangle} is covered in {columns}: {counted(length, 'pixel')}, "
        f"which makes it span {place} of {spans}, sorted longest first."
    )


def pixel_pass(step: StepValues) -> str:
    """The pass that draws a pixel."""
    number, size = step.whole("pass_number"), step.whole("pass_size")
    at = "is the first of its span" if number == 0 else f"is {counted(number, 'pixel')} from its span's start"
    others = (
        f"in one go with a pixel of each of {size - 1:,} others" if size > 2 else "with one of another span"
    )
    together = others if size > 1 else "alone, as no other span is as long"
    return f"{step.pixel_name} {at}, so pass {number} draws it, {together}."


def pixel_drawn(step: StepValues) -> str:
    """The place of a pixel in the order of execution."""
    rank = step.whole("rank")
    before, in_pass = (counted(step.whole(name), "pixel") for name in ("drawn_before", "place"))
    return (
        f"{step.pixel_name} is covered without a test of its own, and its rank is {rank}: {before} of earlier "
        f"passes and {in_pass} of this one are drawn before it."
    )


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "raster.lane.rows": lane_rows,
    "raster.lane.lane": lane_place,
    **{f"raster.lane-row.edge-{k}": row_edge for k in range(3)},
    "raster.lane-row.start": row_start,
    "raster.lane-row.stop": row_stop,
    "raster.lane-row.place": row_place,
    "raster.pass.pass": pixel_pass,
    "raster.pass.draw": pixel_drawn,
}
