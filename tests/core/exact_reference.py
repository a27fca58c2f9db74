"""Which pixels a triangle covers, in rational arithmetic, one pixel at a time, from the definition alone.

Nothing of the program is used here: a window position is a fraction, snapping is Python's ``round`` (half to
even), an edge function is a determinant of fractions, and the tie rule moves the point by writing down what
the determinant gains by the move.
"""

from fractions import Fraction
from math import lcm

import numpy as np

Point = tuple[Fraction, Fraction, Fraction]
LIMIT = 2**16


def exact(values) -> list[Fraction]:
    return [Fraction(float(value)) for value in values]


def snapped_window(corner, size: tuple[int, int]) -> tuple[Fraction, Fraction] | None:
    """Return the corner's place on the 1/256-pixel grid, or ``None`` where it has none."""
    x, y, _, w = exact(corner)
    if w <= 0:
        return None
    window = [(p / w + 1) * n / 2 for p, n in zip((x, y), size, strict=True)]
    if any(abs(p) > LIMIT for p in window):
        return None
    column, row = (Fraction(round(256 * p), 256) for p in window)
    return column, row


def homogeneous_window(corner, size: tuple[int, int]) -> Point:
    """Return D clip = (x, y, w) before snapping."""
    x, y, _, w = exact(corner)
    return (x + w) * size[0] / 2, (y + w) * size[1] / 2, w


def determinant(first: Point, second: Point, third: Point) -> Fraction:
    (x0, y0, w0), (x1, y1, w1), (x2, y2, w2) = first, second, third
    return x0 * (y1 * w2 - w1 * y2) + y0 * (w1 * x2 - x1 * w2) + w0 * (x1 * y2 - y1 * x2)


def facing(clip, size: tuple[int, int], snaps: bool = True) -> int:
    """Return 1 for the front, -1 for the back, 0 for edge-on; of snapped corners where all are on the grid."""
    places = [snapped_window(corner, size) if snaps else None for corner in clip]
    if None in places:
        value = determinant(*(homogeneous_window(corner, size) for corner in clip))
    else:
        value = determinant(*((*place, Fraction(1)) for place in places))
    return (value > 0) - (value < 0)


def line_through(first: Point, second: Point) -> tuple[int, int, int]:
    """Return integers a, b, c in proportion to the determinant of (first, second, pixel)."""
    (x1, y1, w1), (x2, y2, w2) = first, second
    a, b, c = y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
    scale = lcm(a.denominator, b.denominator, c.denominator)
    return int(a * scale), int(b * scale), int(c * scale)


def edge_signs(clip, size: tuple[int, int], snaps: bool = True) -> list[tuple[int, int, int]]:
    """Return inward lines (a, b, c) of the three edges; edge k lies opposite corner k."""
    places = [snapped_window(corner, size) if snaps else None for corner in clip]
    corners = [homogeneous_window(corner, size) for corner in clip]
    turn = facing(clip, size, snaps)
    lines = []
    for k in range(3):
        start, finish = (k + 1) % 3, (k + 2) % 3
        on_grid = [places[end] for end in (start, finish) if places[end] is not None]
        a, b, c = line_through(corners[start], corners[finish])
        if len(on_grid) == 2:
            a, b, c = line_through(*((*place, Fraction(1)) for place in on_grid))
        elif on_grid:
            # Moved to its snapped end, not turned; all numbers times 256 are whole.
            (x, y), a, b = on_grid[0], 256 * a, 256 * b
            c = int(-(a * x + b * y))
        lines.append((turn * a, turn * b, turn * c))
    return leave_out_turned(lines, places, clip)


def leave_out_turned(lines, places, clip) -> list[tuple[int, int, int]]:
    """Leave out the edge between two snapped corners that are not inside the opposite edges."""
    unsnapped = [k for k, place in enumerate(places) if place is None]
    if len(unsnapped) != 1:
        return lines
    third = unsnapped[0]
    for k in ((third + 1) % 3, (third + 2) % 3):
        (a, b, c), (x, y) = lines[k], places[k]
        if a * x + b * y + c <= 0:
            lines[third] = (0, 0, -1 if Fraction(float(clip[third][3])) > 0 else 1)
    return lines


def exact_coverage(
    clip,
    size: tuple[int, int],
    rule: str = "shared-edge",
    doubled_center: int = 1,
    snaps: bool = True,
    region: tuple[int, int, int, int] | None = None,
) -> np.ndarray:
    """Return (rows, columns) bool of the region, row 0 at the bottom: the pixels of one triangle (3, 4)."""
    first_column, first_row, columns, rows = region or (0, 0, *size)
    covered = np.zeros((rows, columns), bool)
    if facing(clip, size, snaps) == 0 or all(Fraction(float(corner[3])) <= 0 for corner in clip):
        return covered
    lines = edge_signs(clip, size, snaps)
    for row in range(rows):
        for column in range(columns):
            x, y = 2 * (first_column + column) + doubled_center, 2 * (first_row + row) + doubled_center
            covered[row, column] = all(side(line, x, y, rule) for line in lines)
    return covered


def side(line: tuple[int, int, int], doubled_x: int, doubled_y: int, rule: str) -> bool:
    """Decide for the point (x/2, y/2), moved by an infinitesimal step right and a far smaller step up."""
    a, b, c = line
    value = a * doubled_x + b * doubled_y + 2 * c
    if value != 0:
        return value > 0
    if rule != "shared-edge":
        return rule == "inclusive"
    gain_right, gain_up = a, b
    return gain_right > 0 or (gain_right == 0 and gain_up > 0)
