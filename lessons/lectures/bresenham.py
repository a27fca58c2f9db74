"""LMU's chain of rewritings of Bresenham's line, from the naive version to integers, and its case dy < 0."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import nan

from core.lines.bresenham import ERROR_TEST as TEST
from core.lines.bresenham import LENGTHS, STEP
from core.lines.bresenham import TEST as SUM_TEST
from core.lines.line_method import NEXT, PLOT, SLOPE, START, advance, correct, first_sum
from core.methods import table
from lessons.lectures.printed import Listed, ListedLines, Operations, PrintedListing, SlideNumber

SLIDE = "Draw A Line from(x0, y0) to (x1, y1), 0<= slope <=1"
RISING = tuple((0, 0, dx, dy) for dx in range(1, 60) for dy in range(dx + 1))
"""The 1,829 lines from (0, 0) to (dx, dy), 0 <= dy <= dx <= 59, but for the point."""
FALLING = tuple((0, 0, dx, -dy) for dx in range(1, 60) for dy in range(1, dx + 1))
"""The 1,770 lines from (0, 0) to (dx, -dy), 1 <= dy <= dx <= 59."""


def naive(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the naive version."""
    pixels, chosen_by = [], nan
    e = 0.0  #: first-sum
    m = (y1 - y0) / (x1 - x0)  #: slope
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = e + m
        if e + m <= 0.5:  #: test
            x += 1  #: next
            e += m  #: advance
        else:
            x += 1  #: next-step
            y += 1  #: step
            e += m - 1  #: advance-step
    return pixels


