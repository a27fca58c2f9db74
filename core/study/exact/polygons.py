"""Exact cover of polygons: for each pixel's centre, how often rings run around it, in whole numbers."""

import numpy as np

from core.raster.edges.snapping import SUBPIXELS
from core.records.arrays import Flags
from core.records.rings import Rings


def exact_cover(rings: Rings, polygon: int, size: tuple[int, int], is_even_odd: bool) -> Flags:
    """Return (H, W) bool, the pixels whose centres, moved a little to the right and up, lie inside a polygon.

    Parameters
    ----------
    rings : Rings
        Corners are snapped to 1/256 pixel.
    size : (width, height)
    is_even_odd : bool
        Inside is what an odd number of sides separates from the outside; else what rings run around.

    Notes
    -----
    Of each side, the pixels right of it count: by the sign of a cross product in Python's integers.
    """
    width, height = size
    crossed, winding = np.zeros((2, height, width), np.int64)
    half = SUBPIXELS // 2
    for ring in rings.rings_of(polygon):
        places = np.rint(ring * SUBPIXELS).astype(np.int64).tolist()
        for (x0, y0), (x1, y1) in zip(places, [*places[1:], places[0]], strict=True):
            way = 1 if y1 > y0 else -1
            for row in range(height):
                y = SUBPIXELS * row + half
                if (y0 <= y) == (y1 <= y):
                    continue
                for column in range(width):
                    x = SUBPIXELS * column + half
                    if way * ((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) >= 0:
                        crossed[row, column] += 1
                        winding[row, column] += way
    return np.asarray(crossed % 2 == 1 if is_even_odd else winding != 0)
