"""Which pixels triangles and polygons cover, in rational arithmetic, and how much of a pixel in closed form.

The area of a polygon inside a pixel is the integral of x, cut to the pixel, along its border (Green's theorem). On one
straight side x is linear in y, so the mean of the cut x has a closed form without cancellation.

References
----------
E. Catmull, *A hidden-surface algorithm with anti-aliasing*, 1978 (exact area).

An edge is a line with whole-number coefficients through two homogeneous corners. In one row the centres inside it are a
half-line of columns, whose end is a division of integers, rounded down or up; a triangle's are the three half-lines'
intersection.

References
----------
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997.
M. Zwicker, *Computergrafik*, lecture "Shared edges", Bern 2016.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from core.coverage.snapping import SUBPIXELS
from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import Rings

# How much of a pixel a convex shape covers, in closed form.


def area_in_pixels(polygon: Floats, column: Integers, row: Integers) -> Floats:
    """Return the area (F,) float64 of polygons inside the unit squares of pixels.

    Parameters
    ----------
    polygon : (M, 2) or (F, M, 2) float64
        Corners in pixels, counter-clockwise; one for all pixels, or one each.
    column, row : (F,) int64
        The square reaches from (column, row) to (column + 1, row + 1).
    """
    corners = np.broadcast_to(polygon, (len(column), *polygon.shape[-2:]))
    x, y = corners[..., 0] - column[:, None], corners[..., 1] - row[:, None]
    area = np.zeros(len(column))
    for k in range(corners.shape[1]):
        area += _under_side(x[:, k - 1], y[:, k - 1], x[:, k], y[:, k])
    return np.clip(area, 0.0, 1.0)


def _under_side(x0: Floats, y0: Floats, x1: Floats, y1: Floats) -> Floats:
    """Return the integral (F,) of x cut to [0, 1] over the part of y in [0, 1] along one side, signed."""
    bottom, top = np.clip(y0, 0.0, 1.0), np.clip(y1, 0.0, 1.0)
    height = y1 - y0
    is_level = height == 0
    slope = (x1 - x0) / np.where(is_level, 1.0, height)
    first, second = x0 + (bottom - y0) * slope, x0 + (top - y0) * slope
    return np.where(is_level, 0.0, (top - bottom) * _mean_of_cut(first, second))


def _mean_of_cut(first: Floats, second: Floats) -> Floats:
    """Return the mean (F,) of x cut to [0, 1] while x runs evenly from ``first`` to ``second``."""
    low, high = np.minimum(first, second), np.maximum(first, second)
    cut_low, cut_high = np.clip(low, 0.0, 1.0), np.clip(high, 0.0, 1.0)
    above = np.maximum(high - 1.0, 0.0) - np.maximum(low - 1.0, 0.0)
    length = high - low
    is_point = length == 0
    total = (cut_high - cut_low) * (cut_high + cut_low) / 2 + above
    return np.where(is_point, cut_low, total / np.where(is_point, 1.0, length))


# Exact cover of polygons: for each pixel's centre, how often rings run around it, in whole numbers.


def exact_cover(rings: Rings, polygon: int, size: tuple[int, int], is_even_odd: bool) -> Flags:
    """Return (H, W) bool, the pixels whose centres, moved a little to the right and up, lie inside a polygon.

    Parameters
    ----------
    rings : Rings
        Corners are snapped to 1/256 pixel.
    size : (width, height)
    is_even_odd : bool
        Inside is what an odd number of sides separates from the outside; else what rings run around.

    Notes
    -----
    Of each side, the pixels right of it count: by the sign of a cross product in Python's integers.
    """
    width, height = size
    crossed, winding = np.zeros((2, height, width), np.int64)
    half = SUBPIXELS // 2
    for ring in rings.rings_of(polygon):
        places = np.rint(ring * SUBPIXELS).astype(np.int64).tolist()
        for (x0, y0), (x1, y1) in zip(places, [*places[1:], places[0]], strict=True):
            way = 1 if y1 > y0 else -1
            for row in range(height):
                y = SUBPIXELS * row + half
                if (y0 <= y) == (y1 <= y):
                    continue
                for column in range(width):
                    x = SUBPIXELS * column + half
                    if way * ((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) >= 0:
                        crossed[row, column] += 1
                        winding[row, column] += way
    return np.asarray(crossed % 2 == 1 if is_even_odd else winding != 0)


# Which pixels triangles cover, in rational arithmetic: every row of an edge solved for the columns inside.


STEPS = 256
"""Steps of the 1/256-pixel grid in one pixel."""
FARTHEST = 2**16
"""Corners farther from the window's origin than this, in pixels, are not snapped."""

Corner = tuple[Fraction, Fraction, Fraction]
"""x, y, w in the homogeneous window."""
WholeCorner = tuple[int, int, int]
"""The same times any positive number."""
Line = tuple[int, int, int]
"""a, b, c of ``a x + b y + c``, positive inside."""


