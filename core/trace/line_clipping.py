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
from core.records.listing import listing
from core.records.operation import Labels, Operation
from core.stages.clipped_outlines import OutlineClip
from core.trace.inserted_rows import InsertedRows, insert_rows
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace


def _narrow_label(bound: str, changed: str, otherwise: str) -> Labels:
    """Return the line of a clipper that sets a bound, or only compares it."""
    return lambda columns, rows: np.where(
        columns[bound][rows] == columns["bound_before"][rows], otherwise, changed
    )


_ROOM = Operation("room", "edges", ("border", "approach", "room"))
_CODES = Operation("codes", "outcodes", ("code_start", "code_end"))
_KEPT = ("kept_start", "kept_end")
CLIP_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "clip-enter": (
        _ROOM,
        Operation("crossing", "t", ("crossing_t",)),
        Operation("narrow", _narrow_label("t_enter", "enter", "entry"), ("t_enter",)),
    ),
    "clip-leave": (
        _ROOM,
        Operation("crossing", "t", ("crossing_t",)),
        Operation("narrow", _narrow_label("t_leave", "leave", "exit"), ("t_leave",)),
    ),
    "clip-parallel": (_ROOM, Operation("side", "parallel")),
    "clip-outside": (_ROOM, Operation("drop", "outside")),
    "clip-kept": (Operation("ends", "ends", _KEPT),),
    "clip-empty": (Operation("drop", "empty"),),
    "outcodes-accept": (_CODES, Operation("ends", "accept", _KEPT)),
    "outcodes-reject": (_CODES, Operation("drop", "reject")),
    "outcodes-cut": (
        _CODES,
        Operation("edge", "edge", ("border", "moved_end")),
        Operation("move", "move", ("moved_to",)),
    ),
}
"""Kind of row to what it does."""


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
    inserted = InsertedRows(
        before=np.searchsorted(pixel_segment, segment),
        group=segment,
        triangle=source.geometry.primitives.triangle[primitive],
        kinds=kinds,
        kind=rows.case,
        operations={kind: CLIP_OPERATIONS[kind] for kind in kinds},
        columns=columns,
        listings=dict.fromkeys(kinds, listing(algorithm)),
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
