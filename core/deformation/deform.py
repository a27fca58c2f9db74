"""Meshes with their deformation done: what the matrices are applied to, and the rest pose that it was made from.

References
----------
F. Parke, *Computer generated animation of faces*, 1972 (blending of shapes).
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "vertex processing": deformation.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.records.arrays import Floats
from core.records.deformations import Blend, Skin
from core.resolved import resolve
from core.scene import Mesh, Scene
from core.settings import Settings
from core.transform.vertex_stage import vertex_normals


def deformed(scene: Scene, settings: Settings) -> Scene:
    """Return a scene with every mesh deformed; the others stay."""
    meshes = (deform(mesh, settings) if mesh.deformation is not None else mesh for mesh in scene.meshes)
    return replace(scene, meshes=tuple(meshes))


def deform(mesh: Mesh, settings: Settings) -> Mesh:
    """Return a mesh where its deformation puts it; one that is deformed already begins from its rest pose."""
    mesh = mesh.rest or mesh
    of_mesh = mesh.deformation
    if isinstance(of_mesh, Blend):
        positions = blend_shapes(of_mesh, mesh.positions)[-1]
        normals = vertex_normals(positions, mesh.triangles)
    else:
        assert isinstance(of_mesh, Skin)
        positions, normals = (
            resolve(settings).method("skinning").function(of_mesh, mesh.positions, rest_normals(mesh))
        )
    return replace(mesh, positions=positions, normals=normals, rest=mesh)


def rest_normals(mesh: Mesh) -> Floats:
    """Return the normals (N, 3) of the rest pose: those of the mesh, or averages over its faces."""
    return mesh.normals if mesh.normals is not None else vertex_normals(mesh.positions, mesh.triangles)


def blended_shape(rest: float, weights: Sequence[float], targets: Sequence[float]) -> float:
    """Listing of one component of a vertex that is moved towards other shapes."""
    place = rest
    for share, goal in zip(weights, targets, strict=True):
        place += share * (goal - rest)  #: blend
    return place


def blend_shapes(blend: Blend, positions: Floats) -> Floats:
    """Return (K, N, 3): vertices (N, 3) after each of the K shapes is added; the last is the result."""
    place, found = positions, []
    for weight, target in zip(blend.weights, blend.targets, strict=True):
        place = place + weight * (target - positions)
        found.append(place)
    return np.stack(found)
