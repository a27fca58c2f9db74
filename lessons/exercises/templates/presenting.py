"""Frame buffers: when pictures are shown, and where a screen is torn."""

from lessons.exercises.drafting import by_rule
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.presenting import torn_row


@template("swap-times", 1, "When a picture is shown", "resolve", 3)
def draw_swaps(draws: Draws) -> Draft:
    """When two pictures are swapped to the front."""
    refresh, drawing = draws.item((8, 10, 12, 16, 20)), draws.whole(9, 50)
    times = drawing, refresh
    reject(drawing < refresh or drawing % refresh == 0)
    asked = f"""A renderer has two buffers, which are swapped only between two refreshes. It begins picture 1 at 0 ms,
        and each next picture when it has a buffer for it. When are pictures 1 and 2 first shown, in ms?
        Hint: The ends of refreshes are multiples of {refresh} ms.
        Hint: Until a swap both buffers are taken, so the renderer begins picture 2 at the swap.
        Hint: Picture 1 is ready at {drawing} ms: which multiple of {refresh} ms comes next?"""
    given = f"Time to draw a picture: {drawing} ms\nTime of a refresh: {refresh} ms, the first begins at 0 ms"
    mistakes = ("swap-before-ready", "swap-without-waiting", "swap-when-ready")
    return by_rule(asked, given, times, mistakes, ("picture 1, in ms", "picture 2, in ms"))


@template("torn-row", 1, "Where the screen is torn", "resolve", 2)
def draw_torn(draws: Draws) -> Draft:
    """The row at which a swap tears a refresh."""
    refresh, rows = draws.item((10, 16, 20)), draws.item((80, 160, 320, 480))
    drawing = draws.whole(refresh + 1, 2 * refresh - 1)
    row = torn_row(drawing, refresh, rows)[0]
    reject(2 * row == rows or (drawing - refresh) * rows % refresh != 0)
    asked = f"""Two buffers are swapped as soon as a picture is ready. A screen reads its {rows} rows evenly in
        {refresh} ms, from the top. The first picture is ready after {drawing} ms. From which row on does that
        refresh show it? Rows count from the top, from 0.
        Hint: How far is the screen when the picture is ready?
        Hint: The refresh began at {refresh} ms: {drawing} - {refresh} ms ago.
        Hint: The share of the refresh is ({drawing} - {refresh}) / {refresh}, and it has {rows} rows."""
    given = f"Refreshes begin at 0 and at {refresh} ms."
    return by_rule(asked, given, (drawing, refresh, rows), ("torn-share-of-drawing", "torn-from-below"))
