"""Rows of a tree that is built: one for every node, with what is computed to cut it."""

from dataclasses import dataclass

import numpy as np

from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.box_tree import BoxTree, Objects
from core.records.listing import listing
from core.settings import Settings
from core.stages.object_tree import ObjectTree
from core.trace.stage_trace import InsertedRows
from core.trees.bounding_volumes import area_split, median_split
from core.trees.octree import octants_of

SHOWN_ITEMS = 6
"""Objects of a sorted node that a row names."""


@dataclass(frozen=True, eq=False)
class Cuts:
    """How every node of a tree was cut; leaves have NaN, -1 and no text."""

    spread: Floats
    """(N, 3) float64, see `core.trees.bounding_volumes.Split`."""
    axis: Integers
    """(N,) int64."""
    cut: Integers
    """(N,) int64."""
    cost: Floats
    """(N,) float64."""
    sorted_items: list[str]
    """The first objects of each, sorted."""


def cuts_of(objects: Objects, tree: BoxTree, hierarchy: str) -> Cuts:
    """Cut the nodes of a bounding volume hierarchy once more, from the top, to see how."""
    split = area_split if hierarchy == "bvh-area" else median_split
    count = len(tree)
    spread, cost = np.full((count, 3), np.nan), np.full(count, np.nan)
    found = Cuts(spread, np.full(count, -1), np.full(count, -1), cost, [""] * count)
    items = {0: np.arange(len(objects))}
    for node in range(count):
        own = items.pop(node)
        if tree.is_leaf[node]:
            continue
        parts = split(objects, own)
        found.spread[node], found.axis[node], found.cut[node] = parts.spread, parts.axis, parts.cut
        found.cost[node] = parts.cost
        names = [str(item) for item in parts.items[:SHOWN_ITEMS].tolist()]
        found.sorted_items[node] = ", ".join(names) + (", …" if len(own) > SHOWN_ITEMS else "")
        below, above = tree.children(node)
        items[below], items[above] = parts.items[: parts.cut], parts.items[parts.cut :]
    return found


def building_rows(grown: ObjectTree, settings: Settings) -> InsertedRows:
    """Return one row for every node, in pre-order, which is the order in which they are made."""
    tree, method = grown.tree, table.get("hierarchy", settings.hierarchy)
    kinds = tuple(method.operations)
    count, is_leaf = len(tree), tree.is_leaf
    leaf = next(k for k, kind in enumerate(kinds) if kind.endswith("leaf"))
    columns = {
        "node": np.arange(count),
        "node_depth": tree.depth,
        "node_lower": tree.lower,
        "node_upper": tree.upper,
        "object_count": tree.object_count,
        "leaf_size": np.full(count, settings.leaf_size),
        "octree_depth": np.full(count, settings.octree_depth),
    }
    if method.name == "octree":
        columns |= _cells(tree)
    elif method.name != "none":
        cuts = cuts_of(grown.objects, tree, method.name)
        columns |= {"spread": cuts.spread, "axis": cuts.axis, "cut": cuts.cut, "cost": cuts.cost}
        columns["sorted_items"] = np.array(cuts.sorted_items, str)
    assert method.listing is not None
    return InsertedRows(
        before=np.zeros(count, np.int64),
        group=np.full(count, -1),
        triangle=np.full(count, -1),
        kinds=kinds,
        kind=np.where(is_leaf, leaf, 1 - leaf),
        operations=method.operations,
        columns=columns,
        listings=dict.fromkeys(kinds, listing(method.listing)),
    )


def _cells(tree: BoxTree) -> dict[str, np.ndarray]:
    """Return the middle of every cell and the objects of its octants, as columns; NaN and -1 of a leaf."""
    middle, counts = np.full((len(tree), 3), np.nan), np.full((len(tree), 8), -1)
    for node in np.flatnonzero(~tree.is_leaf).tolist():
        middle[node] = octants_of(tree.lower[node], tree.upper[node])[0]
        counts[node] = tree.object_count[tree.children(node)]
    return {"middle": middle, "octant_counts": counts}
