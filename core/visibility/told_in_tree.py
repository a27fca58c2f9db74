"""Rays in a tree of boxes, told step by step: three slabs, a jump or a leaf."""

from math import isfinite

from core.explain.formulas import call, concludes, formula_of, named
from core.explain.number_text import spoken
from core.explain.records import Asked, choice
from core.explain.step_tables import FilledColumn, filled_table, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.arrays import Integers
from core.records.steps import StepTable
from core.records.words import counted
from core.trace.stage_trace import StageTrace

BOXES = "tree-missed|tree-behind|tree-node|tree-leaf"


def _box(step: StepValues) -> str:
    return f"{step.pixel_name}, node {step.whole('node')}"


def _held(step: StepValues) -> str:
    return counted(step.whole("object_count"), step.nouns.one, step.nouns.many)


@explains(f"depth.{BOXES}.slab-x|slab-y|slab-z")
def slab(step: StepValues) -> Said:
    """One slab, and what is left of the way."""
    axis = step.operation[-1]
    near, far = step.number(f"near_{axis}"), step.number(f"far_{axis}")
    enter, leave = step.number(f"enter_{axis}"), step.number(f"leave_{axis}")
    way = f"the ray is between the planes of the box in {axis} from t = {spoken(near)} to {spoken(far)}"
    if not isfinite(near) and not isfinite(far) and near < far:
        way = f"the ray runs along the planes of the box in {axis}, and between them or on one"
    text = f"{_box(step)}: {way}, which leaves enter = {spoken(enter)} and leave = {spoken(leave)}."
    earlier = {"x": None, "y": "enter_x", "z": "enter_y"}[axis]
    if earlier is None or not all(map(isfinite, (near, enter, step.number(earlier)))):
        return text
    stated = named("enter", enter).equals(
        call("max", named("enter", step.number(earlier)), named(f"t_{axis}", near))
    )
    return text, formula_of(stated)


def is_opened(step: StepValues) -> Asked | None:
    """Ask whether a box is opened."""
    opened = step.flag("is_opened")
    enter, leave = spoken(step.number("enter_z")), spoken(step.number("leave_z"))
    reveal = f"It enters at {enter} and leaves at {leave}"
    if step.kind == "tree-behind":
        reveal += ", but no hit in it is nearer than the nearest so far"
    return choice(f"Does the ray open the box of node {step.whole('node')}?", int(not opened), f"{reveal}.")


@explains("depth.tree-missed.miss", asks=is_opened, decides=True)
@explains("depth.tree-behind|tree-node|tree-leaf.meet")
def missed_or_met(step: StepValues) -> Said:
    """A box that the ray passes by, or goes through."""
    enter, leave = step.named("enter_z", "enter"), step.named("leave_z", "leave")
    text, verdict = f"{_box(step)}: the ray meets the box, from t = {enter} to {leave}.", "met"
    if step.operation == "miss":
        text = (
            f"{_box(step)}: the ray misses the box, as it would leave at {leave} before it enters at {enter}."
        )
        verdict = "missed"
    if not isfinite(enter.value) or not isfinite(leave.value):
        return text
    return text, formula_of(concludes("missed", verdict, leave.compared("<", enter)))


@explains("depth.tree-missed|tree-behind.jump")
def jump(step: StepValues) -> Said:
    """Past the subtree, by its end."""
    after, count = step.whole("next_node"), step.whole("node_count")
    where = f"to node {after}" if after < count else "and this is the end of the walk"
    skipped = after - step.whole("node") - 1
    inside = f"{counted(skipped, 'box', 'boxes')} inside and " if skipped else ""
    return f"{_box(step)}: the ray jumps past it, {inside}{_held(step)}, {where}."


