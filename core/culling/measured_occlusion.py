"""Occluders measured: what the largest boxes hide of others behind them, and what comparing these takes."""

import numpy as np

from core.pipeline import render
from core.records.arrays import Integers
from core.records.frame import Frame, StageCount
from core.scene import Camera, Mesh, Scene
from core.settings import Settings
from core.stages.declared import STAGES
from core.stages.passes import planned_passes
from core.stages.vertices import process_geometry
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import WRONG_VISIBLE, SeenTask
from core.study.record import Axis, WorkKind
from core.study.workloads import random_source

SIZE = (128, 96)
WALLS = 8
"""Walls side by side, each an eighth of what the view is wide there."""
_CORNERS = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
_SIDES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def walls_before_boxes(count: int, seed: int) -> Scene:
    """Return walls, the smallest first, before ``count`` boxes of side 0.8 at random places."""
    random = random_source(seed)
    triangles = np.array([side[:1] + pair for side in _SIDES for pair in (side[1:3], side[2:])])
    heights = np.linspace(2.0, 6.0, WALLS)
    left = np.linspace(-4.4, 3.3, WALLS)
    boxes = [
        _CORNERS * (1.05, height, 0.2) + (x + 0.55, 0.0, -8.0)
        for x, height in zip(left, heights, strict=True)
    ]
    places = random.uniform((-9.0, -2.5, -24.0), (9.0, 2.5, -10.0), (count, 3))
    boxes += [_CORNERS * 0.8 + place for place in places]
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), near=1.0, far=60.0)
    return Scene(tuple(Mesh(corners, triangles) for corners in boxes), camera, (), SIZE)


class OccludersTask(SeenTask):
    """Walls before boxes, some of the walls occluders."""

    def __init__(self, scene: Scene, occluders: int) -> None:
        super().__init__(scene, len(scene.meshes), "cull", self._without_culling)
        self.turned = {"occluders": occluders}

    def _without_culling(self) -> Integers:
        return render(self.scene, Settings(shading="unlit")).primitive.astype(np.int64)

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and what boxes were compared with."""
        chosen = self.with_dials(settings)
        objects = process_geometry(self.scene, chosen, {s: StageCount() for s in STAGES}).culled.objects
        found = {"boxes outside the view": 0, "boxes hidden": 0, "texels read": 0}
        if objects is not None:
            found["boxes outside the view"] = len(self.scene.meshes) - len(objects.kept_leaves)
            if objects.occlusion is not None:
                found["boxes hidden"] = int(objects.occlusion.tests.is_hidden.sum())
                found["texels read"] = int((objects.occlusion.tests.texels[..., 0] >= 0).sum())
        passes = [each.scene for each in planned_passes(self.scene, chosen)]
        drawn = [len(mesh.triangles) for scene in passes if isinstance(scene, Scene) for mesh in scene.meshes]
        return {**found, "triangles of the pass": sum(drawn), **super().counts(chosen, made)}


def make_occluders(assignment: Assignment) -> OccludersTask:
    """Make the picture with so many boxes behind the walls, and so many occluders."""
    scene = walls_before_boxes(int(assignment.dials["boxes"]), assignment.seed)
    return OccludersTask(scene, int(assignment.dials["occluders"]))


OCCLUDERS = StudyFamily(
    "occluders",
    "Occluders",
    ("object_culling",),
    (
        WorkKind(
            "walls",
            "Walls before boxes",
            "frame",
            (
                Axis("occluders", "Occluders", "boxes", (1.0, 2.0, 4.0, 8.0, 16.0), default=4, is_cost=True),
                Axis("boxes", "Boxes behind the walls", "", (25.0, 100.0, 400.0), default=100),
            ),
        ),
    ),
    (WRONG_VISIBLE,),
    make_occluders,
    Settings(shading="unlit", hierarchy="none"),
)
