"""Scenes of primitives assembled from a row of vertices: segments, points, strips and a polygon."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from core.scene import ClipScene
from core.transform.assembly import assemble
from lessons.shapes import FACE_COLORS, linear_color
from lessons.world_scenes import TEACHING_SIZE


def assembled(name: str, x: ArrayLike, y: ArrayLike, size: tuple[int, int]) -> ClipScene:
    """Return primitives assembled between places (V,) in the window, each vertex in one of four colours."""
    corners = np.stack([np.asarray(x, float), np.asarray(y, float)], axis=1)
    clip = np.concatenate([2 * corners / size - 1, np.tile([0.0, 1.0], (len(corners), 1))], axis=1)
    colors = np.array([linear_color(FACE_COLORS[k % 4]) for k in range(len(corners))])
    return assemble(name, clip, colors, size=size)


def segment() -> ClipScene:
    """One segment between two pixel centres, 8 columns and 3 rows apart: Bresenham's first example."""
    return assembled("segments", [1.5, 9.5], [1.5, 4.5], (16, 12))


def clipped_segment() -> ClipScene:
    """One segment from below a clip window to the right of it: it enters at t = 2/9 and leaves at t = 8/9."""
    lying = assembled("segments", [3, 13], [1, 10], (16, 12))
    return replace(lying, clip_region=np.array([-0.5, -0.5, 0.5, 0.5]))


def segment_in_polygon() -> ClipScene:
    """One segment through a clip window of five corners, which it enters and leaves through slanted sides."""
    lying = assembled("segments", [1.5, 14.5], [3.5, 9.5], (16, 12))
    corners = np.array([[4, 2], [12, 2], [14, 6], [8, 10], [2, 6]])
    return replace(lying, clip_region=corners / (8, 6) - 1)


def line_strip() -> ClipScene:
    """Five segments, each of which begins where the one before ends."""
    x, y = [2.5, 9.5, 14.5, 20.5, 24.5, 29.5], [12.5, 12.5, 18.5, 18.5, 8.5, 8.5]
    return assembled("line-strip", x, y, (32, 24))


def points() -> ClipScene:
    """Five points, of which one lies on the border of two pixels and one outside of the raster."""
    return assembled("points", [2.5, 5.25, 8, 12.5, 17.5], [2.5, 8.75, 5, 9.5, 3.5], (16, 12))


def triangle_strip() -> ClipScene:
    """Six triangles of eight vertices, which lie below and above in turn."""
    x, y = [4.5, 8.5, 18.5, 24.5, 34.5, 38.5, 50.5, 58.5], [34.5, 8.5, 42.5, 12.5, 40.5, 6.5, 38.5, 12.5]
    return assembled("triangle-strip", x, y, TEACHING_SIZE)


def polygon() -> ClipScene:
    """A star of ten corners, of which every other one is reflex."""
    angle = np.pi / 2 + np.arange(10) * np.pi / 5
    radius = np.where(np.arange(10) % 2, 11.0, 23.0)
    x, y = (np.rint(4 * value) / 4 for value in (32 + radius * np.cos(angle), 23 + radius * np.sin(angle)))
    return assembled("polygon", x, y, TEACHING_SIZE)
