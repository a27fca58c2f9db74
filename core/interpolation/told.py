"""Interpolation, told step by step: weights of three corners or two ends, corrected every n pixels, and flat values."""

import math
from collections.abc import Sequence

import numpy as np

from core.explain.formulas import Chain, Named, below, call, formula_of, named, outstanding, total
from core.explain.number_text import is_remainder, listed, remainder_note, spoken, vector_text
from core.explain.records import Asked, number
from core.explain.step_values import ATTRIBUTES, Said, StepValues, component_names, explains
from core.explain.steps import CENTRE, COEFFICIENTS, VariableText, given, hides, shows
from core.explain.term_latex import work_out
from core.interpolation.interpolation import window_weights
from core.records.terms import Colored, Term
from core.records.words import joined, noun_of

# Interpolation along lines: the weights of both ends.


@explains("interpolate.line-perspective.parts")
def parts(step: StepValues) -> Said:
    """Both ends' parts of 1/w."""
    t, (start, end) = step.named("t", "t"), map(named, ("p_0", "p_1"), step.vector("parts"))
    first, second = (named(step.of_end("w", k), w) for k, w in enumerate(step.vector("end_w")))
    text = (
        f"{step.fragment_name}: at t = {t} between ends with w = {first} and w = {second}, "
        f"the first end gives {start} of 1/w and the second {end}."
    )
    return text, formula_of(start.equals((1 - t) / first), end.equals(t / second))


@explains("interpolate.line-perspective.total")
def total_along_line(step: StepValues) -> Said:
    """1/w along the line."""
    (start, end) = map(named, ("p_0", "p_1"), step.vector("parts"))
    whole = step.named("total", r"\frac{1}{w}")
    text = f"{step.fragment_name}: both parts add up to 1/w = {whole}."
    return text, formula_of(whole.equals(start + end))


def second_weight(step: StepValues) -> Asked | None:
    """Ask for the weight of the second end."""
    s = step.number("s")
    return number(f"What is s, the weight of the second end, at {step.the_pixel}?", s, f"s is {spoken(s)}.")


@explains("interpolate.*.weight", asks=second_weight, decides=True)
def weight(step: StepValues) -> Said:
    """The weights of the ends."""
    s, is_affine = step.named("s", "s"), step.kind == "line-affine"
    how = "its place along the line in the window" if is_affine else "its part divided by 1/w"
    text = f"{step.fragment_name}: the second end has weight {s}, {how}"
    of_first = f", and the first end {spoken(1 - s.value)}."
    if is_affine:
        before = step.named("t_before", r"s_{\mathrm{before}}")
        if math.isnan(before.value):
            return text + of_first, formula_of(s.equals(step.named("t", "t")))
        difference = named(r"\Delta s", s.value - before.value)
        if difference.value:
            more = "more" if difference.value > 0 else "less"
            text += f" and {spoken(abs(difference.value))} {more} than at the pixel before"
        return text + of_first, formula_of(s.equals(step.named("t", "t")), s.equals(before + difference))
    return text + of_first, formula_of(
        s.equals(named("p_1", step.vector("parts")[1]) / step.named("total", "1/w"))
    )


shows(
    "interpolate",
    {
        "t": given("t", "Position along the line: 0 at the first end, 1 at the second."),
        "end_w": given("w of the ends", "w of the line's first and second end."),
        "parts": VariableText("p₀, p₁", "Weight of each end over its w."),
        "s": VariableText("s", "Weight of the second end in the value."),
        "end_values": VariableText("at end #", "All values at the line's end, in order.", "s", "parts"),
    },
)


# Interpolation over triangles: weights with and without perspective, corrected every n pixels, and mixed
# values.


ATTRIBUTE_NAMES = {
    "color": "colour",
    "uv": "texture coordinates",
    "position": "world position",
    "normal": "normal",
    "diffuse_light": "diffuse light",
    "specular_light": "specular light",
}


@explains("interpolate.perspective|affine.numerators")
def numerators(step: StepValues) -> Said:
    """The unsnapped edge functions at the pixel."""
    values, is_affine = step.vector("numerators"), step.kind == "affine"
    what = "there, each the determinant times weight / w"
    if is_affine:
        what = "each multiplied by the w of its corner to leave perspective out"
    text = (
        f"{step.fragment_name}: the edge functions of the unsnapped corners are {listed(values)}"
        f"{',' if is_affine else ''} {what}."
    )
    x, y = step.centre
    sums = []
    for k, (a, b, c) in enumerate(map(step.plane, range(3))):
        here: Term = a * x + b * y + c
        if is_affine:
            here = (a @ x + b @ y + c) * named(f"w_{k}", step.vector("corner_w")[k])
        sums.append(named(f"n_{k}", values[k]).equals(here))
    return text, formula_of(*sums)


