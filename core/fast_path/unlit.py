"""Pictures without light: one colour a triangle, looked up by number, or nothing but a texture, band by band.

For a picture whose bytes are linear, of triangles so few and large that a band of each is worth its calls; see
``packed_texture`` for how close the bytes are.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from core.depth.depth import NearestFragments
from core.fast_path.draw_context import BLOCK, Coloring, DrawContext, Words
from core.framebuffer.display import encode_linear
from core.interpolation.interpolation import value_plane
from core.numeric.planes import OPAQUE, IntegerPlanes, pack_level
from core.records.arrays import Floats, Singles
from core.records.primitives import CornerValues, lit_by
from core.scene import AnyScene, ClipScene, Scene, Texture
from core.spans.bands import Band, Strip, bands
from core.stages.fragment_color import shade_fragments
from core.textures.packed import FARTHEST, PackedSampler, has_bytes, is_packable, linear_levels

# One colour a triangle: looked up by number, a word of bytes per pixel.


FEW = 64
"""Triangles that are looked at first: mostly they tell."""


def palette(context: DrawContext) -> Floats | None:
    """Return the linear colour of every primitive, (P, 4) float64, or ``None`` where its pixels differ.

    Notes
    -----
    The corners of a triangle agree in all that is interpolated, so its pixels agree, to the rounding of the weights'
    sum: the colour is that of a corner.
    """
    scene, geometry = context.scene, context.geometry
    if context.has_texture or (isinstance(scene, Scene) and lit_by(context.settings.shading) == "fragments"):
        return None
    values = geometry.primitives.values
    is_known = isinstance(scene, ClipScene) and not geometry.has_pieces and _is_flat(scene)
    if not is_known and not all(_corners_agree(values, part) for part in (slice(FEW), slice(None))):
        return None
    given = values.rows.take(values.index[0], axis=0)
    mesh = geometry.primitives.mesh
    color: Floats = shade_fragments(scene, context.settings, values.layout, mesh, given).color
    return color


def _corners_agree(values: CornerValues, part: slice) -> bool:
    """Return whether the corners of every triangle of a part have the same values."""
    first, *others = (index[part] for index in values.index)
    given = values.rows.take(first, axis=0)
    return all(
        np.array_equal(first, other) or np.array_equal(given, values.rows.take(other, axis=0))
        for other in others
    )


@lru_cache(maxsize=4)
def _is_flat(scene: ClipScene) -> bool:
    """Return whether the corners of every triangle have the same values."""
    assert scene.attributes is not None
    return all(np.array_equal(scene.attributes[:, 0], scene.attributes[:, corner]) for corner in (1, 2))


@dataclass(frozen=True, eq=False)
class PaletteColors:
    """The bytes of P triangles of one colour each."""

    words: Words
    """(P,) uint32."""
    name: ClassVar[Coloring] = "palette"
    stage = "resolve"

    @property
    def for_layer(self) -> "PaletteColors | None":
        """These, if all are opaque, so that a pixel that is drawn is never 0; else ``None``."""
        return None if (self.words < OPAQUE).any() else self

    def packed(self) -> IntegerPlanes:
        """Return the colours as words that are the same all over the window."""
        level = np.zeros(len(self.words), np.int64)
        return IntegerPlanes(pack_level(self.words), level, level)

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the colour of the triangle seen at every pixel, or of the background; return how many are seen.

        Notes
        -----
        The low bits of a word are the number of the triangle plus one, and 0 where nothing was drawn: an index as it
        is into a table that begins with the background.
        """
        table = np.concatenate([[context.background], self.words])
        seen_count = 0
        for first in range(0, len(context.pixels), BLOCK):
            part = slice(first, first + BLOCK)
            pixels = context.pixels[part]
            index = nearest.number_in(part, context.scratch("palette_index", len(pixels), dtype=np.int64))
            table.take(index, out=pixels, mode="clip")
            seen_count += int(np.count_nonzero(index))
        return seen_count


# Large triangles with nothing but a texture: coordinates band by band, texels packed, bytes at once.


MOST = 64
"""Triangles: of more, bands are not worth their calls."""
MOST_ROUNDING = 2.0
"""Parts of 256 of a texel that positions in float32 may be off by a bound that is seldom reached."""
SINGLE = 2.0**-23
"""A sum of two rounded to float32 is off by at most this part of what they may be, so is a product of quotients."""


