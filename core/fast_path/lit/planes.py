"""Planes over the window in float64, evaluated at pixels in memory that is used again.

Planes through corners far from the origin are rounded, these and those of ``render``, by `ROUNDING` times x y over the
area, as a part of what the corners differ by (``core.fragments.interpolation``).
"""

from typing import NamedTuple

import numpy as np

from core.fast_path.lit.corner_places import CornerPlaces
from core.numeric.integer_planes import window_slopes
from core.records.arrays import Floats, Integers

ROUNDING = 2.0**-48
"""Rounding of planes, as a part of the products of coordinates in them, with room to spare."""

Plane = tuple[Floats, Floats, Floats]
"""Change per column, per row, and value at the window's origin, (P,) float64 each."""


def plane_through(places: CornerPlaces, values: list[Floats]) -> Plane:
    """Return the plane through values (P,) at the three corners."""
    across, up = window_slopes(places.x, places.y, places.doubled_area, *values)
    origin = values[0] - (across * places.x[0] + up * places.y[0])
    return across, up, origin


def rounding(places: CornerPlaces, extent: Floats) -> Floats:
    """Return by how much (P,) values may be off that the corners of a triangle differ in by ``extent`` (P,).

    Used up is ``extent``: second minus first plus third minus first, in size. Doubtful triangles have no such bound: 0.
    """
    extent[places.is_doubtful] = 0
    extent /= np.abs(places.doubled_area)
    extent *= np.abs(places.x).max(axis=0)
    extent *= np.abs(places.y).max(axis=0)
    extent *= ROUNDING
    return extent


class Shown(NamedTuple):
    """The primitives of F pixels."""

    primitives: Integers
    """(U,) int64, each once."""
    local: Integers
    """(F,) int64, which of these a pixel shows: numbers of so few stay in the processor's nearest cache."""


def evaluate(plane: Plane, shown: Shown, x: Floats, y: Floats, values: Floats, term: Floats) -> None:
    """Write the ``values`` (F,) of the planes of primitives at pixel centres (F,); ``term`` (F,) is memory."""
    across, up, origin = (part.take(shown.primitives) for part in plane)
    up.take(shown.local, out=values, mode="clip")
    values *= y
    values += origin.take(shown.local, out=term, mode="clip")
    across.take(shown.local, out=term, mode="clip")
    term *= x
    values += term
