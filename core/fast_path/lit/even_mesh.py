"""Phong's shading of a mesh: what it needs of a pixel are a direction (``normals``) and a colour (``albedo``).

The direction to the eye follows from the pixel alone. Then the lighting rule is evaluated in float32 (``pixel_light``),
and linear light becomes bytes through a table.

Used where the bytes stay within `TOLERANCE` of those of ``render`` before both are rounded: see ``light_errors``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.corner_places import CornerPlaces
from core.fast_path.lit.light_errors import light_error, normal_error
from core.fast_path.lit.light_visible import LitPlanes
from core.fast_path.lit.normals import normal_planes
from core.fast_path.lit.pixel_light import PixelLight, pixel_light
from core.fast_path.lit.vertex_facts import Color, VertexFacts, vertex_facts
from core.scene import Mesh, Scene
from core.stages.geometry import Geometry

TOLERANCE = 1.0
"""Bytes that a colour may be away from the exact one before both are rounded."""
MOST_UNLIKE = 0.25
"""Part of the triangles that may have unlike normals."""
IN_FRONT = 0.75
"""Part of the triangles that have a place in the window, at least."""


@dataclass(frozen=True, eq=False)
class LitMesh:
    """A mesh whose pixels differ in nothing but their normals and their colour."""

    mesh: Mesh
    light: PixelLight
    facts: VertexFacts
    color: Color | None
    """Linear grey, or red, green and blue, of all vertices; ``None``: they differ."""

    @property
    def brightest(self) -> float:
        """Greatest linear colour of a vertex."""
        return self.facts.brightest if self.color is None else float(max(self.color))


def even_mesh(context: DrawContext) -> LitMesh | None:
    """Return the mesh that all primitives are of: opaque, lit from far away, shaded as Phong does."""
    scene, settings, number = context.scene, context.settings, context.only_mesh
    if number is None or not isinstance(scene, Scene) or settings.shading != "phong":
        return None
    if settings.interpolation != "perspective":
        return None
    mesh = scene.meshes[number]
    light = pixel_light(scene, mesh)
    facts = vertex_facts(context.geometry, number)
    if light is None or not facts.is_opaque:
        return None
    # Of clipped triangles only those of this part of the picture are known, and others may have other colours.
    if facts.color is None and (mesh.texture is not None or context.geometry.clipped is not None):
        return None
    return LitMesh(mesh, light, facts, facts.color)


def have_few_unlike(context: DrawContext, meshes: Sequence[VertexFacts]) -> bool:
    """Return whether few enough triangles of all ``meshes`` of a scene have unlike normals to be coloured twice.

    Of whole meshes, so that what holds for the picture holds for all bands of it; pieces of triangles are no mesh.
    """
    if context.geometry.clipped is not None:
        return True
    unlike = sum(mesh.unlike_count for mesh in meshes)
    return unlike <= MOST_UNLIKE * sum(mesh.triangle_count for mesh in meshes)


def is_mostly_in_front(geometry: Geometry) -> bool:
    """Return whether so few triangles have corners without a place in the window that they may be coloured twice.

    Of all that are not culled, so that what holds for the picture holds for all bands of it.
    """
    has_place = geometry.window.is_projected
    if has_place.all():
        return True
    if geometry.clipped is not None:
        return bool(geometry.is_projected.all())
    corner = geometry.assembled.corner[:, geometry.culled.kept]
    in_front = np.count_nonzero(has_place.take(corner).all(axis=0))
    return bool(in_front >= IN_FRONT * corner.shape[1])


def lit_planes(
    context: DrawContext, mesh: LitMesh, places: CornerPlaces, albedo_error: float = 0.0
) -> LitPlanes | None:
    """Return the normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    Parameters
    ----------
    albedo_error : float
        Bytes that what the light is multiplied with may be off.
    """
    turn = normal_error(places)
    error = light_error(turn, mesh.light, mesh.brightest, context.encoding) + albedo_error
    if not error <= TOLERANCE:
        return None
    found = normal_planes(context, mesh.light.camera, mesh.facts, places)
    if found is None:
        return None
    normals, is_unlike = found
    return LitPlanes(normals, mesh.light, turn, places.is_doubtful | is_unlike)
