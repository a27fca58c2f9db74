"""Scenes of layers in the window: two that cross, the same as glass, and four from near to far."""

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
