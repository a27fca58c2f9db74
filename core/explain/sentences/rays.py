"""What is said of ray casting: one sentence for every key."""

import math
from collections.abc import Callable, Mapping

from core.explain.number_text import pair_text, spoken
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import StepValues


def measure(step: StepValues) -> str:
    """What tells which of two hits is nearer: the larger one is."""
    return "1/w" if step.flag("by_w") else "−z/w"


def hit(step: StepValues) -> str:
    """Where the ray meets a triangle."""
    triangle, value = f"triangle {step.triangle}", spoken(step.number("nearness"))
    if math.isinf(step.number("error")):
        return (
            f"{pixel_name(step)}: the ray runs in the plane of {triangle}, or so nearly that float64 cannot tell "
            f"where it meets it; {value} stands for that."
        )
    return (
        f"{pixel_name(step)}: the ray meets {triangle} at {measure(step)} = {value}, "
        f"give or take {spoken(step.number('error'))}."
    )


def first(step: StepValues) -> str:
    """The first hit of a ray."""
    return f"{pixel_name(step)}: the ray has met nothing before, so triangle {step.triangle} is the nearest so far."


def compared(step: StepValues) -> str:
    """A hit that float64 tells from the nearest so far."""
    new, old = pair_text(step.number("nearness"), step.number("nearest_nearness"))
    verdict, word = ("passes", "larger") if step.flag("passes") else ("fails", "smaller")
    return (
        f"{pixel_name(step)} {verdict}: {measure(step)} {new} is {word} than {old} of triangle "
        f"{step.whole('nearest')}, and by more than both errors together."
    )


def doubted(step: StepValues) -> str:
    """A hit that float64 cannot tell from the nearest so far."""
    errors = step.number("error") + step.number("nearest_error")
    difference = abs(step.number("nearness") - step.number("nearest_nearness"))
    if math.isinf(errors):
        return f"{pixel_name(step)}: float64 knows one of the two hits not at all, so it cannot decide."
    return (
        f"{pixel_name(step)}: triangle {step.whole('nearest')} is {spoken(difference)} away in {measure(step)}, "
        f"within the errors of {spoken(errors)}: float64 cannot decide."
    )


def exact(step: StepValues) -> str:
    """The comparison in whole numbers."""
    sign, nearest = step.whole("sign"), f"triangle {step.whole('nearest')}"
    if sign == 0:
        return f"{pixel_name(step)} fails: in whole numbers it is exactly as near as {nearest}, and a tie keeps that."
    verdict, word = ("passes", "nearer") if sign > 0 else ("fails", "farther")
    return f"{pixel_name(step)} {verdict}: compared in whole numbers, without any error, it is {word} than {nearest}."


def written(step: StepValues) -> str:
    """Which triangle the ray has as its nearest now."""
    seen = f"triangle {step.triangle}" if step.flag("passes") else f"triangle {step.whole('nearest')}"
    verb = "is now" if step.flag("passes") else "is still"
    return f"{pixel_name(step)}: {seen} {verb} the nearest that the ray has met."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **{f"depth.{kind}.hit": hit for kind in ("ray-first", "ray", "ray-exact")},
    "depth.ray-first.keep": first,
    "depth.ray.compare": compared,
    "depth.ray-exact.doubt": doubted,
    "depth.ray-exact.exact": exact,
    "depth.ray.write": written,
    "depth.ray-exact.write": written,
}
