"""Octrees: a cube around all objects, halved along all three axes while too many objects touch a part.

Space is cut, not the objects: an object is listed in every part that its box touches. Where many meet in a point, no
cut ever parts them, so the depth is limited.

References
----------
D. Meagher, *Geometric modeling using octree encoding*, 1982.
LMU, *Computer Graphics 1*, "BVH with AABB": "Octree: #partitions explode (*8); an object may occur in multiple
partitions".
"""

from collections.abc import Callable, Sequence

import numpy as np

from core.methods import method
from core.numeric.watched import report
from core.records.arrays import Flags, Floats, Integers
from core.records.box_tree import BoxTree, Objects, join_nodes
from core.records.listing import Operation
from core.trees.bounding_volumes import Node

OCTANTS = np.array([[k & 1, k >> 1 & 1, k >> 2 & 1] for k in range(8)], bool)
"""(8, 3): whether an octant is the upper half along x, y and z."""
MOST_REFERENCES = 4_000_000
"""References that an octree may have: 32 MB of them."""


def cube_around(lower: Floats, upper: Floats) -> tuple[Floats, Floats]:
    """Return the corners (3,) of a cube around boxes (T, 3); a rounding is made up for where it cuts one off."""
    low, high = lower.min(axis=0), upper.max(axis=0)
    with np.errstate(over="ignore"):
        half = (high / 2 - low / 2).max()
        center = low / 2 + high / 2
        return np.minimum(center - half, low), np.maximum(center + half, high)


def octants_of(low: Floats, high: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the middle (3,) of a cell, and the corners (8, 3) of its octants."""
    middle = low / 2 + high / 2
    return middle, np.where(OCTANTS, middle, low), np.where(OCTANTS, high, middle)


def touching(objects: Objects, items: Integers, lower: Floats, upper: Floats) -> list[Integers]:
    """Return, for every octant (8, 3), which of ``items`` (P,) touch it by their boxes: faces count twice."""
    low, high = objects.lower[items, None], objects.upper[items, None]
    touches: Flags = np.all((low <= upper) & (high >= lower), axis=2)
    return [items[touches[:, octant]] for octant in range(8)]


def octree_listing(
    lower: Sequence[Sequence[float]], upper: Sequence[Sequence[float]], leaf_size: int, octree_depth: int
) -> list[Node]:
    """Listing of a tree of cells, halved along all axes: its nodes in pre-order."""
    nodes = []

    def build(low: list[float], high: list[float], items: list[int], depth: int) -> None:
        if len(items) <= leaf_size or depth == octree_depth:  #: leaf
            nodes.append((low, high, depth, items))
            return
        nodes.append((low, high, depth, []))
        middle = [a / 2 + b / 2 for a, b in zip(low, high, strict=True)]  #: middle
        for octant in range(8):
            is_upper = [octant >> k & 1 for k in range(3)]
            a = [middle[k] if is_upper[k] else low[k] for k in range(3)]
            b = [high[k] if is_upper[k] else middle[k] for k in range(3)]
            part = [
                i for i in items if all(lower[i][k] <= b[k] and upper[i][k] >= a[k] for k in range(3))
            ]  #: part
            build(a, b, part, depth + 1)

    if lower:
        low = [min(box[k] for box in lower) for k in range(3)]
        high = [max(box[k] for box in upper) for k in range(3)]
        half = max(b / 2 - a / 2 for a, b in zip(low, high, strict=True))
        center = [a / 2 + b / 2 for a, b in zip(low, high, strict=True)]
        cube = (
            [min(c - half, a) for c, a in zip(center, low, strict=True)],
            [max(c + half, b) for c, b in zip(center, high, strict=True)],
        )
        build(*cube, list(range(len(lower))), 0)
    return nodes


@method(
    "hierarchy",
    "octree",
    "Octree",
    source="Meagher 1982; LMU 2020, BVH with AABB",
    exact_for="every scene: each triangle in every cell that its box touches",
    breaks_where="many triangles at one point: no cut parts them, and the depth limit ends the tree",
    takes=("leaf_size", "octree_depth"),
    listing=octree_listing,
    operations={
        "octree-leaf": (
            Operation("leaf", "leaf", (), ("node_lower", "node_upper", "object_count", "node_depth")),
        ),
        "octree-node": (
            Operation("full", "leaf", (), ("node_lower", "node_upper", "object_count", "node_depth")),
            Operation("middle", "middle", ("middle",)),
            Operation("parts", "part", {"octant_counts": "part"}),
        ),
    },
)
def octree(objects: Objects, leaf_size: int, octree_depth: int) -> BoxTree:
    """List each object in all cells that it touches."""
    return grow_octree(objects, leaf_size, octree_depth, touching)


def grow_octree(
    objects: Objects,
    leaf_size: int,
    octree_depth: int,
    listed_in: Callable[[Objects, Integers, Floats, Floats], list[Integers]],
) -> BoxTree:
    """Halve a cube around all objects along all axes, while a part of it lists more than ``leaf_size``.

    ``listed_in`` says which objects the octants of a cell list, as `touching` does.

    Reports the share of the cube that is done to `core.numeric.watched.report`.

    Raises
    ------
    ValueError
        If more than `MOST_REFERENCES` objects would be listed, each as often as there are leaves that list it.
    """
    lower, upper, depth, own = list[Floats](), list[Floats](), list[int](), list[Integers]()
    none, listed, share = np.empty(0, np.int64), 0, 0.0
    pending = []
    if len(objects):
        pending.append((*cube_around(objects.lower, objects.upper), np.arange(len(objects)), 0))
    while pending:
        low, high, items, level = pending.pop()
        lower.append(low)
        upper.append(high)
        depth.append(level)
        is_leaf = len(items) <= leaf_size or level == octree_depth
        own.append(items if is_leaf else none)
        if is_leaf:
            listed, share = listed + len(items), share + 8.0**-level
            continue
        report(share)
        _, lows, highs = octants_of(low, high)
        parts = listed_in(objects, items, lows, highs)
        pending += [(lows[k], highs[k], parts[k], level + 1) for k in reversed(range(8))]
        if listed + sum(len(waiting) for _, _, waiting, _ in pending) > MOST_REFERENCES:
            raise ValueError(
                f"an octree may list {MOST_REFERENCES:,} objects, got more by depth {level + 1} of {octree_depth}: "
                "lower octree_depth, or raise leaf_size"
            )
    return join_nodes(lower, upper, depth, own)
