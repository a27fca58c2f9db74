"""What the pictures of covered pixels are judged by: colours, order, which of any triangles is the nearest."""

import numpy as np

from core.methods import table
from core.records.arrays import Flags, Floats, Integers
from core.records.cached import cached_property
from core.records.frame import Frame
from core.scene import ClipScene, Mesh, Scene
from core.settings import Settings
from core.stages.vertex_program import vertex_stage
from core.study.accuracy.frame_task import judge_order
from core.study.accuracy.record import Judgement
from core.study.exact.values import exact_nearest
from core.study.stability.case_text import pixels_text
from core.study.stability.experiment import Case


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
