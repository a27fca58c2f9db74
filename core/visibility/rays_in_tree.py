"""Ray casting with a tree of boxes: a ray asks the triangles of a leaf only if it meets all boxes around it.

A box is met where the ray's way through its three slabs, each from one plane of the box to the opposite one, has a part
in common. A box that is missed is jumped over with its subtree, and so is one that begins behind the nearest hit.

What is a hit, and which of two is nearer, is decided as in ``ray-casting``. So boxes must hold whatever covers a pixel,
and that is more than the triangle: corners are snapped, and slabs are rounded. `TreeRays` makes boxes larger by both.

References
----------
S. Rubin, T. Whitted, *A 3-dimensional representation for fast rendering of complex scenes*, 1980 (boxes in boxes).
T. Kay, J. Kajiya, *Ray tracing complex scenes*, 1986 (slabs).
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "graphics pipelines vs. raytracing": O(log n) with an
acceleration structure, but the constant is very high.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf, isnan, nan
from typing import TypeVar

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.box_tree import BoxTree
from core.records.primitives import DrawingOrder
from core.records.steps import RowOrder
from core.visibility.exact_case import ExactCase, ExactTests
from core.visibility.ray_casting import RayPlanes, decide_hits

ROUNDING = 2.0**-44
"""Bound of the rounding in a slab, as a share of the sizes of all that it is made from: 512 roundings."""
RAY_BY_RAY = RowOrder(
    ("Row", "Ray", "Box or hit"),
    is_by_pixel=True,
    sums=(
        ("boxes", "node", "asked"),
        ("covered", "hit", "nearest so far, of which each ray keeps the last"),
        ("depth-failed", "hit", "hidden or out of range"),
    ),
)
"""Ray after ray, and of each the boxes and triangles in the order in which it asks them."""
OPENED, MISSED, BEHIND = range(3)
"""What becomes of a box: it is met, missed, or begins behind the nearest hit so far."""
Triangle = TypeVar("Triangle")


@dataclass(frozen=True, eq=False)
class TreeRays:
    """The rays of a picture in the space of a tree's boxes, and its N boxes made larger for them.

    The ray through X, Y of the window runs from ``origin`` along ``direction``; its parameter t is w where all rays
    begin in the eye, and z where they are parallel.
    """

    tree: BoxTree
    lower: Floats
    """(N, 3) float64, least coordinates, made larger."""
    upper: Floats
    """(N, 3) float64, greatest coordinates, made larger."""
    matrix: Floats
    """(3, 3) float64, the columns lead along X, along Y, and into the depth of the view."""
    base: Floats
    """(3,) float64, where X, Y and depth are 0: the eye, if rays begin there."""
    is_central: bool
    """Whether all rays begin in the eye."""
    across: float
    """What X and Y are multiplied by for parallel rays: w, which is constant then."""
    steepness: Floats
    """(N,) float64, how much nearer than at its corners a triangle of the subtree may be where snapping has covered."""
    has_order: bool
    """Whether t tells how near a hit is; else no box is left out for being far."""

    def rays(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Return origins and directions (3, U) of the rays at X, Y (U,)."""
        to_x, to_y, to_depth = (column[:, None] for column in self.matrix.T)
        if self.is_central:
            return np.broadcast_to(self.base[:, None], (3, len(x))), to_x * x + to_y * y + to_depth
        return self.base[:, None] + (to_x * x + to_y * y) * self.across, np.broadcast_to(
            to_depth, (3, len(x))
        )

    @property
    def least(self) -> float:
        """The parameter that a ray begins with."""
        return 0.0 if self.is_central else -inf

    def nearness(self, enter: Floats, node: Integers) -> Floats:
        """Return how near a hit in boxes (U,) can be at most, as `RayPlanes.values` counts, of rays that enter at t."""
        if not self.has_order:
            return np.full(len(enter), inf)
        with np.errstate(divide="ignore", invalid="ignore"):
            nearest = np.where(enter > 0, 1 / enter, inf) if self.is_central else -enter / self.across
            bound = (nearest + self.steepness.take(node)) + np.abs(nearest) * 2.0**-40
        return np.where(np.isnan(bound), inf, bound)  # Infinities of both signs bound nothing.


