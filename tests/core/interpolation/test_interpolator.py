"""Blocks of fragments give the values of the rule, bit for bit, however primitives share what is interpolated."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.interpolation.interpolation import (
    FEW_PRIMITIVES,
    Interpolator,
    interpolate,
    perspective,
    set_up_planes,
)
from core.interpolation.mixing import BLOCK, LocalNumbers
from core.methods import table
from core.records.primitives import CornerValues

MODES = ["perspective", "affine", "flat"]


def random_case(primitive_count, fragment_count, value_count=5, seed=0):
    random = np.random.default_rng(seed)
    homogeneous = random.uniform(-4, 4, (primitive_count, 3, 3)) + np.array([0, 0, 6])
    varyings = random.normal(size=(primitive_count, 3, value_count))
    # As in rows of pixels: most neighbours belong to the same primitive.
    primitive = random.integers(0, primitive_count, fragment_count // 3 + 1).repeat(3)[:fragment_count]
    x, y = random.integers(0, 64, (2, fragment_count)) + 0.5
    return set_up_planes(homogeneous), varyings, primitive, x, y


def by_the_formula(weights, varyings, primitive):
    w0, w1, w2 = (weights[:, k, None] for k in range(3))
    v0, v1, v2 = (varyings[primitive, k] for k in range(3))
    return w0 * v0 + w1 * v1 + w2 * v2


@pytest.mark.parametrize("primitive_count", [1, 7, FEW_PRIMITIVES, FEW_PRIMITIVES + 1, 20000])
@pytest.mark.parametrize("mode", MODES)
def test_values_are_those_of_the_formula(mode, primitive_count):
    planes, varyings, primitive, x, y = random_case(primitive_count, 2 * BLOCK + 5)
    weights, values = interpolate(planes, varyings, primitive, x, y, mode, "last")
    assert np.array_equal(values, by_the_formula(weights, varyings, primitive), equal_nan=True)
    picture = Interpolator(planes, varyings, table.get("interpolation", mode).function, 2).values(
        primitive, x, y
    )
    assert np.array_equal(values, picture, equal_nan=True)


def test_memory_that_is_given_is_used():
    planes, varyings, primitive, x, y = random_case(50, 100)
    rows = np.zeros((5, 100))
    values = Interpolator(planes, varyings, perspective, 2).values(primitive, x, y, rows)
    assert np.shares_memory(values, rows)
    assert values.shape == (100, 5)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("primitive_count", [3, FEW_PRIMITIVES + 500])
def test_equal_and_shared_values(mode, primitive_count):
    planes, varyings, primitive, x, y = random_case(primitive_count, 5000, 9)
    varyings[..., 1], varyings[..., 2], varyings[..., 3] = 1, varyings[..., 0], 0
    varyings[..., 4], varyings[..., 5] = -0.0, np.nan
    varyings[..., 7] = varyings[..., 6]
    varyings[0, 0, 7] += 1  # differs at one corner
    varyings[1, :, 8], varyings[0, :, 8] = 0.0, -0.0
    weights, values = interpolate(planes, varyings, primitive, x, y, mode, "first")
    expected = by_the_formula(weights, varyings, primitive)
    assert np.array_equal(values, expected, equal_nan=True)
    assert np.array_equal(np.signbit(values[:, [3, 4, 8]]), np.signbit(expected[:, [3, 4, 8]]))


@pytest.mark.parametrize("primitive_count", [40, 4 * FEW_PRIMITIVES])
def test_corners_may_share_rows(primitive_count):
    planes, _, primitive, x, y = random_case(primitive_count, 3000)
    random = np.random.default_rng(1)
    shared = CornerValues(random.normal(size=(77, 4)), {}, random.integers(0, 77, (3, primitive_count)))
    own = Interpolator(planes, shared.at_corners, perspective, 2).values(primitive, x, y)
    assert np.array_equal(Interpolator(planes, shared, perspective, 2).values(primitive, x, y), own)


def test_no_fragments_no_primitives_no_values():
    for primitive_count, value_count in ((0, 4), (3, 0), (0, 0)):
        planes = set_up_planes(np.ones((primitive_count, 3, 3)))
        none = np.empty(0, np.int64)
        varyings = np.empty((primitive_count, 3, value_count))
        weights, values = interpolate(planes, varyings, none, none + 0.5, none + 0.5, "perspective", "last")
        assert (weights.shape, values.shape) == ((0, 3), (0, value_count))


@given(primitive=st.lists(st.integers(0, 30), min_size=1, max_size=60))
def test_local_numbers(primitive):
    shown, local = LocalNumbers(31).number(np.array(primitive))
    assert sorted(shown.tolist()) == sorted(set(primitive))
    assert shown[local].tolist() == primitive
