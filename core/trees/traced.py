"""Rows of a tree that is built: one for every node, with what is computed to cut it."""

import numpy as np

from core.methods import table
from core.records.arrays import Integers
from core.records.box_tree import BoxTree
from core.records.listing import listing
from core.settings import Settings
from core.stages.object_tree import ObjectTree
from core.trace.stage_trace import InsertedRows
from core.trees.bounding_volumes import SPLITS
from core.trees.levels import SHOWN_ITEMS, build_levels
from core.trees.octree import octants_of


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
        built = build_levels(grown.objects, settings.leaf_size, SPLITS[method.name])
        columns |= {"spread": built.spread, "axis": built.axis, "cut": built.cut, "cost": built.cost}
        columns["sorted_items"] = _named(built.first_items, tree.object_count)
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


def _named(items: Integers, count: Integers) -> np.ndarray:
    """Return the first objects (N, `SHOWN_ITEMS`) of nodes that were cut, as texts (N,); ``count`` (N,) of them all."""
    named = [", ".join(str(item) for item in own if item >= 0) for own in items.tolist()]
    more = (count > SHOWN_ITEMS).tolist()
    return np.array(
        [f"{text}, …" if text and of_more else text for text, of_more in zip(named, more, strict=True)], str
    )


def _cells(tree: BoxTree) -> dict[str, np.ndarray]:
    """Return the middle of every cell and the objects of its octants, as columns; NaN and -1 of a leaf."""
    middle, counts = np.full((len(tree), 3), np.nan), np.full((len(tree), 8), -1)
    for node in np.flatnonzero(~tree.is_leaf).tolist():
        middle[node] = octants_of(tree.lower[node], tree.upper[node])[0]
        counts[node] = tree.object_count[tree.children(node)]
    return {"middle": middle, "octant_counts": counts}