def set_up_tree_rays(
    tree: BoxTree, to_clip: Floats, planes: RayPlanes, constant_w: float, reach: float, sizes: Floats
) -> TreeRays:
    """Return the rays through a tree.

    Parameters
    ----------
    to_clip : (4, 4) float64
        From the space of the boxes to x, y, z and w.
    constant_w : float
        w of all corners; 0: it is not the same for all, and rays begin in the eye.
    reach : float
        How far coverage reaches beyond a triangle, in pixels.
    sizes : (4, 4) float64
        The sizes of all terms of ``to_clip``.
    """
    depth_row = 2 if constant_w else 3
    rows, offset = to_clip[[0, 1, depth_row], :3], to_clip[[0, 1, depth_row], 3]
    matrix: Floats = np.asarray(np.linalg.inv(rows), np.float64)
    farthest = np.maximum(np.abs(tree.lower), np.abs(tree.upper)).max(axis=0, initial=0.0)
    rounded = ROUNDING * (sizes[[0, 1, depth_row], :3] @ farthest + sizes[[0, 1, depth_row], 3])
    width, height = planes.size
    one_pixel = np.array([2 * reach / width, 2 * reach / height])
    w_row = to_clip[3]
    largest_w = np.maximum(tree.lower * w_row[:3], tree.upper * w_row[:3]).sum(axis=1) + w_row[3]
    moved = np.outer(np.maximum(largest_w, 0.0), np.abs(matrix[:, :2]) @ one_pixel)
    margin = moved + (np.abs(matrix) @ rounded + ROUNDING * np.abs(matrix @ offset))
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = (np.abs(planes.a) * one_pixel[0] + np.abs(planes.b) * one_pixel[1]) / np.abs(planes.d)
    slope = np.where(np.isfinite(slope), slope, inf)
    return TreeRays(
        tree,
        tree.lower - margin,
        tree.upper + margin,
        matrix,
        -matrix @ offset,
        not constant_w,
        constant_w or 1.0,
        _largest_below(tree, slope),
        planes.by_w or bool(constant_w),
    )


def _largest_below(tree: BoxTree, values: Floats) -> Floats:
    """Return the largest of the values (T,) of all objects below every node (N,); 0 where it has none."""
    if not len(tree.items):
        return np.zeros(len(tree))
    listed = np.append(values.take(tree.items), 0.0)
    ends = np.stack([tree.first[:-1], tree.first[tree.subtree_end]], axis=1)
    found = np.maximum.reduceat(listed, ends.ravel())[::2]
    return np.where(tree.count > 0, found, 0.0)


def meet_box(
    origin: Sequence[float],
    direction: Sequence[float],
    low: Sequence[float],
    high: Sequence[float],
    least: float,
) -> tuple[float, float]:
    """Listing of the way of a ray through a box, from enter to leave: it is missed where it leaves before it enters."""
    enter, leave = least, inf
    for k in range(3):
        t0 = divided(low[k] - origin[k], direction[k])
        t1 = divided(high[k] - origin[k], direction[k])
        if isnan(t0) or isnan(t1):
            continue
        enter = max(enter, min(t0, t1))  #: enter
        leave = min(leave, max(t0, t1))
    return enter, leave


def divided(number: float, by: float) -> float:
    """Return a quotient as float64 has it: infinite where it is divided by 0, and not a number for 0/0."""
    if by != 0:
        return number / by
    return nan if number == 0 else inf if number > 0 else -inf