class TextureColors:
    """Colours of the textured triangles of a context, block by block; the texture is packable."""

    name: ClassVar[Coloring] = "texture"
    stage = "shade"

    @property
    def for_layer(self) -> "TextureColors":
        """These, for a picture that is one layer: no pixel that is drawn is 0."""
        return self

    def __init__(self, context: DrawContext, texture: Texture) -> None:
        geometry = context.geometry
        values = geometry.primitives.values
        uv = values.rows[:, values.layout["uv"]]
        levels = None if has_bytes(texture) else encode_linear(linear_levels())
        self._sampler = PackedSampler(texture, context.settings.texture_filter, context.settings.wrap, levels)
        inverse_w = geometry.inverse_w_plane
        self._planes = [inverse_w]
        """Of 1 / w, and of the positions in the texture divided by w."""
        self._corner_positions = []
        """Of u and of v, (P, 3) float64 in 256ths of a texel."""
        for number, axis in enumerate(self._sampler.axes):
            of_corners = uv[:, number].take(values.index).T
            self._corner_positions.append(axis.scale * of_corners + axis.offset)
            plane = value_plane(geometry.planes, of_corners)
            a, b, c = (
                axis.scale * of + axis.offset * of_w for of, of_w in zip(plane, inverse_w, strict=True)
            )
            self._planes.append((a, b, c))

    def rounding(self, context: DrawContext) -> float:
        """Return by how many 256ths of a texel a position may be off, as planes and quotient are in float32.

        Of one triangle and the whole window, so that what holds for all bands of a picture holds for the picture.
        """
        width, height = context.scene.size
        w = context.geometry.primitives.clip[..., 3].max(axis=1)
        of_w, *positions = (
            (np.abs(a) * width + np.abs(b) * height + np.abs(c)) * w * SINGLE for a, b, c in self._planes
        )
        corners = (np.abs(of).max(axis=1) for of in self._corner_positions)
        off = [of + at * (of_w + SINGLE) for of, at in zip(positions, corners, strict=True)]
        return float(np.max(off, initial=0.0))

    def block(self, context: DrawContext, triangle: int, band: Band | Strip) -> Words:
        """Return the pixels (R, C) uint32 of one triangle at all pixels of a band's block."""
        rows, steps = band.inside, band.steps
        x, y, step = context.raster.along(rows.origin), context.raster.along(rows.row), steps.number
        shape = (len(rows), steps.width)
        inverse_w, u, v = (
            context.scratch(f"texture_{name}", *shape, dtype=np.float32) for name in ("w", "u", "v")
        )
        for values, (a, b, c) in zip((inverse_w, u, v), self._planes, strict=True):
            ramp = (a[triangle] * step).astype(np.float32)
            of_row = (a[triangle] * x + (b[triangle] * y + c[triangle])).astype(np.float32)
            np.add(steps.spread(ramp), of_row[:, None], out=values)
        with np.errstate(divide="ignore", invalid="ignore"):
            is_near = bool((_ends(inverse_w) > 0).all())
            np.divide(np.float32(1), inverse_w, out=inverse_w)
            for position in (u, v):
                position *= inverse_w
                is_near = is_near and float(np.abs(_ends(position)).max()) <= FARTHEST
        pixels: Words = context.scratch("texture_pixels", *shape, dtype=np.uint32)
        u, v, flat = u.reshape(-1), v.reshape(-1), pixels.reshape(-1)
        if is_near:
            self._sampler.write_words_at(u, v, flat)
        else:
            across, up = self._sampler.axes
            self._sampler.write_words((u - across.offset) / across.scale, (v - up.offset) / up.scale, flat)
        return pixels

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the colour of what is seen at every pixel, and return how many there are; the others stay."""
        number = nearest.number_in(slice(None), np.empty(len(context.pixels), np.int64)).reshape(
            context.raster.shape
        )
        image = context.pixels.reshape(context.raster.shape)
        for triangle, rows in context.rows_of_each(np.arange(len(context.geometry.primitives))):
            for band in bands(rows, context.raster):
                is_seen = number[band.rows, band.columns] == triangle + 1
                if is_seen.any():
                    np.copyto(
                        image[band.rows, band.columns], self.block(context, triangle, band), where=is_seen
                    )
        return int(np.count_nonzero(number))


def _ends(values: Singles) -> Singles:
    """Return the first and the last value of all rows (R, C)."""
    return values[:, :: max(values.shape[1] - 1, 1)]


def texture_colors(context: DrawContext) -> TextureColors | None:
    """Return the colours of all primitives, or ``None`` where they are more than one texture, or too many."""
    primitives, settings = context.geometry.primitives, context.settings
    if (
        context.encoding != "linear"
        or context.counts["cull"].outgoing > MOST
        or settings.interpolation != "perspective"
    ):
        return None
    if settings.texture_filter not in ("bilinear", "nearest"):
        return None
    texture = _only_texture(context.scene)
    if texture is None or not is_packable(texture, settings.wrap):
        return None
    values = primitives.values
    if not set(values.layout) <= {"uv", "color"} or not context.geometry.is_projected.all():
        return None
    if not isinstance(context.scene, ClipScene) and (values.rows[:, values.layout["color"]] != 1).any():
        return None
    colors = TextureColors(context, texture)
    return colors if colors.rounding(context) <= MOST_ROUNDING else None


def _only_texture(scene: AnyScene) -> Texture | None:
    """Return the texture that everything in the scene has."""
    if isinstance(scene, ClipScene):
        return scene.texture
    return scene.meshes[0].texture if len(scene.meshes) == 1 else None
