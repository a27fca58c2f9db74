"""Interpolation over triangles: weights with and without perspective, corrected every n pixels, and mixed values."""

import math

import numpy as np

from core.explain.digits import is_remainder, number_latex, remainder_note, signed_latex, spoken, vector_text
from core.explain.equation import (
    Part,
    beside,
    difference,
    equation,
    fraction,
    linear,
    linear_parts,
    outstanding,
)
from core.explain.records import Asked, number
from core.explain.rows import Said, explains
from core.explain.step_values import ATTRIBUTES, StepValues, component_names
from core.explain.variable_text import CENTRE, COEFFICIENTS, VariableText, given, hides, shows
from core.fragments.interpolation import window_weights
from core.records.words import joined, noun_of

ATTRIBUTE_NAMES = {
    "color": "colour",
    "uv": "texture coordinates",
    "position": "world position",
    "normal": "normal",
    "diffuse_light": "diffuse light",
    "specular_light": "specular light",
}


def _listed(values: list[float]) -> str:
    return joined([spoken(value) for value in values])


@explains("interpolate.perspective|affine.numerators")
def numerators(step: StepValues) -> Said:
    """The unsnapped edge functions at the pixel."""
    values, is_affine = step.vector("numerators"), step.kind == "affine"
    what = "there, each the determinant times weight / w"
    if is_affine:
        what = "each multiplied by the w of its corner to leave perspective out"
    text = (
        f"{step.fragment_name}: the edge functions of the unsnapped corners are {_listed(values)}"
        f"{',' if is_affine else ''} {what}."
    )
    x, y = step.number("x"), step.number("y")
    planes = [[step.vector(name)[k] for name in "abc"] for k in range(3)]
    w = step.vector("corner_w") if is_affine else [1.0] * 3
    sums: list[list[Part]] = []
    for k, (a, b, c) in enumerate(planes):
        terms, units = [(f"a_{k}", a), (f"b_{k}", b), (f"c_{k}", c)], (("x", x), ("y", y))
        if is_affine:
            products_text = " + ".join(
                rf"{signed_latex(slope)} \cdot {number_latex(at)}" for slope, at in ((a, x), (b, y))
            )
            plane = (rf"(a_{k} x + b_{k} y + c_{k})", f"({products_text} + {signed_latex(c)})")
            sums.append([(f"n_{k}", values[k]), "=", plane, r"\cdot", (f"w_{k}", w[k])])
        else:
            sums.append(linear_parts(f"n_{k}", values[k], terms, *units))
    return text, equation(*beside(*sums))


@explains("interpolate.perspective|affine.total")
def total(step: StepValues) -> Said:
    """The sum of the three."""
    values, whole, inverse_w = (
        step.vector("numerators"),
        step.number("total"),
        spoken(step.number("inverse_w")),
    )
    what = f"the determinant times 1/w, and 1/w is {inverse_w} here"
    if step.kind == "affine":
        what = f"the sum that the three weights are parts of (1/w is {inverse_w} here)"
    text = f"{step.fragment_name}: together they are {spoken(whole)}, {what}."
    return text, linear("n", whole, [(f"n_{k}", values[k]) for k in range(3)])


def first_weight(step: StepValues) -> Asked | None:
    """Ask for the weight of the first corner."""
    weights = step.vector("weights")
    names = ", ".join(f"λ{k}" for k in range(len(weights)))
    reveal = f"{names} are {', '.join(map(spoken, weights))}."
    return number(f"What is λ0, the weight of corner 0, at {step.the_pixel}?", weights[0], reveal)


def below_zero(weights: list[float]) -> str:
    """Return what weights below 0, or 0 up to rounding, mean, as the end of a sentence."""
    below = [str(k) for k, weight in enumerate(weights) if weight < 0 and not is_remainder(weight)]
    text = remainder_note(weights)
    if below:
        verb = "is" if len(below) == 1 else "are"
        text += f"; {noun_of(len(below), 'weight')} {joined(below)} {verb} below 0, as coverage uses snapped corners "
        text += "and weights use unsnapped ones"
    return text


