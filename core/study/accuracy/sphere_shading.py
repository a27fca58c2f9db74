"""Study of shading: a sphere of triangles against the sphere itself."""

from core.records.arrays import Flags, Floats
from core.records.cached import cached_property
from core.records.frame import Frame
from core.scene import Scene
from core.settings import Settings
from core.study.accuracy.family import Assignment, Errors, StudyFamily
from core.study.accuracy.frame_task import (
    LARGEST_COLOR,
    MEAN_COLOR,
    FrameTask,
    color_errors,
    color_pictures,
    premultiplied,
)
from core.study.accuracy.record import Dial, Pictures, WorkKind
from core.study.accuracy.workloads import sphere_scene
from core.study.exact.sphere import sphere_picture


class SphereTask(FrameTask):
    """A sphere of triangles; the reference is the sphere itself, met by every pixel's ray."""

    stage = "shade"

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene, 1)
        self._sphere = scene

    @cached_property
    def reference(self) -> tuple[Flags, Floats]:
        """Where the sphere is seen (H, W), and its colours (H, W, 4)."""
        return sphere_picture(self._sphere, 1.0)

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Return the differences of the colours where both the triangles and the sphere are seen."""
        seen, color = self.reference
        return color_errors(premultiplied(made.color, settings), color, seen & (made.primitive >= 0))

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours."""
        return color_pictures(premultiplied(made.color, settings), self.reference[1])


def make_shading(assignment: Assignment) -> SphereTask:
    """Make the sphere."""
    return SphereTask(sphere_scene(int(assignment.dials["rings"]), int(assignment.dials["side"])))


SHADING = StudyFamily(
    "shading",
    "Shading",
    ("shading",),
    (
        WorkKind(
            "sphere",
            "A shining sphere",
            "frame",
            (
                Dial("rings", "Rings of the sphere", "", (4, 6, 8, 12, 16, 24, 32, 48, 64), 16, is_cost=True),
                Dial("side", "Side of the picture", "pixels", (32, 64, 128, 256), 128),
            ),
        ),
    ),
    (MEAN_COLOR, LARGEST_COLOR),
    make_shading,
)
