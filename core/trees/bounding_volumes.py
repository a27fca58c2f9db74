"""Bounding volume hierarchies: a box around all objects, and boxes around two parts of them, down to a few objects.

An object lies in exactly one leaf; boxes may overlap. The objects are cut by their number in sorted order, never by a
coordinate: so equal centres come apart, too, and the building ends.

References
----------
J. Clark, *Hierarchical geometric models for visible surface algorithms*, 1976.
S. Rubin, T. Whitted, *A 3-dimensional representation for fast rendering of complex scenes*, 1980.
J. Goldsmith, J. Salmon, *Automatic creation of object hierarchies for ray tracing*, 1987 (surface area).
LMU, *Computer Graphics 1*, "BVH with AABB".
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.records.arrays import Floats, Integers
from core.records.box_tree import BoxTree, Objects, join_nodes
from core.records.listing import Operation

Node = tuple[list[float], list[float], int, list[int]]
"""What a listing says of a node: least and greatest corner, depth, and the objects of a leaf."""


@dataclass(frozen=True, eq=False)
class Split:
    """How the objects of a node are cut into two parts."""

    axis: int
    items: Integers
    """(P,) int64, the objects sorted by their centres along the axis."""
    cut: int
    """How many of them go into the first part."""
    spread: Floats
    """(3,) float64, extent of the centres along every axis."""
    cost: float
    """Area times number of both parts together, half a box's surface as its area; NaN: not looked at."""


Splitter = Callable[[Objects, Integers], Split]


def centers(objects: Objects, items: Integers) -> Floats:
    """Return the centres (P, 3) of the boxes of ``items`` (P,)."""
    return objects.lower[items] / 2 + objects.upper[items] / 2


def spread_of(center: Floats) -> Floats:
    """Return the extents (3,) of centres (P, 3)."""
    with np.errstate(over="ignore"):
        return np.asarray(center.max(axis=0) - center.min(axis=0))


