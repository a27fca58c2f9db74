"""Culling of objects, told box by box and plane by plane."""

from core.culling.told import by_axes
from core.explain.formulas import concludes, formula_of, named
from core.explain.number_text import vector_text
from core.explain.records import Asked, choice
from core.explain.step_tables import FilledColumn, filled_table, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.arrays import Integers
from core.records.steps import StepTable
from core.records.words import counted
from core.trace.stage_trace import StageTrace


def _box(step: StepValues) -> str:
    return f"Node {step.whole('node')}"


def _held(step: StepValues) -> str:
    return counted(step.whole("object_count"), step.nouns.one, step.nouns.many)


def _distance(step: StepValues, which: str, corner: str, symbol: str) -> Said:
    value, point, equation = step.named(which, "d"), step.vector(corner), step.vector("plane_equation")
    text = f"{_box(step)}: {symbol} lies at the signed distance {value} from the {step.text('plane')} plane."
    stated = value.equals(by_axes("n", equation[:3], symbol, point) + named("c", equation[3]))
    return text, formula_of(stated)


@explains("cull.box-outside|box-plane.p")
def farthest(step: StepValues) -> Said:
    """The corner that could be inside if any is."""
    point, plane = vector_text(step.vector("p_corner")), step.text("plane")
    return f"{_box(step)}, {plane} plane: p = {point} is the corner of its box farthest along the plane's normal."


@explains("cull.box-outside|box-plane.far")
def far(step: StepValues) -> Said:
    """The distance of that corner."""
    return _distance(step, "far", "p_corner", "p")


def is_outside(step: StepValues) -> Asked | None:
    """Ask whether a box lies outside of a plane."""
    outside = step.kind == "box-outside"
    plane = step.text("plane")
    where = "outside" if outside else "not outside"
    reveal = f"Its corner farthest along the normal lies {where} the {plane} plane."
    return choice(
        f"Is the box of node {step.whole('node')} wholly outside the {plane} plane?", int(not outside), reveal
    )


@explains("cull.box-outside.outside", asks=is_outside, decides=True)
def outside(step: StepValues) -> Said:
    """A box outside one plane."""
    value, slack = step.named("far", "d"), step.number("slack")
    text = (
        f"{_box(step)} is dropped, with all that is in it: even the corner farthest along the normal of the "
        f"{step.text('plane')} plane is outside, and no other plane is asked."
    )
    return text, formula_of(concludes("dropped", "dropped", value.compared("<", named("-s", -slack))))


@explains("cull.box-plane.not-outside", asks=is_outside, decides=True)
def not_outside(step: StepValues) -> Said:
    """A box that this plane does not drop."""
    value, slack = step.named("far", "d"), step.number("slack")
    text = f"{_box(step)} is not wholly outside the {step.text('plane')} plane: p is inside."
    if value.value < 0:
        text = f"{_box(step)} is kept at the {step.text('plane')} plane: p is outside by less than rounding may be."
    return text, formula_of(concludes("dropped", "kept", value.compared("<", named("-s", -slack))))


@explains("cull.box-plane.n")
def nearest(step: StepValues) -> Said:
    """The corner that is outside if any is."""
    point, plane = vector_text(step.vector("n_corner")), step.text("plane")
    return f"{_box(step)}, {plane} plane: q = {point} is the corner of its box farthest against the plane's normal."


@explains("cull.box-plane.near")
def near(step: StepValues) -> Said:
    """The distance of that corner."""
    return _distance(step, "near", "n_corner", "q")


@explains("cull.box-plane.crosses")
def crosses(step: StepValues) -> Said:
    """Whether what lies in the box has to ask this plane, too."""
    value, plane = step.named("near", "d"), step.text("plane")
    text = f"{_box(step)} is wholly inside the {plane} plane: what lies in it need not ask this plane."
    if step.flag("is_crossed"):
        text = f"{_box(step)} is not wholly inside the {plane} plane: what lies in it has to ask this plane, too."
    return text, formula_of(
        concludes("crosses", "crosses" if step.flag("is_crossed") else "inside", value.compared("<"))
    )


@explains("cull.box-verdict.verdict")
def verdict(step: StepValues) -> Said:
    """What no plane drops: taken whole, or asked further."""
    if step.text("box_verdict") == "inside":
        return f"{_box(step)} is inside all planes: it is taken whole, with {_held(step)}, and no box in it is asked."
    if step.flag("is_node_leaf"):
        return (
            f"{_box(step)} is kept, as it is outside no plane: its {_held(step)} go on to tests of their own."
        )
    return f"{_box(step)} is outside no plane, and inside not all: the boxes in it are asked next."


@explains("cull.with-its-box.drop")
def drop(step: StepValues) -> Said:
    """A triangle that is dropped before its own tests."""
    return (
        f"{step.name.capitalize()} is dropped without a test of its own: node {step.whole('node')}, which lists it, "
        f"lies outside the {step.text('plane')} plane."
    )


shows(
    "cull",
    {
        "plane_equation": VariableText(
            "n, c", "Plane in world space: distance of x, y, z is the product with n, plus c."
        ),
        "p_corner": VariableText("p", "Corner of the box farthest along the plane's normal."),
        "far": VariableText("d(p)", "Signed distance of p: below 0, the whole box is outside."),
        "slack": VariableText("s", "By how much rounding may change a distance."),
        "n_corner": VariableText("q", "Corner of the box farthest against the plane's normal."),
        "near": VariableText("d(q)", "Signed distance of q: 0 or more, the whole box is inside."),
        "is_crossed": VariableText("crosses", "Whether q is outside."),
        "box_verdict": VariableText("box", "Outside a plane, inside all of them, or crossing one."),
    },
)


def _side(step: StepValues) -> str:
    if step.kind == "box-outside":
        return "outside: dropped"
    return "crosses" if step.flag("is_crossed") else "inside"


_COLUMNS = (
    FilledColumn(
        "d(p)", "Distance of the corner farthest along the normal.", lambda step: step.number("far"), "far"
    ),
    FilledColumn(
        "d(q)", "Distance of the corner farthest against it.", lambda step: step.number("near"), "near"
    ),
    FilledColumn("verdict", "Where the box lies against the plane.", _side),
)


@tabulates("cull", ("box-outside", "box-plane", "box-verdict"))
def planes_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the planes that one box is asked by, rows (R,) of a trace."""
    tests = rows[[trace.kind_of(row) != "box-verdict" for row in rows.tolist()]]
    node = int(trace.columns["node"][rows[0]])
    labels = [str(trace.columns["plane"][row]) for row in tests.tolist()]
    title, objects = f"Node {node}, plane by plane", trace.extra["culled"].objects
    leaves = counted(int(objects.tree.is_leaf.sum()), "leaf", "leaves")
    note = (
        f"Boxes were tested against planes {counted(len(objects.plane), 'time')}; without the tree, {leaves} "
        f"one by one, {counted(objects.one_by_one_count, 'time')}."
    )
    is_last = int(trace.columns["visit"][rows[0]]) == len(objects.visited) - 1
    closing = int(rows[-1])
    return filled_table(
        trace,
        tests,
        position,
        title,
        "Plane",
        labels,
        _COLUMNS,
        closing=closing,
        note=note if is_last else "",
        grows=True,
    )
