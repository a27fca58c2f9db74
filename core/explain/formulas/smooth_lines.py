"""The formulas of lines with intensities, of rectangles, and of what blends them."""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import Part, equation, number_latex, signed_latex
from core.explain.formulas.frame import FORMULAS as FRAME_FORMULAS
from core.explain.records import Formula
from core.explain.sentences.smooth_lines import LINE_BLENDS, minor_axis
from core.explain.step_values import StepValues

_HALF = r"\frac{1}{2}"


def rectangle_length(step: StepValues) -> Formula:
    """The length of a rectangle."""
    run, rise = number_latex(step.number("run")), number_latex(step.number("rise"))
    symbols, numbers = r"\sqrt{\Delta x^2 + \Delta y^2}", rf"\sqrt{{{run}^2 + {rise}^2}}"
    if step.flag("is_steep"):
        numbers = rf"\sqrt{{{rise}^2 + {run}^2}}"
    return equation(("L", step.number("length")), "=", (symbols, numbers))


def across(step: StepValues) -> Formula:
    """The distance from the line, between the long sides."""
    (x0, y0), (x1, y1) = step.vector("first_end"), step.vector("second_end")
    x, y = step.pixel
    symbols = r"\frac{\Delta x (y - y_0) - \Delta y (x - x_0)}{L}"
    products = (
        rf"{signed_latex(x1 - x0)} \cdot ({number_latex(y)} - {signed_latex(y0)}) - "
        rf"{signed_latex(y1 - y0)} \cdot ({number_latex(x)} - {signed_latex(x0)})"
    )
    numbers = rf"\frac{{{products}}}{{{number_latex(step.number('length'))}}}"
    away = ("a", step.number("decision"))
    return equation(f"-{_HALF}", r"\le", away, r"\le", _HALF, r"\quad", "a", "=", (symbols, numbers))


def along(step: StepValues) -> Formula:
    """The place along the line, between the short sides."""
    return equation("0", r"\le", ("s", step.number("along")), "<", ("L", step.number("length")))


def share(step: StepValues) -> Formula:
    """How much of a column the line spans."""
    axis, k = ("y", 1) if step.flag("is_steep") else ("x", 0)
    low, high = sorted((step.vector("first_end")[k], step.vector("second_end")[k]))
    at = number_latex(step.number("major"))
    symbols = rf"\min({axis} + {_HALF}, {axis}_{{\max}}) - \max({axis} - {_HALF}, {axis}_{{\min}})"
    numbers = rf"\min({at} + {_HALF}, {number_latex(high)}) - \max({at} - {_HALF}, {number_latex(low)})"
    return equation(("g", step.number("share")), "=", (symbols, numbers))


def divided(step: StepValues) -> Formula:
    """The intensity by Wu."""
    axis, fraction = minor_axis(step), step.number("fraction")
    is_lower = step.number("minor") <= step.number("decision")
    part: Part = ("(1 - f)", f"(1 - {number_latex(fraction)})") if is_lower else ("f", fraction)
    of_fraction = (rf"{axis} - \lfloor {axis} \rfloor", number_latex(fraction))
    intensity = ("I", step.number("intensity"))
    share_of_column = ("g", step.number("share"))
    return equation("f", "=", of_fraction, r"\quad", intensity, "=", part, r"\cdot", share_of_column)


def line_cosine(step: StepValues) -> Formula:
    """The cosine of the line's angle with its longer axis."""
    slope = step.number("slope")
    symbols, numbers = r"\frac{1}{\sqrt{1 + m^2}}", rf"\frac{{1}}{{\sqrt{{1 + {signed_latex(slope)}^2}}}}"
    return equation(("c", step.number("cosine")), "=", (symbols, numbers))


def distance(step: StepValues) -> Formula:
    """The distance of a pixel's centre from the line."""
    axis = minor_axis(step)
    minor, line = number_latex(step.number("minor")), signed_latex(step.number("decision"))
    apart = (rf"|{axis}_{{\mathrm{{pixel}}}} - {axis}|", f"|{minor} - {line}|")
    return equation(("d", step.number("line_distance")), "=", apart, r"\cdot", ("c", step.number("cosine")))


def filtered(step: StepValues) -> Formula:
    """The intensity by the filter's table."""
    value = (rf"T_{{\lfloor 16 d + {_HALF} \rfloor}}", step.number("filtered"))
    return equation(("I", step.number("intensity")), "=", value, r"\cdot", ("g", step.number("share")))


def weighed(step: StepValues) -> Formula:
    """Alpha scaled by the line's intensity."""
    product: list[Part] = [(r"a_{\mathrm{shaded}}", step.vector("color")[3]), r"\cdot"]
    return equation(
        (r"a_{\mathrm{source}}", step.vector("source")[3]), "=", *product, ("I", step.number("intensity"))
    )


RECTANGLE: Mapping[str, Callable[[StepValues], Formula | None]] = {"across": across, "along": along}
WU: Mapping[str, Callable[[StepValues], Formula | None]] = {"share": share, "divide": divided}
GUPTA_SPROULL: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "share": share,
    "distance": distance,
    "filter": filtered,
}

BLEND_FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **{
        key.replace("blend.", "blend.line-"): FRAME_FORMULAS[key]
        for key in LINE_BLENDS
        if key in FRAME_FORMULAS
    },
    **{f"blend.line-{key.split('.')[1]}.weigh": weighed for key in LINE_BLENDS},
}
"""Formulas of blending where the fragment is a line's: weighed first, then as any other."""
