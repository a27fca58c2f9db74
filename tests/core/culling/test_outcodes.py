"""Outcodes say the same as the signed distances from the planes, whatever the size of the numbers."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.culling.culling import (
    BEHIND_BIT,
    PLANE_BITS,
    RANGE_BIT,
    has_bits,
    joined_bits,
    outcodes,
    plane_distances,
    shared_bits,
)

TINY = float(np.finfo(float).smallest_subnormal)
NUMBERS = st.one_of(
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 0.5, 1 + 2**-52, TINY, -TINY, 1e60, -1e60, 1e300, -1e300]),
    st.floats(allow_nan=False),
)
POSITIONS = st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS), min_size=3, max_size=12)


@given(POSITIONS)
def test_a_bit_for_each_negative_distance(positions) -> None:
    clip = np.array(positions)
    z, w = clip[:, 2], clip[:, 3]
    with np.errstate(over="ignore", invalid="ignore"):
        outside = plane_distances(clip) < 0
    code = outcodes(clip)
    assert np.array_equal(np.stack([has_bits(code, 1 << plane) for plane in range(6)], axis=1), outside)
    assert np.array_equal(has_bits(code, BEHIND_BIT), w <= 0)
    assert np.array_equal(has_bits(code, RANGE_BIT), ~((w > 0) & (z >= -w) & (z <= w)))


@given(POSITIONS, st.integers(0, 2**32 - 1))
def test_bits_of_triangles(positions, seed: int) -> None:
    code = outcodes(np.array(positions))
    corner = np.random.default_rng(seed).integers(0, len(code), (3, 7))
    assert np.array_equal(shared_bits(code, corner), np.bitwise_and.reduce(code[corner], axis=0))
    assert np.array_equal(joined_bits(code, corner), np.bitwise_or.reduce(code[corner], axis=0))


def test_nothing_is_gathered_where_all_vertices_are_inside() -> None:
    code = outcodes(np.array([[0.0, 0, 0, 1]] * 3))
    assert not code.any()
    assert shared_bits(code, np.array([[0], [1], [2]])).tolist() == [0]
    assert not has_bits(joined_bits(code, np.array([[0], [1], [2]])), PLANE_BITS | RANGE_BIT).any()
