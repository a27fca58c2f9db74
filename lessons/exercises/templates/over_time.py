"""Pictures mixed over time: what is kept, and how long a ghost is seen."""

from fractions import Fraction

from core.explain.number_text import number_text
from lessons.exercises.drafting import by_rule
from lessons.exercises.numbers import Draws, reject
from lessons.exercises.question import Draft, template
from lessons.mistakes.history import ghost_pictures


@template("history-value", 1, "What the history keeps", "resolve", 2)
def draw_kept(draws: Draws) -> Draft:
    """What is kept of a pixel after some pictures."""
    share, count = (
        draws.item((Fraction(1, 10), Fraction(1, 5), Fraction(1, 4), Fraction(2, 5))),
        draws.whole(2, 3),
    )
    old, new = draws.item(
        ((Fraction(0), Fraction(1)), (Fraction(1), Fraction(0)), (Fraction(1, 2), Fraction(1)))
    )
    asked = f"""The history of a pixel is {number_text(float(old))}. Then {count} pictures have the colour
        {number_text(float(new))} there, each with a share of {number_text(float(share))}. What is kept?
        Hint: What is kept goes towards the new colour by the share of the way between them.
        Hint: The next picture begins with what the last one has kept.
        Hint: The first picture goes {number_text(float(share))} of the way from {number_text(float(old))} to
        {number_text(float(new))}."""
    given = "kept = history + share * (new - history)"
    return by_rule(asked, given, (old, new, share, count), ("share-of-the-history", "share-added"))


@template("ghost-length", 1, "How long a ghost is seen", "resolve", 2)
def draw_ghost(draws: Draws) -> Draft:
    """After how many pictures a ghost has faded."""
    share, visible = (
        draws.item((Fraction(1, 2), Fraction(1, 3), Fraction(1, 4), Fraction(1, 5))),
        draws.item((4, 8, 10)),
    )
    reject(ghost_pictures(share, Fraction(1, visible))[0] < 3)
    asked = f"""An object has left a pixel, whose history shows it in full. Each new picture shows the black background
        there, with a share of {share}. After how many pictures is less than 1/{visible} of it left for the first
        time, and how much of it?
        Hint: What is left is multiplied by the same number in each picture.
        Hint: That number is 1 - {share}.
        Hint: After n pictures (1 - {share}) to the power of n is left: find the first n with less than 1/{visible}."""
    given = f"Share of the new picture: {share}"
    return by_rule(
        asked,
        given,
        (share, Fraction(1, visible)),
        ("ghost-is-over", "ghost-of-the-share"),
        ("pictures", "left"),
    )
