"""Barycentric coordinates three ways: two equations, areas, distances from the edges."""

from core.explain.formulas import Chain, Named, formula_of, named
from core.explain.number_text import listed, remainder_note, spoken
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import GIVEN, VariableText, hides, shows
from core.explain.term_latex import Written
from core.interpolation.told import below_zero, first_weight, quotients
from core.records.terms import Colored, Operation


def _row(names: tuple[str, str, str], values: list[float]) -> Chain:
    """Return one of the two equations, as p1 l1 + p2 l2 = p."""
    first, second, right = map(named, names, values)
    one, other = (Written(rf"\vertex{{{k}}}{{\lambda_{k}}}") for k in (1, 2))
    return Chain((first * one + second * other, right), ("=",))


@explains("interpolate.affine-equations.system")
def system(step: StepValues) -> Said:
    """Two equations with two unknowns: the pixel as seen from corner 0 along two sides."""
    rows = step.rows("system")
    text = (
        f"{step.fragment_name}: its centre is corner 0, plus λ1 of the side to corner 1, plus λ2 of the "
        "side to corner 2: "
        "one equation for x and one for y."
    )
    names = [(f"{axis}_1 - {axis}_0", f"{axis}_2 - {axis}_0", f"{axis} - {axis}_0") for axis in "xy"]
    names = [(f"({first})", f"({second})", right) for first, second, right in names]
    return text, formula_of(*map(_row, names, rows))


@explains("interpolate.affine-equations.pivot")
def pivot(step: StepValues) -> Said:
    """The row with the larger coefficient of the first unknown comes first."""
    chosen, other = step.vector("chosen"), step.vector("other")
    first, second = ("y", "x") if step.flag("is_swapped") else ("x", "y")
    text = (
        f"{step.fragment_name}: the equation for {first} comes first, as its factor of λ1 is not the smaller one: "
        f"{spoken(abs(chosen[0]))} against {spoken(abs(other[0]))} for {second}."
    )
    return text, formula_of(_row(("p_1", "p_2", "p"), chosen), _row(("q_1", "q_2", "q"), other))


@explains("interpolate.affine-equations.factor")
def factor(step: StepValues) -> Said:
    """How often the first equation is subtracted from the second."""
    f, (p1, *_), (q1, *_) = step.named("factor", "f"), *_equations(step)
    text = f"{step.fragment_name}: the second equation has {f} times as much of λ1 as the first."
    return text, formula_of(f.equals(q1 / p1))


def _equations(step: StepValues) -> tuple[list[Named], list[Named]]:
    """Return the numbers of both equations, p_1, p_2 and p, and q_1, q_2 and q."""
    p, q = (
        [
            named(symbol, value)
            for symbol, value in zip((f"{letter}_1", f"{letter}_2", letter), step.vector(name), strict=True)
        ]
        for letter, name in (("p", "chosen"), ("q", "other"))
    )
    return p, q


@explains("interpolate.affine-equations.eliminate")
def eliminate(step: StepValues) -> Said:
    """The first equation is subtracted so often that the first unknown leaves the second."""
    ((_, p2, p), (_, q2, q)), f = _equations(step), step.named("factor", "f")
    e2, e = map(named, ("e_2", "e"), step.vector("reduced"))
    text = (
        f"{step.fragment_name}: with {f} times the first equation subtracted from the second, λ1 disappears "
        f"and {e2} λ2 = {e} is left."
    )
    return text, formula_of(e2.equals(q2 - f * p2), e.equals(q - f * p))


@explains("interpolate.affine-equations.last")
def last_unknown(step: StepValues) -> Said:
    """The weight of corner 2."""
    e2, e = map(named, ("e_2", "e"), step.vector("reduced"))
    weight = step.named("weight_2", r"\lambda_2")
    return f"{step.fragment_name}: corner 2 has weight {weight}.", formula_of(
        weight.equals(Colored(2, e / e2))
    )


@explains("interpolate.affine-equations.first")
def first_unknown(step: StepValues) -> Said:
    """The weight of corner 1, from the first equation."""
    (p1, p2, p), _ = _equations(step)
    first, second = (step.named(f"weight_{k}", rf"\lambda_{k}") for k in (1, 2))
    text = f"{step.fragment_name}: with λ2 in the first equation, corner 1 has weight {first}."
    return text, formula_of(first.equals(Colored(1, (p - p2 * second) / p1)))


