"""What is said of affine interpolation that is corrected every n pixels: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import joined, spoken, vector_text
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import StepValues


def row(step: StepValues) -> str:
    """Where the triangle begins and ends in the pixel's row."""
    left, right = step.vector("row_ends")
    if math.isinf(left) or math.isinf(right):
        return f"{pixel_name(step)}: the triangle is seen edge-on, so its row has no ends."
    return (
        f"{pixel_name(step)}: in this row the triangle, not snapped, reaches from x = {spoken(left)} "
        f"to x = {spoken(right)}."
    )


def anchors(step: StepValues) -> str:
    """The two places that are interpolated with perspective."""
    left, right = step.vector("anchor_x")
    before, behind = step.vector("grid")
    n, x = step.whole("interval"), step.number("x")
    columns = (
        f"the columns of whole multiples of {n} beside it are at x = {spoken(before)} and {spoken(behind)}"
    )
    if left == right:
        return (
            f"{pixel_name(step)}: {columns}, but the centre is not between the ends of the triangle's row, "
            f"so it is its own anchor, x = {spoken(x)}."
        )
    text = f"{pixel_name(step)}: {columns}, so its anchors are x = {spoken(left)} and x = {spoken(right)}"
    moved = [
        side
        for side, anchor, of_grid in (("left", left, before), ("right", right, behind))
        if anchor != of_grid
    ]
    if moved:
        verb = "ends" if len(moved) == 2 else "end"
        return f"{text}, the {joined(moved)} {verb} moved to where the triangle's row ends."
    return text + "."


def fraction(step: StepValues) -> str:
    """How far the pixel is between its anchors."""
    t = step.number("fraction")
    if t == 0:
        return f"{pixel_name(step)}: its centre is at the left anchor, t = 0."
    return f"{pixel_name(step)}: its centre is t = {spoken(t)} of the way from the left to the right anchor."


def corrected(step: StepValues) -> str:
    """The perspective-correct weights at the anchors."""
    left, right = (vector_text(values) for values in step.rows("anchor_weights"))
    return (
        f"{pixel_name(step)}: with the division by 1/w the weights are {left} at the left anchor and {right} "
        "at the right one."
    )


def weights(step: StepValues) -> str:
    """The weights, linear between the anchors."""
    t, values = step.number("fraction"), step.vector("weights")
    text = (
        f"{pixel_name(step)}: {spoken(1 - t)} of the left and {spoken(t)} of the right anchor's weights give "
        f"corners 0, 1 and 2 the weights {joined([spoken(value) for value in values])}"
    )
    if any(map(math.isnan, values)):
        return f"{text}; NaN means that 1/w is 0 at an anchor."
    return f"{text}, without a division."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "interpolate.affine-n.row": row,
    "interpolate.affine-n.anchors": anchors,
    "interpolate.affine-n.fraction": fraction,
    "interpolate.affine-n.corrected": corrected,
    "interpolate.affine-n.weights": weights,
}
