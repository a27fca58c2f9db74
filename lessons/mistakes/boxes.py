"""Mistakes with boxes of objects: asked by planes and by rays, and cut into trees."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np

from core import Settings
from core.records.arrays import Floats, Integers
from core.records.box_tree import BoxTree, Objects
from core.trees.bounding_volumes import bvh
from core.trees.octree import grow_octree
from lessons.mistakes.transforms import Vector
from lessons.mistakes.twin import Case, Twin, wrong_rule
from lessons.small_scenes import triangle_scene

Box = tuple[Sequence[Any], Sequence[Any]]
"""Least and greatest coordinates."""


def farthest_along(normal: Sequence[Any], offset: Any, box: Box) -> Vector:
    """Return the distance of the corner of a box farthest along a plane's normal."""
    return (sum(n * (high if n > 0 else low) for n, low, high in zip(normal, *box, strict=True)) + offset,)


def dropped(planes: Sequence[tuple[Sequence[Any], Any]], box: Box) -> Vector:
    """Return 1 where a box lies outside of one of the planes as a whole, else 0."""
    return (int(any(farthest_along(normal, offset, box)[0] < 0 for normal, offset in planes)),)


def slab_ends(origin: Sequence[int], direction: Sequence[int], box: Box) -> list[tuple[Fraction, Fraction]]:
    """Return where a ray comes between the two planes of each axis, and where it leaves them."""
    found = []
    for start, step, low, high in zip(origin, direction, *box, strict=True):
        one, other = Fraction(low - start, step), Fraction(high - start, step)
        found.append((min(one, other), max(one, other)))
    return found


def way_through(origin: Sequence[int], direction: Sequence[int], box: Box) -> Vector:
    """Return where a ray enters a box, and where it leaves it; it misses the box where it leaves first."""
    ends = slab_ends(origin, direction, box)
    return max(near for near, _ in ends), min(far for _, far in ends)


def nearest_hit(boxes: Sequence[tuple[int, int]]) -> Vector:
    """Return which of boxes, each with the distance where it begins and that of its hit, has the nearest hit."""
    return (min(range(len(boxes)), key=lambda k: boxes[k][1]),)


def parts_by_number(centers: Sequence[int]) -> Vector:
    """Return how many of sorted centres go into both parts of a tree that is cut in the middle."""
    return len(centers) // 2, len(centers) - len(centers) // 2


def entries(spans: Sequence[tuple[int, int]], middle: int) -> Vector:
    """Return how many of the spans touch the lower half of a cell, and how many the upper one."""
    return sum(low <= middle for low, _ in spans), sum(high >= middle for _, high in spans)


def octants_of_centres(objects: Objects, items: Integers, lower: Floats, upper: Floats) -> list[Integers]:
    """List each of ``items`` (P,) in the one octant (8, 3) that its centre lies in."""
    centres = objects.lower[items] / 2 + objects.upper[items] / 2
    octant = (centres >= upper[0]) @ np.array([1, 2, 4])
    return [items[octant == k] for k in range(8)]


def octree_of_centres(objects: Objects, leaf_size: int, octree_depth: int) -> BoxTree:
    """Grow an octree that lists each object once."""
    return grow_octree(objects, leaf_size, octree_depth, octants_of_centres)


def boxes_of_centres(objects: Objects, leaf_size: int, octree_depth: int) -> BoxTree:
    """Bound only the centres of what each node of a hierarchy holds."""
    tree, centres = bvh(objects, leaf_size, octree_depth), objects.lower / 2 + objects.upper / 2
    held = [centres[tree.items_of(node)] for node in range(len(tree))]
    lower, upper = (np.array([find(each, axis=0) for each in held]) for find in (np.min, np.max))
    return replace(tree, lower=lower, upper=upper)


IN_OCTREE = Settings(visibility="ray-casting-tree", hierarchy="octree", leaf_size=1, octree_depth=2)
IN_BOXES = Settings(visibility="ray-casting-tree", hierarchy="bvh", leaf_size=1)
NEIGHBOURS = triangle_scene([[(1, 1), (11, 1), (1, 9)], [(11, 2), (11, 9), (2, 9)]], (12, 10))
ONE_PIXEL = triangle_scene([[(4, 4), (5, 4), (4.5, 5)]], (9, 9))

