"""Small scenes given in the window: triangles of exercises, segments between pixels."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core.scene import ClipScene
from lessons.scenes import assembled, window_triangle

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
