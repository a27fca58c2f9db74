"""Interpolation against fractions: perspective exact, affine linear in the window, flat one corner's."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from core import Settings, draw_triangles
from core.coverage.snapping import place_corners
from core.interpolation.interpolation import interpolate, plane_value, set_up_planes, value_plane
from tests.core.exact_reference import determinant, homogeneous_window
from tests.core.strategies import clip_of_window, homogeneous_triangles, perspective_triangles

PIXELS = st.tuples(st.integers(0, 15), st.integers(0, 15))
FIRST = np.zeros(1, np.int64)


def exact_weights(triangle, size, column: int, row: int) -> tuple[list[Fraction], Fraction]:
    """Return the corners' shares of the point seen at a pixel centre, and its 1/w, by Cramer's rule."""
    rows = [homogeneous_window(corner, size) for corner in triangle]
    pixel = (Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2), Fraction(1))
    whole = determinant(*rows)
    shares = [determinant(*rows[:k], pixel, *rows[k + 1 :]) / whole for k in range(3)]
    total = sum(shares)
    return ([share / total for share in shares] if total else []), total


def weights_at(clip, size, column: int, row: int, mode: str, provoking: str = "last"):
    planes = set_up_planes(place_corners(clip, size, "snapped").homogeneous)
    x, y = np.array([column + 0.5]), np.array([row + 0.5])
    weights, _ = interpolate(planes, np.zeros((len(clip), 3, 0)), FIRST, x, y, mode, provoking)
    return weights[0], planes


def has_area(clip, size) -> bool:
    """Return whether each triangle is seen from a side by more than a thousandth of a pixel."""
    return all(
        abs(determinant(*(homogeneous_window(corner, size) for corner in triangle))) > Fraction(1, 1000)
        for triangle in clip
    )


@given(st.one_of(perspective_triangles(1), homogeneous_triangles(1)), PIXELS)
def test_perspective_weights_are_those_of_exact_arithmetic(case, pixel) -> None:
    clip, size = case
    assume(has_area(clip, size))
    expected, inverse_w = exact_weights(clip[0], size, *pixel)
    assume(abs(inverse_w) > Fraction(1, 1000))
    weights, planes = weights_at(clip, size, *pixel, "perspective")
    bound = 1e-9 * max(1, *(abs(float(share)) for share in expected))
    assert np.allclose(weights, [float(share) for share in expected], rtol=1e-9, atol=bound)
    plane = value_plane(planes, np.ones((1, 3)))
    found = plane_value(plane, FIRST, np.array([pixel[0] + 0.5]), np.array([pixel[1] + 0.5]))[0]
    assert found == pytest.approx(float(inverse_w), rel=1e-9, abs=1e-9)


@given(
    st.one_of(perspective_triangles(1), homogeneous_triangles(1)),
    PIXELS,
    st.sampled_from(["perspective", "affine"]),
)
def test_weights_add_up_to_one(case, pixel, mode: str) -> None:
    clip, size = case
    assume(has_area(clip, size) and (mode == "perspective" or (clip[..., 3] > 0).all()))
    weights, _ = weights_at(clip, size, *pixel, mode)
    assume(np.isfinite(weights).all())
    assert weights.sum() == pytest.approx(1, abs=1e-12 * max(1, np.abs(weights).max()))


@given(perspective_triangles(1), PIXELS)
def test_affine_weights_are_the_areas_in_the_window(case, pixel) -> None:
    clip, size = case
    (x0, y0), (x1, y1), (x2, y2) = place_corners(clip, size, "snapped").window[0]
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    assume(abs(area) > 0.01)
    x, y = pixel[0] + 0.5, pixel[1] + 0.5
    second = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
    third = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
    weights, _ = weights_at(clip, size, *pixel, "affine")
    bound = 1e-8 * max(1, abs(second), abs(third))
    assert np.allclose(weights, [1 - second - third, second, third], rtol=1e-9, atol=bound)


@given(perspective_triangles(1), PIXELS, st.sampled_from([0.25, 1.0, 3.0]))
def test_affine_equals_perspective_where_w_is_equal(case, pixel, w: float) -> None:
    clip, size = case
    level = clip / clip[..., 3:] * w
    assume(has_area(level, size))
    affine, _ = weights_at(level, size, *pixel, "affine")
    perspective, _ = weights_at(level, size, *pixel, "perspective")
    assert np.allclose(affine, perspective, rtol=1e-12, atol=1e-12 * max(1, np.abs(perspective).max()))


def test_affine_errs_as_the_lecture_says() -> None:
    # w = 1 and 4 at the ends of a floor: in the middle of the window the near end counts 4/5, not 1/2.
    clip = clip_of_window([[(0.5, 0.5), (4.5, 0.5), (0.5, 9.5)]], (5, 10), [[1.0, 4.0, 1.0]])
    assert weights_at(clip, (5, 10), 2, 0, "perspective")[0].tolist() == pytest.approx(
        [0.8, 0.2, 0], abs=1e-12
    )
    assert weights_at(clip, (5, 10), 2, 0, "affine")[0].tolist() == pytest.approx([0.5, 0.5, 0], abs=1e-12)


@pytest.mark.parametrize("mode", ["perspective", "affine"])
def test_the_value_of_a_corner_stands_at_the_corner(mode: str) -> None:
    corners = [(1.5, 1.5), (6.5, 2.5), (2.5, 6.5)]
    clip = clip_of_window([corners], (8, 8), [[1.0, 2.5, 0.5]])
    for k, (x, y) in enumerate(corners):
        weights, _ = weights_at(clip, (8, 8), int(x), int(y), mode)
        assert np.allclose(weights, np.eye(3)[k], atol=1e-12)


@pytest.mark.parametrize(("provoking", "corner"), [("last", 2), ("first", 0)])
def test_flat_takes_the_provoking_corner(provoking: str, corner: int) -> None:
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)]], (8, 8))
    assert weights_at(clip, (8, 8), 1, 1, "flat", provoking)[0].tolist() == np.eye(3)[corner].tolist()
    settings = Settings(interpolation="flat", provoking=provoking)
    frame = draw_triangles(clip, 8, 8, attributes=[[[1.0], [2.0], [3.0]]], settings=settings)
    assert (frame.attributes[frame.primitive == 0] == [1.0, 2.0, 3.0][corner]).all()


HORIZON = np.array(
    [
        [[-1 / 4, -1 / 4, -0.225, 1 / 4], [-1 / 4, -1.5 / 7, -0.225, 1 / 4], [0, -1 / 4, -0.225, 1 / 4]],
        [[3, -16.5 / 7, -1.35, 1.5], [-6, 12 / 7, -1.35, 1.5], [12, -18 / 7, -2.7, 3]],
    ]
)
"""1/w of the second triangle is 0 at a pixel above the raster (1, 7)."""


@given(
    perspective_triangles(3),
    st.lists(PIXELS, min_size=1, max_size=20),
    st.sampled_from(["perspective", "affine"]),
)
@example((HORIZON, (1, 7)), [(0, 0), (0, 0), (0, 0), (0, 12)], "perspective")
def test_a_fragment_gets_the_same_values_alone_and_among_others(case, at, mode: str) -> None:
    clip, size = case
    assume(has_area(clip, size))
    planes = set_up_planes(place_corners(clip, size, "snapped").homogeneous)
    varyings = np.random.default_rng(len(at)).uniform(-1, 1, (len(clip), 3, 5))
    primitive = np.arange(len(at)) % len(clip)
    x, y = np.array(at, float).T + 0.5
    together = interpolate(planes, varyings, primitive, x, y, mode, "last")
    for n in range(len(at)):
        one = slice(n, n + 1)
        alone = interpolate(planes, varyings, primitive[one], x[one], y[one], mode, "last")
        assert np.array_equal(alone[0], together[0][one], equal_nan=True)
        assert np.array_equal(alone[1], together[1][one], equal_nan=True)


@given(homogeneous_triangles(2), st.lists(st.floats(-9, 9), min_size=3, max_size=3))
def test_planes_are_linear_over_the_window(case, values: list[float]) -> None:
    clip, size = case
    planes = set_up_planes(place_corners(clip, size, "snapped").homogeneous)
    plane = value_plane(planes, np.broadcast_to(values, (len(clip), 3)))
    assume(np.isfinite(plane).all())
    x, y = np.array([0.5, 8.5, 4.5]), np.array([2.5, 6.5, 4.5])
    for t in range(len(clip)):
        ends = plane_value(plane, np.full(3, t), x, y)
        assert ends[2] == pytest.approx(
            (ends[0] + ends[1]) / 2, rel=1e-9, abs=1e-9 * (1 + np.abs(ends).max())
        )


@given(perspective_triangles(2))
def test_the_planes_meet_the_corners(case) -> None:
    clip, size = case
    corners = place_corners(clip, size, "snapped")
    planes = set_up_planes(corners.homogeneous)
    z, w = clip[..., 2], clip[..., 3]
    depth = value_plane(planes, (z + w) / 2)
    inverse_w = value_plane(planes, np.ones(w.shape))
    (x0, y0), (x1, y1), (x2, y2) = np.moveaxis(corners.window, 0, -1)
    area = np.abs((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0))
    for t in np.flatnonzero(area > 1):
        x, y = corners.window[t].T
        at = np.full(3, t)
        assert np.allclose(plane_value(depth, at, x, y), (z[t] / w[t] + 1) / 2, atol=1e-8)
        assert np.allclose(plane_value(inverse_w, at, x, y), 1 / w[t], atol=1e-8)


@pytest.mark.parametrize("mode", ["perspective", "affine", "flat"])
def test_a_triangle_seen_edge_on_that_snapping_opens_has_finite_values(mode: str) -> None:
    # Its three corners lie on a line before snapping, and beside it afterwards.
    points = [(1.0, 1.0), (4.0, 1.0 + 1.5 / 256), (7.0, 1.0 + 3 / 256)]
    clip = clip_of_window([[(1.0, 0.5), (4.0, 0.5 + 1.5 / 256), (7.0, 0.5 + 3 / 256)], points], (8, 8))
    planes = set_up_planes(place_corners(clip, (8, 8), "snapped").homogeneous)
    values = np.array([[[1.0], [2.0], [6.0]]] * 2)
    for t in range(2):
        columns = np.arange(8) + 0.5
        weights, value = interpolate(planes, values, np.full(8, t), columns, np.full(8, 0.5), mode, "last")
        assert np.isfinite(weights).all()
        assert np.isfinite(value).all()
    plane = value_plane(planes, np.array([[1.0, 2.0, 6.0]] * 2))
    assert np.isfinite(plane).all()


def test_edge_on_takes_the_mean_of_the_corners() -> None:
    homogeneous = np.array([[[1.0, 1.0, 1.0], [4.0, 1.0, 1.0], [7.0, 1.0, 1.0]]])
    planes = set_up_planes(homogeneous)
    weights, value = interpolate(
        planes,
        np.array([[[1.0], [2.0], [6.0]]]),
        FIRST,
        np.array([3.5]),
        np.array([1.0]),
        "perspective",
        "last",
    )
    assert weights[0].tolist() == pytest.approx([1 / 3] * 3)
    assert value[0].tolist() == pytest.approx([3.0])


def test_edge_on_with_corners_behind_the_eye_takes_the_mean_of_those_in_front() -> None:
    # 1/w of the three corners add up to 0.
    homogeneous = np.array([[[1.0, 1.0, 1.0], [-8.0, -2.0, -2.0], [-14.0, -2.0, -2.0]]])
    planes = set_up_planes(homogeneous)
    values = np.array([[[1.0], [2.0], [6.0]]])
    weights, value = interpolate(
        planes, values, FIRST, np.array([3.5]), np.array([1.0]), "perspective", "last"
    )
    assert weights[0].tolist() == [1, 0, 0]
    assert value[0].tolist() == [1]
    assert (plane_value(value_plane(planes, np.ones((1, 3))), FIRST, np.zeros(1), np.zeros(1)) > 0).all()
