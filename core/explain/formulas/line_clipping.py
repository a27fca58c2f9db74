"""The formulas of line clipping: p, q and t, entries and exits, outcodes."""

from collections.abc import Callable, Mapping

from core.explain.formulas.equation import (
    Part,
    all_of,
    comparison,
    conclusion,
    equation,
    number_latex,
    relation,
    signed_latex,
    vector_latex,
)
from core.explain.records import Formula
from core.explain.sentences.line_clipping import code_text, uses_normals
from core.explain.step_values import StepValues

_P_AND_Q = {
    "left": ("-(x_1 - x_0)", r"x_0 - x_{\min}"),
    "right": ("x_1 - x_0", r"x_{\max} - x_0"),
    "bottom": ("-(y_1 - y_0)", r"y_0 - y_{\min}"),
    "top": ("y_1 - y_0", r"y_{\max} - y_0"),
}
"""Liang-Barsky's p and q of each border."""


def room(step: StepValues) -> Formula:
    """How fast an edge runs outwards, and how much room its first end has."""
    border, along, distance = step.text("border"), step.number("approach"), step.number("room")
    start, end, point = (step.vector(name) for name in ("window_start", "window_end", "border_point"))
    if uses_normals(step):
        normal = vector_latex(step.vector("normal"))
        reach = vector_latex([b - a for a, b in zip(start, end, strict=True)])
        offset = vector_latex([a - b for a, b in zip(start, point, strict=True)])
        first: list[Part] = [(r"N \cdot D", along), "=", (r"N", normal), r"\cdot", ("D", reach)]
        dot = r"N \cdot (P_0 - P_E)"
        return equation(
            *first, r"\quad", (dot, -distance), "=", ("N", normal), r"\cdot", (r"(P_0 - P_E)", offset)
        )
    axis = 0 if border in ("left", "right") else 1
    p = f"{number_latex(end[axis])} - {signed_latex(start[axis])}"
    q = f"{number_latex(point[axis])} - {signed_latex(start[axis])}"
    if border in ("left", "bottom"):
        p, q = f"-({p})", f"{number_latex(start[axis])} - {signed_latex(point[axis])}"
    of_p, of_q = _P_AND_Q[border]
    return equation(("p", along), "=", (of_p, p), r"\quad", ("q", distance), "=", (of_q, q))


def crossing(step: StepValues) -> Formula:
    """The t of a border's line."""
    along, distance = step.number("approach"), step.number("room")
    if uses_normals(step):
        symbols = r"\frac{N \cdot (P_0 - P_E)}{-N \cdot D}"
        numbers = rf"\frac{{{number_latex(-distance)}}}{{{number_latex(-along)}}}"
    else:
        symbols = r"\frac{q}{p}"
        numbers = rf"\frac{{{number_latex(distance)}}}{{{number_latex(along)}}}"
    return equation(("t", step.number("crossing_t")), "=", (symbols, numbers))


def narrow(step: StepValues) -> Formula:
    """The latest entry or the earliest exit by now."""
    is_entry = step.kind == "clip-enter"
    name, symbol, rule = ("t_enter", "t_E", r"\max") if is_entry else ("t_leave", "t_L", r"\min")
    before = number_latex(step.number("bound_before"))
    numbers = f"{rule}({before}, {number_latex(step.number('crossing_t'))})"
    return equation((symbol, step.number(name)), "=", (rf"{rule}({symbol}, t)", numbers))


def side(step: StepValues) -> Formula:
    """On which side of its parallel border an edge lies."""
    distance = step.number("room")
    if uses_normals(step):
        compared = comparison(r"N \cdot (P_0 - P_E)", r"\le", -distance)
    else:
        compared = comparison("q", r"\ge", distance)
    return equation(*compared, *conclusion("inside", "outside" if distance < 0 else "inside"))


def kept(step: StepValues) -> Formula:
    """The verdict: the last entry comes before the first exit."""
    enter, leave = step.number("t_enter"), step.number("t_leave")
    compared: list[Part] = [("t_E", enter), (r"\le", relation(enter, leave)), ("t_L", leave)]
    return equation(*compared, *conclusion("draw", "nothing" if enter > leave else "draw"))


def codes(step: StepValues) -> Formula:
    """The outcodes of both ends, and what they have in common."""
    first, second = step.whole("code_start"), step.whole("code_end")
    shown = [rf"\mathrm{{{code_text(code)}}}" for code in (first, second, first & second)]
    return equation(("c_0", shown[0]), r"\quad", ("c_1", shown[1]), r"\quad", (r"c_0 \land c_1", shown[2]))


def decided(step: StepValues) -> Formula:
    """The verdict of two outcodes."""
    first, second = step.whole("code_start"), step.whole("code_end")
    if step.kind == "outcodes-reject":
        return equation(
            *comparison(r"c_0 \land c_1", r"\ne", float(first & second)), *conclusion("drop", "drop")
        )
    compared = [comparison("c_0", "=", float(first)), comparison("c_1", "=", float(second))]
    return all_of(compared, *conclusion("draw", "draw"))


def chosen_edge(step: StepValues) -> Formula:
    """The lowest bit of the outcode names the border."""
    k = step.whole("moved_end")
    code = rf"\mathrm{{{code_text(step.whole(('code_start', 'code_end')[k]))}}}"
    return equation((f"c_{k}", code), *conclusion("lowest bit", step.text("border")))


def move(step: StepValues) -> Formula:
    """The point of the edge on the border."""
    start, end, point = (step.vector(name) for name in ("window_start", "window_end", "moved_to"))
    u, v = (0, 1) if step.text("border") in ("left", "right") else (1, 0)
    a, b = "xy"[u], "xy"[v]
    symbols = rf"{b}_0 + ({b}_1 - {b}_0) \frac{{{a} - {a}_0}}{{{a}_1 - {a}_0}}"
    n = number_latex
    numbers = (
        rf"{n(start[v])} + ({n(end[v])} - {signed_latex(start[v])}) "
        rf"\frac{{{n(point[u])} - {signed_latex(start[u])}}}{{{n(end[u])} - {signed_latex(start[u])}}}"
    )
    return equation((a, point[u]), r"\quad", (b, point[v]), "=", (symbols, numbers))


_EDGE: Mapping[str, Callable[[StepValues], Formula | None]] = {
    "room": room,
    "crossing": crossing,
    "narrow": narrow,
}
_KINDS: Mapping[str, Mapping[str, Callable[[StepValues], Formula | None]]] = {
    "clip-enter": _EDGE,
    "clip-leave": _EDGE,
    "clip-parallel": {"room": room, "side": side},
    "clip-outside": {"room": room, "drop": side},
    "clip-kept": {"ends": kept},
    "clip-empty": {"drop": kept},
    "outcodes-accept": {"codes": codes, "ends": decided},
    "outcodes-reject": {"codes": codes, "drop": decided},
    "outcodes-cut": {"codes": codes, "edge": chosen_edge, "move": move},
}
FORMULAS: Mapping[str, Callable[[StepValues], Formula | None]] = {
    f"raster.{kind}.{name}": make for kind, of_kind in _KINDS.items() for name, make in of_kind.items()
}
