"""Lines: Bresenham's pixels and its table of D, octants, DDA, the error, ties, listings as printed, Wu."""

from collections.abc import Sequence
from fractions import Fraction
from math import floor

from core import Settings, draw_lines
from lessons.exercises.answers.answer import Value
from lessons.exercises.answers.fields import Column, Row, Rows, TableAnswer, empty_rows, followed, number_rows
from lessons.exercises.answers.marked import PixelAnswer
from lessons.exercises.drafting import (
    drafted,
    factor_text,
    listed,
    numbers,
    place_text,
    run_exactly,
    table,
    window_text,
)
from lessons.exercises.numbers import Draws, number_text, reject
from lessons.exercises.question import Draft, template
from lessons.lectures.catalogue import printed_listing
from lessons.mistakes.scan_conversion import LECTURE
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import in_window, line_pixels
from lessons.small_scenes import pixel_segments, segment_scene

# Bresenham's line as printed (LMU): its pixels, and its table of D.


Ends = tuple[tuple[int, int], tuple[int, int]]
SIZE = (14, 9)
TALL = (14, 32)
"""A window that a line which steps too often does not leave."""
RULE = (
    "Bresenham's line begins with D = 2 dy - dx. Where D > 0, y steps up and 2 dx is subtracted from D; in any case "
    "2 dy is added. The last pixel is drawn."
)


def d_values(ends: Ends, settings: Settings) -> Rows:
    """Return D before each move of a line from left to right."""
    decisions = draw_lines(in_window(pixel_segments([ends], TALL)), *TALL, settings.line).steps.decision
    return number_rows([[int(value)] for value in decisions[1:]])


def d_table(ends: Ends) -> TableAnswer:
    """Return the table of D before each move, with follow-through."""
    (x0, y0), (x1, y1) = ends
    dx, dy = x1 - x0, y1 - y0

    def follow(own: Sequence[Row], row: int, mine: Row) -> Value:
        if row == 0:
            return Fraction(2 * dy - dx)
        before = own[-1][0]
        return before + 2 * dy - (2 * dx if before > 0 else 0)

    labels = tuple(f"at x = {x}" for x in range(x0, x1))
    return TableAnswer((Column("D"),), labels, d_values(ends, LECTURE), follow)


def gentle_ends(draws: Draws) -> Ends:
    """Draw a gentle line that rises from left to right."""
    dx = draws.whole(6, 10)
    dy = draws.whole(1, min(dx - 1, 6))
    x0, y0 = draws.whole(0, 3), draws.whole(0, 2)
    return (x0, y0), (x0 + dx, y0 + dy)


def moves_text(start: tuple[int, int], end: tuple[int, int]) -> str:
    """Return dx and dy as expressions in numbers."""
    return f"dx = {end[0]} - {start[0]}, dy = {end[1]} - {start[1]}"


def of_segments(
    asked: str, segments: list[Ends], names: tuple[str, ...], direction: tuple[int, int] | None = None
) -> Draft:
    """Ask for the pixels of segments by the lecture's Bresenham; of one in the ``direction`` that it is drawn in."""
    scene = pixel_segments(segments, SIZE)
    wrong = {name: line_pixels(scene, SHELF[name].change_settings(LECTURE)) for name in names}
    answer = PixelAnswer(SIZE, line_pixels(scene, LECTURE), direction=direction)
    given = f"{window_text(SIZE)}\n" + listed("From pixel {} to pixel {}.", *zip(*segments, strict=True))
    return drafted(asked, given, answer, wrong, scene, LECTURE)


@template("bresenham-pixels", 2, "Pixels of Bresenham's line", "raster", 4)
def draw_pixels(draws: Draws) -> Draft:
    """Pixels of a line."""
    ends = gentle_ends(draws)
    names = (
        "ties-step",
        "not-corrected",
        "start-not-doubled",
        "row-truncated",
        "last-pixel-lost",
        "first-pixel-lost",
    )
    (x0, y0), (x1, y1) = ends
    asked = f"""Which pixels does the line draw? {RULE}
        Hint: One pixel in every column, from the first end to the second.
        Hint: Keep D beside each pixel; its sign chooses the row of the next one.
        Hint: {moves_text(*ends)}."""
    return of_segments(asked, [ends], names, (x1 - x0, y1 - y0))


@template("bresenham-table", 1, "Bresenham's D", "raster", 4)
def draw_table(draws: Draws) -> Draft:
    """D before each move."""
    ends = gentle_ends(draws)
    names = ("ties-step", "not-corrected", "start-not-doubled")
    wrong = {name: d_values(ends, SHELF[name].change_settings(LECTURE)) for name in names}
    asked = f"""What is D before each move? {RULE}
        Hint: Begin with the D of the first pixel.
        Hint: Each D follows from the one before: its sign decides whether 2 dx is subtracted.
        Hint: {moves_text(*ends)}: add 2 dy every time."""
    given, scene = f"From pixel {ends[0]} to pixel {ends[1]}.", pixel_segments([ends], SIZE)
    return drafted(asked, given, d_table(ends), wrong, scene, LECTURE)