def median_split(objects: Objects, items: Integers) -> Split:
    """Cut ``items`` (P,) in the middle of their number, along the axis on which their centres spread most."""
    center = centers(objects, items)
    spread = spread_of(center)
    axis = int(spread.argmax())
    order = items[np.argsort(center[:, axis], kind="stable")]
    return Split(axis, order, len(items) // 2, spread, np.nan)


def area_split(objects: Objects, items: Integers) -> Split:
    """Cut ``items`` (P,) along the axis and at the place where area times number of both parts together is least."""
    center = centers(objects, items)
    sorted_by = [items[np.argsort(center[:, axis], kind="stable")] for axis in range(3)]
    costs = np.stack([split_costs(objects.lower[order], objects.upper[order]) for order in sorted_by])
    axis, place = (int(index) for index in np.unravel_index(costs.argmin(), costs.shape))
    return Split(axis, sorted_by[axis], place + 1, spread_of(center), float(costs[axis, place]))


def split_costs(lower: Floats, upper: Floats) -> Floats:
    """Return the costs (P - 1,) of cutting boxes (P, 3) in their order behind the first, the second, ..."""
    count = np.arange(1, len(lower))
    below = half_area(np.minimum.accumulate(lower), np.maximum.accumulate(upper))[:-1]
    above = half_area(np.minimum.accumulate(lower[::-1]), np.maximum.accumulate(upper[::-1]))[-2::-1]
    with np.errstate(over="ignore", invalid="ignore"):
        return below * count + above * (len(lower) - count)


def half_area(lower: Floats, upper: Floats) -> Floats:
    """Return half the surface (P,) of boxes (P, 3)."""
    with np.errstate(over="ignore", invalid="ignore"):
        x, y, z = np.moveaxis(upper - lower, -1, 0)
        return np.asarray(x * y + y * z + z * x)


def build(objects: Objects, leaf_size: int, split: Splitter) -> BoxTree:
    """Return the tree of objects (T,), cut by ``split`` while more than ``leaf_size`` are together."""
    lower, upper, depth, own = list[Floats](), list[Floats](), list[int](), list[Integers]()
    none = np.empty(0, np.int64)
    pending = [(np.arange(len(objects)), 0)] if len(objects) else []
    while pending:
        items, level = pending.pop()
        lower.append(objects.lower[items].min(axis=0))
        upper.append(objects.upper[items].max(axis=0))
        depth.append(level)
        is_leaf = len(items) <= leaf_size
        own.append(items if is_leaf else none)
        if not is_leaf:
            parts = split(objects, items)
            pending += [(parts.items[parts.cut :], level + 1), (parts.items[: parts.cut], level + 1)]
    return join_nodes(lower, upper, depth, own)


def box_of(
    lower: Sequence[Sequence[float]], upper: Sequence[Sequence[float]], items: list[int]
) -> tuple[list[float], list[float]]:
    """Return the box around the boxes of ``items``."""
    return [min(lower[i][k] for i in items) for k in range(3)], [
        max(upper[i][k] for i in items) for k in range(3)
    ]


def area_of(lower: Sequence[Sequence[float]], upper: Sequence[Sequence[float]], items: list[int]) -> float:
    """Return half the surface of the box around ``items``."""
    (x, y, z), (u, v, w) = box_of(lower, upper, items)
    return (u - x) * (v - y) + (v - y) * (w - z) + (w - z) * (u - x)


def median_tree(
    lower: Sequence[Sequence[float]], upper: Sequence[Sequence[float]], leaf_size: int
) -> list[Node]:
    """Listing of a tree of boxes, cut in the middle of the objects: its nodes in pre-order."""
    nodes = []
    center = [
        [low / 2 + high / 2 for low, high in zip(*box, strict=True)] for box in zip(lower, upper, strict=True)
    ]

    def build(items: list[int], depth: int) -> None:
        low, high = box_of(lower, upper, items)  #: bound
        if len(items) <= leaf_size:  #: leaf
            nodes.append((low, high, depth, items))
            return
        nodes.append((low, high, depth, []))
        spread = [
            max(center[i][k] for i in items) - min(center[i][k] for i in items) for k in range(3)
        ]  #: spread
        axis = spread.index(max(spread))  #: axis
        items = sorted(items, key=lambda i: center[i][axis])  #: sort
        cut = len(items) // 2  #: cut
        build(items[:cut], depth + 1)
        build(items[cut:], depth + 1)

    if lower:
        build(list(range(len(lower))), 0)
    return nodes


def area_tree(
    lower: Sequence[Sequence[float]], upper: Sequence[Sequence[float]], leaf_size: int
) -> list[Node]:
    """Listing of a tree of boxes, cut where area times number of both parts is least: its nodes in pre-order."""
    nodes = []
    center = [
        [low / 2 + high / 2 for low, high in zip(*box, strict=True)] for box in zip(lower, upper, strict=True)
    ]

    def cost_of(items: list[int], axis: int, cut: int) -> float:
        items = sorted(items, key=lambda i: center[i][axis])
        below, above = items[:cut], items[cut:]
        return area_of(lower, upper, below) * len(below) + area_of(lower, upper, above) * len(above)

    def build(items: list[int], depth: int) -> None:
        low, high = box_of(lower, upper, items)  #: bound
        if len(items) <= leaf_size:  #: leaf
            nodes.append((low, high, depth, items))
            return
        nodes.append((low, high, depth, []))
        places = [(axis, cut) for axis in range(3) for cut in range(1, len(items))]
        axis, cut = min(places, key=lambda place: cost_of(items, *place))  #: place
        items = sorted(items, key=lambda i: center[i][axis])  #: sort
        build(items[:cut], depth + 1)
        build(items[cut:], depth + 1)

    if lower:
        build(list(range(len(lower))), 0)
    return nodes


def mesh_list(
    lower: Sequence[Sequence[float]], upper: Sequence[Sequence[float]], mesh: Sequence[int]
) -> list[Node]:
    """Listing of a list of boxes, one around every mesh."""
    nodes = []
    for one in sorted(set(mesh)):
        items = [i for i in range(len(mesh)) if mesh[i] == one]
        low, high = box_of(lower, upper, items)  #: bound
        nodes.append((low, high, 0, items))  #: leaf
    return nodes


_BOUND = Operation("bound", "bound", {"node_lower": "low", "node_upper": "high"})
_LEAF = Operation("leaf", "leaf", (), ("object_count",))
_SORT = Operation("sort", "sort", {"sorted_items": "items"})


@method(
    "hierarchy",
    "none",
    "No tree: a list of meshes",
    source="LMU 2020, View frustum culling",
    exact_for="every scene: each mesh is one object",
    breaks_where="a scene of one mesh: a single box, and all triangles in it",
    listing=mesh_list,
    operations={"list-leaf": (_BOUND, Operation("leaf", "leaf", {"object_count": "nodes"}))},
)
def no_tree(objects: Objects, leaf_size: int, octree_depth: int) -> BoxTree:
    """Put one box around every mesh: as many leaves, and nothing above them."""
    starts = np.flatnonzero(np.diff(objects.mesh, prepend=-1))
    if not len(starts):
        return build(objects, leaf_size, median_split)
    items = np.split(np.arange(len(objects)), starts[1:])
    lower, upper = np.minimum.reduceat(objects.lower, starts), np.maximum.reduceat(objects.upper, starts)
    return join_nodes(list(lower), list(upper), [0] * len(starts), items)


@method(
    "hierarchy",
    "bvh",
    "BVH, cut in the middle",
    source="LMU 2020, BVH with AABB; Rubin and Whitted 1980",
    exact_for="every scene: each triangle in exactly one leaf",
    breaks_where="large triangles among small ones: boxes overlap, and a ray visits both",
    takes=("leaf_size",),
    listing=median_tree,
    operations={
        "bvh-leaf": (_BOUND, _LEAF),
        "bvh-node": (
            _BOUND,
            Operation("spread", "spread", ("spread",)),
            Operation("axis", "axis", ("axis",)),
            _SORT,
            Operation("cut", "cut", ("cut",)),
        ),
    },
)
def bvh(objects: Objects, leaf_size: int, octree_depth: int) -> BoxTree:
    """Cut the objects in the middle of their number, along the axis of the widest spread."""
    return build(objects, leaf_size, median_split)


@method(
    "hierarchy",
    "bvh-area",
    "BVH, cut by surface area",
    source="Goldsmith and Salmon 1987",
    exact_for="every scene: each triangle in exactly one leaf",
    breaks_where="building: every place of every axis is weighed, in each node",
    takes=("leaf_size",),
    listing=area_tree,
    operations={
        "bvh-leaf": (_BOUND, _LEAF),
        "bvh-area-node": (_BOUND, Operation("place", "place", ("axis", "cut"), ("cost",)), _SORT),
    },
)
def bvh_area(objects: Objects, leaf_size: int, octree_depth: int) -> BoxTree:
    """Cut the objects where the areas of both parts, each times its number of objects, are least together."""
    return build(objects, leaf_size, area_split)
