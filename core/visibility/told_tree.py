"""The BSP tree, told step by step: planes, sides and cuts, the walk from back to front, and the tree as a table."""

import numpy as np

from core.explain.formulas import below, formula_of, named, slash, total
from core.explain.number_text import vector_text
from core.explain.records import Asked, choice
from core.explain.step_tables import NONE, cell_texts, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, hides, shows
from core.records.arrays import Integers
from core.records.steps import Level, StepTable, TableCell, TableColumn
from core.records.words import counted, nouns, piece_name
from core.trace.stage_trace import StageTrace
from core.visibility.bsp import BspTree
from core.visibility.traced_order import TREE_OPERATIONS

_TESTED = "on|front|back|cut"
_SIDES = ("In the plane", "On its front side", "On its back side", "On both sides")

shows(
    "depth.flat|root|on|front|back|cut|walk",
    {
        "plane": VariableText(
            "plane #", "a, b, c and d of the plane a x + b y + c z + d w = 0.", spread="parts"
        )
    },
)
hides(f"depth.{'|'.join(TREE_OPERATIONS)}", ("column", "row"))
shows(
    "depth",
    {
        "distances": VariableText(
            "distance d#",
            "Distance of each corner from the plane, positive on its front side.",
            spread="parts",
        ),
        "cut_t": VariableText("t", "Where a side meets the plane, from its end on the front side."),
        "corner": VariableText("new corner", "x, y, z and w where a side crosses the plane."),
        "made_front": VariableText("front", "Pieces that the cut makes on the front side.", "corner"),
        "made_back": VariableText("back", "Pieces that the cut makes on the back side.", "corner"),
        "eye": VariableText("d eye", "Distance of the eye (0, 0, −1, 0) from the plane."),
    },
)


def _piece(step: StepValues) -> str:
    return piece_name(step.nouns.one, step.triangle, step.whole("piece_number"))


def _plane(step: StepValues) -> str:
    return (
        f"the plane of {piece_name(step.nouns.one, step.whole('root_triangle'), step.whole('root_number'))}"
    )


@explains("depth.flat.first")
def flat(step: StepValues) -> Said:
    """A triangle without a plane."""
    text = f"{step.name.capitalize()} has no area, to rounding, and so no plane: it is drawn first and cuts nothing."
    return text, formula_of(named(below("(a, b, c, d)", "plane"), step.vector("plane")))


@explains("depth.root.plane")
def root(step: StepValues) -> Said:
    """A node gets its plane."""
    where = "is the root of the tree"
    if step.whole("parent") >= 0:
        where = f"is the first of the {'back' if step.whole('half') else 'front'} half of the node above it"
    tested = step.whole("tested")
    text = (
        f"{_piece(step).capitalize()} {where}: its plane sorts {counted(tested, 'other piece')}."
        if tested
        else f"{_piece(step).capitalize()} {where}, alone in it: nothing is tested against its plane."
    )
    return text, formula_of(named(below("(a, b, c, d)", "plane"), step.vector("plane")))


def side_asked(step: StepValues) -> Asked:
    """Ask where a piece lies."""
    place = ("on", "front", "back", "cut").index(step.kind)
    return choice(
        f"Where does {_piece(step)} lie, seen from {_plane(step)}?",
        place,
        f"{_SIDES[place].lower()}.",
        _SIDES,
    )


@explains(f"depth.{_TESTED}.distances")
def distances(step: StepValues) -> Said:
    """How far the corners of a piece lie from the plane."""
    d, plane = step.vector("distances"), step.vector("plane")
    text = f"{_piece(step).capitalize()}: its corners lie at distances {vector_text(d)} from {_plane(step)}."
    k = int(np.abs(d).argmax())
    if d[k] == 0:
        return text
    products = [
        named(letter, value) * named(f"{axis}_{k}", coordinate).of_vertex(k)
        for letter, axis, value, coordinate in zip("abcd", "xyzw", plane, step.rows("clip")[k], strict=True)
    ]
    return text, formula_of(named(f"d_{k}", d[k]).of_vertex(k).equals(total(products)))


@explains(f"depth.{_TESTED}.side", asks=side_asked, decides=True)
def side(step: StepValues) -> Said:
    """On which side it lies, and where it goes."""
    because = {
        "on": "all three distances are 0, so it lies in the plane and stays in this node.",
        "front": "no distance is negative, so it goes to the front half.",
        "back": "no distance is positive, so it goes to the back half.",
        "cut": "distances have both signs, so the plane cuts it.",
    }
    return f"{_piece(step).capitalize()}: {because[step.kind]}"


@explains("depth.cut.share")
def share(step: StepValues) -> Said:
    """Where the first side crosses the plane."""
    d, t = step.vector("distances"), step.named("cut_t", "t")
    k = next(k for k in range(3) if min(d[k], d[k - 2]) < 0 < max(d[k], d[k - 2]))
    before, behind = (k, (k + 1) % 3) if d[k] > 0 else ((k + 1) % 3, k)
    first, second = (named(f"d_{one}", d[one]).of_vertex(one) for one in (before, behind))
    where = f"corner {before} of {_piece(step)} to its corner {behind}"
    text = f"From {where}, front to back, the plane is met at t = {t}."
    return text, formula_of(t.equals(slash(first, first - second)))


