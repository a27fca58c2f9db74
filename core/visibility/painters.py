"""Who is seen at a pixel: the nearest fragment, the last one drawn, or the last one after sorting by depth.

References
----------
M. Newell, R. Newell, T. Sancha, *A solution to the hidden surface problem*, 1972 (painter's algorithm, with splitting).
M. Zwicker, *Computergrafik*, lecture "Visibility", Bern 2016.
"""

import numpy as np

from core.methods import method
from core.records.arrays import Floats
from core.records.primitives import DrawingOrder


@method(
    "visibility",
    "z-buffer",
    "Z-buffer",
    source="Catmull 1974; Zwicker 2016, Z-buffering",
    exact_for="opaque triangles, to the resolution of the depth format",
)
def z_buffer(clip: Floats) -> DrawingOrder:
    """Draw as given; a fragment is kept where it is nearer than what is there."""
    return DrawingOrder(np.arange(len(clip)), True)


@method(
    "visibility",
    "last-drawn",
    "Depth test off (last drawn wins)",
    source="OpenGL 4.6, DEPTH_TEST disabled",
    exact_for="triangles drawn from back to front",
    breaks_where="any other order",
)
def last_drawn(clip: Floats) -> DrawingOrder:
    """Draw as given; every fragment overwrites."""
    return DrawingOrder(np.arange(len(clip)), False)


@method(
    "visibility",
    "painters",
    "Painter's algorithm",
    source="Newell, Newell and Sancha 1972 (without splitting); Zwicker 2016",
    exact_for="triangles that do not overlap in depth",
    breaks_where="intersecting triangles, cyclic overlaps, a large triangle beside a small one",
)
def painters(clip: Floats) -> DrawingOrder:
    """Draw from far to near by the mean depth of the corners; level ones stay in drawing order.

    Notes
    -----
    The distance is w, the depth along the viewing direction; where w is constant (orthographic) it is z.
    """
    distance = clip[:, 0, 3] + clip[:, 1, 3] + clip[:, 2, 3]
    if len(clip) and np.ptp(clip[..., 3]) == 0:
        distance = clip[:, 0, 2] + clip[:, 1, 2] + clip[:, 2, 2]
    return DrawingOrder(np.argsort(-distance, kind="stable"), False)
