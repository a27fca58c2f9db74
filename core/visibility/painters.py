"""Who is seen at a pixel: the nearest fragment, the last one drawn, or the last one after sorting by depth.

References
----------
M. Newell, R. Newell, T. Sancha, *A solution to the hidden surface problem*, 1972 (painter's algorithm, with splitting).
M. Zwicker, *Computergrafik*, lecture "Visibility", Bern 2016.
"""

from collections.abc import Sequence

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
    takes=("depth_test_time",),
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


def far_to_near(depths: Sequence[Sequence[float]]) -> list[int]:
    """Listing of the painter's sort: triangles by the sum of their depths, far ones first, level ones as given."""
    distances: list[float] = []
    order: list[int] = []
    for number, (first, second, third) in enumerate(depths):
        distance = first + second + third  #: distance
        distances.append(distance)
        order.append(number)
        place = number  #: append
        while place > 0 and distances[order[place - 1]] < distance:  #: farther
            order[place - 1], order[place] = order[place], order[place - 1]
            place = place - 1  #: swap
    return order


def sums_of_depths(clip: Floats) -> tuple[Floats, Floats]:
    """Return the depths of the corners of triangles (T, 3, 4) in clip space, (T, 3), and their sums (T,).

    Notes
    -----
    Depth is w, the distance along the viewing direction; where w is constant (orthographic) it is z. The mean depth is
    a third of the sum, and sorts alike.
    """
    axis = 2 if len(clip) and np.ptp(clip[..., 3]) == 0 else 3
    depths = np.stack([clip[:, k, axis] for k in range(3)], axis=1)
    return depths, depths[:, 0] + depths[:, 1] + depths[:, 2]


@method(
    "visibility",
    "painters",
    "Painter's algorithm",
    source="Newell, Newell and Sancha 1972 (without splitting); Zwicker 2016",
    exact_for="triangles that do not overlap in depth",
    breaks_where="intersecting triangles, cyclic overlaps, a large triangle beside a small one",
    listing=far_to_near,
)
def painters(clip: Floats) -> DrawingOrder:
    """Draw from far to near by the mean depth of the corners; level ones stay in drawing order."""
    _, distance = sums_of_depths(clip)
    order = np.argsort(-distance, kind="stable")
    return DrawingOrder(order, False, own_rows="core.visibility.traced_order.with_sort")
