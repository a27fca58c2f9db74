"""Line clipping: p, q and t, or normals (Cyrus-Beck), entries and exits; outcodes."""

from collections.abc import Callable

from core.explain.formulas import Chain, call, concludes, formula_of, named, upright
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, Formula, choice
from core.explain.step_values import REMARKS, Said, StepValues, explains
from core.explain.steps import PIXEL, VariableText, hides, shows
from core.explain.term_latex import Written
from core.lines.line_clipping import RECTANGLE_EDGES
from core.lines.traced import CLIP_KINDS
from core.records.words import joined

CODE_BITS = len(RECTANGLE_EDGES)
"""Digits of an outcode."""
_FROM_BORDER = r"N \cdot (P_0 - P_E)"


def uses_normals(step: StepValues) -> bool:
    """Return whether the method uses normals, as Cyrus-Beck does, rather than p and q."""
    return step.text("line_clipping") != "liang-barsky"


def code_text(code: int) -> str:
    """Write an outcode in binary: top, bottom, right, left."""
    return f"{code:0{CODE_BITS}b}"


def is_point(step: StepValues) -> bool:
    """Return whether both ends of an edge are the same: N . D, or p, is 0 at every border."""
    return step.vector("window_start") == step.vector("window_end")


WAYS = {
    "clip-enter": "it runs inwards",
    "clip-leave": "it runs outwards",
    "clip-parallel": "it is parallel and not dropped",
    "clip-outside": "it is parallel and dropped",
}
"""Kind of row to what an edge does at a border."""


def way_of_edge(step: StepValues) -> Asked:
    """Ask what an edge does at a border."""
    symbol = "N · D" if uses_normals(step) else "p"
    start = f"{step.edge_name.capitalize()}: {symbol} is {spoken(step.number('approach'))}"
    found = WAYS[step.kind]
    return choice(
        f"{start} at the {step.text('border')} border. What does the {step.nouns.edge} do there?",
        list(WAYS).index(step.kind),
        f"{symbol} is {spoken(step.number('approach'))}, so {found}.",
        tuple(WAYS.values()),
    )


@explains("raster.clip-enter|clip-leave|clip-parallel|clip-outside.room", asks=way_of_edge, decides=True)
def room(step: StepValues) -> Said:
    """How fast an edge runs outwards, and how much room its first end has."""
    border, along, distance = step.text("border"), step.number("approach"), step.number("room")
    start, end, point = (step.vector(name) for name in ("window_start", "window_end", "border_point"))
    side = "inside" if distance > 0 else "outside" if distance < 0 else "on it"
    beginning = f"{border.capitalize()} border, {step.edge_name}"
    if uses_normals(step):
        way = (
            "potentially entering (PE)"
            if along < 0
            else "potentially leaving (PL)"
            if along > 0
            else "parallel"
        )
        way = "a point (P₀ = P₁)" if is_point(step) else way
        text = (
            f"{beginning}: N · D = {spoken(along)}, so it is {way}, "
            f"and N · (P₀ − Pₑ) = {spoken(-distance)} shows that it starts {side}."
        )
        normal = named("N", step.vector("normal"))
        reach = named("D", [b - a for a, b in zip(start, end, strict=True)])
        offset = named("(P_0 - P_E)", [a - b for a, b in zip(start, point, strict=True)])
        approach = named(r"N \cdot D", along).equals(normal * reach)
        return text, formula_of(approach, named(_FROM_BORDER, -distance).equals(normal * offset))
    way = "runs inwards" if along < 0 else "runs outwards" if along > 0 else "runs parallel"
    way = "is a point" if is_point(step) else way
    text = (
        f"{beginning}: p = {spoken(along)}, so it {way}, "
        f"and q = {spoken(distance)} shows that it starts {side}."
    )
    k, is_low = int(border in ("bottom", "top")), border in ("left", "bottom")
    axis, bound = "xy"[k], "min" if is_low else "max"
    first, last = named(f"{axis}_0", start[k]), named(f"{axis}_1", end[k])
    limit = named(rf"{axis}_{{\{bound}}}", point[k])
    p = named("p", along).equals(-(last - first) if is_low else last - first)
    return text, formula_of(p, named("q", distance).equals(first - limit if is_low else limit - first))


@explains("raster.clip-enter|clip-leave.crossing")
def crossing(step: StepValues) -> Said:
    """Where the edge crosses the line of a border."""
    along, distance, t = step.number("approach"), step.number("room"), step.number("crossing_t")
    where = "before its first end" if t < 0 else "after its second end" if t > 1 else "between its ends"
    where = {0.0: "at its first end", 1.0: "at its second end"}.get(t, where)
    quotient, made = "q/p", named("q", distance) / named("p", along)
    if uses_normals(step):
        quotient = "N · (P₀ − Pₑ) / (−N · D)"
        made = named(_FROM_BORDER, -distance) / named(r"-N \cdot D", -along)
    line = f"the {step.text('border')} border's line"
    text = f"The {step.nouns.edge} crosses {line} at t = {quotient} = {spoken(t)}, {where}."
    return text, formula_of(named("t", t).equals(made))


