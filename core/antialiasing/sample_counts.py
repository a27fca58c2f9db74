"""How many samples a pixel has, and where they lie, by the settings: nothing is drawn here."""

import numpy as np

from core.framebuffer.sample_positions import ROTATED_GRID, grid_positions
from core.records.arrays import Floats, read_only
from core.settings import Settings

CENTER = read_only(np.array([[0.5, 0.5]]))
"""(1, 2) the one sample of a picture without antialiasing."""
FIXED_SIDES = {"ssaa-4": 2, "ssaa-16": 4}
"""Methods of supersampling with a number of samples of their own."""


def side_of(settings: Settings) -> int:
    """Return how many samples supersampling has on a side of a pixel; 0: another method draws.

    Examples
    --------
    >>> side_of(Settings(antialiasing="ssaa-n", samples_across=3)), side_of(Settings())
    (3, 0)
    """
    if settings.antialiasing == "ssaa-n":
        return settings.samples_across
    return FIXED_SIDES.get(settings.antialiasing, 0)


def positions_of(settings: Settings) -> Floats:
    """Return where the samples of a pixel lie, (S, 2) float64 from its lower left corner, 0 to 1.

    Exact areas are of no samples: theirs is the centre, which the buffers beside the colour are of.
    """
    side = side_of(settings)
    if side:
        return grid_positions(side)
    return ROTATED_GRID if settings.antialiasing == "msaa-4" else CENTER


def sample_count(settings: Settings) -> int:
    """Return S, how many samples of a pixel are drawn."""
    return len(positions_of(settings))
