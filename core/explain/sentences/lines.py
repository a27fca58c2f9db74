"""What is said while a wireframe's lines are drawn, and along them: one sentence for every key."""

from collections.abc import Callable, Mapping

from core.explain.number_text import counted, spoken, vector_text
from core.explain.sentences.pixel import attribute
from core.explain.sentences.raster import pixel_name
from core.explain.sentences.smooth_lines import GUPTA_SPROULL, RECTANGLE, WU, line_cosine, rectangle_length
from core.explain.step_values import StepValues
from core.raster.lines.traits import line_traits


def line_method(step: StepValues) -> str:
    """Return the line method of a row."""
    return step.kind.removesuffix("-start")


def axes(step: StepValues) -> tuple[str, str]:
    """Return the name of the longer axis of the line, and of the other."""
    return ("y", "x") if step.flag("is_steep") else ("x", "y")


def minor_direction(step: StepValues) -> int:
    """Return the way in which the shorter axis steps, 1 or −1."""
    major, minor = (1, 0) if step.flag("is_steep") else (0, 1)
    along, across = (step.vector("second_end")[k] - step.vector("first_end")[k] for k in (major, minor))
    if line_method(step) == "bresenham-lecture" and along < 0:
        across = -across
    return -1 if across < 0 else 1


def major_direction(step: StepValues) -> int:
    """Return the way in which the longer axis is followed, 1 or −1."""
    k = 1 if step.flag("is_steep") else 0
    return -1 if step.vector("second_end")[k] < step.vector("first_end")[k] else 1


def place_on_edge(step: StepValues) -> float:
    """Return where the pixel's centre lies along the edge; t is the same, kept between the ends 0 and 1."""
    start, end = step.vector("window_start"), step.vector("window_end")
    k = 1 if abs(end[1] - start[1]) > abs(end[0] - start[0]) else 0
    center = (step.whole("column"), step.whole("row"))[k] + step.number("center")
    return (center - start[k]) / (end[k] - start[k]) if end[k] != start[k] else 0.0


def octant(step: StepValues) -> str:
    """Where an edge runs, and along which axis it is longer."""
    major, _ = axes(step)
    first, second = vector_text(step.vector("window_start")), vector_text(step.vector("window_end"))
    if line_traits(line_method(step)).takes_pixels:
        first, second = (f"pixel {vector_text(step.vector(name))}" for name in ("first_end", "second_end"))
    text = f"Edge {step.whole('edge')} of triangle {step.triangle} runs from {first} to {second}"
    if step.number("run") == 0:
        return f"{text}, so it has no length on the raster."
    steps = "row by row" if step.flag("is_steep") else "column by column"
    level = "as long in x as in y" if step.number("run") == step.number("rise") else f"longer in {major}"
    return f"{text}: it is {level}, so it is drawn {steps}."


def lengths(step: StepValues) -> str:
    """The lengths along both axes and the first decision value."""
    major, minor = axes(step)
    run, rise = step.number("run"), step.number("rise")
    return (
        f"The line goes {counted(int(run), 'pixel')} along {major} and {spoken(rise)} along {minor}, "
        f"so the decision value D starts at 2 · {spoken(rise)} − {spoken(run)} = {spoken(2 * rise - run)}."
    )


def error_slope(step: StepValues) -> str:
    """The slope that is added to the error."""
    _, minor = axes(step)
    run, rise, slope = (spoken(step.number(name)) for name in ("run", "rise", "slope"))
    return f"The slope m is {rise} / {run} = {slope}: with every pixel the line moves so far along {minor}."


def line_slope(step: StepValues) -> str:
    """The equation of the line."""
    major, minor = axes(step)
    slope, intercept = spoken(step.number("slope")), step.number("intercept")
    rest = f"{'−' if intercept < 0 else '+'} {spoken(abs(intercept))}"
    return f"Counted so that pixel centres are whole numbers, the line is {minor} = {slope} · {major} {rest}."


def tested(step: StepValues) -> str:
    """The decision whether the minor coordinate steps."""
    _, minor = axes(step)
    decision, line = step.number("decision"), line_method(step)
    does = f"{minor} steps" if step.flag("has_stepped") else f"{minor} stays"
    if line == "bresenham-float":
        side = "above" if decision > 0.5 else "not above" if decision == 0.5 else "below"
        return f"The error e plus the slope m is {spoken(decision)}, {side} 0.5, so {does}."
    if decision == 0:
        return (
            f"D is 0, a tie: the line passes exactly between two pixels, and by this version's rule {does}."
        )
    return f"D is {spoken(decision)}, {'above' if decision > 0 else 'below'} 0, so {does}."


def stepped(step: StepValues) -> str:
    """The pixel on the minor axis."""
    _, minor = axes(step)
    now = spoken(step.number("minor"))
    if step.flag("has_stepped"):
        return f"The line has come nearer to the next pixel, so {minor} steps to {now}."
    return f"The line is still nearest to the same pixel along {minor}, so {minor} stays {now}."


def evaluated(step: StepValues) -> str:
    """The line equation at a column or row."""
    major, minor = axes(step)
    at, value = spoken(step.number("major")), spoken(step.number("decision"))
    return (
        f"At {major} = {at} the line has {minor} = {value}, counted so that pixel centres are whole numbers."
    )


def advanced(step: StepValues) -> str:
    """The slope added once more."""
    major, minor = axes(step)
    at, value = spoken(step.number("major")), spoken(step.number("decision"))
    done = "added" if major_direction(step) > 0 else "taken away"
    return f"The slope {spoken(step.number('slope'))} is {done} for {major} = {at}, which makes {minor} = {value}."


