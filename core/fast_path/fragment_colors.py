"""Colours of fragments wherever they lie: attributes and light by the rules of every other picture."""

import numpy as np

from core.coverage.fills import Fragments
from core.depth.depth import NearestFragments
from core.fast_path.draw_context import DrawContext
from core.interpolation.interpolation import Interpolator
from core.records.arrays import Floats, Integers
from core.resolved import resolve
from core.stages.fragment_color import shade_fragments
from core.stages.fragments import texture_slopes


class FragmentColors:
    """Interpolates and shades the fragments of a picture, one block after another."""

    def __init__(self, context: DrawContext) -> None:
        self._job = context
        self.count = 0
        """Fragments that have been coloured so far."""
        values, how = context.geometry.primitives.values.trimmed(), resolve(context.settings).interpolation
        with context.timed("interpolate"):
            self._interpolator = Interpolator(context.geometry.planes, values, *how)

    def at(self, primitive: Integers, column: Integers, row: Integers) -> Floats:
        """Return the linear colours (F, 4) float64 of primitives (F,) at pixels (F,)."""
        context, primitives = self._job, self._job.geometry.primitives
        self.count += len(primitive)
        with context.timed("interpolate"):
            x, y = context.raster.centers(column, row)
            rows = context.scratch("values", self._interpolator.value_count, len(primitive))
            values = self._interpolator.values(primitive, x, y, rows)
        with context.timed("shade"):
            mesh = primitives.mesh.take(primitive)
            fragments = Fragments(primitive, column, row)
            slopes = texture_slopes(context.geometry, context.raster, fragments, values)
            shaded = shade_fragments(context.scene, context.settings, primitives.layout, mesh, values, slopes)
            return np.asarray(shaded.color)

    def write(self, place: Integers, primitive: Integers) -> None:
        """Write the pixels at places in the picture (F,), of primitives (F,)."""
        context = self._job
        color = self.at(primitive, *context.raster.position(place))
        with context.timed("resolve"):
            context.pixels[place] = context.encode(color)


def shade_visible(context: DrawContext, nearest: NearestFragments) -> int:
    """Write the pixels that something is seen at, and return how many there are; the others keep what they have."""
    colors = FragmentColors(context)
    seen_count = 0
    with context.timed("depth"):
        for place, primitive in nearest.seen():
            seen_count += len(place)
            colors.write(place, primitive)
    return seen_count
