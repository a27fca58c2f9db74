"""Binning: the bounding box of a triangle, and blocks that lie inside, outside or neither."""

import math

from core.coverage.told_edges import in_format
from core.explain.formulas import Chain, call, concludes, formula_of, limited, named, upright
from core.explain.number_text import spoken
from core.explain.records import Asked, Formula, choice
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import COEFFICIENTS, VariableText, given, hides, shows
from core.explain.term_latex import TermLatex, Written
from core.records.terms import Term, term
from core.records.words import counted, joined, numbered


@explains("bin.box|outer-box.low")
def box_low(step: StepValues) -> Said:
    """The first column and row of the box."""
    is_outer, center = step.kind == "outer-box", step.named("center", "c")
    sides: list[Chain] = []
    least: list[float] = []
    is_limited = False
    for name, axis, values in zip(
        ("column", "row"), "xy", zip(*step.rows("corners"), strict=True), strict=True
    ):
        first, low = step.whole(name), min(values)
        least.append(low)
        minimum: Term = call("min", *(named(f"{axis}_{k}", at).of_vertex(k) for k, at in enumerate(values)))
        if is_outer:
            low = float(math.floor(low))
            minimum = named(rf"\lfloor {TermLatex(False).text(minimum)} \rfloor", low)
        pixel, nominal = call("ceil", minimum - center), math.ceil(low - center.value)
        is_limited |= first != nominal
        sides.append(named(upright(name), first).equals(limited("max", pixel, nominal, "first", first)))
    text = f"The box of triangle {step.triangle} begins at column {step.whole('column')} and row {step.whole('row')}: "
    x, y = map(spoken, least)
    if is_outer:
        text += f"its least x, {x}, and y, {y}, are rounded down to whole pixels first, to be safe."
    else:
        centre = f"the first pixel centre{' of the raster' if is_limited else ''}"
        text += f"{centre} at or beyond its least x, {x}, and its least y, {y}."
    return text, formula_of(*sides)


def _box_size(step: StepValues) -> tuple[int, int]:
    return step.whole("column_end") - step.whole("column"), step.whole("row_end") - step.whole("row")


def _product(columns: int, rows: int) -> str:
    return f"{columns} × {rows} = {counted(columns * rows, 'pixel')}"


@explains("bin.box|outer-box.high")
def box_high(step: StepValues) -> Said:
    """The columns and rows of the box."""
    columns, rows = _box_size(step)
    text = f"The box is empty: triangle {step.triangle} can cover no pixel centre of the raster."
    if columns > 0 and rows > 0:
        text = (
            f"The box ends with column {step.whole('column_end') - 1} and row {step.whole('row_end') - 1}, so "
            f"{_product(columns, rows)} may be covered."
        )
    sides = (
        named(axis, count).equals(
            step.named(f"{name}_end", rf"{upright(name)}_{{\mathrm{{end}}}}") - step.upright(name)
        )
        for name, axis, count in (("column", "n_x", columns), ("row", "n_y", rows))
    )
    return text, formula_of(*sides)


@explains("bin.behind.drop")
def behind(step: StepValues) -> Said:
    """No corner in front of the eye."""
    text = f"Triangle {step.triangle} is behind the eye, as no corner has w above 0, and no pixel is tested."
    tests = (Chain((Written(f"w_{k}"), term(0)), (r"\le",)) for k in range(3))
    return text, formula_of(concludes("nothing to draw", "nothing to draw", *tests))


@explains("bin.whole-image.keep")
def whole_image(step: StepValues) -> Said:
    """Some corner cannot be projected."""
    columns, rows = _box_size(step)
    beginning = f"Not every corner of triangle {step.triangle} has a snapped position in the window"
    if columns <= 0 or rows <= 0:
        return f"{beginning}, and it has no area, so no pixel is tested."
    return f"{beginning}, so no box bounds it and all {_product(columns, rows)} may be covered."


def _block(step: StepValues) -> str:
    size = step.whole("size")
    return f"block at column {step.whole('column')}, row {step.whole('row')} ({size} × {size} pixels)"


def _bounds(step: StepValues, name: str) -> str:
    return joined([f"E{k} = {spoken(value)}" for k, value in enumerate(step.vector(name))])


