"""Polygon clipping in the window: the crossings and walks of Weiler-Atherton, the sides of Sutherland-Hodgman."""

from core.explain.formulas import Chain, formula_of, named
from core.explain.number_text import spoken, vector_text
from core.explain.records import Asked, Formula, choice
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, hides, shows

SH = "sh-in-in|sh-out-out|sh-in-out|sh-out-in"
_WALK = "wa-corner|wa-switch|wa-close"


def _owner(step: StepValues) -> str:
    """Return which of the two a ring is of."""
    return "clip window" if step.flag("of_region") else "polygon"


@explains("clip.wa-ring.direction")
def direction(step: StepValues) -> Said:
    """Whether a ring is a hole."""
    what = "a hole, inside an odd number of others" if step.flag("is_hole") else "an outline"
    return f"Ring {step.whole('ring')} of the {_owner(step)} is {what}."


@explains("clip.wa-ring.turn")
def turn(step: StepValues) -> Said:
    """Which way a ring runs."""
    way = "clockwise" if step.flag("is_hole") else "counter-clockwise"
    turned = "is turned to run" if step.flag("is_turned") else "runs"
    return f"It {turned} {way}, so the interior lies to its left."


@explains("clip.wa-crossing.place")
def crossing(step: StepValues) -> Said:
    """Where two sides cross."""
    t, u = step.named("t", "t"), step.named("region_t", "u")
    text = (
        f"Edge {step.whole('edge')} of ring {step.whole('ring')} crosses edge {step.whole('region_edge')} of ring "
        f"{step.whole('region_ring')} of the clip window: at t = {t} of its length, and at u = {u} of the window's."
    )
    return text, formula_of(t, u)


@explains("clip.wa-crossing.point")
def crossing_point(step: StepValues) -> Said:
    """The place of a crossing."""
    return f"The crossing lies at {vector_text(step.vector('point'))}.", _on_edge(step)


def _on_edge(step: StepValues) -> Formula:
    """Return the place at t of the edge of a step."""
    t, made = step.named("t", "t"), []
    for axis, *places in zip("xy", *map(step.vector, ("point", "start", "end")), strict=True):
        place, first, last = map(named, (axis, f"{axis}_0", f"{axis}_1"), places)
        made.append(place.equals(first + t * (last - first)))
    return formula_of(*made)


def entering(step: StepValues) -> Asked:
    """Ask whether the polygon enters at a crossing."""
    enters = step.flag("is_entering")
    place = vector_text(step.vector("point"))
    return choice(
        f"Does the polygon enter the clip window at {place}?",
        0 if enters else 1,
        f"{'Yes' if enters else 'No'}: it goes on {'inside' if enters else 'outside'} the window's edge.",
    )


@explains("clip.wa-crossing.way", asks=entering)
def way(step: StepValues) -> Said:
    """Whether the polygon enters or leaves."""
    if step.flag("is_entering"):
        return "The polygon enters here: the end of its edge lies to the left of the window's edge, inside."
    return "The polygon leaves here: the end of its edge lies to the right of the window's edge, outside."


@explains("clip.wa-whole.verdict")
def verdict(step: StepValues) -> Said:
    """What becomes of a ring without crossings."""
    other = "polygon" if step.flag("of_region") else "clip window"
    found = "inside the {}: it is kept" if step.flag("is_kept") else "outside the {}: it is dropped"
    return f"Ring {step.whole('ring')} of the {_owner(step)} crosses nothing and lies {found.format(other)}."


@explains("clip.wa-start.start")
def start(step: StepValues) -> Said:
    """Where a ring of the result begins."""
    return (
        f"Ring {step.whole('result_ring')} of the result starts at crossing {step.whole('crossing')}, "
        f"{vector_text(step.vector('point'))}, where the polygon enters."
    )


@explains(f"clip.{_WALK}.next")
def follow(step: StepValues) -> Said:
    """One step along the polygon or the clip window."""
    along = "clip window" if step.flag("on_region") else "polygon"
    what = f"crossing {step.whole('crossing')}" if step.whole("crossing") >= 0 else "its next corner"
    return f"Along the {along} to {what}, {vector_text(step.vector('point'))}."


def goes_on(step: StepValues) -> Asked:
    """Ask which polygon a walk follows behind a crossing."""
    on_region = step.flag("on_region")
    came, found = ("clip window", "polygon") if on_region else ("polygon", "clip window")
    return choice(
        f"The walk reaches crossing {step.whole('crossing')} along the {came}. What does it follow next?",
        int(not on_region),
        f"It changes to the {found}.",
        ("the polygon", "the clip window"),
    )


