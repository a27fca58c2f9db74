"""Rows of the order in which triangles are drawn, before the first pixel: the painter's sort, and the BSP tree.

They are rows of the stage Depth, where it is decided who is seen, and about no pixel. Of a trace of one triangle, they
are those about this triangle.
"""

from bisect import bisect_right, insort
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats, Integers, cached_property
from core.records.listing import RETURN, Listing, Operation, listing
from core.stages.fragment_color import vertex_stage
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, StageTrace, insert_rows
from core.visibility import bsp
from core.visibility.newell import PairTests, examine_pairs
from core.visibility.painters import far_to_near, sums_of_depths

MOST_SWAPS = 2_000
"""Swaps of a sort that have rows of their own; of more, each triangle has its place and their number."""
MOST_ROWS = 50_000
"""Tests of a tree that have rows; of more, only those that cut."""

SORT_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "distance": (
        Operation("sum", "distance", {"distance": "distance"}, ("depths",)),
        Operation("append", "append", {"place": "place"}),
    ),
    "swap": (
        Operation("farther", "farther", (), ("other", "other_distance")),
        Operation("swap", "swap", ("place",)),
    ),
    "place": (Operation("place", "farther", (), ("other", "other_distance", "swaps")),),
}
"""Kind of row to what it does: the depth of a triangle, one swap with the triangle before it, its place for now."""
_TEST = (Operation("distances", "distance", {"distances": RETURN}),)
TREE_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "flat": (Operation("first", "plane", {"plane": "c d"}, ("place",)),),
    "root": (Operation("plane", "plane", {"plane": "c d"}, ("tested", "cuts")),),
    **{side: (*_TEST, Operation("side", side, {"side": RETURN})) for side in ("on", "front", "back")},
    "cut": (
        *_TEST,
        Operation("side", "cut", {"side": RETURN}),
        Operation("share", "t", {"cut_t": "t"}),
        Operation("corner", "corner", ("corner",), ("made_front", "made_back")),
    ),
    "walk": (
        Operation("eye", "eye", {"eye": "distance"}),
        Operation("drawn", "side", {"eye_side": RETURN}, ("place",)),
    ),
}
"""Kind of row to what it does: a node, a piece against its plane, and a node that is drawn."""
SIDES = ("on", "front", "back", "cut")
"""Names of ``core.visibility.bsp.ON`` and those after it, which are kinds of rows."""
Columns = dict[str, NDArray[Any]]


def with_sort(found: StageTrace, source: TraceSource) -> StageTrace:
    """Return the trace of the depth test with the rows of the painter's sort before it."""
    clip, listings = corners_of(source), dict.fromkeys(SORT_OPERATIONS, listing(far_to_near))
    rows = sort_columns(clip, source.triangle)
    return _with_order(found, source, SORT_OPERATIONS, rows, listings, {"sorted": SortedTriangles(clip)})


def with_tree(found: StageTrace, source: TraceSource) -> StageTrace:
    """Return the trace of the depth test with the rows of a BSP tree before it."""
    tree = bsp.build_tree(corners_of(source))
    rows = _joined(list(_tree_rows(tree, source.triangle)), _TREE_COLUMNS)
    return _with_order(found, source, TREE_OPERATIONS, rows, tree_listings(), {"tree": tree})


def _with_order(
    found: StageTrace,
    source: TraceSource,
    operations: Mapping[str, tuple[Operation, ...]],
    rows: Columns,
    listings: Mapping[str, Listing],
    extra: dict[str, Any],
) -> StageTrace:
    kind, triangle, group = rows.pop("kind"), rows.pop("triangle"), rows.pop("group")
    if not len(kind):
        return found
    before = replace(found, method=f"visibility={source.settings.visibility}", extra={**found.extra, **extra})
    return put_before(before, operations, kind, triangle, group, rows, listings)


def put_before(
    found: StageTrace,
    operations: Mapping[str, tuple[Operation, ...]],
    kind: Integers,
    triangle: Integers,
    group: Integers,
    rows: Columns,
    listings: Mapping[str, Listing],
) -> StageTrace:
    """Return a trace with N rows about no pixel before its own.

    Parameters
    ----------
    kind : (N,) int64
        Index of the kinds of ``operations``.
    group : (N,) int64
        What is one step of the levels TRIANGLE and GROUP.
    """
    count, steps = len(kind), found.steps
    ends = np.flatnonzero(np.diff(group, append=group[-1] + 1)) + 1

    def after(there: Integers) -> Integers:
        return np.concatenate([ends, there[there > 0] + count])

    first = np.zeros(count, np.int64)
    inserted = InsertedRows(first, group, triangle, tuple(operations), kind, operations, rows, listings)
    made = insert_rows(found, np.zeros(steps.row_count, np.int64), inserted)
    # The rows that are there keep their own steps.
    made_steps = replace(
        made.steps, triangle_ends=after(steps.triangle_ends), group_ends=after(steps.group_ends)
    )
    columns = {name: made.columns[name] for name in {**rows, **found.columns}}
    return replace(made, steps=made_steps, columns=columns)


