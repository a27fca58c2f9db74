"""How far away what is seen in a picture of a space is, so that the wheel can go there."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from core.records.cached import cached_property
from widgets.space.orbit import Orbit, refocused


@dataclass(frozen=True, eq=False)
class ViewDepth:
    """Distances at some places of a picture that was drawn in perspective."""

    orbit: Orbit
    """From which the picture was drawn."""
    field_of_view: float
    """Vertical, in radians."""
    distance: NDArray[np.float64] = field(repr=False)
    """(R, C) along the direction of view, row 0 at the bottom, evenly over the picture; NaN where nothing is seen."""

    def __post_init__(self) -> None:
        if self.distance.ndim != 2 or 0 in self.distance.shape:
            raise ValueError(f"distance must be (R, C) with at least one place, got {self.distance.shape}")

    @cached_property
    def covered(self) -> list[tuple[float, float, float, float]]:
        """The places where something is seen, row by row: left, bottom, right and top, fractions."""
        rows, columns = self.distance.shape
        is_seen = ~np.isnan(self.distance)
        seen = np.flatnonzero(is_seen.any(axis=1))
        first = is_seen[seen].argmax(axis=1) / columns
        last = 1 - is_seen[seen, ::-1].argmax(axis=1) / columns
        return [
            (left, row / rows, right, (row + 1) / rows)
            for row, left, right in zip(seen.tolist(), first.tolist(), last.tolist(), strict=True)
        ]

    def focused(self, orbit: Orbit, x: float, y: float) -> Orbit:
        """Return ``orbit`` with its target as far away as what is seen at a place, and the same picture.

        Parameters
        ----------
        orbit : Orbit
            The present one: the picture may be older, and is of no use if the space has been turned since.
        x, y : float
            Fractions of the picture's width and height, y up.

        Notes
        -----
        Magnifying goes towards the target and never beyond it. If the target hangs in front of what is seen, the
        wheel does less and less and never gets there.
        """
        is_turned = (orbit.azimuth, orbit.elevation) != (self.orbit.azimuth, self.orbit.elevation)
        if is_turned or not (0 <= x < 1 and 0 <= y < 1):
            return orbit
        rows, columns = self.distance.shape
        forward = -orbit.axes()[2]
        gone = forward @ (orbit.eye(self.field_of_view) - self.orbit.eye(self.field_of_view))
        return refocused(
            orbit, float(self.distance[int(y * rows), int(x * columns)] - gone), self.field_of_view
        )
