"""Mistakes about pictures mixed over time: what is kept after some of them, and how long a ghost is seen."""

from fractions import Fraction

from lessons.mistakes.twin import wrong_rule


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


_KEPT = (Fraction(0), Fraction(1), Fraction(1, 5), 2)
_LEFT = (Fraction(1, 5), Fraction(1, 10))
_HALF, _ONCE = (Fraction(0), Fraction(1), Fraction(1, 2), 2), (Fraction(0), Fraction(1), Fraction(1, 5), 1)
_SOON = (Fraction(1, 2), Fraction(2, 3))


@wrong_rule(kept_after, shows=_KEPT, hides=_HALF)
def share_of_the_history(old: Fraction, new: Fraction, share: Fraction, count: int) -> tuple[float]:
    """The history was weighed by the share of the new picture. The share belongs to the new one."""
    return kept_after(old, new, 1 - share, count)


@wrong_rule(kept_after, shows=_KEPT, hides=_ONCE)
def share_added(old: Fraction, new: Fraction, share: Fraction, count: int) -> tuple[float]:
    """The same step was added each time. The step is a share of the way that is left, so it gets smaller."""
    return (float(old + count * share * (new - old)),)


@wrong_rule(ghost_pictures, shows=_LEFT, hides=_SOON)
def ghost_is_over(share: Fraction, visible: Fraction) -> tuple[int, Fraction]:
    """Each picture was taken to remove the same part of the first brightness. It removes a share of what is left."""
    count = int(-(-(1 - visible) // share))
    return count, 1 - count * share


@wrong_rule(ghost_pictures, shows=_LEFT, hides=_SOON)
def ghost_of_the_share(share: Fraction, visible: Fraction) -> tuple[int, Fraction]:
    """What is left was multiplied by the share. It is the rest, one less the share, that stays each time."""
    return ghost_pictures(1 - share, visible)
