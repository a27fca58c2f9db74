"""Trace of lists of hits: each hit is appended to its pixel's list, then the list stands sorted, from its front."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.traced_rows import occurrence
from core.depth.depth import depth_in_range
from core.depth.traced import DISCARDED, value_columns, value_constants, value_listings, value_operations
from core.records.arrays import Flags, Integers
from core.records.listing import RETURN, Operation, listing
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace
from core.visibility.hit_lists import HitLists, list_hits

LIST_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "hit": (
        Operation("depth", "", (), ("depth", "stored")),
        Operation("append", "append", {"length": "hit_list"}, ("before",)),
    ),
    "hit-beyond": (
        Operation("depth", "", (), ("depth", "stored")),
        Operation("beyond", "beyond", (), ("before",)),
    ),
    "list-front": (
        Operation("sort", "sort", {"place": "hit_list"}, ("stored", "length")),
        Operation("resolve", "resolve", {"passes": RETURN}),
    ),
    "list-next": (
        Operation("sort", "sort", {"place": "hit_list"}, ("stored", "in_front", "front_depth")),
        Operation("resolve", "resolve", {"passes": RETURN}),
    ),
    "out-of-range": (Operation("range", "range", {"passes": RETURN}, ("depth",)),),
    **DISCARDED,
}
"""Kind of row to what it does: a hit that is appended or not; the front of a sorted list, and each hit behind it."""
KINDS = tuple(LIST_OPERATIONS)


def trace_lists(source: TraceSource, lists: HitLists) -> StageTrace:
    """Return a row for every hit in drawing order, then one for each that is in a list, from the front of each list.

    ``lists`` has the hits (F,) in depth range. The rows of a pixel keep this order where they are put together.
    """
    fragments, (depth, keeps, stored) = source.fragments, source.depths
    kept = np.flatnonzero(keeps)
    hit_count, sorted_hits = len(fragments), kept[lists.listed]
    place, in_front = (np.full(hit_count, -1) for _ in range(2))
    place[kept] = lists.place
    in_front[kept] = np.where(lists.in_front >= 0, kept.take(lists.in_front), -1) if len(kept) else kept
    is_listed = place >= 0
    is_seen = source.depth_tests.passes

    # Rows: all fragments, then those in lists once more.
    which = np.concatenate([np.arange(hit_count), sorted_hits])
    is_sorted = np.arange(len(which)) >= hit_count
    kind = _kinds(source, which, is_sorted, is_listed, place)
    ahead = in_front[which]
    length = np.where(is_sorted, 0, 1 + _earlier(source.place, is_listed)[which])
    length[is_sorted] = lists.length[lists.listed]
    columns: dict[str, NDArray[Any]] = {
        "column": fragments.column[which],
        "row": fragments.row[which],
        "depth": depth[which],
        "inverse_w": source.inverse_w[which],
        "stored": stored[which],
        "before": source.start.depth.ravel()[source.place[which]],
        "length": np.where(is_listed[which], length, -1),
        "place": np.where(is_sorted, place[which] + 1, -1),
        "passes": is_seen[which],
        "is_stored": is_sorted & np.isin(which, _stored_ones(source, sorted_hits)),
        "in_front": np.where(ahead >= 0, source.triangle_of_fragment.take(ahead), -1) if hit_count else ahead,
        "front_depth": np.where(ahead >= 0, stored.take(ahead), np.nan) if hit_count else stored[which],
        "primitive": fragments.primitive[which],
    }
    columns |= {name: values[which] for name, values in value_columns(source).items()}
    columns["after"] = np.where(columns["is_stored"], columns["stored"], columns["before"])
    triangle, at = source.triangle_of_fragment[which], source.place[which]
    appended, written = np.flatnonzero(~is_sorted & is_listed[which]), np.flatnonzero(columns["is_stored"])
    decided = np.flatnonzero(is_sorted | ~is_listed[which])
    unknown = np.full(source.raster.shape, np.nan)
    made = value_operations(source)
    operations = {
        name: (*made, *rows[1:]) if made and name in ("hit", "hit-beyond") else rows
        for name, rows in LIST_OPERATIONS.items()
    }
    values = {name.partition(".")[2]: of for name, of in value_listings(source).items()}
    return StageTrace(
        stage="depth",
        method=f"visibility={source.settings.visibility}",
        steps=Steps(KINDS, kind, operations, ends_of(triangle), ends_of(triangle)),
        columns=columns,
        triangle=triangle,
        pixel=np.stack([columns["column"], columns["row"]], axis=1),
        listings=dict.fromkeys(KINDS[:4], listing(list_hits))
        | {f"{name}.{part}": of for name in ("hit", "hit-beyond") for part, of in values.items()}
        | {"out-of-range": listing(depth_in_range)},
        constants={
            **value_constants(source),
            "shows_through": lists.is_mixed,
            "larger_is_nearer": source.depth_format.larger_is_nearer,
        },
        marks={
            "covered": is_sorted & columns["passes"],
            "depth-failed": (is_sorted & ~columns["passes"]) | (~is_sorted & ~is_listed[which]),
            "tie": is_sorted & (columns["stored"] == columns["front_depth"]),
            "nan": ~is_sorted & np.isnan(columns["depth"]),
        },
        buffers=(
            BufferTrack(
                "hits listed",
                unknown,
                appended,
                at[appended],
                columns["length"][appended].astype(float),
                "count",
            ),
            BufferTrack(
                "primitive", source.start.primitive, written, at[written], triangle[written], "ids", True
            ),
            BufferTrack(
                "depth",
                source.start.depth,
                written,
                at[written],
                columns["stored"][written],
                starts_known=True,
            ),
            BufferTrack(
                "passes", unknown, decided, at[decided], columns["passes"][decided].astype(float), "flags"
            ),
        ),
    )


def _kinds(
    source: TraceSource, which: Integers, is_sorted: Flags, is_listed: Flags, place: Integers
) -> Integers:
    """Return (R,) int64, the kind of each row."""
    named = {name: number for number, name in enumerate(KINDS)}
    _, keeps, _ = source.depths
    lost = np.where(source.goes_on, named["out-of-range"], named["discarded"])
    hits = np.where(is_listed, named["hit"], np.where(keeps, named["hit-beyond"], lost))
    fronts = np.where(place == 0, named["list-front"], named["list-next"])
    return np.where(is_sorted, fronts[which], hits[which])


def _earlier(place: Integers, is_listed: Flags) -> Integers:
    """Return how many hits (F,) were appended to the list of each fragment's pixel before it."""
    found = np.zeros(len(place), np.int64)
    found[is_listed] = occurrence(place[is_listed])
    return found


def _stored_ones(source: TraceSource, sorted_hits: Integers) -> Integers:
    """Return of each list the hit nearest to its front whose depth is stored: that of a line's pale pixels is not."""
    if source.writes_depth is not None:
        sorted_hits = sorted_hits[source.writes_depth[sorted_hits]]
    _, first = np.unique(source.place[sorted_hits], return_index=True)
    return sorted_hits[first]
