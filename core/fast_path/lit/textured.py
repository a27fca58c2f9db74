"""Phong's shading of a textured mesh: normals and texture coordinates from planes, lit in float32.

Coordinates are those of ``render`` but for rounding: u/w, v/w and 1/w are linear over the window, each a plane in
float64 through the corners where they lie before snapping, divided at the pixel. The texture is read in single
precision (``single_texture``), normals and light are those of ``even_mesh``.

How close the bytes are: the rounding of the planes moves the position in the texture by some part of a texel
(`position_error`), the texture is off by no more, neighbours being 1 apart at most, and bytes by as much times the
steepest that sRGB rises. It is added to what the light may be off (``light_errors``), and only where the sum stays
within the tolerance is this way taken. Triangles hardly wider than snapping moves their corners have no such bound:
their pixels are coloured once more, exactly (``light_visible``).
"""

from dataclasses import dataclass

import numpy as np

from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.corner_places import CornerPlaces
from core.fast_path.lit.even_mesh import LitMesh
from core.fast_path.lit.light_errors import STEEPEST
from core.fast_path.lit.planes import Plane, Shown, evaluate, plane_through, rounding
from core.fast_path.lit.vertex_facts import Color
from core.fragments.single_texture import FARTHEST, SingleSampler, is_plain
from core.fragments.single_texture import ROUNDING as TEXEL_ROUNDING
from core.records.arrays import Floats, Integers, Singles
from core.scene import Texture
from core.stages.geometry import Geometry


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
