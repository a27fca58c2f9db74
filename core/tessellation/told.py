"""Tessellation: where a curve is cut, the mixtures of every level, and the vertex, with the scheme as a table."""

from fractions import Fraction
from functools import partial
from math import isinf

from core.explain.formulas import Named, call, concludes, formula_of, named
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, choice, number
from core.explain.step_tables import FilledColumn, filled_table, tabulates
from core.explain.step_values import AXES, Said, StepValues, explains
from core.explain.steps import VariableText, hides, shows
from core.records.arrays import Integers
from core.records.steps import StepTable
from core.records.words import counted
from core.tessellation.reyes import GRID_SIDE
from core.tessellation.segments import MOST_HALVINGS
from core.trace.stage_trace import StageTrace

POINTS = "parameter|parameter-v|mix|mix-row|mix-column|normal|emit"
CUTS = "cut-equal|cut-bound|cut-halve|cut-split|cut-dice"


def _curve(step: StepValues) -> str:
    """Return the curve or patch of a step, at the beginning of a sentence."""
    return f"{'Patch' if step.nouns.one == 'triangle' else 'Curve'} {step.whole('owner')}"


def _letter(step: StepValues) -> str:
    """Return what the parameter of a step is called: t of curves, u and v of patches."""
    if step.nouns.one != "triangle":
        return "t"
    is_second = step.kind in ("parameter-v", "mix-row") or (
        step.kind in CUTS.split("|") and step.whole("along") == 1
    )
    return "v" if is_second else "u"


@explains("transform.cut-equal.count")
def equal_steps(step: StepValues) -> Said:
    """As many as asked for, or as fit where no bound does."""
    count = step.whole("count")
    return (
        f"{_curve(step)} is cut at {counted(count, 'equal step')} of {_letter(step)}: "
        f"{counted(count, 'piece')} with {count + 1} ends."
    )


@explains("transform.cut-bound.deviation")
def deviation(step: StepValues) -> Said:
    """How far one straight piece is from the curve at most."""
    value = step.named("deviation", r"\delta")
    bend, w_bend = step.named("bend", "b"), step.named("w_bend", "b_w")
    reach, least = step.named("reach", "r"), step.named("least_w", "w")
    text = (
        f"{_curve(step)}, along {_letter(step)}: with one piece it is at most {value} pixels away, an eighth of its "
        f"largest second derivative{'' if w_bend.value == 0 else ', that of w included'}."
    )
    return text, formula_of(value.equals((bend + reach * w_bend) / (8 * least)))


def piece_count(step: StepValues) -> Asked | None:
    """Ask for the number of pieces."""
    count, tolerance = step.whole("count"), step.number("tolerance")
    text = f"How many equal steps keep the deviation within {spoken(tolerance)} pixels?"
    return number(text, count, "With n steps, it is an n²-th of that with one.")


@explains("transform.cut-bound.count", asks=piece_count, decides=True)
def count(step: StepValues) -> Said:
    """The least number that the bound allows."""
    found, tolerance = step.whole("count"), step.named("tolerance", r"\epsilon")
    text = (
        f"{_curve(step)}: {counted(found, 'equal step')} of {_letter(step)} keep it within {tolerance} pixels, as n "
        "steps divide the deviation by n²."
    )
    wanted = call("ceil", call("sqrt", step.named("deviation", r"\delta") / tolerance))
    return text, formula_of(named("n", found).equals(call("max", wanted, named("", 1))))


def _piece(step: StepValues) -> str:
    first, last, whole = (step.whole(name) for name in ("first", "last", "last_step"))
    ends = (_fraction(first, whole), _fraction(last, whole))
    return f"{_curve(step)} from {_letter(step)} = {ends[0]} to {ends[1]}"


def _fraction(step: int, steps: int) -> str:
    """Return a parameter as a fraction in lowest terms."""
    return str(Fraction(step, steps))


@explains("transform.cut-halve.distance")
def distance(step: StepValues) -> Said:
    """How far the control points are from the chord."""
    value = step.number("distance")
    if isinf(value):
        return f"{_piece(step)} reaches behind the eye, so it has no chord in the window."
    place = vector_text(step.vector("control_point"))
    return f"{_piece(step)}: its inner control point {place} is the farthest from the chord, {spoken(value)} pixels."