@explains("raster.clip-enter|clip-leave.narrow")
def narrow(step: StepValues) -> Said:
    """The latest entry or the earliest exit so far."""
    name = "t_leave"
    kind = "exit"
    extreme = "earliest"
    order = "before"
    lost = "after"
    symbol = "t_L"
    rule = "min"
    if step.kind == "clip-enter":
        name = "t_enter"
        kind = "entry"
        extreme = "latest"
        order = "after"
        lost = "before"
        symbol = "t_E"
        rule = "max"
    before = step.named("bound_before", symbol)
    t = step.named("crossing_t", "t")
    now = step.named(name, symbol)
    text = f"This is the {extreme} {kind} so far: the part {lost} t = {now} is outside."
    if now == before:
        text = f"This {kind} changes nothing: t = {t} is not {order} the {kind} at {before}."
    return text, formula_of(now.equals(call(rule, before, t)))


def _side(step: StepValues) -> Formula:
    """On which side of its parallel border an edge lies."""
    distance = step.number("room")
    test = named("q", distance).compared(r"\ge")
    if uses_normals(step):
        test = named(_FROM_BORDER, -distance).compared(r"\le")
    return formula_of(concludes("inside", "outside" if distance < 0 else "inside", test))


@explains("raster.clip-parallel.side")
def parallel(step: StepValues) -> Said:
    """A parallel edge that is kept, for now."""
    border = step.text("border")
    text = f"The {step.nouns.edge} is parallel to the {border} border and not outside it, so it is not cut there."
    if is_point(step):
        what = "point is" if step.nouns.edge == "point" else f"{step.nouns.edge} is a point, which is"
        text = f"The {what} not outside the {border} border: there is nothing to cut."
    if step.number("room") < 0:
        text = (
            f"As printed, the {border} border is ignored, because it is parallel to the {step.nouns.edge}, "
            f"and the {step.nouns.edge} is kept; it lies outside this border, so the right algorithm drops it."
        )
    return text, _side(step)


REMARKS["raster.clip-parallel.side"] = lambda columns, rows: columns["room"][rows] < 0


@explains("raster.clip-outside.drop")
def outside(step: StepValues) -> Said:
    """A parallel edge outside."""
    how = "a point" if is_point(step) else "parallel to the border"
    text = f"The {step.nouns.edge} is {how} and lies outside {step.text('border')}: nothing of it is drawn."
    return text, _side(step)


@explains("raster.clip-kept.ends", "raster.clip-empty.drop")
def kept(step: StepValues) -> Said:
    """The part between the last entry and the first exit, if there is one."""
    enter, leave = step.named("t_enter", "t_E"), step.named("t_leave", "t_L")
    if step.kind == "clip-empty":
        text = (
            f"The {step.nouns.edge} would leave at t = {leave} before it enters at {enter}: "
            "it misses the clip window, and nothing of it is drawn."
        )
    elif (enter.value, leave.value) == (0.0, 1.0):
        text = f"No border cuts the {step.nouns.edge}: all of it is drawn."
    else:
        ends = f"{vector_text(step.vector('kept_start'))} to {vector_text(step.vector('kept_end'))}"
        text = f"From t = {enter} to {leave} the {step.nouns.edge} is inside: it is drawn from {ends}."
    found = "nothing" if enter.value > leave.value else "draw"
    return text, formula_of(concludes("draw", found, enter.compared(r"\le", leave)))


def borders_of(code: int) -> str:
    """Return the borders that a point with an outcode lies outside of."""
    return joined([name for bit, name in enumerate(RECTANGLE_EDGES) if code >> bit & 1])


def _codes(step: StepValues) -> tuple[int, int]:
    return step.whole("code_start"), step.whole("code_end")


def _compared_code(symbol: str, code: int, wanted: str) -> Chain:
    """Return an outcode beside the one of a point inside, in bits as in the table."""
    bits, inside = upright(code_text(code)), Written(upright(code_text(0)))
    return Chain((Written(symbol, bits), inside), ((wanted, r"\ne" if code else "="),))


OUTCODE_VERDICTS = {
    "outcodes-accept": "it is drawn",
    "outcodes-reject": "it is dropped",
    "outcodes-cut": "it is cut",
}
"""Kind of row to what becomes of an edge."""


def verdict_of_codes(step: StepValues) -> Asked:
    """Ask what the outcodes decide."""
    first, second = (code_text(code) for code in _codes(step))
    return choice(
        f"{step.edge_name.capitalize()}: its ends have the outcodes {first} and {second}. What becomes of it?",
        list(OUTCODE_VERDICTS).index(step.kind),
        f"With {first} and {second} {OUTCODE_VERDICTS[step.kind]}.",
        tuple(OUTCODE_VERDICTS.values()),
    )


