"""The formulas of transforming, culling and clipping."""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import (
    all_of,
    comparison,
    conclusion,
    digits_that_add_up,
    equation,
    linear,
    number_latex,
    signed_latex,
)
from core.explain.records import Formula
from core.explain.sentences.vertex import has_area
from core.explain.step_values import AXES, PLANE_SIGNS, StepValues


def _of_corner(step: StepValues, axis: str, space: str) -> str:
    return rf"\vertex{{{step.whole('corner')}}}{{{axis}_{{\mathrm{{{space}}}}}}}"


def transformed(step: StepValues) -> Formula:
    """One row of a matrix times a position."""
    before, after = step.kind.split("-to-")
    row = AXES.index(step.operation)
    position = step.vector("before")
    elements = [(f"m_{{{row + 1}{k + 1}}}", step.rows("matrix")[row][k]) for k in range(4)]
    units = [(_of_corner(step, axis, before), position[k]) for k, axis in enumerate(AXES)]
    value = step.number(f"after_{step.operation}")
    return linear(_of_corner(step, step.operation, after), value, elements, *units)


def divided(step: StepValues) -> Formula:
    """One component divided by w."""
    axis = step.operation
    above, below = number_latex(step.number(f"before_{axis}")), number_latex(step.number("before_w"))
    fraction = rf"\vertex{{{step.whole('corner')}}}{{\frac{{{axis}_{{\mathrm{{clip}}}}}}{{w}}}}"
    return equation(
        (_of_corner(step, axis, "ndc"), step.number(f"after_{axis}")),
        "=",
        (fraction, rf"\frac{{{above}}}{{{below}}}"),
    )


def placed(step: StepValues) -> Formula:
    """One component from [-1, 1] to the window."""
    axis = step.operation
    half: tuple[str, float | str] = (r"\frac{1}{2}", r"\frac{1}{2}")
    if axis != "z":
        name, size = ("W", step.whole("width")) if axis == "x" else ("H", step.whole("height"))
        half = (rf"\frac{{{name}}}{{2}}", rf"\frac{{{size}}}{{2}}")
    return equation(
        (_of_corner(step, axis, "window"), step.number(f"after_{axis}")),
        "=",
        (
            rf"({_of_corner(step, axis, 'ndc')} + 1)",
            f"({number_latex(step.number(f'before_{axis}'))} + 1)",
        ),
        r"\cdot",
        half,
    )


def behind(step: StepValues) -> Formula:
    """No w above 0."""
    compared = [comparison(f"w_{k}", r"\le", w) for k, w in enumerate(step.vector("w"))]
    return all_of(compared, *conclusion("dropped", "dropped" if step.flag("applies") else "stays"))


def plane(step: StepValues) -> Formula:
    """All corners outside a plane."""
    compared = [comparison(f"d_{k}", "<", distance) for k, distance in enumerate(step.vector("distances"))]
    return all_of(compared, *conclusion("dropped", "dropped" if step.flag("applies") else "stays"))


def _area(step: StepValues) -> str:
    return "2A" if has_area(step) else "D"


def degenerate(step: StepValues) -> Formula:
    """No area."""
    found = "dropped" if step.flag("applies") else "stays"
    return equation(*comparison(_area(step), "=", step.number("facing")), *conclusion("dropped", found))


def facing(step: StepValues) -> Formula:
    """The sign of the area."""
    value = step.number("facing")
    found = "front" if value > 0 else "back"
    return equation(*comparison(_area(step), ">", value), *conclusion("front", found))


def distances(step: StepValues) -> Formula:
    """Signed distances of both ends from a plane."""
    axis, sign = PLANE_SIGNS[step.text("plane")]
    place = AXES.index(axis)
    operator = "+" if sign > 0 else "-"
    start, end = step.vector("start"), step.vector("end")
    digits = max(
        digits_that_add_up(step.number(f"{name}_distance"), [(position[3],), (sign, position[place])])
        for name, position in (("start", start), ("end", end))
    )
    return equation(
        (r"d_{\mathrm{start}}", step.number("start_distance")),
        "=",
        (r"w_{\mathrm{start}}", start[3]),
        operator,
        (rf"{axis}_{{\mathrm{{start}}}}", start[place]),
        r"\quad",
        (r"d_{\mathrm{end}}", step.number("end_distance")),
        "=",
        (r"w_{\mathrm{end}}", end[3]),
        operator,
        (rf"{axis}_{{\mathrm{{end}}}}", end[place]),
        digits=digits,
    )


def _inner_and_outer(step: StepValues, name: str) -> tuple[str, str]:
    ends = (f"start{name}", f"end{name}")
    return ends if step.kind == "in-out" else ends[::-1]


def crossing(step: StepValues) -> Formula:
    """Where an edge crosses a plane."""
    inner, outer = (step.number(name) for name in _inner_and_outer(step, "_distance"))
    numbers = rf"\frac{{{number_latex(inner)}}}{{{number_latex(inner)} - {signed_latex(outer)}}}"
    symbols = r"\frac{d_{\mathrm{in}}}{d_{\mathrm{in}} - d_{\mathrm{out}}}"
    return equation(("t", step.number("t")), "=", (symbols, numbers))


def new_corner(step: StepValues) -> Formula:
    """The corner made there, in the component that changes most."""
    inner, outer = (step.vector(name) for name in _inner_and_outer(step, ""))
    place = max(range(4), key=lambda k: abs(outer[k] - inner[k]))
    axis, t, value = AXES[place], step.number("t"), step.vector("corner")[place]
    digits = digits_that_add_up(value, [(inner[place],), (t, outer[place]), (-1.0, t, inner[place])])
    return equation(
        (axis, value),
        "=",
        (rf"{axis}_{{\mathrm{{in}}}}", inner[place]),
        "+",
        ("t", t),
        r"\cdot",
        (
            rf"({axis}_{{\mathrm{{out}}}} - {axis}_{{\mathrm{{in}}}})",
            f"({number_latex(outer[place], digits)} - {signed_latex(inner[place], digits)})",
        ),
        digits=digits,
    )


FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    **{
        f"transform.{kind}.{axis}": transformed
        for kind in ("object-to-world", "world-to-camera", "camera-to-clip")
        for axis in AXES
    },
    **{f"transform.divide.{axis}": divided for axis in "xyz"},
    **{f"transform.viewport.{axis}": placed for axis in "xyz"},
    "cull.behind.test": behind,
    "cull.plane.test": plane,
    "cull.degenerate.test": degenerate,
    "cull.facing.test": facing,
    **{f"clip.{case}.distances": distances for case in ("in-in", "in-out", "out-in", "out-out")},
    **{f"clip.{case}.t": crossing for case in ("in-out", "out-in")},
    **{f"clip.{case}.corner": new_corner for case in ("in-out", "out-in")},
}
