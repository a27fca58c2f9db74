"""Number formats of the edge functions: equations that rounding makes untrue, corners that are rounded, the inverse."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from core.explain.arithmetic import numbers_are_finite, work_out
from core.explain.digits import spoken, vector_text
from core.explain.formulas import Named, formula_of, named
from core.explain.rows import Said, explains
from core.explain.statements import Chain
from core.explain.step_values import StepValues
from core.explain.term_latex import Written
from core.methods import table
from core.records.terms import Term
from core.records.words import joined

DETERMINANT = r"\det \begin{pmatrix} x_0 & y_0 & w_0 \\ x_1 & y_1 & w_1 \\ x_2 & y_2 & w_2 \end{pmatrix}"
"""The determinant of the corners in symbols."""

ERROR = r"\varepsilon"
"""What rounding adds to a result."""


def number_format(step: StepValues) -> str:
    """Return the name of the numbers that coverage is decided in; a step without one has ``snapped``."""
    return step.text("number_format") if step.has("number_format") else "snapped"


def in_format(step: StepValues, value: Named, wanted: Term, fraction_bits: int = 16) -> Chain:
    """Return that a value equals what is wanted, as the number format has it.

    Numbers that were rounded are equal to the sum plus the error of rounding; whole numbers that wrapped around are
    congruent modulo 2^n.
    """
    rounding = step.text("rounding") if step.has("rounding") else "exact"
    if rounding == "exact" or not numbers_are_finite(wanted):
        return value.equals(wanted)
    if not math.isfinite(value.value):
        return value.equals(with_error(wanted, value.value))
    error = Fraction(value.value) - Fraction(work_out(wanted)[0])
    if rounding == "rounded":
        return value.equals(with_error(wanted, float(error)))
    if not error:
        return value.equals(wanted)
    whole = np.dtype(table.get("coverage", step.text("number_format")).function().held_as)
    return Chain((value, wanted), (r"\equiv",), 8 * whole.itemsize - fraction_bits)


def with_error(wanted: Term, error: float, symbol: str = ERROR) -> Term:
    """Return a result with what rounding adds to it; nothing where it adds nothing."""
    return wanted + named(symbol, error) if error else wanted


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
    numbers = (
        named(f"{axis}_{k}", new)
        .of_vertex(k)
        .equals(with_error(named(axis, old).of_vertex(k), new - old, f"{ERROR}_{axis}"))
        for axis, old, new in zip("xyw", before, after, strict=True)
    )
    return text, formula_of(*numbers)


@explains("edges.determinant.area")
def determinant(step: StepValues) -> Said:
    """The determinant that the inverse is divided by, as the product of pivots."""
    value = step.named("doubled_area", "D")
    rest = ": it has no inverse, and nothing is drawn."
    if value.value != 0:
        rest = ", and the inverse is divided by it, so that its edge functions are positive inside."
    text = f"By elimination the matrix of triangle {step.triangle} has the determinant {value}{rest}"
    return text, formula_of(value.equals(Written(DETERMINANT, r"\mathrm{product\ of\ pivots}")))


@explains("edges.inverse-edge.a|b|c")
def inverse_coefficient(step: StepValues) -> Said:
    """One entry of the inverse of the matrix of corners."""
    k, name = step.whole("edge"), step.operation
    value, row = step.named(name, f"{name}_{k}"), "abc".index(name)
    meaning = {
        "a": f"so E{k} changes by that per pixel to the right",
        "b": f"so E{k} changes by that per pixel upwards",
        "c": f"the value of E{k} at the window's origin",
    }[name]
    text = (
        f"Edge {k} of triangle {step.triangle} is column {k} of the inverse: {name}, in row {row}, is "
        f"{value}, {meaning}."
    )
    entry = value.equals(named(rf"(M^{{-1}})_{{{row},{k}}}", value.value))
    if name != "c":
        return text, formula_of(entry)
    others = joined([str(i) for i in range(3) if i != k])
    if k < 2:
        text = text.removesuffix(".") + f"; a x + b y + c w is 1 for corner {k}, and 0 for corners {others}."
        return text, formula_of(entry, _columns_of_inverse(step, [k]))
    text = text.removesuffix(".") + (
        "; with it M⁻¹ is whole, whose columns are α, β and γ: 1, 0, 0 and 0, 1, 0 and 0, 0, 1 at corners 0, 1 and 2."
    )
    return text, formula_of(_columns_of_inverse(step, [0, 1, 2]))


def matrix(rows: Sequence[Sequence[Named]]) -> Written:
    """Return a matrix of numbers."""
    return Written(_matrix([[one.symbol for one in row] for row in rows]), _matrix(rows))


def _matrix(rows: Sequence[Sequence[object]]) -> str:
    lines = r" \\ ".join(" & ".join(map(str, row)) for row in rows)
    return rf"\begin{{pmatrix}} {lines} \end{{pmatrix}}"


def _columns_of_inverse(step: StepValues, columns: Sequence[int]) -> Chain:
    """Return the matrix of corners times columns of its inverse."""
    k = step.whole("edge")
    corners = dict(
        zip([k, (k + 1) % 3, (k + 2) % 3], map(step.vector, ("homogeneous", "start", "finish")), strict=True)
    )
    of_corners = [
        [named(f"{axis}_{i}", at).of_vertex(i) for axis, at in zip("xyw", corners[i], strict=True)]
        for i in range(3)
    ]
    of_inverse = [
        [named(f"{name}_{column}", row[column]).of_vertex(column) for column in columns]
        for name, row in zip("abc", step.rows("inverse"), strict=True)
    ]
    unit = [
        [named(number, float(number)) for number in ("1" if i == column else "0" for column in columns)]
        for i in range(3)
    ]
    first, second = matrix(of_corners), matrix(of_inverse)
    product = Written(f"{first.symbols} {second.symbols}", f"{first.numbers} {second.numbers}")
    return Chain((product, matrix(unit)), (("=", r"\approx"),))


def replaced_fill(fill: str, coverage: str) -> str:
    """Return why a fill by spans was replaced, as its chapter shows it."""
    return (
        f"Every pixel of the bounding box is tested: {fill} needs float64 numbers, and coverage {coverage} "
        "uses others."
    )
