"""Where corners lie in the window before they are snapped: attributes belong to these, coverage to the snapped ones."""

from dataclasses import dataclass

import numpy as np

from core.fast_path.depth_free import is_thin
from core.raster.edges.snapping import window_position
from core.records.arrays import Flags, Floats, Integers
from core.stages.geometry import Geometry


@dataclass(frozen=True, eq=False)
class CornerPlaces:
    """The corners of P triangles: of those that are doubtful, where nothing is divided by 0.

    An unsnapped thin triangle, hardly wider than snapping moves its corners, may have turned over, or be a line; the
    snapped one is what is drawn. A corner behind the eye, or too far beside the window, has no place in it.
    """

    x: Floats
    """(3, P) float64 pixels."""
    y: Floats
    """(3, P) float64."""
    w: Floats
    """(3, P) float64, above 0."""
    doubled_area: Floats
    """(P,) float64, not 0: 1 for triangles without area, which cover no pixel, and those without places."""
    is_doubtful: Flags
    """(P,) bool, thin triangles (``core.fast_path.depth_free``) and those that cannot be projected: planes do not
    hold."""

    def take(self, chosen: Integers) -> "CornerPlaces":
        """Return the places of the ``chosen`` (C,) triangles."""
        x, y, w = (of.take(chosen, axis=1) for of in (self.x, self.y, self.w))
        return CornerPlaces(x, y, w, self.doubled_area.take(chosen), self.is_doubtful.take(chosen))


def corner_places(geometry: Geometry) -> CornerPlaces:
    """Return where the corners of all primitives lie."""
    primitives, (right, up) = geometry.primitives, geometry.shift
    window = window_position(primitives.vertex_clip.T, geometry.vertices.size)
    x, y = (window[:, 0] + right).take(primitives.corner), (window[:, 1] + up).take(primitives.corner)
    w = primitives.vertex_clip[3].take(primitives.corner)
    has_place = geometry.is_projected
    is_doubtful = is_thin(geometry) | ~has_place
    thin = np.flatnonzero(is_doubtful & has_place)
    for unsnapped, snapped in ((x, geometry.window_x), (y, geometry.window_y)):
        unsnapped[:, thin] = snapped.take(thin, axis=1)
    nowhere = np.flatnonzero(~has_place)
    x[:, nowhere] = y[:, nowhere] = 0.0
    w[:, nowhere] = 1.0
    doubled_area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    doubled_area[doubled_area == 0] = 1.0
    return CornerPlaces(x, y, w, doubled_area, is_doubtful)
