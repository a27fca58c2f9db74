"""Barycentric coordinates three ways: two equations, areas, distances from the edges."""

from core.explain.digits import number_latex, remainder_note, signed_latex, spoken
from core.explain.equation import Part, beside, difference, equation, fraction, linear_parts
from core.explain.records import Formula
from core.explain.rows import Said, explains
from core.explain.step_values import StepValues
from core.explain.subjects.interpolation import below_zero, first_weight
from core.explain.variable_text import GIVEN, VariableText, hides, shows
from core.records.words import joined


def _listed(values: list[float]) -> str:
    return joined([spoken(value) for value in values])


def _row(names: tuple[str, str, str], values: list[float]) -> list[Part]:
    """Return one of the two equations, as p1 l1 + p2 l2 = p."""
    first, second, right = names
    unknown = r"\cdot \vertex{{{k}}}{{\lambda_{k}}}"
    return [
        *((first, values[0]), unknown.format(k=1), "+"),
        *((second, values[1]), unknown.format(k=2), "=", (right, values[2])),
    ]


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
    return text, equation(*beside(*(_row(names[k], rows[k]) for k in range(2))))


@explains("interpolate.affine-equations.pivot")
def pivot(step: StepValues) -> Said:
    """The row with the larger coefficient of the first unknown comes first."""
    chosen, other = step.vector("chosen"), step.vector("other")
    first, second = ("y", "x") if step.flag("is_swapped") else ("x", "y")
    text = (
        f"{step.fragment_name}: the equation for {first} comes first, as its factor of λ1 is not the smaller one: "
        f"{spoken(abs(chosen[0]))} against {spoken(abs(other[0]))} for {second}."
    )
    return text, equation(*beside(_row(("p_1", "p_2", "p"), chosen), _row(("q_1", "q_2", "q"), other)))


@explains("interpolate.affine-equations.factor")
def factor(step: StepValues) -> Said:
    """How often the first equation is subtracted from the second."""
    f, p, q = step.number("factor"), step.vector("chosen"), step.vector("other")
    text = f"{step.fragment_name}: the second equation has {spoken(f)} times as much of λ1 as the first."
    return text, equation(("f", f), "=", fraction(("q_1", q[0]), ("p_1", p[0])))


@explains("interpolate.affine-equations.eliminate")
def eliminate(step: StepValues) -> Said:
    """The first equation is subtracted so often that the first unknown leaves the second."""
    p, q, f, (e2, e) = (
        step.vector("chosen"),
        step.vector("other"),
        step.number("factor"),
        step.vector("reduced"),
    )
    text = (
        f"{step.fragment_name}: with {spoken(f)} times the first equation subtracted from the second, λ1 disappears "
        f"and {spoken(e2)} λ2 = {spoken(e)} is left."
    )
    made: list[list[Part]] = []
    for name, value, above, below in (("e_2", e2, q[1], p[1]), ("e", e, q[2], p[2])):
        q_name, p_name = name.replace("e", "q"), name.replace("e", "p")
        made.append([(name, value), "=", (q_name, above), "-", ("f", f), r"\cdot", (p_name, below)])
    return text, equation(*beside(*made))


@explains("interpolate.affine-equations.last")
def last_unknown(step: StepValues) -> Said:
    """The weight of corner 2."""
    e2, e = step.vector("reduced")
    value = step.number("weight_2")
    text = f"{step.fragment_name}: corner 2 has weight {spoken(value)}."
    return text, equation((r"\lambda_2", value), "=", fraction(("e", e), ("e_2", e2), 2))


@explains("interpolate.affine-equations.first")
def first_unknown(step: StepValues) -> Said:
    """The weight of corner 1, from the first equation."""
    p, second, value = step.vector("chosen"), step.number("weight_2"), step.number("weight_1")
    text = f"{step.fragment_name}: with λ2 in the first equation, corner 1 has weight {spoken(value)}."
    above = rf"{number_latex(p[2])} - {signed_latex(p[1])} \cdot {signed_latex(second)}"
    quotient = fraction((r"p - p_2 \cdot \lambda_2", above), ("p_1", p[0]), 1)
    return text, equation((r"\lambda_1", value), "=", quotient)


