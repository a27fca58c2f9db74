"""Trace of lines: what a clipper does with the edges of a wireframe, and every pixel of every edge."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.traced_rows import FILL_OPERATIONS, overdraw_track, right_pixels
from core.lines.drawing import OPERATIONS, POINT, point_listing
from core.lines.line_clipping import ENTER, OUTCODE_CASES, PARAMETER_CASES, OutcodeRows, ParameterRows
from core.lines.line_method import OFF, check_segments, line_set_up, line_traits
from core.lines.wireframe import line_parameter
from core.methods import table
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import RETURN, Columns, EditedListing, Labels, Operation, listing
from core.records.steps import Steps, ends_of
from core.stages.primitives import OutlineClip
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, InsertedRows, StageTrace, insert_rows

# Trace of line clipping: what a clipper does with an edge of a wireframe, before the pixels of that edge.


def _narrow_label(bound: str, changed: str, otherwise: str) -> Labels:
    """Return the line of a clipper that sets a bound, or only compares it."""
    return lambda columns, rows: np.where(
        columns[bound][rows] == columns["bound_before"][rows], otherwise, changed
    )


def _ends_label(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line that moves an end, or the one that begins with both where no border cuts the segment."""
    is_cut = (columns["t_enter"][rows] > 0) | (columns["t_leave"][rows] < 1)
    return np.where(is_cut, "ends", "uncut")


def _by_parameter(
    approach: str, room: str, enter: str, leave: str, ends: Operation
) -> dict[str, tuple[Operation, ...]]:
    """Return what rows of a clipper do that compares values of t, by the names of its listing."""
    of_border = Operation("room", "edges", {"approach": approach, "room": room}, ("border",))
    crossing = Operation("crossing", "t", {"crossing_t": "t"})
    return {
        "clip-enter": (
            of_border,
            crossing,
            Operation("narrow", _narrow_label("t_enter", "enter", "entry"), {"t_enter": enter}),
        ),
        "clip-leave": (
            of_border,
            crossing,
            Operation("narrow", _narrow_label("t_leave", "leave", "exit"), {"t_leave": leave}),
        ),
        "clip-parallel": (of_border, Operation("side", "parallel")),
        "clip-outside": (of_border, Operation("drop", "outside")),
        "clip-kept": (ends,),
        "clip-empty": (Operation("drop", "empty"),),
    }


_CODES = Operation("codes", "outcodes", dict.fromkeys(("code_start", "code_end"), "codes"))
_KEPT = ("kept_start", "kept_end")
_BY_OUTCODES: dict[str, tuple[Operation, ...]] = {
    "outcodes-accept": (_CODES, Operation("ends", "accept", dict.fromkeys(_KEPT, RETURN))),
    "outcodes-reject": (_CODES, Operation("drop", "reject")),
    "outcodes-cut": (
        _CODES,
        Operation("end", "end", {"moved_end": "end"}),
        Operation("edge", "edge", {"border": "edge"}),
        Operation("move", "move", {"moved_to": "ends"}),
    ),
}
_MOVED = Operation("ends", _ends_label, dict.fromkeys(_KEPT, "ends"))
_BOTH = Operation("ends", "ends", {"kept_start": "first", "kept_end": "second"})
CLIP_OPERATIONS: dict[str, dict[str, tuple[Operation, ...]]] = {
    "cohen-sutherland": _BY_OUTCODES,
    "liang-barsky": _by_parameter("p", "q", "t_enter", "t_leave", _MOVED),
    "cyrus-beck": _by_parameter("along", "room", "t_e", "t_l", _BOTH),
    "cyrus-beck-lecture": _by_parameter("along", "room", "t_e", "t_l", _BOTH),
    "exact": _by_parameter("along", "room", "t_e", "t_l", _MOVED),
}
"""Line clipper to its kinds of rows and what they do."""
CLIP_KINDS = tuple(dict.fromkeys(kind for kinds in CLIP_OPERATIONS.values() for kind in kinds))


