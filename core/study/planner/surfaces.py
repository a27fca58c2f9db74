"""Which surfaces can be seen in a pixel, and how far apart their colours can be.

Within a pixel's square, a piece of surface whose outline does not cross it covers every sample as often as any other
(see ``touched.outline_edges``). So such a piece of one facing hides all that lies behind every triangle of it; what is
left are the candidates, and whatever is drawn there, with as many samples as wanted, with faces of a back culled,
clipped or not, in any depth format that tells the candidates from what they hide, has a colour between the least and
the largest of theirs: two such pictures are no farther apart than the **width** of that range.
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.study.planner.bytes import byte_width
from core.study.planner.color_ranges import ColorRanges
from core.study.planner.orders import depth_between
from core.study.planner.touched import Touched

ROUNDING = 1e-9
"""Widths below this, in 1/255, are rounding of equal colours."""


MOST_TRIANGLES = 16
"""A piece of surface with more triangles in a pixel is looked at by its farthest depth alone."""


@dataclass(frozen=True, eq=False)
class Surfaces:
    """The candidates of every pixel."""

    is_candidate: Flags
    """(Q,) bool, of the pairs of a look."""
    sees_background: Flags
    """(H * W,) bool, some of the pixel may be covered by nothing."""
    width: Floats
    """(H * W,) float64, in 1/255 of sRGB: pictures of the candidates differ by no more."""


def surfaces(
    touched: Touched,
    colors: ColorRanges,
    background: Floats,
    margin: float,
    culls_backs: bool = False,
    is_blended: bool = False,
) -> Surfaces:
    """Find the candidates of every pixel.

    Parameters
    ----------
    touched : Touched
    colors : ColorRanges
    background : (4,) float64 linear
    margin : float
        Window depths closer than this may be taken for equal, see `format_margin`.
    culls_backs : bool
        Whether back faces may be left out, so that they hide nothing.
    is_blended : bool
        Whether surfaces let others shine through: then all are candidates, and the background too.
    """
    count = touched.pixel_count
    hidden_behind = np.full(count, np.inf)
    is_candidate = touched.is_drawn.copy()
    if not is_blended:
        hiders = _covering_groups(touched, culls_backs)
        np.minimum.at(hidden_behind, hiders.pixel, hiders.far)
        is_candidate &= ~(touched.near > hidden_behind[touched.pixel] + margin)
        is_candidate &= ~_is_behind(touched, hiders, hidden_behind, is_candidate, margin)
    sees_background = ~(hidden_behind < np.inf)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    low[sees_background] = high[sees_background] = background[:3]
    pixel = touched.pixel[is_candidate]
    np.minimum.at(low, pixel, colors.low[is_candidate])
    np.maximum.at(high, pixel, colors.high[is_candidate])
    width = byte_width(np.minimum(low, high), high).max(axis=1)
    return Surfaces(is_candidate, sees_background, np.where(width < ROUNDING, 0.0, width))


@dataclass(frozen=True, eq=False)
class _Hiders:
    """G pieces of surface that cover all of a pixel's square."""

    pixel: Integers
    """(G,) int64."""
    far: Floats
    """(G,) float64, their farthest depth there."""
    start: Integers
    """(G,) int64, where its pairs begin in ``order``."""
    count: Integers
    """(G,) int64."""
    order: Integers
    """Numbers of pairs."""


def _covering_groups(touched: Touched, culls_backs: bool) -> _Hiders:
    """Return the components of one facing that cover all of a pixel's square."""
    primitive = touched.primitive
    facing = touched.facing.take(primitive)
    chosen = facing > 0 if culls_backs else facing != 0
    component = touched.component.take(primitive)
    group = (touched.pixel * (int(component.max(initial=0)) + 1) + component) * 2 + (facing < 0)
    index = np.flatnonzero(chosen)
    order = index[np.argsort(group[index], kind="stable")]
    starts = np.flatnonzero(np.diff(group[order], prepend=-1))
    if not len(starts):
        none = np.empty(0, np.int64)
        return _Hiders(none, np.empty(0), none, none, none)
    far = np.maximum.reduceat(touched.far[order], starts)
    covers = ~np.logical_or.reduceat(touched.is_outlined[order], starts)
    counts = np.diff(np.append(starts, len(order)))
    return _Hiders(touched.pixel[order[starts]][covers], far[covers], starts[covers], counts[covers], order)


def _is_behind(
    touched: Touched, hiders: _Hiders, hidden_behind: Floats, is_candidate: Flags, margin: float
) -> Flags:
    """Return (Q,) bool: the candidate is behind every triangle of the nearest piece that covers its pixel."""
    nearest = np.full(touched.pixel_count, -1)
    is_nearest = hiders.far == hidden_behind[hiders.pixel]
    nearest[hiders.pixel[is_nearest]] = np.flatnonzero(is_nearest)
    behind = np.zeros(len(touched.pixel), bool)
    index = np.flatnonzero(is_candidate & (nearest[touched.pixel] >= 0))
    piece = nearest[touched.pixel[index]]
    few = hiders.count[piece] <= MOST_TRIANGLES
    index, piece = index[few], piece[few]
    still = np.ones(len(index), bool)
    for step in range(int(hiders.count[piece].max(initial=0))):
        there = np.flatnonzero(still & (hiders.count[piece] > step))
        front = hiders.order[hiders.start[piece[there]] + step]
        still[there] = depth_between(touched, front, index[there])[0] > margin
    behind[index[still]] = True
    return behind


def format_margin(depth: str) -> float:
    """Return how close two window depths must be for a format to take one for the other.

    Notes
    -----
    Whole numbers of b bits: less than one step apart. float32 z: 24 bits below 1. Reversed and logarithmic depth, and
    1/w, are finer than float32 z wherever that is coarse; near the eye, where they need not be, z moves by far more for
    the same step; they are taken to be as fine as float32 z.
    """
    steps = {"z-16": 2.0**16 - 1, "z-24": 2.0**24 - 1}
    return 1.5 / steps.get(depth, 2.0**23)
