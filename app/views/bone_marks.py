"""Bones in the 3D view: each a line from its head to its tail, where its pose has taken them."""

import numpy as np

from app.views.box_marks import SpaceMark
from core.deformation.skinning import joints_of, where_bones_take
from core.records.deformations import Skin
from core.scene import AnyScene, Scene
from core.transform.matrices import transform


def bone_marks(scene: AnyScene) -> list[SpaceMark]:
    """Return the bones of the meshes of a scene, posed, in world space; a disc and its number stand at each joint."""
    marks = []
    for mesh in scene.meshes if isinstance(scene, Scene) else ():
        skin = mesh.deformation
        if not isinstance(skin, Skin):
            continue
        matrices = joints_of(skin).matrices
        ends = np.stack([skin.heads, skin.tails])
        placed = [
            next(where_bones_take(ends[:, joint], matrix[None])) for joint, matrix in enumerate(matrices)
        ]
        for joint, points in enumerate(placed):
            world = transform(mesh.transform, np.column_stack([points, np.ones(2)]))[:, :3]
            marks.append(SpaceMark(world[::-1], "text", f"bone {joint}", "disc"))
    return marks
