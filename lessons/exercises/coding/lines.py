"""Listings of lines: Bresenham, midpoint and DDA in every octant; and of other pictures: dashed, thick, striped."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import gcd
from typing import Any

from core import Settings
from core.edits.edit import original
from lessons.exercises.coding.task import SIDE, Case, Fault, Shown, Task, in_classes
from lessons.exercises.coding.triangles import INSIDE
from lessons.small_scenes import segment_scene

# Listings of lines: Bresenham, midpoint and DDA, on lines of every octant, with ties, and of one pixel.


Ends = tuple[float, float, float, float]
PIXELS = "the list of pixels"
DRAW = "pixels.append((y, x, D) if is_steep else (x, y, D))"
ROUND = "pixels.append((Y, x, y) if is_steep else (x, Y, y))"
WHILE = "while (x1 - x) * sx > 0 or (last_pixel and x == x1):"
SIGNS = "sx, sy = (-1 if x1 < x0 else 1), (-1 if y1 < y0 else 1)"
SLOPE = "m = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0"
LINE_HINTS = """
    Hint: Draw a short line by hand, and follow the listing beside it.
    Hint: Is it wrong for steep lines, for falling ones, for lines to the left, at ties, or at an end?
    Hint: From (x0, y0) to (x1, y1): what must hold before the loop, in each round, and at the last pixel?"""


def _octant(dx: int, dy: int) -> str:
    """Return the class of a line by its direction."""
    slope = "steep" if abs(dy) > abs(dx) else "gentle"
    return f"{slope} lines {'up' if dy > 0 else 'down'} to the {'right' if dx > 0 else 'left'}"


def is_tied(dx: int, dy: int) -> bool:
    """Return whether a line between centres runs through the middle between two centres somewhere."""
    shared = gcd(dx, dy)
    return shared > 0 and max(abs(dx), abs(dy)) // shared % 2 == 0


def line_classes() -> dict[str, list[Ends]]:
    """Return lines between pixels by class, short ones first."""
    found: dict[str, list[Ends]] = {}
    ways = [(dx, dy) for dx in range(-7, 8) for dy in range(-7, 8)]
    for dx, dy in sorted(ways, key=lambda way: abs(way[0]) + abs(way[1])):
        if (dx, dy) == (0, 0) or (is_tied(dx, dy) and max(abs(dx), abs(dy)) not in (2, 4)):
            continue
        if is_tied(dx, dy):
            name = "ties"
        elif 0 in (dx, dy) or abs(dx) == abs(dy):
            name = "level, upright and diagonal lines"
        elif max(abs(dx), abs(dy)) < 3 or (dx + dy) % 2:
            continue
        else:
            name = _octant(dx, dy)
        x, y = (SIDE - dx) // 2, (SIDE - dy) // 2
        found.setdefault(name, []).append((x, y, x + dx, y + dy))
    found["lines of one pixel"] = [(2, 2, 2, 2), (5, 1, 5, 1), (0, 7, 0, 7)]
    return found


def _case(ends: Ends, last_pixel: bool) -> Case:
    x0, y0, x1, y1 = ends
    without = "" if last_pixel else ", without its last pixel"
    said = f"from ({x0:g}, {y0:g}) to ({x1:g}, {y1:g}){without}"
    return Case((*ends, last_pixel), said, size=abs(x1 - x0) + abs(y1 - y0))


def whole_cases(*, leaves_last: bool) -> dict[str, tuple[Case, ...]]:
    """Return lines between pixels; ``leaves_last``: some are drawn without their last pixel."""
    found = {name: tuple(_case(ends, True) for ends in lines) for name, lines in line_classes().items()}
    if leaves_last:
        lines = [lines[0] for lines in line_classes().values()]
        found["lines without their last pixel"] = tuple(_case(ends, False) for ends in lines)
    return found


def float_cases() -> dict[str, tuple[Case, ...]]:
    """Return lines between centres, and lines with ends beside them."""
    found = {
        name: tuple(_case((x0 + 0.0, y0 + 0.0, x1 + 0.0, y1 + 0.0), True) for x0, y0, x1, y1 in lines)
        for name, lines in line_classes().items()
    }
    beside = [
        (1.25, 2.0, 4.75, 3.125),
        (6.5, 5.25, 2.25, 4.0),
        (3.0, 1.25, 4.125, 6.5),
        (5.25, 7.75, 4.0, 2.5),
    ]
    found["lines with ends beside centres"] = tuple(_case(ends, True) for ends in beside)
    lines = [lines[0] for lines in line_classes().values()]
    found["lines without their last pixel"] = tuple(
        _case((x0 + 0.0, y0 + 0.0, x1 + 0.0, y1 + 0.0), False) for x0, y0, x1, y1 in lines
    )
    return found


def pixels_of(value: Any) -> Any:
    """Return the places of listed pixels from left to right: their order is not seen, nor what chose them."""
    for pixel in value:
        if not isinstance(pixel, list) or len(pixel) not in (2, 3):
            raise ValueError("a pixel of the list must be (x, y), or (x, y) and what chose it")
        if not all(type(number) is int for number in pixel[:2]):
            raise ValueError("the x and y of a pixel must be whole numbers")
    return sorted(pixel[:2] for pixel in value)


def pixels_text(value: Any) -> str:
    """Return pixels in words, the first of many."""
    if not value:
        return "no pixel"
    more = f" and {len(value) - 6} more" if len(value) > 6 else ""
    return ", ".join(f"({x}, {y})" for x, y in value[:6]) + more


def _shown(method: str, case: Case) -> Shown:
    x0, y0, x1, y1 = (number + 0.5 for number in case.values[:4])
    scene = segment_scene([((x0, y0), (x1, y1))], (SIDE + 1, SIDE + 1))
    settings = Settings(line=method)
    return Shown(scene, settings, "line", method, "raster")


def line_task(
    name: str, title: str, purpose: str, cases: Mapping[str, tuple[Case, ...]], faults: tuple[Fault, ...]
) -> Task:
    """Return the task of a line method's listing."""
    listing = original("line", name)
    return Task(
        name,
        "raster",
        title,
        purpose + LINE_HINTS,
        listing.source.replace(f"{name.replace('-', '_')}_listing", "line"),
        cases,
        faults,
        ("[]", "[(floor(x0), floor(y0))]", "[(floor(x0), floor(y0)), (floor(x1), floor(y1))]"),
        "list",
        PIXELS,
        pixels_text,
        listing.function,
        pixels_of,
        shown=lambda case: _shown(name, case),
    )


