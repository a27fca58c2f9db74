"""Pellacini's loops for a line with a slope from 0 to 1: midpoint, DDA and Bresenham."""

from dataclasses import replace
from math import ceil, floor, nan

from core.raster.lines.bresenham import STEP, TEST
from core.raster.lines.traits import (
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
from core.records.operation import Operation
from lessons.printed.records import (
    Listed,
    ListedLines,
    PrintedListing,
    SlideNumber,
    first_divergence,
    half_up,
)

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
    rows=(
        _FIRST,
        (NEXT, TEST, advance("d"), PLOT),
        (NEXT, TEST, STEP, correct("d"), advance("d"), PLOT),
    ),
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
    rows=(
        _FIRST,
        (NEXT, advance("d"), TEST, PLOT),
        (NEXT, advance("d"), TEST, STEP, correct("d"), PLOT),
    ),
    like="bresenham-float",
    beside=TESTED_FIRST,
)

ALL = (MIDPOINT, DDA, BRESENHAM)
