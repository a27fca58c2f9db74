"""The formulas of the edge functions, of binning and of coverage."""

from collections.abc import Callable, Mapping

import numpy as np

from core.explain.formulas import spans as formulas_spans
from core.explain.formulas.equation import (
    Part,
    all_of,
    comparison,
    conclusion,
    digits_that_add_up,
    equation,
    lattice_latex,
    linear,
    linear_digits,
    linear_parts,
    number_latex,
    relation,
    signed_latex,
    vector_latex,
)
from core.explain.formulas.numbers import equals
from core.explain.records import Formula
from core.explain.sentences.raster import disagreeing_edges
from core.explain.step_values import StepValues


def projected(step: StepValues) -> Formula:
    """A corner divided by its w."""
    k = step.whole("corner")
    x, y, w = step.vector("homogeneous")
    window = step.vector("window")

    def fraction(axis: str, value: float) -> Part:
        symbols = rf"\vertex{{{k}}}{{\frac{{{axis}}}{{w}}}}"
        return (symbols, rf"\frac{{{number_latex(value)}}}{{{number_latex(w)}}}")

    first: list[Part] = [(rf"\vertex{{{k}}}{{x_{{\mathrm{{window}}}}}}", window[0]), "=", fraction("x", x)]
    second: list[Part] = [(rf"\vertex{{{k}}}{{y_{{\mathrm{{window}}}}}}", window[1]), "=", fraction("y", y)]
    return equation(*first, r"\quad", *second)


def snapped(step: StepValues) -> Formula:
    """A corner rounded to 1/256 pixel."""
    k = step.whole("corner")
    parts: list[Part] = []
    for axis, window, lattice in zip("xy", step.vector("window"), step.vector("snapped"), strict=True):
        parts += [r"\quad"] if parts else []
        symbol = rf"\vertex{{{k}}}{{{axis}_{{\mathrm{{window}}}}}}"
        parts += [
            (rf"\vertex{{{k}}}{{{axis}_{k}}}", lattice_latex(lattice)),
            "=",
            (
                rf"\frac{{\mathrm{{round}}(256 \cdot {symbol})}}{{256}}",
                rf"\frac{{\mathrm{{round}}(256 \cdot {signed_latex(window)})}}{{256}}",
            ),
        ]
    return equation(*parts)


def orientation(step: StepValues) -> Formula:
    """Twice the area, or the determinant where a corner is not projected."""
    value = step.number("doubled_area")
    corners = [step.vector("snapped"), step.vector("start"), step.vector("finish")]
    if step.flag("is_projected") and all(np.isfinite(corners[0])):
        (x0, y0), (x1, y1, _), (x2, y2, _) = corners
        factors = [(x1, y2), (-x1, y0), (-x0, y2), (-x2, y1), (x2, y0), (x0, y1)]
        digits = digits_that_add_up(value, factors)

        def difference(axis: str, place: int, end: float, start: float) -> Part:
            return (
                rf"(\vertex{{{place}}}{{{axis}_{place}}} - \vertex{{0}}{{{axis}_0}})",
                f"({number_latex(end, digits)} - {signed_latex(start, digits)})",
            )

        sign, rest = equals(step, value, [[x1 - x0, y2 - y0], [-(x2 - x0), y1 - y0]])
        return equation(
            ("2A", value),
            sign,
            difference("x", 1, x1, x0),
            r"\cdot",
            difference("y", 2, y2, y0),
            "-",
            difference("x", 2, x2, x0),
            r"\cdot",
            difference("y", 1, y1, y0),
            *rest,
            digits=digits,
        )
    symbols = r"\det \begin{pmatrix} x_0 & y_0 & w_0 \\ x_1 & y_1 & w_1 \\ x_2 & y_2 & w_2 \end{pmatrix}"
    if step.flag("is_projected"):
        # The two other corners stand here divided by their w, which this determinant is not made of.
        return equation((symbols, value))
    x, y, w = step.vector("homogeneous")
    if all(np.isfinite(corners[0])):
        x, y = corners[0][0] * w, corners[0][1] * w
    rows = [[x, y, w], *corners[1:]]
    matrix = r" \\ ".join(" & ".join(map(number_latex, row)) for row in rows)
    return equation(("D", value), "=", (symbols, rf"\det \begin{{pmatrix}} {matrix} \end{{pmatrix}}"))


