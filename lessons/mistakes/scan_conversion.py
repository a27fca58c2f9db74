"""Mistakes in scan conversion: scanline fills, the picture's memory, and Bresenham's algorithm as printed."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import floor
from typing import Any

import numpy as np

from core import Settings, draw_lines
from core.records.arrays import Flags, Floats
from core.records.frame import Frame
from core.scene import ClipScene
from lessons.assembled_scenes import assembled
from lessons.mistakes.coverage import FREE, SQUARE, with_places
from lessons.mistakes.transforms import Vector
from lessons.mistakes.twin import (
    Case,
    Change,
    Twin,
    edited,
    in_window,
    line_pixels,
    same_settings,
    wrong_rule,
)
from lessons.small_scenes import Point, pixel_segments, segment_scene, triangle_scene
from lessons.window_scenes import polygon_of_rings

# Mistakes of scanline fills and of the picture's memory.


def owns_both_sides(a: Floats, b: Floats) -> Flags:
    """Own left and right edges, and level bottom edges."""
    return np.asarray((a != 0) | (b > 0))


def one_column_more(scene: ClipScene) -> ClipScene:
    """Widen the window by one column on the right."""
    wide = replace(scene, size=(scene.size[0] + 1, scene.size[1]))
    return with_places(wide, in_window(scene))


def column_wrapped(frame: Frame, scene: ClipScene) -> Frame:
    """Store rows of one column too many in memory for the right number: the last column lands in the next row."""
    columns = scene.size[0]
    buffers = {}
    for name in ("color", "depth", "primitive", "attributes", "cover_count"):
        wide = getattr(frame, name)
        stored = wide[:, :columns].copy()
        beyond = frame.cover_count[:-1, columns] > 0
        stored[1:, 0][beyond] = wide[:-1, columns][beyond]
        buffers[name] = stored
    return replace(frame, **buffers)


def truncated_to_zero(scene: ClipScene) -> ClipScene:
    """Find the pixels of points by int(x), which turns -1 < x < 0 into 0."""
    if scene.kind != "points":
        return scene
    return with_places(scene, np.trunc(in_window(scene)) + 0.5)


def other_rule(settings: Settings) -> Settings:
    """Fill polygons by the other one of the two rules."""
    other = {"even-odd": "non-zero", "non-zero": "even-odd"}[settings.polygon_fill]
    return replace(settings, polygon_fill=other)


def edge_crossing(start: Vector, end: Vector, row: int) -> Vector:
    """Return x where an edge meets the centres of a row."""
    (x0, y0), (x1, y1) = start, end
    return (x0 + (row + Fraction(1, 2) - y0) * (x1 - x0) / Fraction(y1 - y0),)


def crossing_count(polygon: Sequence[Vector], y: int) -> Vector:
    """Return how many edges a scan line crosses: an edge has its lower end, but not its upper one."""
    edges = pairwise([*polygon, polygon[0]])
    return (Fraction(sum(min(y0, y1) <= y < max(y0, y1) for (_, y0), (_, y1) in edges)),)


def active_edges(polygon: Sequence[Vector], y: Fraction) -> frozenset[int]:
    """Return the edges that are active on the line y: they have their lower end, but not their upper one."""
    edges = enumerate(pairwise([*polygon, polygon[0]]))
    return frozenset(k for k, ((_, y0), (_, y1)) in edges if min(y0, y1) <= y < max(y0, y1))


def pixels_with_border(polygon: Sequence[Vector]) -> frozenset[tuple[int, int]]:
    """Return the pixels whose centres lie inside of a convex, counter-clockwise polygon or on its border."""
    sides = list(pairwise([*polygon, polygon[0]]))
    (left, right), (bottom, top) = (
        (floor(min(c) - Fraction(1, 2)), floor(max(c) - Fraction(1, 2))) for c in zip(*polygon, strict=True)
    )
    return frozenset(
        (i, j)
        for i in range(left, right + 1)
        for j in range(bottom, top + 1)
        if all(_left_of(side, (i + Fraction(1, 2), j + Fraction(1, 2))) >= 0 for side in sides)
    )


def _left_of(side: tuple[Vector, Vector], point: Vector) -> Any:
    (x0, y0), (x1, y1) = side
    return (x1 - x0) * (point[1] - y0) - (y1 - y0) * (point[0] - x0)


def count_by_weights(triangles: Sequence[Sequence[Vector]], side: int) -> Vector:
    """Return how many of side x side pixels are drawn where all weights of a triangle lie in [0, 1], ends included."""
    return (Fraction(len(frozenset().union(*(pixels_with_border(_turned(one)) for one in triangles)))),)


def _turned(corners: Sequence[Vector]) -> Sequence[Vector]:
    return corners if _left_of((corners[0], corners[1]), corners[2]) > 0 else corners[::-1]


SHIFT = Fraction(1, 16384)
LOW, HIGH, FAR = Fraction(1, 2) - SHIFT, Fraction(13, 2), Fraction(13, 2) + SHIFT
HALVES = (
    ((Fraction(1, 2), HIGH), (Fraction(1, 2), LOW), (FAR, LOW)),
    ((FAR, LOW), (FAR, HIGH), (Fraction(1, 2), HIGH)),
)
"""Two triangles that share an edge through 7 centres; their corners are float32 numbers."""
TURNED_HALVES = tuple((b, a, c) for a, b, c in HALVES)
EDGE = ((Fraction(6, 5), Fraction(19, 10)), (Fraction(12, 5), Fraction(87, 10)), 4)
LEVEL_EDGE = ((Fraction(3), Fraction(1, 2)), (Fraction(3), Fraction(9, 2)), 2)
STAR = np.array([(2.3, 1.2), (6.1, 8.6), (9.7, 1.4), (1.2, 5.8), (10.9, 5.7)])
HOUSE = ((0, 0), (6, 3), (4, 8), (0, 8))
LATE = ((3, 5), (1, 7), (1, 1), (7, 6))
RECTANGLE = tuple((x + Fraction(1, 2), y + Fraction(1, 2)) for x, y in ((1, 1), (5, 1), (5, 4), (1, 4)))
DIAMOND = tuple((x + Fraction(1, 2), y + Fraction(1, 2)) for x, y in ((2, 0), (4, 2), (2, 4), (0, 2)))


@wrong_rule(edge_crossing, shows=EDGE, hides=LEVEL_EDGE)
def crossing_from_vertex(start: Vector, end: Vector, row: int) -> Vector:
    """x was counted from the vertex as if it lay on a row of centres. Begin at the first row's centre."""
    (x0, y0), (x1, y1) = start, end
    return (x0 + (row - floor(y0)) * (x1 - x0) / Fraction(y1 - y0),)


