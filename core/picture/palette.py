"""One colour a triangle: looked up by number, a word of bytes per pixel."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.framebuffer.nearest import NearestFragments
from core.geometry_stages import Geometry
from core.picture.byte_words import OPAQUE, pack_level
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.bands import Band
from core.raster.spans.packed import PackedPlanes
from core.scene import AnyScene, ClipScene, Scene
from core.settings import Settings
from core.surface import shade_fragments

Words = NDArray[np.uint32]

BLOCK = 1 << 15
"""Pixels that are looked up together: their numbers stay in the processor's cache."""


def palette(scene: AnyScene, geometry: Geometry, settings: Settings) -> Floats | None:
    """Return the linear colour of every primitive, (P, 4) float64, or ``None`` where its pixels differ.

    Notes
    -----
    The corners of a triangle agree in all that is interpolated, so its pixels agree, to the rounding of the weights'
    sum: the colour is that of a corner.
    """
    if has_texture(scene) or (isinstance(scene, Scene) and settings.shading == "phong"):
        return None
    values = geometry.primitives.values
    first, second, third = values.index
    given = values.rows.take(first, axis=0)
    if not (isinstance(scene, ClipScene) and geometry.clipped is None and _is_flat(scene)):
        for other in (second, third):
            if not (np.array_equal(first, other) or np.array_equal(given, values.rows.take(other, axis=0))):
                return None
    mesh = geometry.primitives.mesh
    color: Floats = shade_fragments(scene, settings, values.layout, mesh, given).color
    return color


@lru_cache(maxsize=4)
def _is_flat(scene: ClipScene) -> bool:
    """Tell whether the corners of every triangle have the same values."""
    assert scene.attributes is not None
    return all(np.array_equal(scene.attributes[:, 0], scene.attributes[:, corner]) for corner in (1, 2))


def has_texture(scene: AnyScene) -> bool:
    """Tell whether anything in the scene has a texture."""
    if isinstance(scene, ClipScene):
        return scene.texture is not None
    return any(mesh.texture is not None for mesh in scene.meshes)


@dataclass(frozen=True, eq=False)
class PaletteColors:
    """The bytes of P triangles of one colour each."""

    words: Words
    """(P,) uint32."""
    name = "palette"
    stage = "resolve"

    @property
    def fits_layer(self) -> bool:
        """Whether all are opaque, so that a pixel that is drawn is never 0."""
        return not bool((self.words < OPAQUE).any())

    def packed(self) -> PackedPlanes:
        """Return the colours as words that are the same all over the window."""
        level = np.zeros(len(self.words), np.int64)
        return PackedPlanes(pack_level(self.words), level, level)

    def block(self, triangle: int, band: Band, raster: Raster, arena: Arena) -> Words:
        """Return the pixels (R, C) uint32 of one triangle at all pixels of a band's block."""
        return np.broadcast_to(self.words[triangle], (len(band.row), len(band.column)))

    def look_up(self, nearest: NearestFragments, raster: Raster, pixels: Words, arena: Arena) -> int:
        """Write the colour of the triangle seen at every pixel (H*W,); return how many are seen.

        Notes
        -----
        The low bits of a word are the number of the triangle plus one, and 0 where nothing was drawn: an index as it
        is into a table that begins with the background, which ``pixels`` holds.
        """
        table = np.concatenate([pixels[:1], self.words])
        seen_count = 0
        for first in range(0, len(pixels), BLOCK):
            part = slice(first, first + BLOCK)
            index = nearest.number_in(part, arena("palette_index", len(pixels[part]), dtype=np.int64))
            table.take(index, out=pixels[part], mode="clip")
            seen_count += int(np.count_nonzero(index))
        return seen_count
