"""Which surfaces can be seen in a pixel, and how far apart their colours can be.

Within a pixel's square, a mesh whose outline does not cross it covers every sample as often as any other (see
``touched.outline_edges``). So the farthest depth of such a mesh and facing hides all that lies wholly behind it; what is
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
    hidden_behind, hider = np.full(count, np.inf), np.full(count, -1)
    if not is_blended:
        far, pixel, only = _covering_groups(touched, culls_backs)
        np.minimum.at(hidden_behind, pixel, far)
        is_nearest = far == hidden_behind[pixel]
        hider[pixel[is_nearest]] = only[is_nearest]
    is_candidate = touched.is_drawn & ~(touched.near > hidden_behind[touched.pixel] + margin)
    behind = np.flatnonzero(is_candidate & (hider[touched.pixel] >= 0))
    is_candidate[behind] = ~(depth_between(touched, hider[touched.pixel[behind]], behind)[0] > margin)
    sees_background = ~(hidden_behind < np.inf)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    low[sees_background] = high[sees_background] = background[:3]
    pixel = touched.pixel[is_candidate]
    np.minimum.at(low, pixel, colors.low[is_candidate])
    np.maximum.at(high, pixel, colors.high[is_candidate])
    width = byte_width(np.minimum(low, high), high).max(axis=1)
    return Surfaces(is_candidate, sees_background, np.where(width < ROUNDING, 0.0, width))


def _covering_groups(touched: Touched, culls_backs: bool) -> tuple[Floats, Integers, Integers]:
    """Return the farthest depth and the pixel of every mesh and facing that covers all of a pixel's square.

    The third is the pair that does it, or -1 where it takes several.
    """
    primitive = touched.primitive
    is_back = touched.facing.take(primitive) < 0
    chosen = ~is_back if culls_backs else np.ones(len(primitive), bool)
    chosen &= touched.facing.take(primitive) != 0
    mesh = touched.geometry.primitives.mesh.take(primitive)
    group = (touched.pixel * (int(mesh.max(initial=0)) + 1) + mesh) * 2 + is_back
    index = np.flatnonzero(chosen)
    order = index[np.argsort(group[index], kind="stable")]
    if not len(order):
        return np.empty(0), np.empty(0, np.int64), np.empty(0, np.int64)
    starts = np.flatnonzero(np.diff(group[order], prepend=-1))
    far = np.maximum.reduceat(touched.far[order], starts)
    is_outlined = np.logical_or.reduceat(touched.is_outlined[order], starts)
    first = order[starts]
    only = np.where(np.diff(np.append(starts, len(order))) == 1, first, -1)
    return far[~is_outlined], touched.pixel[first][~is_outlined], only[~is_outlined]


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
