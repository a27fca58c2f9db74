"""What rows of the raster stage are, before their numbers: what each is about, in drawing order, and what is right."""

from dataclasses import dataclass

import numpy as np

from core.coverage.binning import bound
from core.coverage.pixel_runs import EVALUATED, SideWalk
from core.lines.line_method import line_traits
from core.lines.wireframe import draw_outlines, join_batches
from core.methods import table
from core.records.arrays import Floats, Integers
from core.records.listing import RETURN, Columns, Labels, Operation
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack

# What rows of the raster stage are: pixels and spans of fills, pixels of lines; and how often pixels are
# covered.


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


# The rows of the raster stage before their numbers: what each is about, in drawing order.


KIND = {name: number for number, name in enumerate(FILL_OPERATIONS)}
"""Number of every kind of row of a fill."""


PIXEL_KINDS = np.array([KIND["test"], KIND["climb"], KIND["step"]])
"""Kind of a pixel's row by how its values were got: ``EVALUATED``, ``ADDED_B`` or ``ADDED_A``."""


@dataclass(frozen=True, eq=False)
class RowTable:
    """R rows, each about a triangle, a stretch of pixels in one of its rows, or one pixel."""

    kind: Integers
    """(R,) int64, number in `KIND`."""
    primitive: Integers
    """(R,) int64."""
    group: Integers
    """(R,) int64, equal in neighbouring rows that are one step of the level GROUP."""
    row: Integers
    """(R,) int64, -1: about no row of pixels."""
    start: Integers
    """(R,) int64, first column of the stretch that the row is about or lies in, -1: none."""
    stop: Integers
    """(R,) int64, column after the last."""
    crossings: Floats
    """(R, 3) float64, x where the edges are crossed; NaN: not known or of no use."""
    run: Integers
    """(R,) int64, index of the run that the row is about or lies in, -1: none."""
    test: Integers
    """(R,) int64, index of the pixel test, -1: the row is about no pixel."""


def rows_of_runs(source: TraceSource) -> RowTable:
    """Return one row for every pixel looked at; of fills by spans, one before the pixels of every span."""
    runs, tests = source.runs, source.tests
    has_spans = runs.crossings is not None
    headers = np.arange(len(runs)) if has_spans else np.empty(0, np.int64)
    run = np.concatenate([headers, tests.run])
    test = np.concatenate([np.full(len(headers), -1), np.arange(len(tests.run))])
    order = np.argsort(run, kind="stable")
    run, test = run[order], test[order]
    span_kind = KIND["span"] if runs.walk is None else _printed_kinds(runs.walk)[run]
    pixel_kind = np.where(
        runs.accepted[run], KIND["accept"], PIXEL_KINDS[np.append(tests.added, EVALUATED)[test]]
    )
    return RowTable(
        kind=np.where(test >= 0, pixel_kind, span_kind),
        primitive=runs.triangle[run],
        group=run if has_spans else runs.group[run],
        row=runs.row[run],
        start=runs.start[run],
        stop=runs.stop[run],
        crossings=runs.crossings[run] if runs.crossings is not None else np.full((len(run), 3), np.nan),
        run=run,
        test=test,
    )


def _printed_kinds(walk: SideWalk) -> Integers:
    """Return (R,) int64, the kind of the row before every span of the printed scanline."""
    found: Integers = np.array([KIND[name] for name in PRINTED])[2 * ~walk.is_upper + ~walk.is_first]
    return found


def printed_columns(walk: SideWalk, table: RowTable) -> dict[str, np.ndarray]:
    """Return the numbers that the sides of the printed scanline are made from: slopes, and x in the row before."""
    run = table.run
    of_sides = {
        "crossing_before": walk.before,
        "slope": walk.slope,
        "width": walk.width,
        "height": walk.height,
    }
    columns = {f"{name}_{k}": values[k][run] for name, values in of_sides.items() for k in range(2)}
    return columns | {"part_x": walk.corner[0][run], "part_y": walk.corner[1][run]}


