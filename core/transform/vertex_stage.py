"""Vertex stage: every vertex through every space, and triangles assembled for the stages behind.

Components are kept as contiguous rows: the record's ``(N, 4)`` is the transposed view of four rows of N numbers.

References
----------
M. Zwicker, *Computergrafik*, lecture "The complete vertex transform", Bern 2016.
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "vertex processing".
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Floats, Integers, Scalar, cached_property, read_only
from core.records.depth_table import DepthTable
from core.records.primitives import Rings, ShadedVertices, own_corners
from core.scene import ClipScene, Mesh, Scene
from core.transform.matrices import projection, transform, viewport, world_to_camera


@dataclass(frozen=True, eq=False)
class World:
    """N vertices and T triangles of meshes in world space: what does not change when only the camera moves."""

    object: Floats
    """(N, 4) float64, w = 1."""
    world: Floats
    """(N, 4) float64."""
    normals: Floats
    """(N, 3) float64, world space, unit (or zero where a mesh gives none)."""
    model: Floats
    """(M, 4, 4) float64, M of every mesh."""
    corners: Integers
    """(T, 3) int64, the vertices of every triangle."""
    mesh: Integers
    """(T,) int64, the mesh of every triangle."""
    mesh_of_vertex: Integers
    """(N,) int64."""

    @property
    def corner_rows(self) -> Integers:
        """(3, T) int64, contiguous: the first, second and third corner of every triangle."""
        return self.corners.T


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
    view_range: tuple[float, float] | None = None
    """Near and far of a perspective camera, for which w is the distance along the view; ``None``: it is not."""
    corner_count: int = 3
    """Corners of a primitive that are its own: 2 of segments, 1 of points, 0 of fragments, more than 3 of polygons.

    ``corners`` has three of them all the same, see ``own_corners`` and `corners_of_planes`.
    """
    draws_last: Flags | None = None
    """(T,) bool, the pixel of a segment's second end is drawn, see ``ClipScene``; ``None`` of triangles."""
    first_fragment: Integers | None = None
    """(P,) int64, of each patch of a table of depths, 0 of an empty one; ``None``: a scene of other primitives.

    Fragments go by the number of their patch: what is looked up by number has a row for each patch.
    """
    clip_region: Floats | None = None
    """(4,) or (M, 2) float64, NDC, what is clipped to, see ``ClipScene``; ``None``: the raster."""
    rings: Integers | None = None
    """(R,) int64, first corner of each ring of a polygon, see ``ClipScene``; ``None``: no polygons."""
    region_rings: Integers | None = None
    """(R,) int64, first corner of each ring of ``clip_region``."""
    shaded: ShadedVertices | None = None
    """What a vertex shader gave, which has made ``clip``, too; ``None``: the matrices did.

    Then ``world`` is where the camera sees ``clip``, and there is no ``object`` or ``camera``.
    """

    @property
    def all_corners(self) -> Integers:
        """(T, corner_count) int64, the vertices of every primitive: all corners of a polygon."""
        if self.first_fragment is not None:
            return np.empty((len(self.first_fragment), 0), np.int64)
        if self.rings is None:
            return self.corners[:, : self.corner_count]
        return np.arange(len(self.corners) * self.corner_count).reshape(-1, self.corner_count)

    def corners_of(self, primitive: Any) -> Integers:
        """Return the vertices (..., 3) of primitives, as ``corners`` has them; all (..., C) of polygons."""
        if self.first_fragment is not None:
            primitive = self.first_fragment[primitive]
        found: Integers = (self.corners if self.rings is None else self.all_corners)[primitive]
        return found

    @property
    def ring_slices(self) -> list[slice]:
        """Which of ``corners_of`` form a closed line: all of a triangle, one ring after the other of a polygon."""
        if self.rings is None:
            return [slice(0, 3)]
        return [slice(*ends) for ends in pairwise([*self.rings.tolist(), self.corner_count])]

    @property
    def colors(self) -> tuple[int, ...]:
        """0, 1 or 2 for each of ``corners_of`` and its side: a triangle's own number, a polygon's ring in turn."""
        if self.rings is None:
            return (0, 1, 2)
        return tuple(k % 3 for k, ring in enumerate(self.ring_slices) for _ in range(ring.start, ring.stop))

    @property
    def sides(self) -> Integers:
        """(S, 2) int64, which of ``corners_of`` sides run between: side k of a triangle lies opposite corner k."""
        if self.rings is None:
            return np.array([[1, 2], [2, 0], [0, 1]])
        following = self.rings_of(np.zeros(1, np.int64)).following
        return np.stack([np.arange(self.corner_count), following], axis=1)

    def rings_of(self, polygon: Integers) -> Rings:
        """Return the rings of polygons (P,) in the window, not snapped."""
        assert self.rings is not None
        count, ring_count = len(polygon), len(self.rings)
        own = self.all_corners[polygon].ravel()
        first = self.corner_count * np.repeat(np.arange(count), ring_count)
        starts = np.append(first + np.tile(self.rings, count), len(own))
        return Rings(self.window[own, :2], starts, np.repeat(np.arange(count), ring_count))

    @property
    def clip_rows(self) -> Floats:
        """(4, N) float64, contiguous: x, y, z and w of ``clip``."""
        return self.clip.T

    @property
    def corner_rows(self) -> Integers:
        """(3, T) int64, contiguous: the first, second and third corner of every triangle."""
        return self.corners.T

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


