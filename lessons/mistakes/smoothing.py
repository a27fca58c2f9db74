"""Mistakes of smoothing edges in the finished picture, FXAA."""

from collections.abc import Sequence
from fractions import Fraction

from lessons.mistakes.twin import WrongRule


def luma_range(lumas: Sequence[Fraction]) -> tuple[Fraction]:
    """Return the contrast of a pixel, the first luma, and its four neighbours."""
    return (max(lumas) - min(lumas),)


def moved_by_stair(back: int, forth: int) -> tuple[Fraction]:
    """Return how far the nearer end of a stair moves a colour, in pixels; both ends are so many pixels away."""
    return (Fraction(1, 2) - Fraction(min(back, forth), back + forth),)


RULES = (
    WrongRule(
        "contrast-to-center",
        "Each neighbour was compared with the pixel alone. The contrast is the largest luma less the smallest one.",
        luma_range,
        lambda lumas: (max(abs(luma - lumas[0]) for luma in lumas),),
        ((2, 1, 3, 2, 2),),
        ((1, 1, 3, 2, 2),),
    ),
    WrongRule(
        "moved-in-the-middle",
        "The share of the way to the end was taken. A colour moves most at the end of a stair, and not in its middle.",
        moved_by_stair,
        lambda back, forth: (Fraction(min(back, forth), back + forth),),
        (1, 5),
        (1, 3),
    ),
    WrongRule(
        "stair-of-one-side",
        "The nearer end was measured by the farther one. The stair is as long as both ways together.",
        moved_by_stair,
        lambda back, forth: (Fraction(1, 2) - Fraction(min(back, forth), max(back, forth)),),
        (1, 5),
        (0, 5),
    ),
)
