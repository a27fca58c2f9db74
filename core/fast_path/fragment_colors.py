"""Colours of fragments wherever they lie: attributes and light by the rules of every other picture."""

import numpy as np

from core.fast_path.draw_context import Job
from core.fragments.interpolation import Interpolator
from core.raster.coverage import Fragments
from core.records.arrays import Floats, Integers
from core.stages.fragment_color import shade_fragments
from core.stages.texture_slopes import texture_slopes


class FragmentColors:
    """Interpolates and shades the fragments of a picture, one block after another."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self.count = 0
        """Fragments that have been coloured so far."""
        values, settings = job.geometry.primitives.values.trimmed(), job.settings
        how = settings.interpolation, settings.provoking, settings.correction_interval
        with job.timed("interpolate"):
            self._interpolator = Interpolator(job.geometry.planes, values, *how)

    def at(self, primitive: Integers, column: Integers, row: Integers) -> Floats:
        """Return the linear colours (F, 4) float64 of primitives (F,) at pixels (F,)."""
        job, primitives = self._job, self._job.geometry.primitives
        self.count += len(primitive)
        with job.timed("interpolate"):
            x, y = job.raster.centers(column, row)
            rows = job.arena("values", self._interpolator.value_count, len(primitive))
            values = self._interpolator.values(primitive, x, y, rows)
        with job.timed("shade"):
            mesh = primitives.mesh.take(primitive)
            fragments = Fragments(primitive, column, row)
            slopes = texture_slopes(job.geometry, job.settings, job.raster, fragments, values)
            shaded = shade_fragments(job.scene, job.settings, primitives.layout, mesh, values, slopes)
            return np.asarray(shaded.color)

    def write(self, place: Integers, primitive: Integers) -> None:
        """Write the pixels at places in the picture (F,), of primitives (F,)."""
        job = self._job
        color = self.at(primitive, *job.raster.position(place))
        with job.timed("resolve"):
            job.pixels[place] = job.encode(color)
