"""Affine interpolation corrected every n pixels: exact with n = 1, worse with every n, and its closed form."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.coverage.snapping import place_corners
from core.interpolation.corrected_affine import corrected_affine, largest_affine_error, place_anchors
from core.interpolation.interpolation import affine, perspective, plane_value, set_up_planes, value_plane
from core.trace import trace
from tests.core.exact_reference import determinant, homogeneous_window
from tests.core.strategies import perspective_triangles

INTERVALS = st.sampled_from([1, 2, 3, 4, 7, 16, 64, 256])
TILTED = np.array([[1.0, 2, 1], [1200, 60, 6], [160, 900, 10]])
"""x, y, w of corners, x and y times w: the window positions are (1, 2), (200, 10), (16, 90)."""


def covered_pixels(homogeneous: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the centres that lie in a triangle of positive w."""
    x, y = (np.ravel(part) + 0.5 for part in np.meshgrid(np.arange(220), np.arange(100)))
    shares = perspective(set_up_planes(homogeneous[None]), np.zeros(len(x), np.int64), x, y, 0, 1)
    inside = (shares >= 0).all(axis=1)
    return x[inside], y[inside]


def rules(homogeneous: np.ndarray, x: np.ndarray, y: np.ndarray, interval: int):
    planes, which = set_up_planes(homogeneous[None]), np.zeros(len(x), np.int64)
    return (
        perspective(planes, which, x, y, 0, interval),
        corrected_affine(planes, which, x, y, 0, interval),
        place_anchors(planes, which, x, y, interval),
    )


@given(perspective_triangles(1), st.integers(-5, 20), st.integers(-5, 20))
def test_corrected_at_every_pixel_it_is_perspective_bit_for_bit(case, column, row) -> None:
    clip, size = case
    corners = [homogeneous_window(corner, size) for corner in clip[0]]
    assume(abs(determinant(*corners)) > Fraction(1, 1000))
    homogeneous = place_corners(clip, size, "snapped").homogeneous[0]
    for center in (0.0, 0.5):
        x, y = np.array([column + center]), np.array([row + center])
        exact, found, _ = rules(homogeneous, x, y, 1)
        if np.isfinite(exact).all():
            assert np.array_equal(found, exact)


def test_pictures_corrected_at_every_pixel_are_those_of_perspective() -> None:
    clip = [[[-0.9, -0.8, 0.2, 1], [2.7, -2.1, 0.6, 3], [0.4, 1.8, 0.9, 2]]]
    scene = ClipScene(clip, np.eye(3)[None], (64, 48))
    exact = render(scene, Settings(interpolation="perspective"))
    found = render(scene, Settings(interpolation="affine-n", correction_interval=1))
    assert np.array_equal(exact.color, found.color)


def test_at_the_anchors_it_is_perspective_and_between_them_linear() -> None:
    x, y = covered_pixels(TILTED)
    exact, found, anchors = rules(TILTED, x, y, 16)
    at_left = x == anchors.left
    assert at_left.sum() > 100
    assert np.array_equal(found[at_left], exact[at_left])
    assert (anchors.left <= x).all()
    assert (anchors.right >= x).all()
    assert (anchors.right - anchors.left <= 16).all()
    # Three neighbours of one interval lie on a line.
    same = (
        (y[2:] == y[:-2])
        & (anchors.left[2:] == anchors.left[:-2])
        & (anchors.right[2:] == anchors.right[:-2])
    )
    assert same.sum() > 1000
    bend = found[2:] - 2 * found[1:-1] + found[:-2]
    assert np.abs(bend[same]).max() < 1e-13


def test_anchors_are_columns_of_the_grid_or_ends_of_the_row() -> None:
    x, y = covered_pixels(TILTED)
    _, _, anchors = rules(TILTED, x, y, 8)
    is_column = (anchors.left - 0.5) % 8 == 0
    is_row_end = anchors.left == anchors.row_left
    assert (is_column | is_row_end).all()
    assert is_column.any()
    assert is_row_end.any()
    assert ((anchors.right - 0.5) % 8 == 0).any()
    assert (((anchors.right - 0.5) % 8 == 0) | (anchors.right == anchors.row_right)).all()


