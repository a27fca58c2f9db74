"""Setting up triangles, told step by step: corners in the window, area, edge functions, and number formats."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from core.coverage.snapping import SNAP_LIMIT, SUBPIXELS
from core.explain.formulas import Chain, Named, call, concludes, formula_of, named, on_grid
from core.explain.number_text import position_text, spoken, vector_text
from core.explain.records import Asked, Formula, number
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.explain.term_latex import TermLatex, Written, numbers_are_finite, work_out
from core.methods import ReplacedName, table
from core.records.terms import Colored, Operation, Term, term
from core.records.words import joined

# Number formats of the edge functions: equations that rounding makes untrue, corners that are rounded, the
# inverse.


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


# Setting up triangles: corners in the window, snapping, the area, edge functions and the fill rule.


ROUNDING = 1e-9
"""Pixels below which a corner counts as unmoved."""


def _corner(step: StepValues) -> str:
    return f"Corner {step.whole('corner')} of triangle {step.triangle}"


@explains("edges.snapped.window")
def projected(step: StepValues) -> Said:
    """A corner divided by its w, before snapping."""
    (x, y, w), window = map(named, "xyw", step.vector("homogeneous")), step.vector("window")
    k = step.whole("corner")
    text = f"{_corner(step)} is at {vector_text(window)} in the window: {x} and {y}, each divided by w = {w}."
    places = _in_window(step)
    return text, formula_of(
        *(place.equals(Colored(k, at / w)) for place, at in zip(places, (x, y), strict=True))
    )


def _in_window(step: StepValues) -> list[Named]:
    """Return x and y of a corner before snapping."""
    k, window = step.whole("corner"), step.vector("window")
    return [
        named(rf"{axis}_{{\mathrm{{window}}}}", at).of_vertex(k)
        for axis, at in zip("xy", window, strict=True)
    ]


@explains("edges.snapped.snap")
def snapped(step: StepValues) -> Said:
    """A corner rounded to 1/256 pixel."""
    window, grid, k = step.vector("window"), step.vector("snapped"), step.whole("corner")
    place = position_text(grid)
    moved = math.hypot(*(a - b for a, b in zip(grid, window, strict=True)))
    text = f"is snapped to the nearest 1/256 pixel, {place}, which moves it by {spoken(moved)} px."
    if moved < ROUNDING:
        text = f"stays at {place}, which is on the 1/256-pixel grid."
    rounded = (
        on_grid(f"{axis}_{k}", after).of_vertex(k).equals(call("round", SUBPIXELS * before) / SUBPIXELS)
        for axis, before, after in zip("xy", _in_window(step), grid, strict=True)
    )
    return f"{_corner(step)} {text}", formula_of(*rounded)


@explains("edges.homogeneous.keep")
def homogeneous(step: StepValues) -> Said:
    """A corner that is not snapped, and why."""
    place = vector_text(step.vector("homogeneous"))
    w = step.vector("homogeneous")[2]
    form = step.text("number_format")
    if step.text("rounding") == "wrapped":
        return (
            f"{_corner(step)} cannot be represented in {form}: behind the eye or too far away, "
            f"so the triangle is not drawn: (x, y, w) = {place}."
        )
    if not w > 0:
        reason = f"its w is {spoken(w)}, not above 0"
    elif form == "snapped" and any(abs(value) > SNAP_LIMIT for value in step.vector("window")):
        reason = f"it lies more than {SNAP_LIMIT:,.0f} pixels away"
    else:
        reason = "this number format does not snap"
    return f"{_corner(step)} keeps its homogeneous position (x, y, w) = {place}: {reason}."


def _has_area(step: StepValues) -> bool:
    """Return whether the area is that of snapped corners; else it is a determinant."""
    return step.flag("is_projected") and all(map(math.isfinite, step.vector("snapped")))


@explains("edges.orientation.area")
def orientation(step: StepValues) -> Said:
    """Twice the signed area, or the determinant where a corner is not projected."""
    value = step.number("doubled_area")
    first, start, finish = step.vector("snapped"), step.vector("start"), step.vector("finish")
    is_area = _has_area(step)
    name = "Twice the signed area" if is_area else "The determinant of the (x, y, w) matrix"
    rest = ": nothing is drawn"
    if value > 0:
        rest = ", above 0, so its edge functions are positive inside already"
    elif value < 0:
        rest = ", below 0, so its edge functions are negated to be positive inside"
    text = f"{name} of triangle {step.triangle} is {spoken(value)}{rest}."
    if is_area:
        return text, _area(step, [first, start[:2], finish[:2]])
    if step.text("rounding") == "wrapped":
        # The format cannot represent a corner and counts the area as 0.
        return text, formula_of(named(DETERMINANT, value))
    rows = [[named("", at) for at in row] for row in (step.vector("homogeneous"), start, finish)]
    determinant = Written(DETERMINANT, rf"\det {matrix(rows).numbers}")
    return text, formula_of(named("D", value).equals(determinant))


def _area(step: StepValues, corners: list[list[float]]) -> Formula:
    """Return twice the area of snapped corners as a cross product."""
    (x0, y0), (x1, y1), (x2, y2) = (_named_corner(k, corner) for k, corner in enumerate(corners))
    area = step.named("doubled_area", "2A")
    return formula_of(in_format(step, area, (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)))


def _named_corner(k: int, place: list[float]) -> list[Named]:
    """Return x and y of a corner, and w where it has one, with their symbols."""
    return [named(f"{axis}_{k}", at).of_vertex(k) for axis, at in zip("xyw", place, strict=False)]


def coefficients(step: StepValues) -> Asked | None:
    """Ask for a coefficient of an edge function."""
    k = step.whole("edge")
    shown = ", ".join(spoken(step.number(name)) for name in "abc")
    text = f"What is a{k} of triangle {step.triangle}, the change of E{k} per pixel to the right?"
    return number(text, step.number("a"), f"a{k}, b{k}, c{k} are {shown}.")


@explains("edges.edge.a|b|c", asks=coefficients)
def coefficient(step: StepValues) -> Said:
    """One component of the cross product of an edge's ends."""
    name, k = step.operation, step.whole("edge")
    sign, value = named("s", _sign(step.number("doubled_area"))), step.named(name, f"{name}_{k}")
    made = in_format(step, value, sign * _cross(step), 16 if name == "c" else 8)
    return _coefficient_text(step), formula_of(made)