@explains("interpolate.perspective|affine.weights", asks=first_weight, decides=True)
def weights(step: StepValues) -> Said:
    """The weights of the corners, parts of the sum."""
    values, whole = step.vector("weights"), step.number("total")
    text = f"{step.fragment_name}: corners 0, 1 and 2 have weights {_listed(values)}, their parts of the sum"
    w = step.vector("corner_w")
    if step.kind == "perspective" and min(w) != max(w):
        in_window = window_weights(np.array(values), np.array(w)).tolist()
        text += f" (divided by w; in the window {_listed(in_window)})"
    text += below_zero(values)
    if any(map(math.isnan, values)):
        text += "; NaN means that the sum is 0"
    quotients: list[list[Part]] = [
        [(rf"\lambda_{k}", values[k]), "=", fraction((f"n_{k}", part), ("n", whole), k)]
        for k, part in enumerate(step.vector("numerators"))
    ]
    return f"{text}.", equation(*beside(*quotients))


@explains("interpolate.flat.weights", asks=first_weight, decides=True)
def flat_weights(step: StepValues) -> Said:
    """The weight of the provoking corner alone."""
    values = step.vector("weights")
    corner = values.index(max(values))
    others = "the other has" if len(values) == 2 else "the others have"
    text = f"{step.fragment_name}: only corner {corner} counts; {others} weight 0."
    return text, equation(*beside(*([(rf"\lambda_{k}", weight)] for k, weight in enumerate(values))))


def _value(step: StepValues, how: str) -> str:
    """Return the sentence of an interpolated value, and how it was found."""
    name = step.operation.removeprefix("value-")
    values = step.vector(name)
    shown = spoken(values[0]) if len(values) == 1 else vector_text(values)
    title = "u" if len(values) == 1 else ATTRIBUTE_NAMES.get(name, name.replace("_", " "))
    verb = "are" if name == "uv" else "is"
    return f"{step.fragment_name}: its {title} {verb} {shown}, {how}{remainder_note(values)}."


def _component(step: StepValues, corners: list[list[float]]) -> tuple[str, float, list[float]]:
    """Return the component in which the corners differ most: its letter, its value, and those of the corners."""
    name = step.operation.removeprefix("value-")
    values = step.vector(name)
    spread = [max(column) - min(column) for column in zip(*corners, strict=True)]
    k = outstanding(spread if any(spread) else values[:3])
    return component_names(name, len(values))[k][0], values[k], [corner[k] for corner in corners]


@explains("interpolate.*.value")
def value(step: StepValues) -> Said:
    """An interpolated value."""
    how = (
        "taken from the provoking corner"
        if step.kind == "flat"
        else "the weighted sum of the corners' values"
    )
    letter, found, corners = _component(step, step.corner_values(step.operation.removeprefix("value-")))
    terms = [(rf"\lambda_{k}", share) for k, share in enumerate(step.vector("weights"))]
    units = ((f"{letter}_{k}", corner) for k, corner in enumerate(corners))
    mixed = linear_parts(letter, found, terms, *units)
    if step.kind != "perspective" or not step.operation.endswith("uv"):
        return _value(step, how), equation(*mixed)
    how += f", or {letter}/w over 1/w, which are A x + B y + C each"
    return _value(step, how), equation(*beside(mixed, *_quotient_of_planes(step, letter, found, corners)))


def _quotient_of_planes(
    step: StepValues, letter: str, found: float, corners: list[float]
) -> list[list[Part]]:
    """Return a value as value/w over 1/w, both of which are linear in x and y."""
    inverse_w = step.number("inverse_w")
    determinant = step.number("total") / inverse_w
    made: list[list[Part]] = []
    for name, of, values in ((f"{letter}/w", letter, corners), ("1/w", "w", [1.0] * 3)):
        plane = [
            sum(a * of_corner for a, of_corner in zip(step.vector(column), values, strict=True)) / determinant
            for column in "abc"
        ]
        terms = [(f"{symbol}_{of}", factor) for symbol, factor in zip("ABC", plane, strict=True)]
        value = inverse_w if of == "w" else found * inverse_w
        made.append(linear_parts(name, value, terms, ("x", step.number("x")), ("y", step.number("y"))))
    return [*made, [(letter, found), "=", fraction((f"{letter}/w", found * inverse_w), ("1/w", inverse_w))]]


