"""The scanline fill as LMU prints it: its sides, its columns, and what the right algorithm draws there."""

import math

import numpy as np

from core.explain.digits import number_latex, signed_latex, spoken, vector_text
from core.explain.equation import Part, beside, equation, fraction
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
    slope, width, height = (step.number(f"{name}_{k}") for name in ("slope", "width", "height"))
    part = "above" if _is_upper(step) else "below"
    text = f"In the part {part} a level side, the {SIDES[k]} side moves by {spoken(slope)} with each row upwards."
    if height == 0:
        text = f"The {SIDES[k]} side has no height: its slope is taken as 0, where the printed program divides by 0."
        return text, equation((f"m_{k + 1}", slope))
    quotient = fraction((rf"\Delta x_{k + 1}", width), (rf"\Delta y_{k + 1}", height))
    return text, equation((f"m_{k + 1}", slope), "=", quotient)


@explains("raster.top-first|bottom-first.ends")
def first_sides(step: StepValues) -> Said:
    """Where both sides of a part are in its first row."""
    row, x, y = step.whole("row"), step.number("part_x"), step.number("part_y")
    first, second = (step.number(f"crossing_{k}") for k in range(2))
    text = (
        f"Row {row}: the part begins at its corner {vector_text([x, y])}, so here the sides are at "
        f"x = {spoken(first)} and {spoken(second)}."
    )
    height: Part = (r"(\mathrm{row} - y)", f"({row} - {signed_latex(y)})")
    sides: list[list[Part]] = []
    for k, at in enumerate((first, second)):
        slope = (f"m_{k + 1}", step.number(f"slope_{k}"))
        sides.append([(f"x_{k + 1}", at), "=", ("x", x), "+", slope, r"\cdot", height])
    return text, equation(*beside(*sides))


@explains("raster.top|bottom.next-0|next-1")
def next_side(step: StepValues) -> Said:
    """One side in the next row: x of the row before and the slope."""
    k = int(step.operation[-1])
    x, before, slope = (step.number(f"{name}_{k}") for name in ("crossing", "crossing_before", "slope"))
    sign = "-" if _is_upper(step) else "+"
    text = f"Row {step.whole('row')}: the {SIDES[k]} side moves on, from x = {spoken(before)} to {spoken(x)}."
    name = f"x_{k + 1}"
    return text, equation(
        (name, x), "=", (rf"{name}^{{\mathrm{{before}}}}", before), sign, (f"m_{k + 1}", slope)
    )


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
    sides: list[list[Part]] = []
    for k, name in enumerate(SIDES):
        crossing = step.number(f"crossing_{k}")
        symbols = rf"\lfloor x_{k + 1} + \frac{{1}}{{2}} \rfloor"
        numbers = rf"\lfloor {number_latex(crossing)} + \frac{{1}}{{2}} \rfloor"
        column = rf"\mathrm{{column}}_{{\mathrm{{{name}}}}}"
        sides.append([(column, float(math.floor(crossing + 0.5))), "=", (symbols, numbers)])
    return text, equation(*beside(*sides))