def _joined(rows: list[dict[str, Any]], empty: dict[str, Any]) -> Columns:
    """Return columns of rows; what a row does not have is that of ``empty``."""
    return {
        name: np.array(
            [row.get(name, missing) for row in rows], "U5" if missing == "" else np.asarray(missing).dtype
        )
        for name, missing in empty.items()
    }


# The painter's sort: every triangle goes in at its place among those before it.


@dataclass(frozen=True, eq=False)
class SortedTriangles:
    """T triangles that are drawn from far to near, for the tables beside the sort."""

    clip: Floats
    """(T, 3, 4) float64, clip space."""

    @cached_property
    def distance(self) -> Floats:
        """(T,) float64, sums of the corners' depths."""
        return sums_of_depths(self.clip)[1]

    @cached_property
    def pairs(self) -> list[PairTests]:
        """Newell's tests of all pairs, in the order of drawing."""
        return examine_pairs(self.clip, np.argsort(-self.distance, kind="stable").tolist())


def sort_columns(clip: Floats, chosen: int | None = None) -> Columns:
    """Return the rows of the sort of triangles (T, 3, 4); with ``chosen``, only those about one triangle.

    They are the sum of a triangle's depths, its swaps, and its place among those so far.
    """
    depths, distance = sums_of_depths(clip)
    order: list[int] = []
    rows: list[dict[str, Any]] = []
    swaps = _swaps(distance)
    for number, (own, summed) in enumerate(zip(depths.tolist(), distance.tolist(), strict=True)):
        place, end = len(order), len(order) - int(swaps[number])
        if chosen not in (None, number):
            order.insert(end, number)
            continue
        of = {"triangle": number, "group": number, "depths": own, "distance": summed}
        rows.append(of | {"kind": 0, "place": place})
        for other in order[end:][::-1] if swaps.sum() <= MOST_SWAPS else ():
            place -= 1
            rows.append(of | {"kind": 1, "place": place, "other": other, "other_distance": distance[other]})
        last = {"other": order[end - 1], "other_distance": distance[order[end - 1]]} if end else {}
        rows.append(of | {"kind": 2, "place": end, "swaps": int(swaps[number])} | last)
        order.insert(end, number)
    return _joined(
        rows,
        {
            **dict.fromkeys(("kind", "triangle", "group", "place", "other", "swaps"), -1),
            "depths": [np.nan] * 3,
            "distance": np.nan,
            "other_distance": np.nan,
            "by_z": bool(len(clip) and np.ptp(clip[..., 3]) == 0),
        },
    )


def _swaps(distance: Floats) -> Integers:
    """Return how many of the triangles before each (T,) are nearer: it goes in before them."""
    so_far: list[float] = []
    found = []
    for value in (-distance).tolist():
        found.append(len(so_far) - bisect_right(so_far, value))
        insort(so_far, value)
    return np.array(found, np.int64)


def corners_of(source: TraceSource) -> Floats:
    """Return the corners (T, 3, 4) of all triangles of the scene in clip space."""
    vertices = vertex_stage(source.scene)
    return vertices.clip_rows.take(vertices.corner_rows, axis=1).T


# The tree: its nodes with all tests, then the walk.


_TREE_COLUMNS: dict[str, Any] = {
    **dict.fromkeys(
        ("kind", "triangle", "group", "node", "parent", "half", "piece", "piece_number", "place"), -1
    ),
    **dict.fromkeys(
        ("root_triangle", "root_number", "tested", "cuts", "made_front", "made_back", "held"), -1
    ),
    "plane": [np.nan] * 4,
    "clip": [[np.nan] * 4] * 3,
    "distances": [np.nan] * 3,
    "side": "",
    "cut_t": np.nan,
    "corner": [np.nan] * 4,
    "eye": np.nan,
    "eye_side": "",
}


