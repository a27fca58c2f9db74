"""Pellacini's lecture: its numbers, and its loops for a line with a slope from 0 to 1."""

from dataclasses import replace
from functools import partial
from math import ceil, floor, nan

import numpy as np

from core import Settings, draw_lines
from core.coverage.edge_formats import inverse_coefficients
from core.culling.culling import PLANES
from core.lines.bresenham import STEP, TEST
from core.lines.drawing import interpolate_line
from core.lines.line_method import (
    EVALUATE,
    FIRST_COLUMN,
    INTERCEPT,
    NEXT,
    PLOT,
    SLOPE,
    advance,
    correct,
    first_sum,
)
from core.methods import table
from core.records.listing import Operation
from core.scene import Camera, triangulate
from core.transform.matrices import projection, transform, viewport
from lessons.lectures.printed import (
    Listed,
    ListedLines,
    PrintedListing,
    SlideNumber,
    first_divergence,
    half_up,
    slide_number,
)
from lessons.small_scenes import clipped_corner_count, distance, is_covered, rounded, triangles

# Pellacini's loops for a line with a slope from 0 to 1: midpoint, DDA and Bresenham.


MIDPOINT_SLIDE, DDA_SLIDE = "midpoint line rasterization", "optimizing midpoint line rasterization"
BRESENHAM_SLIDE = "bresenham's line rasterization"
EXAMPLE = (0.0, 0.0, 5.0, 2.0)
"""A line of slope 0.4."""