def _cross(step: StepValues) -> Operation:
    """Return a coefficient of an edge as a component of the cross product of its ends."""
    k, (one, other) = step.whole("edge"), {"a": (1, 2), "b": (2, 0), "c": (0, 1)}[step.operation]
    start = _named_corner((k + 1) % 3, step.vector("start"))
    finish = _named_corner((k + 2) % 3, step.vector("finish"))
    return start[one] @ finish[other] - start[other] @ finish[one]


@explains("edges.anchored-edge.a|b|c", asks=coefficients)
def anchored_coefficient(step: StepValues) -> Said:
    """One coefficient of an edge with one snapped end: its direction in whole numbers, exactly through that end."""
    name, k, is_forward = step.operation, step.whole("edge"), step.whole("anchor") > 0
    i, j = (k + 1) % 3, (k + 2) % 3
    a, b, c = (step.named(letter, f"{letter}_{k}") for letter in "abc")
    text = _coefficient_text(step)
    if name == "c":
        x, y, _ = _named_corner(*((i, step.vector("start")) if is_forward else (j, step.vector("finish"))))
        return text, formula_of(c.equals(-(a * x) - b * y))
    direction = named(TermLatex(False).text(_cross(step)), step.vector("direction")["ab".index(name)])
    text = f"{text.removesuffix('.')}, in whole numbers that keep the edge's direction before snapping."
    sign = named("s", _sign(step.number("doubled_area")))
    return text, formula_of(step.named(name, f"{name}_{k}").equals(sign * call("whole", direction)))


@explains("edges.left-out-edge.leave-out")
def left_out(step: StepValues) -> Said:
    """An edge between two snapped corners that are not inside the opposite edges."""
    k, c = step.whole("edge"), step.number("c")
    i, j = (k + 1) % 3, (k + 2) % 3
    text = (
        f"Edge {k} of triangle {step.triangle} is left out, since on the grid corner {i} or corner {j} is "
        "not inside the opposite edge: "
        f"E{k} is {spoken(c)} everywhere."
    )
    return text, formula_of(*(step.named(name, f"{name}_{k}") for name in "abc"))


def _sign(value: float) -> float:
    return math.copysign(1.0, value) if value else value