@explains("interpolate.perspective|affine.total")
def sum_of_three(step: StepValues) -> Said:
    """The sum of the three."""
    whole, inverse_w = step.named("total", "n"), spoken(step.number("inverse_w"))
    what = f"the determinant times 1/w, and 1/w is {inverse_w} here"
    if step.kind == "affine":
        what = f"the sum that the three weights are parts of (1/w is {inverse_w} here)"
    text = f"{step.fragment_name}: together they are {whole}, {what}."
    return text, formula_of(whole.equals(total(_numbered("n", step.vector("numerators")))))


def _numbered(letter: str, values: list[float]) -> list[Named]:
    """Return numbers of the corners with their symbols."""
    return [named(f"{letter}_{k}", value) for k, value in enumerate(values)]


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
    values, whole = step.vector("weights"), step.named("total", "n")
    text = f"{step.fragment_name}: corners 0, 1 and 2 have weights {listed(values)}, their parts of the sum"
    w = step.vector("corner_w")
    if step.kind == "perspective" and min(w) != max(w):
        in_window = window_weights(np.array(values), np.array(w)).tolist()
        text += f" after the division by w (in the window {listed(in_window)})"
    text += below_zero(values)
    if any(map(math.isnan, values)):
        text += "; NaN means that the sum is 0"
    parts = _numbered("n", step.vector("numerators"))
    return f"{text}.", formula_of(*quotients(step, parts, [whole] * 3))


def quotients(step: StepValues, over: Sequence[Term], under: Sequence[Term]) -> list[Chain]:
    """Return the three weights as quotients, in the colours of their corners."""
    weights = _numbered(r"\lambda", step.vector("weights"))
    return [weight.equals(Colored(k, over[k] / under[k])) for k, weight in enumerate(weights)]


@explains("interpolate.flat.weights", asks=first_weight, decides=True)
def flat_weights(step: StepValues) -> Said:
    """The weight of the provoking corner alone."""
    values = step.vector("weights")
    corner = values.index(max(values))
    others = "the other has" if len(values) == 2 else "the others have"
    text = f"{step.fragment_name}: only corner {corner} counts; {others} weight 0."
    return text, formula_of(*_numbered(r"\lambda", values))


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
    shares, ends = _numbered(r"\lambda", step.vector("weights")), _numbered(letter, corners)
    mixed = named(letter, found).equals(total(share * end for share, end in zip(shares, ends, strict=True)))
    if step.kind != "perspective" or not step.operation.endswith("uv"):
        return _value(step, how), formula_of(mixed)
    how += f", or {letter}/w over 1/w, which are A x + B y + C each"
    return _value(step, how), formula_of(mixed, *_quotient_of_planes(step, letter, found, corners))


def _quotient_of_planes(step: StepValues, letter: str, found: float, corners: list[float]) -> list[Chain]:
    """Return a value as value/w over 1/w, both of which are linear in x and y."""
    inverse_w, (x, y) = step.named("inverse_w", "1/w"), step.centre
    determinant = step.number("total") / inverse_w.value
    over_w = named(f"{letter}/w", found * inverse_w.value)
    made = []
    for quotient, of, values in ((over_w, letter, corners), (inverse_w, "w", [1.0] * 3)):
        a, b, c = (
            named(
                f"{column.upper()}_{of}",
                sum(slope * value for slope, value in zip(step.vector(column), values, strict=True))
                / determinant,
            )
            for column in "abc"
        )
        made.append(quotient.equals(a * x + b * y + c))
    return [*made, named(letter, found).equals(over_w / inverse_w)]


@explains("interpolate.line-perspective|line-affine.value")
def value_along(step: StepValues) -> Said:
    """A value between those of the ends of a line."""
    s = step.number("s")
    how = f"{spoken(1 - s)} of the first end's and {spoken(s)} of the second end's"
    name = step.operation.removeprefix("value-")
    letter, found, ends = _component(step, step.corner_values(name, "end_values"))
    first, second = (named(step.of_end(letter, end), value) for end, value in enumerate(ends))
    mixed = named(letter, found).equals(named("(1 - s)", 1 - s) * first + named("s", s) * second)
    if step.kind == "line-perspective" or math.isnan(step.number("t_before")):
        return _value(step, how), formula_of(mixed)
    # Linear along the line: every pixel adds the same difference.
    k = [one[0] for one in component_names(name, len(step.vector(name)))].index(letter)
    before = step.corner_values(name, "values_before")[0][k]
    difference = named(r"\Delta s", s - step.number("t_before"))
    added = named(letter, found).equals(
        named(f"{letter}_{{\\mathrm{{before}}}}", before) + difference * (second - first)
    )
    return _value(step, how), formula_of(mixed, added)


@explains("interpolate.point.value")
def value_of_point(step: StepValues) -> Said:
    """The value of a point."""
    letter, found, (of_point,) = _component(step, step.corner_values(step.operation.removeprefix("value-")))
    made = named(letter, found).equals(named(f"{letter}_0", of_point))
    return _value(step, "that of the point"), formula_of(made)