# Lines beyond the first octant: DDA, the error e, ties, listings as printed, Wu, values along a line.


HALF = Fraction(1, 2)
WINDOW = window_text(SIZE)


def slope(ends: Ends) -> Fraction:
    """Return dy/dx."""
    (x0, y0), (x1, y1) = ends
    return Fraction(y1 - y0, x1 - x0)


@template("line-octants", 2, "Lines in other octants", "raster", 4)
def draw_octants(draws: Draws) -> Draft:
    """A steep line, and one that falls from right to left."""
    steep: Ends = ((draws.whole(0, 3), 0), (draws.whole(4, 6), draws.whole(7, 8)))
    x0 = draws.whole(12, 13)
    falling: Ends = ((x0, draws.whole(0, 3)), (draws.whole(4, 6), draws.whole(5, 8)))
    asked = f"""Which pixels do the two lines draw? Where |dy| is not below |dx|, x and y exchange their
        parts; lines are drawn from left to right (steep ones upwards), and with a negative slope y steps by
        -1. {RULE}
        Hint: Which of the lines is steep?
        Hint: A steep line has one pixel in every row.
        Hint: The steep one: {moves_text(*steep)}, which exchange their parts. The other one, from
        {falling[1]}: {moves_text(*falling[::-1])}."""
    return of_segments(asked, [steep, falling], ("one-octant", "ends-not-ordered", "slope-always-up"))


@template("line-from-right", 2, "A line given from the right", "raster", 3)
def draw_direction(draws: Draws) -> Draft:
    """A line with ties, given from right to left."""
    start, end = gentle_ends(draws)
    asked = f"""Which pixels does the line draw? Lines are drawn from left to right, whichever end comes
        first. {RULE}
        Hint: Exchange the ends.
        Hint: Is D zero somewhere?
        Hint: From {start}: {moves_text(start, end)}. Where D = 0, y does not step."""
    direction = end[0] - start[0], end[1] - start[1]
    return of_segments(asked, [(end, start)], ("from-other-end", "last-pixel-lost"), direction)


@template("dda-table", 1, "y and rows of a DDA", "raster", 4)
def draw_dda(draws: Draws) -> Draft:
    """The y and the row in every column."""
    ends = gentle_ends(draws)
    m, (x0, y0) = slope(ends), ends[0]
    listed_pixels = run_exactly("line", "dda", *ends[0], *ends[1], True)

    def follow(own: Sequence[Row], number: int, mine: Row) -> Fraction:
        if not mine:
            return own[-1][0] + m if number else Fraction(y0)
        return Fraction(floor(mine[0] + HALF))

    right = [[y, row] for _, row, y in listed_pixels]
    wrong = {"row-truncated": [[y, floor(y)] for y, _ in right]}
    asked = f"""Fill in y and the row of each pixel of this line by a DDA: y grows by m = dy/dx in every
        column, and the row is floor(y + 1/2).
        Hint: What is m?
        Hint: Add m once for every column.
        Hint: Round y to the nearest row; a half goes up.
        Hint: m = ({ends[1][1]} - {y0}) / ({ends[1][0]} - {x0}), and the first y is {y0}."""
    labels = [f"x = {x}" for x, _, _ in listed_pixels]
    given, scene = f"From pixel {ends[0]} to pixel {ends[1]}.", pixel_segments([ends], SIZE)
    return table(asked, given, ("y", "row"), labels, right, wrong, follow, scene, Settings(line="dda"))


@template("error-table", 1, "The error of Bresenham's line", "raster", 3)
def draw_error(draws: Draws) -> Draft:
    """The error e before each move."""
    ends = gentle_ends(draws)
    m = slope(ends)

    def follow(own: Sequence[Row], number: int, mine: Row) -> Fraction:
        if not number:
            return Fraction(0)
        e: Fraction = own[-1][0] + m
        return e - 1 if e > HALF else e

    asked = f"""What is the error e before each move? It begins at 0. Where e + m > 1/2, y steps up and e
        grows by m - 1; else e grows by m. m = dy/dx.
        Hint: What is m?
        Hint: Compare e + m with 1/2.
        Hint: e is where the line runs above the pixel's centre.
        Hint: m = ({ends[1][1]} - {ends[0][1]}) / ({ends[1][0]} - {ends[0][0]}), and the first e is 0."""
    labels = [f"at x = {x}" for x in range(ends[0][0], ends[1][0])]
    right = followed(follow, empty_rows(len(labels), 1))
    given, scene = f"From pixel {ends[0]} to pixel {ends[1]}.", pixel_segments([ends], SIZE)
    return table(asked, given, ("e",), labels, right, None, follow, scene, LECTURE)