TWINS = (
    Twin(
        "octant-of-centre",
        "Each object was listed in the part that its centre lies in. An octree lists it in every part that it "
        "touches, or rays would miss what reaches over the border.",
        Case(NEIGHBOURS, IN_OCTREE),
        Case(ONE_PIXEL, IN_OCTREE),
        lambda settings: (
            settings.replaced(hierarchy=octree_of_centres) if settings.hierarchy == "octree" else settings
        ),
    ),
    Twin(
        "boxes-of-centres",
        "The boxes were put around the centres of the objects. A box must hold all of each object, or what is seen "
        "is dropped with its box.",
        Case(NEIGHBOURS, IN_BOXES),
        Case(ONE_PIXEL, IN_BOXES),
        lambda settings: (
            settings.replaced(hierarchy=boxes_of_centres) if settings.hierarchy == "bvh" else settings
        ),
    ),
)
"""Trees that lose what is seen."""


@wrong_rule(farthest_along, shows=((1, 0), 0, ((-1, 0), (2, 1))), hides=((1, 0), 0, ((2, 0), (2, 1))))
def nearest_corner_asked(normal: Sequence[Any], offset: Any, box: Box) -> Vector:
    """The corner farthest against the plane's normal was asked.

    A box is outside as a whole only where even the corner farthest along the normal is.
    """
    return (sum(n * (low if n > 0 else high) for n, low, high in zip(normal, *box, strict=True)) + offset,)


@wrong_rule(
    dropped,
    shows=((((1, 0), 1), ((-1, 0), 1)), ((-3, 0), (3, 1))),
    hides=((((1, 0), 1), ((-1, 0), 1)), ((2, 0), (3, 1))),
)
def no_corner_inside(planes: Sequence[tuple[Sequence[Any], Any]], box: Box) -> Vector:
    """The box was dropped as none of its corners is inside.

    A large box around the view has none inside, either: it is outside only where all corners are outside of one
    and the same plane.
    """
    corners = product(*zip(*box, strict=True))
    inside = (
        all(
            sum(n * x for n, x in zip(normal, corner, strict=True)) + offset >= 0 for normal, offset in planes
        )
        for corner in corners
    )
    return (int(not any(inside)),)


@wrong_rule(way_through, shows=((0, 0), (1, 1), ((2, 3), (6, 5))), hides=((0, 0), (1, 1), ((2, 2), (5, 5))))
def slabs_joined(origin: Sequence[int], direction: Sequence[int], box: Box) -> Vector:
    """The ways between the planes of both axes were joined.

    The ray is in the box only where it is between all of them: from the largest entry to the smallest exit.
    """
    ends = slab_ends(origin, direction, box)
    return min(near for near, _ in ends), max(far for _, far in ends)


@wrong_rule(nearest_hit, shows=(((1, 9), (3, 4)),), hides=(((1, 2), (3, 4)),))
def nearest_box_wins(boxes: Sequence[tuple[int, int]]) -> Vector:
    """The box that begins nearest was taken.

    What it holds may lie farther than a hit in another box: the nearest hit wins.
    """
    return (min(range(len(boxes)), key=lambda k: boxes[k][0]),)


@wrong_rule(parts_by_number, shows=((0, 1, 2, 3, 20),), hides=((0, 1, 19, 20),))
def space_halved(centers: Sequence[int]) -> Vector:
    """The space was halved.

    A bounding volume hierarchy cuts the sorted objects in the middle of their number, wherever they lie.
    """
    middle = Fraction(min(centers) + max(centers), 2)
    below = sum(center < middle for center in centers)
    return below, len(centers) - below


@wrong_rule(entries, shows=(((0, 3), (4, 9), (6, 8)), 5), hides=(((0, 3), (6, 8)), 5), twin=TWINS[0])
def entries_by_centre(spans: Sequence[tuple[int, int]], middle: int) -> Vector:
    """Return in how many halves their centres lie: each in one."""
    below = sum(low + high < 2 * middle for low, high in spans)
    return below, len(spans) - below
