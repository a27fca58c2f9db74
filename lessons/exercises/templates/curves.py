"""Curves: a point by de Casteljau's scheme, how many segments keep a tolerance, and the division by w."""

from fractions import Fraction

from lessons.exercises.drafting import by_rule, listed
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.curves import cut_then_divided


@template("curve-point", 1, "A point of a curve", "transform", 2)
def draw_point(draws: Draws) -> Draft:
    """The point of a curve of three or four control points."""
    count = draws.item((3, 4))
    t = draws.item((Fraction(1, 2), Fraction(1, 4), Fraction(3, 4)))
    # So that every level has whole numbers, or halves.
    unit = t.denominator ** (count - 2)
    points = tuple(
        (draws.whole(0, 16 // unit) * unit, draws.whole(0, 16 // unit) * unit) for _ in range(count)
    )
    reject(len(set(points)) < count)
    given = f"{listed('P{} = {}', range(count), points)}\nt = {t}"
    levels = "two" if count == 3 else "three"
    asked = f"""Where is the point of this Bezier curve at t?
        Hint: Mix each two neighbours: 1 − t of the first and t of the second.
        Hint: Each level has one point fewer than the one before. Mix its points in the same way, until one is left.
        Hint: There are {levels} levels here. The first begins with the mixture of {points[0]} and {points[1]} at
        t = {t}."""
    return by_rule(
        asked,
        given,
        (points, t),
        ("shares-of-t-swapped", "ends-mixed", "one-level-of-mixtures"),
        ("x", "y"),
    )


@template("segments-to-tolerance", 1, "Segments to a tolerance", "transform", 2)
def draw_count(draws: Draws) -> Draft:
    """The fewest equal steps that keep a curve within a tolerance."""
    tolerance = draws.item((Fraction(1, 4), Fraction(1, 2), Fraction(1), Fraction(2)))
    deviation, is_closed = Fraction(draws.whole(3, 60)), draws.whole(0, 3) == 0
    reject(deviation / tolerance <= 2)
    line = "closed: it ends where it begins" if is_closed else "open: it does not end where it begins"
    given = f"""With one segment the curve is at most {deviation} pixels away.
Tolerance: {tolerance} pixel
The curve is {line}."""
    asked = f"""How many equal steps of t are the fewest that surely keep the curve within the tolerance, and how many
        different ends do these segments have?
        Hint: With n equal steps, each piece is n times as short, and the deviation n² times as small.
        Hint: n² is at least what one segment deviates, divided by the tolerance. An open line has one end more than
        it has segments.
        Hint: Here n is the square root of {deviation} / ({tolerance}), rounded up."""
    wrong = ("deviation-falls-with-n", "segments-rounded-down", "as-many-ends-as-segments")
    return by_rule(asked, given, (deviation, tolerance, is_closed), wrong, ("segments", "ends"))


@template("curve-in-perspective", 1, "A curve in perspective", "transform", 3)
def draw_depth(draws: Draws) -> Draft:
    """Where the middle of a curve lies in the window whose ends are not equally far."""
    places = tuple(draws.whole(0, 12) for _ in range(3))
    w = (1, draws.item((1, 2)), draws.item((3, 4, 5)))
    t = Fraction(1, 2)
    (found,) = cut_then_divided(places, w, t)
    reject(len(set(places)) < 3 or found.denominator > 12)
    given = listed("P{}: window x = {}, w = {}", range(3), places, w)
    asked = f"""At which window x lies the point of this curve at t = 1/2? The curve is cut in clip space, before
        anything is divided by w.
        Hint: In clip space each control point has x w and w. Both are mixed.
        Hint: At t = 1/2 a curve of three points is a quarter of the first, a half of the second and a quarter of the
        third.
        Hint: Divide the mixture of x w by that of w, which mixes {w[0]}, {w[1]} and {w[2]}."""
    return by_rule(asked, given, (places, w, t), ("divided-before-cutting",), ("x",))


@template("split-and-dice", 1, "Split and dice", "transform", 2)
def draw_dice(draws: Draws) -> Draft:
    """Into how many pieces a line is split, and how each is diced."""
    length, side = draws.whole(18, 120), draws.item((1, 2, 3, 4))
    reject(length % 16 == 0)
    given = f"Length: {length} pixels. A grid may be 16 pixels long, a micropolygon {side}. Each half is half as long."
    asked = f"""REYES splits a line of a patch in halves until each piece fits a grid, and dices each piece into a
        power of two of parts. How many pieces are there, and how many parts has each?
        Hint: Halve {length} until it is 16 or less. Two pieces, four, eight ...
        Hint: Then take one part, two, four ... until a part is no longer than a micropolygon may be.
        Hint: The first time it is halved, {length} becomes {length} / 2."""
    wrong = ("parts-not-a-power-of-two", "diced-without-splitting")
    return by_rule(asked, given, (length, 16, side), wrong, ("pieces", "parts of each"))


@template("points-shaded", 1, "Points that REYES shades", "transform", 2)
def draw_shaded(draws: Draws) -> Draft:
    """How many points are shaded, whatever is hidden."""
    patches, columns, rows = draws.whole(2, 6), draws.item((2, 4, 8)), draws.item((2, 4, 8))
    hidden = draws.whole(1, patches - 1)
    given = f"""{patches} patches, each diced into {columns} x {rows} micropolygons, with a grid of its own.
{hidden} of them will be hidden behind others."""
    asked = f"""How many points does REYES shade?
        Hint: When does it shade: before or after it finds out what is hidden?
        Hint: It shades the corners of the micropolygons, each corner of a grid once.
        Hint: {columns} cells in a row have {columns} + 1 corners, and {rows} rows have {rows} + 1 lines of them. There
        are {patches} grids."""
    wrong = ("micropolygons-for-points", "hidden-grids-not-shaded")
    return by_rule(asked, given, (patches, columns, rows, hidden), wrong)
