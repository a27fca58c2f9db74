"""One record for trees of boxes, and for lists of them: nodes in pre-order, each with the end of its subtree."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.records.arrays import Flags, Floats, Integers, cached_property, checked

NODE_BYTES, ITEM_BYTES = 8 * (3 + 3 + 1 + 1), 8
"""What a node takes in memory (two corners, the end of its subtree, its first item), and a reference to an object."""


@dataclass(frozen=True, eq=False)
class Objects:
    """T objects that a tree is built over, each known by its box."""

    lower: Floats
    """(T, 3) float64, least coordinates."""
    upper: Floats
    """(T, 3) float64, greatest coordinates."""
    mesh: Integers
    """(T,) int64, what each is part of, not falling."""

    def __len__(self) -> int:
        return len(self.lower)


@dataclass(frozen=True, eq=False)
class BoxTree:
    """N nodes in pre-order: behind a node stands its first child, and the next one stands at a subtree's end.

    Whoever walks it goes from node k to k + 1, or past all that is inside to ``subtree_end[k]``.
    """

    lower: Floats
    """(N, 3) float64, least coordinates of every box."""
    upper: Floats
    """(N, 3) float64, greatest coordinates."""
    subtree_end: Integers
    """(N,) int64, the number behind the last node of the subtree: k + 1 of a leaf."""
    first: Integers
    """(N + 1,) int64: the subtree of node k has the ``items`` from ``first[k]`` to ``first[subtree_end[k]]``."""
    items: Integers
    """(R,) int64, numbers of the objects, leaf by leaf; one that lies in several leaves stands there several times."""

    def __len__(self) -> int:
        return len(self.subtree_end)

    @cached_property
    def count(self) -> Integers:
        """(N,) int64, how many references the subtree of every node has."""
        return self.first[self.subtree_end] - self.first[:-1]

    @cached_property
    def object_count(self) -> Integers:
        """(N,) int64, how many different objects the subtree of every node has."""
        if len(np.unique(self.items)) == len(self.items):
            return self.count
        return np.array([len(np.unique(self.items_of(node))) for node in range(len(self))], np.int64)

    @cached_property
    def is_leaf(self) -> Flags:
        """(N,) bool."""
        return np.asarray(self.subtree_end == np.arange(1, len(self) + 1))

    @cached_property
    def depth(self) -> Integers:
        """(N,) int64, how many nodes each one lies in: 0 of a root."""
        opened = np.zeros(len(self) + 2, np.int64)
        np.add.at(opened, np.arange(len(self)) + 1, 1)
        np.add.at(opened, self.subtree_end, -1)
        return np.cumsum(opened)[: len(self)]

    @property
    def byte_count(self) -> int:
        """What nodes and references take in memory."""
        return NODE_BYTES * len(self) + ITEM_BYTES * len(self.items)

    def items_of(self, node: int) -> Integers:
        """Return the objects of a node's subtree, leaf by leaf."""
        return self.items[self.first[node] : self.first[self.subtree_end[node]]]

    def children(self, node: int) -> list[int]:
        """Return the nodes directly inside a node."""
        found, child, end = [], node + 1, int(self.subtree_end[node])
        while child < end:
            found.append(child)
            child = int(self.subtree_end[child])
        return found


def join_nodes(
    lower: Sequence[Floats], upper: Sequence[Floats], depth: Sequence[int], items: Sequence[Integers]
) -> BoxTree:
    """Return N nodes that come in pre-order as a tree; ``items`` are those that each has itself, none but of a leaf."""
    end, open_nodes = np.full(len(depth), len(depth), np.int64), list[int]()
    for node, level in enumerate(depth):
        while len(open_nodes) > level:
            end[open_nodes.pop()] = node
        open_nodes.append(node)
    return BoxTree(
        np.array(lower, float).reshape(-1, 3),
        np.array(upper, float).reshape(-1, 3),
        end,
        np.cumsum([0, *map(len, items)]).astype(np.int64),
        np.concatenate([*items, np.empty(0, np.int64)]),
    )


def checked_objects(lower: Floats, upper: Floats, mesh: Integers | None = None) -> Objects:
    """Return objects of boxes (T, 3), all of one mesh if ``mesh`` (T,) is not given.

    Raises
    ------
    ValueError
        Unless all corners are finite and no box is turned inside out.
    """
    low, high = (
        checked(name, values, ("T", 3), np.float64)
        for name, values in zip(("lower", "upper"), (lower, upper), strict=True)
    )
    if len(low) != len(high):
        raise ValueError(f"upper must have as many boxes as lower, {len(low)}, got {len(high)}")
    if (low > high).any():
        box = int((low > high).any(axis=1).argmax())
        raise ValueError(f"lower must not lie above upper, got {low[box]} and {high[box]} for box {box}")
    return Objects(low, high, np.zeros(len(low), np.int64) if mesh is None else mesh)
