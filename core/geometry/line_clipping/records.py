"""What all line clippers share: the window they clip to, and the records of what they did; and no clipping at all."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core.methods import method
from core.records.arrays import Flags, Floats, Integers, checked
from core.records.cached import cached_property
from core.records.clip_region import check_convex

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
