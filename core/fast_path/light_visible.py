"""Light once for every visible pixel; and what is in doubt once more, as ``render`` has it.

A highlight ends where the light goes behind the surface, and it may end abruptly. There the least turn of a normal
decides between a highlight and none, and no bound holds. Nor does one for triangles hardly wider than snapping moves
their corners: attributes belong to the unsnapped ones, and pixels may lie far outside these. The few pixels that are
so are coloured once more, with the attributes and the light of every other picture, and so are those of the few
triangles whose normals differ too much.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from core.depth.depth import NearestFragments
from core.fast_path.draw_context import BLOCK, DrawContext, blocks
from core.fast_path.fragment_colors import FragmentColors
from core.fast_path.lit_planes import Shown
from core.fast_path.pixel_light import NormalPlanes, PixelLight, lit_pixels, unit_normals
from core.interpolation.mixing import LocalNumbers
from core.records.arrays import Flags, Integers, Singles

Albedo = Callable[[DrawContext, Shown, Integers, Integers], Sequence[Singles | np.float32]]
"""Linear grey, or red, green and blue, of primitives of a context at columns and rows (F,)."""
Seen = Iterable[tuple[Integers, Integers]]
"""Places in the picture (V,), and the primitives (V,) that are seen there, some at a time."""


class Lit(NamedTuple):
    """What has been lit."""

    seen_count: int
    """Pixels that something is seen at."""
    place: Integers
    """(D,) int64, those whose colour is in doubt, maybe twice."""


@dataclass(frozen=True, eq=False)
class LitPlanes:
    """Normals of P triangles in camera space, and what lights them."""

    normals: NormalPlanes
    light: PixelLight
    turn: float
    """Angle that a normal may be off, in radians."""
    is_doubtful: Flags
    """(P,) bool, those in doubt where they are (``corner_places``), and those whose normals differ too much
    (``normals``): their pixels are coloured once more."""

    def light_seen(self, context: DrawContext, seen: Seen, albedo: Albedo) -> Lit:
        """Write the lit colour of what is seen at some of the (H*W,) pixels; those in doubt are to be coloured anew."""
        numbers = LocalNumbers(len(self.is_doubtful), BLOCK)
        seen_count, has_doubtful = 0, bool(self.is_doubtful.any())
        doubtful = [np.empty(0, np.int64)]
        for place, primitive in seen:
            seen_count += len(place)
            column, row = context.raster.position(place)
            shown = Shown(*numbers.number(primitive))
            color = albedo(context, shown, column, row)
            normal = unit_normals(self.normals, context, shown, column, row)
            diffuse, specular, in_doubt = self.light.at(context, normal, self.turn, column, row)
            context.pixels[place] = lit_pixels(context, color, diffuse, specular)
            doubtful.append(place.take(in_doubt))
            if has_doubtful:
                doubtful.append(place[self.is_doubtful.take(primitive)])
        return Lit(seen_count, np.concatenate(doubtful))


def color_doubtful(context: DrawContext, nearest: NearestFragments, lit: Lit) -> int:
    """Colour pixels in doubt as ``render`` has them, and return how many pixels are lit."""
    if len(lit.place):
        # Only the primitives that are shown there are set up.
        is_shown = np.zeros(len(context.geometry.primitives), bool)
        for part in blocks(len(lit.place)):
            is_shown[nearest.primitive_at(lit.place[part])] = True
        colors, number = FragmentColors(context.part(np.flatnonzero(is_shown))), np.cumsum(is_shown) - 1
        for part in blocks(len(lit.place)):
            place = lit.place[part]
            colors.write(place, number.take(nearest.primitive_at(place)))
    return lit.seen_count
