"""Edge functions against determinants of fractions, the tie rule in every direction, and their listings."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from core.coverage.edges import cross, edge_value, is_inside, orient
from core.coverage.fill_rule import exclusive, inclusive
from core.coverage.snapping import place_corners
from core.methods import table
from tests.core.drawing import edges_of, facing_of
from tests.core.exact_reference import determinant, facing, homogeneous_window
from tests.core.strategies import ANY_TRIANGLES, clip_of_window, grid_triangles, homogeneous_triangles

DIRECTIONS = [
    (1, 0),
    (1, 1),
    (0, 1),
    (-1, 1),
    (-1, 0),
    (-1, -1),
    (0, -1),
    (1, -1),
    (3, 1),
    (-1, 3),
    (-3, -1),
    (1, -3),
]


@given(grid_triangles(), st.integers(0, 15), st.integers(0, 15))
def test_values_are_exact_for_projected_corners(case, column: int, row: int) -> None:
    clip, size = case
    edges = edges_of(clip, size)
    assume(edges.corners.is_projected.all())
    x, y = column + 0.5, row + 0.5
    for t in range(len(edges)):
        corner = [tuple(Fraction(float(p)) for p in edges.corners.decided[t, k]) for k in range(3)]
        turn = int(np.sign(edges.doubled_area[t]))
        for k in range(3):
            (x1, y1), (x2, y2) = corner[k - 2], corner[k - 1]
            expected = turn * ((x2 - x1) * (Fraction(y) - y1) - (y2 - y1) * (Fraction(x) - x1))
            assert (
                edge_value(edges.a[t, k], edges.b[t, k], edges.c[t, k], x, y) == float(expected) == expected
            )


@given(grid_triangles())
def test_the_three_values_add_up_to_the_doubled_area(case) -> None:
    clip, size = case
    edges = edges_of(clip, size)
    assume(edges.corners.is_projected.all())
    total = edge_value(edges.a, edges.b, edges.c, 0.5, 0.5)
    assert np.array_equal(total[:, 0] + total[:, 1] + total[:, 2], np.abs(edges.doubled_area))


@given(ANY_TRIANGLES)
def test_facing_is_the_sign_of_the_determinant(case) -> None:
    clip, size = case
    assert facing_of(clip, size).tolist() == [facing(triangle, size) for triangle in clip]


@given(homogeneous_triangles())
def test_determinant_where_a_corner_cannot_be_projected(case) -> None:
    clip, size = case
    value = orient(place_corners(clip, size, "float64"))
    for t, triangle in enumerate(clip):
        rows = [homogeneous_window(corner, size) for corner in triangle]
        assert value[t] == float(determinant(*rows))


@given(ANY_TRIANGLES)
def test_edge_k_is_zero_at_its_ends_and_positive_at_corner_k(case) -> None:
    clip, size = case
    edges = edges_of(clip, size)
    t, k = np.nonzero(edges.corners.is_projected & (edges.corners.is_projected.all(axis=1))[:, None])
    x, y = edges.corners.decided[t, k].T
    values = edge_value(edges.a[t], edges.b[t], edges.c[t], x[:, None], y[:, None])
    others = np.arange(3) != k[:, None]
    assert not values[others].any()
    assert np.array_equal(values[~others], np.abs(edges.doubled_area[t]))


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_tie_rule_on_an_edge_of_every_direction(direction: tuple[int, int]) -> None:
    # The edge runs through the centre (8.5, 8.5); its inside lies to the left of its direction. The point
    # moved a step right, then a far smaller step up, lies on the left of the edge or on the right.
    dx, dy = direction
    center = np.array([8.5, 8.5])
    start, end = center - 3 * np.array(direction), center + 3 * np.array(direction)
    third = center + 5 * np.array([-dy, dx])
    edges = edges_of(clip_of_window([[third, start, end]], (16, 16)), (16, 16))
    assert edge_value(edges.a[0, 0], edges.b[0, 0], edges.c[0, 0], 8.5, 8.5) == 0
    step_right, step_up = (1.0, 0.0), (1.0, 1e-6)
    left_of_edge = [dx * step[1] - dy * step[0] for step in (step_right, step_up)]
    assert edges.owns_tie[0, 0] == ((left_of_edge[0] or left_of_edge[1]) > 0)
    # Seen from the other side exactly the other triangle owns it.
    across = edges_of(clip_of_window([[2 * center - third, end, start]], (16, 16)), (16, 16))
    assert edges.owns_tie[0, 0] != across.owns_tie[0, 0]


@pytest.mark.parametrize(
    ("corners", "expected"),
    [
        ([(2.5, 2.5), (6.5, 2.5), (2.5, 6.5)], True),  # left edge and level bottom edge meet
        ([(2.5, 2.5), (6.5, 2.5), (6.5, 6.5)], True),  # level bottom edge and the slanted edge above it
        ([(-2.5, 2.5), (2.5, 2.5), (2.5, 6.5)], False),  # right edge
        ([(-2.5, -2.5), (2.5, -2.5), (2.5, 2.5)], False),  # the top corner of a right edge
        ([(2.5, 2.5), (6.5, 0.5), (6.5, 4.5)], True),  # a corner that points left
        ([(-2.5, 0.5), (2.5, 2.5), (-2.5, 4.5)], False),  # a corner that points right
        (
            [(2.5, 2.5), (4.5, 6.5), (0.5, 6.5)],
            False,
        ),  # a corner that points down: the point moves out to the right
        ([(2.5, 2.5), (0.5, -1.5), (4.5, -1.5)], False),  # a corner that points up
    ],
)
def test_centre_on_a_corner(corners: list[tuple[float, float]], expected: bool) -> None:
    edges = edges_of(clip_of_window([corners], (8, 8)), (8, 8))
    values = edge_value(edges.a[0], edges.b[0], edges.c[0], 2.5, 2.5)
    assert is_inside(values, edges.owns_tie[0]).all() == expected


def test_other_rules_own_every_edge_or_none() -> None:
    a, b = np.array([[1.0, -1.0, 0.0]]), np.array([[0.0, 2.0, -1.0]])
    assert inclusive(a, b).all()
    assert not exclusive(a, b).any()
    assert table.names("fill_rule")[0] == "shared-edge"


@given(st.lists(st.floats(-1e6, 1e6), min_size=6, max_size=6))
def test_the_ends_of_an_edge_may_change_places(numbers: list[float]) -> None:
    x1, y1, w1, x2, y2, w2 = numbers
    there, back = cross(x1, y1, w1, x2, y2, w2), cross(x2, y2, w2, x1, y1, w1)
    assert there == tuple(-value for value in back)


@given(ANY_TRIANGLES)
def test_values_are_monotone_in_column_and_row(case) -> None:
    # What blocks and spans rest on.
    clip, size = case
    edges = edges_of(clip, size)
    columns, rows = np.arange(30) + 0.5, np.arange(30) + 0.5
    a, b, c = (n.reshape(-1, 1, 1) for n in (edges.a, edges.b, edges.c))
    values = edge_value(a, b, c, columns[None, None, :], rows[None, :, None])
    assert (np.diff(values, axis=2) * np.sign(a) >= 0).all()
    assert (np.diff(values, axis=1) * np.sign(b) >= 0).all()
