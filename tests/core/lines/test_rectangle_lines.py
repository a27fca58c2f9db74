"""The point-sampled rectangle: pictures, thickness by angle, ties, exactness."""

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.lines.drawing import draw_lines
from core.lines.line_method import COORDINATE_LIMIT
from core.lines.rectangle import half_width
from tests.core.lines.test_lines_pictures import centers, picture

ON_GRID = st.integers(-5120, 5120).map(lambda n: n / 256)
SHIFT, SIZE = 32, 64


def rectangle_pixels(segments, **options) -> list[list[int]]:
    drawn = draw_lines(
        np.asarray(segments) + SHIFT, SIZE, SIZE, line="rectangle", pixel_center="integer", **options
    )
    return (drawn.pixels - SHIFT).tolist()


def test_sloping_lines_have_two_pixels_in_some_columns():
    assert picture([[[0.5, 1.0], [7.5, 4.5]]], 8, 5, line="rectangle") == [
        "......0.",
        "....000.",
        "..000...",
        "000.....",
        "........",
    ]
    assert picture(centers([0, 0, 9, 0]), 10, 1, line="rectangle") == ["000000000."]
    # Of 45 degrees: every pixel on the line, and none beside it (at 0.707).
    assert picture(centers([0, 0, 3, 3]), 4, 4, line="rectangle", last_pixel=True) == [
        "...0",
        "..0.",
        ".0..",
        "0...",
    ]


def test_the_thickness_changes_with_the_angle():
    angles = np.arange(0, 45, 5)
    ends = 400 * np.stack([np.cos(np.radians(angles)), np.sin(np.radians(angles))], axis=1)
    segments = np.stack([np.zeros_like(ends), ends], axis=1) + 20.3
    drawn = draw_lines(segments, 500, 500, line="rectangle")
    per_column = np.bincount(drawn.owner) / np.abs(ends).max(axis=1)
    np.testing.assert_allclose(per_column, 1 / np.cos(np.radians(angles)), atol=0.02)
    assert (np.diff(per_column) > 0).all()


@pytest.mark.parametrize("mirror", [(1, 1), (-1, 1), (1, -1), (-1, -1)])
@pytest.mark.parametrize("swaps", [False, True])
def test_all_octants_draw_the_same_line_where_there_is_no_tie(mirror, swaps):
    def move(points):
        points = np.asarray(points) * mirror
        return points[..., ::-1] if swaps else points

    segment = np.array([[[-11.0, -2.25], [13.0, 4.5]]])
    assert sorted(rectangle_pixels(move(segment))) == sorted(move(rectangle_pixels(segment)).tolist())


@given(st.tuples(*[ON_GRID] * 4), st.booleans())
def test_pixels_are_those_whose_centre_lies_inside(ends, last_pixel):
    # Squares instead of roots, in exact fractions, for all pixels around.
    x0, y0, x1, y1 = (Fraction(end) for end in ends)
    dx, dy = x1 - x0, y1 - y0
    squared = dx * dx + dy * dy
    found = set(
        map(tuple, rectangle_pixels([[[ends[0], ends[1]], [ends[2], ends[3]]]], last_pixel=last_pixel))
    )
    if squared == 0:
        return
    for column in range(int(min(x0, x1)) - 2, int(max(x0, x1)) + 3):
        for row in range(int(min(y0, y1)) - 2, int(max(y0, y1)) + 3):
            cross, dot = dx * (row - y0) - dy * (column - x0), dx * (column - x0) + dy * (row - y0)
            beside = 4 * cross * cross - squared
            if beside == 0:
                # The point a hair to the right, or above, decides.
                step = -dy if dy else dx
                is_inside = (step > 0) == (cross < 0)
            else:
                is_inside = beside < 0
            is_inside &= 0 <= dot < squared or (dot == squared and last_pixel)
            assert ((column, row) in found) == is_inside


@given(st.integers(-40, 40), st.integers(-40, 40), st.integers(1, 5))
def test_lines_side_by_side_share_no_pixel_and_leave_none_out(dx, dy, scale):
    # Pythagorean directions: one pixel aside is on the grid, and centres lie on the long sides.
    way = scale * np.array([dx * dx - dy * dy, 2 * dx * dy])
    length = scale * (dx * dx + dy * dy)
    if length == 0 or length > 25:
        return
    aside = np.array([-way[1], way[0]]) / length
    segments = [[[0, 0] + k * aside, way + k * aside] for k in range(-3, 4)]
    exact = np.rint(np.array(segments) * 256) == np.array(segments) * 256
    if not exact.all():
        return
    pixels = rectangle_pixels(segments)
    assert len({*map(tuple, pixels)}) == len(pixels)
    wide = 0
    for column in range(-30, 31):
        for row in range(-30, 31):
            cross, dot = way[0] * row - way[1] * column, way[0] * column + way[1] * row
            wide += abs(cross) < 3.5 * length and 0 <= dot < length * length
    on_sides = sum(
        abs(way[0] * row - way[1] * column) == 3.5 * length
        and 0 <= way[0] * column + way[1] * row < length * length
        for column in range(-30, 31)
        for row in range(-30, 31)
    )
    assert wide <= len(pixels) <= wide + on_sides


@given(st.lists(st.integers(1, 2**60), min_size=1, max_size=5))
def test_half_a_pixel_times_a_root_is_exact(squared):
    half, is_exact = half_width(np.array(squared))
    assert half.tolist() == [isqrt(2**14 * value) for value in squared]
    assert is_exact.tolist() == [isqrt(2**14 * value) ** 2 == 2**14 * value for value in squared]


def test_squares_and_their_neighbours():
    roots = np.array([1, 2, 3, 2**15, 2**29 + 1, 3 * 2**27, 2**30 - 1])
    for offset in (-1, 0, 1):
        squared = np.maximum(roots * roots + offset, 1)
        assert half_width(squared)[0].tolist() == [isqrt(2**14 * int(value)) for value in squared]


def test_degenerate_and_far_segments():
    point = centers([2, 1, 2, 1])
    assert draw_lines(point, 4, 3, line="rectangle").pixels.tolist() == []
    assert draw_lines(point, 4, 3, line="rectangle", last_pixel=True).pixels.tolist() == [[2, 1]]
    assert draw_lines(np.zeros((0, 2, 2)), 4, 3, line="rectangle").pixels.shape == (0, 2)
    far = COORDINATE_LIMIT
    through = draw_lines([[[-far, -far], [far, far]]], 8, 8, line="rectangle")
    assert through.pixels.tolist() == [[i, i] for i in range(8)]
    beside = np.tile([[[-far, 40.0], [far, 30.0]]], (1000, 1, 1))
    assert len(draw_lines(beside, 8, 8, line="rectangle").pixels) == 0
