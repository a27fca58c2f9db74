"""The picture of 256 samples: the scene drawn at 16 times its size and averaged, the reference for colours.

References
----------
F. C. Crow, *The aliasing problem in computer-generated shaded images*, 1977.
"""

from copy import copy
from dataclasses import replace

import numpy as np

from core.pipeline import draw
from core.raster.pixel_runs import make_raster
from core.records.arrays import Floats, Integers
from core.scene import SIZE_LIMIT, AnyScene
from core.settings import Settings
from core.study.accuracy.frame_task import premultiplied

SIDE = 16
"""Samples on a side of a pixel."""
ROWS = 32
"""So many rows of a picture are enough to tell its mean error."""
ROWS_AT_ONCE = 4


def can_be_sampled(size: tuple[int, int]) -> bool:
    """Return whether a picture of this size can be drawn at 16 times its size."""
    return SIDE * max(size) <= SIZE_LIMIT


def spread_rows(height: int) -> Integers:
    """Return (R,) int64 rows of a picture, evenly spread, all of a small one."""
    count = min(height, ROWS)
    return (np.arange(count) * height) // count


def sampled_rows(scene: AnyScene, settings: Settings, rows: Integers) -> Floats:
    """Return the mean colours (R, W, 4) float64, times alpha, of 16 x 16 samples in every pixel of some rows (R,).

    Notes
    -----
    Samples lie at the centres of a grid of 16 x 16 squares in the pixel, whatever ``pixel_center`` says.
    """
    width, height = scene.size
    enlarged = replace(copy(scene), size=(SIDE * width, SIDE * height))
    settings = replace(settings, pixel_center="half")
    result = np.empty((len(rows), width, 4))
    # Neighbouring rows are drawn together.
    parts = np.split(np.arange(len(rows)), np.flatnonzero(np.diff(rows) != 1) + 1)
    for part in (
        chunk for run in parts for chunk in np.split(run, range(ROWS_AT_ONCE, len(run), ROWS_AT_ONCE))
    ):
        if not len(part):
            continue
        region = (0, SIDE * int(rows[part[0]]), SIDE * width, SIDE * len(part))
        frame = draw(enlarged, settings, make_raster(enlarged.size, "half", region))
        samples = premultiplied(frame.color, settings).reshape(len(part), SIDE, width, SIDE, 4)
        result[part] = samples.mean(axis=(1, 3))
    return result


def sampled_picture(scene: AnyScene, settings: Settings) -> Floats:
    """Return the mean colours (H, W, 4) float64, times alpha, of 256 samples in every pixel."""
    return sampled_rows(scene, settings, np.arange(scene.size[1]))
