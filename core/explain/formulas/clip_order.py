"""The formulas of clipping after the division, and of new corners that are computed in the polygon's order."""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import (
    Part,
    comparison,
    conclusion,
    digits_that_add_up,
    equation,
    number_latex,
    signed_latex,
)
from core.explain.records import Formula
from core.explain.step_values import AXES, StepValues


def divided(step: StepValues) -> Formula:
    """The three quotients of a corner."""
    clip, ndc = step.vector("clip"), step.vector("ndc")
    parts: list[Part] = []
    for axis, value, numerator in zip(AXES, ndc, clip, strict=False):
        parts += [r"\quad"] if parts else []
        fraction = rf"\frac{{{number_latex(numerator)}}}{{{number_latex(clip[3])}}}"
        parts += [(rf"{axis}_{{\mathrm{{ndc}}}}", value), "=", (rf"\frac{{{axis}}}{{w}}", fraction)]
    return equation(*parts)


def sign(step: StepValues) -> Formula:
    """The sign that the quotients do not show any more."""
    compared = comparison("w", ">", step.vector("clip")[3])
    return equation(*compared, *conclusion("in front", "mirrored"))


def undefined(step: StepValues) -> Formula:
    """The w of a triangle that cannot be divided."""
    w = step.vector("clip")[3]
    return equation(*comparison("w", r"\ne", w), *conclusion("divide", "drop the triangle"))


def crossing(step: StepValues) -> Formula:
    """Where an edge crosses a plane, from its start."""
    first, second = step.number("start_distance"), step.number("end_distance")
    symbols = r"\frac{d_{\mathrm{start}}}{d_{\mathrm{start}} - d_{\mathrm{end}}}"
    numbers = rf"\frac{{{number_latex(first)}}}{{{number_latex(first)} - {signed_latex(second)}}}"
    return equation(("t", step.number("t")), "=", (symbols, numbers))


def new_corner(step: StepValues) -> Formula:
    """The corner made there, in the component that changes most."""
    start, end = step.vector("start"), step.vector("end")
    place = max(range(4), key=lambda k: abs(end[k] - start[k]))
    axis, t, value = AXES[place], step.number("t"), step.vector("corner")[place]
    digits = digits_that_add_up(value, [(start[place],), (t, end[place]), (-1.0, t, start[place])])
    span = f"({number_latex(end[place], digits)} - {signed_latex(start[place], digits)})"
    symbols = rf"({axis}_{{\mathrm{{end}}}} - {axis}_{{\mathrm{{start}}}})"
    first: Part = (rf"{axis}_{{\mathrm{{start}}}}", start[place])
    return equation((axis, value), "=", first, "+", ("t", t), r"\cdot", (symbols, span), digits=digits)


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "clip.divided.divide": divided,
    "clip.mirrored.divide": divided,
    "clip.mirrored.sign": sign,
    "clip.undefined.drop": undefined,
    **{f"clip.{case}.t-in-order": crossing for case in ("in-out", "out-in")},
    **{f"clip.{case}.corner-in-order": new_corner for case in ("in-out", "out-in")},
}
