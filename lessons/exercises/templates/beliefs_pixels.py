"""Beliefs about pixels, ties, lines and blocks."""

from core import Settings
from lessons.exercises.drafting import believed
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, Refutation, template
from lessons.exercises.templates.coverage import SIZE
from lessons.exercises.templates.lines import d_values
from lessons.small_scenes import pixel_segments, rectangle_corners, triangle_scene

TESTED = Settings(fill="bounding-box")


@template("belief-little-square", 2, "Is a pixel a little square?", "raster", 1)
def draw_square(draws: Draws) -> Draft:
    """A pixel is a little square."""
    column, is_inside = draws.whole(3, 8), draws.whole(0, 1)
    share = draws.item((20, 25, 30, 35, 40) if is_inside else (40, 42, 44, 46, 48))
    if is_inside:
        # A thin triangle around the centre: in the middle it is half as wide as at its end.
        middle = column + 0.5
        corners = [(middle - share / 100, -15.5), (middle + share / 100, -15.5), (middle, 24.5)]
        right, belief, condition = "yes", "no", "covered"
        sentence = "A pixel is its centre: the centre lies inside, so the whole pixel is drawn."
    else:
        # The right edge leans, so that the pixel is tested, and covers the share of it.
        low, high = (column + share / 100 + (y - 4.5) / 10 for y in (-20, 30))
        corners = [(low, -20), (high, 30), (column - 20, 5)]
        right, belief, condition = "no", "yes", "not covered"
        sentence = (
            "A pixel is its centre: the centre lies outside the edge, so nothing of the pixel is drawn."
        )
    refutation = Refutation(
        sentence,
        triangle_scene([corners], SIZE),
        "raster",
        f"{condition} and column == {column} and row == 4",
        TESTED,
    )
    asked = f"""A triangle covers {share} percent of the area of pixel ({column}, 4),
        {("but not", "and also")[is_inside]} its centre. With one sample a pixel, is the pixel drawn?
        Hint: What does the coverage test look at?
        Hint: Area counts only where it is measured, as by many samples.
        Hint: The centre is ({column} + 1/2, 4 + 1/2): is it inside?"""
    return believed(draws, asked, right, [belief], [f"with {share} percent of the colour"], refutation)


@template("belief-sample-point", 1, "Where is a pixel tested?", "raster", 1)
def draw_sample_point(draws: Draws) -> Draft:
    """The pixel's name is its sample point."""
    column, row = draws.whole(1, 6), draws.whole(1, 4)
    refutation = Refutation(
        f"Pixel ({column}, {row}) reaches from its lower left corner to the next, and its centre is tested.",
        triangle_scene([[(0, 0), (11, 0), (0, 9)]], SIZE),
        "raster",
        f"column == {column} and row == {row} and x == {column}.5 and y == {row}.5",
        TESTED,
    )
    asked = f"""At which point of the window is pixel ({column}, {row}) tested, with one test a pixel?
        Hint: Which point of a pixel is tested?
        Hint: A pixel is 1 wide: where does it begin, where is its middle?
        Hint: It reaches from {column} to {column} + 1 in x, and from {row} to {row} + 1 in y."""
    names = [
        f"({x}, {y})"
        for x, y in ((column + 0.5, row + 0.5), (column, row), (column + 1, row + 1), (column + 0.5, row))
    ]
    return believed(draws, asked, names[0], names[1:2], names[2:], refutation)


@template("belief-rounding", 2, "Does rounding remove cracks?", "edges", 1)
def draw_rounding(draws: Draws) -> Draft:
    """Rounding the vertices removes cracks; or every diagonal runs through centres."""
    width, is_square = draws.whole(4, 7), draws.whole(0, 1)
    height = width if is_square else width + 1
    with_rule, without = "only with a tie rule", "yes, also without a tie rule"
    if is_square:
        right, belief, condition = with_rule, without, "(tie[0] or tie[1] or tie[2]) and not covered"
        sentence = "All corners are whole, yet centres lie on the common edge: with E > 0 neither triangle takes them."
    else:
        right, belief, condition = without, with_rule, "column == 1 and row == 1 and covered"
        sentence = (
            f"The common edge rises by {height} in {width} pixels, one of them even, the other odd: it runs through no "
            "centre, so E = 0 nowhere."
        )
    refutation = Refutation(
        sentence,
        triangle_scene(rectangle_corners(1, 1, 1 + width, 1 + height), SIZE),
        "raster",
        condition,
        Settings(fill="bounding-box", fill_rule="exclusive"),
    )
    asked = f"""The corners of a rectangle, {width} pixels wide and {height} high, are rounded to whole
        pixels, alike in both of its triangles. Does each centre in it belong to exactly one of them?
        Hint: Where does the diagonal run?
        Hint: What does rounding decide about a centre on an edge?
        Hint: The diagonal runs through (i + 1/2, j + 1/2) if {height} (2 i + 1) = {width} (2 j + 1): is that
        possible?"""
    return believed(draws, asked, right, [belief], ["no: rounding opens cracks"], refutation)


