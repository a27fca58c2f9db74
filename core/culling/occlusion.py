"""Culling of objects that others hide: a few large ones are drawn first, depth alone, and what lies behind is dropped.

Their depth is the bottom of a pyramid: each texel of the next level keeps the farthest of 2 x 2 texels. A box covers a
rectangle of pixels. At the level at which this rectangle lies in at most 2 x 2 texels, the occluders leave no depth in
it that is farther than the farthest of these. A box whose nearest depth is farther still is hidden, with all it holds.

It drops nothing that is seen: the rectangle is as large as snapping may make it, and the nearest depth as near. A box
that crosses the near plane has no rectangle and is kept.

References
----------
N. Greene, M. Kass, G. Miller, *Hierarchical z-buffer visibility*, SIGGRAPH 1993.
H. Zhang, D. Manocha, T. Hudson, K. Hoff, *Visibility culling using hierarchical occlusion maps*, SIGGRAPH 1997.
LMU, *Computer Graphics 1*, "Culling": "Occlusion culling: do not render objects behind visible objects".
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import floor

import numpy as np

from core.depth.depth import Stored
from core.methods import method
from core.records.arrays import Flags, Floats, Integers

MOST_TEXELS = 4
"""Texels that a box is compared with, at most."""


@dataclass(frozen=True, eq=False)
class BoxesOnScreen:
    """B boxes in a window of W x H pixels."""

    node: Integers
    """(B,) int64, the node of the tree that each is."""
    is_before: Flags
    """(B,) bool, it crosses the near plane, and so has no rectangle; what follows is 0 then."""
    corners: Floats
    """(B, 8, 3) float64, x and y in pixels, and what the depth buffer would store there."""
    reach: float
    """Pixels that snapping moves a corner at most, and a little more."""
    size: tuple[int, int]
    """(W, H)."""
    rectangle: Integers
    """(B, 4) int64, first column and row, last column and row of the pixels that it may cover."""
    slack: Floats
    """(B,) float64, what its nearest corner stores, less the nearest that a fragment of it may store."""
    nearest: Floats
    """(B,) float64, this nearest."""

    @property
    def pixel_count(self) -> Integers:
        """(B,) int64, the pixels of the rectangle; 0: it has none."""
        first_column, first_row, last_column, last_row = self.rectangle.T
        return np.where(self.is_before, 0, (last_column - first_column + 1) * (last_row - first_row + 1))


def rectangles(corners: Floats, reach: float, size: tuple[int, int]) -> Integers:
    """Return the pixels (B, 4) that boxes of window corners (B, 8, 2) reach, as in `BoxesOnScreen`."""
    last = np.array(size) - 1
    low, high = corners.min(axis=1) - reach, corners.max(axis=1) + reach
    return np.concatenate([np.clip(np.floor(end), 0, last) for end in (low, high)], axis=1).astype(np.int64)


@dataclass(frozen=True, eq=False)
class OcclusionTests:
    """B boxes against the depth of the occluders."""

    pyramid: tuple[Stored, ...]
    """Level k: (ceil(H / 2^k), ceil(W / 2^k)); the first is what the occluders leave in the depth buffer."""
    level: Integers
    """(B,) int64, the level that each is compared at; -1: it has no rectangle."""
    texels: Integers
    """(B, 4, 2) int64, columns and rows of the texels there, row by row; -1: fewer."""
    stored: Floats
    """(B, 4) float64, what they store; NaN: fewer."""
    farthest: Floats
    """(B,) float64, the farthest of these; NaN: none."""
    is_hidden: Flags
    """(B,) bool."""


@dataclass(frozen=True, eq=False)
class Occlusion:
    """What compared the boxes that the frustum keeps with occluders."""

    boxes: BoxesOnScreen
    occluders: Integers
    """(K,) int64, places in ``boxes`` of the occluders, the largest first."""
    why_none: str
    """Why there are none, a sentence; empty: there are."""
    larger_is_nearer: bool
    """Whether the depth buffer keeps larger numbers for nearer fragments."""
    tests: OcclusionTests


def pyramid_of(depth: Stored, join: np.ufunc) -> tuple[Stored, ...]:
    """Return the levels over a depth buffer (H, W), up to a single texel; ``join`` says what a texel keeps of 2 x 2."""
    levels = [depth]
    while max(levels[-1].shape) > 1:
        finer = levels[-1]
        for axis in (0, 1):
            finer = join.reduceat(finer, np.arange(0, finer.shape[axis], 2), axis=axis)
        levels.append(finer)
    return tuple(levels)


def compare_with_pyramid(
    boxes: BoxesOnScreen, pyramid: tuple[Stored, ...], larger_is_nearer: bool
) -> OcclusionTests:
    """Compare the nearest depth of B boxes with up to four texels each, (B, 4), of the level that each fits."""
    first_column, first_row, last_column, last_row = boxes.rectangle.T
    level = np.full(len(boxes.node), -1)
    for number in reversed(range(len(pyramid))):
        fits = ((last_column >> number) - (first_column >> number) < 2) & (
            (last_row >> number) - (first_row >> number) < 2
        )
        level[fits & ~boxes.is_before] = number
    texels = np.full((len(level), MOST_TEXELS, 2), -1)
    stored = np.full((len(level), MOST_TEXELS), np.nan)
    for box in np.flatnonzero(level >= 0).tolist():
        one, (left, bottom, right, top) = level[box], boxes.rectangle[box] >> level[box]
        found = [(column, row) for row in range(bottom, top + 1) for column in range(left, right + 1)]
        texels[box, : len(found)] = found
        stored[box, : len(found)] = [pyramid[one][row, column] for column, row in found]
    farther = np.fmin if larger_is_nearer else np.fmax
    farthest = farther.reduce(stored, axis=1)
    with np.errstate(invalid="ignore"):
        is_hidden = boxes.nearest < farthest if larger_is_nearer else boxes.nearest > farthest
    return OcclusionTests(pyramid, level, texels, stored, farthest, is_hidden)


Chooses = Callable[[Sequence[float]], float]


def largest_boxes(rectangle: Sequence[Sequence[int]], most: int) -> list[int]:
    """Listing of the choice of occluders: the boxes whose rectangles have most pixels, the largest first."""
    pixels = [(right - left + 1) * (top - bottom + 1) for left, bottom, right, top in rectangle]  #: pixels
    order = sorted(range(len(pixels)), key=lambda box: -pixels[box])
    return order[:most]  #: chosen


def coarser_level(finer: Sequence[Sequence[float]], farther: Chooses) -> list[list[float]]:
    """Listing of one level of the pyramid; ``farther`` is max where smaller is nearer, else min."""
    coarser = []
    for y in range(0, len(finer), 2):
        rows, columns = finer[y : y + 2], range(0, len(finer[0]), 2)
        squares = [[depth for row in rows for depth in row[x : x + 2]] for x in columns]
        coarser.append([farther(square) for square in squares])  #: level
    return coarser


def box_behind_occluders(
    corners: Sequence[Sequence[float]],
    is_before: bool,
    reach: float,
    slack: float,
    pyramid: Sequence[Sequence[Sequence[float]]],
    nearer: Chooses,
    farther: Chooses,
) -> bool:
    """Listing of one box: whether it is hidden; ``nearer`` is min where smaller is nearer, ``farther`` then max."""
    if is_before:  #: near-plane
        return False
    xs, ys, depths = zip(*corners, strict=True)
    width, height = len(pyramid[0][0]), len(pyramid[0])
    ends = [
        (min(xs) - reach, width),
        (max(xs) + reach, width),
        (min(ys) - reach, height),
        (max(ys) + reach, height),
    ]
    left, right, bottom, top = [min(max(floor(end), 0), size - 1) for end, size in ends]  #: rectangle
    nearest = nearer(depths) - slack  #: nearest
    level = 0
    while (right >> level) - (left >> level) > 1 or (top >> level) - (bottom >> level) > 1:  #: level
        level += 1
    rows, columns = range(bottom >> level, (top >> level) + 1), range(left >> level, (right >> level) + 1)
    farthest = farther([pyramid[level][row][column] for row in rows for column in columns])  #: texels
    return farther([nearest, farthest]) != farthest  #: compare


@method(
    "object_culling",
    "occlusion",
    "Frustum, then occlusion",
    source="Greene, Kass, Miller 1993; Zhang et al. 1997; LMU 2020, Occlusion culling",
    exact_for="every scene: what is dropped has no pixel in the picture",
    breaks_where="what several small objects hide together, or what reaches beside an occluder: kept, though not seen; "
    "blending, lines and several samples a pixel have no occluders",
    needs=("world-boxes",),
    takes=("hierarchy", "occluders"),
    listing=box_behind_occluders,
    traits="occlusion",
)
def occlusion(boxes: BoxesOnScreen, depth: Stored, larger_is_nearer: bool) -> OcclusionTests:
    """Compare boxes that the frustum keeps with the depth (H, W) that the occluders leave."""
    pyramid = pyramid_of(depth, np.minimum if larger_is_nearer else np.maximum)
    return compare_with_pyramid(boxes, pyramid, larger_is_nearer)