@dataclass(frozen=True, eq=False)
class ExactSpans:
    """R stretches of covered pixels, triangle by triangle, row by row."""

    triangle: Integers
    """(R,) int64."""
    row: Integers
    """(R,) int64."""
    start: Integers
    """(R,) int64, first column."""
    stop: Integers
    """(R,) int64, column after the last."""

    def pixels(self) -> tuple[Integers, Integers, Integers]:
        """Return triangle, column and row (F,) of every covered pixel."""
        length = self.stop - self.start
        which = np.repeat(np.arange(len(length)), length)
        place = np.arange(len(which)) - np.repeat(np.cumsum(length) - length, length)
        return self.triangle[which], self.start[which] + place, self.row[which]


def exact_spans(
    clip: Floats,
    size: tuple[int, int],
    *,
    is_snapped: bool = True,
    rule: str = "shared-edge",
    pixel_center: str = "half",
) -> ExactSpans:
    """Find the pixels of triangles, each for itself.

    Parameters
    ----------
    clip : (T, 3, 4) float64
        Clip positions, taken as the rational numbers that they are.
    size : (width, height)
    is_snapped : bool
        Move corners to the 1/256-pixel grid first (half to even), as GPUs and ``coverage=snapped`` do. An edge with
        one end on the grid is moved and not turned: see `core.coverage.snapping`.
    rule : {"shared-edge", "inclusive", "exclusive"}
        Who owns a centre that lies exactly on an edge.
    pixel_center : {"half", "integer"}

    Notes
    -----
    Depth is not looked at. A triangle seen edge-on, or with all w <= 0, covers nothing.
    """
    center = doubled_center(pixel_center)
    found: list[tuple[int, int, int, int]] = []
    for number in np.flatnonzero(may_hold_a_center(clip, size, center / 2)).tolist():
        lines, rows = triangle_lines(clip[number], size, is_snapped)
        if not lines:
            continue
        for row in rows:
            start, stop = columns_inside(lines, 2 * row + center, center, rule, size[0])
            if start < stop:
                found.append((number, row, start, stop))
    columns = np.array(found, np.int64).reshape(-1, 4).T
    return ExactSpans(*columns)


def doubled_center(pixel_center: str) -> int:
    """Return twice the offset of a pixel's centre: 1 for ``half``, 0 for ``integer``."""
    return {"half": 1, "integer": 0}[pixel_center]


def may_hold_a_center(clip: Floats, size: tuple[int, int], center: float) -> Flags:
    """Tell which triangles (T, 3, 4) may cover a pixel: of a large mesh most lie between the centres.

    Parameters
    ----------
    center : float
        Of pixel 0 in pixels: 0.5, or 0.

    Returns
    -------
    (T,) bool
        False only for triangles that cover nothing, snapped or not.

    Notes
    -----
    A triangle with all w > 0 lies in the box of its corners. The box is found in float64 and widened by far more than
    that rounds, a few units in the last place, and by a step of the grid, twice what snapping moves a corner.
    """
    is_in_front = (clip[..., 3] > 0).all(axis=1)
    may_touch: Flags = np.logical_not(is_in_front)
    corners = clip[is_in_front]
    with np.errstate(over="ignore", invalid="ignore"):
        places = (corners[..., :2] / corners[..., 3:] + 1.0) * (np.array(size) / 2.0)
        slack = 1.0 / STEPS + 1e-12 * (np.abs(places) + np.array(size))
        first = np.maximum(np.ceil((places - slack).min(axis=1) - center), 0.0)
        last = np.minimum(np.floor((places + slack).max(axis=1) - center), np.array(size) - 1.0)
    # What is not a number is looked at too: only boxes that are known to be empty are left out.
    may_touch[is_in_front] = ~(first > last).any(axis=1)
    return may_touch


