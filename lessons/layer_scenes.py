"""Scenes of flat triangles: two that cross, the same as glass, four layers from near to far, and a fan."""

import numpy as np

from core.scene import ClipScene
from lessons.shapes import FACE_COLORS, linear_color
from lessons.window_scenes import window_triangle
from lessons.world_scenes import TEACHING_SIZE


def intersecting() -> ClipScene:
    """Two triangles that pass through each other: no order of drawing them is right everywhere."""
    size = TEACHING_SIZE
    rising = window_triangle([4, 60, 10], [8, 20, 44], [0.1, 0.9, 0.3], [1, 1, 1], size)
    falling = window_triangle([4, 60, 54], [24, 4, 45], [0.8, 0.2, 0.4], [1, 1, 1], size)
    colors = np.stack([np.tile(linear_color(color), (3, 1)) for color in FACE_COLORS[:2]])
    return ClipScene(np.stack([rising, falling]), colors, size)


def crossing_glass() -> ClipScene:
    """The same two as panes of glass that let half of the light through: neither order blends all pixels right."""
    opaque = intersecting()
    colors = np.asarray(opaque.attributes) * [1, 1, 1, 0.5]
    return ClipScene(opaque.clip, colors, opaque.size)


def four_layers() -> ClipScene:
    """Four layers over the whole picture, drawn from near to far: an early depth test shades the first one alone."""
    size = (32, 24)
    layers = [window_triangle([0, 64, 0], [0, 0, 48], [z] * 3, [1, 1, 1], size) for z in (0.3, 0.5, 0.7, 0.9)]
    colors = np.stack([np.tile(linear_color(color), (3, 1)) for color in FACE_COLORS[:4]])
    return ClipScene(np.stack(layers), colors, size)


def fan() -> ClipScene:
    """Sixteen triangles around a pixel centre: edges to all sides run through pixel centres."""
    rim = [(20, 0), (20, 8), (18, 18), (8, 20), (0, 20), (-8, 20), (-18, 18), (-20, 8)]
    around = [(0, 0), *rim, *((-x, -y) for x, y in rim)]
    x, y = np.array(around).T + np.array([[32.5], [24.5]])
    corners = np.array([[0, k, k % 16 + 1] for k in range(1, 17)])
    clip = np.stack(
        [window_triangle(x[row], y[row], np.full(3, 0.5), np.ones(3), TEACHING_SIZE) for row in corners]
    )
    palette = [linear_color(FACE_COLORS[k % 4]) for k in range(16)]
    return ClipScene(clip, np.repeat(palette, 3, axis=0).reshape(16, 3, 4), TEACHING_SIZE, shared=corners)
