"""Occlusion culling, told: which boxes are drawn first, the pyramid over their depth, and every box against it."""

import numpy as np

from core.explain.formulas import below, concludes, formula_of, named, upright
from core.explain.number_text import pair_text, spoken
from core.explain.records import Asked, choice
from core.explain.step_tables import FilledColumn, filled_table, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.records.arrays import Integers
from core.records.steps import StepTable
from core.records.words import counted, joined, noun_of
from core.trace.stage_trace import StageTrace

MOST_ROWS = 24
"""Occluders in a table: the first of more."""


def _node(step: StepValues) -> str:
    return f"Node {step.whole('node')}"


def _extent(step: StepValues) -> str:
    left, bottom, right, top = (int(value) for value in step.vector("box_rectangle"))
    return f"columns {left} to {right} and rows {bottom} to {top}"


def _held(step: StepValues) -> str:
    return counted(step.whole("object_count"), step.nouns.one, step.nouns.many)


@explains("cull.occluder.pixels")
def pixels(step: StepValues) -> Said:
    """How many pixels the rectangle of an occluder has."""
    left, bottom, right, top = step.vector("box_rectangle")
    across, up = (
        named(end, high) - named(start, low) + 1
        for start, low, end, high in (("l", left, "r", right), ("b", bottom, "t", top))
    )
    count = named(upright("area"), step.whole("box_pixels"))
    text = f"{_node(step)}: on screen its box reaches {_extent(step)}, {step.whole('box_pixels'):,} pixels."
    return text, formula_of(count.equals(across * up))


@explains("cull.occluder.chosen")
def chosen(step: StepValues) -> Said:
    """Why it is an occluder."""
    rank, count = step.whole("occluder_rank"), step.whole("occluder_count")
    boxes = counted(step.whole("box_count"), "box", "boxes")
    before = "none" if rank == 0 else f"none but {counted(rank, 'occluder')} before it"
    return (
        f"{_node(step)} is occluder {rank + 1} of {count}, as what is large on screen can hide most: of {boxes} with a "
        f"rectangle on screen, {before} reaches more pixels."
    )


@explains("cull.no-occluder.none")
def no_occluder(step: StepValues) -> Said:
    """Why nothing is drawn first."""
    why = step.text("why_none")
    return f"There is no occluder, so no box is dropped as hidden: {why[0].lower()}{why[1:]}"


def _size(step: StepValues) -> str:
    width, height = step.vector("level_size")
    return f"{width:.0f} × {height:.0f} texel{'s' if width * height > 1 else ''}"


@explains("cull.pyramid-bottom.drawn")
def bottom_level(step: StepValues) -> Said:
    """The depth of the occluders."""
    count = step.whole("occluder_count")
    leave = f"{counted(count, 'occluder')} {noun_of(count, 'leaves', 'leave')}"
    return f"Level 0 of the pyramid is the depth that {leave}, drawn as a pass of its own: {_size(step)}, one a pixel."


@explains("cull.pyramid-level.level")
def coarser(step: StepValues) -> Said:
    """One level, and what its texels keep."""
    keeps = "the farthest depth" if step.flag("keeps_farthest") else "a depth, but not always the farthest,"
    number = step.whole("made_level")
    return (
        f"Level {number} has {_size(step)}: each keeps {keeps} of up to 2 × 2 texels of level {number - 1}."
    )


@explains("cull.near-box.near-plane")
def near_plane(step: StepValues) -> Said:
    """A box without a rectangle."""
    return (
        f"{_node(step)} is kept, with {_held(step)}: its box does not lie wholly behind the near plane, so it has no "
        "rectangle on screen."
    )


@explains("cull.seen-box|hidden-box.rectangle")
def rectangle(step: StepValues) -> Said:
    """The pixels that a box reaches."""
    return f"{_node(step)}: wherever snapping moves its corners, its box reaches no pixels outside {_extent(step)}."


@explains("cull.seen-box|hidden-box.nearest")
def nearest(step: StepValues) -> Said:
    """The nearest depth that a fragment in the box may have."""
    depth, slack, found = step.named("box_depth", "d"), step.number("depth_slack"), step.number("box_nearest")
    if not slack:
        text = f"{_node(step)}: no fragment in its box is nearer than the nearest of its corners, at the depth {depth}."
        return text, formula_of(named(below("d", "near"), found).equals(depth))
    text = (
        f"{_node(step)}: the nearest of its corners has the depth {depth}, and snapping and rounding may bring a "
        f"fragment nearer by {spoken(abs(slack))}, to {spoken(found)}."
    )
    return text, formula_of(named(below("d", "near"), found).equals(depth - named("s", slack)))


