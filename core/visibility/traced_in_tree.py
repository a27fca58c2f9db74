"""Trace of rays in a tree: of every ray the boxes that it asks, slab by slab, and the hits in the leaves it opens."""

from dataclasses import replace

import numpy as np

from core.records.arrays import Integers
from core.records.listing import Operation, listing
from core.trace.row_order import in_rows
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, StageTrace, insert_rows
from core.visibility.rays_in_tree import BEHIND, MISSED, OPENED, TreeWalk, Visits, meet_box, slabs, walk_tree

_SLABS = tuple(
    Operation(
        f"slab-{axis}",
        "enter",
        {f"enter_{axis}": "enter"},
        (*(("node", "m", "n") if axis == "x" else ()), f"near_{axis}", f"far_{axis}", f"leave_{axis}"),
    )
    for axis in "xyz"
)
BOX_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "tree-missed": (
        *_SLABS,
        Operation("miss", "missed", (), ("object_count",)),
        Operation("jump", "jump", {"next_node": "node"}),
    ),
    "tree-behind": (
        *_SLABS,
        Operation("meet", "missed"),
        Operation("behind", "behind", (), ("nearest_nearness", "most_nearness", "object_count")),
        Operation("jump", "skip", {"next_node": "node"}),
    ),
    "tree-node": (
        *_SLABS,
        Operation("meet", "missed"),
        Operation("open", "behind", (), ("object_count",)),
        Operation("next", "next", {"next_node": "node"}),
    ),
    "tree-leaf": (*_SLABS, Operation("meet", "missed"), Operation("leaf", "leaf", (), ("object_count",))),
}
"""Kind of row to what it does: a box that a ray misses, one behind its nearest hit, one that it opens, and a leaf."""
HIDDEN: dict[str, tuple[Operation, ...]] = {"tree-hidden": (Operation("hide", "", (), ("node", "nearest")),)}
"""What is said of a triangle that covers a pixel, and that the ray does not ask."""


def with_boxes(source: TraceSource, found: StageTrace, walk: TreeWalk) -> StageTrace:
    """Return the rows of hits in the order in which rays ask them, with one before them for each box."""
    assert walk.visits is not None
    _, keeps, _ = source.depths
    count = found.steps.row_count
    time, rank, hidden = np.full(count, -1), np.zeros(count, np.int64), np.full(count, -1)
    time[keeps], rank[keeps], hidden[keeps] = walk.time, walk.rank, walk.hidden_in
    last = np.where(time < 0, np.iinfo(np.int64).max, time)
    rows = np.lexsort((rank, last))
    is_hidden = keeps & (time < 0)
    kinds = (*found.steps.kinds, *HIDDEN)
    steps = replace(
        found.steps,
        kinds=kinds,
        kind=np.where(is_hidden, len(kinds) - 1, found.steps.kind),
        operations={**found.steps.operations, **HIDDEN},
    )
    hits = replace(found, steps=steps, columns={**found.columns, "node": hidden})
    hits = in_rows(hits, rows, found.triangle, found.triangle)
    boxes = _box_rows(source, walk, walk.visits, last[rows])
    return insert_rows(hits, np.zeros(count, np.int64), boxes)


def _box_rows(source: TraceSource, walk: TreeWalk, visits: Visits, times: Integers) -> InsertedRows:
    """Return one row for each visit of a box; ``times`` (R,) are those of the rows of hits, rising."""
    rays, tree = walk.rays, walk.rays.tree
    order = np.argsort(visits.time, kind="stable")
    ray, node, verdict, time, nearest = (
        values[order] for values in (visits.ray, visits.node, visits.verdict, visits.time, visits.nearest)
    )
    origin, direction = (values.take(ray, axis=1) for values in rays.rays(walk.x, walk.y))
    near, far = slabs(origin, direction, rays.lower[node].T, rays.upper[node].T)
    enter = np.maximum.accumulate(np.vstack([np.full(len(ray), rays.least), near]))[1:]
    leave = np.minimum.accumulate(far)
    row, column = np.divmod(walk.pixel[ray], source.raster.shape[1])
    first_column, first_row, _, _ = source.raster.bounds
    planes = source.geometry.ray_planes
    m, n = walk.x[ray] * planes.size[0], walk.y[ray] * planes.size[1]
    value, _ = planes.values(np.maximum(nearest, 0), m, n)
    kinds = tuple(BOX_OPERATIONS)
    is_leaf = tree.is_leaf[node]
    kind = np.where(verdict == MISSED, 0, np.where(verdict == BEHIND, 1, np.where(is_leaf, 3, 2)))
    columns = {
        "column": column + first_column,
        "row": row + first_row,
        "node": node,
        "m": m,
        "n": n,
        "node_lower": rays.lower[node],
        "node_upper": rays.upper[node],
        "ray_origin": origin.T,
        "ray_direction": direction.T,
        "node_depth": tree.depth[node],
        "node_count": np.full(len(ray), len(tree)),
        "is_box": np.ones(len(ray), bool),
        "is_opened": verdict == OPENED,
        "object_count": tree.object_count[node],
        "nearest": nearest,
        "nearest_nearness": np.where(nearest < 0, np.nan, value),
        "most_nearness": rays.nearness(enter[2], node),
        "next_node": np.where((verdict == MISSED) | (verdict == BEHIND), tree.subtree_end[node], node + 1),
    }
    for k, axis in enumerate("xyz"):
        columns |= {f"near_{axis}": near[k], f"far_{axis}": far[k]}
        columns |= {f"enter_{axis}": enter[k], f"leave_{axis}": leave[k]}
    slab_listing, walk_listing = listing(meet_box), listing(walk_tree)
    slab_names = [f"{kind}.{slab.name}" for kind in kinds for slab in _SLABS]
    return InsertedRows(
        before=np.searchsorted(times, time, "left"),
        group=np.zeros(len(ray), np.int64),
        triangle=np.full(len(ray), -1),
        kinds=kinds,
        kind=kind,
        operations=BOX_OPERATIONS,
        columns=columns,
        listings=dict.fromkeys(kinds, walk_listing) | dict.fromkeys(slab_names, slab_listing),
        pixel=np.stack([columns["column"], columns["row"]], axis=1),
    )
