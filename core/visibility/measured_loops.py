"""Which loop is outside: what a z-buffer and rays ask of one sphere, as its triangles and its pixels grow.

A z-buffer sets up every triangle and tests every fragment. Rays ask triangles, each of them or those in the leaves of a
tree that they open, and the boxes of that tree. What is counted is how often; one box is not one fragment, and the
building of the tree is not counted.

References
----------
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "graphics pipelines vs. raytracing": O(n) against
O(log n) with a large constant.
"""

from core.depth.measured import visible_triangles
from core.records.frame import Frame
from core.scene import AnyScene
from core.settings import Settings
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import WRONG_VISIBLE, SeenTask
from core.study.record import Axis, WorkKind
from core.study.workloads import sphere_scene
from core.trees.measured import walk_of_all_rays

COMPARED = ("z-buffer", "ray-casting-by-pixel", "ray-casting-tree")
RINGS, SIDES = (4.0, 8.0, 16.0, 32.0, 64.0, 96.0), (8.0, 16.0, 32.0, 64.0, 128.0)
RINGS_TITLE, SIDE_TITLE = "Rings n of the sphere, 4 n (n − 1) triangles", "Side of the picture"


class LoopsTask(SeenTask):
    """A sphere, of which the nearest triangle is to be seen at every pixel."""

    def __init__(self, scene: AnyScene) -> None:
        super().__init__(scene, 1, "depth", lambda: visible_triangles(scene).astype("int64"))

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return how often a method asks something, and the sum.

        Notes
        -----
        This program finds hits by filling triangles, and so its time is not that of a loop over rays.
        """
        found = super().counts(settings, made)
        triangles, rays = found["triangles drawn"], self.scene.size[0] * self.scene.size[1]
        if settings.visibility == "z-buffer":
            asked = {"triangles set up": triangles, "fragments tested": found["depth tests"]}
        elif settings.visibility == "ray-casting-by-pixel":
            asked = {"triangles asked": rays * triangles}
        else:
            walk = walk_of_all_rays(self.scene, settings)
            asked = {"boxes asked": int(walk.box_count.sum()), "triangles asked": int(walk.asked_count.sum())}
        return {"asked in all: triangles, fragments, boxes": sum(asked.values()), **asked}


def make_loops(assignment: Assignment) -> LoopsTask:
    """Make the sphere of so many rings on so many pixels."""
    return LoopsTask(sphere_scene(int(assignment.dials["rings"]), int(assignment.dials["side"])))


LOOPS = StudyFamily(
    "loops",
    "Triangles outside, or pixels outside",
    ("visibility",),
    (
        WorkKind(
            "triangles",
            "A sphere of more and more triangles",
            "frame",
            (
                Axis("rings", RINGS_TITLE, "", RINGS, default=16, is_cost=True),
                Axis("side", SIDE_TITLE, "pixels", SIDES, default=16),
            ),
        ),
        WorkKind(
            "pixels",
            "A sphere on more and more pixels",
            "frame",
            (
                Axis("side", SIDE_TITLE, "pixels", SIDES, default=32, is_cost=True),
                Axis("rings", RINGS_TITLE, "", RINGS, default=64),
            ),
        ),
    ),
    (WRONG_VISIBLE,),
    make_loops,
    only=COMPARED,
)
