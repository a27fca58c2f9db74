"""What is common to cases of one lit mesh: which triangle is seen where, and that none is seen from behind."""

import numpy as np

from core.geometry.vertex_stage import transform_vertices
from core.records.arrays import Flags, Floats
from core.scene import Mesh, Scene


def clip_corners(scene: Scene) -> Floats:
    """Return the corners (T, 3, 4) of all triangles in clip space."""
    vertices = transform_vertices(scene)
    return np.asarray(vertices.clip[vertices.corners])


def faces_the_eye(scene: Scene) -> Flags:
    """Return which triangles, (T,) bool, are seen from the front, where they are in front of the eye."""
    return np.asarray(np.linalg.det(clip_corners(scene)[..., [0, 1, 3]]) > 0)


def mesh_and_normals(scene: Scene) -> tuple[Mesh, Floats]:
    """Return the mesh of a scene that has one, and its normals (N, 3), which need not be unit.

    Raises
    ------
    ValueError
        If it has several, or no normals.
    """
    if len(scene.meshes) != 1 or scene.meshes[0].normals is None:
        raise ValueError("one mesh with normals is wanted, got another scene")
    return scene.meshes[0], scene.meshes[0].normals
