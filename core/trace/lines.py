"""Trace of a wireframe's coverage: every pixel of every edge, with the numbers by which the line method chose it."""

from collections.abc import Mapping

import numpy as np

from core.methods import table
from core.raster.lines.points import OPERATIONS, POINT, point_listing
from core.raster.lines.records import check_segments
from core.raster.lines.traits import OFF, line_set_up, line_traits
from core.raster.lines.wireframe import line_parameter
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import listing
from core.records.operation import Columns, Operation
from core.records.steps import Steps, ends_of
from core.trace.inserted_rows import InsertedRows, insert_rows
from core.trace.line_clipping import with_line_clipping
from core.trace.raster_rows import FILL_OPERATIONS, overdraw_track
from core.trace.right_pixels import right_pixels
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace


def trace_lines(source: TraceSource) -> StageTrace:
    """Return one row for every pixel of the outlines; rows of one edge of one primitive are a group.

    Before the pixels of an edge stand the steps of the line clipper.
    """
    geometry, raster, line = source.geometry, source.raster, source.settings.line
    outlines, (fragments, steps) = geometry.outlines, source.lines
    assert outlines is not None
    segment, is_smooth = fragments.segment, fragments.intensity is not None
    count = len(fragments)
    pixel = np.stack([fragments.column, fragments.row], axis=1)
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "primitive": fragments.primitive,
        "segment": segment,
        "edge": outlines.edge[segment],
        "window_start": outlines.window[segment, 0],
        "window_end": outlines.window[segment, 1],
        "covered": np.ones(count, bool),
        **{name: values for name, values in vars(steps).items() if name != "t"},
        "fraction": steps.decision - np.floor(steps.decision),
        "t": line_parameter(outlines, fragments, raster.center),
        "previous": _previous(steps.decision, segment),
    }
    segments = check_segments(outlines.drawn, *source.scene.size, raster.center)
    set_up = line_set_up(segments, line)
    columns |= {name: values[segment] for name, values in set_up.items()}
    is_steep = columns["is_steep"]
    columns["major"] = np.where(is_steep, pixel[:, 1], pixel[:, 0])
    columns["minor"] = np.where(is_steep, pixel[:, 0], pixel[:, 1])
    columns |= _pixel_before(columns, steps.index == 0)
    # A listing that has swapped x and y for a steep line goes on with dx along its longer axis.
    is_unswapped = is_steep & (not line_traits(line).swaps_axes)
    columns["dx"], columns["dy"] = (
        np.where(is_unswapped, columns[other], columns[own])
        for own, other in (("run", "rise"), ("rise", "run"))
    )
    columns |= line_traits(line).columns(columns)
    columns |= right_pixels(source, columns, line)

    method = table.get("line", line)
    assert method.listing is not None, f"{line} has no listing"
    operations, listed = method.operations, listing(method.listing)
    kind = _kind(columns, tuple(operations), line_traits(line).pixels_in_column)
    if geometry.vertices.corner_count == 1:
        operations, listed = {POINT: OPERATIONS}, listing(point_listing)
        kind = np.zeros(count, np.int64)
    kinds = (*FILL_OPERATIONS, *operations)
    triangle = geometry.primitives.triangle[fragments.primitive]
    listings = dict.fromkeys(operations, listed)
    every, place = np.arange(count), source.place
    unknown = np.full(raster.shape, np.nan)
    found = StageTrace(
        stage="raster",
        method=f"line={line}",
        steps=Steps(
            kinds=kinds,
            kind=len(FILL_OPERATIONS) + kind,
            operations={**FILL_OPERATIONS, **operations},
            triangle_ends=ends_of(triangle),
            group_ends=ends_of(segment),
        ),
        columns=columns,
        triangle=triangle,
        pixel=pixel,
        listings=listings,
        marks={
            "covered": columns["covered"],
            "rejected": np.zeros(count, bool),
            "tie": steps.is_tie,
            "nan": np.zeros(count, bool),
        },
        buffers=(
            BufferTrack(
                "coverage", unknown, every, place, steps.intensity, "scalar" if is_smooth else "flags"
            ),
            BufferTrack("edge", np.full(raster.shape, -1), every, place, columns["edge"], "ids"),
            BufferTrack("t", unknown, every, place, columns["t"]),
            BufferTrack("decision", unknown, every, place, steps.decision, "signed"),
            overdraw_track(source, every),
        ),
        extra={
            "runs": source.runs,
            "boxes": source.boxes,
            "blocks": None,
            "edges": geometry.edges,
            "outlines": outlines,
        },
        constants={"center": raster.center, "right_method": line_traits(line).right},
        given=_given(operations, columns),
    )
    return with_line_clipping(_with_set_up(found, line_traits(line).pixels_in_column), source)


