"""Scenes of Bezier curves and patches."""

from dataclasses import replace

import numpy as np

from core.records.arrays import Floats
from core.records.curves import Curves
from core.scene import Camera, ClipScene, Scene
from core.settings import DEFAULTS
from core.stages.before_matrices import before_matrices
from core.tessellation.ball import balls
from core.tessellation.patches import mesh_of_patches
from lessons.shapes import FACE_COLORS, linear_color
from lessons.world_scenes import TEACHING_SIZE, sun

ARCH = ((2.0, 4.0), (10.0, 40.0), (50.0, 44.0), (60.0, 6.0))
"""Control points of the curve of the lessons, in pixels."""


def curve_scene(control: Floats, size: tuple[int, int], w: float | Floats = 1.0) -> ClipScene:
    """Return Bezier curves (C, D + 1, 2), control points in pixels, with w (C, D + 1) in clip space."""
    places = np.asarray(control, float)
    weights = np.broadcast_to(np.asarray(w, float), places.shape[:2])
    clip = np.concatenate(
        [2 * places / size - 1, np.zeros((*weights.shape, 1)), np.ones((*weights.shape, 1))], axis=2
    )
    colors = [linear_color(FACE_COLORS[k % 4]) for k in range(len(places))]
    curves = Curves(clip * weights[..., None], np.array(colors))
    ends = curves.control[:, [0, -1]]
    made = before_matrices(ClipScene(ends, size=size, kind="segments", curves=curves), DEFAULTS)
    assert isinstance(made, ClipScene)
    return made


def arch() -> ClipScene:
    """One cubic curve over a small raster."""
    return curve_scene(np.array([ARCH]), TEACHING_SIZE)


def curve_in_depth() -> ClipScene:
    """A cubic whose far end has w = 4: its middle, seen in perspective, lies where no mixture of divided points is."""
    return curve_scene(np.array([ARCH]), TEACHING_SIZE, np.array([[1.0, 1.0, 2.0, 4.0]]))


def hill() -> Scene:
    """One patch, a hill with a steep side, seen from above at a slant."""
    x, y = np.meshgrid(np.linspace(-1.5, 1.5, 4), np.linspace(-1.5, 1.5, 4), indexing="ij")
    height = np.array([[0, 0.2, 0.2, 0], [0.2, 2.4, 1.6, 0], [0, 2.0, 1.2, -0.6], [0, -0.4, 0, 0]])
    # The first index to the right and the second away from the viewer: the front is above.
    patch = np.stack([x, height, -y], axis=2)
    mesh = mesh_of_patches(patch[None], name="hill", colors=None)
    camera = Camera(eye=np.array([1.2, 2.6, 4.2]), target=np.array([0.0, 0.3, 0.0]), near=1.0, far=12.0)
    return Scene((mesh,), camera, (sun(),), TEACHING_SIZE)


def ball() -> Scene:
    """One ball of eight patches, 40 pixels across, without perspective."""
    return balls(1)


def folded_glass() -> Scene:
    """A sheet of glass in the shape of an S, three layers deep in its middle, and a flat one that cuts through it."""
    part = np.linspace(0, 1, 4)
    there = np.array([8.0, 92.0, -28.0, 56.0])
    folded = np.stack(
        np.broadcast_arrays(there[:, None], 5 + 38 * part, np.array([-8.0, -8, 8, 8])[:, None]), axis=2
    )
    across = 4 + 56 * part[:, None]
    flat = np.stack(np.broadcast_arrays(across, 10 + 28 * part, (across - 32) / 2.5), axis=2)
    meshes = []
    for number, (name, patch) in enumerate((("folded sheet", folded), ("flat sheet", flat))):
        mesh = mesh_of_patches(patch[None], name=name)
        glass = linear_color(FACE_COLORS[number]) * [1, 1, 1, 0.5]
        meshes.append(replace(mesh, colors=np.tile(glass, (len(mesh.positions), 1))))
    return Scene(tuple(meshes), _before(30.0), (sun(),), TEACHING_SIZE)


def cracked() -> Scene:
    """Two flat patches with one curved edge in common; the upper one bends more at its other edge.

    To 10 pixels, the bound cuts the lower one into 2 steps along the edge and the upper one into 3: their common edge
    has 2 pieces on one side and 3 on the other.
    """
    edge = np.array(ARCH)
    foot = np.stack([edge[:, 0], np.full(4, 2.0)], axis=1)
    top = np.array([(2.0, 10.0), (4.0, 56.0), (58.0, 58.0), (62.0, 12.0)])
    meshes = []
    for number, (name, below, above) in enumerate((("lower patch", foot, edge), ("upper patch", edge, top))):
        part = np.linspace(0, 1, 4)[None, :, None]
        flat = below[:, None] * (1 - part) + above[:, None] * part
        patch = np.concatenate([flat, np.zeros((4, 4, 1))], axis=2)
        color = linear_color(FACE_COLORS[number])
        mesh = mesh_of_patches(patch[None], name=name)
        meshes.append(
            mesh_of_patches(patch[None], name=name, colors=np.tile(color, (len(mesh.positions), 1)))
        )
    return Scene(tuple(meshes), _before(5.0), (), TEACHING_SIZE)


def _before(distance: float) -> Camera:
    """Return a camera without perspective that sees x and y as pixels, from a distance in front of z = 0."""
    width, height = TEACHING_SIZE
    middle = np.array([width / 2, height / 2, 0.0])
    return Camera(
        eye=middle + np.array([0.0, 0.0, distance]),
        target=middle,
        projection="orthographic",
        view_height=float(height),
        near=1.0,
        far=2 * distance - 1,
    )
