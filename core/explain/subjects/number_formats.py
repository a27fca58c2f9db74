"""Number formats of the edge functions: equations that rounding makes untrue, corners that are rounded, the inverse."""

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import chain

import numpy as np

from core.explain.digits import number_latex, spoken, vector_text
from core.explain.equation import Part, beside, equation
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.methods import table
from core.records.words import joined

DETERMINANT = r"\det \begin{pmatrix} x_0 & y_0 & w_0 \\ x_1 & y_1 & w_1 \\ x_2 & y_2 & w_2 \end{pmatrix}"
"""The determinant of the corners in symbols."""

ERROR = r"\varepsilon"
"""What rounding adds to a result."""


def number_format(step: StepValues) -> str:
    """Return the name of the numbers that coverage is decided in; a step without one has ``snapped``."""
    return step.text("number_format") if step.has("number_format") else "snapped"


def equals(
    step: StepValues, value: float, terms: Sequence[Sequence[float]], fraction_bits: int = 16
) -> tuple[str, list[Part]]:
    """Return the sign between a value and a sum of products, and what stands behind the sum.

    Numbers that were rounded are equal to the sum plus the error of rounding; whole numbers that wrapped around are
    congruent modulo 2^n.
    """
    rounding = step.text("rounding") if step.has("rounding") else "exact"
    if rounding == "exact" or not all(map(math.isfinite, chain(*terms))):
        return "=", []
    if not math.isfinite(value):
        return "=", error_parts(value)
    error = Fraction(value) - sum(math.prod(map(Fraction, term)) for term in terms)
    if rounding == "rounded":
        return "=", error_parts(float(error))
    if not error:
        return "=", []
    whole = np.dtype(table.get("coverage", step.text("number_format")).function().held_as)
    modulus = rf"(\mathrm{{mod}} \, 2^{{{8 * whole.itemsize - fraction_bits}}})"
    return r"\equiv", [r"\quad", modulus]


def error_parts(error: float, symbol: str = ERROR) -> list[Part]:
    """Return what rounding adds to a result; nothing where it adds nothing."""
    return ["+", (symbol, error)] if error else []


@explains("edges.rounded.round")
def rounded(step: StepValues) -> Said:
    """A corner rounded to the format."""
    before, after, form = step.vector("homogeneous"), step.vector("rounded"), number_format(step)
    k = step.whole("corner")
    name = f"Corner {k} of triangle {step.triangle}"
    moved = max(abs(a - b) for a, b in zip(after, before, strict=True))
    text = f"{name} is rounded to {form}, (x, y, w) = {vector_text(after)}, which changes it by up to {spoken(moved)}."
    if before == after:
        text = f"{name} stays at (x, y, w) = {vector_text(before)}: {form} represents these numbers exactly."
    elif not all(map(math.isfinite, after)):
        text = f"{name}, {vector_text(before)}, is too large for {form}, which makes it {vector_text(after)}."
    numbers: list[list[Part]] = [
        [
            (rf"\vertex{{{k}}}{{{axis}_{k}}}", new),
            "=",
            (rf"\vertex{{{k}}}{{{axis}}}", old),
            *error_parts(new - old, f"{ERROR}_{axis}"),
        ]
        for axis, old, new in zip("xyw", before, after, strict=True)
    ]
    return text, equation(*beside(*numbers))


@explains("edges.determinant.area")
def determinant(step: StepValues) -> Said:
    """The determinant that the inverse is divided by, as the product of pivots."""
    value = step.number("doubled_area")
    rest = ": it has no inverse, and nothing is drawn."
    if value != 0:
        rest = ", and the inverse is divided by it, so that its edge functions are positive inside."
    text = f"By elimination the matrix of triangle {step.triangle} has the determinant {spoken(value)}{rest}"
    return text, equation(("D", value), "=", (DETERMINANT, r"\mathrm{product\ of\ pivots}"))


@explains("edges.inverse-edge.a|b|c")
def inverse_coefficient(step: StepValues) -> Said:
    """One entry of the inverse of the matrix of corners."""
    k, name, value = step.whole("edge"), step.operation, step.number(step.operation)
    row = "abc".index(name)
    meaning = {
        "a": f"so E{k} changes by that per pixel to the right",
        "b": f"so E{k} changes by that per pixel upwards",
        "c": f"the value of E{k} at the window's origin",
    }[name]
    text = (
        f"Edge {k} of triangle {step.triangle} is column {k} of the inverse: {name}, in row {row}, is "
        f"{spoken(value)}, {meaning}."
    )
    entry: list[Part] = [(f"{name}_{k}", value), "=", (rf"(M^{{-1}})_{{{row},{k}}}", number_latex(value))]
    if name != "c":
        return text, equation(*entry)
    others = joined([str(i) for i in range(3) if i != k])
    if k < 2:
        text = text.removesuffix(".") + f"; a x + b y + c w is 1 for corner {k}, and 0 for corners {others}."
        return text, equation(*beside(entry, _columns_of_inverse(step, [k])))
    text = text.removesuffix(".") + (
        "; with it M⁻¹ is whole, whose columns are α, β and γ: 1, 0, 0 and 0, 1, 0 and 0, 0, 1 at corners 0, 1 and 2."
    )
    return text, equation(*_columns_of_inverse(step, [0, 1, 2]))


def _columns_of_inverse(step: StepValues, columns: Sequence[int]) -> list[Part]:
    """Return the matrix of corners times columns of its inverse."""
    k = step.whole("edge")
    corners = dict(
        zip([k, (k + 1) % 3, (k + 2) % 3], map(step.vector, ("homogeneous", "start", "finish")), strict=True)
    )

    def matrix(rows: Sequence[Sequence[str]]) -> str:
        lines = r" \\ ".join(" & ".join(row) for row in rows)
        return rf"\begin{{pmatrix}} {lines} \end{{pmatrix}}"

    symbols = [[rf"\vertex{{{i}}}{{{axis}_{i}}}" for axis in "xyw"] for i in range(3)]
    inverse = step.rows("inverse")
    unit = matrix([["1" if i == column else "0" for column in columns] for i in range(3)])
    return [
        (matrix(symbols), matrix([[number_latex(value) for value in corners[i]] for i in range(3)])),
        (
            matrix([[rf"\vertex{{{column}}}{{{name}_{column}}}" for column in columns] for name in "abc"]),
            matrix([[number_latex(row[column]) for column in columns] for row in inverse]),
        ),
        ("=", r"\approx"),
        unit,
    ]


def replaced_fill(fill: str, coverage: str) -> str:
    """Return why a fill by spans was replaced, as its chapter shows it."""
    return (
        f"Every pixel of the bounding box is tested: {fill} needs float64 numbers, and coverage {coverage} "
        "uses others."
    )
