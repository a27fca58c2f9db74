"""A tree of boxes that is built, told node by node."""

import numpy as np

from core.explain.formulas import call, formula_of, named
from core.explain.number_text import spoken, vector_text
from core.explain.step_tables import FilledColumn, filled_table, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.arrays import Integers
from core.records.steps import StepTable
from core.records.words import counted
from core.trace.stage_trace import StageTrace

KINDS = "list-leaf|bvh-leaf|bvh-node|bvh-area-node|octree-leaf|octree-node"
MOST_NODES = 40
"""Nodes that a table shows: the last ones made."""


def _held(step: StepValues) -> str:
    return counted(step.whole("object_count"), step.nouns.one, step.nouns.many)


@explains("cull.list-leaf|bvh-leaf|bvh-node|bvh-area-node.bound")
def bound(step: StepValues) -> Said:
    """The box around what a node holds."""
    low, high = vector_text(step.vector("node_lower")), vector_text(step.vector("node_upper"))
    return f"Node {step.whole('node')} holds {_held(step)}: its box goes from {low} to {high}."


@explains("cull.list-leaf.leaf")
def mesh(step: StepValues) -> Said:
    """A mesh as one object."""
    return (
        f"Node {step.whole('node')} is a mesh of {_held(step)}: one object, with nothing above or inside it."
    )


@explains("cull.bvh-leaf.leaf")
def leaf(step: StepValues) -> Said:
    """Few enough objects."""
    size = step.whole("leaf_size")
    return f"Node {step.whole('node')} is a leaf: it holds {_held(step)}, and a leaf may hold {size}."


@explains("cull.bvh-node.spread")
def spread(step: StepValues) -> Said:
    """How far the centres are apart along every axis."""
    value = step.vector("spread")
    return f"Node {step.whole('node')}: the centres of its boxes spread by {vector_text(value)} along x, y and z."


@explains("cull.bvh-node.axis")
def axis(step: StepValues) -> Said:
    """The axis of the widest spread."""
    name = "xyz"[step.whole("axis")]
    widest = spoken(step.vector("spread")[step.whole("axis")])
    return f"Node {step.whole('node')} is cut along {name}: on no axis do the centres spread by more than {widest}."


@explains("cull.bvh-node|bvh-area-node.sort")
def sort(step: StepValues) -> Said:
    """The objects in the order of their centres."""
    name, order = "xyz"[step.whole("axis")], step.text("sorted_items")
    return (
        f"Node {step.whole('node')}: sorted by their centres along {name}, its {step.nouns.many} are {order}."
    )


@explains("cull.bvh-node.cut")
def cut(step: StepValues) -> Said:
    """Half of them, by number."""
    count, first = step.whole("object_count"), step.whole("cut")
    text = (
        f"Node {step.whole('node')} is cut by number: the first {first} of {count} go into one part, the other "
        f"{count - first} into the other, wherever they lie."
    )
    return text, formula_of(named("c", first).equals(call("floor", named("n", count) / 2)))


@explains("cull.bvh-area-node.place")
def place(step: StepValues) -> Said:
    """The place of the least cost."""
    count, first, cost = step.whole("object_count"), step.whole("cut"), step.number("cost")
    name = "xyz"[step.whole("axis")]
    return (
        f"Node {step.whole('node')} is cut along {name} behind the first {first} of {count}: half a surface times "
        f"number, of both parts together, is {spoken(cost)}, and no place of any axis has less."
    )


def _listed(step: StepValues) -> str:
    return f"Node {step.whole('node')}: its cell lists {_held(step)}"


@explains("cull.octree-leaf.leaf")
def cell(step: StepValues) -> Said:
    """A cell that is not cut: few enough, or too deep."""
    text, size, deep = _listed(step), step.whole("leaf_size"), step.whole("node_depth")
    why = f"and a leaf may hold {size}"
    if step.whole("object_count") > size:
        why = f"more than {size}, but it is {deep} deep, the limit"
    return f"{text}, {why}: it is a leaf."


