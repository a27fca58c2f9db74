"""What is lit at the vertices, and what lights a point of a surface.

References
----------
F. Pellacini, *Computer Graphics*, "lighting computation": flat, Gouraud and Phong differ in where they evaluate it.
"""

from functools import lru_cache

import numpy as np

from core.methods import table
from core.records.arrays import Flags, Floats, Integers, read_only
from core.records.primitives import CornerValues, lit_by, own_corners
from core.scene import Camera, Light, Material, Mesh, Scene
from core.settings import Settings
from core.shading.lighting import Reflectance, dot, light_surface, reflectance
from core.shading.shading import LightRule, centroids, outward_normals
from core.transform.matrices import camera_axes
from core.transform.vertex_stage import VertexStage, place_meshes

ANY_CAMERA = Camera(np.array([0.0, 0.0, 1.0]), np.zeros(3))
"""Stands in for the camera where nothing depends on it."""
BLOCK = 8192
"""Triangles that are looked at at once, so that their numbers stay in the processor's cache."""


def viewpoint(camera: Camera, position: Floats) -> Floats:
    """Return where the surface at ``position`` (F, 3) is seen from: the eye, or (orthographic) back along the view."""
    if camera.projection == "orthographic":
        return np.asarray(position + camera_axes(camera)[2])
    return camera.eye


def light_vertices(
    scene: Scene, vertices: VertexStage, settings: Settings, triangle: Integers
) -> CornerValues:
    """Return what is interpolated over triangles (P,): no more than the settings need, every vertex lit once.

    Notes
    -----
    A vertex has a row for each side that it is seen from. Where faces are lit, every corner has its own row.
    """
    corner = vertices.corner_rows.take(triangle, axis=1)
    behind = np.zeros(len(triangle), bool)
    if lit_by(settings.shading) != "nothing":
        behind = _is_seen_from_behind(scene, triangle)
    if lit_by(settings.shading) == "faces":
        return _light_corners(scene, settings.shading, corner, behind)
    count = len(vertices.clip)
    side = corner + count * behind if behind.any() else corner
    if looks_alike_from_everywhere(scene, settings.shading) and "shading" not in settings.replacements:
        sides = 2 if behind.any() else 1
        return CornerValues(*_light_all_sides(scene.meshes, scene.lights, settings.shading, sides), side)
    used, index = _used_sides(side, 2 * count)
    return CornerValues(*_light_sides(scene, settings.shading, used), index)


def looks_alike_from_everywhere(scene: Scene, shading: str) -> bool:
    """Whether what is interpolated does not depend on the camera: no highlight is evaluated at vertices."""
    return lit_by(shading) in ("fragments", "nothing") or all(
        mesh.material.specular == 0 for mesh in scene.meshes
    )


def _used_sides(side: Integers, count: int) -> tuple[Integers, Integers]:
    """Return which of ``count`` sides occur in ``side`` (3, P), as (M,) int64, and the place of each among these."""
    is_used = np.zeros(count, bool)
    is_used[side] = True
    used = np.flatnonzero(is_used)
    place = np.empty(count, np.int64)
    place[used] = np.arange(len(used))
    return used, place.take(side)


@lru_cache(maxsize=4)
def _light_all_sides(
    meshes: tuple[Mesh, ...], lights: tuple[Light, ...], shading: str, sides: int
) -> tuple[Floats, dict[str, slice]]:
    """Return the values (sides * N, K) of all vertices, for any camera: first the front sides, then the backs."""
    vertex_count = sum(len(mesh.positions) for mesh in meshes)
    return _light_sides(Scene(meshes, ANY_CAMERA, lights), shading, np.arange(sides * vertex_count))


def _light_sides(scene: Scene, shading: str, side: Integers) -> tuple[Floats, dict[str, slice]]:
    """Return the values (M, K) of sides of vertices, and their layout: a vertex is lit like a face of one corner.

    Side v of N is the front of vertex v, side N + v the same vertex as if its normal were turned round.
    """
    world = place_meshes(scene.meshes)
    is_turned = side >= len(world.world)
    vertex = side - len(world.world) * is_turned
    normal = world.normals.T.take(vertex, axis=1)
    if is_turned.any():
        normal *= np.where(is_turned, -1.0, 1.0)
    position = world.world.T[:3].take(vertex, axis=1)
    mesh = world.mesh_of_vertex.take(vertex)
    itself, in_front = np.arange(len(vertex))[:, None], np.zeros(len(vertex), bool)
    parts = given_values(scene.meshes, vertex[:, None])
    parts |= _shade_corners(scene, shading, mesh, position.T, normal.T, itself, in_front)
    values, layout = side_by_side(parts)
    return read_only(values[:, 0]), layout


def _light_corners(scene: Scene, shading: str, corner: Integers, behind: Flags) -> CornerValues:
    """Return the values at the corners (3, P) of triangles that are lit as faces."""
    world, corners = place_meshes(scene.meshes), corner.T
    parts = given_values(scene.meshes, corners)
    parts |= _shade_corners(
        scene, shading, world.mesh_of_vertex, world.world[:, :3], world.normals, corners, behind
    )
    values, layout = side_by_side(parts)
    rows = values.reshape(-1, values.shape[2])
    return CornerValues(rows, layout, own_corners(np.arange(len(corners))))


