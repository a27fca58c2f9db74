"""Pieces of surface: the triangles of one component and facing in a pixel, which hide together what lies behind.

Within a pixel's square a piece that no outlined edge crosses covers every sample (see ``touched.outline_edges``).
"""

from dataclasses import dataclass

import numpy as np

from core.records.arrays import Flags, Floats, Integers


@dataclass(frozen=True, eq=False)
class Pieces:
    """G pieces, each in one pixel."""

    pixel: Integers
    """(G,) int64."""
    far: Floats
    """(G,) float64, farthest window depth in the pixel's square."""
    start: Integers
    """(G,) int64, where its pairs begin in ``order``."""
    count: Integers
    """(G,) int64, how many they are."""
    is_front: Flags
    """(G,) bool."""
    covers: Flags
    """(G,) bool, all of the pixel's square."""
    order: Integers
    """Numbers of pairs, piece by piece."""

    def take(self, index: Integers) -> "Pieces":
        """Return the pieces ``index`` (R,)."""
        return Pieces(
            self.pixel.take(index),
            self.far.take(index),
            self.start.take(index),
            self.count.take(index),
            self.is_front.take(index),
            self.covers.take(index),
            self.order,
        )

    def covering(self, culls_backs: bool) -> "Pieces":
        """Return the pieces that cover all of their pixels, without backs where these may be left out."""
        return self.take(np.flatnonzero(self.covers & (self.is_front | (not culls_backs))))


def pieces_of(
    pixel: Integers, component: Integers, facing: Floats, far: Floats, is_outlined: Flags
) -> Pieces:
    """Join pairs of pixel and triangle to pieces.

    Parameters
    ----------
    pixel : (Q,) int64
    component : (Q,) int64
        Triangles of one number hang together.
    facing : (Q,) float64
        Positive: a front; 0: seen edge on, which hides nothing.
    far : (Q,) float64
        Farthest window depth.
    is_outlined : (Q,) bool
        An outlined edge crosses the square.
    """
    index = np.flatnonzero(facing != 0)
    group = (pixel * (int(component.max(initial=0)) + 1) + component) * 2 + (facing < 0)
    order = index[np.argsort(group[index], kind="stable")]
    starts = np.flatnonzero(np.diff(group[order], prepend=-1))
    if not len(starts):
        none, nothing = np.empty(0, np.int64), np.empty(0, bool)
        return Pieces(none, np.empty(0), none, none, nothing, nothing, none)
    return Pieces(
        pixel[order[starts]],
        np.maximum.reduceat(far[order], starts),
        starts,
        np.diff(np.append(starts, len(order))),
        facing[order[starts]] > 0,
        ~np.logical_or.reduceat(is_outlined[order], starts),
        order,
    )
