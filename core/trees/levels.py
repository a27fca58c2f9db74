"""Bounding volume hierarchies built level by level: all nodes of a level are cut together, as rows of padded arrays.

Nodes of about as many objects stand in one array (M, W), each in a row: W is a power of two, and what a row has too
much is behind all else in every order. Sorting and the least and greatest coordinates then go along the rows.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.coverage.pixel_runs import expand
from core.numeric.watched import report
from core.records.arrays import Flags, Floats, Integers
from core.records.box_tree import BoxTree, Objects

SHOWN_ITEMS = 6
"""Objects of a sorted node that a row of the trace names."""
_LARGEST = 1 << 17
"""Numbers that are worked on together: they stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class Cuts:
    """How N nodes with P objects are cut into two parts each."""

    axis: Integers
    """(N,) int64."""
    cut: Integers
    """(N,) int64, how many objects go into the first part."""
    spread: Floats
    """(N, 3) float64, extent of the centres along every axis."""
    cost: Floats
    """(N,) float64, area times number of both parts together, half a box's surface as its area; NaN: not looked at."""
    items: Integers
    """(P,) int64, the objects node by node, each node's sorted by their centres along its axis."""


Splitter = Callable[[Objects, Floats, Integers, Integers], Cuts]
"""Of objects, their centres (T, 3), the ``items`` (P,) of N nodes, node by node, and how many each has (N,)."""


@dataclass(frozen=True, eq=False)
class BuiltTree:
    """A tree of N nodes, and how each was cut; leaves have NaN and -1."""

    tree: BoxTree
    axis: Integers
    """(N,) int64."""
    cut: Integers
    """(N,) int64."""
    spread: Floats
    """(N, 3) float64."""
    cost: Floats
    """(N,) float64."""
    first_items: Integers
    """(N, `SHOWN_ITEMS`) int64, the first objects in sorted order; -1 where there are fewer."""


@dataclass(frozen=True, eq=False)
class _Level:
    """The N nodes of one level, C of them cut."""

    lower: Floats
    upper: Floats
    is_leaf: Flags
    leaf_items: Integers
    """Of all leaves, leaf by leaf."""
    leaf_count: Integers
    cuts: Cuts
    """(C,)"""
    first_items: Integers
    """(C, `SHOWN_ITEMS`)."""


def squares(count: Integers) -> Iterator[tuple[Integers, Integers, Flags]]:
    """Yield nodes (M,) of ``count`` (N,) with as many objects, roughly: their places (M, W), and which are own."""
    start = np.cumsum(count) - count
    width = 1 << np.ceil(np.log2(np.maximum(count, 1))).astype(np.int64)
    for w in np.unique(width).tolist():
        alike = np.flatnonzero(width == w)
        for nodes in np.array_split(alike, -(-len(alike) * w // _LARGEST)):
            along = np.arange(w)
            is_own = along < count[nodes, None]
            yield nodes, start[nodes, None] + np.where(is_own, along, 0), is_own


def sort_rows(values: Floats, place: Integers, is_own: Flags) -> Integers:
    """Return places (M, W) with each row sorted by its ``values`` (M, W), equal ones in their order."""
    order = np.argsort(np.where(is_own, values, np.inf), axis=1, kind="stable")
    return np.take_along_axis(place, order, axis=1)


def spread_of(center: Floats, count: Integers) -> Floats:
    """Return the extents (N, 3) of the centres (P, 3) of N nodes with ``count`` (N,) objects each."""
    start = np.cumsum(count) - count
    with np.errstate(over="ignore"):
        return np.asarray(np.maximum.reduceat(center, start) - np.minimum.reduceat(center, start))


@lru_cache(maxsize=1)
def build_levels(objects: Objects, leaf_size: int, split: Splitter) -> BuiltTree:
    """Return the tree of objects (T,), cut by ``split`` while more than ``leaf_size`` are together.

    How far it is goes to `core.numeric.watched.report`. The last one is kept: picture and trace ask for the same.
    """
    items, count = np.arange(len(objects)), np.array([len(objects)] if len(objects) else [], np.int64)
    center = objects.lower / 2 + objects.upper / 2
    levels: list[_Level] = []
    expected = max(np.log2(max(len(objects) / leaf_size, 1)) + 1, 1)
    while len(count):
        report(min(len(levels) / expected, 1.0))
        start = np.cumsum(count) - count
        lower = np.minimum.reduceat(objects.lower[items], start)
        upper = np.maximum.reduceat(objects.upper[items], start)
        is_leaf = count <= leaf_size
        goes_on = np.repeat(~is_leaf, count)
        leaf_items, leaf_count = items[~goes_on], count[is_leaf]
        count = count[~is_leaf]
        cuts = split(objects, center, items[goes_on], count)
        items = cuts.items
        place = (np.cumsum(count) - count)[:, None] + np.arange(SHOWN_ITEMS)
        is_own = np.arange(SHOWN_ITEMS) < count[:, None]
        first = np.where(is_own, items[np.where(is_own, place, 0)] if len(items) else -1, -1)
        levels.append(_Level(lower, upper, is_leaf, leaf_items, leaf_count, cuts, first))
        count = np.stack([cuts.cut, count - cuts.cut], axis=1).ravel()
    return _in_pre_order(levels)


def _in_pre_order(levels: list[_Level]) -> BuiltTree:
    """Return the nodes of all levels in pre-order."""
    sizes: list[Integers] = []
    below = np.empty(0, np.int64)
    for level in reversed(levels):
        size = np.ones(len(level.is_leaf), np.int64)
        size[~level.is_leaf] += below.reshape(-1, 2).sum(axis=1)
        sizes.append(size)
        below = size
    sizes.reverse()
    total = int(sizes[0].sum()) if sizes else 0
    lower, upper, spread = np.empty((total, 3)), np.empty((total, 3)), np.full((total, 3), np.nan)
    end, cost = np.empty(total, np.int64), np.full(total, np.nan)
    axis, cut, own_count = np.full(total, -1), np.full(total, -1), np.zeros(total, np.int64)
    first_items = np.full((total, SHOWN_ITEMS), -1)
    leaf_places, leaf_counts, leaf_items = ([np.empty(0, np.int64)] for _ in range(3))
    place = np.zeros(1, np.int64)
    for depth, level in enumerate(levels):
        parents = place[~level.is_leaf]
        lower[place], upper[place], end[place] = level.lower, level.upper, place + sizes[depth]
        axis[parents], cut[parents] = level.cuts.axis, level.cuts.cut
        spread[parents], cost[parents] = level.cuts.spread, level.cuts.cost
        first_items[parents] = level.first_items
        leaf_places.append(place[level.is_leaf])
        leaf_counts.append(level.leaf_count)
        leaf_items.append(level.leaf_items)
        own_count[leaf_places[-1]] = level.leaf_count
        if len(parents):
            place = np.stack([parents + 1, parents + 1 + sizes[depth + 1][::2]], axis=1).ravel()
    counts, items = np.concatenate(leaf_counts), np.concatenate(leaf_items)
    order = np.argsort(np.concatenate(leaf_places))
    leaf, turn = expand(counts[order])
    items = items[(np.cumsum(counts) - counts)[order][leaf] + turn]
    first = np.concatenate([[0], np.cumsum(own_count)])
    return BuiltTree(BoxTree(lower, upper, end, first, items), axis, cut, spread, cost, first_items)
