"""What pictures are judged by: colours, order, which of any triangles is nearest; and the cover of any scene."""

from functools import cache

import numpy as np

from core.coverage.measured_cover import CoverageExperiment, on_its_grid
from core.interpolation.measured import exact_nearest
from core.methods import table
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene, Mesh, Scene
from core.settings import Settings
from core.stages.fragment_color import vertex_stage
from core.study.case_text import pixels_text
from core.study.experiment import Case
from core.study.frame_task import judge_order
from core.study.record import Axis, Judgement
from core.study.workloads import flat_scene

# What the pictures of covered pixels are judged by: colours, order, which of any triangles is the nearest.


class NearestCase(Case):
    """Triangles given in clip space; right is the nearest one at every pixel. Of two as near, either is right."""

    scene: ClipScene
    stage = "depth"

    @cached_property
    def nearest(self) -> Integers:
        """(H, W) int64, the triangle that is seen; of those as near, the first."""
        return exact_nearest(self.scene.clip, self.scene.size)

    @cached_property
    def is_decided(self) -> Flags:
        """(H, W) bool, False where several triangles are exactly as near: the last of them is not the first."""
        return np.asarray(self._last(self.scene.clip) == self.nearest)

    @cached_property
    def is_decided_by_w(self) -> Flags:
        """(H, W) bool, where the same triangle is the nearest by w as by z, for formats that store w.

        Notes
        -----
        After projection z and w tell the same; with digits left out they need not any more.
        """
        clip = self.scene.clip.copy()
        # The depth -c/w grows with w, and with c so small it is between the planes.
        clip[..., 2] = -np.abs(clip[..., 3]).min() / 2
        first = exact_nearest(clip, self.scene.size)
        return np.asarray((first == self.nearest) & (self._last(clip) == self.nearest))

    def _last(self, clip: Floats) -> Integers:
        """Return the nearest triangle, (H, W) int64; of those as near, the last."""
        backwards = exact_nearest(clip[::-1], self.scene.size)
        return np.where(backwards < 0, -1, len(clip) - 1 - backwards)

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count the pixels that show a triangle which is hidden."""
        wrong = np.asarray(made.primitive != self.nearest)
        if wrong.any():
            wrong = wrong & self.is_decided
        if wrong.any() and "perspective" in table.get("depth", settings.depth).needs:
            wrong = wrong & self.is_decided_by_w
        return judge_order(wrong, "a triangle that should be hidden")

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that ``wrong`` pixels, (H, W) bool, show the nearest triangle."""
        return pixels_text(wrong, self.nearest, "frame.primitive[row, column] == wanted")


def clip_corners(scene: Scene) -> Floats:
    """Return the corners (T, 3, 4) of all triangles in clip space."""
    vertices = vertex_stage(scene)
    return np.asarray(vertices.clip[vertices.corners])


def faces_the_eye(scene: Scene) -> Flags:
    """Return which triangles, (T,) bool, are seen from the front, where they are in front of the eye."""
    return np.asarray(np.linalg.det(clip_corners(scene)[..., [0, 1, 3]]) > 0)


def mesh_and_normals(scene: Scene) -> tuple[Mesh, Floats]:
    """Return the mesh of a scene that has one, and its normals (N, 3), which need not be unit.

    Raises ValueError if it has several, or no normals.
    """
    if len(scene.meshes) != 1 or scene.meshes[0].normals is None:
        raise ValueError("expected one mesh with normals, got another scene")
    return scene.meshes[0], scene.meshes[0].normals


# Watertightness of any scene: whether every pixel is covered as often as exact arithmetic says.


NAME = "open-scene"
COLUMNS = (8.0, 16.0, 24.0, 32.0, 48.0)
SHIFTS = (0.0, 0.25, 0.5, 0.75)
MOST_TRIANGLES = 100_000
"""Of these, formats that test the whole raster take some ten seconds for one cell."""
METHODS = (
    *("fill_rule=exclusive", "fill_rule=inclusive", "fill=scanline-lecture", "coverage=float16"),
    *("coverage=inverse", "coverage=float32", "coverage=float64", "fill_rule=shared-edge"),
    *("fill=spans", "coverage=exact"),
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
