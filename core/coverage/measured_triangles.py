"""Number formats on slivers, far corners, flat triangles and small cells, and meshes without gaps: experiments."""

import numpy as np

from core.coverage.measured_cover import CoverageExperiment, once_everywhere
from core.records.arrays import Floats
from core.scene import ClipScene
from core.study.record import Axis
from core.study.workloads import (
    clip_of_window,
    flat_scene,
    grid_triangles,
    on_grid,
    random_source,
    window_mesh,
)

SIZE = (64, 64)
"""A power of two: window positions that are multiples of 1/256 pixel are exact in clip space."""
W_RATIOS = (0.001, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1000.0)
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


def scene_of_window(window: Floats, size: tuple[int, int] = SIZE) -> ClipScene:
    """Return triangles with corners (T, 3, 2) in pixels, all at one depth, w = 1."""
    level = np.ones(window.shape[:2])
    return flat_scene(clip_of_window(window, size, 0.5 * level, level), size)


def powers(first: int, last: int, step: int = 1) -> tuple[float, ...]:
    """Return 2^first to 2^last."""
    return tuple(2.0**exponent for exponent in range(first, last + 1, step))


def sliver(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle ``width`` pixels high whose long side lies ``offset`` pixels below a row of pixel centres.

    Notes
    -----
    The side has the slope 1/3 and passes under ten centres. It begins at the window's middle, where clip space has
    its 0: there it holds 2^-50 pixel.
    """
    width, offset = place
    start, end = np.array([0.5, 0.5]), np.array([27.5, 9.5])
    clip = np.array([[*point, 0.0, 1.0] for point in (start / 32, end / 32, (start + end) / 64)])
    clip[:, 1] -= offset / 32
    clip[2, 1] += width / 32
    return flat_scene(clip[None], SIZE)


def far_corners(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle whose far corners lie ``distance`` pixels away; one edge passes through the window.

    Notes
    -----
    The edge passes ``offset`` steps of 1/256 pixel below pixel centres, about in the diagonal. All corners are on the
    1/256-pixel grid, so that snapping changes nothing.
    """
    distance, steps = place
    below = np.array([32.5, 32.5 - steps / 256])
    far = distance * np.array([1.0, 0.75])
    window = np.array([below - far, below + far, below + distance * np.array([-0.5, 1.0])])
    return scene_of_window(on_grid(window, 256)[None])


def edge_on(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle almost seen edge-on: its corners' matrix is about ``distance`` from a singular one.

    Notes
    -----
    It is ``distance`` pixels high, with a row of pixel centres at half its height; one corner has w = 1, another
    w = ``ratio``, the third their mean.
    """
    distance, ratio = place
    below = np.array([0.0, distance / 2])
    start, end = np.array([4.5, 8.5]) - below, np.array([58.5, 44.5]) - below
    window = np.array([start, end, (start + end) / 2 + 4 * below])
    w = np.array([1.0, ratio, (1.0 + ratio) / 2])
    return flat_scene(clip_of_window(window[None], SIZE, np.full((1, 3), 0.5), w[None]), SIZE)


def crowded_mesh(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a mesh whose grid lines crowd around the pixel centres, ``cell`` pixels apart: small cells and long ones.

    Notes
    -----
    Every pixel belongs to exactly one triangle. ``shift`` moves the lines, in cells. Corners are moved by less than a
    quarter of a cell, so that no triangle turns over.
    """
    cell, shift = place
    side, reach = 4, 2
    source = random_source(seed)
    around = cell * (np.arange(-reach, reach + 1) + shift)
    lines = np.concatenate([[-1.0], (0.5 + np.arange(side)[:, None] + around).ravel(), [side + 1.0]])
    points = np.stack(np.meshgrid(lines, lines), axis=-1)
    points[1:-1, 1:-1] += cell * on_grid(source.uniform(-0.24, 0.24, (len(lines) - 2, len(lines) - 2, 2)))
    return scene_of_window(grid_triangles(points), (side, side))


SLIVERS = CoverageExperiment(
    "slivers",
    "Slivers by width and offset",
    "The lower side of a long thin triangle lies just below ten pixel centres. How thin may it be, and how "
    "close?",
    (
        Axis("width", "Height of the sliver", "pixels", powers(-24, 0, 3), True),
        Axis("offset", "Distance of the centres from its side", "pixels", powers(-50, -2, 3), True),
    ),
    FORMATS,
    "Snapped corners lose slivers thinner than 1/256 pixel. float32 errs from 2^-17 pixel on, float64 from "
    "2^-47. Whole numbers of any length are right at every width and offset.",
    sliver,
)


COORDINATES = CoverageExperiment(
    "coordinates",
    "Coordinates from 1 to 2^30 pixels",
    "An edge passes just below pixel centres of the window while its ends move away. When is a pixel lost?",
    (
        Axis("distance", "Distance of the corners", "pixels", powers(3, 30, 1), True),
        Axis(
            "steps", "Distance of the edge from the centres", "1/256 pixel", tuple(map(float, range(-4, 5)))
        ),
    ),
    FORMATS,
    "32 bits wrap around from 128 pixels on, 64 bits beyond 4 million. float32 errs from 2^17 pixels on. "
    "float64 and whole numbers of any length are right up to 2^30.",
    far_corners,
)


SINGULAR = CoverageExperiment(
    "singular-matrix",
    "Triangles seen almost edge-on",
    "The 3x3 matrix of the corners is nearly singular. Do its inverse, its adjugate and whole numbers agree?",
    (
        Axis("distance", "Distance from a singular matrix", "pixels", powers(-54, 0, 3), True),
        Axis("ratio", "w of the second corner over the first", "", W_RATIOS, True),
    ),
    ("coverage=float32", "coverage=inverse", "coverage=snapped", "coverage=float64", "coverage=exact"),
    "Floats err where a triangle is flatter than their spacing, snapped corners where it is flatter than "
    "1/256 pixel. Whole numbers of any length are right at any distance.",
    edge_on,
)


SNAPPING = CoverageExperiment(
    "snapping",
    "Corners snapped or not",
    "The grid lines of a mesh move closer and closer around pixel centres. Is every pixel drawn exactly once?",
    (
        Axis("cell", "Size of a cell", "pixels", powers(-20, -3, 1), True),
        Axis(
            "shift",
            "Place of the lines",
            "cells",
            (-0.5, -0.375, -0.25, -0.125, 0.0, 0.125, 0.25, 0.375, 0.5),
        ),
    ),
    ("coverage=float32", "coverage=snapped", "coverage=int64", "coverage=float64", "coverage=exact"),
    "Snapping can turn over triangles of about 1/256 pixel, and they are drawn twice. float32 errs below 2^-9"
    " pixel, whatever the grid. float64 and whole numbers draw every pixel once.",
    crowded_mesh,
    wanted=once_everywhere,
)


SIDE = 32
"""Columns and rows of the pictures."""


def uneven_grid(cells: int, steps: int, seed: int) -> ClipScene:
    """Return a mesh of uneven cells that reaches beyond the window, with corners at multiples of 1/steps pixel."""
    return scene_of_window(window_mesh((SIDE, SIDE), cells, seed, steps), (SIDE, SIDE))


def through_the_eye(tilt: float, cells: int, seed: int) -> ClipScene:
    """Return a plane that fills the window and goes on behind the eye, as a grid of ``cells`` x ``cells`` cells.

    Notes
    -----
    Its points are (s, t, 1 - tilt t) in clip x, y, w. The window's top sees t = 1 / (1 + tilt), its bottom
    t = -1 / (1 - tilt); the grid reaches to t = 4, where w is negative for a tilt above 1/4.
    """
    source = random_source(seed)
    low, high = -1.0 / (1.0 - tilt) - 1.0, 4.0
    across, along = np.meshgrid(np.linspace(-5, 5, cells + 1), np.linspace(low, high, cells + 1))
    points = np.stack([across, along], axis=-1)
    step = np.array([10.0, high - low]) / cells
    points[1:-1, 1:-1] += source.uniform(-0.24, 0.24, (cells - 1, cells - 1, 2)) * step
    x, y = on_grid(points).transpose(2, 0, 1)
    clip = np.stack([x, y, np.zeros_like(x), 1.0 - tilt * y], axis=-1)
    return flat_scene(grid_triangles(clip), (SIDE, SIDE))


SHARED_EDGES = CoverageExperiment(
    "shared-edges",
    "Shared edges of a mesh",
    "A mesh fills the window, with its corners on a grid. Is every pixel drawn exactly once?",
    (
        Axis("steps", "Grid steps of the corners per pixel", "", powers(0, 10), True),
        Axis("cells", "Cells along a side", "", (4.0, 6.0, 8.0, 12.0, 16.0), True),
    ),
    (
        *("fill=scanline-lecture", "fill_rule=exclusive", "fill_rule=inclusive", "coverage=float16"),
        *("coverage=inverse", "coverage=float32", "coverage=float64", "fill_rule=shared-edge"),
        *("fill=spans", "coverage=exact"),
    ),
    "Where corners lie on pixel centres, exclusive edges leave cracks and inclusive edges are drawn twice. "
    "The shared-edge rule draws every pixel once if an edge has the same value in both triangles.",
    lambda place, seed: uneven_grid(int(place[1]), int(place[0]), seed),
    wanted=once_everywhere,
)


THROUGH_THE_EYE = CoverageExperiment(
    "mesh-through-the-eye",
    "A mesh that continues behind the eye",
    "A plane fills the window and continues behind the eye, where w is negative. Is every pixel drawn exactly"
    " once?",
    (
        Axis("tilt", "Decrease of w per unit of y", "", tuple((np.arange(9) / 10).tolist())),
        Axis("cells", "Cells along a side", "", (2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0), True),
    ),
    (
        "clipping=project-first",
        "clipping=after-divide",
        "clipping=sutherland-hodgman-lecture",
        "clipping=sutherland-hodgman",
        "clipping=homogeneous",
        "coverage=float64",
        "coverage=exact",
    ),
    "Projecting first mirrors corners with w < 0 and draws the wrong triangle. Clipping in clip space and "
    "homogeneous edge functions draw every pixel once.",
    lambda place, seed: through_the_eye(place[0], int(place[1]), seed),
    wanted=once_everywhere,
)


EXPERIMENTS = (SLIVERS, COORDINATES, SINGULAR, SNAPPING, SHARED_EDGES, THROUGH_THE_EYE)
