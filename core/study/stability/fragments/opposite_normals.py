"""Normals between opposite ones: what is interpolated is 0 in the middle, and has no direction.

References
----------
B. T. Phong, *Illumination for computer generated pictures*, 1975 (normals are interpolated, and made unit).
K. Shoemake, *Animating rotation with quaternion curves*, 1985 (turning evenly along the arc).
"""

import numpy as np

from core.fragments.lighting import light_surface
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import Frame
from core.scene import Camera, DirectionalLight, Material, Mesh, Scene
from core.settings import Settings
from core.stages.vertex_light import viewpoint
from core.study.accuracy.frame_task import judge_colors
from core.study.accuracy.record import Axis, Judgement
from core.study.accuracy.workloads import strip_triangles
from core.study.exact.values import exact_values
from core.study.stability.case_text import pixels_text
from core.study.stability.experiment import Case, Experiment
from core.study.stability.fragments.cases import clip_corners, faces_the_eye, mesh_and_normals
from core.study.stability.kinds import LIT_MESHES

SIZE = (65, 3)
"""An odd number of columns: the centre of the middle one is where opposite normals interpolate to 0."""
MATERIAL = Material(ambient=0.1, diffuse=0.8, specular=0.0, shininess=1.0)
TOLERANCE = 8.0
"""Largest colour error, in 1/255, that is taken as right."""
LIGHT = DirectionalLight(np.array([0.3, -0.2, -1.0]))


class NormalsCase(Case):
    """Triangles whose normals are turned about the upright; right is light on normals that turn evenly between them.

    Raises ValueError if a normal is not level, or leads away from the eye, or a triangle is seen from behind.
    """

    scene: Scene
    stage = "shade"

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene)
        self._mesh, normals = mesh_and_normals(scene)
        if normals[:, 1].any() or (normals[:, 2] < 0).any() or not normals.any(axis=1).all():
            raise ValueError("every normal must be turned from the front about the upright, got another one")
        if scene.camera.projection != "orthographic" or not faces_the_eye(scene).all():
            raise ValueError("every triangle must be seen from the front, by parallel rays, got another one")
        self._turn = np.arctan2(normals[:, 0], normals[:, 2])

    def _shown_and_wanted(self, frame: Frame) -> tuple[Floats, Floats]:
        """Return the colours as drawn and as they should be, (H, W, 3) each; the same where nothing is drawn."""
        shown = frame.color[..., :3].astype(np.float64)
        wanted = shown.copy()
        for triangle in np.unique(frame.primitive[frame.primitive >= 0]).tolist():
            row, column = np.nonzero(frame.primitive == triangle)
            wanted[row, column] = self._evenly_lit(triangle, column, row)
        return shown, wanted

    def _evenly_lit(self, triangle: int, column: Integers, row: Integers) -> Floats:
        """Return the colours (F, 3) of pixels (F,) of a triangle, if its normals turn evenly."""
        vertices = self._mesh.triangles[triangle]
        given = np.column_stack([self._turn[vertices], self._mesh.positions[vertices]])
        values = exact_values(clip_corners(self.scene)[triangle], given, self.scene.size, column, row)
        turn, position = values[:, 0], values[:, 1:]
        normal = np.stack([np.sin(turn), np.zeros(len(turn)), np.cos(turn)], axis=1)
        seen_from = viewpoint(self.scene.camera, position)
        diffuse, specular = light_surface(
            position, normal, seen_from, self.scene.lights, self._mesh.material, False
        )
        return diffuse + specular

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Compare the colours with those of normals that turn evenly."""
        return judge_colors(*self._shown_and_wanted(made), TOLERANCE)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that ``wrong`` pixels, (H, W) bool, are lit as by normals that turn evenly."""
        _, wanted = self._shown_and_wanted(made)
        return pixels_text(
            wrong, wanted, f"255 * np.abs(frame.color[row, column, :3] - wanted).max() <= {TOLERANCE}"
        )


def flattened_tube(angle: float, parts: int) -> Scene:
    """Return a flat strip that is lit like half a tube: its normals turn evenly, by ``angle`` degrees in all."""
    width, height = SIZE
    aspect = width / height
    x = np.linspace(-aspect, aspect, parts + 1)
    positions = np.array([[at, y, 0.0] for at in x for y in (-1.0, 1.0)])
    normals = np.repeat(turned_normals(np.linspace(0, 1, parts + 1), angle), 2, axis=0)
    mesh = Mesh(positions, strip_triangles(parts), normals, material=MATERIAL, name="half a tube, flattened")
    camera = Camera(
        np.array([0.0, 0.0, 1.0]), np.zeros(3), projection="orthographic", view_height=2.0, near=0.5, far=2.0
    )
    return Scene((mesh,), camera, (LIGHT,), SIZE)


def turned_normals(part: Floats, angle: float) -> Floats:
    """Return unit normals (N, 3) at parts (N,) of the way, turned by ``angle`` degrees about the upright in all."""
    turn = np.radians(angle) * (part - 0.5)
    across = np.cos(turn)
    # A quarter turn to either side is exactly opposite: the cosine of the rounded angle is not quite 0.
    across[np.abs(across) < 1e-15] = 0.0
    return np.stack([np.sin(turn), np.zeros(len(part)), across], axis=1)


NORMALS = Experiment(
    "opposite-normals",
    "Normals that interpolate to zero",
    "The normals at the two ends of a strip point away from each other, up to opposite directions. Which "
    "colour lies between them, and does dividing the strip help?",
    (
        Axis("angle", "Angle between the normals", "degrees", (0, 30, 60, 90, 120, 150, 170, 179, 180)),
        Axis("parts", "Parts of the strip", "", (1, 2, 3, 4, 6, 8, 16, 32), True),
    ),
    ("shading=flat", "shading=gouraud", "shading=phong"),
    "Nothing becomes NaN. Where opposite normals meet, the interpolated normal has no direction, and Phong "
    "and Gouraud draw a wrong picture. Divided into three parts or more, Phong is right at every angle. "
    "Gouraud needs sixteen.",
    lambda place, _: flattened_tube(place[0], int(place[1])),
    NormalsCase,
    kind=LIT_MESHES,
)
