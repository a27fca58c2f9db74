"""Phong's shading of one mesh or several: each is lit by its material, with its colour, its texture or its vertices'.

All of them have to allow it, so that the bands of a picture agree with the whole, see `core.fast_path.record.Route`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from core.fast_path.draw_context import BLOCK, DrawContext, blocks
from core.fast_path.lit.corner_places import CornerPlaces, corner_places
from core.fast_path.lit.even_mesh import LitMesh, even_mesh, have_few_unlike, is_mostly_in_front, lit_planes
from core.fast_path.lit.light_visible import Albedo, Lit, LitPlanes, color_doubtful
from core.fast_path.lit.planes import Shown
from core.fast_path.lit.textured import texture_albedo
from core.fast_path.lit.vertex_colored import vertex_albedo
from core.fast_path.lit.vertex_facts import Color, vertex_facts
from core.fast_path.record import Coloring
from core.framebuffer.nearest import NearestFragments
from core.records.arrays import Integers
from core.scene import Scene

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
    if not isinstance(scene, Scene) or context.settings.shading != "phong":
        return None
    is_several = len(scene.meshes) > 1
    if is_several and (len(scene.meshes) > MOST or context.geometry.clipped is not None):
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
