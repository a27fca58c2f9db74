"""Phong's shading of meshes in single precision: lit by material, with colours of vertices or a texture.

The direction to the eye follows from the pixel alone. Then the lighting rule is evaluated in float32 (``pixel_light``),
and linear light becomes bytes through a table.

Used where the bytes stay within `TOLERANCE` of those of ``render`` before both are rounded: see ``light_errors``.

Coordinates are those of ``render`` but for rounding: u/w, v/w and 1/w are linear over the window, each a plane in
float64 through the corners where they lie before snapping, divided at the pixel. The texture is read in single
precision (``single_texture``), normals and light are those of ``even_mesh``.

How close the bytes are: the rounding of the planes moves the position in the texture by some part of a texel
(`position_error`), the texture is off by no more, neighbours being 1 apart at most, and bytes by as much times the
steepest that sRGB rises. It is added to what the light may be off (``light_errors``), and only where the sum stays
within the tolerance is this way taken. Triangles hardly wider than snapping moves their corners have no such bound:
their pixels are coloured once more, exactly (``light_visible``).

All of them have to allow it, so that the bands of a picture agree with the whole: `core.fast_path.draw_context.Route`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from core.depth.depth import NearestFragments
from core.fast_path.draw_context import BLOCK, Coloring, DrawContext, blocks
from core.fast_path.light_visible import Albedo, Lit, LitPlanes, color_doubtful
from core.fast_path.lit_planes import (
    Color,
    CornerPlaces,
    Plane,
    Shown,
    VertexFacts,
    corner_places,
    evaluate,
    plane_through,
    rounding,
    vertex_facts,
)
from core.fast_path.pixel_light import (
    STEEPEST,
    PixelLight,
    light_error,
    normal_error,
    normal_planes,
    pixel_light,
)
from core.records.arrays import Floats, Integers, Singles
from core.resolved import resolve
from core.scene import Mesh, Scene, Texture
from core.settings import Settings
from core.stages.geometry import Geometry
from core.textures.single_precision import FARTHEST, SingleSampler, is_plain
from core.textures.single_precision import ROUNDING as TEXEL_ROUNDING

# Phong's shading of a mesh: what it needs of a pixel are a direction (``normals``) and a colour
# (``albedo``).


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


def is_phong(settings: Settings) -> bool:
    """Return whether fragments are lit, and none of them looks for a shadow or mirrors what is around it."""
    resolved = resolve(settings)
    return settings.shading == "phong" and resolved.shadow is None and resolved.environment is None


def even_mesh(context: DrawContext) -> LitMesh | None:
    """Return the mesh that all primitives are of: opaque, lit from far away, shaded as Phong does."""
    scene, settings, number = context.scene, context.settings, context.only_mesh
    if number is None or not isinstance(scene, Scene) or not is_phong(settings):
        return None
    if settings.interpolation != "perspective":
        return None
    mesh = scene.meshes[number]
    light = pixel_light(scene, mesh)
    facts = vertex_facts(context.geometry, number)
    if light is None or not facts.is_opaque:
        return None
    # Of clipped triangles only those of this part of the picture are known, and others may have other colours.
    if facts.color is None and (mesh.texture is not None or context.geometry.has_pieces):
        return None
    return LitMesh(mesh, light, facts, facts.color)


def have_few_unlike(context: DrawContext, meshes: Sequence[VertexFacts]) -> bool:
    """Return whether few enough triangles of all ``meshes`` of a scene have unlike normals to be coloured twice.

    Of whole meshes, so that what holds for the picture holds for all bands of it; pieces of triangles are no mesh.
    """
    if context.geometry.has_pieces:
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
    if geometry.has_pieces:
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


# Colours of vertices between these, in float32: over w each is a plane over the window, as 1/w is.


SINGLE = 2.0**-21
"""Rounding of a quotient in float32, as a part of it."""


@dataclass(frozen=True, eq=False)
class VertexAlbedo:
    """Colours of P triangles."""

    planes: list[Plane]
    """1/w, and linear grey, or red, green and blue, over w, all in one scale."""

    def __call__(self, context: DrawContext, shown: Shown, column: Integers, row: Integers) -> list[Singles]:
        """Return the linear grey, or red, green and blue, of primitives at pixels, (F,) float32 each."""
        x, y = context.raster.centers(column, row)
        value, term = context.scratch("vertex_color", len(x)), context.scratch("vertex_color_term", len(x))
        found = context.scratch("vertex_colors", len(self.planes), len(x), dtype=np.float32)
        for plane, of_plane in zip(self.planes, found, strict=True):
            evaluate(plane, shown, x, y, value, term)
            np.copyto(of_plane, value, casting="same_kind")
        np.divide(np.float32(1), found[0], out=found[0])
        found[1:] *= found[0]
        return list(found[1:])


def vertex_albedo(context: DrawContext, mesh: LitMesh, places: CornerPlaces) -> tuple[VertexAlbedo, float]:
    """Return the colours between the vertices of a mesh, and by how many bytes these may be off.

    Notes
    -----
    A quotient of two planes is off by what both are rounded, times the greatest w over the least. Doubtful triangles,
    whose planes are not those of the pipeline, are coloured once more.
    """
    inverse = places.w.min(axis=0) / places.w
    corners = [
        mesh.facts.values.colors.take(index, axis=1) for index in context.geometry.primitives.values.index
    ]
    over_w = [
        [of[channel] * by for of, by in zip(corners, inverse, strict=True)]
        for channel in range(len(corners[0]))
    ]
    off = rounding(places, np.full(len(places.is_doubtful), 8.0)) + SINGLE
    off *= places.w.max(axis=0) / places.w.min(axis=0)
    # Of one triangle, so that what holds for all bands of a picture holds for the picture.
    error = float(off.max(initial=0)) * mesh.brightest * mesh.light.strength * STEEPEST
    return VertexAlbedo([plane_through(places, values) for values in (list(inverse), *over_w)]), error


# Phong's shading of a textured mesh: normals and texture coordinates from planes, lit in float32.


@dataclass(frozen=True, eq=False)
class TextureAlbedo:
    """What a texture shows on P triangles."""

    coordinates: tuple[Plane, Plane, Plane]
    """1/w, and the position in texels over w."""
    color: Color
    """What the texture is multiplied with: linear grey, or red, green and blue."""
    sampler: SingleSampler

    def __call__(self, context: DrawContext, shown: Shown, column: Integers, row: Integers) -> list[Singles]:
        """Return the linear grey, or red, green and blue, of primitives at pixels, (F,) float32 each."""
        x, y = context.raster.centers(column, row)
        inverse_w, u, v = context.scratch("texture_position", 3, len(x))
        term = context.scratch("texture_term", len(x))
        for values, plane in zip((inverse_w, u, v), self.coordinates, strict=True):
            evaluate(plane, shown, x, y, values, term)
        np.divide(1, inverse_w, out=inverse_w)
        u *= inverse_w
        v *= inverse_w
        colors = context.scratch("texture_colors", self.sampler.channels, len(x), dtype=np.float32)
        self.sampler.write_colors(u, v, colors)
        if all(part == 1 for part in self.color):
            return list(colors)
        count = max(len(colors), len(self.color))
        return [
            colors[min(k, len(colors) - 1)] * self.color[min(k, len(self.color) - 1)] for k in range(count)
        ]


def texture_albedo(
    context: DrawContext, mesh: LitMesh, places: CornerPlaces
) -> tuple[TextureAlbedo, float] | None:
    """Return what the texture of a mesh shows, and by how many bytes that may be off; ``None``: it is not known."""
    texture, settings = mesh.mesh.texture, context.settings
    if texture is None or mesh.color is None or settings.texture_filter != "bilinear":
        return None
    if not is_plain(texture, settings.wrap):
        return None
    if not mesh.facts.farthest_uv * max(texture.pixels.shape[:2]) < FARTHEST:
        return None
    position = _texel_positions(context.geometry, mesh, texture)
    error = (
        (position_error(places, position) + TEXEL_ROUNDING) * STEEPEST * mesh.light.strength * mesh.brightest
    )
    inverse = list(1 / places.w)
    over_w = [[of_corner * by for of_corner, by in zip(axis, inverse, strict=True)] for axis in position]
    inverse_w, u, v = (plane_through(places, values) for values in (inverse, *over_w))
    return TextureAlbedo((inverse_w, u, v), mesh.color, SingleSampler(texture, settings.wrap)), error


def _texel_positions(geometry: Geometry, mesh: LitMesh, texture: Texture) -> list[list[Floats]]:
    """Return the texture coordinates of the corners in texels: for u and v three times (P,) float64."""
    rows, columns, _ = texture.pixels.shape
    index = geometry.primitives.values.index
    return [
        [(of_vertices * size).take(of_corner) for of_corner in index]
        for of_vertices, size in zip(mesh.facts.values.uv, (columns, rows), strict=True)
    ]


def position_error(places: CornerPlaces, position: list[list[Floats]]) -> float:
    """Return by how many texels the position of a fragment of a triangle that is not doubtful may be off.

    ``position`` are the corners' places in the texture: for u and v three times (P,) float64 texels.
    """
    extent = np.zeros(len(places.is_doubtful))
    for first, second, third in position:
        extent += np.abs(second - first)
        extent += np.abs(third - first)
    # Of one triangle, so that what holds for all bands of a picture holds for the picture.
    return float(rounding(places, extent).max(initial=0))


# Phong's shading of one mesh or several: each is lit by its material, with its colour, its texture or its
# vertices'.


MOST = 64
"""Meshes: of more, setting up each of them takes longer than light by the plain rules."""
AT_ONCE = 4 * BLOCK
"""Pixels that are sorted by mesh together, so that a mesh has many of them and little memory is taken."""


@dataclass(frozen=True, eq=False)
class MeshPart:
    """The primitives of one mesh."""

    context: DrawContext
    planes: LitPlanes
    albedo: Albedo


@dataclass(frozen=True, eq=False)
class LitColors:
    """The meshes of a picture of P primitives, each with its colours."""

    parts: list[MeshPart]
    part: NDArray[np.uint8]
    """(P,) uint8, the part that each primitive is in."""
    local: Integers
    """(P,) int64, its number there."""
    name: ClassVar[Coloring] = "lit"
    stage = "shade"
    for_layer: ClassVar[None] = None
    """None: they light what is seen once it is known, so a picture has its depth first."""

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the lit colour of what is seen at every pixel, and return how many there are; the others stay."""
        if len(self.parts) == 1:
            (part,) = self.parts
            lit = part.planes.light_seen(part.context, nearest.seen(), part.albedo)
            return color_doubtful(context, nearest, lit)
        seen_count, doubtful = 0, [np.empty(0, np.int64)]
        for first in range(0, len(nearest.keys), AT_ONCE):
            seen = nearest.seen_in(slice(first, first + AT_ONCE))
            for part, place, local in self._by_part(*seen):
                seen_of_part = ((place[at], local[at]) for at in blocks(len(place)))
                lit = part.planes.light_seen(part.context, seen_of_part, part.albedo)
                seen_count += lit.seen_count
                doubtful.append(lit.place)
        return color_doubtful(context, nearest, Lit(seen_count, np.concatenate(doubtful)))

    def _by_part(self, place: Integers, primitive: Integers) -> Iterator[tuple[MeshPart, Integers, Integers]]:
        """Yield the parts that are seen at places (V,), with those of each, and their primitives there."""
        number = self.part.take(primitive)
        order = number.argsort(kind="stable")
        place, local = place.take(order), self.local.take(primitive.take(order))
        ends = np.searchsorted(number.take(order), np.arange(len(self.parts) + 1)).tolist()
        for part, (first, end) in zip(self.parts, pairwise(ends), strict=True):
            if first < end:
                yield part, place[first:end], local[first:end]