def _shade_corners(
    scene: Scene,
    shading: str,
    mesh: Integers,
    position: Floats,
    normal: Floats,
    corners: Integers,
    behind: Flags,
) -> dict[str, Floats]:
    """Return by name what shading interpolates: the family's method with the scene's lights and materials.

    Parameters are those of ``core.shading.shading.phong``; ``mesh`` (N,) is that of every vertex.
    """

    def light_at(at: Floats, facing: Floats, vertex: Integers) -> tuple[Floats, Floats]:
        return light(scene, shading, mesh[vertex], at, facing)

    method = table.get("shading", shading).function
    shaded: dict[str, Floats] = method(position, normal, corners, behind, light_at)
    return shaded


def side_by_side(parts: dict[str, Floats]) -> tuple[Floats, dict[str, slice]]:
    """Return parts (P, C, k) side by side as (P, C, K), and where each stands."""
    ends = np.cumsum([values.shape[2] for values in parts.values()])
    layout = {
        name: slice(int(end) - values.shape[2], int(end))
        for (name, values), end in zip(parts.items(), ends, strict=True)
    }
    return np.concatenate(list(parts.values()), axis=2), layout


def _is_seen_from_behind(scene: Scene, triangle: Integers) -> Flags:
    """Return (P,) bool: the eye is on the side that the vertex normals point away from.

    A two-sided surface must choose its side per triangle. Choosing by the normal of a vertex or fragment turns normals
    near the outline, where they face away although the triangle does not, and draws a dark rim. A triangle without
    area or normals is seen from the front.
    """
    outward, centroid = _facets(scene.meshes)
    behind = np.empty(len(triangle), bool)
    for start in range(0, len(triangle), BLOCK):
        part = triangle[start : start + BLOCK]
        normal, place = outward.take(part, axis=1), centroid.take(part, axis=1)
        x, y, z = viewpoint(scene.camera, place.T).reshape(-1, 3).T - place
        behind[start : start + BLOCK] = dot((normal[0], normal[1], normal[2]), (x, y, z)) < 0
    return behind


@lru_cache(maxsize=2)
def _facets(meshes: tuple[Mesh, ...]) -> tuple[Floats, Floats]:
    """Return face normals on the side of the vertex normals, and centroids, as rows (3, T); for any camera."""
    world = place_meshes(meshes)
    position = world.world[:, :3]
    outward = outward_normals(position, world.normals, world.corners).T
    centroid = centroids(position, world.corners).T
    return read_only(np.ascontiguousarray(outward)), read_only(np.ascontiguousarray(centroid))


def given_values(meshes: tuple[Mesh, ...], vertex: Integers) -> dict[str, Floats]:
    """Return colours and texture coordinates at vertices (P, C), as (P, C, k); the latter if there is a texture."""
    parts = {"color": _vertex_values(meshes, "colors", (1.0, 1.0, 1.0, 1.0)).take(vertex, axis=0)}
    if any(mesh.texture for mesh in meshes):
        parts["uv"] = _vertex_values(meshes, "uvs", (0.0, 0.0)).take(vertex, axis=0)
    return parts


def light(
    scene: Scene,
    shading: str,
    mesh: Integers,
    position: Floats,
    normal: Floats,
    share: Floats | None = None,
    eye: Floats | None = None,
) -> tuple[Floats, Floats]:
    """Return diffuse and specular light (F, 3) at surface points of meshes (F,), by the rule of a method of shading.

    ``share`` (F,) of the light that casts shadows arrives; ``None``: all of it. They are seen from places ``eye``
    (F, 3); ``None``: from the camera.
    """
    material = material_of(scene, mesh)
    eye = viewpoint(scene.camera, position) if eye is None else eye
    rule = table.get("shading", shading).function
    if isinstance(rule, LightRule):
        return rule.light(position, normal, eye, scene.lights, material)
    colors = None if share is None else arriving_colors(scene, share)
    return light_surface(position, normal, eye, scene.lights, material, two_sided=False, colors=colors)


def arriving_colors(scene: Scene, share: Floats) -> list[Floats]:
    """Return what arrives of every light: its colour (3,), and (3, F) where ``share`` (F,) of it does."""
    colors = [each.color for each in scene.lights]
    number = scene.casting_light
    colors[number] = colors[number][:, None] * share
    return colors


def material_of(scene: Scene, mesh: Integers) -> Material | Reflectance:
    """Return the material of points of meshes (F,): one for all where the scene has one mesh."""
    materials = [of_scene.material for of_scene in scene.meshes]
    return materials[0] if len(materials) == 1 else reflectance(materials, mesh)


@lru_cache(maxsize=4)
def _vertex_values(meshes: tuple[Mesh, ...], name: str, default: tuple[float, ...]) -> Floats:
    """Return one attribute of all vertices (N, k); a mesh that has none gets ``default``."""
    missing = [np.broadcast_to(np.array(default), (len(mesh.positions), len(default))) for mesh in meshes]
    given = [getattr(mesh, name) for mesh in meshes]
    return np.concatenate([m if g is None else g for g, m in zip(given, missing, strict=True)])