def common_steps(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the version with what both cases have in common taken out."""
    pixels, chosen_by = [], nan
    e = 0.0  #: first-sum
    m = (y1 - y0) / (x1 - x0)  #: slope
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = e + m
        if e + m <= 0.5:  #: test
            pass
        else:
            y += 1  #: step
            e -= 1  #: correct
        e += m  #: advance
        x += 1  #: next
    return pixels


def one_case(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the version with one case only."""
    pixels, chosen_by = [], nan
    e = 0.0  #: first-sum
    m = (y1 - y0) / (x1 - x0)  #: slope
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = e + m
        if e + m > 0.5:  #: test
            y += 1  #: step
            e -= 1  #: correct
        e += m  #: advance
        x += 1  #: next
    return pixels


def without_division(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the version whose test is multiplied by 2 dx."""
    pixels, chosen_by = [], nan
    e = 0.0  #: first-sum
    dy, dx = y1 - y0, x1 - x0  #: lengths
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = 2 * e * dx + 2 * dy - dx
        if 2 * e * dx + 2 * dy - dx > 0:  #: test
            y += 1  #: step
            e -= 1  #: correct
        e += dy / dx  #: advance
        x += 1  #: next
    return pixels


def with_d(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the version with the constant part in D, read as 2 dy - dx."""
    pixels, chosen_by = [], nan
    e = 0.0  #: first-sum
    dy, dx = y1 - y0, x1 - x0  #: lengths
    D = 2 * dy - dx
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = 2 * e * dx + D
        if 2 * e * dx + D > 0:  #: test
            y += 1  #: step
            e -= 1  #: correct
        e += dy / dx  #: advance
        x += 1  #: next
    return pixels


def with_d_of_x(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the version with the constant part in D, read as 2 dy - x, with x = x0."""
    pixels, chosen_by = [], nan
    e, dy, dx = 0.0, y1 - y0, x1 - x0
    x, y = x0, y0
    D = 2 * dy - x
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = 2 * e * dx + D
        if 2 * e * dx + D > 0:  #: test
            y += 1  #: step
            e -= 1  #: correct
        e += dy / dx  #: advance
        x += 1  #: next
    return pixels


def final(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the final version, read with ``D -= 2*dx``."""
    pixels, chosen_by = [], nan
    dy, dx = y1 - y0, x1 - x0  #: lengths
    D = 2 * dy - dx  #: first-sum
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = D
        if D > 0:  #: test
            y += 1  #: step
            D -= 2 * dx  #: correct
        D += 2 * dy  #: advance
        x += 1  #: next
    return pixels


def final_with_assignment(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the final version, read with ``D = 2*dx``."""
    pixels, chosen_by = [], nan
    dy, dx = y1 - y0, x1 - x0  #: lengths
    D = 2 * dy - dx  #: first-sum
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = D
        if D > 0:  #: test
            y += 1  #: step
            D = 2 * dx
        D += 2 * dy  #: advance
        x += 1  #: next
    return pixels


def falling(x0: int, y0: int, x1: int, y1: int, last_pixel: bool) -> Listed:
    """Listing of the case dy < 0; D starts at 2 dy - dx, which is below -dx."""
    pixels, chosen_by = [], nan
    dy, dx = y1 - y0, x1 - x0  #: lengths
    D = 2 * dy - dx  #: first-sum
    x, y = x0, y0  #: start
    while x <= x1:
        pixels.append((x, y, chosen_by))  #: draw
        chosen_by = D
        if D > 0:  #: test
            y -= 1  #: step
            D -= 2 * dx  #: correct
        D -= 2 * dy  #: advance
        x += 1  #: next
    return pixels


def unlike(listing: Callable[..., Listed], lines: tuple[tuple[int, int, int, int], ...] = RISING) -> int:
    """Count the lines that a listing draws otherwise than the integer version."""
    right = table.get("line", "bresenham-lecture").listing
    assert right is not None
    return sum(
        [pixel[:2] for pixel in listing(*ends, True)] != [pixel[:2] for pixel in right(*ends, True)]
        for ends in lines
    )


def missed_ends(listing: Callable[..., Listed], lines: tuple[tuple[int, int, int, int], ...]) -> int:
    """Count the lines whose last pixel is not their second end."""
    return sum(listing(*ends, True)[-1][:2] != ends[2:] for ends in lines)


def start_of_d(ends: tuple[int, int, int, int]) -> int:
    """Return D at the first decision of the integer version that is right."""
    right = table.get("line", "bresenham-lecture").listing
    assert right is not None
    return int(right(*ends, True)[0][2])


def _counted(slide: str, what: str, number: int, compute: Callable[[], int]) -> SlideNumber:
    return SlideNumber("LMU", slide, what, number, compute, is_counted=True)


def _version(
    name: str,
    title: str,
    text: str,
    tie: float,
    counts: dict[str, tuple[Callable[..., Listed], int]],
    rows: tuple[Operations, ...],
    doubt: str = "",
    read: tuple[str, str] = ("", ""),
) -> PrintedListing:
    """Return a version of the chain; ``counts`` has each reading and how many of ``RISING`` it draws otherwise."""
    numbers = tuple(
        _counted(
            SLIDE,
            f"{name}, read {reading}: lines of 1,829 unlike the integer version",
            n,
            partial(unlike, run),
        )
        for reading, (run, n) in counts.items()
    )
    readings = {reading: run for reading, (run, _) in counts.items()}
    rule = ListedLines(next(iter(readings.values())), tie, takes_pixels=True)
    like = "bresenham-float" if tie else "bresenham-lecture"
    right, shown = "bresenham-lecture", (name, title, "LMU", SLIDE, text, "line")
    return PrintedListing(*shown, right, readings, doubt, numbers, rule, rows, read, like)


NAIVE_TEXT = """\
let e = 0, m = (y1-y0)/(x1-x0)  #: first-sum slope
for (let x = x0, y = y0; x <= x1; ) {  #: start
   draw(x, y)  #: draw
   // how to update x and y?
   if (e+m <= 0.5) {  #: test
       x += 1  #: next
       e += m  #: advance
   } else {
       x += 1  #: next-step
       y += 1  #: step
       e += m-1  #: advance-step
   }
}"""
COMMON_TEXT = """\
let e = 0, m = (y1-y0)/(x1-x0)  #: first-sum slope
for (let x = x0, y = y0; x <= x1; x++) {  #: start next
   draw(x, y)  #: draw
   // how to update x and y?
   if (e+m <= 0.5) {  #: test
   } else {
       v += 1  #: step
       e -= 1  #: correct
   }
   e += m  #: advance
}"""
ONE_CASE_TEXT = """\
let e = 0, m = (y1-y0)/(x1-x0)  #: first-sum slope
for (let x = x0, y = y0; x <= x1; x++) {  #: start next
   draw(x, y)  #: draw
   // how to update x and y?
   if (e+m > 0.5) {  #: test
       v += 1  #: step
       e -= 1  #: correct
   }
   e += m  #: advance
}"""
WITHOUT_DIVISION_TEXT = """\
let e = 0, dy = y1-y0, dx = x1-x0  #: first-sum lengths
for (let x = x0, y = y0; x <= x1; x++) {  #: start next
   draw(x, y)  #: draw
   // how to update x and y?
   if (2*e*dx+2*dy-dx > 0) {  #: test
       y += 1  #: step
       e -= 1  #: correct
   }
   e += dy/dx  #: advance
}"""
WITH_D_TEXT = """\
let e=0, dy=y1-y0, dx=x1-x0, D=2*dy-x  #: first-sum lengths
for (let x = x0, y = y0; x <= x1; x++) {  #: start next
   draw(x, y)  #: draw
   // how to update x and y?
   if (2*e*dx+D > 0) {  #: test
       y += 1  #: step
       e -= 1  #: correct
   }
   e += dy/dx  #: advance
}"""
FINAL_TEXT = """\
let dy = y1-y0, dx = x1-x0, D=2*dy-dx  #: lengths first-sum
for (let x = x0, y = y0; x <= x1; x++) {  #: start next
   draw(x, y)  #: draw
   // how to update x and y?
   if (D > 0) {  #: test
       y += 1  #: step
       D = 2*dx  #: correct
   }
   D += 2*dy  #: advance
}"""
FALLING_TEXT = """\
let dy = y1-y0, dx = x1-x0, D=2*dy-dx  #: lengths first-sum
for (let x = x0, y = y0; x <= x1; x++) {  #: start next
    draw(x, y)  #: draw
    // how to update x and y?
    if (D > 0) {  #: test
        y -= 1  #: step
        D -= 2*dx  #: correct
    }
    D -= 2*dy  #: advance
}"""
_SLOPE_ROW, _LENGTHS_ROW = (first_sum("e"), SLOPE, START, PLOT), (first_sum("e"), LENGTHS, START, PLOT)
NAIVE_ROWS = (
    _SLOPE_ROW,
    (TEST, NEXT, advance("e"), PLOT),
    (TEST, replace(NEXT, label="next-step"), STEP, replace(advance("e"), label="advance-step"), PLOT),
)
ERROR_ROWS, DIVIDED_ROWS = (
    (first, (TEST, advance("e"), NEXT, PLOT), (TEST, STEP, correct("e"), advance("e"), NEXT, PLOT))
    for first in (_SLOPE_ROW, _LENGTHS_ROW)
)
D_ROWS = (
    (LENGTHS, first_sum("D"), START, PLOT),
    (SUM_TEST, advance("D"), NEXT, PLOT),
    (SUM_TEST, STEP, correct("D"), advance("D"), NEXT, PLOT),
)
"""What the rows of the versions do."""
AS_Y = ("v +=", "y +=")
V_IS_Y = "v += 1: v is declared nowhere, so this would not run; read as y += 1."

CHAIN = (
    _version(
        "lmu-naive", "Bresenham, naive version", NAIVE_TEXT, 0.5, {"as printed": (naive, 207)}, NAIVE_ROWS
    ),
    _version(
        "lmu-common-steps",
        "Bresenham, common steps taken out",
        COMMON_TEXT,
        0.5,
        {"y += 1": (common_steps, 212)},
        ERROR_ROWS,
        V_IS_Y,
        AS_Y,
    ),
    _version(
        "lmu-one-case",
        "Bresenham, one case",
        ONE_CASE_TEXT,
        0.5,
        {"y += 1": (one_case, 212)},
        ERROR_ROWS,
        V_IS_Y,
        AS_Y,
    ),
    _version(
        "lmu-without-division",
        "Bresenham, test multiplied by 2 dx",
        WITHOUT_DIVISION_TEXT,
        0.0,
        {"as printed": (without_division, 221)},
        DIVIDED_ROWS,
    ),
    _version(
        "lmu-with-d",
        "Bresenham, constant part in D",
        WITH_D_TEXT,
        0.0,
        {"D=2*dy-dx": (with_d, 223), "D=2*dy-x": (with_d_of_x, 1711)},
        DIVIDED_ROWS,
        "D=2*dy-x: x is not declared yet; the versions beside it have dx. Run with both.",
        ("D=2*dy-x", "D=2*dy-dx"),
    ),
    _version(
        "lmu-final",
        "Bresenham, final version",
        FINAL_TEXT,
        0.0,
        {"D -= 2*dx": (final, 0), "D = 2*dx": (final_with_assignment, 1710)},
        D_ROWS,
        "D = 2*dx: the next slide and the algebra have D -= 2*dx. Run with both.",
        ("D = 2*dx", "D -= 2*dx"),
    ),
)
"""The six versions in the order of the slide's arrows."""

FALLING_CASE = PrintedListing(
    "lmu-falling",
    "Bresenham, dy < 0",
    "LMU",
    "Bresenham Algorithm (cont.)",
    FALLING_TEXT,
    "line",
    "bresenham-lecture",
    {"as printed": falling},
    numbers=(
        _counted(
            "Bresenham Algorithm (cont.)",
            "dy < 0, D starts at 2dy - dx: missed second ends of 1,770",
            1364,
            partial(missed_ends, falling, FALLING),
        ),
        SlideNumber(
            "LMU",
            "Bresenham Algorithm (cont.)",
            "dy < 0: D at the start of (0, 0)-(5, -2)",
            -9,
            partial(start_of_d, (0, 0, 5, -2)),
            right=-1,
        ),
    ),
    rule=ListedLines(falling, 0.0, takes_pixels=True, rises=False),
    rows=D_ROWS,
    like="bresenham-lecture",
)
