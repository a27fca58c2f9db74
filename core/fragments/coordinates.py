"""Texture coordinates as all filters take them: finite, and not so large that an index has no room."""

import numpy as np

from core.records.arrays import Floats

COORDINATE_LIMIT = 2.0**32
"""Coordinates beyond this are moved here: a whole number of repetitions, and indices fit int64."""


def finite_coordinates(uv: Floats) -> Floats:
    """Return a copy of texture coordinates (F, 2) as (2, F); NaN is 0, what lies far outside `COORDINATE_LIMIT`."""
    coordinates = np.array(uv.T, order="C")
    smallest, largest = coordinates.min(initial=0), coordinates.max(initial=0)
    if not (smallest >= -COORDINATE_LIMIT and largest <= COORDINATE_LIMIT):
        coordinates[np.isnan(coordinates)] = 0.0
        np.clip(coordinates, -COORDINATE_LIMIT, COORDINATE_LIMIT, out=coordinates)
    return coordinates
