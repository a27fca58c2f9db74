"""Normals between opposite ones: what is interpolated is 0 in the middle, and has no direction.

References
----------
B. T. Phong, *Illumination for computer generated pictures*, 1975 (normals are interpolated, and made unit).
K. Shoemake, *Animating rotation with quaternion curves*, 1985 (turning evenly along the arc).
"""

import numpy as np

from core.arrays import Floats
from core.fragments.lighting import light_surface
from core.scene import Camera, DirectionalLight, Material, Mesh, Scene
from core.settings import Settings
from core.study.stability.fragments.cases import (
    Case,
    CaseExperiment,
    Judgement,
    drawn_colors,
    judge_colors,
)
from core.study.stability.record import Axis, ExperimentInfo

SIZE = (65, 3)
"""An odd number of columns: the centre of the middle one is where opposite normals interpolate to 0."""
MATERIAL = Material(ambient=0.1, diffuse=0.8, specular=0.0, shininess=1.0)
TOLERANCE = 8.0
"""Largest colour error, in 1/255, that is taken as right."""
LIGHT = DirectionalLight(np.array([0.3, -0.2, -1.0]))


class NormalsCase(Case):
    """A flat strip that is lit like half a tube: its normals turn evenly from left to right, by an angle in all."""

    def __init__(self, angle: float, parts: int) -> None:
        width, height = SIZE
        aspect = width / height
        x = np.linspace(-aspect, aspect, parts + 1)
        positions = np.array([[at, y, 0.0] for at in x for y in (-1.0, 1.0)])
        normals = np.repeat(turned_normals(np.linspace(0, 1, parts + 1), angle), 2, axis=0)
        first = 2 * np.arange(parts)
        triangles = np.stack([first, first + 2, first + 3, first, first + 3, first + 1], axis=1).reshape(
            -1, 3
        )
        mesh = Mesh(positions, triangles, normals, material=MATERIAL, name="half a tube, flattened")
        camera = Camera(
            np.array([0.0, 0.0, 1.0]),
            np.zeros(3),
            projection="orthographic",
            view_height=2.0,
            near=0.5,
            far=2.0,
        )
        self.scene = Scene((mesh,), camera, (LIGHT,), SIZE)
        self.wanted = evenly_lit(angle)

    def judge(self, settings: Settings) -> Judgement:
        """Compare the colours with those of normals that turn evenly."""
        return judge_colors(drawn_colors(self.scene, settings)[..., :3], self.wanted, TOLERANCE)


def evenly_lit(angle: float) -> Floats:
    """Return the colours (H, W, 3) of normals that turn evenly by ``angle`` degrees from left to right."""
    width, height = SIZE
    normal = turned_normals((np.arange(width) + 0.5) / width, angle)
    # The light comes from infinitely far away, and nothing is mirrored: the place does not matter.
    diffuse, _ = light_surface(np.zeros((width, 3)), normal, np.ones(3), (LIGHT,), MATERIAL, False)
    return np.broadcast_to(diffuse, (height, width, 3))


def turned_normals(part: Floats, angle: float) -> Floats:
    """Return unit normals (N, 3) at parts (N,) of the way, turned by ``angle`` degrees about the upright in all."""
    turn = np.radians(angle) * (part - 0.5)
    across = np.cos(turn)
    # A quarter turn to either side is exactly opposite: the cosine of the rounded angle is not quite 0.
    across[np.abs(across) < 1e-15] = 0.0
    return np.stack([np.sin(turn), np.zeros(len(part)), across], axis=1)


def make_normals(place: tuple[float, ...], seed: int) -> NormalsCase:
    """Make the strip; nothing in it is random."""
    del seed
    return NormalsCase(place[0], int(place[1]))


NORMALS = CaseExperiment(
    ExperimentInfo(
        "opposite-normals",
        "Normals that interpolate to zero",
        "The normals at the two ends of a strip are turned against each other, up to opposite: what colour is between "
        "them, and does it help to divide the strip?",
        (
            Axis("angle", "Angle between the normals", "degrees", (0, 30, 60, 90, 120, 150, 170, 179, 180)),
            Axis("parts", "Parts of the strip", "", (1, 2, 3, 4, 6, 8, 16, 32), True),
        ),
        ("shading=flat", "shading=gouraud", "shading=phong"),
        "Nothing becomes NaN: where opposite normals meet, what is interpolated has no direction, and the picture "
        "is wrong for Phong and Gouraud. Divided into three parts or more, Phong is right at every angle; Gouraud "
        "needs sixteen.",
    ),
    make_normals,
    "shade",
    bound_to="the whole strip, along which normals should turn evenly",
)
