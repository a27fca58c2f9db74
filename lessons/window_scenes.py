"""Scenes given in the window: bars in a circle; polygons with holes, crossing themselves or cut; tables of depths."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from core.depth.whole_depths import table_scene
from core.records.arrays import Floats, checked
from core.records.depth_table import DepthTable, depths_of_text
from core.records.motion import Motion
from core.scene import ClipScene
from lessons.shapes import FACE_COLORS, RED_GREEN_BLUE, linear_color
from lessons.world_scenes import TEACHING_SIZE

# Triangles given in the window: bars that overlap in a circle.


def window_triangle(
    x: ArrayLike, y: ArrayLike, depth: ArrayLike, w: ArrayLike, size: tuple[int, int]
) -> Floats:
    """Return the clip-space corners of a triangle given in the window.

    Parameters
    ----------
    x, y : (3,) array_like
        Pixels, y up.
    depth : (3,) array_like
        Window depth, from 0 (near) to 1 (far).
    w : (3,) array_like
        Clip-space w; not 0. Only its ratios matter, and only for what is interpolated.
    size : (width, height)
        Raster in pixels.

    Returns
    -------
    (3, 4) float64
        ``((2 x / width - 1) w, (2 y / height - 1) w, (2 depth - 1) w, w)``.

    Raises
    ------
    ValueError
        If an array is not three finite numbers, or a w is 0.

    Notes
    -----
    The way there and back rounds; the result differs from x and y by far less than half of 1/256 pixel, so
    corners on that grid snap to the same place.
    """
    columns = [
        checked(name, values, (3,)) for name, values in (("x", x), ("y", y), ("depth", depth), ("w", w))
    ]
    across, up, far, weight = columns
    if (weight == 0).any():
        raise ValueError("w must not be 0: such a corner has no place in the window")
    width, height = size
    ndc = np.stack([2 * across / width - 1, 2 * up / height - 1, 2 * far - 1, np.ones(3)], axis=1)
    return np.asarray(ndc * weight[:, None])


BARS = (
    ((38.5, 31.5, 13.5), (41.25, 45.25, 5.75)),
    ((10.5, 10.5, 53.5), (15.0, 7.0, 11.0)),
    ((47.0, 54.0, 29.0), (3.75, 7.75, 43.25)),
)
"""X and y of three bars, wide and near at their first two corners, pointed and far at the third."""


def bar_and_wire() -> ClipScene:
    """A bar that moves 4 pixels a picture, and a wire of a third of a pixel that stands still."""
    size = (64, 20)
    flat, ones = [0.5] * 3, [1, 1, 1]
    shapes = ([44, 56, 56], [0, 0, 16]), ([44, 56, 44], [0, 16, 16]), ([3, 61, 61], [17, 19.5, 19.8])
    way = (8 / 64, 0.0, 0.0)
    clip = np.stack([window_triangle(x, y, flat, ones, size) for x, y in shapes])
    motion = Motion(objects=((0, way), (1, way)))
    return ClipScene(clip, np.ones((3, 3, 4)), size, background=np.array([0.0, 0.0, 0.0, 1.0]), motion=motion)


def circle_of_bars() -> ClipScene:
    """Three bars of which each lies over the next: nothing passes through anything, and no order is right."""
    size = (64, 48)
    clip = [window_triangle(x, y, (0.3, 0.3, 0.7), (1, 1, 1), size) for x, y in BARS]
    colors = np.stack([np.tile(linear_color(color), (3, 1)) for color in FACE_COLORS[:3]])
    return ClipScene(np.stack(clip), colors, size)


# Polygons given in the window: with holes, crossing themselves, cut at a clip window.


Ring = Sequence[Sequence[float]]
"""Corners of a ring, x and y in pixels."""


def polygon_of_rings(
    rings: Sequence[Ring | Floats], size: tuple[int, int], color: str = FACE_COLORS[0]
) -> ClipScene:
    """Return one polygon with rings (K, 2) in pixels, y up: the outline, then holes."""
    places = [np.asarray(ring, float) for ring in rings]
    corners = np.concatenate(places)
    clip = np.concatenate([2 * corners / size - 1, np.tile([0.0, 1.0], (len(corners), 1))], axis=1)
    colors = np.tile(linear_color(color), (1, len(corners), 1))
    starts = np.cumsum([0, *map(len, places)])[:-1]
    return ClipScene(clip[None], colors, size, kind="polygons", rings=starts)


def polygon_with_holes() -> ClipScene:
    """A concave polygon with two holes, which run the other way round."""
    outline: Ring = [[3, 3], [29, 2.5], [30, 12], [22, 14.5], [29, 21], [12, 22], [2.5, 16]]
    square: Ring = [[6, 6], [7, 13], [14, 12.5], [13, 5.5]]
    return polygon_of_rings([outline, square, [[19, 6], [20, 11], [26, 8]]], (32, 24))


def weiler_atherton() -> ClipScene:
    """A concave polygon with a hole, and a concave clip window with a hole: one ring with two holes is left."""
    outline: Ring = [[3, 4], [28, 3], [29.5, 19], [21, 8.5], [15, 20], [4, 17]]
    lying = polygon_of_rings([outline, [[8, 8], [9, 13], [13, 9]]], (32, 24))
    window = np.array(
        [[6, 1], [26, 1], [26, 15], [31, 22], [1, 22], [1, 11], [6, 11], [16, 4], [22, 4], [20, 7]]
    )
    region = window / (16, 12) - 1
    return replace(lying, clip_region=region, region_rings=np.array([0, 7]))


def connecting_edges() -> ClipScene:
    """A comb of three teeth, of which the clip window leaves only the teeth."""
    comb: Ring = [
        *([3, 3], [29, 3], [29, 20], [23, 20], [23, 7], [19, 7]),
        *([19, 21], [13, 21], [13, 7], [9, 7], [9, 19], [3, 19]),
    ]
    return replace(
        polygon_of_rings([comb], (32, 24), FACE_COLORS[2]), clip_region=np.array([-0.9, -0.1, 0.95, 0.5])
    )


def pentagram() -> ClipScene:
    """A polygon of five corners that crosses itself five times."""
    angle = np.pi / 2 + np.arange(5) * 4 * np.pi / 5
    corners = np.rint(4 * np.stack([16 + 15 * np.cos(angle), 11 + 12 * np.sin(angle)], axis=1)) / 4
    return polygon_of_rings([corners], (32, 24), FACE_COLORS[1])


# Tables of whole-number depths: the patches that lectures draw into a buffer of infinities.


COLORS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7")
LEVEL = """
5 5 5 5 5 5 5 -
5 5 5 5 5 5 - -
5 5 5 5 5 - - -
5 5 5 5 - - - -
5 5 5 - - - - -
5 5 - - - - - -
5 - - - - - - -
- - - - - - - -
"""
"""A triangle that is equally far everywhere."""
SLOPING = """
- - - - - - - -
7 - - - - - - -
6 7 - - - - - -
5 6 7 - - - - -
4 5 6 7 - - - -
3 4 5 6 7 - - -
2 3 4 5 6 7 - -
- - - - - - - -
"""
"""A triangle that comes nearer to the left and the bottom, and so passes through the level one."""
EQUAL = """
- - - - - -
4 4 4 4 - -
4 4 4 4 - -
- - - - - -
"""
ALSO_EQUAL = """
- - - - - -
- - 4 4 4 4
- - 4 4 4 4
∞ ∞ ∞ ∞ ∞ ∞
"""
"""The same depth two columns further, and a row at infinity."""
INVERSE_W = (
    "8 8 8 - - -\n8 8 8 - - -\n- - - - - -",
    "- 5 5 5 5 -\n- 5 5 5 5 -\n- 5 5 5 5 -",
    "- - - 9 9 9\n- - - - - -\n- - 2 2 2 2",
)
"""Patches of 1/w in whole numbers: larger is nearer."""


def depth_table(*patches: str, test: str = "less") -> DepthTable:
    """Return a table of patches as they are printed, in the order in which they are drawn."""
    colors = np.stack([linear_color(color) for color in COLORS[: len(patches)]])
    return DepthTable(np.stack([depths_of_text(patch) for patch in patches]), colors, test)


def two_triangles() -> ClipScene:
    """Return the level triangle, and then the sloping one."""
    return table_scene(depth_table(LEVEL, SLOPING))


def two_triangles_turned() -> ClipScene:
    """Return the same in the other order: the picture is the same."""
    return table_scene(depth_table(SLOPING, LEVEL))


def equal_depths() -> ClipScene:
    """Return two patches of one depth, and a row at infinity."""
    return table_scene(depth_table(EQUAL, ALSO_EQUAL))


def larger_is_nearer() -> ClipScene:
    """Return three patches of whole numbers that stand for 1/w: larger ones pass."""
    return table_scene(depth_table(*INVERSE_W, test="greater"))


def moving_bar() -> ClipScene:
    """An upright bar on a screen of 16 rows: where it is torn, its sides have a step."""
    corners = [[(6, 0), (10, 0), (10, 16)], [(6, 0), (10, 16), (6, 16)]]
    places = np.array(corners, float)
    clip = np.stack(
        [window_triangle(x, y, np.full(3, 0.5), np.ones(3), (24, 16)) for x, y in places.transpose(0, 2, 1)]
    )
    return ClipScene(clip, np.tile(linear_color(FACE_COLORS[1]), (2, 3, 1)), (24, 16))


def single_triangle() -> ClipScene:
    """One triangle with red, green and blue corners, the first nearest and the last farthest."""
    clip = window_triangle([8, 57, 22.5], [6, 15.5, 42], [0.2, 0.5, 0.8], [1, 1.5, 2.5], TEACHING_SIZE)
    return ClipScene(clip[None], RED_GREEN_BLUE[None], TEACHING_SIZE)


def shared_edge() -> ClipScene:
    """Two triangles with an edge in common that runs through pixel centres."""
    x, y = np.array([8.5, 52.5, 12.5, 58.5]), np.array([40.5, 8.5, 6.5, 42.5])
    corners = np.array([[0, 2, 1], [0, 1, 3]])
    clip = np.stack(
        [window_triangle(x[row], y[row], np.full(3, 0.5), np.ones(3), TEACHING_SIZE) for row in corners]
    )
    colors = np.stack([np.tile(linear_color(color), (3, 1)) for color in FACE_COLORS[:2]])
    return ClipScene(clip, colors, TEACHING_SIZE, shared=corners)
