"""The line as a rectangle: a pixel is drawn where its centre lies inside a rectangle one pixel wide around the segment.

The rectangle is one pixel wide at a right angle to the line, so it is up to 1.41 pixels high in a column: some columns
get two pixels, more of them the steeper the line, and lines of different angles look differently thick. Its short
sides are cut at a right angle too, so that lines that meet at a corner leave a notch there.

The ends are snapped to 1/256 pixel, as coverage does. A centre is at the distance ``cross / length`` from the line,
where the cross product is a whole number and the length a square root: whether the distance is at most half a pixel
is decided by the whole number below the root, which integers alone find (`half_width`). So every decision is exact.

**Ties**: a centre on one of the long sides belongs to the rectangle that contains the point moved an infinitesimal step
right, then up, as in the fill rule for shared edges: lines that lie side by side share no pixel and leave none out. A
centre on the short side at the first end is drawn, one at the second end only with ``last_pixel``, so that lines that
continue each other share none either.

References
----------
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline": point-sampled line rasterization.
"""

from dataclasses import dataclass
from math import ceil, floor, isqrt, sqrt

import numpy as np

from core.coverage.snapping import SUBPIXELS
from core.lines.line_method import (
    OCTANT,
    PLOT,
    LineRun,
    LineTraits,
    Segments,
    enumerate_steps,
    line_rows,
    major_first,
    visible_range,
)
from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Operation

CANDIDATES = 3
"""Pixels of a column that are looked at: the one nearest to the line and both beside it. """
MOST_INSIDE = 2
"""Most of them that are inside: the rectangle is at most 1.42 pixels high in a column."""
FIRST_COLUMNS = 4
"""Columns among the first of which the line's first pixel is, if it is longer than that."""

Listed = list[tuple[int, int, float]]
"""Column, row and distance across the line, from a listing."""

_INSIDE = (
    Operation("across", "inside", takes=("decision", "is_tie")),
    Operation("along", "along", takes=("along",)),
    PLOT,
)


@dataclass(frozen=True, eq=False)
class _Rectangles:
    """L rectangles; whole numbers in 1/256 pixel, in coordinates where pixel centres are multiples of 256."""

    is_steep: Flags
    step: Integers
    """(L,) int64, 1 or -1 along the major axis."""
    start: Integers
    """(L,) int64 first column (steep: row) that the rectangle may reach."""
    count: Integers
    """(L,) int64 columns from the first to the last."""
    v: Floats
    """(L,) float64 minor coordinate of the line in column ``start``, in pixels."""
    slope: Floats
    """(L,) float64 its change from column to column to the right."""
    first: Integers
    """(L, 2) int64 first end x, y."""
    way: Integers
    """(L, 2) int64 from the first end to the second; (1, 0) where they coincide."""
    squared: Integers
    """(L,) int64 square of the length, 0 where the ends coincide."""
    half: Integers
    """(L,) int64, half a pixel times the length of ``way``, see `half_width`."""
    is_whole: Flags
    """(L,) bool, whether this is exact."""

    @property
    def pixel(self) -> Floats:
        """(L,) float64, one pixel times the length of ``way``: products divided by it are distances in pixels."""
        way = self.way
        return SUBPIXELS * np.sqrt((way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1]).astype(np.float64))


