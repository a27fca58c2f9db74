"""A point of the wireframe: the pixel that contains it, with every line method."""

from math import floor

from core.records.operation import Operation

POINT = "point"
"""Kind of the row of a point."""
OPERATIONS = (
    Operation("pixel", "pixel", {"column": "column", "row": "row"}),
    Operation("plot", "draw", {"covered": "pixels"}),
)
"""What the row of a point does."""


def point_listing(x: float, y: float, center: float) -> list[tuple[int, int]]:
    """List the pixel that contains a point; on a border it is the one on the right, or above.

    ``center`` is where a pixel's centre lies from its number: 0.5, or 0.
    """
    pixels = []
    column, row = floor(x - center + 0.5), floor(y - center + 0.5)  #: pixel
    pixels.append((column, row))  #: draw
    return pixels