@explains("interpolate.affine-equations.weights", asks=first_weight, decides=True)
def rest_of_one(step: StepValues) -> Said:
    """The weight of corner 0 is what is left of 1."""
    weights = step.vector("weights")
    text = (
        f"{step.fragment_name}: corner 0 has the rest of 1, so corners 0, 1 and 2 have weights "
        f"{_listed(weights)}{below_zero(weights)}."
    )
    made: list[Part] = [(r"\lambda_0", weights[0]), "=", "1"]
    for k in (1, 2):
        made += ["-", (rf"\lambda_{k}", weights[k])]
    return text, equation(*made)


def _doubled_area(symbol: str, value: float, corners: list[tuple[tuple[str, float], ...]]) -> list[Part]:
    """Return the doubled area of three points as two products of differences; the first point is subtracted."""
    (x0, y0), (x1, y1), (x2, y2) = corners
    made: list[Part] = [(symbol, value), "="]
    for sign, across, up in (("", x1, y2), ("-", x2, y1)):
        products = [difference(across, x0), difference(up, y0)]
        made += [sign] if sign else []
        made.append(
            (
                "".join(f"({symbols})" for symbols, _ in products),
                r" \cdot ".join(f"({numbers})" for _, numbers in products),
            )
        )
    return made


def _named_corners(step: StepValues) -> list[tuple[tuple[str, float], ...]]:
    """Return x and y of the corners with their symbols."""
    return [
        tuple((f"{axis}_{k}", value) for axis, value in zip("xy", corner, strict=True))
        for k, corner in enumerate(step.rows("corner_window"))
    ]


@explains("interpolate.affine-areas.whole")
def whole_area(step: StepValues) -> Said:
    """The area of the triangle, doubled and signed."""
    value = step.number("whole_area")
    turn = "counter-clockwise" if value > 0 else "clockwise"
    text = f"{step.fragment_name}: twice the area of the triangle is {spoken(value)}; its corners run {turn}."
    return text, equation(*_doubled_area("2A", value, _named_corners(step)))


@explains("interpolate.affine-areas.areas")
def part_areas(step: StepValues) -> Said:
    """The pixel cuts the triangle into three, each opposite to its corner."""
    areas, corners = step.vector("areas"), _named_corners(step)
    centre = (("x", step.number("x")), ("y", step.number("y")))
    text = (
        f"{step.fragment_name}: its centre cuts the triangle into three; twice the areas opposite to "
        "corners 0, 1 and 2 "
        f"are {_listed(areas)}"
    )
    text += "; an area below 0 lies outside" if min(areas) < 0 else ""
    parts = [_doubled_area(f"2A_{k}", areas[k], [centre, corners[k - 2], corners[k - 1]]) for k in range(3)]
    return f"{text}.", equation(*beside(*parts))


def _quotients(
    step: StepValues, symbols: list[tuple[str, str]], over: list[float], under: list[float]
) -> Formula:
    """Return the three weights as quotients."""
    weights = step.vector("weights")
    quotients: list[list[Part]] = [
        [(rf"\lambda_{k}", weights[k]), "=", fraction((top, over[k]), (bottom, under[k]), k)]
        for k, (top, bottom) in enumerate(symbols)
    ]
    return equation(*beside(*quotients))


@explains("interpolate.affine-areas.weights", asks=first_weight, decides=True)
def shares_of_area(step: StepValues) -> Said:
    """The weight of a corner is the part of the area opposite to it."""
    weights = step.vector("weights")
    text = (
        f"{step.fragment_name}: corners 0, 1 and 2 have weights {_listed(weights)}, the parts of the area "
        "opposite to them"
        f"{below_zero(weights)}."
    )
    symbols = [(f"2A_{k}", "2A") for k in range(3)]
    return text, _quotients(step, symbols, step.vector("areas"), [step.number("whole_area")] * 3)


