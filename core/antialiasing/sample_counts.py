"""How many samples a pixel has, and where they lie, by the settings: nothing is drawn here."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from core.framebuffer.sample_positions import grid_positions
from core.methods import table
from core.records.arrays import Floats, read_only
from core.settings import Settings

CENTER = read_only(np.array([[0.5, 0.5]]))
"""(1, 2) the one sample of a picture without antialiasing."""


@dataclass(frozen=True, eq=False)
class SampleTraits:
    """Where the samples of a method of the family ``antialiasing`` lie; without any of these, at the pixel's centre."""

    side: Callable[[Settings], int] | None = None
    """Samples on a side of a pixel, in a regular grid: each is drawn as a pixel of a finer picture."""
    positions: Floats = field(default_factory=lambda: CENTER)
    """(S, 2) where they lie otherwise, from the lower left corner of the pixel, 0 to 1."""
    has_areas: bool = False
    """Whether a pixel's colour is of areas, and its samples only of the buffers beside."""


def sample_traits(settings: Settings) -> SampleTraits:
    """Return where samples lie."""
    if settings.antialiasing == Settings.antialiasing:
        return SampleTraits()  # Looking in the table would import what draws.
    traits: SampleTraits = table.get("antialiasing", settings.antialiasing).traits
    return traits


def side_of(settings: Settings) -> int:
    """Return how many samples supersampling has on a side of a pixel; 0: another method draws.

    Examples
    --------
    >>> side_of(Settings(antialiasing="ssaa-n", samples_across=3)), side_of(Settings())
    (3, 0)
    """
    side = sample_traits(settings).side
    return 0 if side is None else side(settings)


def positions_of(settings: Settings) -> Floats:
    """Return where the samples of a pixel lie, (S, 2) float64 from its lower left corner, 0 to 1.

    Exact areas are of no samples: theirs is the centre, which the buffers beside the colour are of.
    """
    side = side_of(settings)
    return grid_positions(side) if side else sample_traits(settings).positions


def sample_count(settings: Settings) -> int:
    """Return S, how many samples of a pixel are drawn."""
    return len(positions_of(settings))
