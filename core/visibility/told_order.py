"""The painter's sort, told step by step, and why it fails: Newell's five tests of every pair."""

from core.explain.formulas import below, formula_of, named, total
from core.explain.number_text import exact_text, full_text, spoken
from core.explain.records import Asked, choice
from core.explain.step_tables import cell_texts, tabulates
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, hides, shows
from core.records.arrays import Integers
from core.records.steps import Level, StepTable, TableCell, TableColumn
from core.records.words import joined, nouns
from core.trace.stage_trace import StageTrace
from core.visibility.newell import PairTests, find_cycle
from core.visibility.traced_order import SORT_OPERATIONS, SortedTriangles

shows(
    "depth",
    {
        "depths": VariableText(
            lambda step: f"{_depth(step)}#", "Depth of the corner along the view.", spread="parts"
        ),
        "distance": VariableText("D", "Sum of the corners' depths, three times their mean."),
        "other": VariableText(
            "before it", "The triangle just before it in the order so far.", absent="other"
        ),
        "other_distance": VariableText("D before", "The sum of that one's depths.", "other", absent="other"),
        "place": VariableText("place", "Place in the drawing order, counted from 0."),
    },
)
hides(f"depth.{'|'.join(SORT_OPERATIONS)}", ("column", "row"))


def _depth(step: StepValues) -> str:
    """Return the coordinate that is the depth along the view."""
    return "z" if step.flag("by_z") else "w"


@explains("depth.distance.sum")
def summed(step: StepValues) -> Said:
    """How far a triangle is: by the depths of its corners."""
    depths, distance = step.vector("depths"), step.named("distance", "D")
    axis = _depth(step)
    corners = [named(f"{axis}_{k}", depth).of_vertex(k) for k, depth in enumerate(depths)]
    text = (
        f"{step.name.capitalize()}: the depths {axis} of its corners add up to {distance}, "
        f"a mean of {spoken(distance.value / 3)}."
    )
    return text, formula_of(distance.equals(total(corners)))


@explains("depth.distance.append")
def appended(step: StepValues) -> Said:
    """Where it stands before it is compared."""
    return f"{step.name.capitalize()} goes to the end of the order so far, place {step.whole('place')}, counted from 0."


def swaps(step: StepValues) -> Asked | None:
    """Ask whether two neighbours of the order swap; the first of the order has none before it."""
    if step.whole("other") < 0:
        return None
    other = step.named_primitive(step.whole("other"))
    is_farther = step.number("distance") > step.number("other_distance")
    return choice(
        f"{other.capitalize()} stands just before {step.name}. Do they swap?",
        0 if is_farther else 1,
        f"{step.name} is {'farther' if is_farther else 'not farther'}, and far ones are drawn first.",
    )


@explains("depth.swap.farther", asks=swaps, decides=True)
def farther(step: StepValues) -> Said:
    """The comparison with the one before it."""
    mine, other = step.named("distance", "D"), step.named("other_distance", below("D", "before"))
    before = step.named_primitive(step.whole("other"))
    text = f"{step.name.capitalize()} (D = {mine}) is farther than {before} (D = {other})."
    return text, formula_of(mine.compared(">", other))


@explains("depth.swap.swap")
def swapped(step: StepValues) -> Said:
    """Two neighbours change places."""
    place, other = step.whole("place"), step.named_primitive(step.whole("other"))
    return f"They swap: {step.name} moves to place {place}, {other} to place {place + 1}."


@explains("depth.place.place", asks=swaps, decides=True)
def placed(step: StepValues) -> Said:
    """The place where no swap follows."""
    place, count = step.whole("place"), step.whole("swaps")
    after = f" after {count} swaps" if count > 1 else " after 1 swap" if count else ""
    if step.whole("other") < 0:
        return f"Nothing stands before {step.name}{after}: of those so far it is drawn first."
    mine, other = step.named("distance", "D"), step.named("other_distance", below("D", "before"))
    text = (
        f"{step.named_primitive(step.whole('other')).capitalize()} (D = {other}) is not nearer: "
        f"{step.name} stays at place {place} for now{after}."
    )
    return text, formula_of(mine.compared(">", other))


# The table of the sort while it runs, then Newell's tests of its result.


LONGEST = 60
"""Rows of a table at most."""
PAIRS_OF = 40
"""Triangles at most of which all pairs are tested."""