@explains("bin.block.high")
def block_high(step: StepValues) -> Said:
    """The greatest values of the edge functions in a block."""
    text, edge = (
        f"In the {_block(step)} the greatest values of triangle {step.triangle} are {_bounds(step, 'high')}",
        step.whole("rejected_by"),
    )
    rejected = f", so all of it is outside edge {edge}" if edge >= 0 else ""
    return f"{text}{rejected}.", _bound(step, "high", r"\max")


@explains("bin.block.low")
def block_low(step: StepValues) -> Said:
    """The least values of the edge functions in a block."""
    return (
        f"In the {_block(step)} the least values of triangle {step.triangle} are {_bounds(step, 'low')}.",
        _bound(step, "low", r"\min"),
    )


def _bound(step: StepValues, name: str, extreme: str) -> Formula:
    """Return the value of the deciding edge at the corner of the block where it is greatest or least."""
    values, rejected = step.vector(name), step.whole("rejected_by")
    k = rejected if name == "high" and rejected >= 0 else min(range(3), key=lambda k: values[k])
    a, b, c = step.plane(k)
    reach = step.whole("size") - 1
    x, y = (
        named(
            axis, step.whole(place) + step.number("center") + reach * ((slope.value > 0) == (name == "high"))
        )
        for axis, place, slope in (("x", "column", a), ("y", "row", b))
    )
    return formula_of(in_format(step, named(rf"E_{k}^{{{extreme}}}", values[k]), a * x + b * y + c))


def verdict(step: StepValues) -> Asked:
    """Ask where a block lies."""
    found, size = step.text("verdict"), step.whole("size")
    answer = {"outside": 0, "inside": 1}.get(found, 2)
    where = f"the {size} × {size} block at ({step.whole('column')}, {step.whole('row')})"
    reveal = f"{where} is {found}." if answer < 2 else f"an edge crosses {where}."
    text = f"Is {where} outside triangle {step.triangle}, inside it, or neither?"
    return choice(text, answer, reveal, ("Outside", "Inside", "Neither"))


@explains("bin.block.verdict", asks=verdict)
def block_verdict(step: StepValues) -> Said:
    """Whether a block is rejected, accepted, split, or tested pixel by pixel."""
    name, found, edge = _block(step), step.text("verdict"), step.whole("rejected_by")
    low = step.vector("low")
    if found == "outside":
        high = named(rf"E_{edge}^{{\max}}", step.vector("high")[edge])
        text = (
            f"The {name} is rejected by edge {edge} of triangle {step.triangle}: even its greatest E{edge} "
            f"there, {high}, is outside."
        )
        return text, formula_of(concludes("outside", "outside", high.compared("<")))
    crossing = [k for k in range(3) if not low[k] > 0]
    edges = (
        f"{numbered('edge', crossing)} of triangle {step.triangle} may cross it" if crossing else "unclear"
    )
    text, verdict = {
        "inside": (
            f"The {name} is accepted as a whole: even the least value of every edge function is inside.",
            "inside",
        ),
        "split": (
            f"The {name} is neither in nor out ({edges}), so it is split into smaller blocks.",
            "split",
        ),
        "leaf": (
            f"The {name} is neither in nor out ({edges}), so its pixels are tested one by one.",
            "test its pixels",
        ),
    }[found]
    least = (named(rf"E_{k}^{{\min}}", value).compared(">") for k, value in enumerate(low))
    return text, formula_of(concludes("inside", verdict, *least))


shows(
    "bin",
    {
        "corners": VariableText("corner #", "Position used for coverage, in pixels.", spread="edges"),
        "column": given("column", "First column of the box or block."),
        "column_end": given("column end", "Column after the last."),
        "row": given("row", "First row of the box or block."),
        "row_end": given("row end", "Row after the last."),
        "size": given("size", "Pixels on a side of the block; 0 for a box."),
        "center": given("c (centre)", "Position of a pixel's centre, from its lower left corner."),
        "high": VariableText("E# max", "Greatest value of the edge function in the block.", spread="edges"),
        "low": VariableText("E# min", "Least value of the edge function in the block.", spread="edges"),
        "rejected_by": VariableText("rejected by", "Edge that the whole block lies outside of; −1: none."),
        "verdict": VariableText(
            "verdict", "Whether the block is outside, inside, split, or tested by pixels."
        ),
        **COEFFICIENTS,
    },
)
hides("bin.box|outer-box", ("size", "a", "b", "c"))
hides("bin.whole-image", ("size", "center", "a", "b", "c"))
hides("bin.behind", ("column", "column_end", "row", "row_end", "size", "center", "a", "b", "c"))
