"""What is said while triangles are transformed, culled and clipped: one sentence for every key."""

from collections.abc import Callable, Mapping

from core.explain.number_text import joined, spoken, vector_text
from core.explain.step_values import PLANE_SIGNS, StepValues

ORDINALS = {"x": "first", "y": "second", "z": "third", "w": "fourth"}
MATRICES = {
    "object-to-world": "the model matrix M",
    "world-to-camera": "the inverse camera matrix",
    "camera-to-clip": "the projection matrix P",
}
BEYOND = {("x", -1): "left", ("x", 1): "right", ("y", -1): "bottom", ("y", 1): "top"} | {
    ("z", -1): "near",
    ("z", 1): "far",
}


def _corner(step: StepValues) -> str:
    return f"Corner {step.whole('corner')} of triangle {step.triangle}"


def transformed(step: StepValues) -> str:
    """One component of a matrix times a position."""
    before, after = step.kind.split("-to-")
    axis = step.operation
    value = step.number(f"after_{axis}")
    text = (
        f"{_corner(step)}: its {after} {axis} is {spoken(value)}, "
        f"the {ORDINALS[axis]} row of {MATRICES[step.kind]} times its {before} position"
    )
    is_perspective = after == "clip" and axis == "w" and step.rows("matrix")[3] != [0.0, 0.0, 0.0, 1.0]
    if is_perspective and value > 0:
        text += "; w above 0 means in front of the eye"
    elif is_perspective and value <= 0:
        text += "; w not above 0 means that it cannot be seen from the eye"
    return text + "."


def divided(step: StepValues) -> str:
    """One component divided by w."""
    axis = step.operation
    before, after, w = (step.number(name) for name in (f"before_{axis}", f"after_{axis}", "before_w"))
    text = (
        f"{_corner(step)}: its NDC {axis} is {spoken(after)}, "
        f"clip {axis} = {spoken(before)} divided by w = {spoken(w)}"
    )
    if w == 0:
        text += "; with w = 0 it has no place in the window"
    elif w < 0:
        text += "; as w is below 0 it lies behind the eye, and the division mirrors it"
    elif abs(after) > 1:
        plane = BEYOND[axis, 1 if after > 0 else -1]
        text += f"; that is not between −1 and 1, so it lies beyond the {plane} plane"
    return text + "."


def placed(step: StepValues) -> str:
    """One component from NDC to the window."""
    axis = step.operation
    before, after = spoken(step.number(f"before_{axis}")), spoken(step.number(f"after_{axis}"))
    if axis == "z":
        return f"{_corner(step)}: its depth is {after}: NDC z is {before}, and −1 to 1 becomes 0 to 1."
    side, pixels = ("the left", step.whole("width")) if axis == "x" else ("the bottom", step.whole("height"))
    return (
        f"{_corner(step)}: its window {axis} is {after} pixels from {side}: "
        f"NDC {axis} is {before}, and −1 to 1 becomes 0 to {pixels}."
    )


def behind(step: StepValues) -> str:
    """Whether all corners have w of 0 or less."""
    w = step.vector("w")
    if step.flag("applies"):
        return (
            f"Triangle {step.triangle} is behind the eye and dropped: "
            f"no corner has w above 0 (w = {joined([spoken(value) for value in w])})."
        )
    in_front = [str(k) for k in range(3) if not w[k] <= 0]
    corners = f"corner{'s' if len(in_front) > 1 else ''} {joined(in_front)}"
    return (
        f"Triangle {step.triangle} is not behind the eye: {corners} "
        f"{'have' if len(in_front) > 1 else 'has'} w above 0 (w = {joined([spoken(v) for v in w])})."
    )


def plane(step: StepValues) -> str:
    """Whether all corners are outside one plane."""
    distances = step.vector("distances")
    name = step.text("plane")
    listed = joined([spoken(value) for value in distances])
    if step.flag("applies"):
        return (
            f"Triangle {step.triangle} is dropped: all its corners are outside the {name} plane "
            f"(distances {listed})."
        )
    inside = sum(not value < 0 for value in distances)
    return (
        f"Triangle {step.triangle} stays: {('no', 'one', 'two', 'all')[inside]} "
        f"of its corners {'are' if inside > 1 else 'is'} inside the {name} plane (distances {listed})."
    )