@tabulates("depth", tuple(SORT_OPERATIONS), Level.STAGE)
def sort_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the order so far, of ``rows`` (R,), or, when all are sorted, Newell's tests of every pair."""
    found: SortedTriangles = trace.extra["sorted"]
    done = trace.steps.position_after(int(rows[-1]))
    if position > done and 2 <= len(found.distance) <= PAIRS_OF:
        return _pair_table(trace, found, done)
    names, columns = nouns(trace.corner_count), trace.columns
    current, _ = trace.steps.row_at(position)
    order: list[int] = []
    at: dict[int, int] = {}
    for row in rows[trace.steps.starts[rows] < position].tolist():
        triangle = int(trace.triangle[row])
        at[triangle] = min(trace.steps.position_after(row), position)
        if triangle in order:
            order.remove(triangle)
        order.insert(int(columns["place"][row]), triangle)
    cells = [
        (_number(float(found.distance[one]), at[one]), _number(float(found.distance[one] / 3), at[one]))
        for one in order[:LONGEST]
    ]
    here = int(trace.triangle[current]) if current >= 0 and current <= rows[-1] else -1
    return StepTable(
        "Order so far, from the first drawn to the last",
        names.one.capitalize(),
        (
            TableColumn("D", "Sum of the depths of its corners."),
            TableColumn("mean", "Mean depth of its corners."),
        ),
        tuple(f"{names.one} {one}" for one in order[:LONGEST]),
        tuple(cells),
        row=order.index(here) if here in order[:LONGEST] else -1,
        note="All are sorted: far ones are drawn first." if position >= done else "",
    )


def _number(value: float, position: int) -> TableCell:
    return TableCell(exact_text(value), full_text(value), position)


_COLUMNS = (
    TableColumn("x", "The two do not overlap in x, so either order is right."),
    TableColumn("y", "The two do not overlap in y."),
    TableColumn("P behind Q", "All corners of P lie behind the plane of Q, or in it, seen from the eye."),
    TableColumn("Q before P", "All corners of Q lie before the plane of P, or in it, seen from the eye."),
    TableColumn("apart", "The two do not overlap in the window."),
    TableColumn("nearer", "Which of the two is nearer where they overlap in the window."),
    TableColumn("P first", "Whether drawing P before Q is right there."),
)
_VERDICTS = {"either": "either order", "right": "right", "wrong": "wrong", "cut": "no order"}
_NEARER = {"neither": "–", "unknown": "behind the eye"}


def _pair_table(trace: StageTrace, found: SortedTriangles, position: int) -> StepTable:
    pairs = found.pairs
    shown = pairs if len(pairs) <= LONGEST else [pair for pair in pairs if pair.verdict != "either"][:LONGEST]

    def cell(value: bool | str) -> TableCell:
        return TableCell(*cell_texts(value), position)

    return StepTable(
        "Newell's five tests of this order: P is drawn before Q",
        "P, Q",
        _COLUMNS,
        tuple(f"{pair.first}, {pair.second}" for pair in shown),
        tuple(
            (
                *(cell(bool(holds)) for holds in pair.holds),
                cell(_NEARER.get(pair.nearer, pair.nearer)),
                cell(_VERDICTS[pair.verdict]),
            )
            for pair in shown
        ),
        note=order_verdict(pairs, nouns(trace.corner_count).many),
    )


def order_verdict(pairs: list[PairTests], many: str) -> str:
    """Return what the pairs say of an order, in one or two sentences."""
    cycle = find_cycle(pairs)
    cut = "one has to be cut, as the painter's algorithm with a BSP tree does (pane Methods, More methods)."
    crossing = next((pair for pair in pairs if pair.verdict == "cut"), None)
    wrong = next((pair for pair in pairs if pair.verdict == "wrong"), None)
    if cycle:
        return (
            f"{many.capitalize()} {joined([str(one) for one in cycle])} overlap in a circle: each must be drawn before "
            f"the next, and the last before the first. No order paints them: {cut}"
        )
    if crossing and crossing.nearer == "both":
        return (
            f"{many.capitalize()} {crossing.first} and {crossing.second} pass through each other: each is nearer in a "
            f"part of their overlap. No order paints them: {cut}"
        )
    if crossing:
        return f"No test orders {many} {crossing.first} and {crossing.second}: each crosses the plane of the other."
    if wrong:
        return f"{wrong.second} must be drawn before {wrong.first}: the mean depth puts them the wrong way round."
    return "No pair is the wrong way round: this order is right."