def flat(step: StepValues) -> Asked | None:
    """Ask whether a piece is halved."""
    return choice(
        f"Is the piece from {_piece(step).partition(' from ')[2]} straight enough?",
        int(not step.flag("is_flat")),
        f"Its control points are within {spoken(step.number('distance'))} pixels of the chord.",
    )


@explains("transform.cut-halve.verdict", asks=flat, decides=True)
def verdict(step: StepValues) -> Said:
    """One straight piece, or two halves."""
    distance, tolerance = step.named("distance", "d"), step.named("tolerance", r"\epsilon")
    if step.whole("halvings") == MOST_HALVINGS and distance.value > tolerance.value:
        return f"{_piece(step)} was halved {MOST_HALVINGS} times, the limit: it stays one piece."
    found = "one piece"
    text = f"no control point is farther than {tolerance} pixels from the chord: it is one piece."
    if not step.flag("is_flat"):
        found = "halve"
        text = f"a control point is farther than {tolerance} pixels from the chord: it is halved, and each half tested."
    if isinf(distance.value):
        return f"{_piece(step)} is halved, and each half tested."
    return f"{_piece(step)}: {text}", formula_of(
        concludes("one piece", found, distance.compared(r"\le", tolerance))
    )


def _part(step: StepValues) -> str:
    count, letter = 2 ** step.whole("halvings"), _letter(step)
    where = f"part {step.whole('place')} of {count} along {letter}" if count > 1 else f"along {letter}"
    return f"{_curve(step)}, {where}"


def is_split(step: StepValues) -> Asked | None:
    """Ask whether a part is split."""
    length = spoken(step.number("piece_length"))
    text = f"{_part(step)}, is {length} pixels long by its control points. Is it split?"
    return choice(
        text, int(step.kind != "cut-split"), f"Above {GRID_SIDE} pixels it is split, else it is diced."
    )


@explains("transform.cut-split.split", asks=is_split, decides=True)
def split(step: StepValues) -> Said:
    """A part too long for one grid."""
    length = step.named("piece_length", "l")
    if isinf(length.value):
        return f"{_part(step)}: it reaches behind the eye, so it is split."
    text = f"{_part(step)}: by its control points it is {length} pixels long, too long for a grid, so it is split."
    return text, formula_of(concludes("split", "split", length.compared(">", named("", GRID_SIDE))))


@explains("transform.cut-dice.length", asks=is_split, decides=True)
def is_short(step: StepValues) -> Said:
    """A part that one grid holds."""
    length = step.named("piece_length", "l")
    if not length.value <= GRID_SIDE:
        return f"{_part(step)}: it was split {MOST_HALVINGS} times, the limit, so it is diced."
    text = f"{_part(step)}: by its control points it is {length} pixels long, short enough for a grid, so it is diced."
    return text, formula_of(concludes("split", "dice", length.compared(">", named("", GRID_SIDE))))


@explains("transform.cut-dice.dice")
def diced(step: StepValues) -> Said:
    """A power of two, so that each part is short enough."""
    parts, side, length = step.whole("parts"), step.number("micro_side"), step.number("part_length")
    text = f"{_part(step)}: it has {counted(parts, 'part')}; by its control points the longest is"
    if parts > 1 and length <= side:
        return f"{text} {spoken(length)} pixels long, and of half as many it was longer than {spoken(side)}."
    return f"{text} {spoken(length)} pixels long."


@explains("transform.parameter|parameter-v.parameter")
def parameter(step: StepValues) -> Said:
    """Where on the curve the next point lies."""
    letter, done, steps = _letter(step), step.whole("step"), step.whole("steps")
    t, s = step.named("t", letter), step.named("s", "s")
    text = f"{_curve(step)}: its next point is at {letter} = {t}, step {done} of {steps}, and s = 1 − {letter} = {s}."
    shares = (
        t.equals(named("k", done) / named("n", steps)),
        s.equals((named("n", steps) - named("k", done)) / named("n", steps)),
    )
    return text, formula_of(*shares)


def _scheme(step: StepValues) -> str:
    """Return which mixture a step makes."""
    level, pair = step.whole("level"), step.whole("pair")
    line = ""
    if step.kind != "mix":
        name = "row" if step.kind == "mix-row" else "column"
        line = f"{name} {step.whole('line')}, "
    return f"{_curve(step)}, {line}level {level}, point {pair}"


