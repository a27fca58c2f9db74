"""Mistakes of depth, blending and antialiasing beyond those of ``fragments``."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from core import Settings
from core.depth.depth import DepthFormat
from core.methods import table
from core.scene import ClipScene
from lessons.mistakes.fragments import ALPHA, CLEAR_RED, COLOR, OPAQUE, RED_AND_BLUE, WINDOW, in_over
from lessons.mistakes.transforms import Vector
from lessons.mistakes.twin import Case, Twin, frame_colors, wrong_rule
from lessons.small_scenes import triangle_scene


def cards(*depths: Sequence[float], alpha: float = 1.0) -> ClipScene:
    """Return cards over the whole window, red first, then blue, with the depths of their three corners."""
    colors = [(1, 0, 0, alpha), (0, 0, 1, alpha), (0, 1, 0, alpha)]
    attributes = [[colors[k % 3]] * 3 for k in range(len(depths))]
    return triangle_scene([WINDOW] * len(depths), (4, 4), depth=list(depths), attributes=attributes)


def cleared_to_near(settings: Settings) -> Settings:
    """Clear the depth buffer to the nearest depth."""
    right: DepthFormat = table.get("depth", settings.depth).function()
    wrong = replace(right, cleared=1.0 - right.cleared)
    return settings.replaced(depth=lambda: wrong)


def drawn_last_on_ties(scene: ClipScene) -> ClipScene:
    """Move every triangle a hair in front of those before it, so that of equal depths the last one wins."""
    clip = scene.clip.copy()
    clip[..., 2] -= 1e-6 * np.arange(len(clip))[:, None] * clip[..., 3]
    return replace(scene, clip=clip)


def first_is_nearest(scene: ClipScene) -> ClipScene:
    """Give each triangle a depth behind all before it, so that the first one drawn is kept."""
    clip = scene.clip.copy()
    depths = (np.arange(len(clip)) + 0.5) / len(clip)
    clip[..., 2] = (2 * depths - 1)[:, None] * clip[..., 3]
    return replace(scene, clip=clip)


def window_depth(near: Any, far: Any, distance: Any) -> Vector:
    """Return the window depth from 0 to 1 of a surface at a distance, with perspective."""
    return (Fraction(far) * (distance - near) / (Fraction(distance) * (far - near)),)


def depth_between(t: Any, depths: Vector, distances: Vector) -> Vector:
    """Return the window depth at t along an edge in the window: it is linear there."""
    return (depths[0] + t * (depths[1] - depths[0]),)


def distance_between(t: Any, distances: Vector) -> Vector:
    """Return the distance at t along an edge in the window: 1/w is linear there."""
    return (1 / ((1 - t) / Fraction(distances[0]) + t / Fraction(distances[1])),)


def painted_first(depths: Sequence[Vector]) -> Vector:
    """Return the triangles in the order of their farthest vertices, the farthest first."""
    return tuple(sorted(range(len(depths)), key=lambda k: -max(depths[k])))


@dataclass(frozen=True)
class Layer:
    """A triangle in one pixel: the samples it covers, its depth and its grey value."""

    samples: frozenset[int]
    depth: int
    grey: int


def resolved(layers: Sequence[Layer], count: int) -> Vector:
    """Return the mean of the samples over black, each sample with a depth of its own."""
    greys = [0] * count
    nearest = [10**9] * count
    for layer in layers:
        for sample in layer.samples:
            if layer.depth < nearest[sample]:
                nearest[sample], greys[sample] = layer.depth, layer.grey
    return (Fraction(sum(greys), count),)


def line_greys(grey: int, counts: Sequence[int]) -> Vector:
    """Return the grey of a pixel of a line over black with so many samples: all of them are written."""
    return tuple(Fraction(grey) for _ in counts)


NEAR_AND_FAR = cards([0.25] * 3, [0.75] * 3)
LEVEL = cards([0.5] * 3, [0.5] * 3)
GLASS = cards([0.25] * 3, [0.75] * 3, alpha=0.5)
TWO = (Layer(frozenset({0, 1}), 1, 8), Layer(frozenset({0, 1, 2, 3}), 2, 4))
ONE = (Layer(frozenset({0, 1}), 1, 8),)
BLENDED = Settings(blend="over", visibility="last-drawn")

TWINS = (
    Twin(
        "cleared-to-near",
        "The depth buffer was cleared to the nearest depth, so nothing passes. Clear it to the farthest.",
        Case(NEAR_AND_FAR),
        Case(NEAR_AND_FAR, Settings(visibility="last-drawn"), frame_colors),
        change_settings=cleared_to_near,
    ),
    Twin(
        "last-wins-ties",
        "Of equal depths the last one was kept. Here a tie keeps what is there.",
        Case(LEVEL, reading=frame_colors),
        Case(NEAR_AND_FAR, reading=frame_colors),
        change_scene=drawn_last_on_ties,
    ),
    Twin(
        "first-drawn-wins",
        "Depths were not compared, and a pixel that was drawn stayed: the first one drawn won.",
        Case(cards([0.75] * 3, [0.25] * 3), reading=frame_colors),
        Case(NEAR_AND_FAR, reading=frame_colors),
        change_scene=first_is_nearest,
    ),
    Twin(
        "inclusive-without-depth",
        "Every centre on an edge was counted (E >= 0), and depths were not compared: the last one drawn won.",
        Case(NEAR_AND_FAR),
        Case(cards([0.75] * 3, [0.25] * 3)),
        change_settings=lambda settings: replace(settings, fill_rule="inclusive", visibility="last-drawn"),
    ),
    Twin(
        "painted-by-mean",
        "Triangles were sorted by their mean depth, and a near one was painted over. A z-buffer compares pixels.",
        Case(cards([0.1, 0.1, 0.95], [0.4, 0.4, 0.4]), reading=frame_colors),
        Case(NEAR_AND_FAR, reading=frame_colors),
        change_settings=lambda settings: replace(settings, visibility="painters"),
    ),
    Twin(
        "glass-writes-depth",
        "The transparent surface wrote its depth, so what lies behind it is missing. Blend without writing depth.",
        Case(GLASS, BLENDED, frame_colors),
        Case(cards([0.75] * 3, [0.25] * 3, alpha=0.5), BLENDED, frame_colors),
        change_settings=lambda settings: replace(settings, visibility="z-buffer"),
    ),
    Twin(
        "alpha-squared",
        "The alpha of the result is a a + (1 - a) d. It is a + (1 - a) d.",
        CLEAR_RED,
        OPAQUE,
        change_settings=in_over(ALPHA, "result.append(alpha * alpha + (1 - alpha) * destination[3])"),
    ),
    Twin(
        "alpha-kept",
        "The alpha that was there was kept. The result has a + (1 - a) times it.",
        Case(cards([0.5] * 3, alpha=0.5), BLENDED),
        RED_AND_BLUE,
        change_settings=in_over(ALPHA, "result.append(destination[3])"),
    ),
    Twin(
        "not-multiplied",
        "The colour was not multiplied by its alpha, and the result is too bright.",
        CLEAR_RED,
        OPAQUE,
        change_settings=in_over(COLOR, "color[k] + (1 - alpha) * destination[k]"),
    ),
)


@wrong_rule(window_depth, shows=(1, 10, 2), hides=(1, 10, 10))
def depth_linear(near: Any, far: Any, distance: Any) -> Vector:
    """Depth was taken for linear in the distance. With perspective most of its range lies near the eye."""
    return (Fraction(distance - near) / (far - near),)


@wrong_rule(window_depth, shows=(1, 10, 2), hides=(1, 10, 10))
def near_plane_tiny(near: Any, far: Any, distance: Any) -> Vector:
    """The near plane lies almost at the eye, so that every depth is almost 1."""
    return window_depth(Fraction(near) / 1000, far, distance)


@wrong_rule(depth_between, shows=(Fraction(1, 2), (0, 1), (1, 10)), hides=(Fraction(1, 2), (0, 1), (4, 4)))
def depth_corrected_twice(t: Any, depths: Vector, distances: Vector) -> Vector:
    """The window depth was corrected for perspective. It was divided by w already, and is linear in the window."""
    first, second = (1 - t) / Fraction(distances[0]), t / Fraction(distances[1])
    return ((first * depths[0] + second * depths[1]) / (first + second),)


@wrong_rule(distance_between, shows=(Fraction(1, 2), (1, 10)), hides=(Fraction(1, 2), (3, 3)))
def distance_linear(t: Any, distances: Vector) -> Vector:
    """The distance was interpolated in the window. Its reciprocal 1/w is linear there."""
    return (distances[0] + t * (distances[1] - distances[0]),)


@wrong_rule(painted_first, shows=(((1, 1, 30), (12, 12, 12)),), hides=(((1, 1, 1), (12, 12, 12)),))
def sorted_by_mean(depths: Sequence[Vector]) -> Vector:
    """The triangles were sorted by their mean depth. Here the farthest vertex decides."""
    return tuple(sorted(range(len(depths)), key=lambda k: -sum(depths[k])))


@wrong_rule(resolved, shows=(TWO, 4), hides=(ONE, 4))
def one_depth_a_pixel(layers: Sequence[Layer], count: int) -> Vector:
    """The samples shared one depth, so the background shines through. Each sample has a depth of its own."""
    greys, nearest = [0] * count, 10**9
    for layer in layers:
        if layer.samples and layer.depth < nearest:
            nearest = layer.depth
            for sample in layer.samples:
                greys[sample] = layer.grey
    return (Fraction(sum(greys), count),)


@wrong_rule(resolved, shows=(ONE, 4), hides=((Layer(frozenset({0}), 1, 8),), 4))
def one_sample_filled(layers: Sequence[Layer], count: int) -> Vector:
    """Only one sample was filled, but the sum was divided by the number of all."""
    first = [replace(layer, samples=layer.samples & {0}) for layer in layers]
    return resolved(first, count)


@wrong_rule(line_greys, shows=(240, (1, 4, 16)), hides=(240, (1,)))
def line_in_one_sample(grey: int, counts: Sequence[int]) -> Vector:
    """The line was written to one sample of each pixel, so it fades as their number grows. Write all of them."""
    return tuple(Fraction(grey, count) for count in counts)
