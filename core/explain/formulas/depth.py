"""The formulas of the depth test, whatever the depth buffer holds."""

from collections.abc import Callable, Mapping

from core.explain.formulas import rays as formulas_rays
from core.explain.formulas.equation import (
    all_of,
    comparison,
    conclusion,
    digits_that_differ,
    equation,
    linear,
    number_latex,
    relation,
)
from core.explain.records import Formula
from core.explain.step_values import StepValues

SYMBOLS = {
    "z": ("z", "depth"),
    "inverse-w": (r"\frac{1}{w}", "inverse_w"),
    "reversed-z": ("r", "value"),
    "logarithm": ("l", "value"),
}
"""Quantity of the depth buffer to its symbol and the name of its number."""


def depth_stored(step: StepValues) -> Formula:
    """The depth as it is stored."""
    quantity = step.depth_quantity()
    symbol, name = SYMBOLS[quantity]
    value = number_latex(step.number(name))
    if quantity == "z" and step.has("scale"):
        scale = number_latex(step.number("scale"))
        symbols, numbers = (
            rf"\mathrm{{round}}(\mathrm{{steps}} \cdot {symbol})",
            rf"\mathrm{{round}}({scale} \cdot {value})",
        )
        return equation((r"z_{\mathrm{new}}", step.number("stored")), "=", (symbols, numbers))
    return equation(
        (r"z_{\mathrm{new}}", step.number("stored")),
        "=",
        (rf"\mathrm{{store}}({symbol})", rf"\mathrm{{store}}({value})"),
    )


def value_made(step: StepValues) -> Formula:
    """The reversed or the logarithmic depth."""
    value = step.number("value")
    if step.depth_quantity() == "logarithm":
        inverse_w, near, far = (number_latex(step.number(name)) for name in ("inverse_w", "near", "far"))
        symbols = r"\frac{\log_2 (w / n)}{\log_2 (f / n)}"
        numbers = rf"\frac{{\log_2 (1 / ({inverse_w} \cdot {near}))}}{{\log_2 ({far} / {near})}}"
        return equation(("l", value), "=", (symbols, numbers))
    if step.has("t"):
        t, (start, end) = step.number("t"), step.vector("ends")
        return equation(
            ("r", value),
            "=",
            ("(1 - t)", f"(1 - {number_latex(t)})"),
            r"\cdot",
            ("r_0", start),
            "+",
            ("t", t),
            r"\cdot",
            ("r_1", end),
        )
    coefficients = [(name, step.number(name)) for name in "abc"]
    return linear("r", value, coefficients, ("x", step.number("x")), ("y", step.number("y")))


def compared(step: StepValues) -> Formula:
    """The depth test: what is asked, over what holds."""
    stored, before = step.number("stored"), step.number("before")
    wanted = ">" if step.flag("larger_is_nearer") else "<"
    return equation(
        (r"z_{\mathrm{new}}", stored),
        (wanted, relation(stored, before)),
        (r"z_{\mathrm{buffer}}", before),
        *conclusion("passes", "passes" if step.flag("passes") else "fails"),
        digits=digits_that_differ(stored, before),
    )


def out_of_range(step: StepValues) -> Formula:
    """The depth range."""
    depth = step.number("depth")
    tests = [comparison("z", r"\ge", depth), comparison("z", r"\le", depth, 1.0)]
    return all_of(tests, *conclusion("kept", "dropped"))


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "depth.test.value": value_made,
    "depth.test.depth": depth_stored,
    "depth.test.compare": compared,
    "depth.out-of-range.range": out_of_range,
    "depth.store.value": value_made,
    "depth.store.depth": depth_stored,
    **formulas_rays.FORMULAS,
}
