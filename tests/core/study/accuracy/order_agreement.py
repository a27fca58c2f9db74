"""How well two measurements of a study agree in order.

References
----------
M. Kendall, *A new measure of rank correlation*, 1938.
"""

from collections.abc import Sequence
from itertools import combinations
from math import nan

from core.study.record import CLOSE, Point, is_faster


def kendall_tau(first: Sequence[Point], second: Sequence[Point]) -> float:
    """Return how well two measurements of the same methods agree in order: 1 in all, -1 in no pair, NaN: none counts.

    Notes
    -----
    A pair counts where both measurements tell it apart, and its medians differ by more than `CLOSE` in both.
    """
    others = {point.method: point for point in second if point.is_measured}
    both = [(point, others[point.method]) for point in first if point.is_measured and point.method in others]
    signs = [_sign(one[0], other[0]) * _sign(one[1], other[1]) for one, other in combinations(both, 2)]
    counted = [sign for sign in signs if sign]
    return sum(counted) / len(counted) if counted else nan


def _sign(first: Point, second: Point) -> int:
    """Return 1 where the first is faster by more than `CLOSE`, -1 where the second is, 0 where it is open."""
    if CLOSE * first.median < second.median and is_faster(first, second):
        return 1
    return -1 if CLOSE * second.median < first.median and is_faster(second, first) else 0
