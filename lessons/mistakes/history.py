"""Mistakes about pictures mixed over time: what is kept after some of them, and how long a ghost is seen."""

from fractions import Fraction

from lessons.mistakes.twin import WrongRule


def kept_after(old: Fraction, new: Fraction, share: Fraction, count: int) -> tuple[float]:
    """Return what is kept of a value after ``count`` pictures with the same new one."""
    for _ in range(count):
        old = old + share * (new - old)
    return (float(old),)


def ghost_pictures(share: Fraction, visible: Fraction) -> tuple[int, Fraction]:
    """Return after how many pictures less than ``visible`` is left of what was there, and how much that is."""
    left, count = Fraction(1), 0
    while left >= visible:
        left, count = left * (1 - share), count + 1
    return count, left


def ghost_by_steps(share: Fraction, visible: Fraction) -> tuple[int, Fraction]:
    """Remove the same part of what was there in each picture."""
    count = int(-(-(1 - visible) // share))
    return count, 1 - count * share


_KEPT = (Fraction(0), Fraction(1), Fraction(1, 5), 2)
_LEFT = (Fraction(1, 5), Fraction(1, 10))
_HALF, _ONCE = (Fraction(0), Fraction(1), Fraction(1, 2), 2), (Fraction(0), Fraction(1), Fraction(1, 5), 1)
_SOON = (Fraction(1, 2), Fraction(2, 3))
RULES = (
    WrongRule(
        "share-of-the-history",
        "The history was weighed by the share of the new picture. The share belongs to the new one.",
        kept_after,
        lambda old, new, share, count: kept_after(old, new, 1 - share, count),
        _KEPT,
        _HALF,
    ),
    WrongRule(
        "share-added",
        "The same step was added each time. The step is a share of the way that is left, so it gets smaller.",
        kept_after,
        lambda old, new, share, count: (float(old + count * share * (new - old)),),
        _KEPT,
        _ONCE,
    ),
    WrongRule(
        "ghost-is-over",
        "Each picture was taken to remove the same part of the first brightness. It removes a share of what is left.",
        ghost_pictures,
        ghost_by_steps,
        _LEFT,
        _SOON,
    ),
    WrongRule(
        "ghost-of-the-share",
        "What is left was multiplied by the share. It is the rest, one less the share, that stays each time.",
        ghost_pictures,
        lambda share, visible: ghost_pictures(1 - share, visible),
        _LEFT,
        _SOON,
    ),
)
