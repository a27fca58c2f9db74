"""Scan-line visible surfaces: one row, its spans, and what is compared at their ends."""

from lessons.exercises.drafting import by_rule, listed
from lessons.exercises.numbers import Draws
from lessons.exercises.question import Draft, template
from lessons.mistakes.scan_lines import HandSpan

NAMES = tuple("ABC")


def _given(spans: tuple[HandSpan, ...], has_depths: bool) -> str:
    """Return the spans of a row as lines."""
    columns = [f"columns {span.left} to {span.right - 1}" for span in spans]
    depths = [
        f", depth {span.depth} at its first centre, {span.slope:+d} per column" if has_depths else ""
        for span in spans
    ]
    return listed("{}: {}{}", NAMES, columns, depths)


@template("row-of-spans", 1, "One row of two surfaces", "depth", 2)
def draw_row(draws: Draws) -> Draft:
    """How many pixels of a row show each of two crossing surfaces."""
    left, length = draws.whole(1, 4), draws.whole(6, 9)
    first = HandSpan(0, left + length - draws.whole(1, 2), draws.whole(20, 26), -1)
    second = HandSpan(left, left + length, first.depth_at(left) + draws.whole(1, 3), -2)
    spans = (first, second)
    names = ("nearest-at-left", "nearest-at-own-start")
    asked = f"""The spans of two surfaces in one row, with their depths: smaller is nearer, and of equal depths A
        stays. How many pixels of the row show A, and how many B?
        Hint: Between which ends are both live?
        Hint: Compare them at the first and at the last centre there, and find where they change places.
        Hint: At column {left} A has depth {first.depth} - {left}, and B has depth {second.depth}."""
    return by_rule(asked, _given(spans, True), (spans,), names, ("A", "B"))


@template("depths-of-a-row", 1, "Depths that a row needs", "depth", 2)
def draw_work(draws: Draws) -> Draft:
    """Segments of a row, and the depths at their ends."""
    first = draws.whole(3, 5)
    middle, end = first + draws.whole(3, 5), first + draws.whole(9, 12)
    spans = (
        HandSpan(draws.whole(0, 1), middle, 5, 0),
        HandSpan(middle, end, 5, 0),
        HandSpan(first, end - draws.whole(1, 3), 2, 0),
    )
    names = ("closed-spans", "depth-at-each-pixel")
    asked = f"""Three spans of one row. Their ends cut it into segments. At the first and at the last centre of a
        segment, the depth of every live surface is computed; where one alone is live, none is. C is nearest
        wherever it is, so nothing is halved. How many segments with a live surface are there, and how many depths?
        Hint: Sort all ends: the first columns, and the columns after the last ones.
        Hint: A segment with one surface needs no depth. How many have two?
        Hint: Each segment with two surfaces needs 2 times 2 depths, one of a single pixel 2. A ends before column
        {middle}, where B begins."""
    return by_rule(asked, _given(spans, False), (spans,), names, ("segments", "depths"))