@wrong_rule(edge_crossing, shows=EDGE, hides=LEVEL_EDGE)
def height_plus_one(start: Vector, end: Vector, row: int) -> Vector:
    """The height was made one larger against division by zero. That turns every edge."""
    (x0, y0), (x1, y1) = start, end
    return (x0 + (row + Fraction(1, 2) - y0) * (x1 - x0) / Fraction(y1 - y0 + 1),)


@wrong_rule(crossing_count, shows=(HOUSE, 3), hides=(HOUSE, 5))
def both_ends_crossed(polygon: Sequence[Vector], y: int) -> Vector:
    """A vertex was counted for both of its edges. An edge has its lower end, not its upper one."""
    edges = pairwise([*polygon, polygon[0]])
    return (Fraction(sum(min(y0, y1) <= y <= max(y0, y1) and y0 != y1 for (_, y0), (_, y1) in edges)),)


@wrong_rule(active_edges, shows=(LATE, Fraction(6)), hides=(LATE, Fraction(4)))
def edges_leave_late(polygon: Sequence[Vector], y: Fraction) -> frozenset[int]:
    """Edges were removed after the row was drawn.

    They leave the active edges before it: an edge has its lower end, not its upper one.
    """
    return active_edges(polygon, y) | active_edges(polygon, y - 1)


@wrong_rule(pixels_with_border, shows=(RECTANGLE,), hides=(DIAMOND,))
def level_side_dropped(polygon: Sequence[Vector]) -> frozenset[tuple[int, int]]:
    """The level upper side was dropped, and its pixels with it. Here what lies on the border is drawn."""
    pixels, top = pixels_with_border(polygon), max(y for _, y in polygon)
    is_level = sum(y == top for _, y in polygon) > 1
    return frozenset((i, j) for i, j in pixels if not is_level or j + Fraction(1, 2) < top)