def slabs(origin: Floats, direction: Floats, lower: Floats, upper: Floats) -> tuple[Floats, Floats]:
    """Return where rays (3, U) pass the near and the far plane of each slab of boxes (3, U): t (3, U) of both.

    Notes
    -----
    A ray that runs in a plane of its slab has 0/0 there: it is inside, from minus infinity to infinity.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        one, other = (lower - origin) / direction, (upper - origin) / direction
        is_along = np.isnan(one) | np.isnan(other)
        return np.where(is_along, -inf, np.minimum(one, other)), np.where(
            is_along, inf, np.maximum(one, other)
        )


def walk_tree(
    boxes: Sequence[tuple[int, Sequence[Triangle]]],
    meets_box: Callable[[int], bool],
    is_behind: Callable[[int, Triangle | None], bool],
    meets: Callable[[Triangle], bool],
    is_nearer: Callable[[Triangle, Triangle], bool],
) -> Triangle | None:
    """Listing of the walk of one ray; a box is the number behind its subtree, and the triangles of a leaf."""
    nearest: Triangle | None = None
    node = 0
    while node < len(boxes):
        end, triangles = boxes[node]
        if not meets_box(node):  #: missed
            node = end  #: jump
            continue
        if is_behind(node, nearest):  #: behind
            node = end  #: skip
            continue
        for triangle in triangles:  #: leaf
            if meets(triangle) and (nearest is None or is_nearer(triangle, nearest)):
                nearest = triangle
        node += 1  #: next
    return nearest


@method(
    "visibility",
    "ray-casting-tree",
    "Ray casting with a tree of boxes",
    source="Rubin and Whitted 1980; Kay and Kajiya 1986; Pellacini, graphics pipelines vs. raytracing",
    exact_for="opaque triangles in any order: each hit is decided as in ray casting (exact)",
    breaks_where="edge functions that round (float16, float32): they may cover a pixel whose ray misses the box; "
    "blending: only the nearest surface of each pixel is left",
    takes=("hierarchy",),
    listing=walk_tree,
    traits="exact",
)
def ray_casting_with_tree(clip: Floats) -> DrawingOrder:
    """Take the triangles in the order in which each ray meets their boxes."""
    return DrawingOrder(np.arange(len(clip)), True, decide_in_tree, RAY_BY_RAY, walks_tree=True)


def decide_in_tree(case: ExactCase) -> tuple[Flags, ExactTests]:
    """Keep of the fragments the nearest of each pixel alone; where no tree holds them, as rays that ask all."""
    if case.tree is None:
        return decide_hits(case)
    from core.visibility.tree_walk import walk_rays  # Only rays in a tree wait for it.

    pixels, first = np.unique(case.pixel, return_index=True)
    m, n = case.rays
    of_ray, initial = (pixels, m.take(first), n.take(first)), case.initial.take(pixels)
    fragments = case.pixel, case.triangle
    tests, walk = walk_rays(case.tree, case.planes, *fragments, of_ray, initial, case.keeps_visits)
    return walk.wins, replace(tests, walk=walk)


@dataclass(frozen=True, eq=False)
class Visits:
    """V boxes that rays have asked, ray by ray, in the order of the walk."""

    ray: Integers
    """(V,) int64."""
    node: Integers
    """(V,) int64."""
    verdict: Integers
    """(V,) int64, ``OPENED``, ``MISSED`` or ``BEHIND``."""
    time: Integers
    """(V,) int64, the number of the visit in the walk of its ray."""
    nearest: Integers
    """(V,) int64, the nearest triangle that the ray has met by then, -1: none."""


@dataclass(frozen=True, eq=False)
class TreeWalk:
    """The walks of U rays through a tree, and what became of F fragments on the way."""

    rays: TreeRays
    x: Floats
    """(U,) float64, X of the rays."""
    y: Floats
    """(U,) float64, Y of the rays."""
    pixel: Integers
    """(U,) int64, of each ray."""
    wins: Flags
    """(F,) bool, the nearest of its pixel."""
    winner: Integers
    """(F,) int64, the triangle that its ray meets first."""
    ties: Flags
    """(F,) bool, it is met exactly where that one is."""
    time: Integers
    """(F,) int64, the number of the visit of the ray in which it was compared; -1: the tree has hidden it."""
    rank: Integers
    """(F,) int64, place among the fragments that were compared in the same visit."""
    previous: Integers
    """(F,) int64, the fragment that was the nearest before, -1: none, or one that was there before all."""
    box_count: Integers
    """(U,) int64, boxes that each ray has asked."""
    asked_count: Integers
    """(U,) int64, triangles in the leaves that it has opened."""
    visits: Visits | None
    """All visits; ``None``: not kept."""
    hidden_in: Integers
    """(F,) int64, the box that the ray has not opened around a fragment that was not compared, -1: it was compared."""
