"""Phong's shading of several meshes: each is lit in its own way, by its material, with its colour or its texture.

All of them have to allow it, so that the bands of a picture agree with the whole, see `core.fast_path.record.Route`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from core.fast_path.draw_context import BLOCK, DrawContext, blocks
from core.fast_path.lit.corner_places import corner_places
from core.fast_path.lit.light_visible import Lit, color_doubtful
from core.fast_path.lit.one_color import (
    LitNormals,
    even_mesh,
    have_few_unlike,
    is_mostly_in_front,
    normals_of,
)
from core.fast_path.lit.textured import LitTexture, texture_of
from core.fast_path.lit.vertex_facts import vertex_facts
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
    colors: LitNormals | LitTexture


@dataclass(frozen=True, eq=False)
class LitMeshes:
    """The meshes of a picture of P primitives, each with its colours."""

    parts: list[MeshPart]
    part: NDArray[np.uint8]
    """(P,) uint8, the part that each primitive is in."""
    local: Integers
    """(P,) int64, its number there."""
    name: ClassVar[Coloring] = "meshes"
    stage = "shade"
    for_layer: ClassVar[None] = None
    """None: they light what is seen once it is known, so a picture has its depth first."""

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the lit colour of what is seen at every pixel, and return how many there are; the others stay."""
        seen_count, doubtful = 0, [np.empty(0, np.int64)]
        for first in range(0, len(nearest.keys), AT_ONCE):
            seen = nearest.seen_in(slice(first, first + AT_ONCE))
            for part, place, local in self._by_part(*seen):
                seen_of_part = ((place[at], local[at]) for at in blocks(len(place)))
                lit = part.colors.light_seen(part.context, seen_of_part)
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


def lit_meshes(context: DrawContext) -> LitMeshes | None:
    """Return the meshes of a scene of several, or ``None`` where one of them allows no cheaper colours.

    Pieces of clipped triangles are left to the plain rules.
    """
    scene, primitives = context.scene, context.geometry.primitives
    if (
        not isinstance(scene, Scene)
        or not 1 < len(scene.meshes) <= MOST
        or context.geometry.clipped is not None
    ):
        return None
    # What is interpolated is found once for all of them.
    if context.settings.shading != "phong" or not len(primitives.values.rows):
        return None
    if not is_mostly_in_front(context.geometry):
        return None
    drawn = np.flatnonzero(np.bincount(primitives.mesh, minlength=len(scene.meshes)))
    part_of_mesh = np.zeros(len(scene.meshes), np.uint8)
    part_of_mesh[drawn] = np.arange(len(drawn))
    part = part_of_mesh.take(primitives.mesh)
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
        at = places.take(chosen)
        colors = normals_of(of_mesh, mesh, at) or texture_of(of_mesh, mesh, at)
        if colors is None:
            return None
        local[chosen] = np.arange(len(chosen))
        parts.append(MeshPart(of_mesh, colors))
    return LitMeshes(parts, part, local)