@explains("raster.outcodes-accept|outcodes-reject|outcodes-cut.codes", asks=verdict_of_codes, decides=True)
def codes(step: StepValues) -> Said:
    """The outcodes of both ends, and what they have in common."""
    first, second = _codes(step)
    ends = [
        f"{vector_text(step.vector(point))} has outcode {code_text(code)} "
        f"({f'outside {borders_of(code)}' if code else 'inside'})"
        for code, point in ((first, "pass_start"), (second, "pass_end"))
    ]
    shown = (
        Written(symbol, upright(code_text(code)))
        for symbol, code in (("c_0", first), ("c_1", second), (r"c_0 \land c_1", first & second))
    )
    return f"{step.edge_name.capitalize()}: {', '.join(ends)}.", formula_of(*shown)


@explains("raster.outcodes-accept.ends")
def accept(step: StepValues) -> Said:
    """Both ends inside."""
    start, end = (vector_text(step.vector(name)) for name in ("kept_start", "kept_end"))
    tests = (_compared_code(f"c_{k}", code, "=") for k, code in enumerate(_codes(step)))
    text = f"Both outcodes are 0000: the {step.nouns.edge} is drawn from {start} to {end}."
    return text, formula_of(concludes("draw", "draw", *tests))


@explains("raster.outcodes-reject.drop")
def reject(step: StepValues) -> Said:
    """Both ends outside one border."""
    first, second = _codes(step)
    text = (
        f"Both outcodes have {code_text(first & second)} in common: the {step.nouns.edge} lies outside "
        f"{borders_of(first & second)}, and nothing of it is drawn."
    )
    test = _compared_code(r"c_0 \land c_1", first & second, r"\ne")
    return text, formula_of(concludes("drop", "drop", test))


@explains("raster.outcodes-cut.end")
def chosen_end(step: StepValues) -> Said:
    """The end that moves: the first one, unless it is inside."""
    k = step.whole("moved_end")
    text = f"{('The first', 'Only the second')[k]} end is outside, so it moves."
    test = _compared_code(f"c_{k}", _codes(step)[k], r"\ne")
    return text, formula_of(concludes("moves", "moves", test))


@explains("raster.outcodes-cut.edge")
def chosen_border(step: StepValues) -> Said:
    """The border that is cut at: the lowest bit of the outcode names it."""
    k, border = step.whole("moved_end"), step.text("border")
    text = f"Of the borders that its outcode names, {border} is the first."
    code = Chain((Written(f"c_{k}", upright(code_text(_codes(step)[k]))),))
    return text, formula_of(concludes("lowest bit", border, code))


@explains("raster.outcodes-cut.move")
def move(step: StepValues) -> Said:
    """The new end, on the border."""
    start, end, point = (step.vector(name) for name in ("window_start", "window_end", "moved_to"))
    border, moved = step.text("border"), ("first", "second")[step.whole("moved_end")]
    text = f"The {moved} end moves to {vector_text(point)}, where the {step.nouns.edge} crosses the {border} border."
    ends = zip("xy", point, start, end, strict=True)
    places = [(named(a, at), named(f"{a}_0", first), named(f"{a}_1", last)) for a, at, first, last in ends]
    (a, a0, a1), (b, b0, b1) = places if border in ("left", "right") else places[::-1]
    return text, formula_of(a, b.equals(b0 + (b1 - b0) @ ((a - a0) / (a1 - a0))))


def _either(normals: str, p_and_q: str) -> Callable[[StepValues], str]:
    """Return a label in the symbols of the method."""
    return lambda step: normals if uses_normals(step) else p_and_q


shows(
    "raster",
    {
        "border": VariableText("border", "Border of the raster that the edge is compared with."),
        "normal": VariableText("N", "Outward normal of the border.", "approach"),
        "border_point": VariableText("Pₑ", "A point on the border.", "approach"),
        "approach": VariableText(
            _either("N · D", "p"), "Below 0 the edge enters here, above 0 it leaves, 0 is parallel."
        ),
        "room": VariableText(
            _either("−N · (P₀ − Pₑ)", "q"), "Room inside the border at the first end; below 0: outside."
        ),
        "crossing_t": VariableText("t (border)", "Where the edge crosses the border's line."),
        "bound_before": VariableText(
            "bound before", "The latest entry, or earliest exit, of the previous borders."
        ),
        "t_enter": VariableText("tE", "Latest entry so far.", previous="bound_before"),
        "t_leave": VariableText("tL", "Earliest exit so far.", previous="bound_before"),
        "pass_start": VariableText("first end now", "First end at the start of this pass.", "code_start"),
        "pass_end": VariableText("second end now", "Second end at the start of this pass.", "code_end"),
        "code_start": VariableText("c₀", "Outcode of the first end: 1 left + 2 right + 4 bottom + 8 top."),
        "code_end": VariableText("c₁", "Outcode of the second end: 1 left + 2 right + 4 bottom + 8 top."),
        "moved_end": VariableText("moved end", "The end that moves: 0 the first, 1 the second."),
        "moved_to": VariableText("moves to", "Where the edge crosses the border."),
        "kept_start": VariableText("drawn from", "First end of the part that is drawn."),
        "kept_end": VariableText("drawn to", "Second end of the part that is drawn."),
    },
)
hides(f"raster.{'|'.join(CLIP_KINDS)}", PIXEL)
