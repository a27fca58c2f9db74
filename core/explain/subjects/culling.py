"""Culling: the tests that drop a whole triangle."""

from core.explain.digits import listed, spoken
from core.explain.formulas import Conclusion, concludes, formula_of, named
from core.explain.rows import Said, explains
from core.explain.statements import Chain
from core.explain.step_values import StepValues
from core.explain.variable_text import VariableText, shows
from core.records.words import counted, numbered

MOST_CORNERS = 4
"""Of more corners only the largest number is shown: all are below 0 if it is."""


def _dropped(step: StepValues, *tests: Chain) -> Conclusion:
    return concludes("dropped", "dropped" if step.flag("applies") else "kept", *tests)


def _each(symbol: str, name: str, relation: str, values: list[float]) -> tuple[str, list[Chain]]:
    """Return the numbers of all corners and a comparison of each, or of the largest where they are many."""
    if len(values) > MOST_CORNERS:
        largest = named(rf"\max_k {symbol}_k", max(values))
        return f"largest {name} {largest}", [largest.compared(relation)]
    return listed(values), [
        named(f"{symbol}_{k}", value).compared(relation) for k, value in enumerate(values)
    ]


@explains("cull.behind.test")
def behind(step: StepValues) -> Said:
    """Whether all corners have w of 0 or less."""
    w = step.vector("w")
    numbers, compared = _each("w", "w", r"\le", w)
    in_front = [k for k, value in enumerate(w) if not value <= 0]
    has_many = len(w) > MOST_CORNERS
    name, found = step.name.capitalize(), f"w above 0 ({'' if has_many else 'w = '}{numbers})"
    if step.flag("applies"):
        text = f"{name} is behind the eye and dropped: no {step.nouns.corner} has {found}."
    else:
        verb = "have" if len(in_front) > 1 else "has"
        noun = step.nouns.corner
        corners = counted(len(in_front), noun) if has_many else numbered(noun, in_front)
        text = f"{name} is not behind the eye: {corners} {verb} {found}."
    return text, formula_of(_dropped(step, *compared))


@explains("cull.plane.test")
def plane(step: StepValues) -> Said:
    """Whether all corners are outside one plane."""
    distances, name, noun = step.vector("distances"), step.text("plane"), step.nouns.corner
    numbers, compared = _each("d", "distance", "<", distances)
    inside = sum(not value < 0 for value in distances)
    small = ("no", "one", "two")
    number = "all" if inside == len(distances) else small[inside] if inside < len(small) else str(inside)
    corners = f"{number} of its {noun}s {'are' if inside > 1 else 'is'} inside"
    outside, lie = f"all its {noun}s are outside", f"all of its {noun}s lie"
    if is_one := len(distances) == 1:
        corners, outside, lie = "it is inside", "it is outside", "it lies"
    if not any(distances):
        corners = f"{lie} on it, which counts as inside"
    verdict = f"is not outside the {name} plane: {corners}"
    if step.flag("applies"):
        verdict = f"is dropped: {outside} the {name} plane"
    listed = numbers if len(distances) > MOST_CORNERS else f"distance{'' if is_one else 's'} {numbers}"
    text = f"{step.name.capitalize()} {verdict} ({listed})."
    return text, formula_of(_dropped(step, *compared))


def decisive_area(step: StepValues) -> tuple[str, str]:
    """Return what decides the facing, and its symbol: the area, or the determinant where a w is not above 0."""
    has_area = all(value > 0 for value in step.vector("w"))
    if step.has("is_projected"):
        has_area = all(step.flags("is_projected"))
    return ("twice its signed area", "2A") if has_area else ("the determinant of its (x, y, w) matrix", "D")


@explains("cull.degenerate.test")
def degenerate(step: StepValues) -> Said:
    """Whether the triangle has an area."""
    name, symbol = decisive_area(step)
    value = step.named("facing", symbol)
    text = f"is not degenerate: {name} is {value}, not 0."
    if step.flag("applies"):
        text = f"is degenerate and dropped: {name} is 0."
    return f"{step.name.capitalize()} {text}", formula_of(_dropped(step, value.compared("=")))


@explains("cull.facing.test")
def facing(step: StepValues) -> Said:
    """Which side the eye sees, and whether the setting drops that side."""
    (name, symbol), value = decisive_area(step), step.number("facing")
    side, sign = ("front", "above") if value > 0 else ("back", "below")
    verdict, does = ("culled", "drops") if step.flag("applies") else ("kept", "keeps")
    text = (
        f"{step.name.capitalize()} is {verdict}: {name} is {spoken(value)}, {sign} 0, "
        f"so we see its {side}, which the cull setting {does}."
    )
    return text, formula_of(concludes("front", side, named(symbol, value).compared(">")))


@explains("cull.kept.verdict")
def kept(step: StepValues) -> Said:
    """No test applied."""
    text = f"{step.name.capitalize()} is kept: none of the tests drops it."
    if step.has("flat_ring") and step.whole("flat_ring") >= 0:
        text += f" Ring {step.whole('flat_ring')} lies on one line: it encloses nothing."
    return text


shows(
    "cull",
    {
        "w": VariableText("w#", "w of the corner: above 0 is in front of the eye.", spread="edges"),
        "plane": VariableText("plane", "Plane of the view volume."),
        "distances": VariableText("d#", "Signed distance of the corner: below 0 is outside.", spread="edges"),
        "facing": VariableText(
            lambda step: decisive_area(step)[1],
            "Twice the signed area 2A, or the determinant D: above 0 is the front.",
        ),
        "applies": VariableText("applies", "Whether the test drops the triangle."),
        "verdict": VariableText(
            "verdict", "Whether the triangle is kept or culled; undecided before all tests."
        ),
    },
)
