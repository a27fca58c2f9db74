"""Scenes of some of their triangles: what a view draws of many, and what a pass draws of the occluders."""

from dataclasses import replace

import numpy as np

from core.records.arrays import Integers
from core.scene import AnyScene, ClipScene, Mesh
from core.transform.vertex_stage import vertex_normals


def with_triangles(scene: AnyScene, chosen: Integers) -> AnyScene:
    """Return a scene with some of its triangles, (K,) numbers that rise; a mesh without any is left out."""
    if isinstance(scene, ClipScene):
        if scene.table is not None:
            # Fragments are drawn as points; those of a patch are chosen together.
            chosen = np.flatnonzero(np.isin(scene.numbers, chosen))
            scene = replace(scene, kind="points", table=None)
        assert scene.attributes is not None
        return replace(scene, clip=scene.clip[chosen], attributes=scene.attributes[chosen], shared=None)
    meshes, first = [], 0
    for mesh in scene.meshes:
        end = first + len(mesh.triangles)
        of_mesh = chosen[(chosen >= first) & (chosen < end)] - first
        if len(of_mesh):
            meshes.append(_mesh_of(mesh, of_mesh))
        first = end
    return replace(scene, meshes=tuple(meshes))


def _mesh_of(mesh: Mesh, chosen: Integers) -> Mesh:
    """Return a mesh of some triangles; its normals are those of the whole mesh."""
    used, triangles = np.unique(mesh.triangles[chosen], return_inverse=True)
    normals = mesh.normals if mesh.normals is not None else vertex_normals(mesh.positions, mesh.triangles)
    return replace(
        mesh,
        positions=mesh.positions[used],
        triangles=triangles.reshape(-1, 3),
        normals=normals[used],
        uvs=None if mesh.uvs is None else mesh.uvs[used],
        colors=None if mesh.colors is None else mesh.colors[used],
        faces=None,
    )
