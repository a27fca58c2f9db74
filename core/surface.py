"""Where textures meet shading: what is lit at the vertices, and the colour of a fragment.

References
----------
F. Pellacini, *Computer Graphics*, "lighting computation": flat, Gouraud and Phong differ in where they evaluate it.
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, Integers
from core.fragments.lighting import Reflectance, light_surface, reflectance
from core.fragments.shading import centroids, is_seen_from_behind, shade
from core.fragments.textures import texture_colors
from core.geometry.matrices import camera_axes
from core.geometry.vertex_stage import VertexStage
from core.methods import table
from core.scene import AnyScene, Camera, ClipScene, Material, Mesh, Scene
from core.settings import Settings


@dataclass(frozen=True, eq=False)
class Surface:
    """F shaded fragments."""

    albedo: Floats
    """(F, 4) float64, the texture's colour where there is one, times the vertex colour."""
    diffuse_light: Floats | None
    """(F, 3) float64, ambient and diffuse light that falls on it; ``None``: unlit."""
    specular_light: Floats | None
    """(F, 3) float64, light that it mirrors."""
    color: Floats
    """(F, 4) float64, albedo * diffuse_light + specular_light; alpha is the albedo's."""


def viewpoint(camera: Camera, position: Floats) -> Floats:
    """Return where the surface at ``position`` (F, 3) is seen from: the eye, or (orthographic) back along the view."""
    if camera.projection == "orthographic":
        return np.asarray(position + camera_axes(camera)[2])
    return camera.eye


def light_vertices(
    scene: Scene, vertices: VertexStage, settings: Settings, triangle: Integers
) -> tuple[Floats, dict[str, slice]]:
    """Return what is interpolated over triangles (T,), as (T, 3, K) and its layout: no more than the settings need."""
    corners = vertices.corners[triangle]
    parts: dict[str, Floats] = {
        "color": _vertex_values(scene.meshes, "colors", [1.0, 1.0, 1.0, 1.0])[corners]
    }
    if any(mesh.texture for mesh in scene.meshes):
        parts["uv"] = _vertex_values(scene.meshes, "uvs", [0.0, 0.0])[corners]
    assert vertices.world is not None
    assert vertices.normals is not None
    position, normal = vertices.world[:, :3], vertices.normals
    mesh = np.repeat(np.arange(len(scene.meshes)), [len(m.positions) for m in scene.meshes])

    def light_at(at: Floats, facing: Floats, vertex: Integers) -> tuple[Floats, Floats]:
        return light(scene, mesh[vertex], at, facing)

    shading = table.get("shading", settings.shading).function
    if settings.shading != "unlit":
        behind = is_seen_from_behind(
            position, normal, corners, viewpoint(scene.camera, centroids(position, corners))
        )
        parts |= shading(position, normal, corners, behind, light_at)
    ends = np.cumsum([values.shape[2] for values in parts.values()])
    layout = {
        name: slice(int(end) - values.shape[2], int(end))
        for (name, values), end in zip(parts.items(), ends, strict=True)
    }
    return np.concatenate(list(parts.values()), axis=2), layout


def light(scene: Scene, mesh: Integers, position: Floats, normal: Floats) -> tuple[Floats, Floats]:
    """Return diffuse and specular light (F, 3) at surface points of meshes (F,)."""
    eye = viewpoint(scene.camera, position)
    return light_surface(position, normal, eye, scene.lights, material_of(scene, mesh), two_sided=False)


def material_of(scene: Scene, mesh: Integers) -> Material | Reflectance:
    """Return the material of points of meshes (F,): one for all where the scene has one mesh."""
    materials = [of_scene.material for of_scene in scene.meshes]
    return materials[0] if len(materials) == 1 else reflectance(materials, mesh)


def shade_fragments(
    scene: AnyScene, settings: Settings, layout: dict[str, slice], mesh: Integers, values: Floats
) -> Surface:
    """Return the colours of fragments.

    Parameters
    ----------
    layout : dict
        Which of the K values are what, see ``Primitives``.
    mesh : (F,) int64
    values : (F, K) float64, interpolated
    """
    albedo = np.zeros((len(values), 4))
    albedo[:, 3] = 1
    if "color" in layout:
        color = values[:, layout["color"]]
        albedo[:, : color.shape[1]] = color
    if isinstance(scene, ClipScene):
        if scene.texture is not None:
            uv = values[:, layout["uv"]]
            albedo = texture_colors(scene.texture, uv, settings.texture_filter, settings.wrap)
        return Surface(albedo, None, None, albedo)

    for index, of_scene in enumerate(scene.meshes):
        if of_scene.texture is not None:
            chosen = np.flatnonzero(mesh == index)
            uv = values[chosen, layout["uv"]]
            albedo[chosen] *= texture_colors(of_scene.texture, uv, settings.texture_filter, settings.wrap)
    if "normal" in layout:
        diffuse, specular = light(scene, mesh, values[:, layout["position"]], values[:, layout["normal"]])
    elif "diffuse_light" in layout:
        diffuse, specular = values[:, layout["diffuse_light"]], values[:, layout["specular_light"]]
    else:
        return Surface(albedo, None, None, albedo)
    return Surface(albedo, diffuse, specular, shade(albedo, diffuse, specular))


def _vertex_values(meshes: tuple[Mesh, ...], name: str, default: list[float]) -> Floats:
    """Return one attribute of all vertices (N, k); a mesh that has none gets ``default``."""
    missing = [np.broadcast_to(np.array(default), (len(mesh.positions), len(default))) for mesh in meshes]
    given = [getattr(mesh, name) for mesh in meshes]
    return np.concatenate([m if g is None else g for g, m in zip(given, missing, strict=True)])
