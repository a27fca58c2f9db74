"""The formulas of a wireframe's lines: how each method chooses its pixels, and interpolation along them."""

import math
from collections.abc import Callable, Mapping

from core.explain.formulas.equation import (
    Part,
    all_of,
    comparison,
    conclusion,
    equation,
    linear,
    number_latex,
    relation,
    signed_latex,
)
from core.explain.formulas.pixel import attribute
from core.explain.formulas.smooth_lines import GUPTA_SPROULL, RECTANGLE, WU, line_cosine, rectangle_length
from core.explain.records import Formula
from core.explain.sentences.lines import axes, line_method, major_direction, minor_direction, place_on_edge
from core.explain.step_values import StepValues


def octant(step: StepValues) -> Formula:
    """Along which axis a line is longer."""
    run, rise = step.number("run"), step.number("rise")
    is_steep = step.flag("is_steep")
    in_x, in_y = (rise, run) if is_steep else (run, rise)
    wanted = r"\ge" if line_method(step) == "bresenham-lecture" else ">"
    compared: list[Part] = [(r"|\Delta y|", in_y), (wanted, relation(in_y, in_x)), (r"|\Delta x|", in_x)]
    return equation(*compared, *conclusion("row by row", "row by row" if is_steep else "column by column"))


def lengths(step: StepValues) -> Formula:
    """The first decision value."""
    major, minor = axes(step)
    run, rise = step.number("run"), step.number("rise")
    product: list[Part] = ["2", r"\cdot", (rf"|\Delta {minor}|", rise), "-", (rf"|\Delta {major}|", run)]
    return equation(("D", 2 * rise - run), "=", *product)


def slope(step: StepValues) -> Formula:
    """The slope, and (where the line equation is used) the intercept."""
    major, minor = axes(step)
    m = step.number("slope")
    if line_method(step) == "bresenham-float":
        run, rise = max(step.number("run"), 1.0), step.number("rise")
        bars = rf"\frac{{|\Delta {minor}|}}{{|\Delta {major}|}}"
        return equation(("m", m), "=", (bars, rf"\frac{{{number_latex(rise)}}}{{{number_latex(run)}}}"))
    u, v = (1, 0) if step.flag("is_steep") else (0, 1)
    first, second = step.vector("first_end"), step.vector("second_end")
    numbers = (
        rf"\frac{{{number_latex(second[v])} - {signed_latex(first[v])}}}"
        rf"{{{number_latex(second[u])} - {signed_latex(first[u])}}}"
    )
    symbols = rf"\frac{{{minor}_1 - {minor}_0}}{{{major}_1 - {major}_0}}"
    fraction: list[Part] = ["=", (symbols, numbers)] if second[u] != first[u] else []
    return equation(("m", m), *fraction, r"\quad", ("b", step.number("intercept")))


def tested(step: StepValues) -> Formula:
    """The decision whether the minor coordinate steps."""
    line, decision = line_method(step), step.number("decision")
    done = conclusion("step", "step" if step.flag("has_stepped") else "stay")
    if line == "bresenham-float":
        return equation(*comparison("e + m", ">", decision, 0.5), *done)
    return equation(*comparison("D", ">" if line == "bresenham-lecture" else r"\ge", decision), *done)


def stepped(step: StepValues) -> Formula:
    """The minor coordinate after the decision."""
    _, minor = axes(step)
    now, moved = step.number("minor"), float(step.flag("has_stepped") * minor_direction(step))
    return equation((minor, now), "=", (rf"{minor}_{{\mathrm{{before}}}}", now - moved), "+", ("s", moved))


def evaluated(step: StepValues) -> Formula:
    """The line equation."""
    major, minor = axes(step)
    terms = [("m", step.number("slope")), ("b", step.number("intercept"))]
    return linear(minor, step.number("decision"), terms, (major, step.number("major")))


def advanced(step: StepValues) -> Formula:
    """The slope added once more."""
    _, minor = axes(step)
    decision, previous = step.number("decision"), step.number("previous")
    if math.isnan(previous):
        return equation((minor, decision))
    sign = float(major_direction(step))
    before = (rf"{minor}_{{\mathrm{{before}}}}", previous)
    return equation((minor, decision), "=", before, "+", ("s", sign), r"\cdot", ("m", step.number("slope")))


def rounded(step: StepValues) -> Formula:
    """The nearest pixel centre."""
    _, minor = axes(step)
    value = step.number("decision")
    symbols = rf"\lfloor {minor} + \frac{{1}}{{2}} \rfloor"
    numbers = rf"\lfloor {number_latex(value)} + \frac{{1}}{{2}} \rfloor"
    return equation((rf"{minor}_{{\mathrm{{pixel}}}}", step.number("minor")), "=", (symbols, numbers))


def nearest(step: StepValues) -> Formula:
    """How far the line passes from the centre."""
    _, minor = axes(step)
    half = r"\frac{1}{2}"
    away = (rf"{minor} - {minor}_{{\mathrm{{centre}}}}", step.number("decision"))
    return equation(f"-{half}", r"\le", away, r"\le", half)


