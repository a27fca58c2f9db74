"""What is said of edge functions in other numbers: corners that are rounded, the inverse, values by additions."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import spoken, vector_text
from core.explain.sentences.edges import box_high
from core.explain.step_values import StepValues


def number_format(step: StepValues) -> str:
    """Return the name of the numbers that coverage is decided in; that of a step without one is ``snapped``."""
    return step.text("number_format") if step.has("number_format") else "snapped"


def rounded(step: StepValues) -> str:
    """A corner rounded to the format."""
    before, after = step.vector("homogeneous"), step.vector("rounded")
    name = f"Corner {step.whole('corner')} of triangle {step.triangle}"
    form = number_format(step)
    if before == after:
        return f"{name} stays at (x, y, w) = {vector_text(before)}: {form} has these numbers."
    if not all(map(math.isfinite, after)):
        return f"{name}, {vector_text(before)}, is too large for {form}, which makes it {vector_text(after)}."
    moved = max(abs(a - b) for a, b in zip(after, before, strict=True))
    return (
        f"{name} is rounded to {form}, (x, y, w) = {vector_text(after)}, which changes a number by up to "
        f"{spoken(moved)}."
    )


def determinant(step: StepValues) -> str:
    """The determinant that the inverse is divided by."""
    value = step.number("doubled_area")
    text = (
        f"Elimination gives the matrix of corners of triangle {step.triangle} the determinant {spoken(value)}"
    )
    if value == 0:
        return f"{text}: it has no inverse, and nothing is drawn."
    return f"{text}, by which the inverse is divided, so that its edge functions are positive inside."


def inverse_coefficient(step: StepValues) -> str:
    """One entry of the inverse."""
    k, name = step.whole("edge"), step.operation
    value = spoken(step.number(name))
    row = "abc".index(name)
    meaning = {
        "a": f"so E{k} changes by that with every pixel to the right",
        "b": f"so E{k} changes by that with every pixel upwards",
        "c": f"the value of E{k} at the window's origin",
    }[name]
    return f"Edge {k} is column {k} of the inverse: {name}, in row {row}, is {value}, {meaning}."


def outer_low(step: StepValues) -> str:
    """The lower left corner of a box around corners that are not snapped."""
    x, y = zip(*step.rows("corners"), strict=True)
    return (
        f"The box of triangle {step.triangle} begins at column {step.whole('column')} and row {step.whole('row')}: its "
        f"least x, {spoken(min(x))}, and y, {spoken(min(y))}, are rounded down to whole pixels first, to be safe."
    )


def added_value(step: StepValues) -> str:
    """One edge function, from that of the neighbour."""
    k = int(step.operation.removeprefix("edge-"))
    value, before = step.number(f"value_{k}"), step.number(f"before_{k}")
    slope, neighbour = ("a", "to the left") if step.kind == "step" else ("b", "below")
    text = (
        f"{step.pixel_name}: E{k} is {spoken(value)}, from {spoken(before)} at the pixel {neighbour} and "
        f"{slope}{k} = {spoken(step.vector(slope)[k])}"
    )
    if math.isnan(value):
        return f"{text}, which is no number, so it is outside edge {k}."
    if value == 0:
        return f"{text}: it lies exactly on edge {k}."
    return f"{text}, so it is {'inside' if value > 0 else 'outside'} edge {k}."


def replaced_fill(fill: str, coverage: str) -> str:
    """Return why a fill by spans was replaced, as the pipeline rail says it."""
    return (
        f"Every pixel of the bounding box is tested: {fill} is made for float64 numbers, and coverage {coverage} "
        "computes in others."
    )


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "edges.rounded.round": rounded,
    "edges.determinant.area": determinant,
    **{f"edges.inverse-edge.{name}": inverse_coefficient for name in "abc"},
    "bin.outer-box.low": outer_low,
    "bin.outer-box.high": box_high,
    **{f"raster.{kind}.edge-{k}": added_value for kind in ("step", "climb") for k in range(3)},
}
