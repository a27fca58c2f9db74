"""What is said of clipping after the division, and of new corners that are computed in the polygon's order."""

from collections.abc import Callable, Mapping

from core.explain.number_text import spoken, vector_text
from core.explain.step_values import StepValues


def divided(step: StepValues) -> str:
    """A corner divided by its w."""
    clip, ndc = step.vector("clip"), vector_text(step.vector("ndc"))
    return f"Triangle {step.triangle}, corner {step.whole('number')}: x, y and z over w = {spoken(clip[3])} are {ndc}."


def mirrored(step: StepValues) -> str:
    """A corner behind the eye that now looks like one in front of it."""
    w = spoken(step.vector("clip")[3])
    return (
        f"Corner {step.whole('number')} is behind the eye (w = {w}), so the division has mirrored it: from here on "
        "nobody can tell, and the edges to it run the wrong way around."
    )


def undefined(step: StepValues) -> str:
    """A triangle that cannot be divided."""
    w = spoken(step.vector("clip")[3])
    return (
        f"Corner {step.whole('number')} has w = {w}: the triangle has a corner that cannot be divided by w, "
        "and is left out."
    )


def crossing_in_order(step: StepValues) -> str:
    """Where an edge crosses the plane, counted from its start."""
    way = "leaves" if step.kind == "in-out" else "enters"
    start, end = step.number("start_distance"), step.number("end_distance")
    return (
        f"The edge {way} through the {step.text('plane')} plane at t = {spoken(step.number('t'))} from its start: "
        f"the distances of its ends are {spoken(start)} and {spoken(end)}."
    )


def corner_in_order(step: StepValues) -> str:
    """The new corner, computed from the edge's start."""
    corner = vector_text(step.vector("corner"))
    rest = "the outside end is dropped" if step.kind == "in-out" else "after it the end, which is inside"
    return f"A new corner {corner} is handed on, computed from the start of the edge, and {rest}."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "clip.divided.divide": divided,
    "clip.mirrored.divide": divided,
    "clip.mirrored.sign": mirrored,
    "clip.undefined.drop": undefined,
    **{f"clip.{case}.t-in-order": crossing_in_order for case in ("in-out", "out-in")},
    **{f"clip.{case}.corner-in-order": corner_in_order for case in ("in-out", "out-in")},
}
