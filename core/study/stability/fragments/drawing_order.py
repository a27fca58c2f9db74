"""Hidden surfaces by the order of drawing: triangles that overlap in a circle, and layers in a wrong order.

References
----------
M. Newell, R. Newell, T. Sancha, *A solution to the hidden surface problem*, 1972 (cycles have to be split).
"""

import numpy as np

from core.records.arrays import Floats
from core.scene import ClipScene
from core.study.accuracy.record import Axis
from core.study.accuracy.workloads import bars_in_a_circle, clip_of_window, flat_scene, on_grid, random_source
from core.study.stability.experiment import Experiment
from core.study.stability.fragments.cases import NearestCase

SIDE = 64
"""Pixels on a side of the picture: a power of two, so that places on the grid are exact in clip space."""
CROSSING = 0.35 * np.sqrt(3)
"""Where a bar's axis meets those of the others, from its middle, in half sides of the picture times 0.9."""


def circle_of_bars(overlap: float, lift: float) -> Floats:
    """Return clip corners (3, 3, 4) of three bars, each slanting from the front down to behind.

    Parameters
    ----------
    overlap : float
        How far a bar's axis reaches beyond those of the others, in half lengths; far below 0 they do not meet.
    lift : float
        Each bar is farther by this part of a bar's own depth than the one before: lifted enough, one lies wholly
        before the next, and there is no circle.
    """
    slant = 0.12
    depth = 0.3 + slant * (np.array([0.0, 1.0, 1.0]) + lift * np.arange(3)[:, None])
    return bars_in_a_circle((SIDE, SIDE), CROSSING + overlap, 0.2, depth)


def shuffled_layers(count: int, swaps: int, seed: int) -> Floats:
    """Return clip corners (count, 3, 4) of triangles one behind the other, drawn from back to front but for swaps.

    Notes
    -----
    A swap exchanges two neighbours in the order of drawing; the seed chooses which, and no swap undoes another.
    """
    source = random_source(seed)
    turn = source.uniform(0, 2 * np.pi, count)
    corners = turn[:, None] + 2 * np.pi / 3 * np.arange(3)
    window = SIDE * (0.5 + 0.45 * np.stack([np.cos(corners), np.sin(corners)], axis=2))
    order = np.arange(count)
    for _ in range(swaps):
        # Only neighbours that are still in order.
        first = int(source.choice(np.flatnonzero(np.diff(order) > 0)))
        order[[first, first + 1]] = order[[first + 1, first]]
    depth = 0.9 - 0.8 * (order + 0.5) / count
    return clip_of_window(
        on_grid(window), (SIDE, SIDE), np.repeat(depth[:, None], 3, axis=1), np.ones((count, 3))
    )


def layers_at(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return the layers of one place; there are no more swaps than pairs."""
    count = int(place[0])
    clip = shuffled_layers(count, min(int(place[1]), count * (count - 1) // 2), seed)
    return flat_scene(clip, (SIDE, SIDE))


CIRCLE = Experiment(
    "painters-cycle",
    "Painter's algorithm on three bars in a circle",
    "Each of three bars lies in front of the next one at one end. What happens if they overlap more, and if "
    "one is lifted off the next?",
    (
        Axis(
            "overlap",
            "Reach beyond the crossings, in half lengths",
            "",
            (-0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5),
        ),
        Axis("lift", "Lift, in depths of a bar", "", (0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.1, 1.5)),
    ),
    ("visibility=last-drawn", "visibility=painters", "visibility=z-buffer", "visibility=ray-casting"),
    "Where the bars overlap and none is lifted by half its depth, no order is right: sorting fails, and so "
    "does drawing without a depth test. Lifted by a whole depth, sorting is right. A z-buffer is always "
    "right.",
    lambda place, _: flat_scene(circle_of_bars(place[0], place[1]), (SIDE, SIDE)),
    NearestCase,
)
LAYERS = Experiment(
    "drawing-order",
    "Layers drawn in a wrong order",
    "Triangles one behind the other are drawn from back to front, except for some swaps of neighbours. Is the"
    " nearest one visible?",
    (
        Axis("layers", "Layers", "", (2, 3, 4, 6, 8, 12, 16)),
        Axis("swaps", "Swaps of neighbours", "", (0, 1, 2, 3, 4, 6, 8, 12)),
    ),
    ("visibility=last-drawn", "visibility=painters", "visibility=z-buffer", "visibility=ray-casting"),
    "Without a depth test every swap of two visible layers is wrong. Sorted layers and a z-buffer are right "
    "in any order.",
    layers_at,
    NearestCase,
)
