"""Deformation: a vertex moved towards other shapes, taken along by its bones, or moved by a sum of dual quaternions."""

import numpy as np

from core.explain.formulas import Named, below, call, formula_of, named, total
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, number
from core.explain.step_values import AXES, Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.words import counted

ORDINALS = {"x": "first", "y": "second", "z": "third"}
QUATERNION = ("w", "x", "y", "z")


def _vertex(step: StepValues) -> str:
    """Return the number of a vertex in its triangle, and that in the scene where it differs."""
    corner, of_scene = step.whole("corner"), step.whole("vertex")
    return f"Vertex {corner} of {step.name}" + (
        f" (vertex {of_scene} of the scene)" if of_scene != corner else ""
    )


def place_after(step: StepValues) -> Asked | None:
    """Ask for x after the row."""
    after = step.vector("after")
    what = {
        "bone": f"where bone {step.whole('bone')} takes it" if step.kind == "bone" else "",
        "blend": f"once shape {step.whole('target')} is added" if step.kind == "blend" else "",
        "skin": "once all its bones are added up",
        "move": "moved by the sum of its bones",
    }[step.kind]
    return number(
        f"What is x of v{_vertex(step)[1:]}, {what}?", after[0], f"({', '.join(map(spoken, after[:3]))})."
    )


@explains("transform.blend.x|y|z", asks=place_after)
def blended(step: StepValues) -> Said:
    """A step towards another shape."""
    axis = step.operation
    k, target, weight = AXES.index(axis), step.whole("target"), step.named("weight", r"\lambda")
    before, after = (
        named(below(axis, name), step.number(f"{column}_{axis}"))
        for name, column in (("before", "before"), ("after", "after"))
    )
    rest = named(below(axis, "rest"), step.vector("rest")[k])
    shape = named(below(axis, "shape"), step.vector("shape")[k])
    text = f"{_vertex(step)}: with {weight} of the way to shape {target} its {axis} is {spoken(after.value)}."
    return text, formula_of(after.equals(before + weight * (shape - rest)))


@explains("transform.bone.x|y|z", asks=place_after)
def taken(step: StepValues) -> Said:
    """Where one bone takes the vertex."""
    axis, bone = step.operation, step.whole("bone")
    row, before = AXES.index(axis), step.vector("before")
    value = step.number(f"after_{axis}")
    products = (
        named(f"m_{{{row + 1}{k + 1}}}", step.rows("matrix")[row][k]) * named(below(of, "rest"), before[k])
        for k, of in enumerate(AXES)
    )
    text = (
        f"{_vertex(step)}: bone {bone} takes its {axis} to {spoken(value)}, the {ORDINALS[axis]} row of its pose times "
        f"inverse bind times the position at rest."
    )
    return text, formula_of(named(f"{axis}_{bone}", value).equals(total(products)))


@explains("transform.skin.x|y|z", asks=place_after)
def summed(step: StepValues) -> Said:
    """The weighted sum over the bones."""
    axis = step.operation
    k, weights = AXES.index(axis), step.vector("weights")
    moved, value = step.rows("moved"), step.number(f"after_{axis}")
    used = [joint for joint, weight in enumerate(weights) if weight > 0]
    parts = (
        named(rf"\lambda_{joint}", weights[joint]) * named(f"{axis}_{joint}", moved[joint][k])
        for joint in used
    )
    if len(used) == 1:
        text = f"{_vertex(step)} hangs on bone {used[0]} alone, so its {axis} is {spoken(value)}."
    else:
        text = f"{_vertex(step)}: by the weights of its {counted(len(used), 'bone')} its {axis} is {spoken(value)}."
    return text, formula_of(named(axis, value).equals(total(parts)))


@explains("transform.skin.normal")
def turned(step: StepValues) -> Said:
    """The normal by the cofactors of the blended matrix."""
    normal = step.vector("normal")
    rest = step.vector("rest_normal")
    (a, b, c) = np.array(step.rows("blended"))
    k = max(range(3), key=lambda i: abs(normal[i]))
    cofactors = (np.cross(b, c), np.cross(c, a), np.cross(a, b))
    sums = [float(row @ np.array(rest)) for row in cofactors]
    length = named("L", float(np.sqrt(sum(each * each for each in sums))))
    parts = total(
        [
            named(f"c_{{{k + 1}{i + 1}}}", float(cofactors[k][i])) * named(f"n_{AXES[i]}", rest[i])
            for i in range(3)
        ]
    )
    found = named(below(AXES[k], "normal"), normal[k])
    text = f"{_vertex(step)}: the cofactors of the blended matrix turn its normal to {vector_text(normal)}."
    if length.value == 0:
        return f"{_vertex(step)}: the blended matrix flattens all to a line, which leaves no normal.", None
    return text, formula_of(found.equals(parts / length))


