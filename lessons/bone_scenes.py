"""Scenes of meshes that bones bend and twist, and of shapes that are blended."""

from dataclasses import replace
from math import pi, radians

import numpy as np

from core.deformation.deform import deform
from core.records.arrays import Floats, Integers
from core.records.deformations import Blend, Skin
from core.scene import Camera, Mesh, Scene
from core.settings import Settings
from lessons.shapes import FACE_COLORS, linear_color
from lessons.world_scenes import TEACHING_SIZE, sun

LENGTH, JOINT = 8.0, 4.0
"""Of the bars, and where on them the joint is."""


def two_bones(x: Floats, axis: tuple[float, float, float], degrees: float) -> Skin:
    """Return the bones of a bar along x: weights (N, 2) go over from one to the other from x = 3 to x = 5."""
    second = np.clip((x - (JOINT - 1)) / 2, 0.0, 1.0)
    return Skin(
        weights=np.stack([1 - second, second], axis=1),
        heads=np.array([[0.0, 0.0, 0.0], [JOINT, 0.0, 0.0]]),
        tails=np.array([[JOINT, 0.0, 0.0], [LENGTH, 0.0, 0.0]]),
        parents=np.array([-1, 0]),
        axes=np.array([axis, axis], float),
        angles=np.array([0.0, radians(degrees)]),
    )


def colored_by(skin: Skin) -> Floats:
    """Return colours (N, 4): each bone has one, and a vertex their mixture by its weights."""
    bones = np.array([linear_color(FACE_COLORS[k % 4]) for k in range(skin.joint_count)])
    colors: Floats = skin.weights @ bones
    return colors


def strips(rows: int, columns: int, is_closed: bool) -> Integers:
    """Return the triangles (T, 3) between rows of vertices; closed: the last of a row is beside the first."""
    found = []
    for row in range(rows - 1):
        for k in range(columns if is_closed else columns - 1):
            a, b = row * columns + k, row * columns + (k + 1) % columns
            c, d = a + columns, b + columns
            found += [(a, c, d), (a, d, b)]
    return np.array(found)


def flat_bar() -> Mesh:
    """Return a bar of 9 x 2 vertices in the plane z = 0, from x = 0 to 8 and y = -1 to 1, facing +z."""
    x, y = np.repeat(np.arange(LENGTH + 1), 2), np.tile([-1.0, 1.0], int(LENGTH) + 1)
    return Mesh(np.stack([x, y, np.zeros_like(x)], axis=1), strips(int(LENGTH) + 1, 2, False), name="bar")


def bent_bar(degrees: float = 90.0) -> Scene:
    """Return the flat bar, bent in the middle."""
    bar = flat_bar()
    skin = two_bones(bar.positions[:, 0], (0, 0, 1), degrees)
    return _seen(replace(bar, deformation=skin, colors=colored_by(skin)), (2.5, 1.5, 8.0), (2.5, 1.5, 0.0))


def tube() -> Mesh:
    """Return an open tube along x with 17 rings of 12 vertices, of radius 1."""
    turn = 2 * pi * np.arange(12) / 12
    x = np.repeat(np.linspace(0.0, LENGTH, 17), 12)
    y, z = np.tile(np.cos(turn), 17), np.tile(np.sin(turn), 17)
    return Mesh(np.stack([x, y, z], axis=1), strips(17, 12, True)[:, ::-1], name="tube")


def twisted_tube(degrees: float = 170.0) -> Scene:
    """Return a tube, one half of which is twisted about its own axis."""
    shape = tube()
    skin = two_bones(shape.positions[:, 0], (1, 0, 0), degrees)
    return _seen(replace(shape, deformation=skin, colors=colored_by(skin)), (4.0, 2.5, 9.0), (4.0, 0.0, 0.0))


def blended_bar() -> Scene:
    """Return the flat bar halfway between straight and turned by 90 degrees about its end."""
    bar = flat_bar()
    x, y, z = bar.positions.T
    turned = np.stack([-y, x, z], axis=1)
    shape = replace(
        bar,
        deformation=Blend(turned[None], np.array([0.5])),
        colors=np.tile(linear_color(FACE_COLORS[0]), (18, 1)),
    )
    return _seen(shape, (2.0, 2.0, 7.0), (2.0, 2.0, 0.0))


def _seen(mesh: Mesh, eye: tuple[float, float, float], target: tuple[float, float, float]) -> Scene:
    camera = Camera(eye=np.array(eye), target=np.array(target), near=1.0, far=40.0)
    return Scene((mesh,), camera, (sun(),), TEACHING_SIZE)


def posed(scene: Scene, method: str) -> Floats:
    """Return (N, 3) where a method of skinning puts the vertices of the first mesh."""
    return deform(scene.meshes[0], Settings(skinning=method)).positions
