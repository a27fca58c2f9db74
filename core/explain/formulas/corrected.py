"""The formulas of affine interpolation that is corrected every n pixels."""

import math
from collections.abc import Callable, Mapping

from core.explain.formulas.equation import Part, equation, number_latex, signed_latex
from core.explain.records import Formula
from core.explain.step_values import StepValues


def row(step: StepValues) -> Formula:
    """The crossings that bound the row: those of the left edges, and of the right ones, that come first."""
    parts: list[Part] = []
    a, b, c = (step.vector(name) for name in "abc")
    y, determinant = step.number("y"), step.number("determinant")
    names = (r"x_{\mathrm{left}}", r"x_{\mathrm{right}}")
    for name, end, sign in zip(names, step.vector("row_ends"), (1, -1), strict=True):
        parts += [r"\quad"] if parts else []
        parts.append((name, end))
        edges = [k for k in range(3) if sign * a[k] * determinant > 0]
        if not edges or not math.isfinite(end):
            continue
        k = min(edges, key=lambda k: abs(-(b[k] * y + c[k]) / a[k] - end))
        rest = rf"{signed_latex(b[k])} \cdot {number_latex(y)} + {signed_latex(c[k])}"
        symbols = rf"-\frac{{b_{k} y + c_{k}}}{{a_{k}}}"
        parts += ["=", (symbols, rf"-\frac{{{rest}}}{{{number_latex(a[k])}}}")]
    return equation(*parts)


def anchors(step: StepValues) -> Formula:
    """The columns of the grid, moved to the ends of the row; a pixel beyond these is its own anchor."""
    left, right = step.vector("anchor_x")
    if left == right:
        return equation(("l", left), "=", ("r", right), "=", ("x", step.number("x")))
    before, behind = map(number_latex, step.vector("grid"))
    row_left, row_right = map(number_latex, step.vector("row_ends"))
    return equation(
        ("l", left),
        "=",
        (r"\max(g, x_{\mathrm{left}})", rf"\max({before}, {row_left})"),
        r"\quad",
        ("r", right),
        "=",
        (r"\min(g + n, x_{\mathrm{right}})", rf"\min({behind}, {row_right})"),
    )


def fraction(step: StepValues) -> Formula:
    """How far the centre is between the anchors."""
    left, right = step.vector("anchor_x")
    if left == right:
        return equation(("t", 0.0))
    x = step.number("x")
    numbers = (
        rf"\frac{{{number_latex(x)} - {signed_latex(left)}}}{{{number_latex(right)} - {signed_latex(left)}}}"
    )
    return equation(("t", step.number("fraction")), "=", (r"\frac{x - l}{r - l}", numbers))


def corrected(step: StepValues) -> Formula:
    """The perspective-correct weights at both anchors."""
    parts: list[Part] = []
    for letter, values in zip("lr", step.rows("anchor_weights"), strict=True):
        for k in range(3):
            parts += [r"\quad"] if parts else []
            parts.append((rf"\vertex{{{k}}}{{\lambda_{k}({letter})}}", values[k]))
    return equation(*parts)


def weights(step: StepValues) -> Formula:
    """The weights between those of the anchors."""
    t = step.number("fraction")
    left, right = step.rows("anchor_weights")
    parts: list[Part] = []
    for k, value in enumerate(step.vector("weights")):
        parts += [r"\quad"] if parts else []
        parts += [(rf"\lambda_{k}", value), "=", ("(1 - t)", 1 - t), r"\cdot"]
        parts += [(rf"\vertex{{{k}}}{{\lambda_{k}(l)}}", left[k]), "+", ("t", t), r"\cdot"]
        parts.append((rf"\vertex{{{k}}}{{\lambda_{k}(r)}}", right[k]))
    return equation(*parts)


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "interpolate.affine-n.row": row,
    "interpolate.affine-n.anchors": anchors,
    "interpolate.affine-n.fraction": fraction,
    "interpolate.affine-n.corrected": corrected,
    "interpolate.affine-n.weights": weights,
}
