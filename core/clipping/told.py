"""Clipping triangles, told step by step: edges against planes, new corners, the division by w, and its tables."""

from collections.abc import Callable
from dataclasses import replace
from operator import and_, or_

import numpy as np

from core.culling.culling import PLANES
from core.explain.formulas import below, concludes, formula_of, named
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, Formula, choice
from core.explain.step_tables import FilledColumn, filled_table, primitive_name, tabulates
from core.explain.step_values import AXES, Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.lines.told_clipping import borders_of, code_text, is_point
from core.methods import table
from core.records.arrays import Flags, Integers
from core.records.steps import Level, StepTable, TableCell
from core.records.words import capitalized, counted, joined, noun_of, piece_name
from core.trace.stage_trace import StageTrace

# Clipping triangles: edges against planes, new corners in either order, and division before clipping.

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
    piece = piece_name(step.nouns.one, step.triangle, step.whole("tree_piece"))
    return f"{capitalized(piece)} is unchanged: no plane clips it."


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


# The tables of clipping: outcodes; p, q and t; N . D with PE and PL; the planes of the frustum; IN and OUT.


_DIGITS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_WAYS = {
    "clip-enter": ("enters", "PE"),
    "clip-leave": ("leaves", "PL"),
    "clip-parallel": ("parallel", "parallel"),
    "clip-outside": ("parallel, outside", "parallel, outside"),
}
"""What an edge does at a border: in words of Liang-Barsky, and of Cyrus-Beck."""


def _way(step: StepValues, symbols: int) -> str:
    """Return what an edge does at a border, in words (0) or as PE and PL (1)."""
    way = _WAYS[step.kind][symbols]
    return way.replace("parallel", "point") if is_point(step) else way


_BOUNDS = (
    FilledColumn("tE", "Latest entry so far: at least 0.", lambda step: step.number("t_enter")),
    FilledColumn("tL", "Earliest exit so far: at most 1.", lambda step: step.number("t_leave")),
)
_LIANG_BARSKY = (
    FilledColumn(
        "p", "Below 0 the {edge} enters, above 0 it leaves.", lambda step: step.number("approach"), "room"
    ),
    FilledColumn(
        "q", "Room inside at the first end: below 0 is outside.", lambda step: step.number("room"), "room"
    ),
    FilledColumn("case", "What the sign of p says.", lambda step: _way(step, 0), "room"),
    FilledColumn(
        "t = q/p", "Where the border is crossed.", lambda step: step.number("crossing_t"), "crossing_t"
    ),
    *_BOUNDS,
)
_CYRUS_BECK = (
    FilledColumn("N", "Outward normal.", lambda step: tuple(step.vector("normal")), "room"),
    FilledColumn(
        "N · D",
        "Below 0: potentially entering. Above 0: potentially leaving.",
        lambda step: step.number("approach"),
        "room",
    ),
    FilledColumn(
        "N ·\n(P₀ − Pₑ)", "Above 0 the first end is outside.", lambda step: 0.0 - step.number("room"), "room"
    ),
    FilledColumn(
        "PE/PL", "Potentially entering, or potentially leaving.", lambda step: _way(step, 1), "room"
    ),
    FilledColumn("t", "Where the border is crossed.", lambda step: step.number("crossing_t"), "crossing_t"),
    *_BOUNDS,
)


def _title(trace: StageTrace, row: int) -> str:
    """Return the clipper and what it clips."""
    method = table.get("line_clipping", str(trace.constants["line_clipping"])).title
    name = primitive_name(trace, row)
    edge = "" if trace.corner_count < 3 else f"edge {int(trace.columns['edge'][row])} of "
    return f"{method}: {edge}{name}"


@tabulates("raster", (*_WAYS, "clip-kept", "clip-empty"))
def borders_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return p, q and t, or N . D, PE and PL, of every border: rows (R,) of a trace, as far as they are done."""
    clip = trace.extra["outline_clip"]
    columns = _LIANG_BARSKY if trace.constants["line_clipping"] == "liang-barsky" else _CYRUS_BECK
    borders = rows[[trace.kind_of(row) in _WAYS for row in rows.tolist()]]
    names = clip.lines.window.edge_names
    return filled_table(
        trace, borders, position, _title(trace, rows[0]), "Border", names, columns, closing=int(rows[-1])
    )


def _bits(step: StepValues, combine: Callable[[int, int], int]) -> str:
    return code_text(combine(step.whole("code_start"), step.whole("code_end")))


def _does(step: StepValues) -> str:
    """Return what a pass of Cohen-Sutherland decides."""
    if step.kind == "outcodes-accept":
        return "accepted: or = 0"
    if step.kind == "outcodes-reject":
        return f"rejected: {borders_of(step.whole('code_start') & step.whole('code_end'))}"
    return f"end {step.whole('moved_end')} cut at {step.text('border')}"


_OUTCODES = (
    FilledColumn("P₀", "First end now.", lambda step: tuple(step.vector("pass_start")), "code_start"),
    FilledColumn(
        "c₀",
        "Its outcode: top, bottom, right, left.",
        lambda step: code_text(step.whole("code_start")),
        "code_start",
    ),
    FilledColumn("P₁", "Second end now.", lambda step: tuple(step.vector("pass_end")), "code_start"),
    FilledColumn(
        "c₁",
        "Its outcode: top, bottom, right, left.",
        lambda step: code_text(step.whole("code_end")),
        "code_start",
    ),
    FilledColumn("or", "0000: both ends are inside.", lambda step: _bits(step, or_), "code_start"),
    FilledColumn(
        "and", "Not 0000: both ends are outside one border.", lambda step: _bits(step, and_), "code_start"
    ),
    FilledColumn("verdict", "Accepted, rejected, or the end that is cut.", _does),
)


@tabulates("raster", ("outcodes-accept", "outcodes-reject", "outcodes-cut"))
def outcodes_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the outcodes of every pass, rows (R,) of a trace; a pass appears as it begins."""
    labels = [str(number) for number in range(1, len(rows) + 1)]
    return filled_table(trace, rows, position, _title(trace, rows[0]), "Pass", labels, _OUTCODES, grows=True)


