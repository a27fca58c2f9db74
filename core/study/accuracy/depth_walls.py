"""Study of depth formats: two walls, one a little nearer than the other, at all distances at once."""

import numpy as np

from core.records.arrays import Flags
from core.records.frame import Frame
from core.scene import Scene
from core.settings import Settings
from core.study.accuracy.family import Assignment, Errors, StudyFamily
from core.study.accuracy.frame_task import WRONG_VISIBLE, FrameTask, color_pictures, depth_bits, per_million
from core.study.accuracy.record import Dial, Pictures, WorkKind
from core.study.accuracy.workloads import COLORS, wall_scene

SIDES = Dial("side", "Side of the picture", "pixels", (32, 64, 128, 256, 512), 128, is_cost=True)


class WallTask(FrameTask):
    """Two walls, one a little nearer than the other: it has to be seen everywhere."""

    stage = "depth"

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene, 1, ("depth",))
        counts = [len(mesh.triangles) for mesh in scene.meshes]
        self._first, self._end = counts[0], counts[0] + counts[1]

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and the bits of one depth."""
        return super().counts(settings, made) | {"bits of a depth": depth_bits(settings)}

    def _is_wrong(self, made: Frame) -> Flags:
        return np.asarray((made.primitive < self._first) | (made.primitive >= self._end))

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Count the pixels that show the farther wall."""
        return {WRONG_VISIBLE.name: per_million(int(self._is_wrong(made).sum()), made.primitive.size)}

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours of the walls."""
        right = np.broadcast_to(COLORS[0], (*made.primitive.shape, 4))
        return color_pictures(np.where(self._is_wrong(made)[..., None], COLORS[1], right), right)


def make_depth(assignment: Assignment) -> WallTask:
    """Make the two walls."""
    dials = assignment.dials
    return WallTask(wall_scene(dials["far"], dials["gap"], int(dials["side"])))


DEPTH = StudyFamily(
    "depth",
    "Depth formats",
    ("depth",),
    (
        WorkKind(
            "walls",
            "Two walls, one just before the other",
            "frame",
            (
                Dial("far", "Far plane over near plane", "", (10, 100, 1e3, 1e4, 1e5, 1e6), 1e4),
                Dial("gap", "Gap, as a part of the distance", "", (1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2), 1e-5),
                SIDES,
            ),
        ),
    ),
    (WRONG_VISIBLE,),
    make_depth,
    Settings(shading="unlit", fill="bounding-box"),
)