@given(perspective_triangles(1), st.integers(0, 15), INTERVALS)
def test_row_ends_are_those_of_exact_arithmetic(case, row, interval) -> None:
    clip, size = case
    corners = [homogeneous_window(corner, size) for corner in clip[0]]
    assume(abs(determinant(*corners)) > Fraction(1, 10))
    y = Fraction(2 * row + 1, 2)
    points = [(x / w, h / w) for x, h, w in corners]
    crossings = []
    for k in range(3):
        (x0, y0), (x1, y1) = points[k], points[(k + 1) % 3]
        if (y0 <= y) != (y1 <= y):
            crossings.append(x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    assume(len(crossings) == 2)
    left, right = sorted(crossings)
    middle = float((left + right) / 2)
    homogeneous = place_corners(clip, size, "snapped").homogeneous[0]
    _, found, anchors = rules(homogeneous, np.array([middle]), np.array([float(y)]), interval)
    limit = 1e-6 * max(1.0, float(max(abs(left), abs(right))))
    assert anchors.row_left[0] == pytest.approx(float(left), abs=limit)
    assert anchors.row_right[0] == pytest.approx(float(right), abs=limit)
    # Within the row 1/w is positive at both anchors, and the weights are shares.
    plane = value_plane(set_up_planes(homogeneous[None]), np.ones((1, 3)))
    for anchor in (anchors.left, anchors.right):
        assert plane_value(plane, np.zeros(1, np.int64), anchor, np.array([float(y)]))[0] > 0
    assert found.sum() == pytest.approx(1, abs=1e-9)
    assert found.min() > -1e-6


def test_the_error_grows_with_the_interval_and_stays_within_the_closed_form() -> None:
    x, y = covered_pixels(TILTED)
    planes, which = set_up_planes(TILTED[None]), np.zeros(len(x), np.int64)
    inverse_w = value_plane(planes, np.ones((1, 3)))
    largest = []
    for interval in (1, 2, 4, 8, 16, 32, 64, 128, 256):
        exact, found, anchors = rules(TILTED, x, y, interval)
        error = np.abs(found - exact)
        largest.append(error.max())
        ends = [plane_value(inverse_w, which, anchor, y) for anchor in (anchors.left, anchors.right)]
        part = largest_affine_error(ends[0] / ends[1])[:, None]
        at_ends = [perspective(planes, which, anchor, y, 0, 1) for anchor in (anchors.left, anchors.right)]
        assert (error <= part * np.abs(at_ends[1] - at_ends[0]) + 1e-12).all()
    assert largest[0] == 0
    assert (np.diff(largest) > 0).all()
    whole = np.abs(affine(planes, which, x, y, 0, 1) - rules(TILTED, x, y, 1)[0]).max()
    assert largest[4] < whole / 10


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0, 4.0, 9.0, 100.0, 0.25])
def test_the_closed_form_is_what_affine_interpolation_strays(ratio) -> None:
    # An edge along a row from w = 1 to w = ratio; the weight of its second corner is the parameter.
    homogeneous = np.array([[0.0, 0, 1], [1000 * ratio, 0, ratio], [0, 1000, 1]])
    planes, x = set_up_planes(homogeneous[None]), np.linspace(0, 1000, 100001)
    which, y = np.zeros(len(x), np.int64), np.zeros(len(x))
    strayed = np.abs(affine(planes, which, x, y, 0, 1)[:, 1] - perspective(planes, which, x, y, 0, 1)[:, 1])
    expected = largest_affine_error(np.array([ratio]))[0]
    assert strayed.max() == pytest.approx(expected, abs=1e-8)
    assert expected == pytest.approx(largest_affine_error(np.array([1 / ratio]))[0], rel=1e-12)
    if ratio > 1:
        assert x[strayed.argmax()] / 1000 == pytest.approx(ratio**0.5 / (ratio**0.5 + 1), abs=1e-3)


def test_where_w_changes_its_sign_clipping_is_inserted() -> None:
    clip = [[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 0.5, 0, -1]]]
    scene, settings = ClipScene(clip, np.eye(3)[None], (16, 12)), Settings(interpolation="affine-n")
    assert trace(scene, settings).source.geometry.clipping_inserted == "affine-n"
    assert np.isfinite(render(scene, settings).color).all()


@given(perspective_triangles(3), INTERVALS)
def test_it_does_not_depend_on_the_batch(case, interval) -> None:
    clip, size = case
    planes = set_up_planes(place_corners(clip, size, "snapped").homogeneous)
    generator = np.random.default_rng(1)
    x, y = generator.integers(0, 20, (2, 50)) + 0.5
    which = generator.integers(0, len(clip), 50)
    together = corrected_affine(planes, which, x, y, 0, interval)
    for k in range(50):
        one = slice(k, k + 1)
        alone = corrected_affine(planes, which[one], x[one], y[one], 0, interval)
        assert np.array_equal(together[one], alone, equal_nan=True)