def coefficient(step: StepValues) -> Formula:
    """One component of the cross product of an edge's ends."""
    name, k = step.operation, step.whole("edge")
    i, j = (k + 1) % 3, (k + 2) % 3
    first = dict(zip("xyw", step.vector("start"), strict=True))
    second = dict(zip("xyw", step.vector("finish"), strict=True))
    sign = float(np.sign(step.number("doubled_area")))
    one, other = {"a": ("y", "w"), "b": ("w", "x"), "c": ("x", "y")}[name]
    products = [[sign, first[one], second[other]], [-sign, first[other], second[one]]]
    digits = digits_that_add_up(step.number(name), products)
    relation_sign, rest = equals(step, step.number(name), products, 16 if name == "c" else 8)
    return equation(
        (f"{name}_{k}", step.number(name)),
        relation_sign,
        ("s", sign),
        r"\cdot",
        (
            rf"(\vertex{{{i}}}{{{one}_{i}}} \vertex{{{j}}}{{{other}_{j}}} "
            rf"- \vertex{{{i}}}{{{other}_{i}}} \vertex{{{j}}}{{{one}_{j}}})",
            rf"({number_latex(first[one], digits)} \cdot {signed_latex(second[other], digits)} "
            rf"- {signed_latex(first[other], digits)} \cdot {signed_latex(second[one], digits)})",
        ),
        *rest,
        digits=digits,
    )


def anchored_coefficient(step: StepValues) -> Formula:
    """One coefficient of an edge with one snapped end: its direction in whole numbers u, through the corner exactly."""
    name, k = step.operation, step.whole("edge")
    forward = step.whole("anchor") > 0
    i, j = ((k + 1) % 3, (k + 2) % 3) if forward else ((k + 2) % 3, (k + 1) % 3)
    x, y, _ = step.vector("start" if forward else "finish")
    end_x, end_y, end_w = step.vector("finish" if forward else "start")
    sign = float(np.sign(step.number("doubled_area"))) * step.whole("anchor")
    value = (f"{name}_{k}", step.number(name))
    if name == "c":
        a, b = step.number("a"), step.number("b")
        return equation(
            value,
            "=",
            r"-",
            (f"a_{k}", a),
            r"\cdot",
            (rf"\vertex{{{i}}}{{x_{i}}}", x),
            "-",
            (f"b_{k}", b),
            r"\cdot",
            (rf"\vertex{{{i}}}{{y_{i}}}", y),
        )
    corner, end, axis = (y, end_y, "y") if name == "a" else (x, end_x, "x")
    direction = corner * end_w - end if name == "a" else end - corner * end_w
    ends = rf"\vertex{{{i}}}{{{axis}_{i}}} \vertex{{{j}}}{{w_{j}}}"
    symbols = (
        rf"{ends} - \vertex{{{j}}}{{{axis}_{j}}}"
        if name == "a"
        else rf"\vertex{{{j}}}{{{axis}_{j}}} - {ends}"
    )
    return equation(
        value,
        "=",
        ("s", sign),
        r"\cdot",
        (
            rf"\mathrm{{round}} \frac{{{symbols}}}{{u}}",
            rf"\mathrm{{round}} \frac{{{number_latex(direction)}}}{{u}}",
        ),
    )


def tie(step: StepValues) -> Formula:
    """The rule for a pixel centre on an edge."""
    k, a, b = step.whole("edge"), step.number("a"), step.number("b")
    rule, found = step.fill_rule(0), "inside" if step.flag("owns_tie") else "outside"
    if rule != "shared-edge":
        return equation(
            f"E_{k}", r"\ge" if rule == "inclusive" else ">", "0", *conclusion("inside", "inside")
        )
    if a != 0:
        return equation(*comparison(f"a_{k}", ">", a), *conclusion("inside", found))
    parts = [comparison(f"a_{k}", "=", a), comparison(f"b_{k}", ">", b)]
    return all_of(parts, *conclusion("inside", found))


def box_low(step: StepValues) -> Formula:
    """The first column and row of the box."""
    return _box(step, r"\lceil", r"\rceil", r"\min", ("column", "row"))


