"""Study of culling: what is drawn less, and what is missing then."""

import numpy as np

from core.geometry.vertex_stage import transform_vertices
from core.records.arrays import Integers
from core.records.cached import cached_property
from core.records.frame import Frame
from core.scene import Camera, DirectionalLight, Mesh, Scene
from core.settings import Settings
from core.study.accuracy.family import Assignment, Errors, StudyFamily
from core.study.accuracy.frame_task import WRONG_VISIBLE, FrameTask, color_pictures, per_million
from core.study.accuracy.record import Dial, Pictures, WorkKind
from core.study.accuracy.visible import colors_of
from core.study.accuracy.workloads import sphere_mesh
from core.study.exact.values import exact_fragments, exact_visible

SIDE = 96
RINGS = Dial("rings", "Rings of the sphere", "", (4, 6, 8, 12, 16, 24, 32), 12, is_cost=True)


class CullingTask(FrameTask):
    """A sphere that is closed or cut open; the reference sees both sides."""

    stage = "cull"

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene, sum(len(mesh.triangles) for mesh in scene.meshes))

    @cached_property
    def reference(self) -> Integers:
        """(H, W) int64, the nearest triangle, whichever way it faces; -1: none."""
        vertices = transform_vertices(self.scene)
        clip = vertices.clip[vertices.corners]
        return exact_visible(exact_fragments(clip, self.scene.size), self.scene.size)

    def errors(self, settings: Settings, made: Frame) -> Errors:
        """Count the pixels that show another triangle, or none."""
        wrong = int(np.count_nonzero(made.primitive != self.reference))
        return {WRONG_VISIBLE.name: per_million(wrong, made.primitive.size)}

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return a colour for each triangle seen."""
        return color_pictures(colors_of(made.primitive), colors_of(self.reference))


def make_culling(assignment: Assignment) -> CullingTask:
    """Make a sphere, whole or without its upper part."""
    mesh = sphere_mesh(int(assignment.dials["rings"]))
    if assignment.work == "open":
        lower = mesh.positions[mesh.triangles][..., 1].mean(axis=1) < 0.4
        mesh = Mesh(mesh.positions, mesh.triangles[lower], mesh.normals, name="open sphere")
    camera = Camera(np.array([0.0, 2.0, 2.6]), np.zeros(3), near=1.0, far=6.0)
    return CullingTask(Scene((mesh,), camera, (DirectionalLight(np.array([0.4, -0.8, -0.7])),), (SIDE, SIDE)))


CULL = StudyFamily(
    "cull",
    "Culling",
    ("cull",),
    (
        WorkKind("closed", "A closed surface", "triangle", (RINGS,)),
        WorkKind("open", "A surface that is open on one side", "triangle", (RINGS,)),
    ),
    (WRONG_VISIBLE,),
    make_culling,
    Settings(shading="unlit"),
)
