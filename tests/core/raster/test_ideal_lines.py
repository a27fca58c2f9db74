"""The references that lines are measured against, against second derivations."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.raster.lines.ideal import cover_ideal_lines, line_distance

COORDINATE = st.one_of(
    st.integers(-8, 24).map(float), st.integers(-16, 48).map(lambda n: n / 2), st.floats(-8, 24)
)
SEGMENT = st.tuples(*[COORDINATE] * 4)
SIZE = 48
SHIFT = 16
"""The raster of this size, moved by this much, holds every segment whole."""


def picture_of(segment) -> np.ndarray:
    """Coverage of one segment on the whole raster."""
    pixels, coverage, owner = cover_ideal_lines(np.array(segment).reshape(1, 2, 2) + SHIFT, SIZE, SIZE)
    assert (owner == 0).all()
    assert len(np.unique(pixels, axis=0)) == len(pixels)
    picture = np.zeros((SIZE, SIZE))
    picture[pixels[:, 1], pixels[:, 0]] = coverage
    return picture


def clip_half_plane(polygon, a, b, c):
    """Keep the part of a polygon where a x + b y + c >= 0 (Sutherland and Hodgman), in exact fractions."""
    kept = []
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        first, second = a * x0 + b * y0 + c, a * x1 + b * y1 + c
        if first >= 0:
            kept.append((x0, y0))
        if first * second < 0:
            t = first / (first - second)
            kept.append((x0 + t * (x1 - x0), y0 + t * (y1 - y0)))
    return kept


def area_of(polygon) -> Fraction:
    pairs = zip(polygon, polygon[1:] + polygon[:1], strict=True)
    return sum((x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in pairs), Fraction(0)) / 2


@given(SEGMENT)
def test_the_area_is_that_of_the_clipped_polygon_in_exact_fractions(segment):
    x0, y0, x1, y1 = (value + SHIFT for value in segment)
    picture = picture_of(segment)
    length = np.hypot(x1 - x0, y1 - y0)
    if length == 0:
        assert not picture.any()
        return
    half = [Fraction(float(value)) for value in ((y0 - y1) * 0.5 / length, (x1 - x0) * 0.5 / length)]
    ends = [(Fraction(x0), Fraction(y0)), (Fraction(x1), Fraction(y1))]
    signs = [(0, -1), (1, -1), (1, 1), (0, 1)]
    rectangle = [(ends[k][0] + sign * half[0], ends[k][1] + sign * half[1]) for k, sign in signs]
    some = np.argwhere(picture > 0)
    beside = np.argwhere(picture == 0)
    middle = np.array([(y0 + y1) / 2, (x0 + x1) / 2])
    beside = beside[np.argsort(np.hypot(*(beside - middle).T), kind="stable")]
    for row, column in [*some[:: max(len(some) // 12, 1)].tolist(), *beside[:6].tolist()]:
        polygon = clip_half_plane(rectangle, 1, 0, -column)
        polygon = clip_half_plane(polygon, -1, 0, column + 1)
        polygon = clip_half_plane(polygon, 0, 1, -row)
        polygon = clip_half_plane(polygon, 0, -1, row + 1)
        wanted = float(area_of(polygon)) if len(polygon) > 2 else 0.0
        assert abs(picture[row, column] - wanted) < 1e-12


@given(SEGMENT)
def test_the_areas_add_up_to_the_length(segment):
    x0, y0, x1, y1 = segment
    assert abs(picture_of(segment).sum() - np.hypot(x1 - x0, y1 - y0)) < 1e-9


def test_areas_by_hand():
    # A level line across the border between two rows, its ends in the middle of pixels.
    pixels, coverage, _ = cover_ideal_lines([[[0.5, 1.0], [2.5, 1.0]]], 4, 3)
    assert pixels.tolist() == [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]]
    assert coverage.tolist() == [0.25, 0.5, 0.25] * 2
    # A long diagonal through the middle of a pixel leaves two corners of legs 1 - sqrt(1/2).
    pixels, coverage, _ = cover_ideal_lines([[[-9.0, -9.0], [9.0, 9.0]]], 4, 4)
    at = dict(zip(map(tuple, pixels.tolist()), coverage, strict=True))
    legs = 1 - np.sqrt(0.5)
    assert np.isclose(at[1, 1], 1 - legs * legs)
    assert np.isclose(at[2, 1], (np.sqrt(0.5)) ** 2 / 2)
    # Far outside there is nothing to do.
    far = 2.0**20
    assert len(cover_ideal_lines([[[-far, 40.0], [far, 30.0]]] * 50, 8, 8)[0]) == 0


def test_centres_on_whole_numbers_move_the_raster_by_half():
    segments = np.array([[[0.25, 0.5], [9.0, 4.75]], [[7.0, 1.0], [2.5, 8.0]]])
    half = cover_ideal_lines(segments + 0.5, 10, 9)
    whole = cover_ideal_lines(segments, 10, 9, "integer")
    for first, second in zip(half, whole, strict=True):
        np.testing.assert_array_equal(first, second)


def test_distances_from_the_line():
    pixels = np.array([[0, 0], [3, 4], [5, 1], [3, 4]])
    segments = [[[0.5, 0.5], [5.5, 0.5]], [[1.0, 1.0], [1.0, 1.0]], [[0.0, 0.0], [1.0, 1.0]]]
    found = line_distance(pixels, np.array([0, 0, 1, 2]), segments)
    np.testing.assert_allclose(found, [0, 4, np.hypot(4.5, 0.5), np.sqrt(0.5)])
    whole = line_distance(pixels[:2], np.array([0, 0]), segments, "integer")
    np.testing.assert_allclose(whole, [0.5, 3.5])
