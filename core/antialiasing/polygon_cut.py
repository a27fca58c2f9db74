"""Cutting one polygon and measuring it, step by step: the listings of `core.antialiasing.pixel_pieces`.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978.
"""

from collections.abc import Sequence
from itertools import pairwise

from core.antialiasing.pixel_pieces import FLAT, ON_LINE

Polygon = list[tuple[float, float]]
"""Corners counter-clockwise, x and y from the pixel's centre."""


def cut_polygon(polygon: Polygon, a: float, b: float, value: float) -> Polygon:
    """Return what of a polygon lies where a x + b y + value is positive; the empty list: nothing that has an area."""
    on_line = ON_LINE * (abs(a) + abs(b))
    distance = [a * x + (b * y + value) for x, y in polygon]  #: distances
    distance = [0.0 if abs(d) <= on_line else d for d in distance]
    if min(distance, default=0.0) >= 0:
        return polygon  #: whole
    if max(distance) <= 0:
        return []  #: nothing
    kept = []
    for k, (x, y) in enumerate(polygon):
        after = (k + 1) % len(polygon)
        next_x, next_y = polygon[after]
        here, there = distance[k], distance[after]
        if here >= 0:
            kept.append((x, y))
        if here < 0 < there or there < 0 < here:
            t = here / (here - there)
            kept.append((x + t * (next_x - x), y + t * (next_y - y)))
    return kept if len(kept) >= 3 and polygon_area(kept) > FLAT else []  #: cut


def polygon_area(polygon: Polygon) -> float:
    """Return the area of a polygon in pixels: half the sum of cross products, a fan about its first corner."""
    doubled = 0.0
    for (x1, y1), (x2, y2) in pairwise(polygon[1:]):
        x0, y0 = polygon[0]
        doubled += (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    return 0.5 * doubled  #: area


def shown_areas(areas: Sequence[float], primitives: Sequence[int], new: int) -> tuple[float, float]:
    """Return how much of a pixel shows the ``new`` primitive, and how much any; -1 shows the background."""
    front, covered = 0.0, 0.0  #: none
    for area, number in zip(areas, primitives, strict=True):
        if number == new:
            front += area  #: seen
        if number >= 0:
            covered += area  #: cover
    return front, covered
