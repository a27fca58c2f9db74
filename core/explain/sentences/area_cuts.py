"""What is said where the edges of a triangle cut the square of a pixel (exact areas)."""

from collections.abc import Callable, Mapping
from math import isnan

from core.explain.number_text import spoken
from core.explain.sentences.raster import pixel_name
from core.explain.step_values import StepValues

SHAPES = {3: "a triangle", 4: "a quadrilateral", 5: "a pentagon", 6: "a hexagon", 7: "a heptagon"}
FULL = 1 - 2.0**-40
"""Area in pixels from which a pixel is called whole: sums of areas are rounded."""


def distances(step: StepValues) -> str:
    """The edge function at the corners of the polygon that is there."""
    values = [value for value in step.vector("corner_distance") if not isnan(value)]
    outside = sum(value < 0 for value in values)
    edge = f"edge {step.whole('edge')} of triangle {step.triangle}"
    if not outside:
        return f"{pixel_name(step)}: no corner lies beyond {edge}, so it cuts nothing off."
    verb = "lies" if outside == 1 else "lie"
    return (
        f"{pixel_name(step)}: {outside} of {len(values)} corners {verb} beyond {edge}, where it is negative."
    )


def cut(step: StepValues) -> str:
    """What an edge leaves of the polygon."""
    count = step.whole("corner_count")
    if not count:
        return f"{pixel_name(step)}: edge {step.whole('edge')} leaves nothing of it that has an area."
    return f"{pixel_name(step)}: edge {step.whole('edge')} leaves {SHAPES[count]}."


def area(step: StepValues) -> str:
    """The area of what three edges have left."""
    count, value = step.whole("corner_count"), step.number("piece_area")
    name = f"{pixel_name(step)}: triangle {step.triangle}"
    if not count:
        return f"{name} touches it at most in a point or along a side, which has no area."
    if value == 1:
        return f"{name} covers all of its square."
    return f"{name} covers {SHAPES[count]} of it, and half the sum of the cross products is its area, {spoken(value)}."


def seen(step: StepValues) -> str:
    """How much of it passes the depth test."""
    value, whole = step.number("seen_area"), step.number("piece_area")
    name = f"{pixel_name(step)}: triangle {step.triangle}"
    if not value:
        return f"{name} is in front of nothing here, and shows nothing of itself."
    if value >= whole * FULL:
        return f"{name} is in front of all that was there, and shows {spoken(value)} of the pixel."
    return f"{name} shows {spoken(value)} of the pixel, and the rest of it lies behind what was there."


def cover(step: StepValues) -> str:
    """How much of the pixel any triangle covers by now."""
    value = step.number("covered_area")
    if value >= FULL:
        return f"{pixel_name(step)}: triangles cover all of it by now."
    return f"{pixel_name(step)}: triangles cover {spoken(value)} of it by now, and the background is seen in the rest."


SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    "resolve.cut.distances": distances,
    "resolve.cut.cut": cut,
    "resolve.piece.area": area,
    "resolve.piece.seen": seen,
    "resolve.piece.cover": cover,
}
