"""Mistakes with occluders: pyramids that keep another depth than the farthest, and wrong comparisons by hand."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from core import Settings
from core.culling.occlusion import BoxesOnScreen, OcclusionTests, compare_with_pyramid, pyramid_of
from core.depth.depth import Stored
from lessons.mistakes.twin import Case, Twin, wrong_rule
from lessons.world_scenes import boxes_behind_wall

# Faulty pyramids.


def nearest_kept(boxes: BoxesOnScreen, depth: Stored, larger_is_nearer: bool) -> OcclusionTests:
    """Keep the nearest of 2 x 2 texels."""
    pyramid = pyramid_of(depth, np.maximum if larger_is_nearer else np.minimum)
    return compare_with_pyramid(boxes, pyramid, larger_is_nearer)


def mean_kept(boxes: BoxesOnScreen, depth: Stored, larger_is_nearer: bool) -> OcclusionTests:
    """Keep the mean of 2 x 2 texels."""
    sums, counts = pyramid_of(depth, np.add), pyramid_of(np.ones(depth.shape), np.add)
    means = tuple(total / count for total, count in zip(sums, counts, strict=True))
    return compare_with_pyramid(boxes, means, larger_is_nearer)


def compared_by(
    wrong: Callable[[BoxesOnScreen, Stored, bool], OcclusionTests],
) -> Callable[[Settings], Settings]:
    """Return what compares boxes in another way, where settings have occluders."""
    return lambda settings: (
        settings.replaced(object_culling=wrong) if settings.object_culling == "occlusion" else settings
    )


BEHIND = Settings(object_culling="occlusion", hierarchy="none", occluders=1)


def wall(*shown: int) -> Case:
    """Return the wall with some of the boxes behind it."""
    scene: Any = boxes_behind_wall()
    return Case(replace(scene, meshes=tuple(scene.meshes[k] for k in shown)), BEHIND)


TWINS = (
    Twin(
        "nearest-in-pyramid",
        "Each texel of the pyramid kept the nearest depth of those below it. It must keep the farthest, or a box is "
        "dropped that looks out where the occluders are farther.",
        wall(0, 5),
        wall(0, 2),
        compared_by(nearest_kept),
    ),
    Twin(
        "mean-in-pyramid",
        "Each texel of the pyramid kept the mean of the depths below it. No surface need lie there: it must keep the "
        "farthest.",
        wall(0, 5),
        wall(0, 2),
        compared_by(mean_kept),
    ),
)

# Wrong comparisons.

Box = tuple[int, int, tuple[int, ...]]
"""Nearest and farthest depth, and what the texels of its rectangle store."""


def hidden_boxes(boxes: Sequence[Box]) -> tuple[int, ...]:
    """Return the places of boxes that are hidden: even the nearest depth is farther than the farthest texel."""
    return tuple(place for place, (near, _, texels) in enumerate(boxes) if near > max(texels))


def coarser(depths: Sequence[Sequence[int]], keep: Callable[[list[int]], Any]) -> tuple[Any, ...]:
    """Return the level over 4 x 4 depths, row by row: what a texel keeps of each 2 x 2."""
    squares = [[depths[y + j][x + i] for j in (0, 1) for i in (0, 1)] for y in (0, 2) for x in (0, 2)]
    return tuple(keep(square) for square in squares)


def farthest_level(depths: Sequence[Sequence[int]]) -> tuple[int, ...]:
    """Keep the farthest."""
    return coarser(depths, max)


DEPTHS = ((9, 4, 4, 4), (4, 4, 4, 9), (4, 4, 4, 4), (4, 5, 4, 4))
EVEN = ((4, 4, 9, 9), (4, 4, 9, 9), (5, 5, 4, 4), (5, 5, 4, 4))


@wrong_rule(hidden_boxes, shows=(((6, 8, (4, 9)),),), hides=(((6, 8, (4, 5)),),))
def compared_with_nearest_texel(boxes: Sequence[Box]) -> tuple[int, ...]:
    """The box was compared with the nearest texel.

    Where another texel is farther, it may look out: only behind the farthest of them is it surely hidden.
    """
    return tuple(place for place, (near, _, texels) in enumerate(boxes) if near > min(texels))


@wrong_rule(hidden_boxes, shows=(((4, 8, (5, 5)),),), hides=(((6, 8, (5, 5)),),))
def far_side_compared(boxes: Sequence[Box]) -> tuple[int, ...]:
    """The farthest depth of the box was compared. Its near side may still be seen: compare the nearest."""
    return tuple(place for place, (_, far, texels) in enumerate(boxes) if far > max(texels))


@wrong_rule(farthest_level, shows=(DEPTHS,), hides=(EVEN,), twin=TWINS[0])
def nearest_level(depths: Sequence[Sequence[int]]) -> tuple[int, ...]:
    """Keep the nearest."""
    return coarser(depths, min)


@wrong_rule(farthest_level, shows=(DEPTHS,), hides=(EVEN,), twin=TWINS[1])
def mean_level(depths: Sequence[Sequence[int]]) -> tuple[Fraction, ...]:
    """Keep the mean."""
    return coarser(depths, lambda square: Fraction(sum(square), 4))
