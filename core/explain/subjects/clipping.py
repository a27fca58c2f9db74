"""Clipping triangles: edges against planes, new corners in either order, and division before clipping."""

from core.explain.digits import spoken, vector_text
from core.explain.formulas import below, concludes, formula_of, named
from core.explain.records import Asked, Formula, choice
from core.explain.rows import Said, explains
from core.explain.step_values import AXES, StepValues
from core.explain.variable_text import VariableText, given, hides, shows

PLANE_SIGNS = {
    "near": ("z", 1),
    "far": ("z", -1),
    "left": ("x", 1),
    "right": ("x", -1),
    "bottom": ("y", 1),
    "top": ("y", -1),
}
"""Clip planes: the signed distance is w plus or minus one coordinate."""
CASES = {"in-in": 1, "in-out": 1, "out-in": 2, "out-out": 0}
"""Where the ends of an edge lie, to the number of corners it contributes."""


def corner_count(step: StepValues) -> Asked:
    """Ask how many corners an edge contributes."""
    count = CASES[step.kind]
    text = f"How many corners does this edge contribute at the {step.text('plane')} plane?"
    return choice(text, count, f"the edge is {step.kind.replace('-', ' to ')}: {count}.", ("0", "1", "2"))


def _side(distance: float) -> str:
    return f"{'inside' if distance >= 0 else 'outside'} (distance {spoken(distance)})"


@explains(f"clip.{'|'.join(CASES)}.distances", asks=corner_count, decides=True)
def distances(step: StepValues) -> Said:
    """Signed distances of both ends of an edge from the plane."""
    axis, sign = PLANE_SIGNS[step.text("plane")]
    ends = {name: (step.number(f"{name}_distance"), step.vector(name)) for name in ("start", "end")}
    place, start, end = AXES.index(axis), ends["start"][0], ends["end"][0]
    edge = "" if step.nouns.edge != "edge" else f", edge {step.whole('edge')}"
    text = (
        f"{step.name.capitalize()}, {step.text('plane')} plane (w {'+' if sign > 0 else '−'} {axis} = 0){edge}: "
        f"its start is {_side(start)}, its end is {_side(end)}."
    )
    made = []
    for name, (value, at) in ends.items():
        w, coordinate = named(below("w", name), at[3]), named(below(axis, name), at[place])
        made.append(named(below("d", name), value).equals(w + coordinate if sign > 0 else w - coordinate))
    return text, formula_of(*made)


@explains("clip.in-in.keep")
def both_inside(step: StepValues) -> Said:
    """An edge that stays."""
    return f"Both ends are inside the {step.text('plane')} plane, so the end is kept."


@explains("clip.out-out.drop")
def both_outside(step: StepValues) -> Said:
    """An edge that goes."""
    return f"Both ends are outside the {step.text('plane')} plane, so neither is kept."


def _crossing(step: StepValues, names: tuple[str, str], ends: tuple[str, str]) -> Formula:
    first, second = (
        step.named(f"{end}_distance", below("d", name)) for name, end in zip(names, ends, strict=True)
    )
    return formula_of(step.named("t", "t").equals(first / (first - second)))


def _corner(step: StepValues, names: tuple[str, str], ends: tuple[str, str]) -> Formula:
    """The new corner, in the component that changes most."""
    first, second = (step.vector(end) for end in ends)
    place = max(range(4), key=lambda k: abs(second[k] - first[k]))
    axis, value = AXES[place], step.vector("corner")[place]
    start, end = (
        named(below(axis, name), at[place]) for name, at in zip(names, (first, second), strict=True)
    )
    return formula_of(named(axis, value).equals(start + step.named("t", "t") * (end - start)))


def _inner_and_outer(step: StepValues) -> tuple[str, str]:
    return ("start", "end") if step.kind == "in-out" else ("end", "start")


@explains("clip.in-out|out-in.t")
def crossing(step: StepValues) -> Said:
    """Where an edge crosses the plane, from its inside end."""
    inner, outer = _inner_and_outer(step)
    d_in, d_out = (step.number(f"{name}_distance") for name in (inner, outer))
    text = (
        f"The {step.nouns.edge} {'leaves' if step.kind == 'in-out' else 'enters'} through the "
        f"{step.text('plane')} plane at t = {spoken(step.number('t'))} from its inside end, the {inner}: that end "
        f"is {spoken(d_in)} inside, and the two ends are {spoken(d_in - d_out)} apart."
    )
    return text, _crossing(step, ("in", "out"), (inner, outer))