@explains("depth.tree-behind.behind", asks=is_opened, decides=True)
def behind(step: StepValues) -> Said:
    """A box that begins behind the nearest hit."""
    most, nearest = step.number("most_nearness"), step.named_primitive(step.whole("nearest"))
    measure = "1/w" if step.flag("by_w") else "−z/w"
    value = step.number("nearest_nearness")
    text = (
        f"{_box(step)}: the box begins behind {nearest}, whose {measure} is {spoken(value)}: no hit in it can have "
        f"more than {spoken(most)}."
    )
    stated = named(r"v_{\mathrm{most}}", most).compared("<", named("v", value))
    return text, formula_of(concludes("behind", "behind", stated))


@explains("depth.tree-node.open", asks=is_opened, decides=True)
def opened(step: StepValues) -> Said:
    """A box whose parts are asked."""
    return f"{_box(step)}: the box is opened, and the boxes in it are asked."


@explains("depth.tree-node.next")
def following(step: StepValues) -> Said:
    """The first box inside is the next in pre-order."""
    return f"{_box(step)}: the first box in it has the next number, {step.whole('next_node')}."


@explains("depth.tree-leaf.leaf", asks=is_opened, decides=True)
def leaf(step: StepValues) -> Said:
    """A box whose triangles are asked."""
    return f"{_box(step)}: the box is a leaf, and the ray is tested against what it holds: {_held(step)}."


@explains("depth.tree-hidden.hide")
def hidden(step: StepValues) -> Said:
    """A triangle that covers the pixel and is never asked."""
    node = step.whole("node")
    where = f"node {node} was not opened" if node >= 0 else "another part of it was"
    return f"{step.pixel_name}: {step.name} covers it, but the ray does not ask it, as {where}."


_OF_AXES = {
    f"{name}_{axis}": VariableText(label.replace("?", axis), meaning.replace("?", axis))
    for axis in "xyz"
    for name, label, meaning in (
        ("near", "t0 ?", "Where the ray comes between the planes of the box in ?."),
        ("far", "t1 ?", "Where it leaves these."),
        ("enter", "enter", "Where the ray is between all planes so far."),
        ("leave", "leave", "Where it is so no longer."),
    )
}
shows(
    "depth",
    {
        "node": VariableText("node", "Number of the box, in pre-order."),
        **_OF_AXES,
        "object_count": VariableText("listed", "How many {many} the box and those in it list."),
        "most_nearness": VariableText("most", "How near a hit in the box can be at most: larger is nearer."),
        "next_node": VariableText("next", "The box that the ray asks next."),
    },
)
shows(
    "depth.tree-behind",
    {
        "nearest": VariableText(
            "nearest", "Number of the nearest triangle on the ray so far.", "nearest_nearness"
        )
    },
)


def _verdict(step: StepValues) -> str:
    after, count = step.whole("next_node"), step.whole("node_count")
    to = f"to {after}" if after < count else "to the end"
    jumps = {"tree-missed": f"missed: {to}", "tree-behind": f"behind: {to}", "tree-node": "opened"}
    return jumps.get(step.kind, "leaf")


_COLUMNS = (
    FilledColumn(
        "enter", "Where the ray is between all planes.", lambda step: step.number("enter_z"), "enter_z"
    ),
    FilledColumn("leave", "Where it is so no longer.", lambda step: step.number("leave_z"), "leave_z"),
    FilledColumn(
        "listed", "How many {many} the box and those in it list.", lambda step: step.whole("object_count")
    ),
    FilledColumn("verdict", "Opened; or jumped over, to which node.", _verdict),
)


@tabulates("depth", BOXES.split("|"))
def walk_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the boxes that one ray has asked so far, rows (R,) of a trace."""
    column, row = trace.pixel[rows[0]].tolist()
    nodes, depth = trace.columns["node"][rows].tolist(), trace.columns["node_depth"][rows].tolist()
    labels = [f"{'· ' * deep}{node}" for node, deep in zip(nodes, depth, strict=True)]
    opened = int(trace.columns["is_opened"][rows].sum())
    note = f"{counted(len(rows), 'box', 'boxes')} asked, {opened:,} opened."
    title = f"Boxes on the ray of pixel ({column}, {row})"
    return filled_table(trace, rows, position, title, "Node", labels, _COLUMNS, note=note, grows=True)
