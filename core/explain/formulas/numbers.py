"""Formulas of edge functions in other numbers, and how they write an equation that their rounding makes untrue."""

from collections.abc import Callable, Mapping

import numpy as np

from core.explain.formulas.equation import Part, digits_that_add_up, equation, number_latex
from core.explain.records import Formula
from core.explain.step_values import StepValues

MODULUS = {"fixed-24.8": 32, "int64": 64}
"""Bits that whole numbers have, by number format."""


def equals(
    step: StepValues, value: float, terms: list[list[float]], fraction_bits: int = 16
) -> tuple[str, list[Part]]:
    """Return the sign between a value and a sum of products, and what stands behind it: ``=`` where they are equal.

    Numbers that were rounded are about equal; whole numbers that wrapped around are so modulo 2^n.
    """
    rounding = step.text("rounding") if step.has("rounding") else "exact"
    total = sum(float(np.prod(term)) for term in terms)
    if rounding == "exact" or total == value:
        return "=", []
    if rounding == "rounded":
        return r"\approx", []
    if abs(total - value) < 1:
        return "=", []
    bits = MODULUS[step.text("number_format")] - fraction_bits
    return r"\equiv", [r"\quad", rf"(\mathrm{{mod}} \, 2^{{{bits}}})"]


def rounded(step: StepValues) -> Formula:
    """A corner as the format has it."""
    k = step.whole("corner")
    parts: list[Part] = []
    for axis, before, after in zip("xyw", step.vector("homogeneous"), step.vector("rounded"), strict=True):
        parts += [r"\quad"] if parts else []
        is_same = before == after
        parts += [
            (rf"\vertex{{{k}}}{{{axis}_{k}}}", number_latex(after, 7)),
            "=" if is_same else r"\approx",
            (rf"\vertex{{{k}}}{{{axis}}}", number_latex(before, 7)),
        ]
    return equation(*parts)


def determinant(step: StepValues) -> Formula:
    """The determinant as the product of pivots."""
    symbols = r"\det \begin{pmatrix} x_0 & y_0 & w_0 \\ x_1 & y_1 & w_1 \\ x_2 & y_2 & w_2 \end{pmatrix}"
    return equation(("D", step.number("doubled_area")), "=", (symbols, r"\mathrm{product\ of\ pivots}"))


def inverse_coefficient(step: StepValues) -> Formula:
    """One entry of the inverse of the matrix of corners."""
    k, name = step.whole("edge"), step.operation
    symbols = rf"(M^{{-1}})_{{{'abc'.index(name)},{k}}}"
    return equation((f"{name}_{k}", step.number(name)), "=", (symbols, number_latex(step.number(name), 7)))


def outer_low(step: StepValues) -> Formula:
    """The first column and row of a box that is rounded outward."""
    center = step.number("center")
    parts: list[Part] = []
    for name, axis, values in zip(
        ("column", "row"), "xy", zip(*step.rows("corners"), strict=True), strict=True
    ):
        parts += [r"\quad"] if parts else []
        symbols = ", ".join(rf"\vertex{{{k}}}{{{axis}_{k}}}" for k in range(3))
        least = float(np.floor(min(values)))
        bounded = rf"\lceil \lfloor \min({symbols}) \rfloor - c \rceil"
        numbers = rf"\lceil {number_latex(least)} - {number_latex(center)} \rceil"
        nominal = int(np.ceil(least - center))
        if step.whole(name) != nominal:
            bounded, numbers = rf"\max({bounded}, \mathrm{{first}})", rf"\max({nominal}, {step.whole(name)})"
        parts += [(rf"\mathrm{{{name}}}", float(step.whole(name))), "=", (bounded, numbers)]
    return equation(*parts)


def added_value(step: StepValues) -> Formula:
    """One edge function as the neighbour's and a coefficient."""
    k = int(step.operation.removeprefix("edge-"))
    slope = "a" if step.kind == "step" else "b"
    before, added, value = step.number(f"before_{k}"), step.vector(slope)[k], step.number(f"value_{k}")
    sign, rest = equals(step, value, [[before], [added]])
    neighbour = r"\mathrm{left}" if slope == "a" else r"\mathrm{below}"
    digits = digits_that_add_up(value, [[before], [added]])
    terms: list[Part] = [(rf"E_{k}^{{{neighbour}}}", before), "+", (f"{slope}_{k}", added)]
    return equation((f"E_{k}", value), sign, *terms, *rest, digits=digits)


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "edges.rounded.round": rounded,
    "edges.determinant.area": determinant,
    **{f"edges.inverse-edge.{name}": inverse_coefficient for name in "abc"},
    "bin.outer-box.low": outer_low,
    **{f"raster.{kind}.edge-{k}": added_value for kind in ("step", "climb") for k in range(3)},
}
