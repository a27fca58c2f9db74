"""What rows of the raster stage are: pixels and spans of fills, pixels of lines; and how often pixels are covered."""

import numpy as np

from core.records.arrays import Integers
from core.records.listing import RETURN
from core.records.operation import Labels, Operation
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack


def _crossing_label(rise: str, k: int) -> Labels:
    """Return the line that edge ``k`` comes to: its crossing, or the test of a level edge, whose ``rise`` is 0."""
    return lambda columns, rows: np.where(columns[rise][rows, k] == 0, "level", "crossing")


def _tested(label: str) -> tuple[Operation, ...]:
    """Return what a pixel's test does; ``label`` is the line that gives each edge function its value."""
    return (
        *(Operation(f"edge-{k}", label, {f"value_{k}": "value"}) for k in range(3)),
        Operation("decide", "covered", {"covered": RETURN}, ("tie",)),
    )


def _printed(*first: Operation) -> tuple[Operation, ...]:
    """Return what a row of the printed scanline does: both sides, then their columns."""
    return (*first, Operation("round", "round", ("start", "stop")))


_ENDS = {"crossing_0": "x1", "crossing_1": "x2"}
_FIRST = _printed(
    *(Operation(f"slope-{k}", f"slope{k + 1}", {f"slope_{k}": f"slope{k + 1}"}) for k in range(2)),
    Operation("ends", "first", _ENDS),
)
_NEXT = _printed(*(Operation(f"next-{k}", f"next{k + 1}", {f"crossing_{k}": f"x{k + 1}"}) for k in range(2)))
FILL_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "test": _tested("value"),
    "accept": (Operation("accept", "draw", {"covered": "pixels"}),),
    "span": (
        *(Operation(f"edge-{k}", _crossing_label("a", k), {f"crossing_{k}": "crossing"}) for k in range(3)),
        Operation("span", "span", ("start", "stop")),
    ),
    "top-first": _FIRST,
    "top": _NEXT,
    "bottom-first": _FIRST,
    "bottom": _NEXT,
    "lane": (
        Operation("first", "first", {"first_row": "first"}),
        Operation("rows", "count", {"row_count": "count"}),
        Operation("lane", "place", {"lane": "before"}),
    ),
    "lane-row": (
        *(
            Operation(
                f"edge-{k}", _crossing_label("dy", k), {f"quotient_{k}": "crossing"}, (f"numerator_{k}",)
            )
            for k in range(3)
        ),
        Operation("start", "start", ("start",), ("left",)),
        Operation("stop", "stop", ("stop",), ("right",)),
        Operation("place", "place", {"place": "before"}, ("length",)),
    ),
    "pass": (
        Operation("pass", "pass", {"pass_number": "k"}, ("pass_size",)),
        Operation("draw", "draw", {"rank": "drawn", "covered": "drawn"}),
    ),
    "climb": _tested("add"),
    "step": _tested("add"),
}
"""Kind of row of a fill to what it does."""
PRINTED = ("top-first", "top", "bottom-first", "bottom")
"""Rows of the printed scanline: of the part above a level side and the part below, the first row and the others."""


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
