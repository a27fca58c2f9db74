"""Colours of vertices between these, in float32: over w each is a plane over the window, as 1/w is."""

from dataclasses import dataclass

import numpy as np

from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.corner_places import CornerPlaces
from core.fast_path.lit.even_mesh import LitMesh
from core.fast_path.lit.light_errors import STEEPEST
from core.fast_path.lit.planes import Plane, Shown, evaluate, plane_through, rounding
from core.records.arrays import Integers, Singles

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