@template("printed-line", 2, "A listing with a slip", "raster", 4)
def draw_printed(draws: Draws) -> Draft:
    """A listing that slips."""
    printed = printed_listing(draws.item(("pellacini-dda", "pellacini-bresenham")))
    ends = gentle_ends(draws)
    (x0, y0), (x1, y1) = ends
    listing, meant = next(iter(printed.readings.values())), printed_listing("pellacini-midpoint").readings
    drawn, right = (
        frozenset(pixel[:2] for pixel in rule(*map(Fraction, (x0, y0, x1, y1)), True))
        for rule in (listing, next(iter(meant.values())))
    )
    reject(drawn == right or not all(0 <= y < SIZE[1] for _, y in drawn))
    given = f"{printed.text}\n\n{WINDOW} From ({x0}, {y0}) to ({x1}, {y1})."
    asked = f"""This listing is printed on a slide ({printed.lecture}, {printed.slide}). It slips: which
        pixels does it draw, executed as printed with exact numbers? Pixel centres are whole numbers, write(x,
        y) lights pixel (x, y), and 1/2 is rounded up.
        Hint: Execute it line by line, and do not mend it.
        Hint: When does the loop end, and is what is tested already that of the next column?
        Hint: Begin with x = ceil({x0}), m = ({y1} - {y0}) / ({x1} - {x0}); write x and y down at the top of
        every turn."""
    answer = PixelAnswer(SIZE, drawn, direction=(x1 - x0, y1 - y0))
    return drafted(asked, given, answer)


@template("wu-column", 1, "Two intensities of a column", "raster", 2)
def draw_wu(draws: Draws) -> Draft:
    """Two intensities of a column."""
    ends = gentle_ends(draws)
    (x0, y0), (x1, y1) = ends
    x = draws.whole(x0 + 1, x1 - 1)
    y = y0 + slope(ends) * (x - x0)
    share = y - floor(y)
    reject(not share)
    asked = f"""Wu's line lights two pixels of column {x}, on both sides of the line's y there. What are the
        intensities of the lower one and of the upper one? Pixel centres are whole numbers; the two sum to 1.
        Hint: What is y in this column?
        Hint: The nearer pixel is the brighter one.
        Hint: The upper one has y - floor(y).
        Hint: y = {y0} + ({x} - {x0}) ({y1} - {y0}) / ({x1} - {x0})."""
    scene = pixel_segments([ends], SIZE)
    given = f"From pixel {ends[0]} to pixel {ends[1]}."
    settings = Settings(line="wu")
    return numbers(asked, given, [1 - share, share], None, ("lower", "upper"), None, scene, settings)


@template("wu-end", 1, "The first column of Wu's line", "raster", 3)
def draw_end(draws: Draws) -> Draft:
    """Two intensities of the first column of a line that begins inside of it."""
    x0 = draws.whole(1, 3) + Fraction(draws.whole(6, 9), 10)
    y0 = draws.whole(1, 3) + Fraction(draws.whole(1, 9), 10)
    x1 = draws.whole(9, 12) + HALF
    m = Fraction(draws.whole(1, 3), 4)
    segment = ((float(x0), float(y0)), (float(x1), float(y0 + m * (x1 - x0))))
    column = floor(x0)
    y = y0 + m * (column + HALF - x0) - HALF
    above, share = y - floor(y), column + 1 - x0
    if not above:
        return draw_end(draws)
    given = (
        f"From {place_text((x0, y0))}, slope {number_text(m)}, to the right. Pixel (i, j) has its centre at (i + "
        "1/2, j + 1/2)."
    )
    asked = f"""What are the intensities of the lower and of the upper pixel of column {column} of Wu's line?
        The line spans only a part of this column: both are multiplied by that part. The two are weighed by
        the line's y at the column's centre, in units where pixel centres are whole numbers.
        Hint: Which part of the column does the line span?
        Hint: y at the centre: y0 + m (column + 1/2 - x0), less 1/2.
        Hint: The upper pixel has y - floor(y), the lower one the rest.
        Hint: y = {factor_text(y0)} + {factor_text(m)} ({column} + 1/2 - {factor_text(x0)}) - 1/2."""
    wrong = {"ends-at-full": [1 - above, above]}
    scene, names = segment_scene([segment], SIZE), ("lower", "upper")
    right = [(1 - above) * share, above * share]
    return numbers(asked, given, right, wrong, names, None, scene, Settings(line="wu"))


@template("line-value", 1, "A value along a line", "interpolate", 1)
def draw_value(draws: Draws) -> Draft:
    """A parameter along a line."""
    ends = gentle_ends(draws)
    (x0, _), (x1, _) = ends
    x, q = draws.whole(x0 + 1, x1 - 1), [Fraction(draws.whole(0, 20)) for _ in range(2)]
    s = Fraction(x - x0, x1 - x0)
    given = f"From pixel {ends[0]}, q = {number_text(q[0])}, to pixel {ends[1]}, q = {number_text(q[1])}."
    asked = f"""A parameter q is interpolated linearly along this line. What is it at the pixel of column {x}?
        Hint: Which share s of the way lies behind this column?
        Hint: q = q0 (1 - s) + q1 s.
        Hint: s = ({x} - {x0}) / ({x1} - {x0}), q0 = {number_text(q[0])}, q1 = {number_text(q[1])}."""
    return numbers(asked, given, [q[0] * (1 - s) + q[1] * s], scene=pixel_segments([ends], SIZE))