def half_width(squared: Integers) -> tuple[Integers, Flags]:
    """Return the whole number at or below half a pixel times a length, exactly.

    Parameters
    ----------
    squared : (L,) int64
        Squares of lengths in 1/256 pixel, 1 to 2**60.

    Returns
    -------
    half : (L,) int64
        floor(128 sqrt(squared)): a cross product is at most half a pixel from the line where its size is not above.
    is_exact : (L,) bool
        Whether the root is a whole number; only then can a centre lie on a long side.

    Notes
    -----
    16384 times the square does not fit 64 bits. With s = floor(sqrt(squared)) and r = squared - s**2 the result is
    128 s + e, where e is the largest whole number with e (256 s + e) <= 16384 r; it has seven bits.
    """
    root = np.floor(np.sqrt(squared.astype(np.float64))).astype(np.int64)
    root -= root * root > squared
    root += (root + 1) * (root + 1) <= squared
    rest = (SUBPIXELS // 2) ** 2 * (squared - root * root)
    part = np.zeros_like(root)
    for bit in (64, 32, 16, 8, 4, 2, 1):
        larger = part + bit
        part = np.where(larger * (SUBPIXELS * root + larger) <= rest, larger, part)
    return SUBPIXELS // 2 * root + part, part * (SUBPIXELS * root + part) == rest


def snapped_ends(segments: Segments) -> Integers:
    """Return the ends (L, 2, 2) int64 in 1/256 pixel, half to even, where pixel centres are multiples of 256."""
    return np.rint(segments.ends * SUBPIXELS).astype(np.int64) - int(segments.center * SUBPIXELS)


def _set_up(segments: Segments) -> _Rectangles:
    ends = snapped_ends(segments)
    way = ends[:, 1] - ends[:, 0]
    squared = way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1]
    is_steep = np.abs(way[:, 1]) > np.abs(way[:, 0])
    way = np.where(squared[:, None] == 0, np.array([1, 0]), way)
    along = major_first(ends, is_steep)
    u, v, u_end = along[:, 0, 0], along[:, 0, 1], along[:, 1, 0]
    du, dv = np.where(is_steep[:, None], way[:, ::-1], way).T

    # The short sides reach less than half a pixel beyond the ends.
    low, high = np.minimum(u, u_end), np.maximum(u, u_end)
    lowest = -((SUBPIXELS // 2 - low) // SUBPIXELS)
    highest = (high + SUBPIXELS // 2) // SUBPIXELS
    step = np.where(du < 0, -1, 1)
    start = np.where(step > 0, lowest, highest)
    slope = dv / du
    height = v / SUBPIXELS + (start - u / SUBPIXELS) * slope
    return _Rectangles(
        is_steep,
        step,
        start,
        highest - lowest + 1,
        height,
        slope,
        ends[:, 0],
        way,
        squared,
        *half_width(np.maximum(squared, 1)),
    )


@dataclass(frozen=True, eq=False)
class _Verdict:
    """Decisions about Q candidates: `CANDIDATES` pixels of every (segment, column) pair."""

    owner: Integers
    k: Integers
    """(Q,) int64, column of the candidate, counted from the line's first."""
    column: Integers
    row: Integers
    is_inside: Flags
    across: Floats
    """(Q,) float64, distance of the centre from the line in pixels, above 0 on the left of its direction."""
    along: Floats
    """(Q,) float64, how far along the line the centre lies, in pixels."""
    is_tie: Flags


def _nearest(rectangles: _Rectangles, owner: Integers, k: Integers) -> Integers:
    """Return the pixel of column k nearest to the line, in float64: (P,) int64 each."""
    along = rectangles.step[owner] * k
    line = rectangles.v[owner] + along * rectangles.slope[owner]
    return np.rint(line).astype(np.int64)


def _judge(rectangles: _Rectangles, owner: Integers, k: Integers, last_pixel: bool) -> _Verdict:
    """Decide the candidates of column k of segment ``owner``, both (P,) int64."""
    count = len(owner)
    owner, k = owner.repeat(CANDIDATES), k.repeat(CANDIDATES)
    which = np.tile(np.arange(CANDIDATES), count)
    step, is_steep = rectangles.step[owner], rectangles.is_steep[owner]
    u = rectangles.start[owner] + step * k
    v = _nearest(rectangles, owner, k) - 1 + which
    column, row = np.where(is_steep, v, u), np.where(is_steep, u, v)

    x, y = SUBPIXELS * column - rectangles.first[owner, 0], SUBPIXELS * row - rectangles.first[owner, 1]
    dx, dy = rectangles.way[owner].T
    cross, dot = dx * y - dy * x, dx * x + dy * y
    half, squared = rectangles.half[owner], rectangles.squared[owner]

    # On a long side: it belongs to whom an infinitesimal step right, then up, leads into.
    is_side = (np.abs(cross) == half) & rectangles.is_whole[owner]
    is_below = (dy < 0) | ((dy == 0) & (dx > 0))
    owns = np.where(cross < 0, is_below, ~is_below)
    is_inside = (np.abs(cross) <= half) & (owns | ~is_side)
    is_inside &= (dot >= 0) & ((dot < squared) | ((dot == squared) & last_pixel))
    pixel = rectangles.pixel[owner]
    return _Verdict(owner, k, column, row, is_inside, cross / pixel, dot / pixel, is_side)


def rectangle_listing(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """List the pixels of ``rectangle`` on one segment, exactly; pixel centres are whole numbers."""
    x0, y0, x1, y1 = (round(end * SUBPIXELS) for end in (x0, y0, x1, y1))  # in 1/256 pixel
    dx, dy = x1 - x0, y1 - y0
    is_steep = abs(dy) > abs(dx)  #: octant
    squared = dx * dx + dy * dy
    if squared == 0:
        dx = 1
    half_squared = (SUBPIXELS // 2) ** 2 * (dx * dx + dy * dy)
    half = isqrt(half_squared)
    L = sqrt(dx * dx + dy * dy) / SUBPIXELS  #: length
    is_below = dy < 0 or (dy == 0 and dx > 0)

    low, high = sorted((y0, y1) if is_steep else (x0, x1))
    first, last = ceil(low / SUBPIXELS - 0.5), floor(high / SUBPIXELS + 0.5)
    columns = range(first, last + 1)
    du, dv, u0, v0 = dx, dy, x0, y0
    if is_steep:
        du, dv, u0, v0 = dy, dx, y0, x0

    pixels = []
    for u in columns[::-1] if du < 0 else columns:
        place = v0 + (SUBPIXELS * u - u0) * dv / du
        nearest = floor(place / SUBPIXELS + 0.5)
        for v in range(nearest - 1, nearest + 2):
            column, row = (v, u) if is_steep else (u, v)
            x = SUBPIXELS * column - x0
            y = SUBPIXELS * row - y0
            cross = dx * y - dy * x
            dot = dx * x + dy * y
            is_inside = abs(cross) <= half
            if cross * cross == half_squared:
                is_inside = (cross < 0) == is_below
            if not is_inside:  #: inside
                continue
            if dot < 0 or dot > squared or (dot == squared and not last_pixel):  #: along
                continue
            pixels.append((column, row, cross / (SUBPIXELS * SUBPIXELS * L)))  #: draw
    return pixels


def _ends_in_pixels(segments: Segments) -> Floats:
    return snapped_ends(segments) / SUBPIXELS


@method(
    "line",
    "rectangle",
    "Rectangle, point-sampled",
    source="Pellacini, Point-sampled line rasterization",
    exact_for="the one-pixel-wide rectangle around the segment, with ends snapped to 1/256 pixel: exactly the "
    "pixels whose centre it contains",
    breaks_where="sloping lines: some columns have two pixels. Lines that meet at a corner leave a notch. Many "
    "inside tests",
    listing=rectangle_listing,
    operations=line_rows(
        "rectangle", (OCTANT, Operation("length", "length", {"length": "L"}), *_INSIDE), _INSIDE
    ),
    traits=LineTraits(ends=_ends_in_pixels, swaps_axes=False),
)
def rectangle(segments: Segments, last_pixel: bool) -> LineRun:
    """Draw the pixels whose centre lies in the rectangle; ``decision`` is the centre's distance across the line.

    Notes
    -----
    The distance is in pixels, above 0 on the left of the line's direction; ``along`` is the other coordinate of the
    rectangle. Only the three pixels of a column are looked at that can be inside.
    """
    rectangles = _set_up(segments)
    first, last = visible_range(
        segments,
        rectangles.is_steep,
        rectangles.start,
        rectangles.step,
        rectangles.v,
        rectangles.step * rectangles.slope,
        rectangles.count,
    )
    owner, k = enumerate_steps(first, last)
    verdict = _judge(rectangles, owner, k, last_pixel)
    drawn = np.flatnonzero(verdict.is_inside)
    owner, k = verdict.owner[drawn], verdict.k[drawn]
    is_second = np.zeros(len(drawn), bool)
    is_second[1:] = (owner[1:] == owner[:-1]) & (k[1:] == k[:-1])
    index = MOST_INSIDE * (k - _first_drawn(rectangles, last_pixel)[owner]) + is_second
    now, before = _nearest(rectangles, owner, k), _nearest(rectangles, owner, k - 1)
    return LineRun(
        owner,
        index,
        verdict.column[drawn],
        verdict.row[drawn],
        verdict.across[drawn],
        (now != before) & (index > 0),
        verdict.is_tie[drawn],
        along=verdict.along[drawn],
    )


def _first_drawn(rectangles: _Rectangles, last_pixel: bool) -> Integers:
    """Return the first column (L,) that a pixel is drawn in, counted from ``start``: near an end, there may be none."""
    count = len(rectangles.start)
    owner, k = np.arange(count).repeat(FIRST_COLUMNS), np.tile(np.arange(FIRST_COLUMNS), count)
    verdict = _judge(rectangles, owner, k, last_pixel)
    drawn = verdict.is_inside.reshape(count, FIRST_COLUMNS, CANDIDATES).any(axis=2)
    return np.asarray(drawn.argmax(axis=1))
