"""Watertightness of any scene: whether every pixel is covered as often as exact arithmetic says."""

from functools import cache

from core.records.arrays import Floats
from core.scene import AnyScene, ClipScene
from core.stages.vertex_program import vertex_stage
from core.study.accuracy.record import Axis
from core.study.accuracy.workloads import flat_scene
from core.study.stability.coverage.covered_pixels import CoverageExperiment, on_its_grid

NAME = "open-scene"
COLUMNS = (8.0, 16.0, 24.0, 32.0, 48.0)
SHIFTS = (0.0, 0.25, 0.5, 0.75)
MOST_TRIANGLES = 100_000
"""Of these, formats that test the whole raster take some ten seconds for one cell."""
METHODS = (
    "fill_rule=exclusive",
    "fill_rule=inclusive",
    "fill=scanline-lecture",
    "coverage=float16",
    "coverage=inverse",
    "coverage=float32",
    "coverage=float64",
    "fill_rule=shared-edge",
    "fill=spans",
    "coverage=exact",
)
"""As for the meshes of ``shared-edges``."""


def watertightness(scene: AnyScene, title: str) -> CoverageExperiment:
    """Return an experiment on one scene: its triangles, as pictures of several sizes, moved by parts of a pixel.

    Parameters
    ----------
    title : str
        What it is called.

    Notes
    -----
    Right is a pixel that is covered by as many triangles as in rational arithmetic, which gives every shared edge to
    one of its two triangles; for methods that snap, the corners are snapped for the reference too. Facing and depth
    do not count: z is left out, so that no triangle is cut off at the near or the far plane.
    """
    width, height = scene.size

    @cache
    def clip() -> Floats:
        """Not before it is run: the scene may be large, and nobody may ask."""
        vertices = vertex_stage(scene)
        if len(vertices.corners) > MOST_TRIANGLES:
            raise ValueError(
                f"at most {MOST_TRIANGLES:,} triangles can be counted exactly, got {len(vertices.corners):,}."
            )
        flat = vertices.clip[vertices.corners]
        flat[..., 2] = 0.0
        return flat

    def moved(place: tuple[float, ...], seed: int) -> ClipScene:
        columns = int(place[0])
        rows = max(round(columns * height / width), 1)
        there = clip().copy()
        there[..., 0] += 2.0 * place[1] / columns * there[..., 3]
        return flat_scene(there, (columns, rows))

    return CoverageExperiment(
        NAME,
        "Watertightness of the open scene",
        f"The triangles of {title or 'the scene'}, larger and larger and moved by parts of a pixel: "
        "is every pixel covered as often as it should be?",
        (
            Axis("columns", "Columns of the picture", "", COLUMNS, True),
            Axis("shift", "Moved to the right by", "pixels", SHIFTS),
        ),
        METHODS,
        "Exclusive edges leave cracks and inclusive ones are drawn twice where edges pass through pixel centres; "
        "whole numbers of any length are right for every scene.",
        moved,
        wanted=on_its_grid,
    )