@explains("clip.wa-switch.switch", asks=goes_on, decides=True)
def switch(step: StepValues) -> Said:
    """From one polygon to the other."""
    if step.flag("on_region"):
        return "The polygon enters here: the walk goes on along the polygon."
    return "The polygon leaves here: the walk goes on along the clip window, inside the polygon."


@explains("clip.wa-close.close")
def close(step: StepValues) -> Said:
    """The end of a walk."""
    return f"That is the start: ring {step.whole('result_ring')} is closed, with {step.whole('corner_count')} corners."


OUTPUTS = ("nothing", "the crossing", "the end", "the crossing, then the end")
"""What an edge puts out."""


def output_of(step: StepValues) -> Asked:
    """Ask what an edge puts out, by the sides of its ends."""
    first, last = step.number("start_side"), step.number("end_side")
    found = 2 * (last >= 0) + ((first >= 0) != (last >= 0))
    return choice(
        f"An edge has d0 = {spoken(first)} at its start and d1 = {spoken(last)} at its end, 0 or more is inside. "
        "What does it put out?",
        found,
        f"It puts out {OUTPUTS[found]}.",
        OUTPUTS,
    )


@explains(f"clip.{SH}.sides", asks=output_of, decides=True)
def sides(step: StepValues) -> Said:
    """On which side of a window's edge both ends of an edge lie."""
    first, last = step.number("start_side"), step.number("end_side")
    where = ["inside" if value >= 0 else "outside" for value in (first, last)]
    text = (
        f"Ring {step.whole('ring')}, edge {step.whole('edge')}, against edge {step.whole('region_edge')} of the clip "
        f"window: its start is {where[0]} (d0 = {spoken(first)}), its end {where[1]} (d1 = {spoken(last)})."
    )
    a, b = step.vector("region_start"), step.vector("region_end")
    return text, formula_of(
        _side("d_0", first, a, b, step.vector("start")), _side("d_1", last, a, b, step.vector("end"))
    )


def _side(symbol: str, value: float, a: list[float], b: list[float], place: list[float]) -> Chain:
    """Return the cross product that says on which side of the line from a to b a place lies."""
    (xa, ya), (xb, yb), (x, y) = (
        map(named, (f"x{end}", f"y{end}"), at) for end, at in (("_a", a), ("_b", b), ("", place))
    )
    return named(symbol, value).equals((xb - xa) * (y - ya) - (yb - ya) * (x - xa))


@explains("clip.sh-in-out|sh-out-in.crossing")
def corner(step: StepValues) -> Said:
    """The new corner where an edge crosses."""
    return f"The new corner is {vector_text(step.vector('point'))}.", _on_edge(step)


@explains("clip.sh-in-out|sh-out-in.t")
def crosses(step: StepValues) -> Said:
    """Where an edge crosses the line of the window's edge."""
    first, last, t = step.named("start_side", "d_0"), step.named("end_side", "d_1"), step.named("t", "t")
    verb = "leaves" if step.kind == "sh-in-out" else "enters"
    return f"It {verb} at t = d0 / (d0 − d1) = {t}.", formula_of(t.equals(first / (first - last)))


@explains("clip.sh-in-in|sh-out-out|sh-out-in.keep")
def keep(step: StepValues) -> Said:
    """What becomes of the end of an edge."""
    return "Its end is kept." if step.flag("is_kept") else "Both ends are outside: nothing of it is kept."


hides(f"clip.wa-ring|wa-whole|wa-start|{_WALK}", ("edge", "number", "clip"))
hides(f"clip.wa-crossing|{SH}", ("number", "clip"))
shows(
    "clip",
    {
        "region_t": VariableText(
            "t of window", "Where the crossing lies on the edge of the clip window, from 0 to 1."
        ),
        "point": VariableText("place", "Where the crossing or corner lies, in pixels."),
        "is_hole": VariableText("hole", "Whether the ring lies inside an odd number of others."),
        "is_turned": VariableText("turned", "Whether the ring is turned round."),
        "is_entering": VariableText("entering", "Whether the polygon comes into the clip window."),
        "is_kept": VariableText("kept", "Whether it belongs to the result."),
        "start_side": VariableText("d0", "Side of the edge's start: above 0 inside the window's edge."),
        "end_side": VariableText("d1", "Side of the edge's end: above 0 inside the window's edge."),
        "corner_count": VariableText("corners", "Corners of the ring."),
    },
)
