"""Mistakes in counting the work for hidden surfaces: what is shaded, and what rays ask."""

from collections.abc import Sequence
from itertools import pairwise

from lessons.mistakes.twin import WrongRule


def shaded_early(depths: Sequence[int], pixels: int) -> tuple[int]:
    """Return how many fragments of layers over all pixels are shaded, drawn in the order of their depths."""
    nearest, count = max(depths) + 1, 0
    for depth in depths:
        if depth < nearest:
            nearest, count = depth, count + 1
    return (count * pixels,)


def shaded_against_previous(depths: Sequence[int], pixels: int) -> tuple[int]:
    """Compare each depth with the one before it alone."""
    return ((1 + sum(new < old for old, new in pairwise(depths))) * pixels,)


def after_prepass(depths: Sequence[int]) -> tuple[int, int]:
    """Return how many fragments of a pixel are shaded after a prepass, and how many depth tests there are in all."""
    return min(len(depths), 1), 2 * len(depths)


def rays_ask(width: int, height: int, triangles: int) -> tuple[int, int]:
    """Return how often each triangle is asked by the rays of a picture, and the tests of all rays together."""
    return width * height, width * height * triangles


RULES = (
    WrongRule(
        "early-only-visible",
        "Only what is seen in the end was counted. Where it comes late, what was nearest before it is shaded, too.",
        shaded_early,
        lambda depths, pixels: (pixels if depths else 0,),
        ((5, 3, 1), 12),
        ((1, 3, 5), 12),
    ),
    WrongRule(
        "early-against-previous",
        "Each depth was compared with the one before it. The depth buffer holds the nearest so far.",
        shaded_early,
        shaded_against_previous,
        ((3, 5, 4), 12),
        ((5, 3, 1), 12),
    ),
    WrongRule(
        "early-shades-all",
        "All fragments were counted. That is the late test, which shades before it compares.",
        shaded_early,
        lambda depths, pixels: (len(depths) * pixels,),
        ((1, 3, 5), 12),
        ((5, 3, 1), 12),
    ),
    WrongRule(
        "prepass-then-less",
        "After the prepass the test was still for less. No fragment is nearer than the nearest: ask for equal.",
        after_prepass,
        lambda depths: (0, 2 * len(depths)),
        ((5, 3, 1),),
        ((),),
    ),
    WrongRule(
        "prepass-tested-once",
        "Each fragment was tested once. A prepass draws all triangles twice, so each is tested twice.",
        after_prepass,
        lambda depths: (min(len(depths), 1), len(depths)),
        ((5, 3, 1),),
        ((),),
    ),
    WrongRule(
        "ray-loops-swapped",
        "Each triangle was counted once. That is the loop of the z-buffer; here every ray asks it again.",
        rays_ask,
        lambda width, height, triangles: (1, width * height * triangles),
        (4, 3, 2),
        (1, 1, 2),
    ),
    WrongRule(
        "ray-asks-one",
        "One test was counted for each ray. It asks all triangles before it knows the nearest.",
        rays_ask,
        lambda *size: (size[0] * size[1], size[0] * size[1]),
        (4, 3, 2),
        (4, 3, 1),
    ),
)
