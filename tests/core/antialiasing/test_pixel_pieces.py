"""Pieces of pixels against exact rational arithmetic."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.antialiasing.pixel_pieces import area_of, centroid_of, join_pieces, split_pieces, whole_pixels

COEFFICIENT = st.integers(-600, 600)
LINE = st.tuples(COEFFICIENT, COEFFICIENT, COEFFICIENT).filter(lambda line: line[0] != 0 or line[1] != 0)
LINES = st.lists(LINE, min_size=1, max_size=4)
Point = tuple[Fraction, Fraction]


def clipped(polygon: list[Point], a: int, b: int, value: int) -> list[Point]:
    """Return what of a polygon lies where a x + b y + value >= 0, in rational numbers."""
    kept = []
    for (x1, y1), (x2, y2) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        first, second = a * x1 + b * y1 + value, a * x2 + b * y2 + value
        if first >= 0:
            kept.append((x1, y1))
        if first * second < 0:
            t = first / (first - second)
            kept.append((x1 + t * (x2 - x1), y1 + t * (y2 - y1)))
    return kept


def area(polygon: list[Point]) -> Fraction:
    sides = zip(polygon, polygon[1:] + polygon[:1], strict=True)
    return sum((x1 * y2 - x2 * y1 for (x1, y1), (x2, y2) in sides), Fraction(0)) / 2


HALF = Fraction(1, 2)
SQUARE = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)]


@given(LINES)
def test_the_area_inside_all_lines_is_the_rational_one(lines):
    pieces, exact = whole_pixels(np.zeros(1, np.int64)), SQUARE
    for a, b, value in lines:
        inside, _ = split_pieces(pieces, *(np.full(len(pieces), float(n)) for n in (a, b, value)))
        pieces, exact = inside, clipped(exact, a, b, value)
    assert abs(float(area(exact)) - area_of(pieces).sum()) <= 1e-14


@given(LINES)
def test_pieces_add_up_and_keep_the_moments_of_the_square(lines):
    pieces = whole_pixels(np.zeros(1, np.int64))
    for a, b, value in lines:
        pieces = join_pieces(
            list(split_pieces(pieces, *(np.full(len(pieces), float(n)) for n in (a, b, value))))
        )
    areas, (x, y) = area_of(pieces), centroid_of(pieces)
    assert abs(areas.sum() - 1) <= 1e-14
    assert abs((areas * x).sum()) <= 1e-14
    assert abs((areas * y).sum()) <= 1e-14
    assert (np.abs(x) <= 0.5).all()
    assert (np.abs(y) <= 0.5).all()


def test_a_batch_is_cut_as_each_piece_alone():
    generator = np.random.default_rng(1)
    a, b, value = generator.integers(-9, 10, (3, 200)).astype(float)
    inside, outside = split_pieces(whole_pixels(np.arange(200)), a, b, value)
    for k in range(200):
        alone = split_pieces(whole_pixels(np.array([k])), a[k : k + 1], b[k : k + 1], value[k : k + 1])
        for part, own in zip((inside, outside), alone, strict=True):
            chosen = part.select(part.number == k)
            assert area_of(chosen).tobytes() == area_of(own).tobytes()
            assert centroid_of(chosen)[0].tobytes() == centroid_of(own)[0].tobytes()


def test_a_line_through_corners_leaves_nothing_flat():
    one = np.ones(1)
    inside, outside = split_pieces(whole_pixels(np.zeros(1, np.int64)), one, -one, 0 * one)
    assert area_of(inside).tolist() == area_of(outside).tolist() == [0.5]
    inside, outside = split_pieces(whole_pixels(np.zeros(1, np.int64)), one, 0 * one, 0.5 * one)
    assert area_of(inside).tolist() == [1]
    assert len(outside) == 0
