"""Triangles that the numbers of slides are computed on."""

import numpy as np
from numpy.typing import ArrayLike

from core import ClipScene, Settings, render
from core.geometry.polygon_clipping.sutherland_hodgman import clip_polygons, distance_from
from core.records.arrays import Floats
from lessons.small_scenes import triangle_scene

Corners = tuple[tuple[float, float], ...]
SPLIT_SQUARE = (((1.5, 1.5), (5.5, 1.5), (5.5, 4.5)), ((1.5, 1.5), (5.5, 4.5), (1.5, 4.5)))
"""Two triangles whose outer edges and diagonal meet pixel centres."""


def triangles(
    *corners: Corners, size: tuple[int, int] = (8, 6), colors: ArrayLike | None = None
) -> ClipScene:
    """Return triangles with w = 1 given by x and y in the window, ``colors`` (T, 3, 4) at their corners."""
    return triangle_scene(corners, size, attributes=colors)


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


def cells_unlike(scene: ClipScene, closest: np.ufunc) -> int:
    """Return how many cells of the final buffer differ from the ``closest`` depth of all patches there.

    The closest is ``np.fmin`` where smaller is nearer, ``np.fmax`` where larger is; an empty cell is as cleared.
    """
    assert scene.table is not None
    wanted = closest.reduce(scene.table.depths, axis=0)
    buffer = render(scene).depth
    return int(np.count_nonzero(buffer != np.where(np.isnan(wanted), scene.table.cleared, wanted)))