@explains("interpolate.affine-equations.weights", asks=first_weight, decides=True)
def rest_of_one(step: StepValues) -> Said:
    """The weight of corner 0 is what is left of 1."""
    weights = step.vector("weights")
    text = (
        f"{step.fragment_name}: corner 0 has the rest of 1, so corners 0, 1 and 2 have weights "
        f"{listed(weights)}{below_zero(weights)}."
    )
    first, second, third = (named(rf"\lambda_{k}", weight) for k, weight in enumerate(weights))
    return text, formula_of(first.equals(1 - second - third))


Place = tuple[Named, Named]
"""x and y with their symbols."""


def _doubled_area(corners: list[Place]) -> Operation:
    """Return the doubled area of three points as two products of differences; the first point is subtracted."""
    (x0, y0), (x1, y1), (x2, y2) = corners
    return (x1 - x0) @ (y2 - y0) - (x2 - x0) @ (y1 - y0)


def _corners(step: StepValues) -> list[Place]:
    """Return x and y of the corners."""
    return [(named(f"x_{k}", x), named(f"y_{k}", y)) for k, (x, y) in enumerate(step.rows("corner_window"))]


@explains("interpolate.affine-areas.whole")
def whole_area(step: StepValues) -> Said:
    """The area of the triangle, doubled and signed."""
    area = step.named("whole_area", "2A")
    turn = "counter-clockwise" if area.value > 0 else "clockwise"
    text = f"{step.fragment_name}: twice the area of the triangle is {area}; its corners run {turn}."
    return text, formula_of(area.equals(_doubled_area(_corners(step))))


@explains("interpolate.affine-areas.areas")
def part_areas(step: StepValues) -> Said:
    """The pixel cuts the triangle into three, each opposite to its corner."""
    areas, corners = step.vector("areas"), _corners(step)
    text = (
        f"{step.fragment_name}: its centre cuts the triangle into three; twice the areas opposite to "
        "corners 0, 1 and 2 "
        f"are {listed(areas)}"
    )
    text += "; an area below 0 lies outside" if min(areas) < 0 else ""
    made = (
        area.equals(_doubled_area([step.centre, corners[k - 2], corners[k - 1]]))
        for k, area in enumerate(_areas(step))
    )
    return f"{text}.", formula_of(*made)


def _areas(step: StepValues) -> list[Named]:
    """Return twice the three areas."""
    return [named(f"2A_{k}", area) for k, area in enumerate(step.vector("areas"))]


@explains("interpolate.affine-areas.weights", asks=first_weight, decides=True)
def shares_of_area(step: StepValues) -> Said:
    """The weight of a corner is the part of the area opposite to it."""
    weights = step.vector("weights")
    text = (
        f"{step.fragment_name}: corners 0, 1 and 2 have weights {listed(weights)}, the parts of the area "
        "opposite to them"
        f"{below_zero(weights)}."
    )
    return text, formula_of(*quotients(step, _areas(step), [step.named("whole_area", "2A")] * 3))


def _line_values(step: StepValues, column: str, places: list[Place]) -> list[Named]:
    """Return the line functions of the edges opposite to the corners, each at a place."""
    return [
        named(rf"f_{{{(k + 1) % 3}{(k + 2) % 3}}}({x.symbol}, {y.symbol})", value)
        for k, (value, (x, y)) in enumerate(zip(step.vector(column), places, strict=True))
    ]


def _lines_at(step: StepValues, column: str, places: list[Place]) -> list[Chain]:
    """Return how the values of the line functions are computed."""
    made = []
    for k, (value, (x, y)) in enumerate(zip(_line_values(step, column, places), places, strict=True)):
        a, b, c = (named(f"{name}_{k}", step.vector(f"line_{name}")[k]) for name in "abc")
        made.append(value.of_vertex(k).equals(a * x + b * y + c))
    return made