@explains("interpolate.line-perspective|line-affine.value")
def value_along(step: StepValues) -> Said:
    """A value between those of the ends of a line."""
    s = step.number("s")
    how = f"{spoken(1 - s)} of the first end's and {spoken(s)} of the second end's"
    name = step.operation.removeprefix("value-")
    letter, found, (first, second) = _component(step, step.corner_values(name, "end_values"))
    symbols = (step.of_end(letter, end) for end in range(2))
    return _value(step, how), linear(
        letter, found, [("(1 - s)", 1 - s), ("s", s)], *zip(symbols, (first, second), strict=True)
    )


@explains("interpolate.point.value")
def value_of_point(step: StepValues) -> Said:
    """The value of a point."""
    letter, found, (of_point,) = _component(step, step.corner_values(step.operation.removeprefix("value-")))
    return _value(step, "that of the point"), equation((letter, found), "=", (f"{letter}_0", of_point))


@explains("interpolate.affine-n.row")
def row(step: StepValues) -> Said:
    """Where the triangle begins and ends in the pixel's row: the nearest crossings of its left and right edges."""
    ends, y, determinant = step.vector("row_ends"), step.number("y"), step.number("determinant")
    text = (
        f"{step.fragment_name}: in this row the unsnapped triangle reaches from x = {spoken(ends[0])} "
        f"to x = {spoken(ends[1])}."
    )
    if any(map(math.isinf, ends)):
        text = f"{step.fragment_name}: the triangle is edge-on, so its row has no ends."
    a, b, c = (step.vector(name) for name in "abc")
    sides: list[list[Part]] = []
    for name, end, sign in zip(("left", "right"), ends, (1, -1), strict=True):
        side: list[Part] = [(rf"x_{{\mathrm{{{name}}}}}", end)]
        edges = [k for k in range(3) if sign * a[k] * determinant > 0]
        if edges and math.isfinite(end):
            k = min(edges, key=lambda k: abs(-(b[k] * y + c[k]) / a[k] - end))
            above = rf"{signed_latex(b[k])} \cdot {number_latex(y)} + {signed_latex(c[k])}"
            symbols, numbers = fraction((f"b_{k} y + c_{k}", above), (f"a_{k}", a[k]))
            side += ["=", (f"-{symbols}", f"-{numbers}")]
        sides.append(side)
    return text, equation(*beside(*sides))


@explains("interpolate.affine-n.grid")
def grid(step: StepValues) -> Said:
    """The columns of the grid beside a pixel."""
    before, behind = step.vector("grid")
    text = f"{step.fragment_name}: the multiples of {step.whole('interval')} beside it are at x = {spoken(before)} "
    return f"{text}and {spoken(behind)}.", equation(*beside([("g", before)], [("g + n", behind)]))


@explains("interpolate.affine-n.anchors")
def anchors(step: StepValues) -> Said:
    """The columns of the grid, moved to the ends of the row; a pixel beyond these is its own anchor."""
    (left, right), grid = step.vector("anchor_x"), step.vector("grid")
    x = step.number("x")
    if left == right:
        text = (
            f"{step.fragment_name}: its centre is not between the ends of the triangle's row, "
            f"so it is its own anchor, x = {spoken(x)}."
        )
        return text, equation(("l", left), "=", ("r", right), "=", ("x", x))
    text = f"{step.fragment_name}: its anchors are x = {spoken(left)} and x = {spoken(right)}"
    moved = [
        name for name, at, of_grid in (("left", left, grid[0]), ("right", right, grid[1])) if at != of_grid
    ]
    if moved:
        text += f", the {joined(moved)} {'ends' if len(moved) == 2 else 'end'} moved to where the triangle's row ends"
    before, behind, row_left, row_right = map(number_latex, (*grid, *step.vector("row_ends")))
    first: Part = (r"\max(g, x_{\mathrm{left}})", rf"\max({before}, {row_left})")
    second: Part = (r"\min(g + n, x_{\mathrm{right}})", rf"\min({behind}, {row_right})")
    return f"{text}.", equation(*beside([("l", left), "=", first], [("r", right), "=", second]))


