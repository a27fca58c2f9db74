"""Vertex stage: every vertex through every space, and triangles assembled for the stages behind.

References
----------
M. Zwicker, *Computergrafik*, lecture "The complete vertex transform", Bern 2016.
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "vertex processing".
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.arrays import Floats, Integers, read_only
from core.geometry.matrices import projection, transform, viewport, world_to_camera
from core.scene import ClipScene, Mesh, Scene


@dataclass(frozen=True, eq=False)
class VertexStage:
    """N vertices in every space. A scene given in clip space starts there: its earlier spaces are ``None``."""

    clip: Floats
    """(N, 4) float64."""
    corners: Integers
    """(T, 3) int64, the vertices of every triangle."""
    mesh: Integers
    """(T,) int64, the mesh of every triangle."""
    size: tuple[int, int]
    object: Floats | None = None
    """(N, 4) float64, w = 1."""
    world: Floats | None = None
    """(N, 4) float64."""
    camera: Floats | None = None
    """(N, 4) float64."""
    normals: Floats | None = None
    """(N, 3) float64, world space, unit (or zero where a mesh gives none)."""
    model: Floats | None = None
    """(M, 4, 4) float64, M of every mesh."""
    view: Floats | None = None
    """(4, 4) float64, C^-1."""
    projection: Floats | None = None
    """(4, 4) float64, P."""

    @property
    def ndc(self) -> Floats:
        """(N, 3) float64; infinite or NaN where w = 0."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            return self.clip[:, :3] / self.clip[:, 3:]

    @property
    def window(self) -> Floats:
        """(N, 3) float64: x, y in pixels, depth in [0, 1]; infinite or NaN where w = 0."""
        width, height = self.size
        with np.errstate(invalid="ignore", over="ignore"):
            return np.asarray((self.ndc + 1) * np.array([width / 2, height / 2, 0.5]))

    @property
    def viewport(self) -> Floats:
        """(4, 4) float64, D."""
        return viewport(*self.size)


@lru_cache(maxsize=2)
def transform_vertices(scene: Scene | ClipScene) -> VertexStage:
    """Take every vertex of ``scene`` from object space to clip space.

    Scenes never change, so the result of the last ones is kept: picture, trace and views ask for the same.
    """
    if isinstance(scene, ClipScene):
        count = len(scene.clip)
        return VertexStage(
            clip=read_only(scene.clip.reshape(-1, 4)),
            corners=np.arange(3 * count).reshape(count, 3),
            mesh=np.zeros(count, np.int64),
            size=scene.size,
        )
    width, height = scene.size
    view = world_to_camera(scene.camera)
    project = projection(scene.camera, width / height)
    first = np.cumsum([0] + [len(mesh.positions) for mesh in scene.meshes])

    # Every mesh into world space with its own M, then all vertices together.
    positions = [np.column_stack([mesh.positions, np.ones(len(mesh.positions))]) for mesh in scene.meshes]
    world = np.concatenate([transform(m.transform, p) for m, p in zip(scene.meshes, positions, strict=True)])
    camera = transform(view, world)
    clip = transform(project, camera)
    return VertexStage(
        clip=read_only(clip),
        corners=np.concatenate([m.triangles + start for m, start in zip(scene.meshes, first, strict=False)]),
        mesh=np.repeat(np.arange(len(scene.meshes)), [len(m.triangles) for m in scene.meshes]),
        size=scene.size,
        object=read_only(np.concatenate(positions)),
        world=read_only(world),
        camera=read_only(camera),
        normals=read_only(np.concatenate([world_normals(mesh) for mesh in scene.meshes])),
        model=np.stack([mesh.transform for mesh in scene.meshes]),
        view=view,
        projection=project,
    )


def world_normals(mesh: Mesh) -> Floats:
    """Return (N, 3) unit normals in world space: those of the mesh, or else averages over its faces.

    Notes
    -----
    Normals are covectors: they go with the cofactor matrix of M, which is its transposed inverse times det M.
    A mesh flattened by M (det M = 0) still has them, and under a mirror they turn over with the winding.
    """
    normals = mesh.normals if mesh.normals is not None else vertex_normals(mesh.positions, mesh.triangles)
    first, second, third = mesh.transform[:3, :3]
    cofactors = np.array([np.cross(second, third), np.cross(third, first), np.cross(first, second)])
    return unit(normals @ cofactors.T)


def vertex_normals(positions: Floats, triangles: Integers) -> Floats:
    """Return (N, 3) sums of the normals of the faces around each vertex, weighted by area."""
    corners = positions[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.stack(
        [np.bincount(triangles.ravel(), np.repeat(face[:, k], 3), len(positions)) for k in range(3)], axis=1
    )


def unit(vectors: Floats) -> Floats:
    """Return ``vectors`` (..., 3) at length 1; a zero vector stays zero."""
    x, y, z = (vectors[..., k] for k in range(3))
    length = np.sqrt(x * x + y * y + z * z)
    return np.asarray(vectors / np.where(length > 0, length, 1)[..., None])
