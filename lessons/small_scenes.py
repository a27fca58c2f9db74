"""Small scenes given in the window: triangles and segments that exercises and the numbers of lectures are about."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core import Settings, render
from core.clipping.sutherland_hodgman import clip_polygons, distance_from
from core.records.arrays import Floats
from core.scene import ClipScene
from lessons.assembled_scenes import assembled
from lessons.window_scenes import window_triangle

# Small scenes given in the window: triangles of exercises, segments between pixels.


Point = tuple[float, float]
Numbers = ArrayLike | Sequence[Any]
"""Numbers in rows, fractions among them."""
EVERYWHERE: tuple[Point, ...] = ((-20, -20), (40, -20), (-20, 40))
"""A triangle over the whole of a small window."""


def triangle_scene(
    corners: Numbers,
    size: tuple[int, int],
    depth: Numbers = 0.5,
    w: Numbers = 1.0,
    attributes: Numbers | None = None,
) -> ClipScene:
    """Return triangles with corners (T, 3, 2) in pixels, y up.

    Parameters
    ----------
    corners : (T, 3, 2) array_like
    size : (width, height)
    depth, w : array_like, broadcast to (T, 3)
        Window depth from 0 (near) to 1 (far), and clip-space w, of every corner.
    attributes : (T, 3, K) array_like, optional
        See `core.scene.ClipScene`.
    """
    places = np.asarray(corners, float)
    shape = places.shape[:2]
    depths, weights = (np.broadcast_to(np.asarray(each, float), shape) for each in (depth, w))
    clip = [
        window_triangle(place[:, 0], place[:, 1], far, weight, size)
        for place, far, weight in zip(places, depths, weights, strict=True)
    ]
    values = None if attributes is None else np.asarray(attributes, float)
    return ClipScene(np.stack(clip), values, size)


def rectangle_corners(left: float, bottom: float, right: float, top: float) -> list[list[Point]]:
    """Return a rectangle as two triangles that share its rising diagonal."""
    return [[(left, bottom), (right, bottom), (right, top)], [(left, bottom), (right, top), (left, top)]]


def segment_scene(ends: Sequence[tuple[Point, Point]], size: tuple[int, int]) -> ClipScene:
    """Return segments between points in the window, in pixels, y up."""
    x, y = np.array(ends, float).reshape(-1, 2).T
    return assembled("segments", x, y, size)


def pixel_segments(ends: Sequence[tuple[Point, Point]], size: tuple[int, int]) -> ClipScene:
    """Return segments between the centres of pixels."""
    return segment_scene([((x0 + 0.5, y0 + 0.5), (x1 + 0.5, y1 + 0.5)) for (x0, y0), (x1, y1) in ends], size)


# Triangles that the numbers of slides are computed on.


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
