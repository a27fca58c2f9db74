"""The packed keys keep what testing the fragments one by one keeps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.depth.depth import BLOCK, READ_AT_ONCE, NearestFragments, run_depth_tests, stack_fragments
from core.methods import table

PIXEL_COUNT = 6


@st.composite
def drawings(draw):
    """Draw (pixel, primitive, stored) of fragments in drawing order, primitives not decreasing."""
    count = draw(st.integers(1, 8))
    fragments = draw(
        st.lists(
            st.tuples(st.integers(0, count - 1), st.integers(0, PIXEL_COUNT - 1)), max_size=40, unique=True
        )
    )
    fragments.sort()
    primitive = np.array([p for p, _ in fragments], np.int64)
    pixel = np.array([at for _, at in fragments], np.int64)
    depths = st.sampled_from([0.0, 0.125, 0.5, 0.5000001, 0.999, 1.0, 3.5])
    stored = np.array(draw(st.lists(depths, min_size=len(pixel), max_size=len(pixel))), np.float32)
    return count, pixel, primitive, stored


@given(drawings(), st.sampled_from(table.names("depth")), st.booleans(), st.integers(1, 9), st.randoms())
def test_equals_testing_one_by_one(drawing, name: str, uses_depth_test: bool, batch: int, random) -> None:
    count, pixel, primitive, stored = drawing
    depth_format = table.get("depth", name).function()
    if name != "inverse-w":
        stored = np.minimum(stored, np.float32(1))
    if depth_format.scale != 1:
        stored = np.rint(stored.astype(np.float64) * depth_format.scale).astype(depth_format.stored_type)
    nearest = NearestFragments(PIXEL_COUNT, count, depth_format, uses_depth_test)
    # In batches, and the batches in any order: the key knows the drawing order.
    starts = list(range(0, len(pixel), batch))
    random.shuffle(starts)
    for start in starts:
        part = slice(start, start + batch)
        nearest.add(pixel[part], primitive[part], stored[part])
    seen, owner, depth = nearest.resolve()

    expected_depth = np.full(PIXEL_COUNT, depth_format.cleared, depth_format.stored_type)
    expected_owner = np.full(PIXEL_COUNT, -1)
    tests = run_depth_tests(stored, stack_fragments(pixel), expected_depth, depth_format, uses_depth_test)
    for f in np.flatnonzero(tests.passes):
        expected_depth[pixel[f]] = stored[f]
        expected_owner[pixel[f]] = primitive[f]
    assert np.array_equal(depth, expected_depth)
    found = np.full(PIXEL_COUNT, -1)
    found[seen] = owner
    assert np.array_equal(found, expected_owner)


@pytest.mark.parametrize("uses_depth_test", [True, False])
@pytest.mark.parametrize("name", table.names("depth"))
def test_nothing_drawn_is_cleared(name: str, uses_depth_test: bool) -> None:
    depth_format = table.get("depth", name).function()
    pixel, primitive, depth = NearestFragments(4, 0, depth_format, uses_depth_test).resolve()
    assert len(pixel) == len(primitive) == 0
    assert (depth == depth_format.cleared).all()


def test_two_million_triangles_still_fit_the_key() -> None:
    depth_format = table.get("depth", "z-float32").function()
    count = 2**31 - 2
    for uses_depth_test, expected in ((True, 0), (False, count - 1)):
        nearest = NearestFragments(1, count, depth_format, uses_depth_test)
        stored = np.full(2, 0.5, np.float32)
        nearest.add(np.zeros(2, np.int64), np.array([0, count - 1]), stored)
        assert nearest.resolve()[1].tolist() == [expected]


@pytest.mark.parametrize("share", [0.0, 0.001, 0.3, 1.0])
def test_what_is_seen_comes_in_order_and_in_few_parts(share: float) -> None:
    count = 3 * READ_AT_ONCE + 17
    rng = np.random.default_rng(7)
    pixel = np.flatnonzero(rng.random(count) < share)
    primitive = np.sort(rng.integers(0, 500, len(pixel)))
    nearest = NearestFragments(count, 500, table.get("depth", "z-float32").function(), True)
    nearest.add(pixel, primitive, np.full(len(pixel), 0.25, np.float32))
    parts = list(nearest.seen())
    empty = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    found_place, found_primitive = (np.concatenate(of) for of in zip(*(parts or empty), strict=True))
    assert np.array_equal(found_place, pixel)
    assert np.array_equal(found_primitive, primitive)
    assert all(0 < len(place) <= BLOCK for place, _ in parts)
    assert len(parts) <= len(pixel) / BLOCK + 4