def box_high(step: StepValues) -> Formula:
    """The columns and rows of the box."""
    parts: list[Part] = []
    for name, axis in (("column", "n_x"), ("row", "n_y")):
        first, end = step.whole(name), step.whole(f"{name}_end")
        parts += [r"\quad"] if parts else []
        end_symbol, first_symbol = rf"\mathrm{{{name}}}_{{\mathrm{{end}}}}", rf"\mathrm{{{name}}}"
        parts += [
            (axis, float(end - first)),
            "=",
            (end_symbol, float(end)),
            "-",
            (first_symbol, float(first)),
        ]
    return equation(*parts)


def _box(step: StepValues, left: str, right: str, extreme: str, names: tuple[str, str]) -> Formula:
    center = step.number("center")
    parts: list[Part] = []
    for name, axis, values in zip(names, "xy", zip(*step.rows("corners"), strict=True), strict=True):
        parts += [r"\quad"] if parts else []
        symbols = ", ".join(rf"\vertex{{{k}}}{{{axis}_{k}}}" for k in range(3))
        rounded = rf"{left} {extreme}({symbols}) - c {right}"
        numbers = rf"{left} {extreme}{vector_latex(values)} - {number_latex(center)} {right}"
        nominal = int(np.ceil(min(values) - center))
        if step.whole(name) != nominal:
            rounded = rf"\max({rounded}, \mathrm{{first}})"
            numbers = rf"\max({nominal}, {step.whole(name)})"
        parts += [(rf"\mathrm{{{name}}}", float(step.whole(name))), "=", (rounded, numbers)]
    return equation(*parts)


def bin_behind(step: StepValues) -> Formula:
    """No corner in front of the eye."""
    symbols: list[Part] = []
    for k in range(3):
        symbols += ([r"\land"] if k else []) + [f"w_{k}", r"\le", "0"]
    return equation(*symbols, *conclusion("nothing to draw", "nothing to draw"))


def _bound(step: StepValues, name: str, extreme: str) -> Formula:
    values = step.vector(name)
    if step.has("a", "b", "c"):
        # At the corner of the block where the deciding edge has its greatest or least value.
        rejected = step.whole("rejected_by")
        k = rejected if name == "high" and rejected >= 0 else int(np.argmin(values))
        a, b, c = (step.vector(coefficient)[k] for coefficient in "abc")
        low_x, low_y = (step.whole(place) + step.number("center") for place in ("column", "row"))
        reach = step.whole("size") - 1
        x = low_x + (reach if (a > 0) == (name == "high") else 0)
        y = low_y + (reach if (b > 0) == (name == "high") else 0)
        coefficients = [(f"a_{k}", a), (f"b_{k}", b), (f"c_{k}", c)]
        return linear(rf"E_{k}^{{{extreme}}}", values[k], coefficients, ("x", x), ("y", y))
    parts: list[Part] = []
    for k, value in enumerate(values):
        parts += [r"\quad"] if parts else []
        parts += comparison(rf"E_{k}^{{{extreme}}}", "<" if name == "high" else ">", value)
    return equation(*parts)


def block_high(step: StepValues) -> Formula:
    """The greatest value of an edge function in a block."""
    return _bound(step, "high", r"\max")


def block_low(step: StepValues) -> Formula:
    """The least value of an edge function in a block."""
    return _bound(step, "low", r"\min")


def block_verdict(step: StepValues) -> Formula:
    """What decides about a block."""
    verdict, edge = step.text("verdict"), step.whole("rejected_by")
    if verdict == "outside":
        compared = comparison(rf"E_{edge}^{{\max}}", "<", step.vector("high")[edge])
        return equation(*compared, *conclusion("outside", "outside"))
    least = [comparison(rf"E_{k}^{{\min}}", ">", low) for k, low in enumerate(step.vector("low"))]
    found = {"inside": "inside", "split": "split", "leaf": "test its pixels"}[verdict]
    return all_of(least, *conclusion("inside", found))