LECTURE = line_task(
    "bresenham-lecture",
    "Bresenham's line",
    "line lists the pixels of a line between two pixels as (x, y, D), where D is the sum before the step. It draws "
    "from left to right, a steep line from below upwards; D > 0 steps, so a tie does not. The last pixel is always "
    "drawn.",
    whole_cases(leaves_last=False),
    (
        Fault("is_steep = not abs(y1 - y0) < abs(x1 - x0)", "is_steep = False", "one-octant"),
        Fault("x0, y0, x1, y1 = x1, y1, x0, y0", "x0, x1 = x1, x0"),
        Fault("x0, y0, x1, y1 = x1, y1, x0, y0", "x0, y0, x1, y1 = x0, y0, x1, y1", "ends-not-ordered"),
        Fault("sx, sy = 1, (-1 if y1 < y0 else 1)", "sx, sy = 1, 1", "slope-always-up"),
        Fault("D = 2 * dy - dx", "D = dy - dx", "start-not-doubled"),
        Fault("D = 2 * dy - dx", "D = 2 * dx - dy"),
        Fault("while x <= x1:", "while x < x1:", "last-pixel-lost"),
        Fault("if D > 0:", "if D >= 0:", "ties-step"),
        Fault("D -= 2 * dx", "D -= 0", "not-corrected"),
        Fault("D += 2 * dy", "D += dy"),
        Fault(DRAW, DRAW.replace("(y, x, D)", "(x, y, D)")),
    ),
)
BRESENHAM = line_task(
    "bresenham",
    "Bresenham's line in all octants",
    "line lists the pixels of a line between two pixels as (x, y, D), where D is the sum before the step. It draws "
    "from the first end to the second, and D >= 0 steps; last_pixel says whether the last pixel is drawn.",
    whole_cases(leaves_last=True),
    (
        Fault("x0, y0, x1, y1 = y0, x0, y1, x1", "x0, y0, x1, y1 = y0, x0, x1, y1"),
        Fault("dx, dy = abs(x1 - x0), abs(y1 - y0)", "dx, dy = abs(x1 - x0), y1 - y0"),
        Fault(SIGNS, "sx, sy = (-1 if x1 < x0 else 1), 1", "slope-always-up"),
        Fault(SIGNS, "sx, sy = 1, (-1 if y1 < y0 else 1)"),
        Fault("D = 2 * dy - dx", "D = dy - dx", "start-not-doubled"),
        Fault("for _ in range(dx + last_pixel):", "for _ in range(dx):", "last-pixel-lost"),
        Fault("for _ in range(dx + last_pixel):", "for _ in range(dx + 1):"),
        Fault("if D >= 0:", "if D > 0:"),
        Fault("D -= 2 * dx", "D -= dx"),
        Fault("D += 2 * dy", "D += 2 * dx"),
        Fault("x += sx", "x += 1"),
    ),
)
MIDPOINT = line_task(
    "midpoint",
    "the line by its height",
    "line lists the pixels of a line as (x, Y, y): in each column x from the first end to the second, the row Y whose "
    "centre is nearest to the height y = m x + b; in the middle the upper one. Whole coordinates are centres.",
    float_cases(),
    (
        Fault("is_steep = abs(y1 - y0) > abs(x1 - x0)", "is_steep = y1 - y0 > x1 - x0"),
        Fault(SLOPE, "m = (x1 - x0) / (y1 - y0) if y1 != y0 else 0.0"),
        Fault("b = y0 - m * x0", "b = y0 - m"),
        Fault("sx = -1 if x1 < x0 else 1", "sx = 1"),
        Fault("x = ceil(x0) if sx > 0 else floor(x0)", "x = floor(x0)"),
        Fault(WHILE, "while (x1 - x) * sx > 0:", "last-pixel-lost"),
        Fault("Y = floor(y) + (y - floor(y) >= 0.5)", "Y = floor(y)"),
        Fault("Y = floor(y) + (y - floor(y) >= 0.5)", "Y = floor(y) + (y - floor(y) > 0.5)"),
    ),
)
DDA = line_task(
    "dda",
    "the DDA",
    "line lists the pixels of a line as (x, Y, y): in each column x from the first end to the second, the row Y whose "
    "centre is nearest to the height y; in the middle the upper one. From column to column the slope m is added to y. "
    "Whole coordinates are centres.",
    float_cases(),
    (
        Fault("x0, y0, x1, y1 = y0, x0, y1, x1", "x0, y0, x1, y1 = y0, y1, x0, x1"),
        Fault(SLOPE, "m = (y1 - y0) // (x1 - x0) if x1 != x0 else 0.0"),
        Fault("y = m * x + b", "y = y0"),
        Fault(WHILE, "while (x1 - x) * sx > 0:", "last-pixel-lost"),
        Fault("Y = floor(y) + (y - floor(y) >= 0.5)", "Y = floor(y)"),
        Fault("y += m * sx", "y += m"),
        Fault("y += m * sx", "y += sx"),
    ),
)
STEP_CALL = "    y, D = step(y, D, dx, dy, sy)\n"
STEP_LINES = "    if D > 0:\n      y += sy\n      D -= 2 * dx\n    D += 2 * dy\n"