# What the right algorithm draws where one runs as a slide prints it: the same input, row by row and pixel
# by pixel.


RIGHT_FILL = "scanline"
"""The fill that is right where the printed scanline is not."""


def right_spans(source: TraceSource, rows: RowTable) -> dict[str, np.ndarray]:
    """Return the columns (R,) that the triangle of each row covers there, and how many rows are never drawn.

    Returns
    -------
    dict
        ``right_start``, ``right_stop``: the span; both 0 where the triangle covers nothing of the row. ``left_out``:
        rows that the triangle covers and that the printed fill does not draw, at its first row, else 0. Empty where
        the number format has no spans.
    """
    edges, raster = source.geometry.edges, source.raster
    if not edges.numbers.suits_spans:
        return {}
    runs = table.get("fill", RIGHT_FILL).function(edges, bound(edges, raster), raster, 1)
    is_covered = runs.stop > runs.start
    height = source.scene.size[1]
    wanted = runs.triangle[is_covered] * height + runs.row[is_covered]
    order = np.argsort(wanted)
    wanted, spans = wanted[order], np.stack([runs.start[is_covered], runs.stop[is_covered]])[:, order]
    places = rows.primitive * height + rows.row
    found = np.searchsorted(wanted, places)
    start, stop = np.zeros((2, len(places)), np.int64)
    if len(wanted):
        is_known = wanted.take(found, mode="clip") == places
        start, stop = np.where(is_known, spans.take(found, axis=1, mode="clip"), 0)
    missing = np.bincount(np.setdiff1d(wanted, places) // height, minlength=len(edges))
    left_out = np.zeros(len(places), np.int64)
    primitives, is_first = np.unique(rows.primitive, return_index=True)
    left_out[is_first] = missing[primitives]
    return {"right_start": start, "right_stop": stop, "left_out": left_out}


def right_pixels(source: TraceSource, columns: Columns, line: str) -> Columns:
    """Return what the right method draws in the column (steep: row) of each pixel of lines as printed.

    Returns
    -------
    dict
        ``right_pixel`` (P, 2): column and row, -1 where it draws nothing there. ``left_out`` (P, 2): at a line's last
        pixel the first one beyond it that only the right method draws, else -1. Empty for a method that is not one as
        printed.
    """
    right = line_traits(line).right
    outlines = source.geometry.outlines
    if not right or outlines is None:
        return {}
    fragments, _ = join_batches(list(draw_outlines(outlines, source.raster, right)))
    segment, is_steep = columns["segment"], columns["is_steep"]
    steep = dict(zip(segment.tolist(), is_steep.tolist(), strict=True))
    drawn: dict[tuple[int, int], tuple[int, int]] = {}
    places = (fragments.segment, fragments.column, fragments.row)
    for owner, x, y in zip(*(each.tolist() for each in places), strict=True):
        drawn[owner, y if steep.get(owner, False) else x] = (x, y)
    keys = list(zip(segment.tolist(), columns["major"].astype(int).tolist(), strict=True))
    found = np.array([drawn.get(key, (-1, -1)) for key in keys], np.int64).reshape(-1, 2)
    rest: dict[int, list[tuple[int, int]]] = {}
    for (owner, _), pixel in ((key, drawn[key]) for key in drawn.keys() - set(keys)):
        rest.setdefault(owner, []).append(pixel)
    left_out = np.full((len(keys), 2), -1)
    for last in np.flatnonzero(np.diff(segment, append=-1)).tolist():
        pixels = rest.get(int(segment[last]), [])
        here = (int(columns["column"][last]), int(columns["row"][last]))
        if pixels:
            left_out[last] = min(pixels, key=lambda pixel: abs(pixel[0] - here[0]) + abs(pixel[1] - here[1]))
    return {"right_pixel": found, "left_out": left_out}
