"""Beliefs about pixels, ties, lines and blocks."""

from core import Settings
from lessons.exercises.draws import Draws
from lessons.exercises.question import Draft, Template
from lessons.exercises.refutation import Refutation
from lessons.exercises.templates.believing import believed
from lessons.exercises.templates.coverage import SIZE
from lessons.small_scenes import pixel_segments, rectangle_corners, triangle_scene

TESTED = Settings(fill="bounding-box")


def draw_square(draws: Draws) -> Draft | None:
    """A pixel is a little square."""
    share, column = draws.item((40, 42, 44, 46, 48)), draws.whole(3, 8)
    # The right edge leans, so that the pixel is tested, and covers the share of it.
    low, high = (column + share / 100 + (y - 4.5) / 10 for y in (-20, 30))
    scene = triangle_scene([[(low, -20), (high, 30), (column - 20, 5)]], SIZE)
    refutation = Refutation(
        "A pixel is its centre: the centre lies outside of the edge, so nothing of the pixel is drawn.",
        scene,
        "raster",
        f"not covered and column == {column} and row == 4",
        TESTED,
    )
    text = (
        f"A triangle covers {share} percent of the area of pixel ({column}, 4), but not its centre. "
        "With one sample a pixel, is the pixel drawn?"
    )
    hints = (
        "What does the coverage test look at?",
        "Area counts only where it is measured, as by many samples.",
        f"The centre is ({column} + 1/2, 4 + 1/2): is it inside?",
    )
    beliefs = ["yes: much of its square is covered"]
    others = [f"with {share} percent of the colour"]
    return believed(draws, text, "no", beliefs, others, refutation, hints)


def draw_sample_point(draws: Draws) -> Draft | None:
    """The pixel's name is its sample point."""
    column, row = draws.whole(1, 6), draws.whole(1, 4)
    refutation = Refutation(
        f"Pixel ({column}, {row}) reaches from its lower left corner to the next, and its centre is sampled.",
        triangle_scene([[(0, 0), (11, 0), (0, 9)]], SIZE),
        "raster",
        f"column == {column} and row == {row} and x == {column}.5 and y == {row}.5",
        TESTED,
    )
    text = f"Where in the window is pixel ({column}, {row}) sampled, with one sample a pixel?"
    hints = (
        "Which point of a pixel is tested?",
        "A pixel is 1 wide: where does it begin, where is its middle?",
        f"It reaches from {column} to {column} + 1 in x, and from {row} to {row} + 1 in y.",
    )
    names = [
        f"({x}, {y})"
        for x, y in ((column + 0.5, row + 0.5), (column, row), (column + 1, row + 1), (column + 0.5, row))
    ]
    return believed(draws, text, names[0], names[1:2], names[2:], refutation, hints)


def draw_rounding(draws: Draws) -> Draft | None:
    """Rounding the vertices removes cracks."""
    side = draws.whole(4, 7)
    refutation = Refutation(
        "All corners are whole, and yet centres lie on the common edge: with E > 0 neither triangle takes them.",
        triangle_scene(rectangle_corners(1, 1, 1 + side, 1 + side), SIZE),
        "raster",
        "(tie[0] or tie[1] or tie[2]) and not covered",
        Settings(fill="bounding-box", fill_rule="exclusive"),
    )
    text = (
        f"The corners of a square with side {side} are rounded to whole pixels, alike in both of its triangles. "
        "Does each centre in it belong to exactly one of them?"
    )
    hints = (
        "Where does the diagonal run?",
        "What does rounding decide about a centre on an edge?",
        f"The diagonal runs through {side} centres, and rounding leaves E = 0 there.",
    )
    right, belief = "only with a tie rule as well", "yes: equal corners leave no cracks"
    return believed(draws, text, right, [belief], ["no: rounding opens cracks"], refutation, hints)


def draw_tie(draws: Draws) -> Draft | None:
    """At a tie one pixel is right."""
    x, y = draws.whole(0, 4), draws.whole(0, 3)
    ends = (x, y), (x + 8, y + draws.item((1, 3, 5)))
    refutation = Refutation(
        "Both pixels are equally near the line. D > 0 keeps the row, D >= 0 steps: the stated rule decides.",
        pixel_segments([ends], (14, 10)),
        "raster",
        "is_tie",
        Settings(line="bresenham-lecture"),
    )
    text = f"A line from pixel {ends[0]} to {ends[1]} meets a place with D = 0. Which of the two pixels is right there?"
    hints = (
        "What does D = 0 say about the distances to both centres?",
        "Who can choose between equals?",
        f"With D = 0 the line from {ends[0]} to {ends[1]} runs half way between both: a listing decides by > or >=. "
        "Does the line itself decide?",
    )
    right, belief = "either: the stated rule decides", "the upper one"
    return believed(draws, text, right, [belief], ["the lower one", "both are drawn"], refutation, hints)


