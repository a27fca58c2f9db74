"""Culling by three ways to see which side of a face is turned to the eye, beside the centre of the picture."""

import numpy as np

from core.coverage.measured_cover import CoverageExperiment, CoverCase, on_its_grid
from core.interpolation.measured import exact_planes
from core.records.arrays import Integers
from core.scene import ClipScene
from core.settings import Settings
from core.study.record import Axis
from core.study.workloads import flat_scene

SIDE = 96
"""Columns and rows of the pictures, which see 45 degrees to every side."""
REACH = 0.3
"""Distance of the corners from the middle of the triangle, over its distance from the eye."""


def fronts_alone(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64, how many triangles cover each pixel of those that show the eye their front."""
    is_front = [exact_planes(corners, scene.size).determinant > 0 for corners in scene.clip]
    if not any(is_front):
        return np.zeros(scene.size[::-1], np.int64)
    return on_its_grid(flat_scene(scene.clip[is_front], scene.size), settings)


def tilted_face(angle: float, tilt: float) -> ClipScene:
    """Return a triangle seen ``angle`` degrees beside the axis, its front turned to the eye by ``tilt`` degrees.

    At a tilt of 0 the eye lies in its plane. Its normal leads back across the axis.
    """
    a, t = np.radians(angle), np.radians(tilt)
    ray, aside = np.array([np.sin(a), 0.0, -np.cos(a)]), np.array([np.cos(a), 0.0, np.sin(a)])
    normal = -aside * np.cos(t) - ray * np.sin(t)
    up = np.array([0.0, 1.0, 0.0])
    across = np.cross(up, normal)
    turn = np.radians([90.0, 210.0, 330.0])
    corners = ray + REACH * (np.outer(np.cos(turn), across) + np.outer(np.sin(turn), up))
    x, y, z = corners.T
    return flat_scene(np.stack([x, y, np.zeros(3), -z], axis=1)[None], (SIDE, SIDE))


class FacingCase(CoverCase):
    """One triangle, of which the fronts alone are to be drawn."""

    stage = "cull"


FACING = CoverageExperiment(
    "facing-off-axis",
    "Which side of a face beside the centre",
    "A triangle beside the centre of the picture turns its front or its back to the eye. Does culling keep it "
    "exactly where its front is seen?",
    (
        Axis("angle", "Angle from the camera's axis", "degrees", (0.0, 5.0, 10.0, 20.0, 30.0, 40.0)),
        Axis(
            "tilt",
            "Tilt of the front towards the eye",
            "degrees",
            (-30.0, -20.0, -10.0, -5.0, 5.0, 10.0, 20.0, 30.0),
        ),
    ),
    ("cull=back-axis", "cull=back-normal", "cull=back-stored-normal", "cull=back"),
    "With the direction of the camera as V, fronts are lost whose tilt is less than their angle from the axis. "
    "With V from the eye to the face, and with the determinant, all are right.",
    lambda place, _: tilted_face(*place),
    FacingCase,
    wanted=fronts_alone,
)
EXPERIMENTS = (FACING,)
