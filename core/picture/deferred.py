"""Deferred colour: attributes and light once for every visible pixel, by the rules of every other picture."""

import numpy as np

from core.fragments.interpolation import Interpolator
from core.framebuffer.nearest import NearestFragments
from core.picture.job import BLOCK, Job
from core.raster.coverage import Fragments
from core.surface import shade_fragments
from core.texture_slopes import texture_slopes


def shade_visible(job: Job, nearest: NearestFragments) -> int:
    """Write the pixels that something is seen at, and return how many there are; the others keep what they have."""
    primitives, raster = job.geometry.primitives, job.raster
    with job.timed("interpolate"):
        how = job.settings.interpolation, job.settings.provoking, job.settings.correction_interval
        interpolator = Interpolator(job.geometry.planes, primitives.values, *how)
    seen_count = 0
    for first in range(0, len(job.pixels), BLOCK):
        with job.timed("depth"):
            place, primitive = nearest.seen_in(slice(first, first + BLOCK))
        if not len(place):
            continue
        seen_count += len(place)
        place += first
        with job.timed("interpolate"):
            fragments = Fragments(primitive, *raster.position(place))
            x, y = raster.centers(fragments.column, fragments.row)
            rows = job.arena("values", interpolator.value_count, len(place))
            values = interpolator.values(primitive, x, y, rows)
        with job.timed("shade"):
            mesh = primitives.mesh.take(primitive)
            slopes = texture_slopes(job.geometry, job.settings, raster, fragments, values)
            color = shade_fragments(job.scene, job.settings, primitives.layout, mesh, values, slopes).color
        with job.timed("resolve"):
            job.pixels[place] = job.encode(np.asarray(color))
    return seen_count
