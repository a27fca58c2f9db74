"""The formulas of ray casting."""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import (
    conclusion,
    digits_that_differ,
    equation,
    number_latex,
    relation,
    signed_latex,
)
from core.explain.records import Formula
from core.explain.step_values import StepValues


def hit(step: StepValues) -> Formula:
    """Where the ray meets the plane, in the coordinates X = m/W and Y = n/H."""
    a, b, c, d = (step.number(name) for name in "abcd")
    m, n = (number_latex(step.number(name)) for name in "mn")
    top = rf"{signed_latex(a)} \cdot {m} / W + {signed_latex(b)} \cdot {n} / H + {signed_latex(c)}"
    symbols = r"\frac{a \, m / W + b \, n / H + c}{d}"
    return equation(("v", step.number("nearness")), "=", (symbols, rf"\frac{{{top}}}{{{number_latex(d)}}}"))


def compared(step: StepValues) -> Formula:
    """Two hits: the larger value is nearer."""
    new, old = step.number("nearness"), step.number("nearest_nearness")
    return equation(
        (r"v_{\mathrm{new}}", new),
        (">", relation(new, old)),
        (r"v_{\mathrm{nearest}}", old),
        *conclusion("passes", "passes" if step.flag("passes") else "fails"),
        digits=digits_that_differ(new, old),
    )


def doubted(step: StepValues) -> Formula:
    """The difference of two hits against their errors."""
    new, old = step.number("nearness"), step.number("nearest_nearness")
    errors = step.number("error") + step.number("nearest_error")
    return equation(
        (r"|v_{\mathrm{new}} - v_{\mathrm{nearest}}|", abs(new - old)),
        r"\le",
        (r"e_{\mathrm{new}} + e_{\mathrm{nearest}}", errors),
    )


def exact(step: StepValues) -> Formula:
    """The sign of the difference in whole numbers."""
    return equation(
        (r"\mathrm{sign}(v_{\mathrm{new}} - v_{\mathrm{nearest}})", step.number("sign")),
        (">", relation(step.number("sign"))),
        "0",
        *conclusion("passes", "passes" if step.flag("passes") else "fails"),
    )


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **{f"depth.{kind}.hit": hit for kind in ("ray-first", "ray", "ray-exact")},
    "depth.ray.compare": compared,
    "depth.ray-exact.doubt": doubted,
    "depth.ray-exact.exact": exact,
}