def triangle_lines(
    corners: Floats, size: tuple[int, int], is_snapped: bool = True
) -> tuple[tuple[Line, ...], range]:
    """Return the inward lines of a triangle (3, 4), edge k opposite corner k, and the rows that it may touch.

    No lines: nothing is covered.
    """
    given = [whole_corner(corner, size, False) for corner in corners]
    placed = [snapped_corner(corner) if is_snapped else None for corner in given]
    ends = [place or corner for place, corner in zip(placed, given, strict=True)]
    turn = facing(given if None in placed else ends)
    if turn == 0 or all(w <= 0 for _, _, w in given):
        return (), range(0)
    lines = [_edge_line(k, given, placed, turn) for k in range(3)]
    if placed.count(None) == 1:
        _leave_out_turned(lines, placed, given)
    if any(w <= 0 for _, _, w in given):
        return tuple(lines), range(size[1])
    heights = [y // w for _, y, w in ends]
    return tuple(lines), range(max(min(heights) - 1, 0), min(max(heights) + 2, size[1]))


def homogeneous_corner(corner: Floats, size: tuple[int, int]) -> Corner:
    """Return x, y, w of a clip position (4,) in the homogeneous window, where it is."""
    x, y, _, w = (Fraction(float(value)) for value in corner)
    return (x + w) * size[0] / 2, (y + w) * size[1] / 2, w


def whole_corner(corner: Floats, size: tuple[int, int], is_snapped: bool) -> WholeCorner:
    """Return x, y, w of a clip position (4,) in the homogeneous window, as whole numbers in the same proportion.

    Notes
    -----
    A positive factor moves no corner and turns no triangle. The numbers of a float64 are halved so and so often, so
    that a power of two makes them whole: adding and multiplying takes a tenth of the time that fractions take.
    """
    ratios = [float(corner[k]).as_integer_ratio() for k in (0, 1, 3)]
    common = max(below for _, below in ratios)
    x, y, w = (above * (common // below) for above, below in ratios)
    given = (x + w) * size[0], (y + w) * size[1], 2 * w
    return (snapped_corner(given) or given) if is_snapped else given


def snapped_corner(corner: WholeCorner) -> WholeCorner | None:
    """Return a corner's place on the 1/256-pixel grid; ``None``: it is behind the eye or too far away."""
    x, y, w = corner
    if w <= 0 or max(abs(x), abs(y)) > FARTHEST * w:
        return None
    return round(Fraction(STEPS * x, w)), round(Fraction(STEPS * y, w)), STEPS


def facing(corners: Sequence[Corner | WholeCorner]) -> int:
    """Return 1 for a triangle that turns counter-clockwise, -1 for clockwise, 0 for one seen edge-on."""
    (x0, y0, w0), (x1, y1, w1), (x2, y2, w2) = corners
    value = x0 * (y1 * w2 - w1 * y2) + y0 * (w1 * x2 - x1 * w2) + w0 * (x1 * y2 - y1 * x2)
    return (value > 0) - (value < 0)


def _edge_line(k: int, given: list[WholeCorner], placed: list[WholeCorner | None], turn: int) -> Line:
    """Return edge k: between two ends on the grid, or the given one, moved to the end that is on the grid."""
    first, second = placed[k - 2], placed[k - 1]
    ends = (first, second) if first and second else (given[k - 2], given[k - 1])
    (x1, y1, w1), (x2, y2, w2) = ends
    a, b, c = turn * (y1 * w2 - w1 * y2), turn * (w1 * x2 - x1 * w2), turn * (x1 * y2 - y1 * x2)
    anchor = None if first and second else first or second
    if anchor is None:
        return a, b, c
    x, y, w = anchor
    return a * w, b * w, -(a * x + b * y)


def _leave_out_turned(lines: list[Line], placed: list[WholeCorner | None], given: list[WholeCorner]) -> None:
    """Leave out the edge between two corners on the grid that do not lie inside the opposite edges."""
    third = placed.index(None)
    opposite = [(line, place) for line, place in zip(lines, placed, strict=True) if place]
    if any(a * x + b * y + c * w <= 0 for (a, b, c), (x, y, w) in opposite):
        lines[third] = (0, 0, -1 if given[third][2] > 0 else 1)


def owns_edge(a: int | Fraction, b: int | Fraction, rule: str = "shared-edge") -> bool:
    """Tell whether a triangle owns the centres on the inward edge ``a x + b y + c = 0`` by a fill rule."""
    return {"shared-edge": a > 0 or (a == 0 and b > 0), "inclusive": True, "exclusive": False}[rule]


def columns_inside(
    lines: tuple[Line, ...], doubled_y: int, center: int, rule: str, width: int
) -> tuple[int, int]:
    """Return the first column inside all lines in one row, and the column after the last.

    ``doubled_y`` and ``center`` are twice y of the row and x of the first column.
    """
    start, stop = 0, width
    for a, b, c in lines:
        # Twice the value at column k is slope k + rest.
        slope, rest = 2 * a, a * center + b * doubled_y + 2 * c
        owns = owns_edge(a, b, rule)
        if slope > 0:
            start = max(start, -(rest // slope) if owns else -rest // slope + 1)
        elif slope < 0:
            stop = min(stop, rest // -slope + 1 if owns else -(-rest // -slope))
        elif rest < 0 or (rest == 0 and not owns):
            return 0, 0
    return start, stop


def count_pixels(column: Integers, row: Integers, size: tuple[int, int]) -> Integers:
    """Return how often each pixel occurs among ``column`` and ``row`` (F,): (H, W) int64."""
    width, height = size
    return np.bincount(row * width + column, minlength=width * height).reshape(height, width)