def has_area(step: StepValues) -> bool:
    """Tell whether twice the area decides the facing, or else the determinant of the (x, y, w) matrix."""
    if step.has("is_projected"):
        return all(step.flags("is_projected"))
    return all(value > 0 for value in step.vector("w"))


def area_name(step: StepValues) -> str:
    """Say what decides the facing."""
    return "twice its signed area" if has_area(step) else "the determinant of its (x, y, w) matrix"


def degenerate(step: StepValues) -> str:
    """Whether the triangle has an area."""
    if step.flag("applies"):
        return f"Triangle {step.triangle} is degenerate and dropped: {area_name(step)} is 0."
    facing = spoken(step.number("facing"))
    return f"Triangle {step.triangle} is not degenerate: {area_name(step)} is {facing}, not 0."


def facing(step: StepValues) -> str:
    """Which side is seen, and whether that side is dropped."""
    value = step.number("facing")
    side = "front" if value > 0 else "back"
    sign = "above" if value > 0 else "below"
    is_dropped = step.flag("applies")
    verdict = "is culled" if is_dropped else "may stay"
    which = "drops" if is_dropped else "keeps"
    return (
        f"Triangle {step.triangle} {verdict}: {area_name(step)} is {spoken(value)}, {sign} 0, "
        f"so we see its {side}, which the cull setting {which}."
    )


def kept(step: StepValues) -> str:
    """No test applied."""
    return f"Triangle {step.triangle} is kept: none of the tests drops it."


def _side(distance: float) -> str:
    where = "inside" if distance >= 0 else "outside"
    return f"{where} (distance {spoken(distance)})"


def distances(step: StepValues) -> str:
    """Distances of both ends of an edge from the plane."""
    start, end = step.number("start_distance"), step.number("end_distance")
    axis, sign = PLANE_SIGNS[step.text("plane")]
    plane_name = f"{step.text('plane')} plane (w {'+' if sign > 0 else '−'} {axis} = 0)"
    return (
        f"Triangle {step.triangle}, {plane_name}, edge {step.whole('edge')}: "
        f"its start is {_side(start)}, its end is {_side(end)}."
    )


def both_inside(step: StepValues) -> str:
    """An edge that stays."""
    return f"Both ends are inside the {step.text('plane')} plane, so the end is handed on."


def both_outside(step: StepValues) -> str:
    """An edge that goes."""
    return f"Both ends are outside the {step.text('plane')} plane, so nothing is handed on."


def crossing(step: StepValues) -> str:
    """Where an edge crosses the plane."""
    leaves = step.kind == "in-out"
    way, inner = ("leaves", "start") if leaves else ("enters", "end")
    d_in = step.number("start_distance" if leaves else "end_distance")
    d_out = step.number("end_distance" if leaves else "start_distance")
    t, part, whole = (spoken(value) for value in (step.number("t"), d_in, d_in - d_out))
    return (
        f"The edge {way} through the {step.text('plane')} plane at t = {t} from its inside end, the {inner}: "
        f"that end is {part} inside, and the two ends are {whole} apart."
    )


def new_corner(step: StepValues) -> str:
    """The corner made where an edge crosses the plane."""
    corner = vector_text(step.vector("corner"))
    if step.kind == "in-out":
        return f"A new corner {corner} is handed on, and the outside end is dropped."
    return f"A new corner {corner} is handed on, and after it the end, which is inside."


def untouched(step: StepValues) -> str:
    """A triangle that clipping leaves alone."""
    return (
        f"Triangle {step.triangle} goes on as it is: it crosses none of the planes that are clipped against."
    )


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **{f"transform.{kind}.{axis}": transformed for kind in MATRICES for axis in ORDINALS},
    **{f"transform.divide.{axis}": divided for axis in "xyz"},
    **{f"transform.viewport.{axis}": placed for axis in "xyz"},
    "cull.behind.test": behind,
    "cull.plane.test": plane,
    "cull.degenerate.test": degenerate,
    "cull.facing.test": facing,
    "cull.kept.verdict": kept,
    **{f"clip.{case}.distances": distances for case in ("in-in", "in-out", "out-in", "out-out")},
    "clip.in-in.keep": both_inside,
    "clip.out-out.drop": both_outside,
    "clip.in-out.t": crossing,
    "clip.out-in.t": crossing,
    "clip.in-out.corner": new_corner,
    "clip.out-in.corner": new_corner,
    "clip.untouched.keep": untouched,
}