@explains("interpolate.affine-n.row")
def row(step: StepValues) -> Said:
    """Where the triangle begins and ends in the pixel's row: the nearest crossings of its left and right edges."""
    ends, y, determinant = step.vector("row_ends"), step.named("y", "y"), step.number("determinant")
    text = (
        f"{step.fragment_name}: in this row the unsnapped triangle reaches from x = {spoken(ends[0])} "
        f"to x = {spoken(ends[1])}."
    )
    if any(map(math.isinf, ends)):
        text = f"{step.fragment_name}: the triangle is edge-on, so its row has no ends."
    planes = [step.plane(k) for k in range(3)]
    sides: list[Chain | Term] = []
    for name, end, sign in zip(("left", "right"), ends, (1, -1), strict=True):
        side = named(below("x", name), end)
        crossings = [-((b @ y + c) / a) for a, b, c in planes if sign * a.value * determinant > 0]
        if crossings and math.isfinite(end):
            nearest = min(crossings, key=lambda crossing: abs(float(work_out(crossing)[0]) - end))
            sides.append(side.equals(nearest))
        else:
            sides.append(side)
    return text, formula_of(*sides)


@explains("interpolate.affine-n.grid")
def grid(step: StepValues) -> Said:
    """The columns of the grid beside a pixel."""
    before, behind = step.vector("grid")
    text = f"{step.fragment_name}: the multiples of {step.whole('interval')} beside it are at x = {spoken(before)} "
    return f"{text}and {spoken(behind)}.", formula_of(named("g", before), named("g + n", behind))


@explains("interpolate.affine-n.anchors")
def anchors(step: StepValues) -> Said:
    """The columns of the grid, moved to the ends of the row; a pixel beyond these is its own anchor."""
    left, right = map(named, "lr", step.vector("anchor_x"))
    before, behind = map(named, ("g", "g + n"), step.vector("grid"))
    x = step.named("x", "x")
    if left.value == right.value:
        text = (
            f"{step.fragment_name}: its centre is not between the ends of the triangle's row, "
            f"so it is its own anchor, x = {x}."
        )
        return text, formula_of(left.equals(right, x))
    text = f"{step.fragment_name}: its anchors are x = {left} and x = {right}"
    pairs = (("left", left, before), ("right", right, behind))
    moved = [name for name, anchor, of_grid in pairs if anchor.value != of_grid.value]
    if moved:
        text += f", the {joined(moved)} {'ends' if len(moved) == 2 else 'end'} moved to where the triangle's row ends"
    row_left, row_right = map(named, (below("x", "left"), below("x", "right")), step.vector("row_ends"))
    return f"{text}.", formula_of(
        left.equals(call("max", before, row_left)), right.equals(call("min", behind, row_right))
    )


@explains("interpolate.affine-n.fraction")
def position(step: StepValues) -> Said:
    """Where the pixel is between its anchors."""
    t = step.named("fraction", "t")
    (left, right) = map(named, "lr", step.vector("anchor_x"))
    x = step.named("x", "x")
    text = f"{step.fragment_name}: its centre is t = {t} of the way from the left to the right anchor."
    if t.value == 0:
        text = f"{step.fragment_name}: its centre is at the left anchor, t = 0."
    if left.value == right.value:
        return text, formula_of(named("t", 0.0))
    return text, formula_of(t.equals((x - left) / (right - left)))


@explains("interpolate.affine-n.corrected")
def corrected(step: StepValues) -> Said:
    """The perspective-correct weights at the anchors."""
    left, right = step.rows("anchor_weights")
    text = (
        f"{step.fragment_name}: with the division by 1/w the weights are {vector_text(left)} at the left anchor and "
        f"{vector_text(right)} at the right one."
    )
    return text, formula_of(*_at_anchor("l", left), *_at_anchor("r", right))


def _at_anchor(letter: str, weights: list[float]) -> list[Named]:
    """Return the weights at an anchor."""
    return [named(rf"\lambda_{k}({letter})", weight).of_vertex(k) for k, weight in enumerate(weights)]


@explains("interpolate.affine-n.weights", asks=first_weight, decides=True)
def corrected_weights(step: StepValues) -> Said:
    """The weights, linear between the anchors."""
    t, values, (left, right) = step.number("fraction"), step.vector("weights"), step.rows("anchor_weights")
    rest = (
        "; NaN means that 1/w is 0 at an anchor" if any(map(math.isnan, values)) else ", without a division"
    )
    text = (
        f"{step.fragment_name}: {spoken(1 - t)} of the left and {spoken(t)} of the right anchor's weights give "
        f"corners 0, 1 and 2 the weights {listed(values)}{rest}{remainder_note(values)}."
    )
    rest_of_t, at = named("(1 - t)", 1 - t), named("t", t)
    weights = zip(_numbered(r"\lambda", values), _at_anchor("l", left), _at_anchor("r", right), strict=True)
    return text, formula_of(
        *(weight.equals(rest_of_t * first + at * second) for weight, first, second in weights)
    )


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
