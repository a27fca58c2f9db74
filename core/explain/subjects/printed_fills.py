"""The scanline fill as LMU prints it: its sides, its columns, and what the right algorithm draws there."""

import math

import numpy as np

from core.explain.formulas import HALF, below, call, formula_of, named, upright
from core.explain.rows import REMARKS, Said, explains
from core.explain.step_values import StepValues
from core.explain.subjects.fills import SIDES, columns_text
from core.records.arrays import Flags, Integers
from core.records.operation import Columns
from core.records.words import counted
from core.trace.raster_rows import PRINTED

_PRINTED = "|".join(PRINTED)


def _is_upper(step: StepValues) -> bool:
    """Return whether a row is of the part above a level side, which is walked downwards."""
    return step.kind.startswith("top")


@explains("raster.top-first|bottom-first.slope-0|slope-1")
def side_slope(step: StepValues) -> Said:
    """How far a side of the printed scanline fill goes to the right from row to row."""
    k = int(step.operation[-1])
    slope = step.named(f"slope_{k}", f"m_{k + 1}")
    width, height = (
        step.named(f"width_{k}", rf"\Delta x_{k + 1}"),
        step.named(f"height_{k}", rf"\Delta y_{k + 1}"),
    )
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
