"""Colours lit at the corners: each triangle has them in the cheapest way that it allows, whatever else there is.

Where the corners are so much alike that it is near enough, their bytes are interpolated (``byte_colors``); else linear
light with its second differences (``light_words``); the few triangles that neither is certain for, as thin,
see-through and very large ones, have attributes and light per pixel. What a triangle allows follows from itself alone,
so a part of a picture has the bytes of the whole.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from core.fast_path.byte_colors import ByteColors, byte_colors
from core.fast_path.draw_context import DrawContext, blocks
from core.fast_path.fragment_colors import FragmentColors
from core.fast_path.light_words import LightWords, light_pixels, light_words
from core.fast_path.record import Coloring
from core.framebuffer.nearest import READ_AT_ONCE, NearestFragments
from core.raster.spans.packed import bent_spans, each_pass
from core.records.arrays import Flags, Integers

BYTES, LIGHT, PLAIN = 0, 1, 2
"""The ways that a triangle is coloured."""
MOST_PLAIN = 0.125
"""Part of the triangles that may be plain where there is no depth: their pixels are looked for once more."""

Write = Callable[[Integers, Integers], None]
"""Writes the pixels at places (F,) of primitives (F,)."""


@dataclass(frozen=True, eq=False)
class CornerColors:
    """Colours of P triangles."""

    bytes: ByteColors
    """Of all; those that have them in another way are level."""
    others: DrawContext
    """The triangles that are not near enough as bytes, in a picture of their own."""
    light: LightWords | None
    """Colours of these; ``None``: there are none."""
    number: Integers
    """(P,) int64, the number that each of them has there."""
    way: NDArray[np.uint8]
    """(P,) uint8, `BYTES`, `LIGHT` or `PLAIN`."""
    name: ClassVar[Coloring] = "corners"
    stage = "interpolate"

    @property
    def for_layer(self) -> "CornerColors | None":
        """These, for a picture that is one layer, if few triangles are plain; else ``None``."""
        return self if np.count_nonzero(self.way == PLAIN) <= MOST_PLAIN * len(self.way) else None

    @property
    def is_light(self) -> Flags:
        """(P,) bool, the triangles that have linear light."""
        return np.asarray(self.way == LIGHT)

    def write_light(self) -> int:
        """Write the triangles that have linear light along their spans; return how many pixels they have."""
        fragments, context = 0, self.others
        if self.light is None or not self.light.is_certain.any():
            return 0
        for first, end, lanes in context.walks(self.light.is_certain):
            with context.timed("raster"):
                planes = self.light.planes.part(first, end)
                spans = bent_spans(planes, lanes, context.raster, context.owners, context.scratch)
                fragments += spans.pixel_count
            with context.timed("shade"):
                for k, pixel, word in each_pass(spans):
                    context.pixels[k:][pixel] = light_pixels(word, context.encoding, context.scratch)
        return fragments

    def write_plain(self, context: DrawContext) -> None:
        """Write the pixels of the plain triangles of a picture that is one layer."""
        chosen = np.flatnonzero(self.way == PLAIN)
        if len(chosen):
            from core.stages.bin_and_raster import covered  # Few pictures have such triangles.

            part = context.part(chosen)
            colors = FragmentColors(part)
            for fragments in covered(part.geometry, context.raster, context.counts):
                place = context.raster.index(fragments.column, fragments.row)
                for at in blocks(len(place)):
                    colors.write(place[at], fragments.primitive[at])

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the colour of what is seen at every pixel, and return how many there are; the others stay."""
        ways = {way: self._writer(context, way) for way in np.flatnonzero(np.bincount(self.way)).tolist()}
        seen_count = 0
        if len(ways) == 1:
            (write,) = ways.values()
            for place, primitive in nearest.seen():
                seen_count += len(place)
                write(place, primitive)
            return seen_count
        for first in range(0, len(nearest.keys), READ_AT_ONCE):
            place, primitive = nearest.seen_in(slice(first, first + READ_AT_ONCE))
            seen_count += len(place)
            shown = self.way.take(primitive)
            for way, write in ways.items():
                chosen = np.flatnonzero(shown == way)
                for at in blocks(len(chosen)):
                    write(place.take(chosen[at]), primitive.take(chosen[at]))
        return seen_count

    def _writer(self, context: DrawContext, way: int) -> Write:
        """Return what writes the pixels of the triangles that are coloured in a way."""
        if way == BYTES:
            return lambda place, primitive: self.bytes.write(context, place, primitive)
        if way == LIGHT and self.light is not None:
            light = self.light
            return lambda place, primitive: light.write(self.others, place, self.number.take(primitive))
        is_plain = self.way == PLAIN
        colors, number = FragmentColors(context.part(np.flatnonzero(is_plain))), np.cumsum(is_plain) - 1
        return lambda place, primitive: colors.write(place, number.take(primitive))


def corner_colors(context: DrawContext) -> CornerColors | None:
    """Return the colours of all primitives; ``None`` where they are not those of corners."""
    of_bytes = byte_colors(context)
    if of_bytes is None:
        return None
    is_other = ~of_bytes.is_near
    way = np.zeros(len(is_other), np.uint8)
    if not is_other.any():
        return CornerColors(of_bytes, context, None, np.cumsum(is_other), way)
    others = np.flatnonzero(is_other)
    part = context.part(others)
    light = light_words(part)
    way[others] = np.where(light.is_certain, LIGHT, PLAIN)
    return CornerColors(of_bytes, part, light, np.cumsum(is_other) - 1, way)