def _step_cases() -> Iterator[tuple[str, Case]]:
    """Yield states of Bresenham's loop by what must happen."""
    for dx, dy, sy in (
        (3, 1, 1),
        (5, 2, 1),
        (5, 3, -1),
        (7, 2, -1),
        (4, 1, 1),
        (2, 1, -1),
        (4, 4, 1),
        (6, 0, 1),
    ):
        y, D = (3 if sy > 0 else 8), 2 * dy - dx
        for _ in range(dx):
            name = "D > 0" if D > 0 else "D = 0" if D == 0 else "D < 0"
            way = "upwards" if sy > 0 else "downwards"
            said = f"y = {y}, D = {D}, dx = {dx}, dy = {dy}, sy = {sy}"
            label = f"{name}, {way}" if D > 0 else name
            yield label, Case((y, D, dx, dy, sy), said)
            if D > 0:
                y, D = y + sy, D - 2 * dx
            D += 2 * dy


def _step_shown(case: Case) -> Shown:
    _, _, dx, dy, sy = case.values
    y0 = 1 if sy > 0 else 1 + dy
    line = Case((1, y0, 1 + dx, y0 + sy * dy, True), "")
    return _shown("bresenham-lecture", line)


STEP = Task(
    "bresenham-step",
    "raster",
    "one step of Bresenham",
    """step is given the row y and the sum D of a pixel, the lengths dx and dy, and sy, 1 or -1. It returns y
    and D of the next column: where D > 0 the row moves by sy and D loses 2 dx; D always gains 2 dy.
    Hint: Which of y and D changes in every step, and which only where D > 0?
    Hint: What is taken from D after a step of y, and what is always added?
    Hint: With dx = 2, dy = 1 and sy = 1, D goes from 0 to 2, and y stays. Follow your lines.""",
    "def step(y, D, dx, dy, sy):\n  if D > 0:\n    y += sy\n    D -= 2 * dx\n  D += 2 * dy\n  return y, D",
    in_classes(_step_cases()),
    (
        Fault("if D > 0:", "if D >= 0:", "ties-step"),
        Fault("D -= 2 * dx", "D -= 0", "not-corrected"),
        Fault("y += sy", "y += 1", "slope-always-up"),
    ),
    ("y, D", "y + sy, D"),
    ("number", "number"),
    "y and D",
    lambda value: f"y = {value[0]:g}, D = {value[1]:g}",
    None,
    shown=_step_shown,
    whole=LECTURE.text.replace(STEP_LINES, STEP_CALL),
)
TASKS = (LECTURE, BRESENHAM, MIDPOINT, DDA, STEP)


