"""Mistakes of smoothing edges in the finished picture, FXAA."""

from collections.abc import Sequence
from fractions import Fraction

from lessons.mistakes.twin import wrong_rule


def luma_range(lumas: Sequence[Fraction]) -> tuple[Fraction]:
    """Return the contrast of a pixel, the first luma, and its four neighbours."""
    return (max(lumas) - min(lumas),)


def moved_by_stair(back: int, forth: int) -> tuple[Fraction]:
    """Return how far the nearer end of a stair moves a colour, in pixels; both ends are so many pixels away."""
    return (Fraction(1, 2) - Fraction(min(back, forth), back + forth),)


@wrong_rule(luma_range, shows=((2, 1, 3, 2, 2),), hides=((1, 1, 3, 2, 2),))
def contrast_to_center(lumas: Sequence[Fraction]) -> tuple[Fraction]:
    """Each neighbour was compared with the pixel alone. The contrast is the largest luma less the smallest one."""
    return (max(abs(luma - lumas[0]) for luma in lumas),)


@wrong_rule(moved_by_stair, shows=(1, 5), hides=(1, 3))
def moved_in_the_middle(back: int, forth: int) -> tuple[Fraction]:
    """The share of the way to the end was taken. A colour moves most at the end of a stair, and not in its middle."""
    return (Fraction(min(back, forth), back + forth),)


@wrong_rule(moved_by_stair, shows=(1, 5), hides=(0, 5))
def stair_of_one_side(back: int, forth: int) -> tuple[Fraction]:
    """The nearer end was measured by the farther one. The stair is as long as both ways together."""
    return (Fraction(1, 2) - Fraction(min(back, forth), max(back, forth)),)