@explains("cull.octree-node.full")
def full(step: StepValues) -> Said:
    """A cell with too many."""
    size, deep, limit = step.whole("leaf_size"), step.whole("node_depth"), step.whole("octree_depth")
    return (
        f"{_listed(step)}, more than {size}, and it is {deep} deep of {limit}: it is halved along all axes."
    )


@explains("cull.octree-node.middle")
def middle(step: StepValues) -> Said:
    """Where a cell is halved: by space, not by number."""
    value = step.vector("middle")
    low, high = step.vector("node_lower"), step.vector("node_upper")
    text = f"Node {step.whole('node')}: its middle is {vector_text(value)}, whatever lies around it."
    return text, formula_of(named("m", value).equals((named("l", low) + named("h", high)) / 2))


@explains("cull.octree-node.parts")
def parts(step: StepValues) -> Said:
    """How many objects each octant lists."""
    counts = [int(value) for value in step.vector("octant_counts")]
    listed = ", ".join(str(count) for count in counts)
    text = f"Node {step.whole('node')}: its octants list {listed} of {_held(step)}"
    if sum(counts) > step.whole("object_count"):
        text += f", {sum(counts)} in all: what touches several is listed in each of them"
    empty = counts.count(0)
    return (
        f"{text}; {counted(empty, 'octant')} {'is' if empty == 1 else 'are'} empty." if empty else f"{text}."
    )


_CORNER = {
    "node_lower": VariableText("low", "Least x, y and z of the box."),
    "node_upper": VariableText("high", "Greatest x, y and z of the box."),
}
shows(
    "cull",
    {
        "node": VariableText(
            "node", "Number of the node, in pre-order: what lies inside has the next numbers."
        ),
        "node_depth": VariableText("depth", "How many boxes it lies in."),
        **_CORNER,
        "object_count": VariableText("n", "How many {many} it holds."),
        "spread": VariableText("spread", "Extent of the centres along x, y and z."),
        "axis": VariableText("axis", "Axis along which it is cut: 0 is x, 1 is y, 2 is z."),
        "cost": VariableText("cost", "Half the surface times the number, of both parts together."),
        "sorted_items": VariableText("items", "The {many} in the order of their centres, the first of them."),
        "cut": VariableText("cut", "How many go into the first part."),
        "middle": VariableText("middle", "Middle of the cell, where it is halved."),
        "octant_counts": VariableText("parts", "How many {many} touch each octant."),
    },
)


def _part(step: StepValues) -> str:
    if step.kind.endswith("leaf"):
        return "leaf"
    if step.kind == "octree-node":
        return "8 octants"
    count, first = step.whole("object_count"), step.whole("cut")
    return f"{'xyz'[step.whole('axis')]}: {first} and {count - first}"


_COLUMNS = (
    FilledColumn("depth", "How many boxes it lies in.", lambda step: step.whole("node_depth")),
    FilledColumn("low", "Least x, y and z of its box.", lambda step: tuple(step.vector("node_lower"))),
    FilledColumn("high", "Greatest x, y and z of its box.", lambda step: tuple(step.vector("node_upper"))),
    FilledColumn("n", "How many {many} it holds.", lambda step: step.whole("object_count")),
    FilledColumn("cut", "Axis, and how many go into both parts; or a leaf.", _part),
)


@tabulates("cull", KINDS.split("|"))
def nodes_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the nodes made so far, rows (R,) of a trace: the last ones of many."""
    begun = int(np.count_nonzero(trace.steps.starts[rows] < position))
    shown = rows[max(begun - MOST_NODES, 0) : max(begun, 1)]
    labels = [
        f"{'· ' * int(trace.columns['node_depth'][row])}{int(trace.columns['node'][row])}" for row in shown
    ]
    tree = trace.extra["object_tree"].tree
    leaves = int(tree.is_leaf.sum())
    note = (
        f"{counted(len(tree), 'node')}, {counted(leaves, 'leaf', 'leaves')}, {len(tree.items):,} references, "
        f"{tree.byte_count:,} bytes."
    )
    closing = int(rows[-1])
    return filled_table(
        trace,
        shown,
        position,
        "Boxes, in pre-order",
        "Node",
        labels,
        _COLUMNS,
        closing=closing,
        note=note,
        grows=True,
    )
