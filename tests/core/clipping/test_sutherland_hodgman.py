"""Clipping: nothing grows or is lost inside, attributes stay linear, neighbours get the same new corner."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core import Settings, draw_triangles
from core.clipping.sutherland_hodgman import (
    ALL_PLANES,
    CASES,
    DEPTH_PLANES,
    Clipped,
    clip_polygons,
    clip_primitives,
    distance_from,
)
from core.culling.culling import plane_distances
from core.records.primitives import Primitives
from tests.core.drawing import cover_each
from tests.core.strategies import ANY_TRIANGLES, homogeneous_triangles, perspective_triangles

PLANE_SETS = st.sampled_from([ALL_PLANES, DEPTH_PLANES, (0,), (3, 4)])
TOLERANCE = 1e-9


def clipped(clip, planes=ALL_PLANES, varyings=None) -> Clipped:
    count = len(clip)
    values = np.zeros((count, 3, 0)) if varyings is None else varyings
    primitives = Primitives(np.asarray(clip, float), values, np.arange(count) * 10, np.arange(count), {})
    return clip_primitives(primitives, plane_distances(primitives.clip), planes)


def square_area(polygon) -> float:
    """Return the area of a polygon (M, 4) in 4D clip space; it is flat."""
    total = 0.0
    for second, third in pairwise(polygon[1:]):
        wedge = np.outer(second - polygon[0], third - polygon[0])
        total += np.linalg.norm(wedge - wedge.T) / np.sqrt(8)
    return float(total)


def test_corner_cut_off_makes_a_quad_of_two_pieces() -> None:
    triangle = [[[0, 0, 0, 1], [2, 0, 0, 1], [0, 0.5, 0, 1]]]
    result = clipped(triangle, planes=(3,))
    assert result.counts[-1].tolist() == [4]
    assert result.polygons[-1][0, :4, :2].tolist() == [[1, 0], [1, 0.25], [0, 0.5], [0, 0]]
    assert len(result.primitives) == 2
    assert result.primitives.triangle.tolist() == [0, 0]
    assert [CASES[case] for case in result.rows.case] == ["in-out", "out-in", "in-in"]
    assert result.rows.t[:2].tolist() == [0.5, 0.5]
    assert np.isnan(result.rows.t[2])


def test_the_near_plane_cuts_what_reaches_behind_the_eye() -> None:
    triangle = [[[0, 0, 1, 1], [1, 0, 1, 1], [0, 0, -3, -1]]]
    result = clipped(triangle, planes=(0,))
    assert result.polygons[-1][0, :4, 3].tolist() == pytest.approx([1, 1 / 3, 1 / 3, 1])
    assert (result.primitives.clip[..., 3] > 0).all()


def test_pieces_keep_their_place_their_triangle_and_their_mesh() -> None:
    inside = [[0, 0, 0, 1], [0.5, 0, 0, 1], [0, 0.5, 0, 1]]
    crossing = [[0, 0, 0, 1], [2, 0, 0, 1], [0, 0.5, 0, 1]]
    outside = [[2, 0, 0, 1], [3, 0, 0, 1], [2, 1, 0, 1]]
    result = clipped([inside, crossing, outside, inside])
    assert result.primitives.triangle.tolist() == [0, 10, 10, 30]
    assert result.primitives.mesh.tolist() == [0, 1, 1, 3]
    assert result.clipped.tolist() == [1, 2]
    assert np.array_equal(result.primitives.clip[[0, 3]], np.array([inside, inside]))


@given(homogeneous_triangles(), PLANE_SETS)
def test_after_each_plane_the_polygon_lies_inside_it(case, planes) -> None:
    clip, _ = case
    result = clipped(clip, planes)
    scale = np.abs(clip).max() + 1
    for n in range(len(planes)):
        for polygon, count in zip(result.polygons[n + 1], result.counts[n + 1], strict=True):
            within = plane_distances(polygon[:count])[:, list(planes[: n + 1])]
            assert (within >= -TOLERANCE * scale).all()


@given(ANY_TRIANGLES, st.integers(0, 5))
def test_clipping_and_culling_measure_the_same_distance(case, plane: int) -> None:
    clip, _ = case
    assert np.array_equal(distance_from(clip, plane), plane_distances(clip)[..., plane])


@given(homogeneous_triangles(), PLANE_SETS)
def test_area_never_grows(case, planes) -> None:
    clip, _ = case
    result = clipped(clip, planes)
    for n in range(len(planes)):
        for q in range(len(result.clipped)):
            before = square_area(result.polygons[n][q, : result.counts[n][q]])
            after = square_area(result.polygons[n + 1][q, : result.counts[n + 1][q]])
            assert after <= before * (1 + TOLERANCE) + TOLERANCE


@given(homogeneous_triangles(1), st.integers(0, 5))
def test_what_is_cut_off_and_what_is_left_make_up_the_whole(case, plane: int) -> None:
    clip, _ = case
    polygon, count, _ = clip_polygons(clip, np.array([3]), plane)
    # The half on the other side, cut by hand in fractions.
    distance = [Fraction(float(d)) for d in distance_from(clip[0], plane)]
    other: list[np.ndarray] = []
    for k in range(3):
        i, j = k, (k + 1) % 3
        if distance[i] <= 0:
            other.append(clip[0, i])
        if distance[i] * distance[j] < 0:
            t = float(distance[i] / (distance[i] - distance[j]))
            other.append(clip[0, i] + t * (clip[0, j] - clip[0, i]))
    whole = square_area(clip[0])
    assert square_area(polygon[0, : count[0]]) + square_area(np.array(other)) == pytest.approx(
        whole, abs=1e-9
    )


@given(perspective_triangles(1))
def test_the_pieces_cover_the_window_as_the_triangle_does(case) -> None:
    # New corners are snapped again: only where a side passes a centre within 1/128 pixel may they differ.
    clip, size = case
    pieces = clipped(clip).primitives.clip
    covered = cover_each(pieces, size).sum(axis=0) if len(pieces) else np.zeros((size[1], size[0]), int)
    assert covered.max() <= 1
    whole = cover_each(clip, size)[0]
    near = np.abs(clip[..., 2]).max() > 0.99 * clip[..., 3].min()
    differing = covered != whole
    if near or not differing.any():
        return
    widths = sides_distance(clip[0], size)
    assert (widths[differing] < 1 / 128).all()


def sides_distance(triangle, size) -> np.ndarray:
    """Return (H, W) least distance in pixels of each centre from the lines of the three sides."""
    w = triangle[:, 3]
    x, y = (triangle[:, 0] / w + 1) * size[0] / 2, (triangle[:, 1] / w + 1) * size[1] / 2
    columns, rows = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    distances = []
    for k in range(3):
        i, j = k - 2, k - 1
        dx, dy = x[j] - x[i], y[j] - y[i]
        length = np.hypot(dx, dy)
        if length:
            distances.append(np.abs(dx * (rows - y[i]) - dy * (columns - x[i])) / length)
    return np.min(distances, axis=0) if distances else np.zeros(columns.shape)


@given(ANY_TRIANGLES, PLANE_SETS)
def test_new_corners_lie_on_the_triangle_and_carry_its_linear_values(case, planes) -> None:
    # Values that are the clip position itself must come out as the clip position of the new corner.
    clip, _ = case
    result = clipped(clip, planes, varyings=clip.copy())
    scale = np.abs(clip).max() + 1
    assert np.allclose(result.primitives.varyings, result.primitives.clip, rtol=0, atol=1e-12 * scale)


@given(homogeneous_triangles(1), PLANE_SETS, st.integers(0, 2**32 - 1))
def test_attributes_are_linear_combinations_of_the_corners(case, planes, seed: int) -> None:
    clip, _ = case
    rows = clip[0]
    assume(np.linalg.matrix_rank(rows) == 3)
    values = np.random.default_rng(seed).uniform(-1, 1, (1, 3, 2))
    result = clipped(clip, planes, values)
    corners = result.primitives.clip.reshape(-1, 4)
    weights = corners @ np.linalg.pinv(rows)
    assume(np.linalg.cond(rows) < 1e4)
    assert np.allclose(weights.sum(axis=1), 1, atol=1e-8) or not len(corners)
    assert np.allclose(weights @ values[0], result.primitives.varyings.reshape(-1, 2), atol=1e-8)
    assert (weights > -1e-8).all()


@given(st.lists(st.floats(-4, 4), min_size=8, max_size=8), st.integers(0, 5))
def test_an_edge_gets_the_same_new_corner_from_both_sides(numbers: list[float], plane: int) -> None:
    start, end = np.reshape(numbers, (2, 4))
    third = np.array([0.1, 0.2, 0.3, 1.0])
    there, _, rows_there = clip_polygons(np.array([[start, end, third]]), np.array([3]), plane)
    back, _, rows_back = clip_polygons(np.array([[end, start, third]]), np.array([3]), plane)
    assume((distance_from(start, plane) >= 0) != (distance_from(end, plane) >= 0))
    assert np.array_equal(rows_there.corner[0], rows_back.corner[0])
    assert rows_there.t[0] == rows_back.t[0]
    assert (there == rows_there.corner[0]).all(axis=2).any()
    assert (back == rows_back.corner[0]).all(axis=2).any()


@given(ANY_TRIANGLES)
def test_no_planes_and_triangles_inside_change_nothing(case) -> None:
    clip, _ = case
    result = clipped(clip, ())
    assert np.array_equal(result.primitives.clip, clip)
    assert len(result.rows.plane) == 0
    inside = (plane_distances(clip) >= 0).all(axis=(1, 2))
    kept = clipped(clip).primitives
    whole = np.isin(kept.triangle, np.flatnonzero(inside) * 10)
    assert np.array_equal(kept.clip[whole], clip[inside])


@pytest.mark.parametrize(("provoking", "expected"), [("last", 3.0), ("first", 1.0)])
def test_the_provoking_value_survives_clipping(provoking: str, expected: float) -> None:
    # Both corners that may provoke are cut off.
    clip = [[[-3, -1, 0.2, 1], [0, 0.5, 0.2, 1], [3, -1, 0.2, 1]]]
    values = [[[1.0], [2.0], [3.0]]]
    for clipping in ("homogeneous", "sutherland-hodgman"):
        settings = Settings(interpolation="flat", provoking=provoking, clipping=clipping)
        frame = draw_triangles(clip, 8, 8, attributes=values, settings=settings)
        assert set(frame.attributes[frame.primitive == 0].ravel().tolist()) == {expected}


@given(homogeneous_triangles(1))
def test_clipping_and_none_draw_alike_up_to_the_new_corners(case) -> None:
    clip, size = case
    whole, cut = (
        draw_triangles(clip, *size, settings=Settings(clipping=name))
        for name in ("homogeneous", "sutherland-hodgman")
    )
    differing = (whole.primitive != cut.primitive).sum()
    # A side of up to 16 + 16 pixels that is turned by 1/256 pixel passes few centres.
    assert differing <= 8


def test_polygons_that_rounding_makes_concave_are_clipped_too() -> None:
    # With coordinates of very different sizes new corners are rounded to either side of a plane.
    triangle = [
        [3.39793714559767e23, 1.392140314142641e24, 3.1772024342736874e23, 5.450224817130815e23],
        [9.902300965794345e43, 1.6332624160584218e44, 1.2270409292003973e44, 3.772149528268927e43],
        [2.0781545397606397e17, -1.2236035778514135e18, 2.9206254410355155e17, -1.0371697599458227e18],
    ]
    found = clipped([triangle])
    widths = [polygon.shape[1] for polygon in found.polygons]
    assert widths[-1] > 3 + len(ALL_PLANES)
    assert all(width >= count.max() for width, count in zip(widths, found.counts, strict=True))