@explains("depth.cut.corner")
def corner(step: StepValues) -> Said:
    """The new corner, and the pieces."""
    front, back = step.whole("made_front"), step.whole("made_back")
    return (
        f"A new corner is {vector_text(step.vector('corner'))}, and the cut makes {counted(front, 'piece')} on the "
        f"front side and {counted(back, 'piece')} on the back, all still parts of {step.name}."
    )


def eye_asked(step: StepValues) -> Asked:
    """Ask which half is drawn first."""
    is_front = step.text("eye_side") == "front"
    where = "the eye lies on the front side" if is_front else "the eye does not lie on the front side"
    return choice(
        f"Which half is drawn before {_piece(step)}?",
        1 if is_front else 0,
        f"{where}.",
        ("The front half", "The back half"),
    )


@explains("depth.walk.eye", asks=eye_asked, decides=True)
def eye(step: StepValues) -> Said:
    """On which side of a node the eye lies."""
    distance, c = step.named("eye", below("d", "eye")), named("c", step.vector("plane")[2])
    where = (
        "on the front side of"
        if distance.value > 0
        else "on the back side of"
        if distance.value < 0
        else "in"
    )
    text = f"The eye (0, 0, −1, 0) lies {where} {_plane(step)}, at distance {distance}."
    return text, formula_of(distance.equals(-c))


@explains("depth.walk.drawn")
def drawn(step: StepValues) -> Said:
    """A node is drawn between its halves."""
    far, near = ("back", "front") if step.text("eye_side") == "front" else ("front", "back")
    held = step.whole("held")
    more = f" and {counted(held - 1, 'other piece')} of its plane" if held > 1 else ""
    eye_in_plane = (
        " (the eye lies in the plane, so either half may be first)" if step.number("eye") == 0 else ""
    )
    place = f"{'are' if more else 'is'} drawn, at place {step.whole('place')}, counted from 0"
    first = f"After the {far} half of this node{eye_in_plane}, {_piece(step)}{more} {place}"
    return f"{first}, and the {near} half follows."


# The tree as a table: nodes below each other, each a step further in than the one above it.


DEEPEST = 8
"""Levels of a tree that are indented; nodes below say theirs."""
LONGEST = 200
"""Nodes of a table at most."""
_COLUMNS = (
    TableColumn("tested", "Pieces of its half that were tested against its plane."),
    TableColumn("cut", "How many of them the plane cuts."),
    TableColumn("eye", "Side of the plane on which the eye lies: the other half is drawn first."),
    TableColumn("drawn", "Place in the drawing order, counted from 0."),
)


@tabulates("depth", tuple(TREE_OPERATIONS), Level.STAGE)
def tree_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the nodes of ``rows`` (R,) begun so far, indented, with what they cut and when they are drawn."""
    tree: BspTree = trace.extra["tree"]
    steps, columns = trace.steps, trace.columns
    begun = rows[steps.starts[rows] < position]
    kinds = np.array([trace.kind_of(int(row)) for row in begun.tolist()])
    current, _ = steps.row_at(position)
    walked = (
        {int(columns["node"][row]): int(row) for row in begun[kinds == "walk"].tolist()} if len(begun) else {}
    )
    roots = begun[kinds == "root"].tolist() if len(begun) else []
    labels: list[str] = []
    cells: list[tuple[TableCell | None, ...]] = []
    here = -1
    for row in roots[:LONGEST]:
        node = int(columns["node"][row])
        if current >= 0 and current <= rows[-1] and node == columns["node"][current]:
            here = len(labels)
        half = ("", "front: ", "back: ")[int(columns["half"][row]) + 1]
        name = piece_name(
            nouns(trace.corner_count).one,
            int(columns["root_triangle"][row]),
            int(columns["root_number"][row]),
        )
        level = int(tree.depth[node])
        deep = f"level {level}, " if level > DEEPEST else ""
        labels.append("\u2003" * min(level, DEEPEST) + deep + half + name)
        at = steps.position_after(row)
        made = [_cell(int(columns[key][row]), at) if position >= at else None for key in ("tested", "cuts")]
        if node in walked:
            walk = walked[node]
            first, last = int(steps.starts[walk]) + 1, steps.position_after(walk)
            eye = (
                "in the plane"
                if columns["eye"][walk] == 0
                else ("front", "back")[int(columns["eye"][walk] < 0)]
            )
            made += [
                _cell(eye, first),
                _cell(int(columns["place"][walk]), last) if position >= last else None,
            ]
        else:
            made += [None, None]
        cells.append(tuple(made))
    made_now = {
        (k, place)
        for k, line in enumerate(cells)
        for place, one in enumerate(line)
        if one is not None and one is not NONE and one.position == position
    }
    return StepTable(
        "BSP tree: what lies on the front and the back side of each plane",
        "Node",
        _COLUMNS,
        tuple(labels),
        tuple(cells),
        frozenset(made_now),
        here,
        _verdict(tree) if len(rows) and position >= steps.position_after(int(rows[-1])) else "",
    )


def _cell(value: int | str, position: int) -> TableCell:
    return TableCell(*cell_texts(value), position)


def _verdict(tree: BspTree) -> str:
    whole = counted(int(tree.triangle.max(initial=-1)) + 1, "triangle")
    cuts = int((tree.side == 3).sum())
    pieces = counted(len(tree.drawn), "piece")
    return (
        f"{counted(cuts, 'cut')} made {pieces} of {whole}. Whatever is drawn later lies on the eye's side of a plane "
        "that parts it from what is there, so it may paint over it."
    )
