"""Where textures meet shading: the colour of a fragment, and whether a scene's own shaders give it."""

from dataclasses import dataclass

import numpy as np

from core.families import mirrors_of
from core.records.arrays import Floats, Integers
from core.resolved import resolve
from core.scene import AnyScene, ClipScene, Scene, Texture
from core.settings import Settings
from core.transform.vertex_stage import VertexStage, transform_vertices

# Where a scene's own shaders replace the fixed stages; `core.shaders` is imported for such scenes only.


def has_program(scene: AnyScene) -> bool:
    """Whether a scene has shaders of its own."""
    return scene.program is not None


def vertex_stage(scene: AnyScene) -> VertexStage:
    """Return every vertex in clip space: by the vertex shader of a scene that has one, else by the matrices."""
    if scene.program is None:
        return transform_vertices(scene)
    from core.shaders.stages import shade_vertices

    return shade_vertices(scene)


# Where textures meet shading: the colour of a fragment.


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
    """(F, 4) float64, albedo * diffuse_light + specular_light, and what is mirrored; alpha is the albedo's."""
    light_share: Floats | None = None
    """(F,) float64 from 0 to 1, what arrives of the light that casts shadows; ``None``: no shadow is looked for."""
    lit_color: Floats | None = None
    """(F, 4) float64, the colour before what is mirrored is added; ``None``: nothing mirrors."""


def shade_fragments(
    scene: AnyScene,
    settings: Settings,
    layout: dict[str, slice],
    mesh: Integers,
    values: Floats,
    slopes: Floats | None = None,
) -> Surface:
    """Return the colours of fragments.

    Parameters
    ----------
    layout : dict
        Which of the K values are what, see ``Primitives``.
    mesh : (F,) int64
    values : (F, K) float64, interpolated
    slopes : (4, F) float64, see ``core.stages.fragments``; ``None``: the texture filter needs none
    """
    albedo = albedo_of(scene, settings, layout, mesh, values, slopes)
    if "normal" in layout:
        # Here and below: only what is lit, or textured, waits for these imports.
        from core.shading.shading import shade
        from core.stages.vertex_light import light

        assert isinstance(scene, Scene)
        share, position = None, values[:, layout["position"]]
        if resolve(settings).shadow is not None:
            from core.stages.passes import shadow_tests

            found = shadow_tests(scene, settings, position)
            share = None if found is None else found.share
        diffuse, specular = light(scene, settings.shading, mesh, position, values[:, layout["normal"]], share)
        color, own = shade(albedo, diffuse, specular), None
        if resolve(settings).environment is not None and mirrors_of(scene):
            from core.stages.environment import mirror_looks

            own = color.copy()
            for chosen, looks in mirror_looks(scene, settings, mesh, position, values[:, layout["normal"]]):
                color[chosen, :3] += scene.meshes[mesh[chosen[0]]].material.mirror * looks.color
        return Surface(albedo, diffuse, specular, color, share, own)
    if "diffuse_light" not in layout:
        return Surface(albedo, None, None, albedo)
    from core.shading.shading import shade

    diffuse, specular = values[:, layout["diffuse_light"]], values[:, layout["specular_light"]]
    return Surface(albedo, diffuse, specular, shade(albedo, diffuse, specular))


def albedo_of(
    scene: AnyScene,
    settings: Settings,
    layout: dict[str, slice],
    mesh: Integers,
    values: Floats,
    slopes: Floats | None = None,
) -> Floats:
    """Return the colours (F, 4) of fragments before they are lit; see `shade_fragments`."""
    if isinstance(scene, ClipScene) and scene.texture is not None:
        return _texture_color(scene.texture, settings, values[:, layout["uv"]], slopes)
    albedo = _vertex_color(layout, values)
    if isinstance(scene, ClipScene) or not any(of_scene.texture for of_scene in scene.meshes):
        return albedo
    rows = albedo.T.copy()
    for index, of_scene in enumerate(scene.meshes):
        if of_scene.texture is not None:
            chosen = slice(None) if len(scene.meshes) == 1 else np.flatnonzero(mesh == index)
            uv = values[:, layout["uv"]][chosen]
            of_mesh = None if slopes is None else slopes[:, chosen]
            rows[:, chosen] *= _texture_color(of_scene.texture, settings, uv, of_mesh).T
    return rows.T


def _texture_color(texture: Texture, settings: Settings, uv: Floats, slopes: Floats | None) -> Floats:
    """Return the colours (F, 4) of a texture at ``uv`` (F, 2)."""
    from core.textures.look_up import texture_colors, uses_mipmaps

    if not uses_mipmaps(settings.texture_filter):
        return texture_colors(texture, uv, settings.texture_filter, settings.wrap)
    from core.textures.mipmaps import mipmap_colors

    assert slopes is not None
    return mipmap_colors(texture, uv, slopes, settings.texture_filter, settings.wrap)


def _vertex_color(layout: dict[str, slice], values: Floats) -> Floats:
    """Return the interpolated colours (F, 4): what is missing is 0, alpha 1."""
    color = values[:, layout.get("color", slice(0))]
    if color.shape[1] == 4:
        return color
    rows = np.zeros((4, len(values)))
    rows[3] = 1
    rows[: color.shape[1]] = color.T
    return rows.T
