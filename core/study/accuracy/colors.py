"""Studies of colours: texture filters against 256 samples, antialiasing against areas, shading against the sphere."""

import numpy as np

from core.records.arrays import Floats
from core.records.frame import Frame
from core.records.primitives import lit_by
from core.scene import ClipScene, Scene
from core.settings import Settings
from core.study.accuracy.family import Assignment, StudyFamily
from core.study.accuracy.frame_task import LARGEST_COLOR, MEAN_COLOR, ColorTask
from core.study.accuracy.record import Axis, WorkKind
from core.study.accuracy.sampled import sampled_picture
from core.study.accuracy.workloads import (
    checkerboard,
    clip_of_window,
    flat_scene,
    sphere_scene,
    textured_quad,
    window_mesh,
)
from core.study.exact.areas import area_in_pixels
from core.study.exact.sphere import sphere_picture
from core.trace import trace

TEXELS = 256
"""Texels on a side of the texture."""
DENSITIES = Axis("density", "Texels per pixel", "", (0.125, 0.25, 0.5, 1, 2, 4, 8, 16), default=4)
SIDES = Axis("side", "Side of the picture", "pixels", (16, 32, 64, 128, 256), default=64, is_cost=True)


class TextureTask(ColorTask):
    """A textured square."""

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and the texels that are read."""
        columns = trace(self.scene, settings, region=(0, 0, 1, 1)).stage("shade").columns
        # The texels of a fragment by their columns: of one level, or of the nearer and the farther.
        each = sum(values.shape[1] for name, values in columns.items() if name.rpartition("_")[2] == "texels")
        return super().counts(settings, made) | {"texels read": each * made.statistics["shade"].incoming}


def make_texture_filter(assignment: Assignment) -> TextureTask:
    """Make a textured square, facing the camera or leaning back.

    Notes
    -----
    Magnified, the texture is taken to be linear between texel centres, as OpenGL's bilinear filter does; with a texel
    or more for a pixel each texel is a square of one colour, whose mean over a pixel is what mipmaps keep.
    """
    side = int(assignment.dials["side"])
    repeats = side * assignment.dials["density"] / TEXELS
    ratio = 1.0 if assignment.work == "facing" else 4.0
    scene = textured_quad(side, ratio, repeats, checkerboard(TEXELS, assignment.seed))
    base = Settings(texture_filter="bilinear" if assignment.dials["density"] < 1 else "nearest")
    return TextureTask(scene, side * side, "shade", lambda: (sampled_picture(scene, base), None), ("shade",))


TEXTURE_FILTER = StudyFamily(
    "texture_filter",
    "Texture filters",
    ("texture_filter",),
    (
        WorkKind("facing", "A textured square, facing the camera", "pixel", (DENSITIES, SIDES)),
        WorkKind("leaning", "A textured square, leaning back", "pixel", (DENSITIES, SIDES)),
    ),
    (MEAN_COLOR, LARGEST_COLOR),
    make_texture_filter,
)


def make_antialiasing(assignment: Assignment) -> ColorTask:
    """Make a mesh of flat colours with edges in all directions."""
    side = int(assignment.dials["side"])
    # On the 1/256-pixel grid: samples and areas see the same triangles, as nothing is snapped.
    window = window_mesh((side, side), 6, assignment.seed, 256)
    level = np.ones(window.shape[:2])
    scene = flat_scene(clip_of_window(window, (side, side), 0.5 * level, level), (side, side))
    return ColorTask(scene, side * side, "resolve", lambda: (mean_of_areas(window, scene), None))


def mean_of_areas(window: Floats, scene: ClipScene) -> Floats:
    """Return the colours (H, W, 4) float64 of triangles (T, 3, 2) in pixels side by side, by their exact areas."""
    row, column = (index.ravel() for index in np.mgrid[: scene.size[1], : scene.size[0]])
    assert scene.attributes is not None
    colors = np.zeros((len(row), 4))
    for corners, color in zip(window, scene.attributes[:, 0], strict=True):
        (ax, ay), (bx, by) = corners[1] - corners[0], corners[2] - corners[0]
        turned = corners if ax * by > ay * bx else corners[::-1]
        colors += area_in_pixels(turned, column, row)[:, None] * color
    return colors.reshape(*scene.size[::-1], 4)


ANTIALIASING = StudyFamily(
    "antialiasing",
    "Antialiasing",
    ("antialiasing",),
    (WorkKind("edges", "A mesh of flat colours, edges in all directions", "pixel", (SIDES,)),),
    (MEAN_COLOR, LARGEST_COLOR),
    make_antialiasing,
)


class ShadingTask(ColorTask):
    """A sphere of triangles; the reference is the sphere itself, met by every pixel's ray."""

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and how often the lighting rule is evaluated."""
        assert isinstance(self.scene, Scene)
        (mesh,), counts = self.scene.meshes, super().counts(settings, made)
        lit = {
            "fragments": counts["pixels shaded"],
            "vertices": len(mesh.positions),
            "faces": len(mesh.triangles),
            "nothing": 0,
        }
        return counts | {"lights evaluated": lit[lit_by(settings.shading)]}


def make_shading(assignment: Assignment) -> ShadingTask:
    """Make a sphere of triangles."""
    scene = sphere_scene(int(assignment.dials["rings"]), int(assignment.dials["side"]))
    return ShadingTask(scene, 1, "shade", lambda: sphere_picture(scene, 1.0)[::-1])


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
                Axis(
                    "rings",
                    "Rings of the sphere",
                    "",
                    (4, 6, 8, 12, 16, 24, 32, 48, 64),
                    default=16,
                    is_cost=True,
                ),
                Axis("side", "Side of the picture", "pixels", (32, 64, 128, 256), default=128),
            ),
        ),
    ),
    (MEAN_COLOR, LARGEST_COLOR),
    make_shading,
)