def _line_name(k: int, at: str = "x, y") -> str:
    """Write the line function of the edge opposite to corner ``k``."""
    return rf"f_{{{(k + 1) % 3}{(k + 2) % 3}}}({at})"


def _values_of_lines(
    step: StepValues, values: list[float], names: list[str], places: list[tuple[tuple[str, float], ...]]
) -> Formula:
    """Write the three line functions with their values, each at a place: its name, and x and y with their symbols."""
    lines = zip(*(step.vector(f"line_{name}") for name in "abc"), strict=True)
    sums = [
        linear_parts(
            rf"\vertex{{{k}}}{{{_line_name(k, names[k])}}}",
            values[k],
            [(f"{name}_{k}", value) for name, value in zip("abc", line, strict=True)],
            *places[k],
        )
        for k, line in enumerate(lines)
    ]
    return equation(*beside(*sums))


@explains("interpolate.affine-distances.lines")
def line_functions(step: StepValues) -> Said:
    """The line through two corners as a function of x and y that is 0 on it."""
    a, b, c = (step.vector(f"line_{name}") for name in "abc")
    corners = _named_corners(step)
    text = (
        f"{step.fragment_name}: each edge has a function a x + b y + c that is 0 on its line; opposite to "
        f"corner 0 it has a = {spoken(a[0])}, b = {spoken(b[0])}, c = {spoken(c[0])}"
        f"{remainder_note([a[0], b[0], c[0]])}."
    )
    (x1, y1), (x2, y2) = corners[1:]
    products = " - ".join(
        rf"{signed_latex(x)} \cdot {signed_latex(y)}" for x, y in ((x1[1], y2[1]), (x2[1], y1[1]))
    )
    made: list[list[Part]] = [
        [("a_0", a[0]), "=", difference(y1, y2)],
        [("b_0", b[0]), "=", difference(x2, x1)],
        [("c_0", c[0]), "=", ("x_1 y_2 - x_2 y_1", products)],
    ]
    return text, equation(*beside(*made))


@explains("interpolate.affine-distances.functions")
def at_the_pixel(step: StepValues) -> Said:
    """The three functions at the pixel: distances, each in a unit of its own."""
    values, x, y = step.vector("at_pixel"), step.number("x"), step.number("y")
    text = (
        f"{step.fragment_name}: the functions of the edges opposite to corners 0, 1 and 2 are {_listed(values)} here, "
        f"the distances from the edges times their lengths{remainder_note(values)}."
    )
    return text, _values_of_lines(step, values, ["x, y"] * 3, [(("x", x), ("y", y))] * 3)


@explains("interpolate.affine-distances.opposite")
def at_the_corner(step: StepValues) -> Said:
    """The same functions at the corner opposite to each edge."""
    values = step.vector("at_corner")
    text = f"{step.fragment_name}: at the corner opposite to each edge the functions are {_listed(values)}."
    return text, _values_of_lines(step, values, [f"x_{k}, y_{k}" for k in range(3)], _named_corners(step))


@explains("interpolate.affine-distances.weights", asks=first_weight, decides=True)
def shares_of_distance(step: StepValues) -> Said:
    """The weight of a corner is the pixel's distance from the opposite edge, over the corner's own."""
    weights = step.vector("weights")
    text = (
        f"{step.fragment_name}: corners 0, 1 and 2 have weights {_listed(weights)}: how far the pixel is from the "
        f"opposite edge, as a part of how far the corner is{below_zero(weights)}."
    )
    symbols = [(_line_name(k), _line_name(k, f"x_{k}, y_{k}")) for k in range(3)]
    return text, _quotients(step, symbols, step.vector("at_pixel"), step.vector("at_corner"))


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
