"""The walk along the edges of a window that parametric line clippers share: entries, exits, verdict."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from core.geometry.line_clipping.records import (
    EMPTY,
    ENTER,
    KEPT,
    LEAVE,
    OUTSIDE,
    PARALLEL,
    ClippedLines,
    ClipWindow,
    ParameterRows,
)
from core.records.arrays import Flags, Floats, Integers


@dataclass(frozen=True, eq=False)
class EdgeWalk:
    """L segments after M edges; the arrays of M rows hold what was found at each edge."""

    case: Integers
    """(M, L) int64, ``ENTER``, ``LEAVE``, ``PARALLEL`` or ``OUTSIDE``; -1: given up before."""
    along: Floats
    """(M, L) float64, see ``ParameterRows``."""
    room: Floats
    """(M, L) float64."""
    t: Floats
    """(M, L) float64."""
    t_enter: Floats
    """(M, L) float64, after each edge."""
    t_leave: Floats
    """(M, L) float64, after each edge."""
    is_kept: Flags
    """(L,) bool."""
    cut_by: Integers
    """(L, 2) int64."""


def walk_edges(along: Floats, room: Floats, stops_early: bool, ignores: Flags | None = None) -> EdgeWalk:
    """Narrow 0 <= t <= 1 edge by edge.

    Parameters
    ----------
    along, room : (M, L) float64
        N . D and -N . (P0 - P_E) of every edge and segment.
    stops_early : bool
        Whether a segment is given up as soon as it would leave before it enters.
    ignores : (L,) bool, optional
        Segments of which parallel edges are skipped, on whatever side they lie.

    Notes
    -----
    A tie keeps what is there: the first of two edges that cut at the same t is the one that cut.
    """
    edge_count, count = along.shape
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        t = np.where(along == 0, np.nan, room / along)
    is_alive = np.ones(count, bool)
    enter, leave = np.zeros(count), np.ones(count)
    cut_by = np.full((count, 2), -1)
    case = np.full((edge_count, count), -1)
    enters, leaves = np.empty((2, edge_count, count))
    for edge in range(edge_count):
        is_parallel = is_alive & (along[edge] == 0)
        is_outside = is_parallel & (room[edge] < 0)
        if ignores is not None:
            is_outside &= ~ignores
        is_entry, is_exit = is_alive & (along[edge] < 0), is_alive & (along[edge] > 0)
        case[edge] = np.select(
            [is_outside, is_parallel, is_entry, is_exit], [OUTSIDE, PARALLEL, ENTER, LEAVE], -1
        )
        later, sooner = is_entry & (t[edge] > enter), is_exit & (t[edge] < leave)
        enter, leave = np.where(later, t[edge], enter), np.where(sooner, t[edge], leave)
        cut_by[later, 0], cut_by[sooner, 1] = edge, edge
        enters[edge], leaves[edge] = enter, leave
        is_alive &= ~is_outside
        if stops_early:
            is_alive &= enter <= leave
    return EdgeWalk(case, along, room, t, enters, leaves, is_alive & (enter <= leave), cut_by)


def clipped_lines(segments: Floats, window: ClipWindow, walk: EdgeWalk, ends: Floats) -> ClippedLines:
    """Return the record of a walk; ``ends`` (L, 2, 2) is the part that is kept, wherever something is."""
    kept = np.where(walk.is_kept[:, None, None], ends, np.nan)
    cut_by = np.where(walk.is_kept[:, None], walk.cut_by, -1)
    find_rows: Callable[[], ParameterRows] = partial(rows_of_walk, walk, kept)
    return ClippedLines(kept, walk.is_kept, cut_by, window, find_rows)


def points_at(segments: Floats, walk: EdgeWalk) -> Floats:
    """Return P(t) = P0 + t (P1 - P0) (L, 2, 2) where an end was cut, else the end itself."""
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    t = np.stack([walk.t_enter[-1], walk.t_leave[-1]], axis=1)
    points = start[:, None] + t[..., None] * along[:, None]
    return np.where(walk.cut_by[..., None] < 0, segments, points)


def rows_of_walk(walk: EdgeWalk, ends: Floats) -> ParameterRows:
    """List a walk step by step, segment by segment; ``ends`` (L, 2, 2) is what is kept.

    A segment that lies outside a parallel edge is done there; every other one has a row with its verdict.
    """
    edge, segment = np.nonzero(walk.case >= 0)
    is_done_early = (walk.case == OUTSIDE).any(axis=0)
    judged = np.flatnonzero(~is_done_early)
    none = np.full(len(judged), np.nan)
    columns = {
        "segment": np.concatenate([segment, judged]),
        "edge": np.concatenate([edge, np.full(len(judged), -1)]),
        "case": np.concatenate([walk.case[edge, segment], np.where(walk.is_kept[judged], KEPT, EMPTY)]),
    }
    for name in ("along", "room", "t"):
        columns[name] = np.concatenate([getattr(walk, name)[edge, segment], none])
    for name in ("t_enter", "t_leave"):
        values = getattr(walk, name)
        columns[name] = np.concatenate([values[edge, segment], values[-1, judged]])
    columns["ends"] = np.concatenate([np.full((len(edge), 2, 2), np.nan), ends[judged]])
    last = np.where(columns["edge"] < 0, len(walk.case), columns["edge"])
    order = np.lexsort([last, columns["segment"]])
    return ParameterRows(**{name: values[order] for name, values in columns.items()})
