"""What is said of depth on integer planes and of packed keys: one sentence for every key."""

from collections.abc import Callable, Mapping

from core.explain.number_text import spoken
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import KEY_NUMBER_BITS, StepValues, key_text


def _whole(step: StepValues, name: str) -> str:
    """Write a whole number in full, with a true minus sign."""
    return f"{step.whole(name):,}".replace("-", "−")


def plane(step: StepValues) -> str:
    """Depth as an integer plane."""
    return (
        f"{pixel_name(step)}: on the triangle's integer plane the depth is {_whole(step, 'stored')} of "
        f"2³⁸ (z = {spoken(step.number('depth'))})."
    )


def rounded(step: StepValues) -> str:
    """Depth that is rounded at the pixel."""
    return (
        f"{pixel_name(step)}: this triangle has no integer plane, so z = {spoken(step.number('depth'))} is "
        f"rounded here, to {_whole(step, 'stored')} of 2³⁸."
    )


def key(step: StepValues) -> str:
    """Depth and triangle packed into a key."""
    return (
        f"{pixel_name(step)}: its key is {key_text(step.whole('key'))}, the depth above the lower 24 bits, "
        f"which hold the number of triangle {step.whole('number')} plus one."
    )


def minimum(step: StepValues) -> str:
    """The depth test as the minimum of two keys."""
    new, old = step.whole("key"), step.whole("before_key")
    name, there = pixel_name(step), _holder(old)
    if new < old:
        return f"{name} passes: its key is less than the buffer's {key_text(old)}, of {there}."
    if new >> KEY_NUMBER_BITS == old >> KEY_NUMBER_BITS:
        return f"{name} fails: the depths tie, and {there} has the lower number, as it came first."
    return f"{name} fails: the buffer's key, {key_text(old)} of {there}, is the lesser one."


def _holder(key: int) -> str:
    """Say whose key it is."""
    number = key & ((1 << KEY_NUMBER_BITS) - 1)
    return f"triangle {number - 1}" if number else "the empty buffer"


def key_written(step: StepValues) -> str:
    """The key in the buffer after the test."""
    after = step.whole("after_key")
    if step.flag("passes") and not step.flag("writes"):
        return (
            f"{pixel_name(step)}: the buffer keeps {key_text(after)}, of {_holder(after)}, as the line covers less "
            "than half of this pixel."
        )
    verb = "now holds" if step.flag("passes") else "keeps"
    return f"{pixel_name(step)}: the buffer {verb} the lesser key, {key_text(after)}, of {_holder(after)}."


def plane_written(step: StepValues) -> str:
    """A depth on a plane that is written without a test."""
    return (
        f"{pixel_name(step)}: without a depth test {_whole(step, 'after')} simply replaces "
        f"{_whole(step, 'before')} in the depth buffer."
    )


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "depth.test.plane": plane,
    "depth.plane.plane": plane,
    "depth.rounded.depth": rounded,
    **{f"depth.{kind}.key": key for kind in ("test", "rounded")},
    **{f"depth.{kind}.minimum": minimum for kind in ("test", "rounded")},
    "depth.rounded.write": key_written,
    "depth.plane.write": plane_written,
}
