"""Culling, told step by step: the tests that drop a whole triangle, by outcodes, area, or N . V."""

from collections.abc import Sequence

from core.explain.formulas import Chain, Conclusion, concludes, formula_of, named, total
from core.explain.number_text import listed, remainder_note, spoken, vector_text
from core.explain.step_values import REMARKS, Said, StepValues, explains
from core.explain.steps import VariableText, shows
from core.explain.term_latex import Written
from core.records.terms import Operation, Term
from core.records.words import counted, numbered

# Culling: the tests that drop a whole triangle.


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


# Culling by N . V: the face normal, the vector to the face, their product.


def _sides(step: StepValues, corners: str) -> tuple[list[float], list[float]]:
    """Return the sides from corner 0 to corners 1 and 2."""
    a, b, c = step.rows(corners)
    return [y - x for x, y in zip(a, b, strict=True)], [y - x for x, y in zip(a, c, strict=True)]


def _cross(name: str, value: list[float], sides: tuple[list[float], list[float]], point: str) -> Chain:
    first, second = (named(f"({point}_{k} - {point}_0)", side) for k, side in enumerate(sides, 1))
    return named(name, value).equals(Operation("×", first, second))


@explains("cull.back-normal|back-axis.normal")
def normal(step: StepValues) -> Said:
    """The cross product of two sides in camera space."""
    value = step.vector("normal")
    text = (
        f"Triangle {step.triangle}: its normal is N = {vector_text(value)}, the cross product of two of its sides in "
        f"camera space, on the side from which the corners run counter-clockwise{remainder_note(value)}."
    )
    return text, formula_of(_cross("N", value, _sides(step, "eye_corners"), "p"))


@explains("cull.back-stored-normal.stored")
def stored(step: StepValues) -> Said:
    """The same in object space, before anything is transformed."""
    value = step.vector("stored")
    text = (
        f"Triangle {step.triangle}: its normal in object space is n = {vector_text(value)}, as the mesh may keep "
        f"it{remainder_note(value)}."
    )
    return text, formula_of(_cross("n", value, _sides(step, "object_corners"), "o"))


@explains("cull.back-stored-normal.determinant")
def determinant(step: StepValues) -> Said:
    """Whether the matrix to camera space can carry a normal."""
    value = step.number("determinant")
    text = f"Triangle {step.triangle}: the matrix A to camera space has determinant {spoken(value)}"
    if value < 0:
        text += ", below 0: it mirrors"
    elif value == 0:
        text += ": it has no inverse"
    return f"{text}.", formula_of(named(r"\det A", value))


@explains("cull.back-stored-normal.carried")
def carried(step: StepValues) -> Said:
    """Normals are carried by the inverse transpose; a mirror leaves them where they point."""
    value, determinant = step.vector("normal"), step.number("determinant")
    name = f"Triangle {step.triangle}"
    text = (
        f"{name}: the inverse transpose of the matrix to camera space carries it to N = {vector_text(value)}"
    )
    if determinant < 0:
        text += "; this matrix mirrors, which turns the corners around but not this normal"
    elif determinant == 0:
        text += ", since it has no inverse"
    stored = Operation("@", Written("A^{-T}"), named("n", step.vector("stored")))
    return f"{text}{remainder_note(value)}.", formula_of(named("N", value).equals(stored))


@explains("cull.back-normal|back-axis|back-stored-normal.view")
def view(step: StepValues) -> Said:
    """From the eye to the face, or the direction of the camera."""
    value = step.vector("view")
    if step.flag("is_parallel"):
        rest = (
            "for every face" if step.kind == "back-axis" else "as rays of an orthographic camera are parallel"
        )
        text = f"Triangle {step.triangle}: V = {vector_text(value)} is the direction of the camera, {rest}."
        return text, formula_of(named("V", value))
    text = f"Triangle {step.triangle}: V = {vector_text(value)} leads from the eye, at 0, to corner 0."
    return text, formula_of(named("V", value).equals(named("p_0", step.rows("eye_corners")[0])))


@explains("cull.back-normal|back-axis|back-stored-normal.product")
def product(step: StepValues) -> Said:
    """The sum of three products."""
    value = step.number("product")
    n, v = step.vector("normal"), step.vector("view")
    side = "along V" if value > 0 else "against V" if value < 0 else "at a right angle to V"
    made = named(r"N \cdot V", value).equals(by_axes("N", n, "V", v))
    return f"Triangle {step.triangle}: N · V is {spoken(value)}, so N points {side}.", formula_of(made)


def by_axes(first: str, one: Sequence[float], second: str, other: Sequence[float]) -> Term:
    """Return the product of two vectors, axis by axis: a long line breaks between them."""
    return total(
        named(f"{first}_{axis}", a) @ named(f"{second}_{axis}", b)
        for axis, a, b in zip("xyz", one, other, strict=True)
    )


@explains("cull.back-normal|back-axis|back-stored-normal.test")
def turned_away(step: StepValues) -> Said:
    """Above 0 is turned away; the determinant may say otherwise."""
    value, facing = step.number("product"), step.number("facing")
    verdict, sign = ("culled", "above 0") if step.flag("applies") else ("kept", "below 0")
    side = f"its {'back' if value > 0 else 'front'} faces the eye"
    if step.kind == "back-axis":
        # Which side the eye sees is another question, where rays are not parallel.
        side = f"it counts as a {'back' if value > 0 else 'front'}"
    if value == 0:
        sign, side = "not above 0", "the eye sees its edge"
    text = f"Triangle {step.triangle} is {verdict}: N · V is {spoken(value)}, {sign}, so {side}"
    if value * facing > 0:
        text += f"; {decisive_area(step)[0]}, {spoken(facing)}, says the other side"
    side = "back" if value > 0 else "front"
    return f"{text}.", formula_of(concludes("back", side, named(r"N \cdot V", value).compared(">")))


REMARKS["cull.back-normal|back-axis|back-stored-normal.test"] = lambda columns, rows: (
    columns["product"][rows] * columns["facing"][rows] > 0
)


shows(
    "cull",
    {
        "stored": VariableText("n", "Normal of the face in object space."),
        "determinant": VariableText(
            "det A", "Determinant of A, the matrix to camera space: below 0 it mirrors."
        ),
        "normal": VariableText("N", "Normal of the face in camera space."),
        "view": VariableText("V", "From the eye to the face, or the direction of the camera."),
        "product": VariableText("N · V", "Above 0: the face is turned away."),
    },
)
