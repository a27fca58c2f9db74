"""A corner dragged in space: where it goes in the scene, with everything that shares it."""

from dataclasses import replace

import numpy as np

from app.session.scene_edits import set_clip_corner
from app.views.view_space import ViewSpace
from core.records.arrays import Floats
from core.scene import AnyScene, ClipScene


def move_corner_to(space: ViewSpace, triangle: int, corner: int, place: Floats) -> AnyScene:
    """Return the scene with a corner at a place (3,) of the space that is shown.

    In the world all triangles of the vertex move along. In the box of the view volume the corner keeps its w.

    Raises
    ------
    ValueError
        If the corner has no place there (w <= 0), or the mesh is flattened so that no vertex can get there.
    """
    scene = space.scene
    if isinstance(scene, ClipScene):
        w = scene.clip[triangle, corner, 3]
        if w <= 0:
            raise ValueError(
                "a corner with w ≤ 0 has no place in the view volume and cannot be dragged there"
            )
        ndc = np.linalg.solve(space.from_clip, np.append(place, 1.0))
        return set_clip_corner(scene, triangle, corner, ndc / ndc[3] * w)
    vertex = int(space.vertices.corners[triangle, corner])
    index, local = 0, vertex
    while local >= len(scene.meshes[index].positions):
        local -= len(scene.meshes[index].positions)
        index += 1
    mesh = scene.meshes[index]
    try:
        moved = np.linalg.solve(mesh.transform, np.append(place, 1.0))
    except np.linalg.LinAlgError:
        raise ValueError(
            f"{mesh.name} is flattened by its transform: its vertices cannot be dragged"
        ) from None
    positions = mesh.positions.copy()
    positions[local] = moved[:3] / moved[3]
    meshes = list(scene.meshes)
    meshes[index] = replace(mesh, positions=positions)
    return replace(scene, meshes=tuple(meshes))
