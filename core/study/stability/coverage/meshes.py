"""Meshes without gaps: every pixel of the window is to be covered exactly once."""

import numpy as np

from core.scene import ClipScene
from core.study.accuracy.record import Axis
from core.study.accuracy.workloads import flat_scene, grid_triangles, on_grid, random_source, window_mesh
from core.study.stability.coverage.covered_pixels import CoverageExperiment, once_everywhere
from core.study.stability.coverage.number_formats import powers, scene_of_window

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
        "fill=scanline-lecture",
        "fill_rule=exclusive",
        "fill_rule=inclusive",
        "coverage=float16",
        "coverage=inverse",
        "coverage=float32",
        "coverage=float64",
        "fill_rule=shared-edge",
        "fill=spans",
        "coverage=exact",
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
EXPERIMENTS = (SHARED_EDGES, THROUGH_THE_EYE)