def lit_colors(context: DrawContext) -> LitColors | None:
    """Return the lit meshes of a scene, or ``None`` where one of them allows no cheaper colours.

    Of several meshes, pieces of clipped triangles are left to the plain rules.
    """
    scene, primitives = context.scene, context.geometry.primitives
    if not isinstance(scene, Scene) or not is_phong(context.settings):
        return None
    is_several = len(scene.meshes) > 1
    if is_several and (len(scene.meshes) > MOST or context.geometry.has_pieces):
        return None
    # What is interpolated is found once for all of them.
    if not len(primitives.values.rows) or not is_mostly_in_front(context.geometry):
        return None
    drawn = np.flatnonzero(np.bincount(primitives.mesh, minlength=len(scene.meshes)))
    part_of_mesh = np.zeros(len(scene.meshes), np.uint8)
    part_of_mesh[drawn] = np.arange(len(drawn))
    part = part_of_mesh.take(primitives.mesh)
    jobs = [(context, np.arange(len(primitives)))]
    if is_several:
        jobs = []
        for place, number in enumerate(drawn.tolist()):
            chosen = np.flatnonzero(part == place)
            jobs.append((context.part(chosen, number), chosen))
    lit = [mesh for of_mesh, _ in jobs if (mesh := even_mesh(of_mesh))]
    facts = [vertex_facts(context.geometry, number) for number in range(len(scene.meshes))]
    if len(lit) < len(jobs) or not have_few_unlike(context, facts):
        return None
    places = corner_places(context.geometry)
    local, parts = np.empty(len(primitives), np.int64), []
    for mesh, (of_mesh, chosen) in zip(lit, jobs, strict=True):
        found = lit_part(of_mesh, mesh, places.take(chosen) if is_several else places)
        if found is None:
            return None
        local[chosen] = np.arange(len(chosen))
        parts.append(found)
    return LitColors(parts, part, local)


def uniform_albedo(
    color: Color, _context: DrawContext, _shown: Shown, _column: Integers, _row: Integers
) -> Color:
    """Return the colour, which is that of all primitives at all pixels (F,)."""
    return color


def lit_part(context: DrawContext, mesh: LitMesh, places: CornerPlaces) -> MeshPart | None:
    """Return a mesh whose corners are at ``places``, or ``None`` where some pixel could be off by too much."""
    albedo: Albedo
    if mesh.mesh.texture is not None:
        found = texture_albedo(context, mesh, places)
        if found is None:
            return None
        albedo, error = found
    elif mesh.color is None:
        albedo, error = vertex_albedo(context, mesh, places)
    else:
        albedo, error = partial(uniform_albedo, mesh.color), 0.0
    planes = lit_planes(context, mesh, places, error)
    return MeshPart(context, planes, albedo) if planes else None
