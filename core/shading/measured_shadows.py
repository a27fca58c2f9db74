"""Shadows measured: pixels that a shadow map leaves wrongly dark or wrongly lit, and the bias that surfaces need."""

import numpy as np

from core.pipeline import render
from core.records.arrays import Flags, Floats, cached_property
from core.records.frame import Frame
from core.scene import Camera, DirectionalLight, Mesh, Scene
from core.settings import Settings
from core.shading.shading import outward_normals
from core.shading.shadows import BIAS_STEPS
from core.stages.passes import lamp_of, map_camera, planned_passes
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import FrameTask, color_pictures, per_million
from core.study.record import Axis, ErrorMeasure, Judgement, Outcome, Pictures, Verdict, WorkKind
from core.transform.vertex_stage import place_meshes

WRONGLY_DARK = ErrorMeasure("wrongly-dark", "Lit pixels in the dark (acne)", "per million")
WRONGLY_LIT = ErrorMeasure("wrongly-lit", "Shadow pixels in the light", "per million")
BIASES = (0.0, 2.0, 4.0, 6.0, 8.0, 11.0, 16.0, 24.0, 32.0, 48.0, 64.0, 128.0)
MAP_SIZES = (8.0, 16.0, 32.0, 64.0, 128.0, 256.0)
ROUNDING = 1 / 512
"""Difference of colours that is none: half a byte."""


def needed_biases(scene: Scene, settings: Settings) -> tuple[Floats, Floats]:
    """Return the least bias that leaves no point of a triangle in its own shadow, and its share of the lit surface.

    Returns
    -------
    bias : (Q,) float64, in 1/16 texel, of the triangles that face the light
    share : (Q,) float64, their areas over the sum of these

    Notes
    -----
    Half a texel to each side of its middle the depth changes by half of the slopes along both axes of the map; of the
    mean of four texels, by twice as much.
    """
    world, lamp = place_meshes(scene.meshes), lamp_of(scene, settings)
    planned = planned_passes(scene, settings)[0]
    light = scene.lights[lamp.number]
    assert isinstance(light, DirectionalLight)
    normal = outward_normals(world.world[:, :3], world.normals, world.corners)
    area, faces = np.linalg.norm(normal, axis=1), normal @ -light.direction > 0
    across, up, along = lamp.to_map[:, :3]
    # A step of the plane that goes one texel across and none up turns along cross(up, normal), and so for one up.
    with np.errstate(divide="ignore", invalid="ignore"):
        right, above = np.cross(up, normal[faces]), np.cross(across, normal[faces])
        slope = np.abs((right @ along) / (right @ across)) + np.abs((above @ along) / (above @ up))
    camera = map_camera(planned)
    texel = camera.view_height / planned.scene.size[0] / (camera.far - camera.near)
    texels = 2.0 if settings.shadow == "map-average" else 1.0
    return BIAS_STEPS * texels * slope / 2 / texel, area[faces] / max(float(area[faces].sum()), 1e-300)


def box_on_floor() -> Scene:
    """Return a box of side 1 on a floor of 8 x 8, in slanting light."""
    floor = np.array([[-4.0, 0, -4], [4, 0, -4], [4, 0, 4], [-4, 0, 4]])
    corners = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (0.0, 1.0) for x in (-0.5, 0.5)])
    sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    # Each side has corners of its own, and so a normal of its own.
    box = np.concatenate([corners[list(side)] for side in sides])
    fans = np.array([[4 * k + i for i in fan] for k in range(6) for fan in ((0, 1, 2), (0, 2, 3))])
    meshes = Mesh(floor, np.array([[0, 2, 1], [0, 3, 2]]), name="floor"), Mesh(box, fans, name="box")
    camera = Camera(np.array([-3.0, 5, 5]), np.array([-0.4, 0.2, 0]), near=1, far=30)
    return Scene(meshes, camera, (DirectionalLight(np.array([-1, -1.2, -0.6])),), (96, 72))


class ShadowTask(FrameTask):
    """A box on a floor, whose shadow is compared with that of rays to the light."""

    stage = "shade"

    def __init__(self, size: int, bias: int) -> None:
        super().__init__(box_on_floor(), 1)
        self.turned = {"map_size": size, "shadow_bias": bias}

    @cached_property
    def reference(self) -> Frame:
        """The picture whose shadows are those of rays."""
        return render(self.scene, Settings(shadow="rays"))

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and the texels of the map."""
        planned = planned_passes(self.scene, self.with_dials(settings))
        dark, lit = self._wrong(made)
        return {
            "texels of the map": sum(each.scene.size[0] * each.scene.size[1] for each in planned),
            "lit pixels in the dark": int(dark.sum()),
            "shadow pixels in the light": int(lit.sum()),
            **super().counts(settings, made),
        }

    def _wrong(self, made: Frame) -> tuple[Flags, Flags]:
        """Return which pixels (H, W) get less light than by rays, and which more."""
        more = made.color[..., :3].astype(np.float64) - self.reference.color[..., :3]
        return np.asarray((more < -ROUNDING).any(axis=2)), np.asarray((more > ROUNDING).any(axis=2))

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count the pixels that get less light than by rays, and more."""
        dark, lit = self._wrong(made)
        wrong = np.asarray(dark | lit)
        count, seen = int(np.count_nonzero(wrong)), int(np.count_nonzero(made.primitive >= 0))
        outcome = Outcome.WRONG_PICTURE if count else Outcome.RIGHT
        said = f"{int(dark.sum())} pixels wrongly dark, {int(lit.sum())} wrongly lit"
        errors = {
            WRONGLY_DARK.name: per_million(int(dark.sum()), seen),
            WRONGLY_LIT.name: per_million(int(lit.sum()), seen),
        }
        return Judgement(Verdict(outcome, float(count), said), wrong, errors)

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours, and those by rays."""
        return color_pictures(made.color, self.reference.color)


def make_shadows(assignment: Assignment) -> ShadowTask:
    """Make the picture with a map of so many texels, and a bias."""
    return ShadowTask(int(assignment.dials["map"]), int(assignment.dials["bias"]))


SHADOW = StudyFamily(
    "shadow",
    "Shadows",
    ("shadow",),
    (
        WorkKind(
            "box",
            "Box on a floor",
            "frame",
            (
                Axis("bias", "Shadow bias", "sixteenths of a texel", BIASES, default=11, is_cost=True),
                Axis("map", "Shadow map", "texels on a side", MAP_SIZES, True, default=16),
            ),
        ),
    ),
    (WRONGLY_DARK, WRONGLY_LIT),
    make_shadows,
)
