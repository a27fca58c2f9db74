"""Which pixels triangles cover, in rational arithmetic: every row of an edge solved for the columns inside.

An edge is a line with whole-number coefficients through two homogeneous corners. In one row the centres inside it are a
half-line of columns, whose end is a division of integers, rounded down or up; a triangle's are the three half-lines'
intersection.

References
----------
M. Olano, T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, 1997.
M. Zwicker, *Computergrafik*, lecture "Shared edges", Bern 2016.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, lcm

import numpy as np

from core.arrays import Floats, Integers

STEPS = 256
"""Steps of the snapping lattice in one pixel."""
FARTHEST = 2**16
"""Corners farther from the window's origin than this, in pixels, are not snapped."""

Corner = tuple[Fraction, Fraction, Fraction]
"""x, y, w in the homogeneous window."""
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
        Move corners to the lattice of 1/256 pixel first (half to even), as GPUs and ``coverage=snapped`` do.
    rule : {"shared-edge", "inclusive", "exclusive"}
        Who owns a centre that lies exactly on an edge.
    pixel_center : {"half", "integer"}

    Notes
    -----
    Depth is not looked at. A triangle seen edge-on, or with all w <= 0, covers nothing.
    """
    doubled_center = 1 if pixel_center == "half" else 0
    found: list[tuple[int, int, int, int]] = []
    for number, corners in enumerate(clip):
        lines, rows = triangle_lines(corners, size, is_snapped)
        if not lines:
            continue
        for row in rows:
            start, stop = columns_inside(lines, 2 * row + doubled_center, doubled_center, rule, size[0])
            if start < stop:
                found.append((number, row, start, stop))
    columns = np.array(found, np.int64).reshape(-1, 4).T
    return ExactSpans(*columns)


def triangle_lines(
    corners: Floats, size: tuple[int, int], is_snapped: bool = True
) -> tuple[tuple[Line, ...], range]:
    """Return the inward lines of a triangle (3, 4), edge k opposite corner k, and the rows that it may touch.

    No lines: nothing is covered.
    """
    placed = [homogeneous_corner(corner, size, is_snapped) for corner in corners]
    turn = facing(placed)
    if turn == 0 or all(w <= 0 for _, _, w in placed):
        return (), range(0)
    lines = tuple(_line_through(placed[k - 2], placed[k - 1], turn) for k in range(3))
    if any(w <= 0 for _, _, w in placed):
        return lines, range(size[1])
    heights = [y / w for _, y, w in placed]
    return lines, range(max(floor(min(heights)) - 1, 0), min(ceil(max(heights)) + 1, size[1]))


def homogeneous_corner(corner: Floats, size: tuple[int, int], is_snapped: bool) -> Corner:
    """Return x, y, w of a clip position (4,) in the homogeneous window; (snapped w, w) where it is snapped."""
    x, y, _, w = (Fraction(float(value)) for value in corner)
    across, up = (x + w) * size[0] / 2, (y + w) * size[1] / 2
    if not is_snapped or w <= 0 or max(abs(across), abs(up)) > FARTHEST * w:
        return across, up, w
    return Fraction(round(STEPS * across / w), STEPS) * w, Fraction(round(STEPS * up / w), STEPS) * w, w


def facing(corners: list[Corner]) -> int:
    """Return 1 for a triangle that turns counter-clockwise, -1 for clockwise, 0 for one seen edge-on."""
    (x0, y0, w0), (x1, y1, w1), (x2, y2, w2) = corners
    value = x0 * (y1 * w2 - w1 * y2) + y0 * (w1 * x2 - x1 * w2) + w0 * (x1 * y2 - y1 * x2)
    return (value > 0) - (value < 0)


def _line_through(first: Corner, second: Corner, turn: int) -> Line:
    (x1, y1, w1), (x2, y2, w2) = first, second
    a, b, c = y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
    scale = turn * lcm(a.denominator, b.denominator, c.denominator)
    return int(a * scale), int(b * scale), int(c * scale)


def columns_inside(
    lines: tuple[Line, ...], doubled_y: int, doubled_center: int, rule: str, width: int
) -> tuple[int, int]:
    """Return the first column inside all lines in one row, and the column after the last."""
    start, stop = 0, width
    for a, b, c in lines:
        # Twice the value at column k is slope k + rest.
        slope, rest = 2 * a, a * doubled_center + b * doubled_y + 2 * c
        owns = rule == "inclusive" or (rule == "shared-edge" and (a > 0 or (a == 0 and b > 0)))
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
