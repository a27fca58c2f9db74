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

from collections.abc import Sequence

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.box_tree import BoxTree, Objects, join_nodes
from core.records.listing import Operation
from core.trees.levels import Cuts, build_levels, sort_rows, spread_of, squares

Node = tuple[list[float], list[float], int, list[int]]
"""What a listing says of a node: least and greatest corner, depth, and the objects of a leaf."""


def median_split(objects: Objects, center: Floats, items: Integers, count: Integers) -> Cuts:
    """Cut nodes in the middle of their number, along the axis on which their centres spread most.

    Arguments as of a `core.trees.levels.Splitter`: centres (T, 3), items (P,), and their count (N,) in each node.
    """
    spread = spread_of(center[items], count) if len(count) else np.empty((0, 3))
    axis = spread.argmax(axis=1)
    sorted_items = np.empty_like(items)
    for nodes, place, is_own in squares(count):
        turn = sort_rows(center[items[place], axis[nodes, None]], place, is_own)
        sorted_items[place[is_own]] = items[turn[is_own]]
    return Cuts(axis, count // 2, spread, np.full(len(count), np.nan), sorted_items)


def area_split(objects: Objects, center: Floats, items: Integers, count: Integers) -> Cuts:
    """Cut nodes along the axis and at the place where area times number of both parts together is least.

    Arguments as of `median_split`: centres (T, 3), items (P,), count (N,).
    """
    spread = spread_of(center[items], count) if len(count) else np.empty((0, 3))
    axis, cut, cost = np.empty(len(count), np.int64), np.empty(len(count), np.int64), np.empty(len(count))
    sorted_items = np.empty_like(items)
    for nodes, place, is_own in squares(count):
        turns = [sort_rows(center[items[place], k], place, is_own) for k in range(3)]
        costs = [split_costs(objects, items[turn], is_own) for turn in turns]
        best = np.stack([each.argmin(axis=1) for each in costs])
        of_best = np.stack(
            [
                np.take_along_axis(each, at[:, None], axis=1)[:, 0]
                for each, at in zip(costs, best, strict=True)
            ]
        )
        chosen, row = of_best.argmin(axis=0), np.arange(len(nodes))
        axis[nodes], cut[nodes], cost[nodes] = chosen, best[chosen, row] + 1, of_best[chosen, row]
        turn = np.stack(turns)[chosen, row]
        sorted_items[place[is_own]] = items[turn[is_own]]
    return Cuts(axis, cut, spread, cost, sorted_items)


def split_costs(objects: Objects, items: Integers, is_own: Flags) -> Floats:
    """Return the costs (M, W - 1) of cutting rows of ``items`` (M, W) behind the first, the second, ... of their own.

    Infinite where a row has no object behind the cut.
    """
    number, count = np.arange(1, items.shape[1]), is_own.sum(axis=1)[:, None]
    lower, upper = [], []
    for k in range(3):
        lower.append(np.where(is_own, objects.lower[:, k].take(items), np.inf))
        upper.append(np.where(is_own, objects.upper[:, k].take(items), -np.inf))
    below = half_area(
        *(np.minimum.accumulate(values, axis=1) for values in lower),
        *(np.maximum.accumulate(values, axis=1) for values in upper),
    )[:, :-1]
    above = half_area(
        *(np.minimum.accumulate(values[:, ::-1], axis=1) for values in lower),
        *(np.maximum.accumulate(values[:, ::-1], axis=1) for values in upper),
    )[:, -2::-1]
    with np.errstate(over="ignore", invalid="ignore"):
        return np.where(number < count, below * number + above * (count - number), np.inf)


def half_area(x: Floats, y: Floats, z: Floats, u: Floats, v: Floats, w: Floats) -> Floats:
    """Return half the surface (M, W) of boxes from corners x, y, z to u, v, w, (M, W) each."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray((u - x) * (v - y) + (v - y) * (w - z) + (w - z) * (u - x))


SPLITS = {"bvh": median_split, "bvh-area": area_split}


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
        return build_levels(objects, leaf_size, median_split).tree
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
    return build_levels(objects, leaf_size, median_split).tree


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
    return build_levels(objects, leaf_size, area_split).tree
