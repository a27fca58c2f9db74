"""Mistakes of curves: shares, levels, the number of segments, and dividing before the curve is cut."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import ceil, isqrt

from lessons.mistakes.twin import WrongRule

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


def shares_swapped(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """Take t of the first of two neighbours."""
    return curve_point(points, 1 - t)


def ends_mixed(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """Mix the two ends alone, as on a straight line."""
    return curve_point([points[0], points[-1]], t)


def first_level(points: Points, t: Fraction) -> tuple[Fraction, ...]:
    """Stop at the first mixture of the first level."""
    return curve_point(points[:2], t)


def least_segments(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """Return the least n with deviation / n^2 within the tolerance, and how many different ends n segments have."""
    ratio = deviation / tolerance
    n = isqrt(ratio.numerator // ratio.denominator)
    n = max(n if n * n >= ratio else n + 1, 1)
    return n, n + (not is_closed)


def falls_with_n(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """Divide the deviation by n alone."""
    n = max(ceil(deviation / tolerance), 1)
    return n, n + (not is_closed)


def rounded_down(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """Round the square root down."""
    ratio = deviation / tolerance
    n = max(isqrt(ratio.numerator // ratio.denominator), 1)
    return n, n + (not is_closed)


def as_many_ends(deviation: Fraction, tolerance: Fraction, is_closed: bool) -> tuple[int, int]:
    """Count as many ends as segments."""
    n, _ = least_segments(deviation, tolerance, is_closed)
    return n, n


def cut_then_divided(places: Sequence[int], w: Sequence[int], t: Fraction) -> tuple[Fraction]:
    """Return where a curve's point at t lies in the window: mixed in clip space, and then divided by w."""
    x = mixed([Fraction(p * k) for p, k in zip(places, w, strict=True)], t)
    return (x / mixed([Fraction(k) for k in w], t),)


def divided_then_cut(places: Sequence[int], w: Sequence[int], t: Fraction) -> tuple[Fraction]:
    """Mix the control points after their division."""
    return (mixed([Fraction(p) for p in places], t),)


def split_and_diced(length: int, limit: int, side: int) -> tuple[int, int]:
    """Return into how many pieces a line is split in halves, and into how many parts each piece is diced."""
    pieces, parts = 1, 1
    while Fraction(length, pieces) > limit:
        pieces *= 2
    while Fraction(length, pieces * parts) > side:
        parts *= 2
    return pieces, parts


def diced_without_powers(length: int, limit: int, side: int) -> tuple[int, int]:
    """Dice into the least number of parts, whatever the neighbours have."""
    pieces, _ = split_and_diced(length, limit, side)
    return pieces, ceil(Fraction(length, pieces * side))


def diced_at_once(length: int, limit: int, side: int) -> tuple[int, int]:
    """Dice the whole line as one grid."""
    pieces, parts = split_and_diced(length, limit, side)
    return 1, pieces * parts


def points_of_grids(patches: int, columns: int, rows: int, hidden: int) -> tuple[int]:
    """Return how many points are shaded of patches with grids of their own, of which some are hidden."""
    return (patches * (columns + 1) * (rows + 1),)


def cells_of_grids(patches: int, columns: int, rows: int, hidden: int) -> tuple[int]:
    """Count the micropolygons."""
    return (patches * columns * rows,)


def seen_points(patches: int, columns: int, rows: int, hidden: int) -> tuple[int]:
    """Leave out what is hidden."""
    return ((patches - hidden) * (columns + 1) * (rows + 1),)


_HALF = Fraction(1, 2)

RULES = (
    WrongRule(
        "shares-of-t-swapped",
        "The first of two neighbours got the share t. It gets 1 − t: at t = 0 the curve begins at its first point.",
        curve_point,
        shares_swapped,
        (((0, 0), (0, 8), (8, 8)), Fraction(1, 4)),
        (((0, 0), (0, 8), (8, 8)), _HALF),
    ),
    WrongRule(
        "ends-mixed",
        "Only the two ends were mixed, which gives the chord. Mix all neighbours, then the mixtures, to one point.",
        curve_point,
        ends_mixed,
        (((0, 0), (0, 8), (8, 8)), _HALF),
        (((0, 0), (4, 4), (8, 8)), _HALF),
    ),
    WrongRule(
        "one-level-of-mixtures",
        "The first mixture was taken for the point. It is a point of the control polygon: go on until one is left.",
        curve_point,
        first_level,
        (((0, 0), (0, 8), (8, 8)), _HALF),
        (((0, 0), (0, 0), (0, 0)), _HALF),
    ),
    WrongRule(
        "deviation-falls-with-n",
        "The deviation was divided by n. With n equal steps it is n² times as small.",
        least_segments,
        falls_with_n,
        (Fraction(16), Fraction(1), False),
        (Fraction(1), Fraction(1), False),
    ),
    WrongRule(
        "segments-rounded-down",
        "The square root was rounded down, which leaves more than the tolerance. Round it up.",
        least_segments,
        rounded_down,
        (Fraction(15), Fraction(1), False),
        (Fraction(16), Fraction(1), False),
    ),
    WrongRule(
        "as-many-ends-as-segments",
        "As many ends as segments were counted. That holds of a closed line; n segments of an open one have n + 1.",
        least_segments,
        as_many_ends,
        (Fraction(16), Fraction(1), False),
        (Fraction(16), Fraction(1), True),
    ),
    WrongRule(
        "divided-before-cutting",
        "The control points were divided by w before the curve was cut. Mix x w and w, then divide the point.",
        cut_then_divided,
        divided_then_cut,
        ((0, 8, 8), (1, 1, 3), _HALF),
        ((0, 8, 8), (2, 2, 2), _HALF),
    ),
    WrongRule(
        "parts-not-a-power-of-two",
        "The least number of parts was taken. Parts are counted in powers of two, so that neighbours fit together.",
        split_and_diced,
        diced_without_powers,
        (40, 16, 4),
        (64, 16, 4),
    ),
    WrongRule(
        "diced-without-splitting",
        "The whole was diced as one grid. What is longer than a grid may be is first split in halves.",
        split_and_diced,
        diced_at_once,
        (40, 16, 4),
        (12, 16, 4),
    ),
    WrongRule(
        "micropolygons-for-points",
        "The micropolygons were counted. The points of the grid are shaded, one more each way than there are cells.",
        points_of_grids,
        cells_of_grids,
        (2, 4, 4, 1),
        (0, 4, 4, 0),
    ),
    WrongRule(
        "hidden-grids-not-shaded",
        "What is hidden was left out. A grid is shaded before it is known what hides it.",
        points_of_grids,
        seen_points,
        (2, 4, 4, 1),
        (2, 4, 4, 0),
    ),
)
