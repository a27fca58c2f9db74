"""What is said while the edges of a wireframe are clipped to the raster: one sentence for every key."""

from collections.abc import Callable, Mapping

from core.explain.number_text import joined, spoken, vector_text
from core.explain.step_values import StepValues
from core.geometry.line_clipping.records import RECTANGLE_EDGES

CODE_BITS = len(RECTANGLE_EDGES)
"""Digits of an outcode."""


def clipper(step: StepValues) -> str:
    """Return the method that clips."""
    return step.text("line_clipping")


def uses_normals(step: StepValues) -> bool:
    """Tell whether the method speaks of normals, as Cyrus-Beck does, not of p and q."""
    return clipper(step) != "liang-barsky"


def code_text(code: int) -> str:
    """Write an outcode in binary: top, bottom, right, left."""
    return f"{code:0{CODE_BITS}b}"


def edge_name(step: StepValues) -> str:
    """Return the edge of the triangle that is clipped."""
    return f"edge {step.whole('edge')} of triangle {step.triangle}"


def room(step: StepValues) -> str:
    """How an edge runs against a border."""
    along, distance = step.number("approach"), step.number("room")
    side = "inside" if distance > 0 else "outside" if distance < 0 else "on it"
    beginning = f"{step.text('border').capitalize()} border, {edge_name(step)}"
    if uses_normals(step):
        way = "PE, it may enter" if along < 0 else "PL, it may leave" if along > 0 else "parallel"
        return (
            f"{beginning}: N · D = {spoken(along)}, so it is {way}, "
            f"and N · (P₀ − Pₑ) = {spoken(-distance)} tells that it starts {side}."
        )
    way = "it runs inwards" if along < 0 else "it runs outwards" if along > 0 else "it runs parallel"
    return (
        f"{beginning}: p = {spoken(along)}, so {way}, and q = {spoken(distance)} tells that it starts {side}."
    )


def crossing(step: StepValues) -> str:
    """Where it crosses the line of the border."""
    quotient = "N · (P₀ − Pₑ) over −N · D" if uses_normals(step) else "q over p"
    t = step.number("crossing_t")
    where = "before its first end" if t < 0 else "after its second end" if t > 1 else "between its ends"
    if t in (0.0, 1.0):
        where = "at its first end" if t == 0 else "at its second end"
    return f"The {step.text('border')} border's line is crossed at t = {quotient} = {spoken(t)}, {where}."


def narrow(step: StepValues) -> str:
    """What the crossing changes."""
    is_entry = step.kind == "clip-enter"
    before, t = step.number("bound_before"), step.number("crossing_t")
    now = step.number("t_enter" if is_entry else "t_leave")
    if now == before:
        order = "after" if is_entry else "before"
        kind = "entry" if is_entry else "exit"
        return f"This {kind} changes nothing: t = {spoken(t)} does not come {order} the {kind} at {spoken(before)}."
    if is_entry:
        return f"This is the latest entry by now: the part before t = {spoken(now)} is outside."
    return f"This is the earliest exit by now: the part after t = {spoken(now)} is outside."


def side(step: StepValues) -> str:
    """A parallel edge that stays, for now."""
    border = step.text("border")
    if step.number("room") < 0:
        return f"As printed, a parallel edge is ignored, although it lies outside the {border} border: it will be kept."
    return f"The edge is parallel to the {border} border and not outside of it, so it is not cut there."


def outside(step: StepValues) -> str:
    """A parallel edge outside."""
    return (
        f"The edge is parallel to the {step.text('border')} border and outside of it: nothing of it is drawn."
    )


def kept(step: StepValues) -> str:
    """What is left."""
    start, end = step.number("t_enter"), step.number("t_leave")
    if (start, end) == (0.0, 1.0):
        return "No border has cut the edge: all of it is drawn."
    first, second = (vector_text(step.vector(name)) for name in ("kept_start", "kept_end"))
    return (
        f"From t = {spoken(start)} to {spoken(end)} the edge is inside: it is drawn from {first} to {second}."
    )


def empty(step: StepValues) -> str:
    """Nothing is left."""
    return (
        f"The edge would leave at t = {spoken(step.number('t_leave'))} before it enters at "
        f"{spoken(step.number('t_enter'))}: it misses the raster, and nothing of it is drawn."
    )


def borders_of(code: int) -> list[str]:
    """Return the borders that a point with an outcode lies outside of."""
    return [name for bit, name in enumerate(RECTANGLE_EDGES) if code >> bit & 1]


def codes(step: StepValues) -> str:
    """The outcodes of both ends."""
    told = []
    for name, point in (("code_start", "pass_start"), ("code_end", "pass_end")):
        code = step.whole(name)
        where = f"outside {joined(borders_of(code))}" if code else "inside"
        told.append(f"{vector_text(step.vector(point))} has outcode {code_text(code)} ({where})")
    return f"{edge_name(step).capitalize()}: {told[0]}, {told[1]}."


def accept(step: StepValues) -> str:
    """Both ends inside."""
    first, second = (vector_text(step.vector(name)) for name in ("kept_start", "kept_end"))
    return f"Both outcodes are 0000: the edge is drawn from {first} to {second}."


def reject(step: StepValues) -> str:
    """Both ends outside one border."""
    shared = step.whole("code_start") & step.whole("code_end")
    return (
        f"Both outcodes have {code_text(shared)} in common: the edge lies outside {joined(borders_of(shared))}, "
        "and nothing of it is drawn."
    )


def chosen_edge(step: StepValues) -> str:
    """The border that is cut at."""
    end = ("first", "second")[step.whole("moved_end")]
    return f"The {end} end is outside, and {step.text('border')} is the first border that its outcode names."


def move(step: StepValues) -> str:
    """The new end."""
    end = ("first", "second")[step.whole("moved_end")]
    point = vector_text(step.vector("moved_to"))
    return f"The {end} end moves to {point}, where the edge crosses the {step.text('border')} border."


_EDGE: Mapping[str, Callable[[StepValues], str]] = {"room": room, "crossing": crossing, "narrow": narrow}
_KINDS: Mapping[str, Mapping[str, Callable[[StepValues], str]]] = {
    "clip-enter": _EDGE,
    "clip-leave": _EDGE,
    "clip-parallel": {"room": room, "side": side},
    "clip-outside": {"room": room, "drop": outside},
    "clip-kept": {"ends": kept},
    "clip-empty": {"drop": empty},
    "outcodes-accept": {"codes": codes, "ends": accept},
    "outcodes-reject": {"codes": codes, "drop": reject},
    "outcodes-cut": {"codes": codes, "edge": chosen_edge, "move": move},
}
SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    f"raster.{kind}.{name}": say for kind, of_kind in _KINDS.items() for name, say in of_kind.items()
}
