"""Tables of whole-number depths: the patches that lectures draw into a buffer of infinities."""

import numpy as np

from core.assembly.depth_tables import table_scene
from core.records.depth_table import DepthTable, depths_of_text
from core.scene import ClipScene
from lessons.shapes import linear_color

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
