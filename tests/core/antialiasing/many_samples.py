"""Pictures that exact areas are measured against: 256 samples a pixel, or as many as wanted.

At edges their mean is off by up to 1/16 of a pixel's contrast where an edge is level or upright, and by far less
elsewhere.
"""

from dataclasses import replace

import numpy as np

from core.antialiasing.resolve import bands_of
from core.coverage.pixel_runs import make_raster
from core.pipeline import draw_supersampled
from core.records.arrays import Singles, read_only
from core.scene import AnyScene
from core.settings import Settings

REFERENCE_SIDE = 16
"""Samples on a side of a pixel of the reference picture."""
BAND = 1 << 21
"""Samples that are held at once."""


def many_samples(scene: AnyScene, settings: Settings, side: int = REFERENCE_SIDE) -> Singles:
    """Return the mean colour (H, W, 4) float32 of ``side`` x ``side`` samples a pixel, by the box filter.

    Parameters
    ----------
    scene : Scene or ClipScene
    settings : Settings
        All but their antialiasing and filter matter.
    side : int
        ``side`` times the picture must be a raster that can be drawn.
    """
    raster = make_raster(scene.size, settings.pixel_center)
    boxed = replace(settings, resolve_filter="box")
    bands = bands_of(raster, 1, max(BAND // (side * side), 1))
    return read_only(
        np.concatenate([draw_supersampled(scene, boxed, band, None, side).color for band in bands])
    )
