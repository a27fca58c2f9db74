"""The lecture's three cases, the conservative test of blocks, and the two levels of the hierarchy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.coverage.binning import bound, one_level, two_levels
from core.coverage.pixel_runs import BEHIND, INSIDE, LEAF, MIXED, OUTSIDE, PROJECTED, SPLIT, make_raster
from tests.core.drawing import cover_each, edges_of
from tests.core.strategies import ANY_TRIANGLES, REGIONS, clip_of_window

SIZE = (16, 12)


def box_of(clip, size=SIZE, center: str = "half", region=None) -> tuple[int, int, int, int, int]:
    boxes = bound(edges_of(clip, size), make_raster(size, center, region))
    return tuple(int(values[0]) for values in boxes)


@pytest.mark.parametrize(
    ("corners", "expected"),
    [
        ([(2, 2), (5, 2), (2, 6)], (2, 2, 5, 6)),
        ([(2.5, 2.5), (5.5, 2.5), (2.5, 6.5)], (2, 2, 6, 7)),
        ([(2.501, 2.499), (5.499, 2.499), (2.501, 6.501)], (2, 2, 6, 7)),  # snapped onto the centres
        ([(2.51, 2.51), (5.49, 2.51), (2.51, 6.49)], (3, 3, 5, 6)),
        ([(-9, -9), (40, -9), (-9, 40)], (0, 0, 16, 12)),
    ],
)
def test_projected_triangle_has_the_box_of_its_centres(corners, expected) -> None:
    assert box_of(clip_of_window([corners], SIZE)) == (PROJECTED, *expected)


def test_centres_on_integers_move_the_box() -> None:
    clip = clip_of_window([[(2, 2), (5, 2), (2, 6)]], SIZE)
    assert box_of(clip, center="integer") == (PROJECTED, 2, 2, 6, 7)


@pytest.mark.parametrize(
    "corners", [[(20, 2), (25, 2), (20, 6)], [(2.6, 2), (3.4, 2), (3, 6)], [(2, 2), (5, 2), (8, 2)]]
)
def test_nothing_is_looked_at_outside_between_centres_or_without_area(corners) -> None:
    _, column, row, column_end, row_end = box_of(clip_of_window([corners], SIZE))
    assert (column_end - column) * (row_end - row) == 0


@pytest.mark.parametrize(
    ("w", "case"),
    [
        ((1, 1, 1), PROJECTED),
        ((-1, -1, -1), BEHIND),
        ((0, -1, 0), BEHIND),
        ((1, -1, 1), MIXED),
        ((1, 0, 1), MIXED),
    ],
)
def test_the_three_cases(w: tuple[float, float, float], case: int) -> None:
    clip = np.array([[[-0.5, -0.5, 0, w[0]], [0.5, -0.5, 0, w[1]], [0, 0.5, 0, w[2]]]])
    found, column, row, column_end, row_end = box_of(clip)
    assert found == case
    if case == MIXED:
        assert (column, row, column_end, row_end) == (0, 0, 16, 12)
    if case == BEHIND:
        assert (column_end, row_end) == (column, row)


def test_a_corner_too_far_away_to_be_snapped_counts_as_not_projected() -> None:
    assert box_of(clip_of_window([[(2, 2), (65536, 2), (2, 6)]], SIZE))[0] == PROJECTED
    assert box_of(clip_of_window([[(2, 2), (65537, 2), (2, 6)]], SIZE))[0] == MIXED


@given(ANY_TRIANGLES, REGIONS)
def test_the_box_holds_every_covered_pixel_of_the_region(case, region) -> None:
    clip, size = case
    boxes = bound(edges_of(clip, size), make_raster(size, "half", region))
    covered = cover_each(clip, size, "brute-force", region=region)
    for t in range(len(clip)):
        outside = covered[t].copy()
        outside[boxes.row[t] : boxes.row_end[t], boxes.column[t] : boxes.column_end[t]] = 0
        assert not outside.any()


@given(ANY_TRIANGLES, st.sampled_from([1, 2, 3, 5, 8]), st.sampled_from([2, 3, 4]))
def test_nodes_are_in_pre_order_and_say_the_truth(case, block_size: int, factor: int) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size), make_raster(size, "half")
    boxes = bound(edges, raster)
    covered = cover_each(clip, size, "brute-force") > 0
    for blocks in (
        one_level(edges, boxes, raster, block_size),
        two_levels(edges, boxes, raster, block_size, factor),
    ):
        count = len(blocks.triangle)
        assert (np.diff(blocks.triangle) >= 0).all()
        assert (blocks.subtree_end > np.arange(count)).all()
        assert (blocks.subtree_end <= count).all()
        for n in range(count):
            parent = blocks.parent[n]
            if parent >= 0:
                assert blocks.verdict[parent] == SPLIT
                assert parent < n < blocks.subtree_end[parent]
                assert blocks.triangle[parent] == blocks.triangle[n]
                assert blocks.column[parent] <= blocks.column[n] < blocks.column[parent] + blocks.size[parent]
                assert blocks.row[parent] <= blocks.row[n] < blocks.row[parent] + blocks.size[parent]
            if blocks.verdict[n] != SPLIT:
                assert blocks.subtree_end[n] == n + 1
            rows = slice(blocks.row[n], blocks.row[n] + blocks.size[n])
            columns = slice(blocks.column[n], blocks.column[n] + blocks.size[n])
            there = covered[blocks.triangle[n], rows, columns]
            if blocks.verdict[n] == OUTSIDE:
                assert not there.any()
                assert 0 <= blocks.rejected_by[n] < 3
            else:
                assert blocks.rejected_by[n] == -1
            if blocks.verdict[n] == INSIDE:
                assert there.all()
            if there.any():
                assert blocks.verdict[n] in (INSIDE, SPLIT, LEAF)


@given(ANY_TRIANGLES, st.sampled_from([1, 2, 3, 8]))
def test_edge_ranges_are_those_of_the_pixels(case, block_size: int) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size), make_raster(size, "half")
    blocks = one_level(edges, bound(edges, raster), raster, block_size)
    for n in range(0, len(blocks.triangle), 5):
        t = blocks.triangle[n]
        x = blocks.column[n] + np.arange(block_size) + 0.5
        y = blocks.row[n] + np.arange(block_size) + 0.5
        for k in range(3):
            values = edges.a[t, k] * x[None, :] + (edges.b[t, k] * y[:, None] + edges.c[t, k])
            assert (blocks.low[n, k], blocks.high[n, k]) == (values.min(), values.max())


@pytest.mark.parametrize("coverage", ["float64", "float32", "float16", "inverse", "exact"])
def test_formats_that_do_not_snap_look_at_no_more_than_a_pixel_around_the_box(coverage: str) -> None:
    clip = clip_of_window([[(2.5, 2.5), (5.25, 2.5), (2.5, 6.75)]], SIZE)
    boxes = bound(edges_of(clip, SIZE, coverage), make_raster(SIZE, "half", None))
    found = [int(values[0]) for values in boxes]
    assert found[1:] == [2, 2, 6, 7]
    behind = bound(
        edges_of(clip * np.array([1, 1, 1, -1.0])[None, None], SIZE, coverage),
        make_raster(SIZE, "half", None),
    )
    assert int(behind.case[0]) == BEHIND