@explains("interpolate.affine-distances.lines")
def line_functions(step: StepValues) -> Said:
    """The line through two corners as a function of x and y that is 0 on it."""
    a, b, c = (step.vector(f"line_{name}") for name in "abc")
    _, (x1, y1), (x2, y2) = _corners(step)
    text = (
        f"{step.fragment_name}: each edge has a function a x + b y + c that is 0 on its line; opposite to "
        f"corner 0 it has a = {spoken(a[0])}, b = {spoken(b[0])}, c = {spoken(c[0])}"
        f"{remainder_note([a[0], b[0], c[0]])}."
    )
    return text, formula_of(
        named("a_0", a[0]).equals(y1 - y2),
        named("b_0", b[0]).equals(x2 - x1),
        named("c_0", c[0]).equals(x1 @ y2 - x2 @ y1),
    )


@explains("interpolate.affine-distances.functions")
def at_the_pixel(step: StepValues) -> Said:
    """The three functions at the pixel: distances, each in a unit of its own."""
    values = step.vector("at_pixel")
    text = (
        f"{step.fragment_name}: the functions of the edges opposite to corners 0, 1 and 2 are {listed(values)} here, "
        f"the distances from the edges times their lengths{remainder_note(values)}."
    )
    return text, formula_of(*_lines_at(step, "at_pixel", [step.centre] * 3))


@explains("interpolate.affine-distances.opposite")
def at_the_corner(step: StepValues) -> Said:
    """The same functions at the corner opposite to each edge."""
    values = step.vector("at_corner")
    text = f"{step.fragment_name}: at the corner opposite to each edge the functions are {listed(values)}."
    return text, formula_of(*_lines_at(step, "at_corner", _corners(step)))


@explains("interpolate.affine-distances.weights", asks=first_weight, decides=True)
def shares_of_distance(step: StepValues) -> Said:
    """The weight of a corner is the pixel's distance from the opposite edge, over the corner's own."""
    weights = step.vector("weights")
    text = (
        f"{step.fragment_name}: corners 0, 1 and 2 have weights {listed(weights)}: how far the pixel is from the "
        f"opposite edge, as a part of how far the corner is{below_zero(weights)}."
    )
    here = _line_values(step, "at_pixel", [step.centre] * 3)
    at_corner = _line_values(step, "at_corner", _corners(step))
    return text, formula_of(*quotients(step, here, at_corner))


@explains("interpolate.no-area.weights")
def every_third(step: StepValues) -> Said:
    """Corners on one line have no barycentric coordinates."""
    return (
        f"{step.fragment_name}: before snapping the corners lie on one line, so the division would be by 0 "
        "and each corner counts a third."
    )


shows(
    "interpolate",
    {
        "corner_window": VariableText("x#, y#", "Corner in the window.", GIVEN, "edges"),
        "system": VariableText(
            "equation #", "Factors of λ1 and λ2, and the right side: for x and y.", spread="parts"
        ),
        "chosen": VariableText("p1, p2, p", "First equation: the larger factor of λ1."),
        "other": VariableText("q1, q2, q", "Second equation."),
        "factor": VariableText("f", "How often the first equation is subtracted from the second."),
        "reduced": VariableText("e2, e", "What is left of the second equation."),
        "weight_2": VariableText("λ2", "Weight of corner 2.", edge=2),
        "weight_1": VariableText("λ1", "Weight of corner 1.", edge=1),
        "whole_area": VariableText("2A", "Twice the signed area of the triangle."),
        "areas": VariableText("2A#", "Twice the signed area opposite to the corner.", spread="edges"),
        **{
            f"line_{name}": VariableText(f"{name}#", meaning, spread="edges")
            for name, meaning in (
                ("a", "Change of the line function per pixel to the right."),
                ("b", "Change of the line function per pixel upwards."),
                ("c", "Value of the line function at the window's origin."),
            )
        },
        "at_pixel": VariableText("f(x, y) opposite #", "Line function at the pixel.", spread="edges"),
        "at_corner": VariableText("f(x#, y#)", "Line function at the opposite corner.", spread="edges"),
    },
)
hides("interpolate.affine-equations|affine-areas|affine-distances|no-area", ("a", "b", "c", "corner_w"))