@explains("transform.quaternion.side")
def side(step: StepValues) -> Said:
    """On which side the quaternion of a bone is added."""
    bone, sign = step.whole("bone"), step.whole("side")
    text = f"{_vertex(step)}: the turn of bone {bone} is {vector_text(step.vector('rotation'))} as a quaternion, "
    text += "on the side of that of the largest weight, so it is added."
    if sign < 0:
        text = text.replace(
            "on the side of that of the largest weight, so it is added",
            "away from that of the largest weight, so its negative, the same turn, is added",
        )
    return text, None


def _added(step: StepValues, name: str, column: str, part: str, symbol: str) -> Said:
    """Return what is said of a sum of four numbers, with the formula of the one that grows most."""
    before, own, after = (step.vector(each) for each in (column, part, name))
    k = max(range(4), key=lambda i: abs(after[i] - before[i]))
    letter, weight = QUATERNION[k], step.named("weight", r"\lambda")
    new, old = named(f"{letter}_{{\\mathrm{{new}}}}", after[k]), named(letter, before[k])
    signed = named(symbol + f"_{letter}", own[k])
    value = old + weight * signed if step.whole("side") > 0 else old - weight * signed
    kind = "turns" if part == "rotation" else "moves"
    text = f"{_vertex(step)}: the sum of its {kind} is now {vector_text(after)}."
    return text, formula_of(new.equals(value))


@explains("transform.quaternion.real")
def real(step: StepValues) -> Said:
    """The real part is added."""
    return _added(step, "sum_real", "real_before", "rotation", "q")


@explains("transform.quaternion.dual")
def dual(step: StepValues) -> Said:
    """The dual part is added."""
    return _added(step, "sum_dual", "dual_before", "dual", "d")


@explains("transform.move.length")
def length(step: StepValues) -> Said:
    """How long the sum is."""
    found, parts = step.named("length", "L"), step.vector("sum_real")
    squares: list[Named] = [named(letter, value) for letter, value in zip(QUATERNION, parts, strict=True)]
    text = f"{_vertex(step)}: the sum of its turns has the length {found}, by which both sums are divided."
    return text, formula_of(found.equals(call("sqrt", total([each**2 for each in squares]))))


@explains("transform.move.unit")
def unit_of(step: StepValues) -> Said:
    """The sums at length 1."""
    turn, move = (vector_text(step.vector(name)) for name in ("unit_real", "unit_dual"))
    return f"{_vertex(step)}: divided by it, the turn is {turn}, and the move {move}.", None


@explains("transform.move.turn")
def turned_by(step: StepValues) -> Said:
    """The position, turned."""
    return (
        f"{_vertex(step)}: turned about the origin its position is {vector_text(step.vector('turned'))}.",
        None,
    )


@explains("transform.move.move", asks=place_after)
def moved_to(step: StepValues) -> Said:
    """The position, moved."""
    return (
        f"{_vertex(step)}: turned and then moved, it comes to {vector_text(step.vector('after')[:3])}.",
        None,
    )


shows(
    "transform",
    {
        "target": VariableText("shape", "Number of the shape that is added."),
        "bone": VariableText("bone", "Number of the bone."),
        "bones": VariableText("bones", "How many bones the vertex hangs on."),
        "weight": VariableText("λ", "How much of the shape, or of the bone, counts."),
        "normal": VariableText("normal", "The vertex's normal after deformation, in object space."),
        "side": VariableText("side", "1: the quaternion is added; −1: its negative is, the same turn."),
        "rotation": VariableText("q", "The bone's turn as a unit quaternion: w, x, y, z."),
        "dual": VariableText("d", "The bone's move, the dual part of its quaternion."),
        "sum_real": VariableText("sum of q", "Sum of the turns so far."),
        "sum_dual": VariableText("sum of d", "Sum of the moves so far."),
        "length": VariableText("L", "Length of the sum of turns."),
        "unit_real": VariableText("q (unit)", "The sum of turns at length 1."),
        "unit_dual": VariableText("d (unit)", "The sum of moves, divided by the same length."),
        "turned": VariableText("turned", "The position at rest, turned about the origin of object space."),
    },
)
