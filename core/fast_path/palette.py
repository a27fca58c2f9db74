"""One colour a triangle: looked up by number, a word of bytes per pixel."""

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from core.fast_path.draw_context import BLOCK, DrawContext, Words
from core.fast_path.record import Coloring
from core.framebuffer.nearest import NearestFragments
from core.numeric.byte_words import OPAQUE, pack_level
from core.numeric.integer_planes import IntegerPlanes
from core.records.arrays import Floats
from core.records.primitives import CornerValues, lit_by
from core.scene import ClipScene, Scene
from core.stages.fragment_color import shade_fragments

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
    is_known = isinstance(scene, ClipScene) and geometry.clipped is None and _is_flat(scene)
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
