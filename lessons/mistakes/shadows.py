"""Mistakes with shadow maps: faulty look-ups that can be run, and wrong comparisons by hand."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from core import Settings
from core.records.arrays import Floats
from core.shading.shadows import Lamp, MapTests, shadow_map
from lessons.mistakes.twin import Case, Twin, wrong_rule
from lessons.world_scenes import box_in_light

# Faulty look-ups.


def y_flipped(position: Floats, lamp: Lamp) -> MapTests:
    """Count the rows of the map from the top."""
    assert lamp.depth is not None
    return shadow_map(position, replace(lamp, depth=lamp.depth[::-1]))


def bias_subtracted(position: Floats, lamp: Lamp) -> MapTests:
    """Move each point away from the light, not towards it."""
    return shadow_map(position, replace(lamp, bias=-lamp.bias))


def depth_in_ndc(position: Floats, lamp: Lamp) -> MapTests:
    """Compare depth from -1 to 1 with depth from 0 to 1."""
    to_map = lamp.to_map.copy()
    to_map[2] *= 2
    to_map[2, 3] -= 1
    return shadow_map(position, replace(lamp, to_map=to_map))


def looked_up_by(wrong: Callable[[Floats, Lamp], MapTests]) -> Callable[[Settings], Settings]:
    """Return what looks into a shadow map in another way, where settings have one."""
    return lambda settings: settings.replaced(shadow=wrong) if settings.shadow == "map" else settings


def box(**numbers: Any) -> Case:
    """Return the box in the light, small, with a shadow map."""
    scene: Any = replace(box_in_light(), size=(24, 18))
    return Case(scene, Settings(shadow="map", **numbers))


def from_below() -> Case:
    """Return the floor alone, with a bias that no mistake of half a texel comes near."""
    scene: Any = replace(box_in_light(), meshes=box_in_light().meshes[:1], size=(24, 18))
    return Case(scene, Settings(shadow="map", map_size=16, shadow_bias=1024))


TWINS = (
    Twin(
        "shadow-map-upside-down",
        "The rows of the shadow map were counted from the top. The texture's row 0 is at the bottom, as the window's.",
        box(),
        from_below(),
        looked_up_by(y_flipped),
    ),
    Twin(
        "shadow-bias-subtracted",
        "The bias was subtracted from the stored depth. It must be added, so that a surface does not shadow itself.",
        box(),
        box(shadow_bias=0),
        looked_up_by(bias_subtracted),
    ),
    Twin(
        "shadow-depth-in-ndc",
        "Depth from -1 to 1 was compared with the map's depth from 0 to 1. Both must be window depth.",
        box(),
        from_below(),
        looked_up_by(depth_in_ndc),
    ),
)

# Wrong comparisons.

Point = tuple[int, int]
"""The texel of a point, and its depth from the light."""


def lit_points(stored: Sequence[int], bias: int, points: Sequence[Point]) -> tuple[int, ...]:
    """Return the places of points that are lit: in a row of texels, no farther than what is stored and the bias."""
    return tuple(
        place
        for place, (texel, depth) in enumerate(points)
        if not 0 <= texel < len(stored) or depth <= stored[texel] + bias
    )


def mean_of_comparisons(stored: Sequence[int], depth: int) -> tuple[Fraction]:
    """Return the share of the light: of the texels that store no less than the depth."""
    return (Fraction(sum(depth <= texel for texel in stored), len(stored)),)


ROW, POINTS = (4, 4, 9), ((0, 4), (1, 5), (2, 9), (5, 7))


@wrong_rule(lit_points, shows=(ROW, 1, POINTS), hides=(ROW, 0, POINTS))
def shadow_bias_wrong_way(stored: Sequence[int], bias: int, points: Sequence[Point]) -> tuple[int, ...]:
    """The bias was subtracted. It is added to what the map stores, so that a surface does not shadow itself."""
    return lit_points(stored, -bias, points)


@wrong_rule(lit_points, shows=(ROW, 1, POINTS), hides=(ROW, 1, POINTS[:3]))
def shadow_outside_dark(stored: Sequence[int], bias: int, points: Sequence[Point]) -> tuple[int, ...]:
    """Points outside of the map were taken for dark. Nothing is known to stand in their light: they are lit."""
    inside = [place for place, (texel, _) in enumerate(points) if 0 <= texel < len(stored)]
    return tuple(place for place in lit_points(stored, bias, points) if place in inside)


@wrong_rule(lit_points, shows=(ROW, 1, POINTS), hides=(ROW, 1, ()))
def shadow_compared_backwards(stored: Sequence[int], bias: int, points: Sequence[Point]) -> tuple[int, ...]:
    """The comparison was turned round. What lies behind the stored depth is in the shadow."""
    lit = lit_points(stored, bias, points)
    return tuple(place for place in range(len(points)) if place not in lit)


@wrong_rule(mean_of_comparisons, shows=((2, 8, 8, 8), 5), hides=((8, 8, 8, 8), 5))
def shadow_depths_averaged(stored: Sequence[int], depth: int) -> tuple[Fraction]:
    """The depths were averaged, then compared. A mean of two surfaces is none of them: average the comparisons."""
    return (Fraction(int(depth <= float(np.mean(stored)))),)


@wrong_rule(mean_of_comparisons, shows=((2, 8, 8, 8), 5), hides=((2, 2, 8, 8), 5))
def shadow_share_hidden(stored: Sequence[int], depth: int) -> tuple[Fraction]:
    """The texels that hide the light were counted. The share of the light is that of the others."""
    return (1 - mean_of_comparisons(stored, depth)[0],)