# Listings that must draw something else: dashed, open and thick lines, striped and left-out triangles.


def drawn_task(name: str, title: str, asked: str, changes: tuple[tuple[str, str], ...]) -> Task:
    """Return a task that draws something else than a plain line, from Bresenham's listing."""
    text = LECTURE.text
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return replace(LECTURE, name=name, title=title, asked=asked, text=text, faults=(), draws_other=True)


DASHES = drawn_task(
    "dashes",
    "a dashed line",
    """line must list every second pixel of the line: the first, the third and so on, in the order in which it
    is drawn, from left to right, a steep line from below upwards. Which pixels the line has does not change.
    Hint: How does a loop know whether a pixel is the first, the second or the third?
    Hint: x - x0 counts the pixels that are done, also of steep lines: there x and y are exchanged.
    Hint: A number k is even where k % 2 == 0: then k is 0, 2 and so on.""",
    (("while x <= x1:\n", "while x <= x1:\n    if (x - x0) % 2 == 0:\n  "),),
)
THICK = drawn_task(
    "thick-line",
    "a line two pixels thick",
    """line must list two pixels in each column: that of the line, and the one above it. Of a steep line, two
    in each row: that of the line, and the one to its right.
    Hint: Which pixels does one round of the loop list?
    Hint: Of a steep line x and y are exchanged while it is drawn: what is y then?
    Hint: The pixel beside is at y + 1, whichever way the line runs: list 2 pixels a round.""",
    ((DRAW, f"{DRAW}\n    pixels.append((y + 1, x, D) if is_steep else (x, y + 1, D))"),),
)
OPEN_ENDS = drawn_task(
    "open-ends",
    "a line without its ends",
    """line must list the pixels of the line but for the first and the last one. Of a line of one or two
    pixels nothing is left.
    Hint: In which round is the first pixel listed, in which the last one?
    Hint: D must go on as before: leave pixels out, not rounds.
    Hint: The ends have x = x0 and x = x1, also of steep lines: there x and y are exchanged.""",
    (("while x <= x1:\n", "while x <= x1:\n    if x0 < x < x1:\n  "),),
)
STRIPES = replace(
    INSIDE,
    name="stripes",
    title="a striped triangle",
    asked="""covers must draw only the rows of a triangle that have an even number: 0, 2 and so on. It returns
    the three values as before, and whether the pixel is covered; y is the height of the centre, 1/2 above the
    row's number.
    Hint: What does y of a centre say about its row?
    Hint: Two things must hold: the pixel is covered, and its row is even. Join them by and.
    Hint: floor(y) is the number of the row; floor(y) % 2 is 0 in even rows and 1 in odd ones.""",
    text=INSIDE.text.replace("all(inside)", "all(inside) and floor(y) % 2 == 0"),
    faults=(),
    draws_other=True,
)
AROUND = replace(
    INSIDE,
    name="around",
    title="all but a triangle",
    asked="""covers must draw what the box around a triangle has outside of it: a pixel is drawn where the
    triangle does not cover it. It returns the three values as before, and whether the pixel is drawn.
    Hint: Which pixels of the box does the triangle not cover?
    Hint: What does all(inside) say, and what is its opposite?
    Hint: A pixel with inside = [1, 1, 0], as true, true and false, must be drawn.""",
    text=INSIDE.text.replace("all(inside)", "not all(inside)"),
    faults=(),
    draws_other=True,
)
PICTURES = (DASHES, OPEN_ENDS, THICK, STRIPES, AROUND)