def _side_bits(step: StepValues) -> list[int]:
    """Return for every corner whether it is outside the plane of a row, or behind the eye."""
    if step.kind == "behind":
        return [int(value <= 0) for value in step.vector("w")]
    return [int(value < 0) for value in step.vector("distances")]


def _distance(corner: int) -> FilledColumn:
    def value(step: StepValues) -> float:
        return step.vector("w" if step.kind == "behind" else "distances")[corner]

    meaning = f"Signed distance of {{corner}} {corner} from the plane: below 0 is outside."
    return FilledColumn(f"d{str(corner).translate(_DIGITS)}", meaning, value, "applies", vertex=corner)


def _verdict_cell(step: StepValues) -> str:
    bits = _side_bits(step)
    if all(bits):
        return "rejected"
    return "crosses" if any(bits) else "inside"


_VERDICT = FilledColumn(
    "verdict", "Inside: no {corner} is outside. Rejected: all are.", _verdict_cell, "applies"
)
_EQUATIONS = {
    name: f"{name}: w {'+' if sign > 0 else '−'} {axis}" for name, (axis, sign) in PLANE_SIGNS.items()
}


@tabulates("cull", ("behind", "plane", "kept"), Level.TRIANGLE)
def frustum_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the distances of all corners from every plane, rows (R,), up to the first plane that rejects them."""
    corners = trace.corner_count
    tests = rows[[trace.kind_of(row) != "kept" for row in rows.tolist()]]
    columns = (*(_distance(corner) for corner in range(corners)), _VERDICT)
    labels = ["w", *(_EQUATIONS[name] for name in PLANES)]
    title = f"Frustum, plane by plane: {primitive_name(trace, rows[0])}"
    outside = trace.columns["distances"][tests[1:]] < 0
    planes = tests[1:]
    made = filled_table(
        trace,
        tests,
        position,
        title,
        "Plane",
        labels,
        columns,
        closing=int(rows[-1]),
        note="" if trace.columns["applies"][tests[-1]] else _not_rejected(outside),
    )
    done = int((trace.steps.starts[planes + 1] <= position).sum())
    codes = [_code(bits) for bits in outside[:done].T]
    at = trace.steps.position_after(int(planes[done - 1])) if done else -1
    cells = [TableCell(code, code, at) if done else None for code in codes]
    return replace(made, rows=(*made.rows, "outcode"), cells=(*made.cells, (*cells, None)))


def _code(outside: Flags) -> str:
    """Write the outcode of bits (n,), the first plane's last; a plane that is not looked at yet is a dot."""
    return "".join("01"[bit] for bit in outside[::-1].tolist()).rjust(len(PLANES), "·")


def _not_rejected(outside: Flags) -> str:
    """Say what the outcodes of corners, (6, C) bool, decide where no plane has all of them outside."""
    some = np.any(outside, axis=1)
    every = np.all(outside, axis=1)
    joint, shared = _code(some), _code(every)
    crossed = [PLANES[plane] for plane in np.flatnonzero(some)]
    if not crossed:
        return f"Accepted without clipping: the outcodes have no bit (or = {joint})."
    return (
        f"Neither accepted (or = {joint}) nor rejected (and = {shared}): it crosses the {joined(crossed)} "
        f"{noun_of(len(crossed), 'plane')}."
    )


def _ends(step: StepValues) -> str:
    return step.kind.upper().replace("-", " → ")


def _output(step: StepValues) -> str:
    return {"in-in": "end", "in-out": "new", "out-in": "new, end", "out-out": "nothing"}[step.kind]


def _corner_cell(step: StepValues) -> tuple[float, ...] | None:
    return None if step.kind in ("in-in", "out-out") else tuple(step.vector("corner"))


_EDGES = (
    FilledColumn(
        "d start",
        "Distance of its start from the plane.",
        lambda step: step.number("start_distance"),
        "start_distance",
    ),
    FilledColumn(
        "d end",
        "Distance of its end from the plane.",
        lambda step: step.number("end_distance"),
        "end_distance",
    ),
    FilledColumn("case", "Where its start and its end lie.", _ends, "end_distance"),
    FilledColumn("t", "Where the edge crosses the plane.", lambda step: step.number("t"), "t"),
    FilledColumn("output", "The corners that this edge adds to the output.", _output),
    FilledColumn("new corner", "x, y, z and w where it crosses.", _corner_cell, "corner"),
)


@tabulates("clip", tuple(CASES))
def polygon_table(trace: StageTrace, rows: Integers, position: int) -> StepTable:
    """Return the edges of a polygon at one plane, rows (R,): IN and OUT, and the corners that they hand on."""
    plane = str(trace.columns["plane"][rows[0]])
    title = f"{_EQUATIONS[plane]}: {primitive_name(trace, rows[0])}"
    labels = [f"edge {edge}" for edge in trace.columns["edge"][rows].tolist()]
    count = sum(CASES[trace.kind_of(row)] for row in rows.tolist())
    note = (
        f"{counted(len(rows), 'corner')} in, {count} out." if count else "No corner is left: it is outside."
    )
    return filled_table(trace, rows, position, title, "Edge", labels, _EDGES, note=note)