@explains("clip.in-out|out-in.corner")
def new_corner(step: StepValues) -> Said:
    """The corner made where an edge crosses the plane."""
    rest = "dropped" if step.kind == "in-out" else "kept after it"
    end = "outside" if step.kind == "in-out" else "inside"
    text = f"A new {step.nouns.corner} {vector_text(step.vector('corner'))} is added, and the {end} end is {rest}."
    return text, _corner(step, ("in", "out"), _inner_and_outer(step))


@explains("clip.in-out|out-in.t-in-order")
def crossing_in_order(step: StepValues) -> Said:
    """Where an edge crosses the plane, from its start."""
    start, end = step.number("start_distance"), step.number("end_distance")
    text = (
        f"The edge {'leaves' if step.kind == 'in-out' else 'enters'} through the {step.text('plane')} plane at "
        f"t = {spoken(step.number('t'))} from its start: the distances of its ends are {spoken(start)} and "
        f"{spoken(end)}."
    )
    return text, _crossing(step, ("start", "end"), ("start", "end"))


@explains("clip.in-out|out-in.corner-in-order")
def corner_in_order(step: StepValues) -> Said:
    """The new corner, computed from the edge's start."""
    rest = "the outside end is dropped" if step.kind == "in-out" else "the inside end is kept after it"
    corner = vector_text(step.vector("corner"))
    text = f"A new corner {corner}, computed from the start of the edge, is added, and {rest}."
    return text, _corner(step, ("start", "end"), ("start", "end"))


@explains("clip.untouched.keep")
def untouched(step: StepValues) -> Said:
    """A triangle that crosses no plane, or is not clipped."""
    return f"{step.name.capitalize()} is unchanged: no plane clips it."


@explains("clip.divided|mirrored.divide")
def divided(step: StepValues) -> Said:
    """A corner divided by its w."""
    clip, ndc = step.vector("clip"), step.vector("ndc")
    text = (
        f"Triangle {step.triangle}, corner {step.whole('number')}: x, y and z over w = {spoken(clip[3])} are "
        f"{vector_text(ndc)}."
    )
    w = named("w", clip[3])
    quotients = (
        named(below(axis, "ndc"), value).equals(named(axis, above) / w)
        for axis, value, above in zip(AXES, ndc, clip, strict=False)
    )
    return text, formula_of(*quotients)


@explains("clip.mirrored.sign")
def mirrored(step: StepValues) -> Said:
    """A corner behind the eye that now looks like one in front of it."""
    w = named("w", step.vector("clip")[3])
    text = (
        f"Triangle {step.triangle}, corner {step.whole('number')} is behind the eye (w = {w}), so "
        "the division has mirrored it: its NDC "
        "position no longer shows this, and the edges to it run the wrong way around."
    )
    return text, formula_of(concludes("in front", "mirrored", w.compared(">")))


@explains("clip.undefined.drop")
def undefined(step: StepValues) -> Said:
    """A triangle that cannot be divided."""
    w = named("w", step.vector("clip")[3])
    text = (
        f"Triangle {step.triangle}, corner {step.whole('number')} has w = {w}: it cannot be "
        "divided by w, and the triangle is dropped."
    )
    return text, formula_of(concludes("divide", "drop the triangle", w.compared(r"\ne")))


shows(
    "clip",
    {
        "plane": VariableText("plane", "Plane that is clipped against."),
        "edge": given("edge", "Number of the edge in the polygon before this plane."),
        "number": given("number", "Number of the corner that is divided."),
        "clip": given("x, y, z, w", "Clip position of the corner."),
        "ndc": VariableText("x/w, y/w, z/w", "The corner divided by its w."),
        "start": VariableText("start", "Position of the edge's start."),
        "end": VariableText("end", "Position of the edge's end."),
        "start_distance": VariableText("d start", "Signed distance of the start: 0 or more is inside."),
        "end_distance": VariableText("d end", "Signed distance of the end: 0 or more is inside."),
        "t": VariableText(
            "t", "Position of the new corner along the edge, 0 at the end it is computed from."
        ),
        "corner": VariableText("new corner", "Position where the edge crosses the plane."),
    },
)
hides("clip.untouched", ("edge", "number", "clip"))
hides(f"clip.{'|'.join(CASES)}", ("number", "clip"))
hides("clip.divided|mirrored|undefined", ("edge",))
