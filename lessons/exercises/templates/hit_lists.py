"""Lists of hits: what a pixel's list holds, and how it is resolved from front to back."""

from fractions import Fraction

from lessons.exercises.drafting import by_rule, listed
from lessons.exercises.numbers import Draws
from lessons.exercises.question import Draft, template
from lessons.mistakes.hit_lists import HALF, Hit


@template("resolve-a-list", 1, "Resolve a list of hits", "blend", 3)
def draw_resolved(draws: Draws) -> Draft:
    """The grey of a pixel whose hits come in any order."""
    depths = tuple(draws.shuffled(range(1, 10))[:3])
    greys = tuple(draws.shuffled(range(0, 241, 4))[:3])
    hits = tuple(Hit(depth, grey, HALF) for depth, grey in zip(depths, greys, strict=True))
    background = draws.item((0, 16, 48, 96, 160))
    names = ("list-not-sorted", "sorted-farthest-first", "own-alpha-for-share")
    front = min(hits)
    given = listed("Hit {}: depth {}, grey {}, alpha 1/2", range(1, 4), depths, greys)
    asked = f"""A pixel has this list of hits, as they were appended. Smaller depths are nearer. The background is of
        grey {background}. Which grey does the pixel have, if the list is sorted and resolved from front to back?
        Hint: Sort by depth. In front of the first hit there is nothing.
        Hint: Each hit gives 1/2 of what those in front of it let through.
        Hint: The hit of grey {front.grey} is in front and gives 1/2 * {front.grey}. At the end an eighth of the
        background shows."""
    return by_rule(asked, given, (hits, background), names, ("grey",))


@template("ends-of-lists", 1, "What a list holds", "depth", 2)
def draw_listed(draws: Draws) -> Draft:
    """How many hits are listed, and how many are blended until one is opaque."""
    count = draws.whole(4, 6)
    depths, opaque = draws.shuffled(range(1, 10))[:count], draws.whole(0, count - 1)
    hits = tuple(Hit(depth, 0, Fraction(1) if k == opaque else HALF) for k, depth in enumerate(depths))
    names = ("behind-opaque-blended", "opaque-in-drawing-order", "only-nearer-listed")
    alphas = ["opaque" if hit.alpha == 1 else "glass" for hit in hits]
    given = listed("Hit {}: depth {}, {}", range(1, count + 1), depths, alphas)
    asked = f"""These hits of one pixel arrive in this order; smaller depths are nearer, and all are nearer than what
        was there before. How many are in its list when all is drawn, and how many of them are blended, from front
        to back?
        Hint: Appending compares nothing.
        Hint: Sorted by depth, how far do you get until a hit lets nothing through?
        Hint: The opaque hit has depth {depths[opaque]}. Count the hits that are nearer, and that one."""
    return by_rule(asked, given, (hits,), names, ("listed", "blended"))