def leaves(step: StepValues) -> Formula:
    """The diamond-exit test."""
    first, second = step.number("exit_start"), step.number("exit_end")
    compared = [comparison("d_0", "<", first, 0.5), comparison("d_1", r"\ge", second, 0.5)]
    return all_of(compared, *conclusion("leaves", "leaves"))


def plotted(step: StepValues) -> Formula:
    """Where the pixel's centre lies along the segment."""
    t = step.number("t")
    start, end = step.vector("window_start"), step.vector("window_end")
    length = [end[k] - start[k] for k in range(2)]
    k = 1 if abs(length[1]) > abs(length[0]) else 0
    if length[k] == 0:
        return equation(("t", t))
    axis, center = "xy"[k], (step.whole("column"), step.whole("row"))[k] + step.number("center")
    along = place_on_edge(step)
    symbols = rf"\frac{{{axis} - {axis}_0}}{{{axis}_1 - {axis}_0}}"
    numbers = (
        rf"\frac{{{number_latex(center)} - {signed_latex(start[k])}}}"
        rf"{{{number_latex(end[k])} - {signed_latex(start[k])}}}"
    )
    if along != t:
        bound = r"\max(0, " if along < 0 else r"\min(1, "
        symbols, numbers = f"{bound}{symbols})", f"{bound}{numbers})"
    return equation(("t", t), "=", (symbols, numbers))


def parts(step: StepValues) -> Formula:
    """Both ends' parts of 1/w."""
    t = number_latex(step.number("t"))
    w = [number_latex(value) for value in step.vector("end_w")]
    start, end = step.vector("parts")
    first: Part = (r"\frac{1 - t}{w_0}", rf"\frac{{1 - {t}}}{{{w[0]}}}")
    second: Part = (r"\frac{t}{w_1}", rf"\frac{{{t}}}{{{w[1]}}}")
    return equation(("p_0", start), "=", first, r"\quad", ("p_1", end), "=", second)


def total(step: StepValues) -> Formula:
    """Their sum."""
    start, end = step.vector("parts")
    return linear(r"\frac{1}{w}", step.number("total"), [("p_0", start), ("p_1", end)])


def weight(step: StepValues) -> Formula:
    """The share of the second end."""
    s = step.number("s")
    if step.kind == "line-affine":
        return equation(("s", s), "=", ("t", step.number("t")))
    numbers = rf"\frac{{{number_latex(step.vector('parts')[1])}}}{{{number_latex(step.number('total'))}}}"
    return equation(("s", s), "=", (r"\frac{p_1}{1/w}", numbers))


_START: Mapping[str, Callable[[StepValues], Formula | None]] = {"octant": octant, "plot": plotted}
_BRESENHAM: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "test": tested,
    "step": stepped,
    "plot": plotted,
}
_LINE: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "evaluate": evaluated,
    "round": rounded,
    "plot": plotted,
}
_LINE_AT: Mapping[str, Callable[[StepValues], Formula | None]] = {"evaluate": evaluated}
_DIAMOND: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "round": nearest,
    "leaves": leaves,
    "plot": plotted,
}
_KINDS: Mapping[str, Mapping[str, Callable[[StepValues], Formula | None]]] = {
    "bresenham-start": {**_START, "lengths": lengths},
    "bresenham": _BRESENHAM,
    "bresenham-lecture-start": {**_START, "lengths": lengths},
    "bresenham-lecture": _BRESENHAM,
    "bresenham-float-start": {**_START, "slope": slope},
    "bresenham-float": _BRESENHAM,
    "midpoint-start": {**_START, **_LINE, "slope": slope},
    "midpoint": _LINE,
    "dda-start": {**_START, **_LINE, "slope": slope},
    "dda": {"advance": advanced, "round": rounded, "plot": plotted},
    "dda-float32-start": {**_START, **_LINE, "slope": slope},
    "dda-float32": {"advance": advanced, "round": rounded, "plot": plotted},
    "diamond-exit-start": {**_START, **_DIAMOND},
    "diamond-exit": _DIAMOND,
    "rectangle-start": {**_START, **RECTANGLE, "length": rectangle_length, "plot": plotted},
    "rectangle": {**RECTANGLE, "plot": plotted},
    "wu-start": {**_START, **_LINE_AT, **WU, "slope": slope, "plot": plotted},
    "wu": {**_LINE_AT, **WU, "plot": plotted},
    "gupta-sproull-start": {
        **_START,
        **_LINE_AT,
        **GUPTA_SPROULL,
        "slope": slope,
        "cosine": line_cosine,
        "plot": plotted,
    },
    "gupta-sproull": {**_LINE_AT, **GUPTA_SPROULL, "plot": plotted},
}

FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **{f"raster.{kind}.{name}": make for kind, of_kind in _KINDS.items() for name, make in of_kind.items()},
    "interpolate.line-perspective.parts": parts,
    "interpolate.line-perspective.total": total,
    "interpolate.line-perspective.weight": weight,
    "interpolate.line-affine.weight": weight,
    **{f"interpolate.line-{kind}.value": attribute for kind in ("perspective", "affine")},
}