def midpoint(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """Listing of the midpoint loop; ``to`` includes floor(x1)."""
    pixels = []
    m = (y1 - y0) / (x1 - x0)
    b = y0 - m * x0
    x = ceil(x0)  #: start
    while x <= floor(x1):
        y = m * x + b  #: evaluate
        pixels.append((x, half_up(y), y))  #: draw
        x += 1  #: next
    return pixels


def dda(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """Listing of the DDA loop, which ends before floor(x1)."""
    pixels = []
    m = (y1 - y0) / (x1 - x0)
    b = y0 - m * x0
    x = ceil(x0)  #: start
    y = m * x + b  #: evaluate
    while x < floor(x1):
        pixels.append((x, half_up(y), y))  #: draw
        y += m  #: advance
        x += 1  #: next
    return pixels


def bresenham(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """Listing of the Bresenham loop, which adds m to d before it tests d."""
    pixels, chosen_by = [], nan
    m = (y1 - y0) / (x1 - x0)
    b = y0 - m * x0
    x = ceil(x0)  #: start
    y = half_up(m * x + b)  #: first-y
    d = m * (x + 1) + b - y  #: first-sum
    while x < floor(x1):
        pixels.append((x, y, chosen_by))  #: draw
        x += 1  #: next
        d += m  #: advance
        chosen_by = d
        if d > 0.5:  #: test
            y += 1  #: step
            d -= 1  #: correct
    return pixels


def bresenham_tested_first(x0: float, y0: float, x1: float, y1: float, last_pixel: bool) -> Listed:
    """Listing of the Bresenham loop with its lines in the order of the slide before it: test, then add m."""
    pixels, chosen_by = [], nan
    m = (y1 - y0) / (x1 - x0)
    b = y0 - m * x0
    x = ceil(x0)  #: start
    y = half_up(m * x + b)  #: first-y
    d = m * (x + 1) + b - y  #: first-sum
    while x < floor(x1):
        pixels.append((x, y, chosen_by))  #: draw
        x += 1  #: next
        chosen_by = d
        if d > 0.5:  #: test
            y += 1  #: step
            d -= 1  #: correct
        d += m  #: advance
    return pixels


def places(pixels: Listed, count: int | None = None) -> tuple[tuple[int, int], ...]:
    """Return columns and rows of the first ``count`` pixels, ``None``: of all."""
    return tuple(pixel[:2] for pixel in pixels[:count])


def first_difference(listing: str) -> tuple[int, tuple[int, int] | None, tuple[int, int] | None]:
    """Return step, printed pixel and right pixel where a loop leaves ``midpoint`` on the line of slope 0.4."""
    found = first_divergence(LOOPS[listing], "midpoint", EXAMPLE)
    assert found is not None, f"{listing} does not differ"
    printed, right = (None if pixel is None else pixel[:2] for pixel in (found.printed, found.right))
    return found.step, printed, right


_LINE = (replace(SLOPE, label=""), replace(INTERCEPT, label=""))
LOOPS = {"dda": dda, "bresenham": bresenham, "bresenham, tested first": bresenham_tested_first}

MIDPOINT = PrintedListing(
    "pellacini-midpoint",
    "Midpoint loop",
    "Pellacini",
    MIDPOINT_SLIDE,
    """\
for x = ceil(x0) to  #: start next
    floor(x1) {
    y = m*x + b  #: evaluate
    write(x, round(y))  #: draw
}""",
    "line",
    "midpoint",
    {"as printed": midpoint},
    numbers=(
        SlideNumber(
            "Pellacini",
            MIDPOINT_SLIDE,
            "pixels of (0, 0)-(5, 2)",
            ((0, 0), (1, 0), (2, 1), (3, 1), (4, 2), (5, 2)),
            lambda: places(midpoint(*EXAMPLE, True)),
            is_counted=True,
        ),
    ),
    rule=ListedLines(midpoint, None, takes_pixels=False),
    rows=((*_LINE, FIRST_COLUMN, EVALUATE, PLOT), (NEXT, EVALUATE, PLOT)),
    like="midpoint",
)

DDA = PrintedListing(
    "pellacini-dda",
    "DDA loop",
    "Pellacini",
    DDA_SLIDE,
    """\
x = ceil(x0)  #: start
y = m*x + b  #: evaluate
while x < floor(x1)
  write(x, round(y), 1)  #: draw
  y += m  #: advance
  x += 1  #: next""",
    "line",
    "midpoint",
    {"as printed": dda},
    numbers=(
        SlideNumber(
            "Pellacini",
            DDA_SLIDE,
            "(0, 0)-(5, 2): first step unlike midpoint; printed, right pixel",
            (5, None, (5, 2)),
            lambda: first_difference("dda"),
            is_counted=True,
        ),
    ),
    rule=ListedLines(dda, None, takes_pixels=False),
    rows=(
        (*_LINE, FIRST_COLUMN, EVALUATE, PLOT),
        (replace(advance("y"), sets={"decision": "y"}), NEXT, PLOT),
    ),
    like="dda",
)

_ADDED_FIRST = """\
  d += m  #: advance
  if d > 0.5  #: test
    y += 1  #: step
    d -= 1  #: correct"""
_TESTED_FIRST = """\
  if d > 0.5  #: test
    y += 1  #: step
    d -= 1  #: correct
  d += m  #: advance"""
_BRESENHAM = """\
x = ceil(x0)  #: start
y = round(m*x + b)  #: first-y
d = m*(x+1)+b-y  #: first-sum
while x < floor(x1)
  write(x, y, 1)  #: draw
  x += 1  #: next
"""
_FIRST = (*_LINE, FIRST_COLUMN, Operation("first-y", "first-y", {"minor": "y"}), first_sum("d"), PLOT)

TESTED_FIRST = PrintedListing(
    "pellacini-bresenham-tested-first",
    "Bresenham loop, tested before m is added",
    "after Pellacini",
    BRESENHAM_SLIDE,
    _BRESENHAM + _TESTED_FIRST,
    "line",
    "midpoint",
    {"tested before m is added": bresenham_tested_first},
    rule=ListedLines(bresenham_tested_first, 0.5, takes_pixels=False),
    rows=(_FIRST, (NEXT, TEST, advance("d"), PLOT), (NEXT, TEST, STEP, correct("d"), advance("d"), PLOT)),
    like="bresenham-float",
)
"""The loop with its lines in the order of the slide before it; no slide prints it."""

BRESENHAM = PrintedListing(
    "pellacini-bresenham",
    "Bresenham loop",
    "Pellacini",
    BRESENHAM_SLIDE,
    _BRESENHAM + _ADDED_FIRST,
    "line",
    "midpoint",
    {"as printed": bresenham, "tested before m is added": bresenham_tested_first},
    "The slide before tests d first: if d > 0.5 then NE: d += m - 1, else E: d += m. Both orders are run.",
    numbers=(
        SlideNumber(
            "Pellacini",
            BRESENHAM_SLIDE,
            "first three pixels of slope 0.4",
            ((0, 0), (1, 1), (2, 1)),
            lambda: places(bresenham(*EXAMPLE, True), 3),
            is_counted=True,
        ),
        SlideNumber(
            "Pellacini",
            BRESENHAM_SLIDE,
            "slope 0.4: first step unlike midpoint; printed, right pixel",
            (1, (1, 1), (1, 0)),
            lambda: first_difference("bresenham"),
            is_counted=True,
        ),
        SlideNumber(
            "Pellacini",
            BRESENHAM_SLIDE,
            "tested before m is added: first step unlike midpoint; printed, right pixel",
            (5, None, (5, 2)),
            lambda: first_difference("bresenham, tested first"),
            is_counted=True,
        ),
    ),
    rule=ListedLines(bresenham, 0.5, takes_pixels=False),
    rows=(_FIRST, (NEXT, advance("d"), TEST, PLOT), (NEXT, advance("d"), TEST, STEP, correct("d"), PLOT)),
    like="bresenham-float",
    beside=TESTED_FIRST,
)

ALL = (MIDPOINT, DDA, BRESENHAM)


# Numbers of Pellacini's lecture: clipping, viewport depth, pixel centres, d of Bresenham, parameters, z
# precision.


NEAR = PLANES.index("near")
WHICH_Z = "which z distance"
A, B, C = (1.0, 1.0), (7.0, 2.0), (3.0, 5.0)


def depth_of_viewport(z: float) -> float:
    """Return the window depth of an NDC z."""
    return float(transform(viewport(8, 6), np.array([[0.0, 0.0, z, 1.0]]))[0, 2])


def decisions() -> tuple[float, ...]:
    """Return d = (x + 1) m + b - y of every step of (0, 0)-(5, 2), by the method ``bresenham-float``."""
    drawn = draw_lines([[[0, 0], [5, 2]]], 8, 8, "bresenham-float", last_pixel=True, pixel_center="integer")
    return rounded(drawn.steps.decision[1:])


def parameters(s: float) -> float:
    """Return q(s) between q0 = 2 and q1 = 10."""
    return float(interpolate_line(np.array([0]), np.array([s]), [[[2.0], [10.0]]])[0, 0])


def weights_of(x: float, y: float) -> tuple[float, ...]:
    """Return alpha, beta and gamma of a point of the plane."""
    inverse, _ = inverse_coefficients([[*corner, 1.0] for corner in (A, B, C)])
    return rounded(np.array([a * x + b * y + c for a, b, c in zip(*inverse, strict=True)]))


def z_of_half_depth() -> float:
    """Return how far from the eye window depth 1/2 lies, near = 1, far = 99."""
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), near=1.0, far=99.0)
    matrix = projection(camera, 1.0)
    return round(float(matrix[2, 3] / matrix[2, 2]), 12)


def center_of_pixel_0() -> float:
    """Return the coordinate of the centre of pixel 0 with centres on integers."""
    return float(table.get("pixel_center", "integer").function())


def covers_corner(column: int, row: int) -> bool:
    """Return whether a pixel is drawn of a triangle with centres on integers and ends on them."""
    scene = triangles(((1.0, 1.0), (5.0, 1.0), (1.0, 5.0)))
    return is_covered(scene, column, row, Settings(pixel_center="integer"))


_number = partial(slide_number, "Pellacini")
NUMBERS = (
    _number("graphics pipeline", "a quad: triangles", 2, lambda: len(triangulate([[0, 1, 2, 3]])[0])),
    _number("point clipping", "(0, 0, -3, 2) and the near plane: w + z", -1.0, distance, (0, 0, -3, 2), NEAR),
    _number(
        "polygon clipping",
        "a triangle with one corner beyond the near plane: corners left",
        4,
        clipped_corner_count,
        [(0, 0, -2, 1), (1, 0, 0, 1), (0, 1, 0, 1)],
        NEAR,
    ),
    _number(
        "polygon clipping",
        "with two corners beyond it: corners left",
        3,
        clipped_corner_count,
        [(0, 0, -2, 1), (1, 0, -2, 1), (0, 1, 0, 1)],
        NEAR,
    ),
    _number("viewport transformation", "depth of z = -1", 0.0, depth_of_viewport, -1.0),
    _number("viewport transformation", "depth of z = 1", 1.0, depth_of_viewport, 1.0),
    _number("rasterization", "centre of pixel 0", 0.0, center_of_pixel_0),
    _number(
        "rasterization", "centres on integers: pixel (1, 1) at the corner (1, 1)", True, covers_corner, 1, 1
    ),
    _number(
        BRESENHAM_SLIDE, "d of slope 0.4; NE: d += m - 1, E: d += m", (0.4, 0.8, 0.2, 0.6, 0.0), decisions
    ),
    _number("interpolating parameters along a line", "q from 2 to 10 at s = 0", 2.0, parameters, 0.0),
    _number("interpolating parameters along a line", "q at s = 1/4", 4.0, parameters, 0.25),
    _number("interpolating parameters along a line", "q at s = 1", 10.0, parameters, 1.0),
    _number(
        "triangle barycentric coordinates",
        "weights of a/2 + b/4 + c/4",
        (0.5, 0.25, 0.25),
        weights_of,
        3.0,
        2.25,
    ),
    _number(
        "triangle barycentric coordinates",
        "weights of a point outside",
        (0.5, 0.75, -0.25),
        weights_of,
        5.0,
        0.75,
    ),
    _number(WHICH_Z, "distance of depth 1/2, near 1, far 99: 2nf/(n + f)", 1.98, z_of_half_depth),
)
