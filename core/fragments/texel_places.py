"""Where the lower left of the texels around a fragment lies: few places, whatever the coordinate, and so a table."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Wholes = NDArray[np.int32]


@dataclass(frozen=True)
class AxisPlaces:
    """The different places that a lower left texel has along one axis, whatever the coordinate."""

    size: int
    """Texels."""
    first: int
    """Texel index of the first place."""
    count: int
    """Places; then they repeat, or the texture has ended."""
    repeats: bool

    def find(self, index: Wholes, place: Wholes) -> None:
        """Write the ``place`` (F,) of texel indices (F,), 0 to count - 1."""
        if not self.repeats:
            np.subtract(index, self.first, out=place)
            np.maximum(place, 0, out=place)
            np.minimum(place, self.count - 1, out=place)
        elif self.count & (self.count - 1):
            np.remainder(index, self.count, out=place)
        else:
            np.bitwise_and(index, self.count - 1, out=place)


PLACES = {
    "repeat": lambda size: AxisPlaces(size, 0, size, True),
    "mirror": lambda size: AxisPlaces(size, 0, 2 * size, True),
    "clamp": lambda size: AxisPlaces(size, -1, size + 1, False),
}
"""By wrap: the places along an axis of so many texels."""


def place_count(shape: tuple[int, ...], wrap: str) -> int:
    """Return at how many places a texture of ``shape`` (h, w, ...) may be looked up, whatever the coordinates."""
    rows, columns = (PLACES[wrap](size).count for size in shape[:2])
    return rows * columns