def _tree_rows(tree: bsp.BspTree, chosen: int | None) -> Iterator[dict[str, Any]]:
    names = list(TREE_OPERATIONS)
    is_own = np.ones(len(tree.triangle), bool) if chosen is None else tree.triangle == chosen
    shown = np.flatnonzero(is_own[tree.tested])
    if len(shown) > MOST_ROWS:
        shown = shown[tree.side[shown] == bsp.CUT]
    d = bsp.distances(tree.clip[tree.tested[shown]], tree.plane[tree.tested_at[shown]])
    for place, triangle in enumerate(tree.flat.tolist()):
        if not is_own[triangle]:
            continue
        plane = bsp.plane_of(*tree.clip[triangle].tolist())
        flat = {"kind": names.index("flat"), "group": triangle, "place": place, "plane": plane}
        yield _of_piece(tree, triangle) | flat

    # The nodes, every one with what is tested against its plane.
    group = len(tree.clip)
    tested = np.bincount(tree.tested_at, minlength=len(tree.root))
    cuts = np.bincount(tree.tested_at[tree.side == bsp.CUT], minlength=len(tree.root))
    ends = np.searchsorted(tree.tested_at[shown], np.arange(len(tree.root) + 1))
    of_node = {}
    for node in np.flatnonzero(is_own[tree.root] | (np.diff(ends) > 0)).tolist():
        root = int(tree.root[node])
        of_node[node] = _of_node(tree, node)
        if is_own[root]:
            yield (
                of_node[node]
                | _of_piece(tree, root)
                | {
                    "kind": names.index("root"),
                    "group": group + node,
                    "tested": tested[node],
                    "cuts": cuts[node],
                }
            )
        for place in range(ends[node], ends[node + 1]):
            row = int(shown[place])
            side = SIDES[int(tree.side[row])]
            piece = int(tree.tested[row])
            found = of_node[node] | _of_piece(tree, piece)
            found |= {"kind": names.index(side), "group": group + node, "distances": d[place], "side": side}
            if side == "cut":
                found |= dict(zip(("made_front", "made_back"), tree.made[row].tolist(), strict=True))
                found |= _first_corner(tree.clip[piece], d[place].tolist())
            yield found

    # The walk: the half without the eye, the node, the half with it.
    first_drawn = np.full(len(tree.root), len(tree.drawn))
    in_tree = np.flatnonzero(tree.node[tree.drawn] >= 0)
    np.minimum.at(first_drawn, tree.node[tree.drawn[in_tree]], in_tree)
    held = np.bincount(tree.node[tree.node >= 0], minlength=len(tree.root))
    for place, node in enumerate(tree.walk.tolist()):
        root = int(tree.root[node])
        if not is_own[root]:
            continue
        yield (
            of_node[node]
            | _of_piece(tree, root)
            | {
                "kind": names.index("walk"),
                "group": group + len(tree.root) + place,
                "eye": -tree.plane[node, 2],
                "eye_side": bsp.eye_side(tree.plane[node].tolist()),
                "place": first_drawn[node],
                "held": held[node],
            }
        )


def _of_node(tree: bsp.BspTree, node: int) -> dict[str, Any]:
    """Return what all rows of a node have."""
    root, parent = int(tree.root[node]), int(tree.parent[node])
    return {
        "node": node,
        "parent": parent,
        "half": tree.halves[parent].tolist().index(node) if parent >= 0 else -1,
        "root_triangle": tree.triangle[root],
        "root_number": tree.number[root],
        "plane": tree.plane[node],
    }


def _of_piece(tree: bsp.BspTree, piece: int) -> dict[str, Any]:
    """Return what all rows about a piece have."""
    return {
        "triangle": tree.triangle[piece],
        "piece": piece,
        "piece_number": tree.number[piece],
        "clip": tree.clip[piece],
    }


def _first_corner(corners: Floats, d: list[float]) -> dict[str, Any]:
    """Return the first new corner of a cut and its t, from the end before the plane."""
    k = next(k for k in range(3) if min(d[k], d[k - 2]) < 0 < max(d[k], d[k - 2]))
    here, there = (k, k - 2) if d[k] > 0 else (k - 2, k)
    t = d[here] / (d[here] - d[there])
    return {"cut_t": t, "corner": corners[here] + t * (corners[there] - corners[here])}


def tree_listings() -> dict[str, Listing]:
    """Return the listings of the rows of a tree, by kind and operation."""
    found = {"flat": listing(bsp.plane_of), "root": listing(bsp.plane_of), "walk": listing(bsp.eye_side)}
    for side in SIDES:
        found |= {f"{side}.distances": listing(bsp.distance_of), f"{side}.side": listing(bsp.side_of)}
    return found | {f"cut.{name}": listing(bsp.cut_piece) for name in ("share", "corner")}
