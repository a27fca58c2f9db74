"""Which back faces the 3D view need not draw: those of solids, seen from outside."""

import numpy as np

from core.geometry.vertex_stage import transform_vertices
from core.scene import AnyScene, Camera, Mesh, Scene
from core.stages.closed_meshes import is_solid

FEWEST = 2_000
"""Triangles; the back faces of fewer cost less than it takes to find out."""


class HiddenBacks:
    """Remembers of the meshes that are drawn whether they are solids.

    It is found out when meshes are drawn a second time, so it costs nothing while they are edited; one thread asks.
    """

    def __init__(self) -> None:
        self._meshes: tuple[Mesh, ...] = ()
        self._is_solid: bool | None = None
        self._corners = np.zeros((8, 3))
        """Of the box around the solids, in the world."""

    def are_hidden(self, scene: AnyScene) -> bool:
        """Return whether no back face can be seen; ``False`` also where that is not known."""
        if not isinstance(scene, Scene) or sum(len(mesh.triangles) for mesh in scene.meshes) < FEWEST:
            return False
        if scene.meshes is not self._meshes:
            self._meshes, self._is_solid = scene.meshes, None
            return False
        if self._is_solid is None:
            self._is_solid = is_solid(scene)
            world = transform_vertices(scene).world
            assert world is not None
            ends = np.stack([world[:, :3].min(axis=0), world[:, :3].max(axis=0)])
            self._corners = np.stack(np.meshgrid(*ends.T), axis=-1).reshape(8, 3)
        return self._is_solid and self._is_before(scene.camera)

    def _is_before(self, camera: Camera) -> bool:
        """Return whether the near plane cuts nothing off, so that the eye is outside and no solid is seen cut open."""
        forward = camera.target - camera.eye
        distance = (self._corners - camera.eye) @ forward / np.linalg.norm(forward)
        return bool((distance > camera.near).all())
