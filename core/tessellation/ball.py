"""A ball of eight patches, which are nearly round: what is cut and diced in studies and scenes."""

import numpy as np

from core.records.arrays import Floats
from core.scene import Camera, DirectionalLight, Scene
from core.tessellation.patches import mesh_of_patches

SIDE, RADIUS = 48, 20.0
"""Pixels of the picture on a side, and of the ball's radius."""
ROUND = 4 / 3 * (2**0.5 - 1)
"""How far the inner control points of a quarter of a circle stand off, for radius 1: it is at most 0.03 % too large."""


def ball_patches() -> Floats:
    """Return the eight patches (8, 4, 4, 3) of a ball of radius 1 around the origin, y up; the front is outside."""
    arc = np.array([(1, 0), (1, ROUND), (ROUND, 1), (0, 1)])
    patches = []
    for quarter in range(4):
        around = arc @ np.linalg.matrix_power(np.array([[0.0, 1.0], [-1.0, 0.0]]), quarter)
        for sign in (1, -1):
            height = np.broadcast_to(sign * arc[:, 1], (4, 4))[..., None]
            net = np.concatenate([around[:, None] * arc[None, :, :1], height], axis=2)[..., [1, 2, 0]]
            # The half below runs around the other way.
            patches.append(net if sign > 0 else net[::-1])
    return np.array(patches)


def balls(layers: int) -> Scene:
    """Return balls one behind another, 40 pixels across, on a 48 x 48 picture without perspective."""
    meshes = []
    for layer in range(layers):
        matrix = np.diag([RADIUS, RADIUS, RADIUS, 1.0])
        matrix[:3, 3] = 0.0, 0.0, -45.0 * layer
        meshes.append(mesh_of_patches(ball_patches(), name=f"ball {layer}", transform=matrix))
    camera = Camera(
        eye=np.array([0.0, 0.0, 100.0]),
        target=np.zeros(3),
        projection="orthographic",
        view_height=float(SIDE),
        near=10.0,
        far=200.0 + 45 * layers,
    )
    light = DirectionalLight(np.array([-0.5, -0.8, -0.6]))
    return Scene(tuple(meshes), camera, (light,), (SIDE, SIDE))
