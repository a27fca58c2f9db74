"""What rows of the raster stage are: pixels and spans of fills, pixels of lines; and how often pixels are covered."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Integers
from core.records.operation import Columns, Labels, Operation
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack


def _side_label(k: int) -> Labels:
    """Return the line of `span` that edge ``k`` is looked at in: the loop of its side, or the test of a level edge."""

    def label(columns: Columns, rows: Any) -> NDArray[np.str_]:
        a = columns["a"][rows, k]
        return np.select([a > 0, a < 0], ["left", "right"], "parallel")

    return label


def _crossing_label(k: int) -> Labels:
    """Return the line of `span_of_row` that edge ``k`` comes to: its crossing, or nothing where it is level."""
    return lambda columns, rows: np.where(columns["dy"][rows, k] == 0, "level", "crossing")


_ADDITIONS = (
    Operation("edge-0", "add", ("value_0",)),
    Operation("edge-1", "add", ("value_1",)),
    Operation("edge-2", "add", ("value_2",)),
    Operation("decide", "covered", ("covered", "tie")),
)
FILL_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "test": (
        Operation("edge-0", "value", ("value_0",)),
        Operation("edge-1", "value", ("value_1",)),
        Operation("edge-2", "value", ("value_2",)),
        Operation("decide", "covered", ("covered", "tie")),
    ),
    "accept": (Operation("accept", "", ("covered",)),),
    "span": (
        *(Operation(f"edge-{k}", _side_label(k), (f"crossing_{k}",)) for k in range(3)),
        Operation("span", "span", ("start", "stop")),
    ),
    "line": (
        Operation("ends", "draw", ("crossing_0", "crossing_1")),
        Operation("round", "draw", ("start", "stop")),
    ),
    "lane": (Operation("rows", "count", ("first_row", "row_count")), Operation("lane", "place", ("lane",))),
    "lane-row": (
        *(Operation(f"edge-{k}", _crossing_label(k), (f"numerator_{k}", f"quotient_{k}")) for k in range(3)),
        Operation("start", "start", ("left", "start")),
        Operation("stop", "stop", ("right", "stop")),
        Operation("place", "place", ("length", "place")),
    ),
    "pass": (
        Operation("pass", "pass", ("pass_number", "pass_size")),
        Operation("draw", "draw", ("rank", "covered")),
    ),
    "climb": _ADDITIONS,
    "step": _ADDITIONS,
}
"""Kind of row of a fill to what it does."""


def overdraw_track(source: TraceSource, rows: Integers) -> BufferTrack:
    """Return how often each pixel was covered in depth range; ``rows`` (F,) are those of the fragments."""
    keeps = source.depths[1]
    rows, place = rows[keeps], source.place[keeps]
    count = source.start.cover_count.ravel()[place] + 1 + occurrence(place)
    return BufferTrack("overdraw", source.start.cover_count, rows, place, count, "count", True)


def occurrence(place: Integers) -> Integers:
    """Return how many earlier elements name the same place: (K,) to (K,)."""
    order = np.argsort(place, kind="stable")
    ordered = place[order]
    first = np.maximum.accumulate(np.where(np.diff(ordered, prepend=-1) != 0, np.arange(len(place)), 0))
    result = np.empty(len(place), np.int64)
    result[order] = np.arange(len(place)) - first
    return result
