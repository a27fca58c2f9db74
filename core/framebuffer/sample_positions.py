"""Where in a pixel its samples lie.

Positions are from the pixel's lower left corner, x to the right and y up, 0 to 1. Those of four samples (the rotated
grid) are multiples of 1/8 pixel and so of the 1/256 that corners are snapped to: moving the corners by the way from a
sample to the pixel's centre is exact, and the coverage of the moved corners at the centre is the coverage of the
sample, by the very arithmetic of the edge functions and spans.

References
----------
OpenGL 4.6 (core profile), 14.3.1 "Multisampling"; Direct3D 11, "Standard multisample quality patterns" (4 samples).
LMU, *Computer Graphics 1*, tutorial 6, "Supersampling (SSAA)", "Multisampling (MSAA)", 2020.
H. Jubair, *Computer Graphics*, lecture "Antialiasing", supersampling.
"""

import numpy as np

from core.records.arrays import Floats, read_only

ROTATED_GRID = read_only(np.array([[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]))
"""(4, 2) the four samples of graphics cards: each alone in its row, its column and its quarter of the pixel."""


def grid_positions(side: int) -> Floats:
    """Return the centres (S, 2) float64 of ``side`` x ``side`` equal squares, row by row from the lower left.

    Examples
    --------
    >>> grid_positions(2).tolist()
    [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
    """
    along = (np.arange(side) + 0.5) / side
    x, y = np.meshgrid(along, along)
    return read_only(np.column_stack([x.ravel(), y.ravel()]))