def draw_two_steps(draws: Draws) -> Draft | None:
    """Two steps up in a row cannot happen."""
    dx = draws.whole(8, 11)
    dy = dx - draws.whole(1, 2)
    refutation = Refutation(
        "D stays above 0 after the first step here, so y steps again at once.",
        pixel_segments([((0, 0), (dx, dy))], (14, 12)),
        "raster",
        "has_stepped and previous > 0",
        Settings(line="bresenham-lecture"),
    )
    text = f"Bresenham's line from pixel (0, 0) to ({dx}, {dy}): may y step up at two moves in a row?"
    hints = (
        "How many steps up are there, in how many moves?",
        "Follow D over the first three moves.",
        f"D begins with 2 * {dy} - {dx}, grows by 2 * {dy}, and falls by 2 * {dx} after a step up.",
    )
    right, belief = "yes", "no: after a step up the row stays for one move"
    return believed(draws, text, right, [belief], ["only after a tie"], refutation, hints)


def draw_both_ends(draws: Draws) -> Draft | None:
    """A line is the same from both ends."""
    x, y = draws.whole(0, 4), draws.whole(0, 4)
    ends = (x, y), (x + 8, y + 3)
    refutation = Refutation(
        "Where D = 0 the rule steps towards the second end: the way back takes the other of two equal pixels.",
        pixel_segments([ends, ends[::-1]], (14, 10)),
        "raster",
        "is_tie",
        Settings(line="bresenham"),
    )
    text = (
        f"Bresenham's line steps where D >= 0, from the first end to the second. Are its pixels from {ends[0]} to "
        f"{ends[1]} those from {ends[1]} to {ends[0]}?"
    )
    hints = (
        "Where could the two strokes disagree?",
        "Is there a column in which D is 0?",
        f"At D = 0 both ways step: one towards {ends[1]}, the other towards {ends[0]}.",
    )
    right, belief = "all but one", "all: the line is the same"
    return believed(draws, text, right, [belief], ["none but the ends"], refutation, hints)


def draw_block(draws: Draws) -> Draft | None:
    """A block is out if one corner is out."""
    a, b = (draws.item((-1, 1)) * draws.whole(1, 5) for _ in range(2))
    sides = [f"{x} {y}" for x in ("left", "right") for y in ("bottom", "top")]
    right = f"{'right' if a > 0 else 'left'} {'top' if b > 0 else 'bottom'}"
    refutation = Refutation(
        "E is largest at one corner of a block: only if that one is out, all are. Other blocks hold covered pixels.",
        triangle_scene([[(1, 1), (20, 2), (3, 18)]], (24, 24)),
        "bin",
        'kind == "block" and verdict == "leaf"',
        Settings(fill="blocks"),
    )
    text = f"E = {a} x + {b} y + c, inside where E >= 0. At which corner does E < 0 show that a whole block is outside?"
    hints = (
        "At which corner is E largest?",
        "The signs of a and b say in which direction E grows.",
        f"a = {a} is the change to the right, b = {b} the change upwards.",
    )
    others = [corner for corner in sides if corner != right][:2]
    return believed(draws, text, right, ["any corner"], others, refutation, hints)


TEMPLATES = (
    Template("belief-little-square", 1, "Is a pixel a little square?", "raster", 1, draw_square),
    Template("belief-sample-point", 1, "Where is a pixel sampled?", "raster", 1, draw_sample_point),
    Template("belief-rounding", 1, "Does rounding remove cracks?", "edges", 1, draw_rounding),
    Template("belief-tie", 1, "Which pixel is right at a tie?", "raster", 1, draw_tie),
    Template("belief-two-steps", 1, "Two steps up in a row?", "raster", 1, draw_two_steps),
    Template("belief-both-ends", 1, "Is a line the same from both ends?", "raster", 1, draw_both_ends),
    Template("belief-block-corner", 1, "Which corner rejects a block?", "bin", 1, draw_block),
)