def with_line_clipping(found: StageTrace, source: TraceSource) -> StageTrace:
    """Return the trace of a wireframe's pixels with the steps of its line clipper, if it has one."""
    clip = source.geometry.outline_clip
    if clip is None:
        return found
    rows = clip.lines.rows
    assert rows is not None
    own = _outcode_columns(rows, clip) if isinstance(rows, OutcodeRows) else _parameter_columns(rows, clip)
    prefix, cases = (
        ("outcodes", OUTCODE_CASES) if isinstance(rows, OutcodeRows) else ("clip", PARAMETER_CASES)
    )
    algorithm = table.get("line_clipping", source.settings.line_clipping).listing
    assert algorithm is not None, f"{source.settings.line_clipping} has no listing"
    kinds = tuple(f"{prefix}-{case}" for case in cases)
    operations = CLIP_OPERATIONS[source.settings.line_clipping]
    pixel_segment = clip.kept[found.columns["segment"]]
    segment, whole = rows.segment, clip.whole
    primitive = whole.primitive[segment]
    columns: Mapping[str, NDArray[Any]] = {
        "segment": segment,
        "primitive": primitive,
        "edge": whole.edge[segment],
        "window_start": whole.window[segment, 0],
        "window_end": whole.window[segment, 1],
        **own,
    }
    shown = listing(algorithm)
    if isinstance(shown, EditedListing):
        # What it is given: its steps are told by its own lines.
        columns = {**columns, "clip_row": np.arange(len(segment)) - np.searchsorted(segment, segment)}
        shown = replace(shown, given={"window": clip.lines.window})
    inserted = InsertedRows(
        before=np.searchsorted(pixel_segment, segment),
        group=segment,
        triangle=source.geometry.primitives.triangle[primitive],
        kinds=kinds,
        kind=rows.case,
        operations={kind: operations[kind] for kind in kinds},
        columns=columns,
        listings=dict.fromkeys(kinds, shown),
    )
    # Edges are numbered among all of them, not among those that are left.
    numbered = replace(
        found,
        columns={**found.columns, "segment": pixel_segment},
        extra={**found.extra, "outline_clip": clip},
        constants={**found.constants, "line_clipping": source.settings.line_clipping},
    )
    return insert_rows(numbered, pixel_segment, inserted)


def _border_names(edge: NDArray[np.int64], clip: OutlineClip) -> NDArray[Any]:
    """Return what the borders (R,) of the window are called, none: an empty text."""
    return np.array([*clip.lines.window.edge_names, ""])[edge]


def _parameter_columns(rows: ParameterRows, clip: OutlineClip) -> dict[str, NDArray[Any]]:
    window = clip.lines.window
    is_first = np.diff(rows.segment, prepend=-1) != 0
    is_entry = rows.case == ENTER
    before = np.where(is_entry, np.roll(rows.t_enter, 1), np.roll(rows.t_leave, 1))
    return {
        "border": _border_names(rows.edge, clip),
        "normal": window.normals[rows.edge],
        "border_point": window.points[rows.edge],
        "approach": rows.along,
        "room": rows.room,
        "crossing_t": rows.t,
        "bound_before": np.where(is_first, np.where(is_entry, 0.0, 1.0), before),
        "t_enter": rows.t_enter,
        "t_leave": rows.t_leave,
        "kept_start": rows.ends[:, 0],
        "kept_end": rows.ends[:, 1],
    }


def _outcode_columns(rows: OutcodeRows, clip: OutlineClip) -> dict[str, NDArray[Any]]:
    return {
        "border": _border_names(rows.edge, clip),
        "pass_start": rows.ends[:, 0],
        "pass_end": rows.ends[:, 1],
        "code_start": rows.codes[:, 0],
        "code_end": rows.codes[:, 1],
        "moved_end": rows.end,
        "moved_to": rows.point,
        "kept_start": rows.ends[:, 0],
        "kept_end": rows.ends[:, 1],
    }


# Trace of a wireframe's coverage: every pixel of every edge, with the numbers by which the line method
# chose it.


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
