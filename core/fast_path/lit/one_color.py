"""Phong's shading of one colour: what it needs of a pixel is a direction (``normals``).

The direction to the eye follows from the pixel alone. Then the lighting rule is evaluated in float32 (``pixel_light``),
and linear light becomes bytes through a table.

Used where the bytes stay within `TOLERANCE` of those of ``render`` before both are rounded: see ``light_errors``.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.corner_places import CornerPlaces, corner_places
from core.fast_path.lit.light_errors import light_error, normal_error
from core.fast_path.lit.light_visible import Lit, LitPlanes, Seen, color_doubtful
from core.fast_path.lit.normals import normal_planes
from core.fast_path.lit.pixel_light import PixelLight, pixel_light
from core.fast_path.lit.vertex_facts import Color, VertexFacts, vertex_facts
from core.fast_path.record import Coloring
from core.framebuffer.nearest import NearestFragments
from core.records.arrays import Integers
from core.scene import Mesh, Scene
from core.stages.geometry import Geometry

TOLERANCE = 1.0
"""Bytes that a colour may be away from the exact one before both are rounded."""
MOST_UNLIKE = 0.25
"""Part of the triangles that may have unlike normals."""
IN_FRONT = 0.75
"""Part of the triangles that have a place in the window, at least."""


@dataclass(frozen=True, eq=False)
class LitNormals:
    """Normals of P triangles of one colour, and what lights them."""

    planes: LitPlanes
    albedo: Color
    """Linear grey, or red, green and blue, of everything."""
    name: ClassVar[Coloring] = "normals"
    stage = "shade"
    for_layer: ClassVar[None] = None
    """None: they light what is seen once it is known, so a picture has its depth first."""

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the lit colour of what is seen at every pixel, and return how many there are; the others stay."""
        return color_doubtful(context, nearest, self.light_seen(context, nearest.seen()))

    def light_seen(self, context: DrawContext, seen: Seen) -> Lit:
        """Write the lit colour of what is seen at some of the (H*W,) pixels."""
        return self.planes.light_seen(context, seen, self._albedo)

    def _albedo(self, primitive: Integers, column: Integers, row: Integers) -> Color:
        """Return the colour, which is that of all primitives (F,) at all pixels."""
        return self.albedo


def lit_normals(context: DrawContext) -> LitNormals | None:
    """Return the lit normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    They are those of one mesh of one colour without a texture, lit from far away, nearly all of it in front of the eye.
    """
    lit = lit_mesh(context)
    if lit is None or lit.mesh.texture is not None or not have_few_unlike(context, [lit.facts]):
        return None
    return normals_of(context, lit, corner_places(context.geometry))


def normals_of(context: DrawContext, lit: "LitMesh", places: CornerPlaces) -> LitNormals | None:
    """Return the lit normals of a mesh whose corners are at ``places``; ``None``: it has a texture, or as above."""
    planes = None if lit.mesh.texture is not None else lit_planes(context, lit, places)
    return LitNormals(planes, lit.color) if planes else None


@dataclass(frozen=True, eq=False)
class LitMesh:
    """A mesh whose pixels differ in nothing but their normals, and maybe in what a texture shows there."""

    mesh: Mesh
    light: PixelLight
    facts: VertexFacts
    color: Color
    """Linear grey, or red, green and blue, of all vertices."""


def lit_mesh(context: DrawContext) -> LitMesh | None:
    """Return the mesh that all primitives are of, or ``None`` where something else differs from pixel to pixel.

    It is an `even_mesh` of a scene that is nearly all in front of the eye.
    """
    mesh = even_mesh(context)
    return mesh if mesh and is_mostly_in_front(context.geometry) else None


def even_mesh(context: DrawContext) -> LitMesh | None:
    """Return the mesh that all primitives are of: opaque, of one colour, lit from far away, shaded as Phong does."""
    scene, settings, number = context.scene, context.settings, context.only_mesh
    if number is None or not isinstance(scene, Scene) or settings.shading != "phong":
        return None
    if settings.interpolation != "perspective":
        return None
    mesh = scene.meshes[number]
    light = pixel_light(scene, mesh)
    facts = vertex_facts(context.geometry, number)
    if light is None or facts.color is None:
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
    context: DrawContext, mesh: LitMesh, places: CornerPlaces, texture_error: float = 0.0
) -> LitPlanes | None:
    """Return the normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    Parameters
    ----------
    texture_error : float
        Bytes that what the light is multiplied with may be off.
    """
    turn, brightest = normal_error(places), float(max(mesh.color))
    error = light_error(turn, mesh.light, brightest, context.encoding) + texture_error
    if not error <= TOLERANCE:
        return None
    found = normal_planes(context, mesh.light.camera, mesh.facts, places)
    if found is None:
        return None
    normals, is_unlike = found
    return LitPlanes(normals, mesh.light, turn, places.is_doubtful | is_unlike)