@dataclass(frozen=True, eq=False)
class CornerPositionsOnDemand:
    """The clip positions (T, 3, 4) of all corners, for a rule that looks at them only sometimes; indexed like them."""

    vertices: VertexStage

    def __len__(self) -> int:
        return len(self.vertices.corners)

    def __getitem__(self, key: Any) -> Any:
        return self._gathered[key]

    @cached_property
    def _gathered(self) -> Floats:
        return self.vertices.clip_rows.take(self.vertices.corner_rows, axis=1).T


@lru_cache(maxsize=2)
def place_meshes(meshes: tuple[Mesh, ...]) -> World:
    """Take the vertices of meshes into world space, every mesh with its own M, and number them on.

    Meshes never change, so the result is kept for the next camera.
    """
    vertex_counts = [len(mesh.positions) for mesh in meshes]
    first = np.cumsum([0, *vertex_counts[:-1]])
    positions = [np.vstack([mesh.positions.T, np.ones(len(mesh.positions))]) for mesh in meshes]
    world = [transform(mesh.transform, rows.T).T for mesh, rows in zip(meshes, positions, strict=True)]
    corners = [mesh.triangles.T + start for mesh, start in zip(meshes, first, strict=True)]
    number = np.arange(len(meshes))
    return World(
        object=_record(np.hstack(positions)),
        world=_record(np.hstack(world)),
        normals=_record(np.hstack([world_normals(mesh).T for mesh in meshes])),
        model=np.stack([mesh.transform for mesh in meshes]),
        corners=_record(np.hstack(corners)),
        mesh=np.repeat(number, [len(mesh.triangles) for mesh in meshes]),
        mesh_of_vertex=np.repeat(number, vertex_counts),
    )


@lru_cache(maxsize=2)
def transform_vertices(scene: Scene | ClipScene) -> VertexStage:
    """Take every vertex of ``scene`` from object space to clip space.

    Scenes never change, so the result of the last ones is kept: picture, trace and views ask for the same.
    """
    if isinstance(scene, ClipScene):
        count = len(scene.clip)
        number = np.arange(count)
        corners = own_corners(number, max(scene.corner_count, 1))
        if scene.rings is not None:
            window = scene.clip[..., :2] / scene.clip[..., 3:] * scene.size
            corners = scene.corner_count * number + corners_of_planes(window)
        return VertexStage(
            clip=_record(scene.clip.reshape(-1, 4).T),
            corners=_record(corners),
            mesh=np.zeros(count, np.int64),
            size=scene.size,
            corner_count=scene.corner_count,
            draws_last=_ends_alone(scene) if scene.corner_count < 3 else None,
            first_fragment=None if scene.table is None else _first_fragments(scene.numbers, scene.table),
            clip_region=scene.clip_region,
            rings=scene.rings,
            region_rings=scene.region_rings,
        )
    width, height = scene.size
    view = world_to_camera(scene.camera)
    project = projection(scene.camera, width / height)
    of_meshes = place_meshes(scene.meshes)
    camera = transform(view, of_meshes.world)
    return VertexStage(
        clip=read_only(transform(project, camera)),
        corners=of_meshes.corners,
        mesh=of_meshes.mesh,
        size=scene.size,
        object=of_meshes.object,
        world=of_meshes.world,
        camera=read_only(camera),
        normals=of_meshes.normals,
        model=of_meshes.model,
        view=view,
        projection=project,
        view_range=view_range(scene),
    )


def corners_of_planes(window: Floats) -> Integers:
    """Return (3, T): three corners of each polygon (T, C, 2), of which the triangle is large, counter-clockwise.

    The first is corner 0, which has the polygon's colour, and the next the one farthest from it. Depth and w of the
    polygon are those of the plane through these three.
    """
    away = window - window[:, :1]
    x, y = away[..., 0], away[..., 1]
    second = (x * x + y * y).argmax(axis=1)
    every = np.arange(len(window))
    doubled = x[every, second, None] * y - y[every, second, None] * x
    third = np.abs(doubled).argmax(axis=1)
    is_turned = doubled[every, third] < 0
    first = np.zeros(len(window), np.int64)
    return np.stack([first, np.where(is_turned, third, second), np.where(is_turned, second, third)])


def _first_fragments(patch: Integers, table: DepthTable) -> Integers:
    """Return (P,): the first of the fragments whose patches (F,) are in order; 0 of a patch that has none."""
    first = np.searchsorted(patch, np.arange(len(table.depths)))
    return np.where(np.isin(np.arange(len(first)), patch), first, 0)


def _ends_alone(scene: ClipScene) -> Flags:
    """Return (T,) bool: no other segment begins where a segment ends; so it is with all points and patches."""
    if scene.table is not None:
        return np.ones(len(scene.table.depths), bool)
    if scene.shared is None or scene.corner_count < 2:
        return np.ones(len(scene.clip), bool)
    return ~np.isin(scene.shared[:, 1], scene.shared[:, 0])


def view_range(scene: Scene) -> tuple[float, float] | None:
    """Return ``VertexStage.view_range``; a mesh whose M is a projection itself has another w."""
    is_affine = all(mesh.is_affine for mesh in scene.meshes)
    if scene.camera.projection != "perspective" or not is_affine:
        return None
    return scene.camera.near, scene.camera.far


def _record(rows: NDArray[Scalar]) -> NDArray[Scalar]:
    """Return the read-only transposed view (N, k) of rows (k, N), which it makes contiguous."""
    return read_only(np.ascontiguousarray(rows).T)


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