@template("belief-tie", 2, "Which pixel does D choose?", "raster", 1)
def draw_tie(draws: Draws) -> Draft:
    """At a tie one pixel is right; else D decides."""
    x, y, dy = draws.whole(0, 4), draws.whole(0, 3), draws.item((1, 3, 5))
    ends = (x, y), (x + 8, y + dy)
    wanted = draws.whole(-1, 1)
    values = d_values((ends[0], ends[1]), Settings(line="bresenham-lecture"))
    numbers = [int(d) for (d,) in values]
    found = [k for k, d in enumerate(numbers) if (d > 0) - (d < 0) == wanted]
    reject(not found)
    step = draws.item(found)
    d, column = numbers[step], x + step + 1
    upper, lower, either = "the upper one", "the lower one", "either: the stated rule decides"
    right, belief, sentence = {
        1: (
            upper,
            lower,
            f"D = {d} > 0: the line runs above the middle between both centres, nearer to the upper one.",
        ),
        0: (
            either,
            upper,
            "Both are equally near the line. D > 0 keeps the row, D >= 0 steps: the stated rule decides.",
        ),
        -1: (
            lower,
            upper,
            f"D = {d} < 0: the line runs below the middle between both centres, nearer to the lower one.",
        ),
    }[wanted]
    refutation = Refutation(
        sentence,
        pixel_segments([ends], (14, 10)),
        "raster",
        f"column == {column} and decision == {d}",
        Settings(line="bresenham-lecture"),
    )
    asked = f"""Bresenham's line from pixel {ends[0]} to {ends[1]} has D = {d} when the pixel of column
        {column} is chosen, in the row before or one above. Which of the two pixels is right?
        Hint: What does D say about the distances to both centres?
        Hint: D is the line's height above the middle between both centres, times 2 dx.
        Hint: D = {d}: does the line run above the middle, below it, or through it?"""
    others = [each for each in (upper, lower, either) if each not in (right, belief)]
    return believed(draws, asked, right, [belief], [*others, "both are drawn"], refutation)


@template("belief-two-steps", 2, "Two steps up in a row?", "raster", 1)
def draw_two_steps(draws: Draws) -> Draft:
    """Two steps up in a row cannot happen; or they always can."""
    dx, is_steep = draws.whole(8, 11), draws.whole(0, 1)
    dy = dx - draws.whole(1, 2) if is_steep else draws.whole(2, 3)
    yes, no = "yes", "no: after a step up the row stays for a move"
    if is_steep:
        right, belief, condition = yes, no, "has_stepped and previous > 0"
        sentence = "D stays above 0 after the first step here, so y steps again at once."
    else:
        right, belief, condition = no, yes, "not has_stepped and previous > 0"
        sentence = f"A step up takes 2 * {dx} from D, and 2 * {dy} twice is less: D is below 0 after it."
    refutation = Refutation(
        sentence,
        pixel_segments([((0, 0), (dx, dy))], (14, 12)),
        "raster",
        condition,
        Settings(line="bresenham-lecture"),
    )
    asked = f"""Bresenham's line from pixel (0, 0) to ({dx}, {dy}): does y step up at two moves in a row
        anywhere?
        Hint: How many steps up are there, in how many moves?
        Hint: Follow D over the first steps up.
        Hint: D begins with 2 * {dy} - {dx}, grows by 2 * {dy}, and falls by 2 * {dx} after a step up."""
    return believed(draws, asked, right, [belief], ["only after a tie"], refutation)


@template("belief-both-ends", 2, "Is a line the same from both ends?", "raster", 1)
def draw_both_ends(draws: Draws) -> Draft:
    """A line is the same from both ends; or never."""
    x, y, has_tie = draws.whole(0, 3), draws.whole(0, 4), draws.whole(0, 1)
    dx, dy = draws.item(((8, 3), (8, 1), (10, 3)) if has_tie else ((7, 3), (9, 4), (9, 2)))
    ends = (x, y), (x + dx, y + dy)
    but_one, same = "all but one", "all: the line is the same"
    if has_tie:
        right, belief, condition = but_one, same, "is_tie"
        sentence = (
            "Where D = 0 the rule steps towards the second end: the way back takes the other of two pixels."
        )
    else:
        right, belief, condition = same, but_one, "has_stepped and not is_tie"
        sentence = "D is 0 nowhere on this line: in every column one pixel is nearer, whichever way the line is drawn."
    refutation = Refutation(
        sentence,
        pixel_segments([ends, ends[::-1]], (14, 10)),
        "raster",
        condition,
        Settings(line="bresenham"),
    )
    asked = f"""Bresenham's line steps where D >= 0, from the first end to the second. Are its pixels from
        {ends[0]} to {ends[1]}, apart from the ends, those from {ends[1]} to {ends[0]}?
        Hint: Where could the two strokes disagree?
        Hint: Is there a column in which D is 0?
        Hint: If D is 0, both ways step: one towards {ends[1]}, the other towards {ends[0]}."""
    return believed(draws, asked, right, [belief], ["none"], refutation)


@template("belief-block-corner", 2, "Which corner rejects a block?", "bin", 1)
def draw_block(draws: Draws) -> Draft:
    """A block is out if one corner is out."""
    a, b = (draws.item((-1, 1)) * draws.whole(1, 5) for _ in range(2))
    sides = [f"{y} {x}" for x in ("left", "right") for y in ("lower", "upper")]
    right = f"{'upper' if b > 0 else 'lower'} {'right' if a > 0 else 'left'}"
    refutation = Refutation(
        "E is largest at one corner of a block: only if that one is out, all are. Other blocks hold covered pixels.",
        triangle_scene([[(1, 1), (20, 2), (3, 18)]], (24, 24)),
        "bin",
        'kind == "block" and verdict == "leaf"',
        Settings(fill="blocks"),
    )
    sum_text = f"{a} x {'+-'[b < 0]} {abs(b)} y + c"
    asked = f"""E = {sum_text}, inside where E >= 0. At which corner does E < 0 show that a whole block is
        outside?
        Hint: At which corner is E largest?
        Hint: The signs of a and b say in which direction E grows.
        Hint: a = {a} is the change to the right, b = {b} the change upwards."""
    others = [corner for corner in sides if corner != right][:2]
    return believed(draws, asked, right, ["any corner"], others, refutation)
