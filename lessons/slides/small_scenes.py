"""Triangles that the numbers of slides are computed on."""

import numpy as np
from numpy.typing import ArrayLike

from core import ClipScene, Settings, render
from core.geometry.polygon_clipping.sutherland_hodgman import clip_polygons, distance_from
from core.records.arrays import Floats
from lessons.scenes import window_triangle

Corners = tuple[tuple[float, float], ...]


def triangles(
    *corners: Corners, size: tuple[int, int] = (8, 6), depth: ArrayLike = 0.5, colors: ArrayLike | None = None
) -> ClipScene:
    """Return triangles with w = 1 given by x and y in the window, each at its depth; ``colors`` (T, 3, 4)."""
    depths = np.broadcast_to(np.asarray(depth, float), len(corners))
    clip = [
        window_triangle([x for x, _ in three], [y for _, y in three], np.full(3, z), np.ones(3), size)
        for three, z in zip(corners, depths, strict=True)
    ]
    return ClipScene(np.array(clip), None if colors is None else np.asarray(colors, float), size)


def pixel_count(scene: ClipScene, settings: Settings | None = None) -> int:
    """Return how many pixels are covered."""
    return int(np.count_nonzero(render(scene, settings or Settings()).cover_count))


def is_covered(scene: ClipScene, column: int, row: int, settings: Settings | None = None) -> bool:
    """Return whether a pixel is covered."""
    return bool(render(scene, settings or Settings()).cover_count[row, column])


def rounded(values: Floats) -> tuple[float, ...]:
    """Return numbers with 12 decimals, so that what was rounded on the way reads as it is meant."""
    return tuple(float(value) + 0.0 for value in np.round(np.asarray(values, float).ravel(), 12))


def clipped_corner_count(clip: ArrayLike, plane: int) -> int:
    """Return how many corners a triangle (3, 4) has that is clipped to one plane of the view volume."""
    _, count, _ = clip_polygons(np.asarray(clip, float)[None], np.array([3]), plane)
    return int(count[0])


def distance(point: ArrayLike, plane: int) -> float:
    """Return the signed distance of a clip position (4,) from one plane of the view volume."""
    return float(distance_from(np.asarray(point, float), plane))
