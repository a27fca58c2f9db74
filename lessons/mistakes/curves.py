"""Mistakes of curves: shares, levels, the number of segments, and dividing before the curve is cut."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import ceil, isqrt

from lessons.mistakes.twin import wrong_rule

Points = Sequence[tuple[int, ...]]


def mixed(points: Sequence[Fraction], t: Fraction) -> Fraction:
    """Return a coordinate of a curve's point, by de Casteljau's scheme."""
    left = [Fraction(point) for point in points]
    while len(left) > 1:
        left = [(1 - t) * a + t * b for a, b in pairwise(left)]
    return left[0]


def curve_point(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """Return the point of a curve at t."""
    return tuple(mixed([Fraction(c) for c in column], t) for column in zip(*points, strict=True))


def least_segments(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """Return the least n with deviation / n^2 within the tolerance, and how many different ends n segments have."""
    ratio = deviation / tolerance
    n = isqrt(ratio.numerator // ratio.denominator)
    n = max(n if n * n >= ratio else n + 1, 1)
    return n, n + (not is_closed)


def cut_then_divided(places: Sequence[int], w: Sequence[int], t: Fraction) -> tuple[Fraction]:
    """Return where a curve's point at t lies in the window: mixed in clip space, and then divided by w."""
    x = mixed([Fraction(p * k) for p, k in zip(places, w, strict=True)], t)
    return (x / mixed([Fraction(k) for k in w], t),)


def split_and_diced(length: int, limit: int, side: int) -> tuple[int, int]:
    """Return into how many pieces a line is split in halves, and into how many parts each piece is diced."""
    pieces, parts = 1, 1
    while Fraction(length, pieces) > limit:
        pieces *= 2
    while Fraction(length, pieces * parts) > side:
        parts *= 2
    return pieces, parts


def points_of_grids(patches: int, columns: int, rows: int, hidden: int) -> tuple[int]:
    """Return how many points are shaded of patches with grids of their own, of which some are hidden."""
    return (patches * (columns + 1) * (rows + 1),)


_HALF = Fraction(1, 2)


@wrong_rule(
    curve_point, shows=(((0, 0), (0, 8), (8, 8)), Fraction(1, 4)), hides=(((0, 0), (0, 8), (8, 8)), _HALF)
)
def shares_of_t_swapped(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """The first of two neighbours got the share t. It gets 1 − t: at t = 0 the curve begins at its first point."""
    return curve_point(points, 1 - t)


@wrong_rule(curve_point, shows=(((0, 0), (0, 8), (8, 8)), _HALF), hides=(((0, 0), (4, 4), (8, 8)), _HALF))
def ends_mixed(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """Only the two ends were mixed, which gives the chord. Mix all neighbours, then the mixtures, to one point."""
    return curve_point([points[0], points[-1]], t)


@wrong_rule(curve_point, shows=(((0, 0), (0, 8), (8, 8)), _HALF), hides=(((0, 0), (0, 0), (0, 0)), _HALF))
def one_level_of_mixtures(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """The first mixture was taken for the point. It is a point of the control polygon: go on until one is left."""
    return curve_point(points[:2], t)


@wrong_rule(least_segments, shows=(Fraction(16), Fraction(1), False), hides=(Fraction(1), Fraction(1), False))
def deviation_falls_with_n(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """The deviation was divided by n. With n equal steps it is n² times as small."""
    n = max(ceil(deviation / tolerance), 1)
    return n, n + (not is_closed)


@wrong_rule(
    least_segments, shows=(Fraction(15), Fraction(1), False), hides=(Fraction(16), Fraction(1), False)
)
def segments_rounded_down(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """The square root was rounded down, which leaves more than the tolerance. Round it up."""
    ratio = deviation / tolerance
    n = max(isqrt(ratio.numerator // ratio.denominator), 1)
    return n, n + (not is_closed)


@wrong_rule(least_segments, shows=(Fraction(16), Fraction(1), False), hides=(Fraction(16), Fraction(1), True))
def as_many_ends_as_segments(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """As many ends as segments were counted. That holds of a closed line; n segments of an open one have n + 1."""
    n, _ = least_segments(deviation, tolerance, is_closed)
    return n, n


@wrong_rule(cut_then_divided, shows=((0, 8, 8), (1, 1, 3), _HALF), hides=((0, 8, 8), (2, 2, 2), _HALF))
def divided_before_cutting(places: Sequence[int], w: Sequence[int], t: Fraction) -> tuple[Fraction]:
    """The control points were divided by w before the curve was cut. Mix x w and w, then divide the point."""
    return (mixed([Fraction(p) for p in places], t),)


@wrong_rule(split_and_diced, shows=(40, 16, 4), hides=(64, 16, 4))
def parts_not_a_power_of_two(length: int, limit: int, side: int) -> tuple[int, int]:
    """The least number of parts was taken. Parts are counted in powers of two, so that neighbours fit together."""
    pieces, _ = split_and_diced(length, limit, side)
    return pieces, ceil(Fraction(length, pieces * side))


@wrong_rule(split_and_diced, shows=(40, 16, 4), hides=(12, 16, 4))
def diced_without_splitting(length: int, limit: int, side: int) -> tuple[int, int]:
    """The whole was diced as one grid. What is longer than a grid may be is first split in halves."""
    pieces, parts = split_and_diced(length, limit, side)
    return 1, pieces * parts


@wrong_rule(points_of_grids, shows=(2, 4, 4, 1), hides=(0, 4, 4, 0))
def micropolygons_for_points(patches: int, columns: int, rows: int, hidden: int) -> tuple[int]:
    """The micropolygons were counted. The points of the grid are shaded, one more each way than there are cells."""
    return (patches * columns * rows,)


@wrong_rule(points_of_grids, shows=(2, 4, 4, 1), hides=(2, 4, 4, 0))
def hidden_grids_not_shaded(patches: int, columns: int, rows: int, hidden: int) -> tuple[int]:
    """What is hidden was left out. A grid is shaded before it is known what hides it."""
    return ((patches - hidden) * (columns + 1) * (rows + 1),)
