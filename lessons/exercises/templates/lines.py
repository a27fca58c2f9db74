"""Bresenham's line as printed (LMU): its pixels, and its table of D."""

from collections.abc import Sequence
from fractions import Fraction

from core import Settings, draw_lines
from lessons.exercises.answers.cells import Value
from lessons.exercises.answers.fields import Column, Row, Rows, TableAnswer, number_rows
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.drawn_scene import window_text
from lessons.exercises.draws import Draws
from lessons.exercises.question import Draft, template
from lessons.exercises.templates.drafting import drafted, listed
from lessons.mistakes.lines import LECTURE
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import line_pixels, segment_ends
from lessons.small_scenes import pixel_segments

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
    decisions = draw_lines(segment_ends(pixel_segments([ends], TALL)), *TALL, settings.line).steps.decision
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