def rounded(step: StepValues) -> str:
    """The nearest pixel centre."""
    _, minor = axes(step)
    value, nearest = spoken(step.number("decision")), spoken(step.number("minor"))
    if step.flag("is_tie"):
        return (
            f"The value {minor} = {value} lies exactly between two pixel centres: halves go up, to {nearest}."
        )
    return f"The nearest pixel centre to {minor} = {value} is at {nearest}."


def nearest(step: StepValues) -> str:
    """How far the line passes from the centre of the nearest pixel (diamond exit)."""
    height, is_steep = step.number("decision"), step.flag("is_steep")
    sides = ("to the left of", "to the right of") if is_steep else ("below", "above")
    passes = f"the line passes {spoken(abs(height))} px {sides[int(height > 0)]} its centre"
    if height == 0:
        passes = "the line passes through its centre"
    line = "row" if is_steep else "column"
    if abs(height) == 0.5:
        return f"{pixel_name(step)} is as near as its neighbour in this {line}, and OpenGL's rule takes it: {passes}."
    return f"{pixel_name(step)} is the nearest in this {line}: {passes}."


def leaves(step: StepValues) -> str:
    """The diamond-exit test."""
    first, second = spoken(step.number("exit_start")), spoken(step.number("exit_end"))
    is_tie = 0.5 in (step.number("exit_start"), step.number("exit_end"))
    tie = ", a tie that OpenGL's rule decides" if is_tie else ""
    return (
        f"{pixel_name(step)}: its diamond ends at 0.5, the edge begins at {first} and ends at {second}, "
        f"so it leaves the diamond{tie}."
    )


def plotted(step: StepValues) -> str:
    """The pixel is drawn."""
    place, edge = place_on_edge(step), f"edge {step.whole('edge')}"
    intensity = step.number("intensity")
    drawn = "is drawn" if intensity == 1 else f"is drawn with intensity {spoken(intensity)}"
    if not 0 <= place <= 1:
        end = "first" if place < 0 else "second"
        return (
            f"{pixel_name(step)} {drawn}: its centre lies beyond the {end} end of {edge} and counts as there."
        )
    where = {0.0: "at the first end", 1.0: "at the second end"}.get(place, f"at t = {spoken(place)}")
    return f"{pixel_name(step)} {drawn}: its centre lies {where} of {edge}."


def parts(step: StepValues) -> str:
    """Both ends' parts of 1/w."""
    start, end = (spoken(value) for value in step.vector("parts"))
    first, second = (spoken(value) for value in step.vector("end_w"))
    return (
        f"{pixel_name(step)}: at t = {spoken(step.number('t'))} between ends with w = {first} and w = {second}, "
        f"the first end gives {start} of 1/w and the second {end}."
    )


def total(step: StepValues) -> str:
    """1/w along the line."""
    return f"{pixel_name(step)}: both parts add up to 1/w = {spoken(step.number('total'))}."


def weight(step: StepValues) -> str:
    """The shares of the ends."""
    s = step.number("s")
    how = (
        "as far as it is along the line in the window"
        if step.kind == "line-affine"
        else "the second part over 1/w"
    )
    return f"{pixel_name(step)}: the second end counts {spoken(s)}, {how}, and the first end {spoken(1 - s)}."


_BRESENHAM: Mapping[str, Callable[[StepValues], str]] = {"test": tested, "step": stepped, "plot": plotted}
_START: Mapping[str, Callable[[StepValues], str]] = {"octant": octant, "plot": plotted}
_LINE: Mapping[str, Callable[[StepValues], str]] = {"evaluate": evaluated, "round": rounded, "plot": plotted}
_LINE_AT: Mapping[str, Callable[[StepValues], str]] = {"evaluate": evaluated}
_DIAMOND: Mapping[str, Callable[[StepValues], str]] = {"round": nearest, "leaves": leaves, "plot": plotted}
_KINDS: Mapping[str, Mapping[str, Callable[[StepValues], str]]] = {
    "bresenham-start": {**_START, "lengths": lengths},
    "bresenham": _BRESENHAM,
    "bresenham-lecture-start": {**_START, "lengths": lengths},
    "bresenham-lecture": _BRESENHAM,
    "bresenham-float-start": {**_START, "slope": error_slope},
    "bresenham-float": _BRESENHAM,
    "midpoint-start": {**_START, **_LINE, "slope": line_slope},
    "midpoint": _LINE,
    "dda-start": {**_START, **_LINE, "slope": line_slope},
    "dda": {"advance": advanced, "round": rounded, "plot": plotted},
    "dda-float32-start": {**_START, **_LINE, "slope": line_slope},
    "dda-float32": {"advance": advanced, "round": rounded, "plot": plotted},
    "diamond-exit-start": {**_START, **_DIAMOND},
    "diamond-exit": _DIAMOND,
    "rectangle-start": {**_START, **RECTANGLE, "length": rectangle_length, "plot": plotted},
    "rectangle": {**RECTANGLE, "plot": plotted},
    "wu-start": {**_START, **_LINE_AT, **WU, "slope": line_slope, "plot": plotted},
    "wu": {**_LINE_AT, **WU, "plot": plotted},
    "gupta-sproull-start": {
        **_START,
        **_LINE_AT,
        **GUPTA_SPROULL,
        "slope": line_slope,
        "cosine": line_cosine,
        "plot": plotted,
    },
    "gupta-sproull": {**_LINE_AT, **GUPTA_SPROULL, "plot": plotted},
}

SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **{f"raster.{kind}.{name}": say for kind, of_kind in _KINDS.items() for name, say in of_kind.items()},
    "interpolate.line-perspective.parts": parts,
    "interpolate.line-perspective.total": total,
    "interpolate.line-perspective.weight": weight,
    "interpolate.line-affine.weight": weight,
    **{f"interpolate.line-{kind}.value": attribute for kind in ("perspective", "affine")},
}
