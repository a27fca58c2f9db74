"""Exact depth, attributes and visibility against second derivations: barycentric solutions in fractions."""

from fractions import Fraction

import numpy as np
import pytest

from core.coverage.measured_exactly import count_pixels, exact_spans
from core.interpolation.measured import exact_fragments, exact_values, exact_visible
from core.study.workloads import cyclic_triangles, overlapping_triangles

SIZE = (12, 10)


def shares_at(corners, x: Fraction, y: Fraction) -> list[Fraction]:
    """Solve for the clip-space barycentric shares of the corners in the ray through a window position (Cramer)."""
    nx, ny = 2 * x / SIZE[0] - 1, 2 * y / SIZE[1] - 1
    exact = [[Fraction(float(value)) for value in corner] for corner in corners]
    # The point sum(s_k p_k) has x = nx w and y = ny w, and the shares add up to 1.
    rows = [[p[0] - nx * p[3] for p in exact], [p[1] - ny * p[3] for p in exact], [Fraction(1)] * 3]
    right = [Fraction(0), Fraction(0), Fraction(1)]

    def determinant(m) -> Fraction:
        return (
            m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
        )

    whole = determinant(rows)
    found = []
    for k in range(3):
        replaced = [[right[i] if j == k else rows[i][j] for j in range(3)] for i in range(3)]
        found.append(determinant(replaced) / whole)
    return found


def depth_at(corners, x: Fraction, y: Fraction) -> Fraction:
    shares = shares_at(corners, x, y)
    z, w = (sum(s * Fraction(float(c[k])) for s, c in zip(shares, corners, strict=True)) for k in (2, 3))
    return (z / w + 1) / 2


def test_values_are_those_of_the_shares_correctly_rounded() -> None:
    corners = overlapping_triangles(SIZE, 1, 4)[0]
    values = np.array([[0.1, -7.0], [0.7, 1e-3], [3.0, 2.0]])
    row, column = (index.ravel() for index in np.mgrid[0 : SIZE[1], 0 : SIZE[0]])
    found = exact_values(corners, values, SIZE, column, row)
    for place, (i, j) in enumerate(zip(column.tolist(), row.tolist(), strict=True)):
        shares = shares_at(corners, Fraction(2 * i + 1, 2), Fraction(2 * j + 1, 2))
        for k in range(2):
            exact = sum(s * Fraction(float(v)) for s, v in zip(shares, values[:, k], strict=True))
            assert found[place, k] == float(exact)


def test_edge_on_has_no_values() -> None:
    corners = np.array([[-1, -1, 0, 1], [0, 0, 0, 1], [1, 1, 0, 1]], float)
    assert np.isnan(exact_values(corners, np.eye(3), SIZE, np.array([3]), np.array([2]))).all()


@pytest.mark.parametrize("seed", [1, 2])
def test_the_nearest_is_seen_and_depths_are_exact(seed: int) -> None:
    clip = overlapping_triangles(SIZE, 5, seed)
    fragments = exact_fragments(clip, SIZE)
    seen = exact_visible(fragments, SIZE)
    nearest: dict[tuple[int, int], tuple[Fraction, int]] = {}
    triangle, column, row = exact_spans(clip, SIZE).pixels()
    for number, i, j in zip(triangle.tolist(), column.tolist(), row.tolist(), strict=True):
        depth = depth_at(clip[number], Fraction(2 * i + 1, 2), Fraction(2 * j + 1, 2))
        nearest[i, j] = min(nearest.get((i, j), (Fraction(2), -1)), (depth, number))
    expected = np.full((SIZE[1], SIZE[0]), -1)
    for (i, j), (_, number) in nearest.items():
        expected[j, i] = number
    assert np.array_equal(seen, expected)
    for number, i, j, depth in zip(
        fragments.triangle.tolist(),
        fragments.column.tolist(),
        fragments.row.tolist(),
        fragments.depth.tolist(),
        strict=True,
    ):
        assert depth == float(depth_at(clip[number], Fraction(2 * i + 1, 2), Fraction(2 * j + 1, 2)))


def test_depths_that_round_alike_are_compared_as_fractions_and_ties_keep_the_first() -> None:
    everything = np.array([[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]], float)
    clip = np.stack([everything] * 4)
    clip[:, :, 2] = np.array([0.5, 0.5, 0.5, 0.5])[:, None]
    clip[2, :, 2] = 0.5 - 2.0**-54  # (z + 1)/2 rounds to the same float64 as that of the others
    assert (exact_visible(exact_fragments(clip, SIZE), SIZE) == 2).all()
    assert (exact_visible(exact_fragments(clip[:2], SIZE), SIZE) == 0).all()


def test_no_order_of_the_three_bars_is_right() -> None:
    clip = cyclic_triangles((48, 48))
    fragments = exact_fragments(clip, (48, 48))
    covers = np.stack(
        [
            count_pixels(
                fragments.column[fragments.triangle == k], fragments.row[fragments.triangle == k], (48, 48)
            )
            for k in range(3)
        ]
    ).astype(bool)
    seen = exact_visible(fragments, (48, 48))
    hides = {
        (first, second)
        for first in range(3)
        for second in range(3)
        if first != second and (covers[first] & covers[second] & (seen == first)).any()
    }
    assert {(0, 1), (1, 2), (2, 0)} <= hides or {(1, 0), (2, 1), (0, 2)} <= hides


def test_depth_out_of_range_is_left_out_pixel_by_pixel() -> None:
    # From z/w = -3 on the left to 1 on the right: the left half lies before the near plane.
    clip = np.array(
        [[[-1, -1, -3, 1], [1, -1, 1, 1], [1, 1, 1, 1]], [[-1, -1, -3, 1], [1, 1, 1, 1], [-1, 1, -3, 1]]]
    )
    fragments = exact_fragments(clip.astype(float), (8, 4))
    assert sorted(set(fragments.column.tolist())) == [4, 5, 6, 7]
    assert len(fragments.column) == 16
