"""Light once for every visible pixel; and what is in doubt once more, as ``render`` has it.

A highlight ends where the light goes behind the surface, and it may end abruptly. There the least turn of a normal
decides between a highlight and none, and no bound holds. Nor does one for triangles hardly wider than snapping moves
their corners: attributes belong to the unsnapped ones, and pixels may lie far outside of these. The few pixels that are
so are coloured once more, with the attributes and the light of every other picture, and so are those of the few
triangles whose normals differ too much.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Flags, Integers, Singles
from core.framebuffer.nearest import NearestFragments
from core.picture.fragment_colors import FragmentColors
from core.picture.job import Job, Words
from core.picture.lit.normals import NormalPlanes, unit_normals
from core.picture.lit.pixel_light import PixelLight, lit_pixels

Albedo = Callable[[Integers, Integers, Integers], Sequence[Singles | np.float32]]
"""Linear grey, or red, green and blue, of primitives (F,) at columns and rows (F,)."""


@dataclass(frozen=True, eq=False)
class LitPlanes:
    """Normals of P triangles in camera space, and what lights them."""

    normals: NormalPlanes
    light: PixelLight
    turn: float
    """Angle that a normal may be off, in radians."""
    is_doubtful: Flags
    """(P,) bool, thin triangles, which are not drawn where they are (``corner_places``), and those whose normals differ
    too much (``normals``): their pixels are coloured once more."""

    def light_visible(self, job: Job, nearest: NearestFragments, albedo: Albedo) -> int:
        """Write the lit colour of what is seen at the (H*W,) pixels, and return how many are seen; the others stay."""
        seen_count = 0
        doubtful: list[tuple[Integers, Integers]] = []
        for place, primitive in nearest.seen():
            seen_count += len(place)
            column, row = job.raster.position(place)
            color = albedo(primitive, column, row)
            normal = unit_normals(self.normals, job, primitive, column, row)
            diffuse, specular, in_doubt = self.light.at(job, normal, self.turn, column, row)
            job.pixels[place] = lit_pixels(job, color, diffuse, specular)
            in_doubt = np.concatenate([in_doubt, np.flatnonzero(self.is_doubtful.take(primitive))])
            if len(in_doubt):
                doubtful.append((place.take(in_doubt), primitive.take(in_doubt)))
        if doubtful:
            places, primitives = (np.concatenate(of_blocks) for of_blocks in zip(*doubtful, strict=True))
            job.pixels[places] = _exact_pixels(job, primitives, places)
        return seen_count


def _exact_pixels(job: Job, primitive: Integers, place: Integers) -> Words:
    """Return the pixels (D,) of primitives (D,) at places as ``render`` has them; only these are set up."""
    shown, local = np.unique(primitive, return_inverse=True)
    primitives = job.geometry.primitives.take(shown)
    area = job.geometry.doubled_area.take(shown)
    of_shown = replace(job, geometry=replace(job.geometry, primitives=primitives, doubled_area=area))
    return job.encode(FragmentColors(of_shown).at(local, *job.raster.position(place)))