@explains("cull.seen-box|hidden-box.pyramid-level")
def level(step: StepValues) -> Said:
    """The level at which the rectangle lies in at most 2 x 2 texels."""
    number, texels = step.whole("box_level"), step.rows("box_texels")
    across, up = (len({row[axis] for row in texels if row[axis] >= 0}) for axis in (0, 1))
    side = 2**number
    pixel = "one pixel" if side == 1 else f"{side} × {side} pixels"
    return (
        f"{_node(step)}: at level {number} and no lower, the rectangle lies in at most 2 × 2 texels, here {across} × "
        f"{up}, each of which stands for {pixel}."
    )


@explains("cull.seen-box|hidden-box.texels")
def texels(step: StepValues) -> Said:
    """What the texels store."""
    found = [value for value in step.vector("box_stored") if not np.isnan(value)]
    farthest = step.named("box_farthest", below("d", "far"))
    if len(found) == 1:
        return f"{_node(step)}: this texel stores {farthest}."
    listed = joined([spoken(value) for value in found])
    return f"{_node(step)}: these texels store {listed}: the farthest is {farthest}."


def is_hidden(step: StepValues) -> Asked | None:
    """Ask whether a box is hidden."""
    near, far = pair_text(step.number("box_nearest"), step.number("box_farthest"))
    nearer, hidden = "larger" if step.flag("larger_is_nearer") else "smaller", step.flag("is_hidden")
    return choice(
        f"Nothing in the box of node {step.whole('node')} is nearer than {near}; its texels keep {far}. A {nearer} "
        "depth is nearer. Is the box hidden?",
        0 if hidden else 1,
        f"{near} is {'farther' if hidden else 'no farther'} than {far}.",
    )


@explains("cull.seen-box|hidden-box.compare", asks=is_hidden, decides=True)
def compare(step: StepValues) -> Said:
    """Whether the box is farther than all that the occluders leave in its rectangle."""
    near, far = step.number("box_nearest"), step.number("box_farthest")
    mine, there = pair_text(near, far)
    if step.flag("is_hidden"):
        text = (
            f"{_node(step)} is hidden, with {_held(step)}: even its nearest depth, {mine}, is farther than {there}, "
            "the farthest of its texels."
        )
    else:
        text = (
            f"{_node(step)} is kept, with {_held(step)}: its nearest depth, {mine}, is no farther than {there}, the "
            "farthest of its texels."
        )
    sides = named(below("d", "near"), near), named(below("d", "far"), far)
    relation = "<" if step.flag("larger_is_nearer") else ">"
    verdict = "hidden" if step.flag("is_hidden") else "kept"
    return text, formula_of(concludes("hidden", verdict, sides[0].compared(relation, sides[1])))


@explains("cull.behind-occluders.drop")
def drop(step: StepValues) -> Said:
    """A triangle that is dropped before its own tests."""
    return (
        f"{step.name.capitalize()} is dropped without a test of its own: node {step.whole('node')}, which lists it, is "
        "hidden behind the occluders."
    )


shows(
    "cull",
    {
        "box_rectangle": VariableText(
            "rectangle", "First column and row, last column and row that a box reaches."
        ),
        "box_pixels": VariableText("area", "Pixels of this rectangle."),
        "box_window": VariableText(
            "reach", "Least x and y, greatest x and y of the corners in pixels, with what snapping may add."
        ),
        "made_level": VariableText("level", "Number of the level that is made."),
        "level_size": VariableText("size", "Columns and rows of the level."),
        "box_depth": VariableText("d", "What the depth buffer would store of the nearest corner."),
        "depth_slack": VariableText("s", "By how much snapping and rounding may bring a fragment nearer."),
        "box_nearest": VariableText("d near", "Nothing in the box stores a nearer depth."),
        "box_level": VariableText("level", "Level at which the rectangle lies in at most 2 x 2 texels."),
        "box_stored": VariableText("d texel #", "Depth that the texel stores.", spread="parts"),
        "box_farthest": VariableText("d far", "The farthest of these."),
        "is_hidden": VariableText("hidden", "Whether d near is farther than d far."),
    },
)


_COLUMNS = (
    FilledColumn("rectangle", "Columns and rows that it reaches.", _extent, "box_rectangle"),
    FilledColumn("area", "Pixels of the rectangle.", lambda step: step.whole("box_pixels"), "box_pixels"),
)


@tabulates("cull", ("occluder",))
def occluders_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the occluders chosen so far, rows (R,) of a trace."""
    shown = rows[:MOST_ROWS]
    labels = [str(node) for node in trace.columns["node"][shown].tolist()]
    note = "The depth of these is drawn first, as a pass of its own."
    return filled_table(
        trace,
        shown,
        position,
        "Occluders, the largest first",
        "Node",
        labels,
        _COLUMNS,
        closing=int(rows[-1]),
        note=note,
        grows=True,
    )
