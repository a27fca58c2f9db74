"""Transforming vertices: a row of a matrix, the division by w, and the viewport."""

from functools import partial

from core.explain.formulas import HALF, Named, below, formula_of, named, total
from core.explain.number_text import spoken
from core.explain.records import Asked, number
from core.explain.step_values import AXES, REMARKS, Said, StepValues, explains
from core.explain.steps import VariableText, given, shows
from core.records.terms import Colored, Term

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


def _vertex(step: StepValues) -> str:
    """Return the number of a vertex in its triangle, as the views label it, and that in the scene where it differs."""
    corner, number = step.whole("corner"), step.whole("vertex")
    of_scene = f" (vertex {number} of the scene)" if number != corner else ""
    return f"Vertex {corner} of {step.name}{of_scene}"


def _in_space(step: StepValues, axis: str, space: str, value: float) -> Named:
    """Return a component of the position in a space, with its symbol."""
    return named(below(axis, space), value).of_vertex(_colored(step))


def _colored(step: StepValues) -> int | None:
    """Return the corner of the step, in whose colour its numbers stand; ``None``: one of many of a polygon."""
    return None if step.explanation.corner_count > 3 else step.whole("corner")


def position(step: StepValues) -> Asked | None:
    """Ask for x after the step."""
    after = step.vector("after")
    done = step.kind.replace("-", " ")
    text = f"What is x of v{_vertex(step)[1:]} after the step “{done}”?"
    return number(text, after[0], f"({', '.join(map(spoken, after))}).")


@explains("transform.object-to-world|world-to-camera|camera-to-clip.x|y|z|w", asks=position)
def transformed(step: StepValues) -> Said:
    """One row of a matrix times a position."""
    before, after = step.kind.split("-to-")
    axis, value = step.operation, step.number(f"after_{step.operation}")
    text = (
        f"{_vertex(step)}: its {after} {axis} is {spoken(value)}, "
        f"the {ORDINALS[axis]} row of {MATRICES[step.kind]} times its {before} position"
    )
    if after == "clip" and axis == "w" and step.rows("matrix")[3] != [0.0, 0.0, 0.0, 1.0]:
        text += f"; w {'above 0 means' if value > 0 else 'of 0 or less means not'} in front of the eye"
    row, place = AXES.index(axis), step.vector("before")
    products = (
        named(f"m_{{{row + 1}{k + 1}}}", step.rows("matrix")[row][k]) * _in_space(step, of, before, place[k])
        for k, of in enumerate(AXES)
    )
    return f"{text}.", formula_of(_in_space(step, axis, after, value).equals(total(products)))


@explains("transform.divide.x|y|z", asks=position)
def divided(step: StepValues) -> Said:
    """One component divided by w."""
    axis = step.operation
    before, after, w = (step.number(name) for name in (f"before_{axis}", f"after_{axis}", "before_w"))
    text = f"{_vertex(step)}: its NDC {axis} is {spoken(after)}"
    text += f", clip {axis} = {spoken(before)} divided by w = {spoken(w)}"
    if w == 0:
        text += "; with w = 0 it has no position in the window"
    elif w < 0:
        text += "; as w is below 0 it lies behind the eye, and the division mirrors it"
    elif abs(after) > 1:
        text += f"; not between −1 and 1, so it lies beyond the {BEYOND[axis, 1 if after > 0 else -1]} plane"
    quotient, corner = named(below(axis, "clip"), before) / named("w", w), _colored(step)
    shown = quotient if corner is None else Colored(corner, quotient)
    return f"{text}.", formula_of(_in_space(step, axis, "ndc", after).equals(shown))


REMARKS["transform.divide.z"] = lambda columns, rows: columns["before_w"][rows] <= 0


@explains("transform.viewport.x|y|z", asks=position)
def placed(step: StepValues) -> Said:
    """One component from NDC to the window."""
    axis = step.operation
    before, after = step.number(f"before_{axis}"), step.number(f"after_{axis}")
    half: Term = HALF
    text = f"its depth is {spoken(after)}: NDC z is {spoken(before)}, and −1 to 1 becomes 0 to 1"
    if axis != "z":
        side, name, size = (
            ("the left", "W", step.whole("width"))
            if axis == "x"
            else ("the bottom", "H", step.whole("height"))
        )
        half = named(name, size) / 2
        text = (
            f"its window {axis} is {spoken(after)} pixels from {side}: "
            f"NDC {axis} is {spoken(before)}, and −1 to 1 becomes 0 to {size}"
        )
    made = _in_space(step, axis, "window", after).equals((_in_space(step, axis, "ndc", before) + 1) * half)
    return f"{_vertex(step)}: {text}.", formula_of(made)


SPACES = {"divide": "ndc", "viewport": "window"}
"""Steps that are not named after the space they lead to."""


def _label(step: StepValues, axis: str) -> str:
    return f"{axis} {SPACES.get(step.kind, step.kind.split('-to-')[-1])}"


shows(
    "transform",
    {
        "corner": given("vertex", "Number of the vertex in its triangle."),
        "vertex": given("number in the scene", "Number of the vertex in the scene."),
        "before": given("position before", "x, y, z, w in the space before the step."),
        **{
            f"after_{axis}": VariableText(partial(_label, axis=axis), f"{axis} in the space after the step.")
            for axis in AXES
        },
        "width": given("W", "Width of the picture in pixels."),
        "height": given("H", "Height of the picture in pixels."),
    },
)