@wrong_rule(count_by_weights, shows=(HALVES, 7), hides=(TURNED_HALVES, 7))
def third_weight_rounded(triangles: Sequence[Sequence[Vector]], side: int) -> Vector:
    """1 - alpha - beta was rounded below 0 in both triangles, so pixels on their common edge are missing.

    Decide edges by whole numbers, alike in both.
    """
    y, x = np.indices((side, side)).astype(np.float32) + np.float32(0.5)
    is_drawn = np.zeros((side, side), bool)
    for corners in triangles:
        (x0, y0), (x1, y1), (x2, y2) = np.array(corners, float).astype(np.float32)
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        alpha = ((x1 - x) * (y2 - y) - (x2 - x) * (y1 - y)) / area
        beta = ((x2 - x) * (y0 - y) - (x0 - x) * (y2 - y)) / area
        is_drawn |= (alpha >= 0) & (beta >= 0) & (1 - alpha - beta >= 0)
    return (Fraction(int(is_drawn.sum())),)


# Mistakes in Bresenham's algorithm as printed (LMU), D > 0, ends in order, the last pixel drawn; and in
# Wu's.


LECTURE = Settings(line="bresenham-lecture")
DRAW = "pixels.append((y, x, D) if is_steep else (x, y, D))"
ROW = "y0 + sy * abs(x - x0) * dy // max(dx, 1)"


def in_bresenham(*in_lecture: Change, other: Change | None) -> Callable[[Settings], Settings]:
    """Return what runs Bresenham's listing with changed lines: of ``bresenham`` if settings choose it, else LMU's.

    ``other`` is the change of ``bresenham``; ``None``: the mistake makes no difference there.
    """
    lecture = edited("line", "bresenham-lecture", *in_lecture)
    plain = same_settings if other is None else edited("line", "bresenham", other)
    return lambda settings: (plain if settings.line == "bresenham" else lecture)(settings)


def in_both(old: str, new: str) -> Callable[[Settings], Settings]:
    """Return the same for a line that both listings have."""
    return in_bresenham((old, new), other=(old, new))


def intensities(scene: ClipScene, settings: Settings) -> list[float]:
    """Return the intensities of the pixels of lines."""
    drawn: list[float] = draw_lines(in_window(scene), *scene.size, settings.line).intensities.tolist()
    return drawn


def line(*ends: tuple[Point, Point]) -> Case:
    """Return lines between pixels, of which the pixels are compared."""
    return Case(pixel_segments(ends, (16, 12)), LECTURE, line_pixels)


GENTLE = line(((1, 1), (9, 4)))
OUT_OF_SIGHT = line(((-4, 1), (20, 8)))
"""Both ends lie outside of the raster."""

