"""What is said of the depth test: one sentence for every key, whatever the depth buffer holds."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import pair_text, spoken
from core.explain.sentences import rays as sentences_rays
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import StepValues


def depth_stored(step: StepValues) -> str:
    """What the depth method stores of a fragment."""
    stored, quantity = spoken(step.number("stored")), step.depth_quantity()
    if quantity == "inverse-w":
        return f"{pixel_name(step)}: 1/w is {spoken(step.number('inverse_w'))}, to be stored as {stored}."
    if quantity != "z":
        value = step.number("value")
        limited = "" if 0 <= value <= 1 else "limited to 0 to 1 and "
        return f"{pixel_name(step)}: {step.depth_name()} {spoken(value)} is {limited}stored as the float32 {stored}."
    text = f"{pixel_name(step)}: its depth z is {spoken(step.number('depth'))}, to be stored as {stored}"
    return f"{text} of {step.whole('scale'):,} steps." if step.has("scale") else f"{text}."


def value_made(step: StepValues) -> str:
    """The reversed or the logarithmic depth, before it is rounded."""
    name, value, depth = pixel_name(step), spoken(step.number("value")), spoken(step.number("depth"))
    if step.depth_quantity() == "reversed-z":
        where = "along the outline" if step.has("t") else "on the triangle's plane"
        text = f"{name}: {where}, from 1 at the near plane to 0 at the far plane"
        return f"{text}, the reversed z is {value} (z = {depth})."
    near, far = (spoken(step.number(end)) for end in ("near", "far"))
    return (
        f"{name}: on a scale of octaves from w = {near} to w = {far}, 1/w = {spoken(step.number('inverse_w'))} "
        f"is at {value} (z = {depth})."
    )


def compared(step: StepValues) -> str:
    """The depth test."""
    stored, before = step.number("stored"), step.number("before")
    new, old = pair_text(stored, before)
    name, quantity = pixel_name(step), step.depth_name()
    if math.isnan(stored) or math.isnan(before):
        return f"{name} fails: its {quantity}, {new}, cannot be compared with the buffer's {old}."
    if stored == before:
        return f"{name} fails: its {quantity}, {new}, equals the buffer's: a tie keeps what is there."
    verdict, outcome = ("passes", "nearer") if step.flag("passes") else ("fails", "hidden")
    relation = "larger" if stored > before else "smaller"
    return f"{name} {verdict}: its {quantity}, {new}, is {relation} than the buffer's {old}: it is {outcome}."


def depth_written(step: StepValues) -> str:
    """What the depth buffer holds after the test."""
    after, before = pair_text(step.number("after"), step.number("before"))
    triangle = f"triangle {step.triangle}"
    if step.flag("passes") and not step.flag("writes"):
        return _let_through(step)
    if step.flag("passes"):
        return f"{pixel_name(step)}: the depth buffer now holds {after}, of {triangle}, instead of {before}."
    return f"{pixel_name(step)}: the depth buffer keeps {before}, and {triangle} is not seen here."


def _let_through(step: StepValues) -> str:
    """A pale pixel of a line, which is not stored."""
    return (
        f"{pixel_name(step)}: the depth buffer keeps {spoken(step.number('before'))}, as the line covers less than "
        "half of this pixel and must not hide what is drawn there later."
    )


def out_of_range(step: StepValues) -> str:
    """A fragment before the near or behind the far plane."""
    depth = step.number("depth")
    text = f"{pixel_name(step)} is dropped: its depth z is {spoken(depth)}"
    if math.isnan(depth):
        return f"{text}, which is no number."
    return f"{text}, " + (
        "below 0: before the near plane." if depth < 0 else "above 1: behind the far plane."
    )


def untested(step: StepValues) -> str:
    """A fragment written without a test."""
    if not step.flag("writes"):
        return _let_through(step)
    after, before = pair_text(step.number("after"), step.number("before"))
    return f"{pixel_name(step)}: without a depth test {after} simply replaces {before} in the depth buffer."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "depth.test.value": value_made,
    "depth.test.depth": depth_stored,
    "depth.test.compare": compared,
    "depth.test.write": depth_written,
    "depth.out-of-range.range": out_of_range,
    "depth.store.value": value_made,
    "depth.store.depth": depth_stored,
    "depth.store.write": untested,
    **sentences_rays.SENTENCES,
}
