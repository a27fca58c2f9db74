"""Which surfaces can be seen in a pixel, and how far apart their colours can be.

Within a pixel's square, a piece of surface whose outline does not cross it covers every sample as often as any other
(see ``touched.outline_edges``). So such a piece of one facing hides all that lies behind every triangle of it; what is
left are the candidates, and whatever is drawn there, with as many samples as wanted, with faces of a back culled,
clipped or not, in any depth format that tells the candidates from what they hide, has a colour between the least and
the largest of theirs: two such pictures are no farther apart than the **width** of that range.
"""

from dataclasses import dataclass

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.study.planner.bounds.bytes import byte_width
from core.study.planner.bounds.color_ranges import ColorRanges
from core.study.planner.scene_analysis.conservative_coverage import Touched
from core.study.planner.scene_analysis.orders import depth_between
from core.study.planner.scene_analysis.pieces import Pieces

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
    is_candidate, sees_background = candidates(touched, margin, culls_backs, is_blended, colors.is_known)
    low, high = np.full((3, count), np.inf), np.full((3, count), -np.inf)
    low[:, sees_background] = high[:, sees_background] = background[:3, None]
    # Pairs stand pixel by pixel.
    index = np.flatnonzero(is_candidate)
    pixel = touched.pixel[index]
    starts = np.flatnonzero(np.diff(pixel, prepend=-1))
    there = pixel[starts]
    if len(index):
        for channel in range(3):
            least = np.minimum.reduceat(colors.low[index, channel], starts)
            most = np.maximum.reduceat(colors.high[index, channel], starts)
            low[channel, there] = np.minimum(low[channel, there], least)
            high[channel, there] = np.maximum(high[channel, there], most)
    width = np.zeros(count)
    width[there] = byte_width(np.minimum(low, high)[:, there], high[:, there]).max(axis=0)
    return Surfaces(is_candidate, sees_background, np.where(width < ROUNDING, 0.0, width))


def candidates(
    touched: Touched,
    margin: float,
    culls_backs: bool,
    is_blended: bool,
    is_known: Flags | None = None,
) -> tuple[Flags, Flags]:
    """Return which pairs (Q,) may be seen, and of which pixels (H*W,) the background; arguments as of `surfaces`.

    Parameters
    ----------
    is_known : (Q,) bool, optional
        Pairs that are not are known to be hidden already.
    """
    hidden_behind = np.full(touched.pixel_count, np.inf)
    is_candidate = touched.is_drawn.copy() if is_known is None else touched.is_drawn & is_known
    if not is_blended:
        hiders = touched.pieces.covering(culls_backs)
        # The nearest of a pixel is written last.
        hiders = hiders.take(np.argsort(-hiders.far, kind="stable"))
        hidden_behind[hiders.pixel] = hiders.far
        nearest = np.full(touched.pixel_count, -1)
        nearest[hiders.pixel] = np.arange(len(hiders.pixel))
        is_candidate &= ~(touched.near > hidden_behind[touched.pixel] + margin)
        is_candidate &= ~_is_behind(touched, hiders, nearest, is_candidate, margin)
    return is_candidate, ~(hidden_behind < np.inf)


def may_be_seen(touched: Touched, is_blended: bool) -> Flags:
    """Return (Q,) bool: False where a pair is hidden whatever is chosen, by fronts and in the coarsest format too."""
    return candidates(touched, format_margin("z-16"), True, is_blended)[0]


def _is_behind(
    touched: Touched, hiders: Pieces, nearest: Integers, is_candidate: Flags, margin: float
) -> Flags:
    """Return (Q,) bool: the candidate is behind every triangle of the nearest piece that covers its pixel."""
    behind = np.zeros(len(touched.pixel), bool)
    index = np.flatnonzero(is_candidate & (nearest[touched.pixel] >= 0))
    piece = nearest[touched.pixel[index]]
    few = hiders.count[piece] <= MOST_TRIANGLES
    index, piece = index[few], piece[few]
    for step in range(int(hiders.count[piece].max(initial=0))):
        # Those that are behind so far, and have not been compared with all.
        is_done = hiders.count[piece] <= step
        behind[index[is_done]] = True
        index, piece = index[~is_done], piece[~is_done]
        front = hiders.order[hiders.start[piece] + step]
        is_farther = depth_between(touched, front, index)[0] > margin
        index, piece = index[is_farther], piece[is_farther]
    behind[index] = True
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
