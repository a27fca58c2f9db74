"""Pieces of pixels: convex polygons that edges cut a pixel's square into, and the listings of the cuts.

Coordinates are from the pixel's centre, so a whole square reaches from -1/2 to 1/2. A polygon with fewer corners than
the array has room for repeats its first corner, which adds nothing to its area.

Exactness
---------
The value of an edge function at the pixel's centre is exact for snapped corners (`core.coverage.edges`); a
corner made by a cut is rounded to about 2^-53 pixel, and a corner that is no farther than rounding from a line lies on
it. Two triangles of an edge cut with the same line, turned over, so what one of them leaves outside is what the other
finds inside: the pieces of a pixel add up to its area, without gap or overlap.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (polygons clipped to the pixel, exact areas).
L. Carpenter, *The A-buffer, an antialiased hidden surface method*, 1984.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.records.arrays import Flags, Floats, Integers

# Pieces of pixels: convex polygons that edges cut a pixel's square into, their areas and centroids.


SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
"""(4, 2) corners of a pixel, counter-clockwise."""
FLAT = 2.0**-60
"""Area in pixels up to which what a cut leaves is rounding, and left out."""
ON_LINE = 2.0**-46
"""Pixels that a corner may lie beside a line and still be on it: corners that a cut has made are rounded by less.
Without it a neighbour that shares the edge would cut off slivers of rounding, a third of all pieces of a fine mesh."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """P convex polygons, counter-clockwise."""

    corner: Floats
    """(2, V, P) float64, x and y from the pixel's centre, corner by corner."""
    corner_count: Integers
    """(P,) int64, how many of the V are its own; the others repeat the first."""
    number: Integers
    """(P,) int64, what the piece is called by its owner: parts keep the number of the whole."""

    def __len__(self) -> int:
        return len(self.number)

    def select(self, keep: Flags) -> "Pieces":
        """Return the pieces where ``keep`` (P,) holds."""
        return self.take(np.flatnonzero(keep))

    def take(self, index: Integers) -> "Pieces":
        """Return the pieces (K,) of an index."""
        return Pieces(self.corner.take(index, axis=2), self.corner_count.take(index), self.number.take(index))


def whole_pixels(number: Integers) -> Pieces:
    """Return the squares of pixels, named ``number`` (P,)."""
    corner = np.repeat(SQUARE.T[..., None], len(number), axis=2)
    return Pieces(corner, np.full(len(number), 4), number)


def join_pieces(parts: list[Pieces]) -> Pieces:
    """Return all pieces of some lists, in their order."""
    room = max((part.corner.shape[1] for part in parts), default=3)
    count = sum(len(part) for part in parts)
    corner, first = np.empty((2, room, count)), 0
    for part in parts:
        own, end = part.corner.shape[1], first + len(part)
        corner[:, :own, first:end] = part.corner
        corner[:, own:, first:end] = part.corner[:, :1]
        first = end
    return Pieces(
        corner,
        np.concatenate([part.corner_count for part in parts]),
        np.concatenate([part.number for part in parts]),
    )


def split_pieces(pieces: Pieces, a: Floats, b: Floats, value: Floats) -> tuple[Pieces, Pieces]:
    """Cut pieces along lines.

    Parameters
    ----------
    a, b, value : (P,) float64
        Change of an edge function per column and row, and its value at the pixel's centre.

    Returns
    -------
    inside, outside : Pieces
        What lies where the function is positive, and where it is negative; what has no area is left out.
    """
    x, y = pieces.corner
    distance = a * x + (b * y + value)
    distance[np.abs(distance) <= ON_LINE * (np.abs(a) + np.abs(b))] = 0
    # Most pieces lie on one side as a whole: only the others are cut.
    is_inside = distance.min(axis=0, initial=np.inf) >= 0
    is_outside = ~is_inside & (distance.max(axis=0, initial=-np.inf) <= 0)
    crossed = np.flatnonzero(~(is_inside | is_outside))
    cut, of_cut = pieces.take(crossed), distance.take(crossed, axis=1)
    inside, outside = _part(cut, of_cut), _part(cut, -of_cut)
    return join_pieces([pieces.select(is_inside), inside]), join_pieces([pieces.select(is_outside), outside])


def _part(pieces: Pieces, distance: Floats) -> Pieces:
    """Return what of pieces lies where ``distance`` (V, P), linear over each, is positive."""
    room, count = distance.shape
    is_own = np.arange(room)[:, None] < pieces.corner_count
    # Behind its last corner a piece repeats the first one, or the array ends.
    next_distance = np.roll(distance, -1, axis=0)
    next_corner = np.roll(pieces.corner, -1, axis=1)

    # Every corner that is inside, and behind it the crossing with the line where the side ends beyond it.
    is_kept = is_own & (distance >= 0)
    is_crossed = is_own & ((distance > 0) & (next_distance < 0) | (distance < 0) & (next_distance > 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        t = distance / (distance - next_distance)
    crossing = pieces.corner + np.where(is_crossed, t, 0.0) * (next_corner - pieces.corner)
    emitted = np.stack([is_kept, is_crossed], axis=1).reshape(2 * room, count)
    points = np.stack([pieces.corner, crossing], axis=2).reshape(2, 2 * room, count)

    corner_count = emitted.sum(axis=0)
    new_room = max(int(corner_count.max(initial=3)), 3)
    first = points[:, emitted.argmax(axis=0), np.arange(count)]
    corner = np.repeat(first[:, None], new_room, axis=1)
    to = np.cumsum(emitted, axis=0) - 1
    at, which = np.nonzero(emitted)
    corner[:, to[at, which], which] = points[:, at, which]
    found = Pieces(corner, corner_count, pieces.number)
    return found.select((corner_count >= 3) & (area_of(found) > FLAT))


def area_of(pieces: Pieces) -> Floats:
    """Return the areas (P,) float64 in pixels."""
    doubled, _, _ = _moments(pieces)
    return 0.5 * doubled


def centroid_of(pieces: Pieces) -> tuple[Floats, Floats]:
    """Return x and y (P,) float64 of the centroids, from the pixel's centre."""
    doubled, x, y = _moments(pieces)
    scale = 1 / (3 * doubled)
    first_x, first_y = pieces.corner[:, 0]
    return first_x + x * scale, first_y + y * scale


def _moments(pieces: Pieces) -> tuple[Floats, Floats, Floats]:
    """Return twice the area, and six times the first moments about the first corner, (P,) each: a fan is summed."""
    x, y = pieces.corner
    dx, dy = x - x[0], y - y[0]
    doubled, moment_x, moment_y = np.zeros((3, len(pieces)))
    for k in range(1, len(x) - 1):
        cross = dx[k] * dy[k + 1] - dx[k + 1] * dy[k]
        doubled += cross
        moment_x += cross * (dx[k] + dx[k + 1])
        moment_y += cross * (dy[k] + dy[k + 1])
    return doubled, moment_x, moment_y


# Cutting one polygon and measuring it, step by step: the listings of `core.antialiasing.pixel_pieces`.


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