def mixture(step: StepValues) -> Asked | None:
    """Ask for a coordinate of the mixture."""
    value, place = step.number(f"after_{step.operation}"), AXES.index(step.operation)
    points = " and ".join(spoken(step.vector(name)[place]) for name in ("first_point", "second_point"))
    s, t = spoken(step.number("s")), spoken(step.number("t"))
    text = f"{_scheme(step)}: what is the mixture of {points} with s = {s} and {_letter(step)} = {t}?"
    return number(text, value, f"Its {step.operation} is {spoken(value)}.")


@explains("transform.mix|mix-row|mix-column.x|y|z", "transform.mix.w", asks=mixture)
def mixed(step: StepValues) -> Said:
    """One coordinate of a mixture of two neighbours."""
    axis, level, pair = step.operation, step.whole("level"), step.whole("pair")
    place = AXES.index(axis)
    value = step.number(f"after_{axis}")

    def point(number: int, of_level: int, at: float) -> Named:
        return named(f"{axis}_{{{number}}}^{{({of_level})}}", at)

    first, second = (step.vector(name)[place] for name in ("first_point", "second_point"))
    s, t = step.named("s", "s"), step.named("t", _letter(step))
    text = (
        f"{_scheme(step)}: its {axis} is {spoken(value)}, the mixture of {spoken(first)} and {spoken(second)}, "
        f"those of points {pair} and {pair + 1} of level {level - 1}."
    )
    sides = s * point(pair, level - 1, first) + t * point(pair + 1, level - 1, second)
    return text, formula_of(point(pair, level, value).equals(sides))


@explains("transform.normal.x|y|z")
def normal(step: StepValues) -> Said:
    """One coordinate of the cross product of both derivatives."""
    axis = step.operation
    k = AXES.index(axis)
    value, u, v = step.number(f"normal_{axis}"), step.vector("u_slope"), step.vector("v_slope")
    one, other = (k + 1) % 3, (k + 2) % 3

    def slope(letter: str, values: list[float], at: int) -> Named:
        return named(f"{letter}_{{{AXES[at]}}}", values[at])

    product = slope("u", u, one) * slope("v", v, other) - slope("u", u, other) * slope("v", v, one)
    text = (
        f"{_curve(step)}: {axis} of its normal is {spoken(value)}, by the cross product of both derivatives"
    )
    if step.flag("has_no_normal"):
        text += "; it is 0 up to rounding, so the normal of the points beside is taken"
    return f"{text}.", formula_of(named(f"n_{{{axis}}}", value).equals(product))


@explains("transform.emit.emit")
def emitted(step: StepValues) -> Said:
    """The point of the last level becomes a vertex."""
    place, rest = step.vector("after"), "before anything is divided by w"
    if step.nouns.one == "triangle":
        place, rest = place[:3], "before any matrix is applied"
    return f"{_curve(step)} emits the vertex {vector_text(place)}, the point of its last level, {rest}."


hides(f"transform.{POINTS}|{CUTS}", ("corner", "vertex", "before", "width", "height"))
shows(
    "transform",
    {
        "owner": VariableText("number", "Number of the curve or patch."),
        "bend": VariableText("b", "Largest second derivative of x w and y w, in pixels."),
        "w_bend": VariableText("bw", "Largest second derivative of w."),
        "reach": VariableText(
            "r", "Distance of the farthest control point from the middle of all, in pixels."
        ),
        "least_w": VariableText("w", "Least w of the control points."),
        "deviation": VariableText("δ", "How far one straight piece may be away, in pixels."),
        "control_point": VariableText(
            "control point", "The inner control point farthest from its chord, in pixels."
        ),
        "chord_start": VariableText("chord from", "Where its chord begins, in pixels."),
        "chord_end": VariableText("chord to", "Where its chord ends, in pixels."),
        "distance": VariableText("d", "Distance of the control point from the chord, in pixels."),
        "tolerance": VariableText("ε", "How far a curve may be from its pieces, in pixels."),
        "piece_length": VariableText("l", "Length of the longest control polygon, in pixels."),
        "micro_side": VariableText("side", "How long a micropolygon may be, in pixels."),
        "parts": VariableText("parts", "Micropolygons along the part."),
        "part_length": VariableText(
            "longest", "Length of the longest of them by its control points, in pixels."
        ),
        "count": VariableText("n", "Straight pieces."),
        "is_flat": VariableText("straight", "Whether the piece becomes one segment."),
        "step": VariableText("k", "Step of the point."),
        "steps": VariableText("n steps", "Steps of the whole curve."),
        "s": VariableText("s", "Share of the first of two neighbours."),
        "t": VariableText(_letter, "Share of the second: where on the curve the point lies."),
        "level": VariableText("level", "How often neighbours were mixed."),
        "pair": VariableText("point", "Number of the mixture in its level."),
        "u_slope": VariableText("derivative by u", "How the point moves with u."),
        "v_slope": VariableText("derivative by v", "How the point moves with v."),
        **{f"normal_{axis}": VariableText(f"n{axis}", f"{axis} of the normal.") for axis in AXES[:3]},
    },
)
shows(
    "transform.mix|mix-row|mix-column",
    {f"after_{axis}": VariableText(axis, f"{axis} of the mixture.") for axis in AXES},
)
shows("transform.emit", {"after": VariableText("vertex", "x, y, z and w of the vertex.")})


