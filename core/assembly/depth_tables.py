"""Tables of depths as scenes: every cell of a patch is a fragment, which enters the pipeline at the depth test."""

import numpy as np

from core.framebuffer.whole_depths import window_depth
from core.records.depth_table import DepthTable
from core.scene import ClipScene


def table_scene(table: DepthTable) -> ClipScene:
    """Return the scene of a table: one fragment for each cell with a depth, patch by patch, the top row first.

    Examples
    --------
    >>> nan = float("nan")
    >>> scene = table_scene(DepthTable([[[5, nan]], [[3, 7]]], np.ones((2, 4))))
    >>> scene.numbers.tolist(), scene.size
    ([0, 1, 1], (2, 1))
    """
    width, height = table.size
    upside_down = table.depths[:, ::-1]
    patch, line, column = np.nonzero(~np.isnan(upside_down))
    depth = window_depth(upside_down[patch, line, column])
    clip = np.ones((len(patch), 1, 4))
    clip[:, 0, 0] = (2 * column + 1) / width - 1
    clip[:, 0, 1] = (2 * (height - 1 - line) + 1) / height - 1
    clip[:, 0, 2] = 2 * depth - 1
    colors = table.colors[patch][:, None]
    return ClipScene(clip, colors, table.size, shared=patch[:, None], kind="fragments", table=table)
