"""Line clipping: what is left of segments in a window, by any method of the family ``line_clipping``."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from core.methods import method, table
from core.records.arrays import Flags, Floats, Integers, cached_property, checked
from core.records.clip_region import check_convex

# What all line clippers share: the window they clip to, and the records of what they did; and no clipping
# at all.


LINE_CLIP_LIMIT = 2.0**500
"""Largest coordinate that is clipped: products of two differences still fit float64."""
RECTANGLE_EDGES = ("left", "right", "bottom", "top")
"""Edges of a rectangular window, in the order in which they are looked at."""
ENTER, LEAVE, PARALLEL, OUTSIDE, KEPT, EMPTY = range(6)
PARAMETER_CASES = ("enter", "leave", "parallel", "outside", "kept", "empty")
"""What a row of a parametric clipper finds: one of the first four for an edge, one of the last two at the end."""
ACCEPT, REJECT, CUT = range(3)
OUTCODE_CASES = ("accept", "reject", "cut")
"""What a pass of Cohen-Sutherland finds."""


@dataclass(frozen=True, eq=False)
class ClipWindow:
    """A convex region of M edges; its border is inside."""

    corners: Floats
    """(M, 2) float64, counter-clockwise; edge k of a polygon runs from corner k to the next."""
    points: Floats
    """(M, 2) float64, a point on each edge (the lecture's P_E)."""
    normals: Floats
    """(M, 2) float64, outward normal of each edge: of length 1 for a rectangle, as long as the edge for a polygon."""
    edge_names: tuple[str, ...]
    is_rectangle: bool

    @property
    def borders(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top of a rectangle."""
        (left, bottom), (right, top) = self.corners[0], self.corners[2]
        return float(left), float(bottom), float(right), float(top)


@dataclass(frozen=True, eq=False)
class ParameterRows:
    """R steps of a clipper that works on P(t) = P0 + t (P1 - P0): one for each edge, and the verdict."""

    segment: Integers
    """(R,) int64, ascending."""
    edge: Integers
    """(R,) int64, edge of the window, -1 in the verdict."""
    case: Integers
    """(R,) int64, index of ``PARAMETER_CASES``."""
    along: Floats
    """(R,) float64, N . D: Liang-Barsky's p. Below 0 the segment enters here, above 0 it leaves. NaN in the verdict."""
    room: Floats
    """(R,) float64, -N . (P0 - P_E): Liang-Barsky's q. Below 0 the first end is outside. NaN in the verdict."""
    t: Floats
    """(R,) float64, where the line crosses the edge; NaN where it is parallel, and in the verdict."""
    t_enter: Floats
    """(R,) float64, the largest t of an entry (PE) by now, at least 0."""
    t_leave: Floats
    """(R,) float64, the least t of an exit (PL) by now, at most 1."""
    ends: Floats
    """(R, 2, 2) float64, the part that is kept, in the verdict; else NaN."""


@dataclass(frozen=True, eq=False)
class OutcodeRows:
    """R passes of Cohen-Sutherland."""

    segment: Integers
    """(R,) int64, ascending."""
    case: Integers
    """(R,) int64, index of ``OUTCODE_CASES``."""
    ends: Floats
    """(R, 2, 2) float64, both ends as they come to this pass."""
    codes: Integers
    """(R, 2) int64, outcode of both ends: bit k is set outside edge k of ``RECTANGLE_EDGES``."""
    edge: Integers
    """(R,) int64, the edge that is cut at, -1: none."""
    end: Integers
    """(R,) int64, the end that moves there, 0 or 1, -1: none."""
    point: Floats
    """(R, 2) float64, where it moves; NaN: it does not."""


@dataclass(frozen=True, eq=False)
class ClippedLines:
    """What is left of L segments in a window."""

    segments: Floats
    """(L, 2, 2) float64, the part inside, in the segment's own direction; NaN where there is none. Ends that are
    inside stay as they are."""
    is_kept: Flags
    """(L,) bool, something is left, if only a point."""
    cut_by: Integers
    """(L, 2) int64, the edge that cut the first and the second end, -1: none."""
    window: ClipWindow
    find_rows: Callable[[], ParameterRows | OutcodeRows | None]
    """Finds ``rows``; a picture never asks for them."""

    @cached_property
    def rows(self) -> ParameterRows | OutcodeRows | None:
        """Every number that took part, step by step; ``None``: nothing was looked at."""
        return self.find_rows()


def rectangle_window(left: float, bottom: float, right: float, top: float) -> ClipWindow:
    """Return an upright rectangle as a window; its sides may have no length."""
    borders = checked("window", [left, bottom, right, top], (4,), limit=LINE_CLIP_LIMIT)
    if not (borders[0] <= borders[2] and borders[1] <= borders[3]):
        raise ValueError(f"window must be (left, bottom, right, top), got {borders.tolist()}")
    corners = np.array([[left, bottom], [right, bottom], [right, top], [left, top]], float)
    points = np.array([[left, bottom], [right, top], [left, bottom], [right, top]], float)
    normals = np.array([[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]])
    return ClipWindow(corners, points, normals, RECTANGLE_EDGES, is_rectangle=True)


def polygon_window(corners: ArrayLike) -> ClipWindow:
    """Return a convex polygon (M, 2), counter-clockwise, as a window.

    Raises ValueError if it has fewer than three corners, is not convex (decided exactly), clockwise, or without area.
    """
    points = checked("window", corners, ("M", 2), limit=LINE_CLIP_LIMIT)
    check_convex(points)
    along = np.roll(points, -1, axis=0) - points
    normals = np.stack([along[:, 1], -along[:, 0]], axis=1)
    names = tuple(f"side {k}" for k in range(len(points)))
    return ClipWindow(points, points, normals, names, is_rectangle=False)


def need_rectangle(window: ClipWindow, name: str) -> None:
    """Refuse, with a sentence, a window that is no rectangle."""
    if not window.is_rectangle:
        count = len(window.corners)
        raise ValueError(
            f"{name} needs a rectangle (left, bottom, right, top), got a polygon of {count} corners"
        )


@method(
    "line_clipping",
    "none",
    "None (scissoring)",
    source="Pellacini, line clipping: only clip when necessary",
    exact_for="every segment: the pixels are those of the whole line",
    breaks_where="long lines: time is spent on pixels outside the window",
)
def no_line_clipping(segments: Floats, window: ClipWindow) -> ClippedLines:
    """Leave segments (L, 2, 2) as they are."""
    count = len(segments)
    return ClippedLines(segments, np.ones(count, bool), np.full((count, 2), -1), window, lambda: None)


def clip_lines(segments: ArrayLike, window: ArrayLike, method: str = "liang-barsky") -> ClippedLines:
    """Clip line segments to a window.

    Parameters
    ----------
    segments : (L, 2, 2) array_like of float
        First and second end of each, x and y.
    window : (4,) or (M, 2) array_like of float
        Left, bottom, right and top of a rectangle, or the corners of a convex polygon, counter-clockwise. Its
        border is inside.
    method : str
        A method of the family ``line_clipping``; Cohen-Sutherland and Liang-Barsky need a rectangle.

    Returns
    -------
    ClippedLines

    Raises
    ------
    ValueError
        For a shape, window or method that is not allowed, and for a coordinate that is not finite or larger than
        `core.lines.line_clipping.LINE_CLIP_LIMIT`.

    Notes
    -----
    A segment of no length is a point: kept inside and on the border, dropped outside.

    Examples
    --------
    >>> clipped = clip_lines([[[-2, 1], [6, 5]], [[5, 1], [6, 2]]], (0, 0, 4, 3))
    >>> clipped.segments[clipped.is_kept].tolist()
    [[[0.0, 2.0], [2.0, 3.0]]]
    >>> clipped.is_kept.tolist()
    [True, False]
    """
    ends = checked("segments", segments, ("L", 2, 2), limit=LINE_CLIP_LIMIT)
    is_rectangle = np.ndim(window) == 1
    region = rectangle_window(*checked("window", window, (4,))) if is_rectangle else polygon_window(window)
    clipped: ClippedLines = table.get("line_clipping", method).function(ends, region)
    return clipped


# The walk along the edges of a window that parametric line clippers share: entries, exits, verdict.


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