# Where curves are cut: what was measured of each piece, and what becomes of it.


_MEASURED = {
    "cut-equal": FilledColumn("n", "Equal steps.", lambda step: step.whole("count"), "count"),
    "cut-bound": FilledColumn(
        "δ", "How far one piece may be away, in pixels.", lambda step: step.number("deviation"), "deviation"
    ),
    "cut-halve": FilledColumn(
        "d",
        "Distance of a control point from the chord, in pixels.",
        lambda step: step.number("distance"),
        "distance",
    ),
    "cut-split": FilledColumn(
        "l",
        "Length of the longest control polygon, in pixels.",
        lambda step: step.number("piece_length"),
        "piece_length",
    ),
}
_BECOMES = FilledColumn("becomes", "What becomes of the piece.", lambda step: _becomes(step))


def _becomes(step: StepValues) -> str:
    match step.kind:
        case "cut-split":
            return "two parts"
        case "cut-dice":
            return counted(step.whole("parts"), "part")
        case "cut-halve":
            return "one piece" if step.flag("is_flat") else "two halves"
    return counted(step.whole("count"), "piece")


@tabulates("transform", CUTS.split("|"))
def cuts_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return what was found of each piece of curves or patches, rows (R,) of a trace, and what becomes of it."""
    labels = []
    for row in rows.tolist():
        explanation = trace.explain(trace.steps.position_after(row))
        assert explanation is not None
        step = StepValues(explanation, int(trace.triangle[row]))
        is_part = step.kind in ("cut-split", "cut-dice")
        labels.append(_part(step) if is_part else _piece(step) if step.kind == "cut-halve" else _curve(step))
    kind = trace.kind_of(int(rows[0])).replace("dice", "split")
    columns = (_MEASURED[kind], _BECOMES)
    return filled_table(
        trace, rows, position, "Where it is cut", "Piece", labels, columns, note=" ", grows=True
    )


# The triangle scheme, level by level.


@tabulates("transform", POINTS.split("|"))
def scheme_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the scheme of one point, rows (R,) of a trace: every mixture, level by level."""
    kinds = [trace.kind_of(row) for row in rows.tolist()]
    mixtures = rows[[kind.startswith("mix") for kind in kinds]]
    column = {name: trace.columns[name] for name in ("level", "pair", "owner", "step", "steps")}
    is_patch = kinds[0] == "parameter" and "parameter-v" in kinds
    labels = []
    for row in mixtures.tolist():
        line = {"mix": "", "mix-row": "row {} · ", "mix-column": "column {} · "}[trace.kind_of(row)]
        of_line = int(trace.columns["line"][row]) if line else 0
        labels.append(f"{line.format(of_line)}level {column['level'][row]} · {column['pair'][row]}")
    first = int(rows[0])
    name = f"{'Patch' if is_patch else 'Curve'} {column['owner'][first]}"
    title = f"{name}, step {column['step'][first]} of {column['steps'][first]}, level by level"
    columns = (
        FilledColumn("first", "The first of both neighbours.", partial(_point, name="first_point")),
        FilledColumn("second", "The second one.", partial(_point, name="second_point")),
        FilledColumn("mixture", "Share s of the first and t of the second.", partial(_point, name="after")),
    )
    return filled_table(
        trace, mixtures, position, title, "Point", labels, columns, closing=int(rows[-1]), grows=True
    )


def _point(step: StepValues, name: str) -> tuple[float, ...]:
    return tuple(step.vector(name)[: 2 if step.kind == "mix" else 3])
