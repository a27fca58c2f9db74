"""Colours as bytes for the triangles that allow it; attributes and light per pixel for the others.

Whether interpolated bytes are near enough is a bound of each triangle alone (``core.fast_path.byte_colors``):
where light
changes much within one, at the rim of a shadow or of a highlight, it is not, in the thousands beside it is. So each
triangle has the colours that it allows, whatever else is in the picture: a part of it has the bytes of the whole.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from core.fast_path.byte_colors import ByteColors
from core.fast_path.draw_context import DrawContext, blocks
from core.fast_path.fragment_colors import FragmentColors, shade_visible
from core.fast_path.record import Coloring
from core.framebuffer.nearest import READ_AT_ONCE, NearestFragments


@dataclass(frozen=True, eq=False)
class SomeBytes:
    """Colours of P triangles of which some are not near enough as bytes."""

    colors: ByteColors
    name: ClassVar[Coloring] = "some-bytes"
    stage = "interpolate"
    for_layer: ClassVar[None] = None
    """None: what is seen is coloured by attributes and light, once it is known."""

    def look_up(self, context: DrawContext, nearest: NearestFragments) -> int:
        """Write the colour of what is seen at every pixel, and return how many there are; the others stay."""
        is_near = self.colors.is_near
        if not is_near.any():
            return shade_visible(context, nearest)
        others = np.flatnonzero(~is_near)
        number = np.cumsum(~is_near) - 1
        plain = FragmentColors(context.part(others))
        seen_count = 0
        for first in range(0, len(nearest.keys), READ_AT_ONCE):
            place, primitive = nearest.seen_in(slice(first, first + READ_AT_ONCE))
            seen_count += len(place)
            shows_near = is_near.take(primitive)
            near, other = np.flatnonzero(shows_near), np.flatnonzero(~shows_near)
            for part in blocks(len(near)):
                at = near[part]
                self.colors.write(context, place.take(at), primitive.take(at))
            for part in blocks(len(other)):
                at = other[part]
                plain.write(place.take(at), number.take(primitive.take(at)))
        return seen_count
