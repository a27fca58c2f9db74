"""Slivers, far corners, singular matrices, small triangles: what every number format makes of them."""

import numpy as np

from core.scene import ClipScene
from core.study.stability.coverage.covered_pixels import CoverageExperiment
from core.study.stability.record import Axis, ExperimentInfo
from core.study.workloads import clip_of_window, flat_scene

SIZE = (64, 64)
"""A power of two: window positions that are multiples of 1/256 pixel are exact in clip space."""
FORMATS = (
    "coverage=float16",
    "coverage=fixed-24.8",
    "coverage=float32",
    "coverage=inverse",
    "coverage=snapped",
    "coverage=int64",
    "coverage=float64",
    "coverage=exact",
)


def scene_of_window(window: list[list[list[float]]], size: tuple[int, int] = SIZE) -> ClipScene:
    """Return triangles with corners (T, 3, 2) in pixels, all at one depth."""
    corners = np.array(window, np.float64)
    level = np.ones(corners.shape[:2])
    return flat_scene(clip_of_window(corners, size, 0.5 * level, level), size)


def powers(first: int, last: int, step: int = 1) -> tuple[float, ...]:
    """Return 2^first to 2^last."""
    return tuple(2.0**exponent for exponent in range(first, last + 1, step))


def sliver(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle ``width`` pixels high, its long side ``offset`` pixels below a row of pixel centres.

    Notes
    -----
    The side has the slope 1/3 and passes under ten centres. It begins at the window's middle, where clip space has
    its 0, so that even 2^-50 pixel is there before anything is computed.
    """
    width, offset = place
    start, end = np.array([32.5, 32.5]), np.array([59.5, 41.5])
    middle = (start + end) / 2
    # In clip space: the numbers would not hold so small an offset beside 32 pixels.
    low = [(start - 32) / 32, (end - 32) / 32, (middle - 32) / 32]
    clip = np.array([[*point, 0.0, 1.0] for point in low])
    clip[:, 1] -= offset / 32
    clip[2, 1] += width / 32
    return flat_scene(clip[None], SIZE)


SLIVERS = CoverageExperiment(
    ExperimentInfo(
        "slivers",
        "Slivers by width and offset",
        "A long thin triangle has its lower side just below ten pixel centres: how thin may it be, and how close?",
        (
            Axis("width", "Height of the sliver", "pixels", powers(-24, 0, 2), True),
            Axis("offset", "Distance of the centres from its side", "pixels", powers(-50, -2, 3), True),
        ),
        FORMATS,
        "float16 fails at 1/4 pixel, snapped corners below 1/256 pixel, float32 below 2^-16 and float64 below 2^-45; "
        "exact numbers never do.",
    ),
    sliver,
)


EXPERIMENTS = (SLIVERS,)
