"""Where corners lie in the window before they are snapped: attributes belong to these, coverage to the snapped ones."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.geometry_record import Geometry
from core.picture.cleared import is_thin
from core.raster.snapping import window_position


@dataclass(frozen=True, eq=False)
class CornerPlaces:
    """The corners of P projected triangles; those of thin triangles, hardly wider than snapping moves them, snapped.

    An unsnapped thin triangle may have turned over, or be a line; the snapped one is what is drawn.
    """

    x: Floats
    """(3, P) float64 pixels."""
    y: Floats
    """(3, P) float64."""
    doubled_area: Floats
    """(P,) float64, not 0: 1 for triangles without area, which cover no pixel."""
    is_thin: Flags
    """(P,) bool, see ``core.picture.cleared``."""

    def take(self, chosen: Integers) -> "CornerPlaces":
        """Return the places of the ``chosen`` (C,) triangles."""
        x, y = self.x.take(chosen, axis=1), self.y.take(chosen, axis=1)
        return CornerPlaces(x, y, self.doubled_area.take(chosen), self.is_thin.take(chosen))


def corner_places(geometry: Geometry) -> CornerPlaces:
    """Return where the corners of all primitives lie."""
    primitives, (right, up) = geometry.primitives, geometry.shift
    window = window_position(primitives.vertex_clip.T, geometry.vertices.size)
    x, y = (window[:, 0] + right).take(primitives.corner), (window[:, 1] + up).take(primitives.corner)
    thin_ones = is_thin(geometry)
    thin = np.flatnonzero(thin_ones)
    for unsnapped, snapped in ((x, geometry.window_x), (y, geometry.window_y)):
        unsnapped[:, thin] = snapped.take(thin, axis=1)
    doubled_area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    doubled_area[doubled_area == 0] = 1.0
    return CornerPlaces(x, y, doubled_area, thin_ones)
