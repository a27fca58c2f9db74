"""Rings: closed lines of corners in the window. One is the outline of a polygon, more are its holes or islands."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from core.records.arrays import Flags, Floats, Integers, checked

RING_CORNERS = 3
"""Least number of corners of a ring."""


@dataclass(frozen=True, eq=False)
class Rings:
    """The rings of P polygons; one polygon's stand together, in the order of the polygons."""

    corners: Floats
    """(V, 2) float64, pixels; the rings' corners one after the other."""
    starts: Integers
    """(R + 1,) int64: ring k has the corners from ``starts[k]`` to ``starts[k + 1]``."""
    polygon: Integers
    """(R,) int64, the polygon of each ring, not falling."""

    @property
    def following(self) -> Integers:
        """(V,) int64, the corner after each one on its ring."""
        following = np.arange(1, len(self.corners) + 1)
        following[self.starts[1:] - 1] = self.starts[:-1]
        return following

    @property
    def polygon_of_corner(self) -> Integers:
        """(V,) int64."""
        return np.repeat(self.polygon, np.diff(self.starts))

    @property
    def areas(self) -> Floats:
        """(R,) float64, signed area inside each ring, in square pixels: above 0 where it runs counter-clockwise."""
        away = self.corners - np.repeat(self.corners[self.starts[:-1]], np.diff(self.starts), axis=0)
        (x, y), (next_x, next_y) = away.T, away[self.following].T
        return np.add.reduceat(x * next_y - next_x * y, self.starts[:-1]) / 2

    @property
    def are_flat(self) -> Flags:
        """(R,) bool, all corners lie on one line, or at one place: such a ring encloses nothing."""
        first = np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))
        away = self.corners - self.corners[self.starts[:-1]][first]
        length = (away**2).sum(axis=1)
        farthest = np.array([at + int(length[at:end].argmax()) for at, end in pairwise(self.starts.tolist())])
        x, y = away[farthest][first].T
        return np.asarray(~np.logical_or.reduceat(x * away[:, 1] != y * away[:, 0], self.starts[:-1]))

    def moved(self, x: float, y: float) -> "Rings":
        """Return the rings ``x`` and ``y`` pixels further."""
        return replace(self, corners=self.corners + np.array([x, y]))

    def ring(self, index: int) -> Floats:
        """Return the corners (K, 2) of one ring."""
        return self.corners[self.starts[index] : self.starts[index + 1]]

    def rings_of(self, polygon: int) -> list[Floats]:
        """Return the rings of one polygon, each (K, 2)."""
        return [self.ring(int(index)) for index in np.flatnonzero(self.polygon == polygon)]


def join_rings(polygons: Sequence[Sequence[ArrayLike]]) -> Rings:
    """Return the rings of polygons, each a sequence of rings (K, 2) in pixels, as one record."""
    rings = [np.asarray(ring, float) for rings in polygons for ring in rings]
    polygon = np.repeat(np.arange(len(polygons)), [len(rings) for rings in polygons])
    starts = np.cumsum([0, *(len(ring) for ring in rings)])
    return Rings(np.concatenate([*rings, np.empty((0, 2))]), starts, polygon)


def checked_rings(name: str, starts: ArrayLike | None, corner_count: int) -> Integers:
    """Return the first corners (R,) of the rings of ``corner_count`` corners; ``None``: one ring.

    Raises
    ------
    ValueError
        Unless they rise from 0 and each ring has at least three corners.
    """
    firsts = checked(name, [0] if starts is None else starts, ("R",), np.int64)
    counts = np.diff([*firsts.tolist(), corner_count])
    if len(firsts) == 0 or firsts[0] != 0:
        raise ValueError(f"{name} must begin with corner 0, got {firsts.tolist()}")
    if (counts < RING_CORNERS).any():
        ring = int(np.argmax(counts < RING_CORNERS))
        raise ValueError(
            f"ring {ring} must have at least {RING_CORNERS} corners, got {max(int(counts[ring]), 0)}"
        )
    return firsts