def _coefficient_text(step: StepValues) -> str:
    k, value = step.whole("edge"), step.number(step.operation)
    corners = f"from corner {(k + 1) % 3} to corner {(k + 2) % 3}"
    name = f"Edge {k} of triangle {step.triangle} ({corners}): {step.operation} is {spoken(value)}"
    if step.operation == "c":
        return f"{name}, the value of E{k} at the window's origin."
    way = "pixel to the right" if step.operation == "a" else "pixel upwards"
    change = f"{'grows' if value > 0 else 'falls'} by {spoken(abs(value))} with every"
    if value == 0:
        change = "stays the same with every"
    return f"{name}, so E{k} {change} {way}."


EVEN_HANDED_RULES = {
    "inclusive": ("the inclusive rule counts every edge as inside", r"\ge"),
    "exclusive": ("the exclusive rule counts no edge as inside", ">"),
}
"""By fill rule that treats all edges alike: why, and how an edge function inside compares with 0."""


def tie_reason(a: float, b: float, owns: bool, rule: str) -> str:
    """Say why a triangle owns the pixel centres on an edge, or does not."""
    if isinstance(rule, ReplacedName):
        return "the changed fill rule decides so"
    if rule != "shared-edge":
        return EVEN_HANDED_RULES[rule][0]
    if a != 0:
        return "it is a left edge" if owns else "it is a right edge"
    return "it is a level bottom edge" if owns else "it is a level top edge"


def on_edge(step: StepValues, k: int) -> str:
    """Say that a centre lies on an edge, and who owns it."""
    owns = step.flags("owns_tie")[k]
    reason = tie_reason(step.vector("a")[k], step.vector("b")[k], owns, step.fill_rule(k))
    return f"exactly on edge {k}, which the triangle {'owns' if owns else 'does not own'} because {reason}"


def on_own_edges(step: StepValues) -> str:
    """Say of a pixel that is covered without a test which edges it lies on, as the end of a sentence."""
    owns, values = step.flags("owns_tie"), step.vector("values")
    edges = [on_edge(step, k) for k in range(3) if values[k] == 0 and owns[k]]
    return f"; its centre lies {', and '.join(edges)}" if edges else ""


@explains("edges.edge|anchored-edge|inverse-edge.tie")
def tie(step: StepValues) -> Said:
    """Whether the triangle owns the pixel centres on an edge."""
    k, owns = step.whole("edge"), step.flag("owns_tie")
    a, b = step.named("a", f"a_{k}"), step.named("b", f"b_{k}")
    rule, found = step.fill_rule(0), "owned" if owns else "not owned"
    verb = "belongs" if owns else "does not belong"
    reason = tie_reason(a.value, b.value, owns, rule)
    text = f"A pixel centre exactly on edge {k} {verb} to triangle {step.triangle}: {reason}."
    if rule != "shared-edge":
        wanted = Chain((Written(f"E_{k}"), term(0)), (EVEN_HANDED_RULES[rule][1],))
        return text, formula_of(concludes("inside", "inside", wanted))
    tests = [a.compared(">")] if a.value else [a.compared("="), b.compared(">")]
    return text, formula_of(concludes("owned", found, *tests))


shows(
    "edges",
    {
        "corner": given("number", "Number of the corner, and of the edge opposite to it."),
        "homogeneous": given("homogeneous", "x, y and w in the window, before the division."),
        "window": VariableText("window", "Position in pixels, before snapping."),
        "snapped": VariableText("snapped", "Position on the 1/256-pixel grid, used for coverage."),
        "rounded": VariableText("rounded", "x, y and w in the number format."),
        "doubled_area": VariableText(
            lambda step: "2A" if _has_area(step) else "D", "Twice the signed area 2A, or the determinant D."
        ),
        "direction": VariableText("direction", "a and b before snapping, not in whole numbers.", "a"),
        "start": VariableText("edge start", "Start of the edge as (x, y, w).", "a"),
        "finish": VariableText("edge end", "End of the edge as (x, y, w).", "a"),
        "a": VariableText("a", "Change of the edge function per pixel to the right."),
        "b": VariableText("b", "Change of the edge function per pixel upwards."),
        "c": VariableText("c", "Value of the edge function at the window's origin."),
        "owns_tie": VariableText("owns ties", "Whether a pixel centre on the edge belongs to the triangle."),
    },
)
hides("edges.orientation|determinant", ("corner", "homogeneous"))
hides("edges.edge|anchored-edge|left-out-edge|inverse-edge", ("homogeneous",))
hides("edges.edge|left-out-edge|inverse-edge", ("direction",))
