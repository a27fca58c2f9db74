"""Culling by N . V: the face normal, the vector to the face, their product."""

from collections.abc import Sequence

from core.explain.digits import remainder_note, spoken, vector_text
from core.explain.formulas import concludes, formula_of, named, total
from core.explain.rows import REMARKS, Said, explains
from core.explain.statements import Chain
from core.explain.step_values import StepValues
from core.explain.subjects.culling import decisive_area
from core.explain.term_latex import Written
from core.explain.variable_text import VariableText, shows
from core.records.terms import Operation, Term


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