def edge_value(step: StepValues) -> Formula:
    """One edge function at a pixel's centre."""
    k = int(step.operation.removeprefix("edge-"))
    coefficients = [(f"{name}_{k}", step.vector(name)[k]) for name in "abc"]
    units = ("x", step.number("x")), ("y", step.number("y"))
    value, (a, b, c) = step.number(f"value_{k}"), (number for _, number in coefficients)
    sign, rest = equals(step, value, [[a, units[0][1]], [b, units[1][1]], [c]])
    _, _, *terms = linear_parts(f"E_{k}", value, coefficients, *units)
    digits = linear_digits(value, coefficients, *units)
    return equation((f"E_{k}", value), sign, *terms, *rest, digits=digits)


def decision(step: StepValues) -> Formula:
    """The inside test; where a weight disagrees by snapping, the weight beside it."""
    values, owns = step.vector("values"), step.flags("owns_tie")
    compared = [comparison(f"E_{k}", r"\ge" if owns[k] else ">", values[k]) for k in range(3)]
    parts = conclusion("covered", "covered" if step.flag("covered") else "outside")
    for k in disagreeing_edges(step):
        weight = step.vector("weights")[k]
        parts += [r"\quad", (rf"\lambda_{k}", weight), (relation(weight)), "0"]
    return all_of(compared, *parts)


def span_edge(step: StepValues) -> Formula:
    """Where a row crosses an edge."""
    k = int(step.operation.removeprefix("edge-"))
    a, b, c = (step.vector(name)[k] for name in "abc")
    y = step.number("y")
    if a == 0:
        return linear(f"E_{k}", b * y + c, [(f"b_{k}", b), (f"c_{k}", c)], ("y", y))
    symbols = rf"-\frac{{b_{k} \cdot y + c_{k}}}{{a_{k}}}"
    numbers = rf"\frac{{{number_latex(b)} \cdot {signed_latex(y)} + {signed_latex(c)}}}{{{number_latex(a)}}}"
    return equation(("x", step.number(f"crossing_{k}")), "=", (symbols, f"-{numbers}"))


def span(step: StepValues) -> Formula:
    """The length of a span."""
    start, stop = step.whole("start"), step.whole("stop")
    ends: list[Part] = [(r"\mathrm{stop}", float(stop)), "-", (r"\mathrm{start}", float(start))]
    return equation(("n", float(stop - start)), "=", *ends)


def line_ends(step: StepValues) -> Formula:
    """The two sides of a row, made by adding up inverse slopes."""
    first, second = (step.number(f"crossing_{k}") for k in range(2))
    return equation((r"x_{\mathrm{first}}", first), r"\quad", (r"x_{\mathrm{second}}", second))


def line_rounded(step: StepValues) -> Formula:
    """The two sides rounded."""
    parts: list[Part] = []
    for k, name in enumerate(("first", "second")):
        crossing = step.number(f"crossing_{k}")
        parts += [r"\quad"] if parts else []
        symbols = rf"\lfloor x_{{\mathrm{{{name}}}}} + \frac{{1}}{{2}} \rfloor"
        numbers = rf"\lfloor {number_latex(crossing)} + \frac{{1}}{{2}} \rfloor"
        rounded = float(np.floor(crossing + 0.5))
        parts += [(rf"\mathrm{{column}}_{{\mathrm{{{name}}}}}", rounded), "=", (symbols, numbers)]
    return equation(*parts)


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "edges.snapped.window": projected,
    "edges.snapped.snap": snapped,
    "edges.orientation.area": orientation,
    **{f"edges.edge.{name}": coefficient for name in "abc"},
    "edges.edge.tie": tie,
    **{f"edges.anchored-edge.{name}": anchored_coefficient for name in "abc"},
    "edges.anchored-edge.tie": tie,
    "edges.inverse-edge.tie": tie,
    "bin.box.low": box_low,
    "bin.box.high": box_high,
    "bin.outer-box.high": box_high,
    "bin.behind.drop": bin_behind,
    "bin.block.high": block_high,
    "bin.block.low": block_low,
    "bin.block.verdict": block_verdict,
    **{f"raster.test.edge-{k}": edge_value for k in range(3)},
    **{f"raster.{kind}.decide": decision for kind in ("test", "step", "climb")},
    **{f"raster.span.edge-{k}": span_edge for k in range(3)},
    "raster.span.span": span,
    "raster.line.ends": line_ends,
    "raster.line.round": line_rounded,
    **formulas_spans.FORMULAS,
}
