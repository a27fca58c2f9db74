"""Trace of line clipping: what a clipper does with an edge of a wireframe, before the pixels of that edge."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.geometry.line_clipping.records import (
    ENTER,
    OUTCODE_CASES,
    PARAMETER_CASES,
    OutcodeRows,
    ParameterRows,
)
from core.methods import table
from core.records.listing import RETURN, EditedListing, listing
from core.records.operation import Columns, Labels, Operation
from core.stages.clipped_outlines import OutlineClip
from core.trace.inserted_rows import InsertedRows, insert_rows
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace


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
