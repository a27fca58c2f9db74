"""Listings that must draw something else: dashed, open and thick lines, striped and left-out triangles."""

from dataclasses import replace

from lessons.exercises.coding.lines import DRAW, LECTURE
from lessons.exercises.coding.task import Task
from lessons.exercises.coding.triangles import INSIDE


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
TASKS = (DASHES, OPEN_ENDS, THICK, STRIPES, AROUND)