TWINS = (
    Twin(
        "right-end-drawn",
        "The right end of the span was drawn, too. A centre on a right edge belongs to the neighbour.",
        Case(SQUARE),
        Case(FREE),
        change_settings=lambda settings: settings.replaced(fill_rule=owns_both_sides),
    ),
    Twin(
        "flat-sides-lost",
        "A flat side was lost: the loop over its half has no rows. Both halves need their own rows.",
        Case(triangle_scene([[(1, 1), (7, 1), (4, 6)]], (8, 8))),
        Case(triangle_scene([[(6.5, 5.9), (0.2, 1.3), (6.8, 3.6)]], (8, 8))),
        change_settings=lambda settings: replace(settings, fill="scanline-lecture"),
    ),
    Twin(
        "winding-ignored",
        "The two rules are exchanged. Even-odd counts edges, non-zero adds their directions.",
        Case(polygon_of_rings([STAR], (12, 9)), Settings(polygon_fill="non-zero")),
        Case(polygon_of_rings([np.array(HOUSE)], (12, 9)), Settings(polygon_fill="non-zero")),
        change_settings=other_rule,
    ),
    Twin(
        "column-wrapped",
        "Column W was written, which is column 0 of the next row. The last column is W - 1.",
        Case(triangle_scene([[(3, 1), (12, 3), (3, 6)]], (8, 8))),
        Case(FREE),
        change_scene=one_column_more,
        change_frame=column_wrapped,
    ),
    Twin(
        "truncated-to-zero",
        "int(x) turns -1 < x < 0 into 0. A pixel's column is floor(x).",
        Case(assembled("points", np.array([-0.5, 3.5]), np.array([2.5, 2.5]), (6, 6))),
        Case(assembled("points", np.array([0.5, 3.5]), np.array([2.5, 2.5]), (6, 6))),
        change_scene=truncated_to_zero,
    ),
    Twin(
        "ties-step",
        "The line stepped where D = 0. The rule here is D > 0: a tie stays in the row.",
        GENTLE,
        line(((0, 0), (7, 3))),
        change_settings=in_bresenham(("if D > 0:", "if D >= 0:"), other=None),
    ),
    Twin(
        "from-other-end",
        "The line was drawn from its other end, which turns ties over. Begin at the end that the rule names.",
        line(((0, 0), (8, 3))),
        line(((0, 0), (7, 3))),
        change_settings=in_bresenham(
            ("if x0 > x1:", "if x0 < x1:"),
            ("dx, dy = x1 - x0", "dx, dy = x0 - x1"),
            ("sx, sy = 1", "sx, sy = -1"),
            ("while x <= x1:", "while x >= x1:"),
            other=None,
        ),
    ),
    Twin(
        "not-corrected",
        "D was not corrected after a step: 2 dx must be subtracted.",
        GENTLE,
        line(((1, 2), (9, 2))),
        change_settings=in_both("D -= 2 * dx", "D -= 0"),
    ),
    Twin(
        "one-octant",
        "The line ran along x although it is steep. Where |dy| is not below |dx| the axes are exchanged.",
        line(((1, 1), (3, 8))),
        GENTLE,
        change_settings=in_bresenham(
            ("not abs(y1 - y0) < abs(x1 - x0)", "False"), other=("abs(y1 - y0) > abs(x1 - x0)", "False")
        ),
    ),
    Twin(
        "ends-not-ordered",
        "The ends were not exchanged, so a line from right to left is not drawn.",
        line(((9, 4), (1, 1))),
        GENTLE,
        change_settings=in_bresenham(
            ("if x0 > x1:", "if False:"), other=("dx, dy = abs(x1 - x0)", "dx, dy = x1 - x0")
        ),
    ),
    Twin(
        "slope-always-up",
        "The line rises although it should fall: with a negative slope y steps by -1.",
        line(((1, 4), (9, 1))),
        GENTLE,
        change_settings=in_both("(-1 if y1 < y0 else 1)", "1"),
    ),
    Twin(
        "start-not-doubled",
        "D began at dy - dx, but its steps are doubled: it begins at 2 dy - dx.",
        GENTLE,
        line(((1, 2), (9, 2))),
        change_settings=in_both("D = 2 * dy - dx", "D = dy - dx"),
    ),
    Twin(
        "last-pixel-lost",
        "The last pixel is missing. This version draws it.",
        GENTLE,
        OUT_OF_SIGHT,
        change_settings=in_bresenham(("x <= x1", "x < x1"), other=("dx + last_pixel", "dx")),
    ),
    Twin(
        "first-pixel-lost",
        "The first pixel is missing. This version draws it.",
        GENTLE,
        OUT_OF_SIGHT,
        change_settings=in_both(DRAW, f"if x != x0: {DRAW}"),
    ),
    Twin(
        "ends-at-full",
        "The columns of the ends have all of their intensity. They have the share of the column that the line spans.",
        Case(segment_scene([((1.8, 2.1), (8.9, 4.7))], (16, 12)), Settings(line="wu"), intensities),
        Case(segment_scene([((1, 2.1), (9, 4.7))], (16, 12)), Settings(line="wu"), intensities),
        change_settings=edited("line", "wu", ("I = part * g", "I = part if g > 0 else 0.0")),
    ),
    Twin(
        "row-truncated",
        "The row was truncated. The nearest row is floor(y + 1/2).",
        GENTLE,
        line(((1, 1), (6, 6))),
        change_settings=in_both(DRAW, f"pixels.append(({ROW}, x, D) if is_steep else (x, {ROW}, D))"),
    ),
)