SET_UP = frozenset({"octant", "lengths", "directions", "sy", "slope", "intercept"})
"""What a line method does once for a line, before it goes to the first pixel."""


def _with_set_up(found: StageTrace, in_column: int) -> StageTrace:
    """Put a row before each line whose first pixels lie off the raster: what its numbers are, and how many are skipped.

    Of such a line the row of the first pixel, which sets them up, is not there.
    """
    columns, kinds = found.columns, found.steps.kinds
    skipped = columns["index"] // in_column
    first = np.flatnonzero((np.diff(columns["segment"], prepend=-1) != 0) & (skipped > 0))
    starting = next((kind for kind in kinds if kind.endswith("-start")), "")
    if not len(first) or not starting:
        return found
    done = tuple(one for one in found.steps.operations[starting] if one.name in SET_UP)
    kind = f"{starting.removesuffix('-start')}{OFF}"
    rows = InsertedRows(
        before=first,
        group=columns["segment"][first],
        triangle=found.triangle[first],
        kinds=(kind,),
        kind=np.zeros(len(first), np.int64),
        operations={kind: (*done, Operation("skip", "draw", {"skipped": "pixels"}))},
        columns={
            **{name: values[first] for name, values in columns.items()},
            "covered": np.zeros(len(first), bool),
            "skipped": skipped[first],
        },
        listings={kind: found.listings[starting]},
    )
    return insert_rows(found, columns["segment"], rows)


def _kind(columns: Columns, kinds: tuple[str, ...], in_column: int) -> Integers:
    """Return which of the ``kinds`` of a method, with so many pixels ``in_column``, each row (R,) is of."""
    index, segment = columns["index"], columns["segment"]
    is_beside = np.zeros(len(index), bool)
    is_beside[1:] = (segment[1:] == segment[:-1]) & (np.diff(index // in_column) == 0)
    is_other = columns["has_stepped"] if kinds[-1].endswith("-step") else is_beside
    return np.where(index == 0, 0, np.minimum(1 + is_other, len(kinds) - 1))


def _given(operations: Mapping[str, tuple[Operation, ...]], columns: Columns) -> dict[str, tuple[str, ...]]:
    """Return what the rows before have left for each kind of row but a line's first: of this pixel, line or column."""
    shown = {
        kind: dict.fromkeys(name for done in operations[kind] for name in done.shows) for kind in operations
    }
    first, *later = shown
    left = {"major_before": "major", "minor_before": "minor", "sum_before": "decision"}
    if not later:
        return {}
    every = set().union(*shown.values()) | ({"decision"} if "sum_advanced" in shown[first] else set())
    before = [name for name, now in left.items() if now in every and np.isfinite(columns[name]).any()]
    held = shown[first] | shown[later[0]]
    return {kind: (*before, *(name for name in held if name not in shown[kind])) for kind in later}


def _pixel_before(columns: Columns, is_first: Flags) -> dict[str, Floats]:
    """Return both coordinates (R,) of the pixel before on the line, NaN where a pixel is the first."""
    return {
        "major_before": np.where(is_first, np.nan, columns["major"] - columns["sx"]),
        "minor_before": np.where(is_first, np.nan, columns["minor"] - columns["has_stepped"] * columns["sy"]),
    }


def _previous(decision: Floats, segment: np.ndarray) -> Floats:
    """Return the decision (R,) one row before on the same segment, NaN where there is none."""
    before = np.full(len(decision), np.nan)
    same = np.flatnonzero(segment[1:] == segment[:-1])
    before[same + 1] = decision[same]
    return before
