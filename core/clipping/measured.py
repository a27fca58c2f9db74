"""Triangles that reach behind the eye, and the order in which an edge is clipped."""

import numpy as np

from core.coverage.measured_cover import CoverageExperiment, once_everywhere
from core.scene import ClipScene
from core.settings import Settings
from core.study.record import Axis
from core.study.workloads import flat_scene, random_source

SIZE = (32, 32)
NOT_SNAPPED = Settings(fill="bounding-box", coverage="exact")
"""The corners that clipping makes are not on the grid, and edges are not to blame: only the clipping may err."""
CLIPPINGS = (
    "clipping=project-first",
    "clipping=after-divide",
    "clipping=sutherland-hodgman-lecture",
    "clipping=sutherland-hodgman",
    "clipping=homogeneous",
)


def signs_of_w(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle with given w at its second and third corner; the first has w = 1.

    Notes
    -----
    z is 0, so that everything in front of the eye lies between the near and the far plane.
    """
    w1, w2 = place
    clip = np.array([[-0.71, -0.63, 0.0, 1.0], [1.32, -0.17, 0.0, w1], [0.21, 1.13, 0.0, w2]])
    return flat_scene(clip[None], SIZE)


def through_small_w(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle one of whose corners comes near the eye's plane, or lies behind it.

    Notes
    -----
    ``place`` is the logarithm (base 2) of the size of w, and whether it is before the eye (1) or behind (-1).
    """
    size, side = place
    clip = np.array([[-0.9, -0.8, 0.0, 1.0], [0.7, -0.6, 0.0, 1.0], [0.3, 0.9, 0.0, side * size]])
    return flat_scene(clip[None], SIZE)


def pair_over_the_border(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return two triangles that fill the window and share an edge across it: A to B in one, B to A in the other.

    Notes
    -----
    The edge passes through a pixel centre beside the right border and meets the border half-way between two steps of
    the 1/256-pixel grid: the last bit of the new corner decides where it is snapped to, and so the pixel. ``place``
    is the slope in 1/256 and the w of B over that of A.
    """
    slope, ratio = place
    center = np.array([31.5, 16.5])
    along = np.array([1.0, slope / 256])
    window = np.array([center - 40 * along, center + 24 * along, [16.0, 256.0], [16.0, -256.0]])
    w = np.array([1.0, ratio, 1.0, 1.0]) * random_source(seed).uniform(0.5, 2.0)
    clip = np.concatenate([window / 16 - 1, np.zeros((4, 1)), np.ones((4, 1))], axis=1) * w[:, None]
    return flat_scene(clip[[[0, 1, 2], [1, 0, 3]]], SIZE)


RATIOS = (0.1, 0.2, 0.3, 0.7, 1.0, 1.3, 2.9, 4.7, 9.1)
SIGNS = tuple((np.arange(-8, 9) / 4).tolist())
SIGNS_OF_W = CoverageExperiment(
    "signs-of-w",
    "w through 0, mixed signs",
    "Two corners of a triangle move through the eye's plane, independently. Which methods draw the part in "
    "front?",
    (Axis("second", "w of the second corner", "", SIGNS), Axis("third", "w of the third corner", "", SIGNS)),
    CLIPPINGS,
    "Projecting first is right only while all w > 0: it mirrors corners behind the eye, and draws nothing "
    "where w = 0. Clipping in clip space and homogeneous edge functions are right for all signs.",
    signs_of_w,
    base=NOT_SNAPPED,
)
AFTER_DIVIDE = CoverageExperiment(
    "clip-after-divide",
    "Clipping after the division by w",
    "A corner approaches the eye's plane and passes behind it. Can the division come before the clipping?",
    (
        Axis("size", "Size of the corner's w", "", tuple(2.0**k for k in range(-60, 1, 4)), True),
        Axis("side", "Sign of w", "", (-1.0, 0.0, 1.0)),
    ),
    CLIPPINGS,
    "Dividing first is right for every w > 0, however small, and wrong for every w <= 0. Clipping before the "
    "division and homogeneous edge functions are always right.",
    through_small_w,
    base=NOT_SNAPPED,
)
CLIP_ORDER = CoverageExperiment(
    "clip-order",
    "An edge clipped from A to B and from B to A",
    "Two triangles share an edge that crosses the border, in opposite directions. Do they still meet?",
    (
        Axis("slope", "Slope of the edge", "1/256", tuple(map(float, range(1, 64, 4)))),
        Axis("ratio", "w of the second end over the first", "", RATIOS, True),
    ),
    CLIPPINGS,
    "Clipped in the polygon's order, the two new corners of a shared edge differ by rounding and may snap to "
    "different places. Clipped from the inside end to the outside end, they are one corner.",
    pair_over_the_border,
    wanted=once_everywhere,
)
EXPERIMENTS = (SIGNS_OF_W, AFTER_DIVIDE, CLIP_ORDER)
