"""Mistakes in counting the work for hidden surfaces: what is shaded, and what rays ask."""

from collections.abc import Sequence
from itertools import pairwise

from lessons.mistakes.twin import wrong_rule


def shaded_early(depths: Sequence[int], pixels: int) -> tuple[int]:
    """Return how many fragments of layers over all pixels are shaded, drawn in the order of their depths."""
    nearest, count = max(depths) + 1, 0
    for depth in depths:
        if depth < nearest:
            nearest, count = depth, count + 1
    return (count * pixels,)


def after_prepass(depths: Sequence[int]) -> tuple[int, int]:
    """Return how many fragments of a pixel are shaded after a prepass, and how many depth tests there are in all."""
    return min(len(depths), 1), 2 * len(depths)


def rays_ask(width: int, height: int, triangles: int) -> tuple[int, int]:
    """Return how often each triangle is asked by the rays of a picture, and the tests of all rays together."""
    return width * height, width * height * triangles


@wrong_rule(shaded_early, shows=((5, 3, 1), 12), hides=((1, 3, 5), 12))
def early_only_visible(depths: Sequence[int], pixels: int) -> tuple[int]:
    """Only what is seen in the end was counted. Where it comes late, what was nearest before it is shaded, too."""
    return (pixels if depths else 0,)


@wrong_rule(shaded_early, shows=((3, 5, 4), 12), hides=((5, 3, 1), 12))
def early_against_previous(depths: Sequence[int], pixels: int) -> tuple[int]:
    """Each depth was compared with the one before it. The depth buffer holds the nearest so far."""
    return ((1 + sum(new < old for old, new in pairwise(depths))) * pixels,)


@wrong_rule(shaded_early, shows=((1, 3, 5), 12), hides=((5, 3, 1), 12))
def early_shades_all(depths: Sequence[int], pixels: int) -> tuple[int]:
    """All fragments were counted. That is the late test, which shades before it compares."""
    return (len(depths) * pixels,)


@wrong_rule(after_prepass, shows=((5, 3, 1),), hides=((),))
def prepass_then_less(depths: Sequence[int]) -> tuple[int, int]:
    """After the prepass the test was still for less. No fragment is nearer than the nearest: ask for equal."""
    return (0, 2 * len(depths))


@wrong_rule(after_prepass, shows=((5, 3, 1),), hides=((),))
def prepass_tested_once(depths: Sequence[int]) -> tuple[int, int]:
    """Each fragment was tested once. A prepass draws all triangles twice, so each is tested twice."""
    return (min(len(depths), 1), len(depths))


@wrong_rule(rays_ask, shows=(4, 3, 2), hides=(1, 1, 2))
def ray_loops_swapped(width: int, height: int, triangles: int) -> tuple[int, int]:
    """Each triangle was counted once. That is the loop of the z-buffer; here every ray asks it again."""
    return (1, width * height * triangles)


@wrong_rule(rays_ask, shows=(4, 3, 2), hides=(4, 3, 1))
def ray_asks_one(*size: int) -> tuple[int, int]:
    """One test was counted for each ray. It asks all triangles before it knows the nearest."""
    return (size[0] * size[1], size[0] * size[1])