@explains("interpolate.affine-n.fraction")
def position(step: StepValues) -> Said:
    """Where the pixel is between its anchors."""
    t, (left, right), x = step.number("fraction"), step.vector("anchor_x"), step.number("x")
    text = (
        f"{step.fragment_name}: its centre is t = {spoken(t)} of the way from the left to the right anchor."
    )
    if t == 0:
        text = f"{step.fragment_name}: its centre is at the left anchor, t = 0."
    if left == right:
        return text, equation(("t", 0.0))
    quotient = fraction(difference(("x", x), ("l", left)), difference(("r", right), ("l", left)))
    return text, equation(("t", t), "=", quotient)


@explains("interpolate.affine-n.corrected")
def corrected(step: StepValues) -> Said:
    """The perspective-correct weights at the anchors."""
    left, right = step.rows("anchor_weights")
    text = (
        f"{step.fragment_name}: with the division by 1/w the weights are {vector_text(left)} at the left anchor and "
        f"{vector_text(right)} at the right one."
    )
    shown: list[list[Part]] = [
        [(rf"\vertex{{{k}}}{{\lambda_{k}({letter})}}", values[k])]
        for letter, values in (("l", left), ("r", right))
        for k in range(3)
    ]
    return text, equation(*beside(*shown))


@explains("interpolate.affine-n.weights", asks=first_weight, decides=True)
def corrected_weights(step: StepValues) -> Said:
    """The weights, linear between the anchors."""
    t, values, (left, right) = step.number("fraction"), step.vector("weights"), step.rows("anchor_weights")
    rest = (
        "; NaN means that 1/w is 0 at an anchor" if any(map(math.isnan, values)) else ", without a division"
    )
    text = (
        f"{step.fragment_name}: {spoken(1 - t)} of the left and {spoken(t)} of the right anchor's weights give "
        f"corners 0, 1 and 2 the weights {_listed(values)}{rest}{remainder_note(values)}."
    )
    sums: list[list[Part]] = [
        [
            *((rf"\lambda_{k}", values[k]), "=", ("(1 - t)", 1 - t), r"\cdot"),
            *((rf"\vertex{{{k}}}{{\lambda_{k}(l)}}", left[k]), "+", ("t", t), r"\cdot"),
            (rf"\vertex{{{k}}}{{\lambda_{k}(r)}}", right[k]),
        ]
        for k in range(3)
    ]
    return text, equation(*beside(*sums))


shows(
    "interpolate",
    {
        **CENTRE,
        "numerators": VariableText("n#", "Edge function of the unsnapped corners.", spread="edges"),
        "total": VariableText("n", "Sum of n0, n1 and n2."),
        "inverse_w": VariableText("1/w", "One over w at the pixel."),
        "weights": VariableText("λ# (unsnapped)", "Weight of the corner.", spread="edges"),
        "corner_values": VariableText(
            "at corner #", "All values of the corner, in order.", "weights", "edges"
        ),
        **{
            name: VariableText(ATTRIBUTE_NAMES[name], "Weighted sum of the corners' values.")
            for name in ATTRIBUTES
        },
        **COEFFICIENTS,
        "corner_w": given("w#", "w of the corner.", "edges"),
        "row_ends": VariableText("row ends", "x where the triangle begins and ends in this row."),
        "interval": VariableText("n (interval)", "Columns between corrections.", "grid"),
        "grid": VariableText("g, g + n", "x of the multiples of n before and behind the pixel."),
        "anchor_x": VariableText("l, r", "x of the two anchors, which are interpolated with perspective."),
        "fraction": VariableText(
            "t", "Position of the centre between the left (0) and the right anchor (1)."
        ),
        "anchor_weights": VariableText("λ at anchor #", "Perspective-correct weights.", spread="parts"),
    },
)
hides("interpolate.line-perspective", ("total",))
hides("interpolate.line-perspective|line-affine|point|flat", ("corner_w", *COEFFICIENTS))
hides("interpolate.line-perspective|line-affine", ("weights", "corner_values"))
