"""Pieces of pixels: convex polygons that edges cut a pixel's square into, their areas and centroids.

Coordinates are from the pixel's centre, so a whole square reaches from -1/2 to 1/2. A polygon with fewer corners than
the array has room for repeats its first corner, which adds nothing to its area.

Exactness
---------
The value of an edge function at the pixel's centre is exact for snapped corners (`core.raster.edge_functions`); a
corner made by a cut is rounded to about 2^-53 pixel. Two triangles of an edge cut with the same line, turned over, so
what one of them leaves outside is what the other finds inside: the pieces of a pixel add up to its area, without gap or
overlap.

References
----------
I. Sutherland, G. Hodgman, *Reentrant polygon clipping*, 1974.
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (polygons clipped to the pixel, exact areas).
L. Carpenter, *The A-buffer, an antialiased hidden surface method*, 1984.
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats, Integers

SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
"""(4, 2) corners of a pixel, counter-clockwise."""
FLAT = 2.0**-60
"""Area in pixels below which a piece is not worth its division: its centroid is the mean of its corners."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """P convex polygons, counter-clockwise."""

    corner: Floats
    """(P, V, 2) float64, x and y from the pixel's centre."""
    corner_count: Integers
    """(P,) int64, how many of the V are its own; the others repeat the first."""
    number: Integers
    """(P,) int64, what the piece is called by its owner: parts keep the number of the whole."""

    def __len__(self) -> int:
        return len(self.number)

    def select(self, keep: Flags) -> "Pieces":
        """Return the pieces where ``keep`` (P,) holds."""
        index = np.flatnonzero(keep)
        return Pieces(self.corner.take(index, axis=0), self.corner_count.take(index), self.number.take(index))


def whole_pixels(number: Integers) -> Pieces:
    """Return the squares of pixels, named ``number`` (P,)."""
    corner = np.broadcast_to(SQUARE, (len(number), 4, 2)).copy()
    return Pieces(corner, np.full(len(number), 4), number)


def join_pieces(parts: list[Pieces]) -> Pieces:
    """Return all pieces of some lists, in their order."""
    room = max((part.corner.shape[1] for part in parts), default=3)
    corners = []
    for part in parts:
        first = part.corner[:, :1]
        missing = room - part.corner.shape[1]
        corners.append(np.concatenate([part.corner, np.repeat(first, missing, axis=1)], axis=1))
    return Pieces(
        np.concatenate(corners),
        np.concatenate([part.corner_count for part in parts]),
        np.concatenate([part.number for part in parts]),
    )


def split_pieces(pieces: Pieces, a: Floats, b: Floats, value: Floats) -> tuple[Pieces, Pieces]:
    """Cut pieces along lines.

    Parameters
    ----------
    pieces : Pieces
    a, b, value : (P,) float64
        Change of an edge function per column and row, and its value at the pixel's centre.

    Returns
    -------
    inside, outside : Pieces
        What lies where the function is positive, and where it is negative; what has no area is left out.
    """
    distance = a[:, None] * pieces.corner[..., 0] + (b[:, None] * pieces.corner[..., 1] + value[:, None])
    return _part(pieces, distance), _part(pieces, -distance)


def _part(pieces: Pieces, distance: Floats) -> Pieces:
    """Return what of pieces lies where ``distance`` (P, V), linear over each, is positive."""
    count, room = distance.shape
    place = np.arange(room)
    is_own = place < pieces.corner_count[:, None]
    following = np.where(place + 1 < pieces.corner_count[:, None], place + 1, 0)
    next_distance = np.take_along_axis(distance, following, axis=1)
    next_corner = np.take_along_axis(pieces.corner, following[..., None], axis=1)

    # Every corner that is inside, and behind it the crossing with the line where the side ends beyond it.
    is_kept = is_own & (distance >= 0)
    is_crossed = is_own & ((distance > 0) & (next_distance < 0) | (distance < 0) & (next_distance > 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        t = distance / (distance - next_distance)
    crossing = pieces.corner + np.where(is_crossed, t, 0.0)[..., None] * (next_corner - pieces.corner)
    emitted = np.stack([is_kept, is_crossed], axis=2).reshape(count, 2 * room)
    points = np.stack([pieces.corner, crossing], axis=2).reshape(count, 2 * room, 2)

    corner_count = emitted.sum(axis=1)
    new_room = max(int(corner_count.max(initial=3)), 3)
    first = points[np.arange(count), emitted.argmax(axis=1)] if count else np.empty((0, 2))
    corner = np.repeat(first[:, None], new_room, axis=1)
    to = np.cumsum(emitted, axis=1) - 1
    which, at = np.nonzero(emitted)
    corner[which, to[which, at]] = points[which, at]
    found = Pieces(corner, corner_count, pieces.number)
    return found.select((corner_count >= 3) & (area_of(found) > 0))


def area_of(pieces: Pieces) -> Floats:
    """Return the areas (P,) float64 in pixels."""
    doubled, _, _ = _moments(pieces)
    return 0.5 * doubled


def centroid_of(pieces: Pieces) -> tuple[Floats, Floats]:
    """Return x and y (P,) float64 of the centroids, from the pixel's centre."""
    doubled, x, y = _moments(pieces)
    is_flat = doubled <= FLAT
    scale = 1 / (3 * np.where(is_flat, 1.0, doubled))
    mean_x, mean_y = pieces.corner.transpose(2, 1, 0)[:, 0]
    return np.where(is_flat, mean_x, mean_x + x * scale), np.where(is_flat, mean_y, mean_y + y * scale)


def _moments(pieces: Pieces) -> tuple[Floats, Floats, Floats]:
    """Return twice the area, and six times the first moments about the first corner, (P,) each: a fan is summed."""
    x, y = pieces.corner.transpose(2, 1, 0)
    dx, dy = x - x[0], y - y[0]
    doubled, moment_x, moment_y = np.zeros((3, len(pieces)))
    for k in range(1, len(x) - 1):
        cross = dx[k] * dy[k + 1] - dx[k + 1] * dy[k]
        doubled += cross
        moment_x += cross * (dx[k] + dx[k + 1])
        moment_y += cross * (dy[k] + dy[k + 1])
    return doubled, moment_x, moment_y
