"""The formulas of the fill ``spans``: lanes, crossings as fractions, columns, passes."""

import math
from collections.abc import Callable, Mapping

from core.explain.formulas.equation import (
    Part,
    comparison,
    conclusion,
    digits_that_add_up,
    equation,
    number_latex,
    vector_latex,
)
from core.explain.records import Formula
from core.explain.step_values import StepValues

GUARD_LATEX = "2^{-35}"


def lane_rows(step: StepValues) -> Formula:
    """The first row and the number of rows."""
    first, count, center = step.whole("first_row"), step.whole("row_count"), step.number("center")
    heights = step.vector("corner_y")
    nominal = math.ceil(min(heights) - center)
    symbols = r"\lceil \min(\vertex{0}{y_0}, \vertex{1}{y_1}, \vertex{2}{y_2}) - c \rceil"
    numbers = rf"\lceil \min{vector_latex(heights)} - {number_latex(center)} \rceil"
    if nominal != first:
        symbols, numbers = rf"\max({symbols}, \mathrm{{bottom}})", rf"\max({nominal}, {first})"
    return equation(
        (r"\mathrm{first}", float(first)),
        "=",
        (symbols, numbers),
        r"\quad",
        (r"\mathrm{rows}", float(count)),
        "=",
        (r"\mathrm{end}", float(first + count)),
        "-",
        (r"\mathrm{first}", float(first)),
    )


def lane_place(step: StepValues) -> Formula:
    """The lane among all."""
    return equation(
        (r"\mathrm{lane}", step.number("lane")), "<", (r"\mathrm{lanes}", step.number("lane_count"))
    )


def row_edge(step: StepValues) -> Formula:
    """The numerator, which grows by dx from level to level, and the crossing as a fraction."""
    k = int(step.operation.removeprefix("edge-"))
    dx, dy = step.vector("dx")[k], step.vector("dy")[k]
    if dy == 0:
        return equation(*comparison(f"dy_{k}", "=", 0.0), *conclusion("level", "level"))
    level, numerator = step.number("level"), step.number(f"numerator_{k}")
    first = numerator - level * dx
    digits = digits_that_add_up(numerator, [(first,), (level, dx)])
    fraction = (
        rf"\frac{{N_{k}}}{{dy_{k}}}",
        rf"\frac{{{number_latex(numerator, digits)}}}{{{number_latex(dy)}}}",
    )
    return equation(
        (f"N_{k}", numerator),
        "=",
        (rf"N_{k}^{{\mathrm{{first}}}}", first),
        "+",
        ("r", level),
        r"\cdot",
        (f"dx_{k}", dx),
        r"\quad",
        (f"q_{k}", step.number(f"quotient_{k}")),
        "=",
        fraction,
        digits=digits,
    )


def row_start(step: StepValues) -> Formula:
    """The first column right of the left crossing."""
    start = step.whole("start")
    nominal, symbols, numbers = _next_column(step, "left")
    if nominal != start:
        symbols, numbers = rf"\max({symbols}, \mathrm{{first}})", rf"\max({nominal}, {start})"
    return equation((r"\mathrm{start}", float(start)), "=", (symbols, numbers))


def row_stop(step: StepValues) -> Formula:
    """The first column right of the right crossing."""
    stop = step.whole("stop")
    nominal, symbols, numbers = _next_column(step, "right")
    if nominal > stop:
        symbols, numbers = rf"\min({symbols}, \mathrm{{end}})", rf"\min({nominal}, {stop})"
    elif nominal < stop:
        symbols, numbers = rf"\max({symbols}, \mathrm{{start}})", rf"\max({nominal}, {stop})"
    return equation((r"\mathrm{stop}", float(stop)), "=", (symbols, numbers))


def _next_column(step: StepValues, side: str) -> tuple[int, str, str]:
    """Return the next column after a crossing, and how it is computed in symbols and numbers."""
    crossing, guard = step.number(side), step.number(f"{side}_guard")
    sign = "-" if guard < 0 else "+"
    rest = rf" + 1 {sign} {GUARD_LATEX} \rfloor"
    symbols = rf"\lfloor q_{{\mathrm{{{side}}}}}{rest}"
    return math.floor(crossing + (1 + guard)), symbols, rf"\lfloor {number_latex(crossing)}{rest}"


def row_place(step: StepValues) -> Formula:
    """The length of a span, which decides its place."""
    start, length = step.number("start"), step.number("length")
    parts: list[Part] = [("n", length), "=", (r"\mathrm{stop}", start + length), "-"]
    parts.append((r"\mathrm{start}", start))
    if length:
        place = (r"\mathrm{place}", step.number("place"))
        parts += [r"\quad", place, "<", (r"\mathrm{spans}", step.number("span_count"))]
    return equation(*parts)


def pixel_pass(step: StepValues) -> Formula:
    """The pass that draws a pixel."""
    return equation(
        ("k", step.number("pass_number")),
        "=",
        (r"\mathrm{column}", step.number("column")),
        "-",
        (r"\mathrm{start}", step.number("start")),
    )


def pixel_drawn(step: StepValues) -> Formula:
    """The place of a pixel in the order of execution."""
    return equation(
        (r"\mathrm{rank}", step.number("rank")),
        "=",
        (r"\mathrm{before}_k", step.number("drawn_before")),
        "+",
        (r"\mathrm{place}", step.number("place")),
    )


FORMULAS: Mapping[str, Callable[[StepValues], Formula]] = {
    "raster.lane.rows": lane_rows,
    "raster.lane.lane": lane_place,
    **{f"raster.lane-row.edge-{k}": row_edge for k in range(3)},
    "raster.lane-row.start": row_start,
    "raster.lane-row.stop": row_stop,
    "raster.lane-row.place": row_place,
    "raster.pass.pass": pixel_pass,
    "raster.pass.draw": pixel_drawn,
}
