"""Every fill draws the same pixels, and they are those of exact rational arithmetic."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.coverage import fills
from core.coverage.binning import bound
from core.coverage.fills import cover, examine_pixels
from core.coverage.pixel_runs import make_raster
from core.methods import table
from tests.core.drawing import TESTING_FILLS, cover_each, edges_of, pixels, runs_of, text
from tests.core.exact_reference import exact_coverage
from tests.core.strategies import (
    ANY_TRIANGLES,
    BLOCK_SIZES,
    REGIONS,
    clip_of_window,
    grid_triangles,
    homogeneous_triangles,
)


def exact_each(clip, size, rule: str = "shared-edge", doubled_center: int = 1) -> np.ndarray:
    return np.stack([exact_coverage(triangle, size, rule, doubled_center) for triangle in clip])


@pytest.mark.parametrize("fill", TESTING_FILLS)
def test_triangle_on_pixel_centres(fill: str) -> None:
    size = (8, 6)
    clip = clip_of_window([[(1.5, 0.5), (6.5, 0.5), (1.5, 5.5)]], size)
    # The left and the bottom side own their centres; the slanted side meets none but at the corners.
    drawing = ["........", ".#......", ".##.....", ".###....", ".####...", ".#####.."]
    assert text(cover_each(clip, size, fill)[0] > 0) == drawing


@pytest.mark.parametrize("fill", TESTING_FILLS)
def test_triangle_with_a_corner_behind_the_eye_runs_off_the_window(fill: str) -> None:
    # Two corners in front at (2, 1) and (6, 1); the third, at w = -1, projects to (4, -1): the sides open
    # upwards. The left one meets the centres (1.5, 1.5) and (0.5, 2.5) and owns them, the right one does not.
    size = (8, 4)
    clip = clip_of_window([[(2, 1), (6, 1), (4, -1)]], size, [[1.0, 1.0, -1.0]])
    drawing = ["########", "#######.", ".#####..", "........"]
    assert text(cover_each(clip, size, fill)[0] > 0) == drawing


@pytest.mark.parametrize("fill", TESTING_FILLS)
@pytest.mark.parametrize("w", [[-1.0, -1.0, -1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, -2.0]])
def test_nothing_of_a_triangle_behind_the_eye_is_drawn(fill: str, w: list[float]) -> None:
    corners = np.array([[[-9, -9, 0, w[0]], [9, -9, 0, w[1]], [0, 9, 0, w[2]]]])
    assert not cover_each(corners, (8, 6), fill).any()


@pytest.mark.parametrize("fill", TESTING_FILLS)
@pytest.mark.parametrize("image", [(1, 1), (1, 5), (5, 1)])
def test_images_of_one_pixel_or_row(fill: str, image: tuple[int, int]) -> None:
    everything = [[[-9, -9, 0, 1], [9, -9, 0, 1], [0, 18, 0, 1]]]
    assert cover_each(everything, image, fill).all()


@pytest.mark.parametrize("fill", ["blocks", "hierarchy"])
@pytest.mark.parametrize("block_size", [2, 3, 4, 6, 12])
def test_a_block_that_ends_on_a_side_it_does_not_own_is_not_accepted(fill: str, block_size: int) -> None:
    # The right and the top side run through the centres of column and row 11, the last of a block.
    size = (14, 14)
    right, top = [(-30, -30.5), (11.5, -30.5), (11.5, 50.5)], [(-30.5, -30), (50.5, 11.5), (-30.5, 11.5)]
    clip = clip_of_window([right, top], size)
    drawn = cover_each(clip, size, fill, block_size=block_size)
    assert np.array_equal(drawn, exact_each(clip, size))
    assert drawn[0, 0, :11].all()
    assert drawn[1, :11, 0].all()
    assert not drawn[0, :, 11].any()
    assert not drawn[1, 11].any()


@given(ANY_TRIANGLES, BLOCK_SIZES)
def test_all_fills_draw_the_pixels_of_exact_arithmetic(case, block_size: int) -> None:
    clip, size = case
    expected = exact_each(clip, size).astype(int)
    for fill in TESTING_FILLS:
        drawn = cover_each(clip, size, fill, block_size=block_size)
        assert np.array_equal(drawn, expected), (fill, text(drawn[0]), text(expected[0]))


@given(ANY_TRIANGLES, st.sampled_from(["inclusive", "exclusive"]), st.sampled_from(TESTING_FILLS))
def test_other_tie_rules_are_exact_too(case, rule: str, fill: str) -> None:
    clip, size = case
    drawn = cover_each(clip, size, fill, fill_rule=rule) > 0
    assert np.array_equal(drawn, exact_each(clip, size, rule))


@given(ANY_TRIANGLES, st.sampled_from(TESTING_FILLS))
def test_centres_on_integers_are_exact_too(case, fill: str) -> None:
    clip, size = case
    drawn = cover_each(clip, size, fill, pixel_center="integer") > 0
    assert np.array_equal(drawn, exact_each(clip, size, doubled_center=0))


@given(homogeneous_triangles(), st.sampled_from(TESTING_FILLS))
def test_coverage_without_snapping_is_exact_where_float64_is(case, fill: str) -> None:
    clip, size = case
    drawn = cover_each(clip, size, fill, coverage="float64") > 0
    expected = [exact_coverage(triangle, size, snaps=False) for triangle in clip]
    assert np.array_equal(drawn, np.stack(expected))


@given(ANY_TRIANGLES, REGIONS, BLOCK_SIZES, st.sampled_from(TESTING_FILLS))
def test_a_region_shows_its_part_of_the_picture(case, region, block_size: int, fill: str) -> None:
    clip, size = case
    whole = cover_each(clip, size)
    column, row, columns, rows = region
    window = np.zeros(whole.shape[1:], bool)
    window[row : row + rows, column : column + columns] = True
    part = cover_each(clip, size, fill, region=region, block_size=block_size)
    assert np.array_equal(part, whole * window)


@given(
    st.lists(st.floats(-1e4, 1e4), min_size=12, max_size=12),
    st.sampled_from([(5, 4), (16, 16), (33, 7)]),
    BLOCK_SIZES,
)
@example([1.0, 2.0, 0.0, -1e-9, 0.3, 1e4, 0.0, 1e-9, -7.0, 0.1, 0.0, 3.0], (16, 16), 4)
@example(
    [0.0, 0.0, 0.0, -2.163384566918764e-60, 0.0, 1.0, 0.0, 3.0, 0.0, -317.7295279687951, 0.0, 0.0], (5, 4), 1
)
def test_fills_agree_on_any_numbers(numbers: list[float], size: tuple[int, int], block_size: int) -> None:
    clip = np.reshape(numbers, (1, 3, 4))
    expected = cover_each(clip, size, "brute-force")
    # Sums are exact where an end of every edge is snapped.
    has_exact_sums = np.count_nonzero(~edges_of(clip, size).corners.is_projected) < 2
    for fill in TESTING_FILLS:
        if has_exact_sums or fill != "incremental":
            assert np.array_equal(cover_each(clip, size, fill, block_size=block_size), expected), fill


@pytest.mark.parametrize(
    "reach", [2.0**16 - 16, 2.0**16 - 1 / 256, 2.0**16, 2.0**16 + 1 / 256, 2.0**16 + 16, 2.0**40]
)
def test_corners_at_and_past_the_snapping_limit(reach: float) -> None:
    size = (16, 16)
    clip = clip_of_window(
        [[(reach, 5.5), (3.5, reach), (-reach, 5.5)], [(2.5, 2.5), (reach, 2.5), (2.5, reach)]], size
    )
    expected = exact_each(clip, size)
    for fill in TESTING_FILLS:
        assert np.array_equal(cover_each(clip, size, fill) > 0, expected), fill


@pytest.mark.parametrize("fill", ["hierarchy", "blocks", "bounding-box", "scanline"])
@pytest.mark.parametrize("corner", [(0, 0), (8191, 8191), (8192, 8191), (16381, 16380), (16382, 16382)])
def test_a_raster_of_16384_pixels_is_exact(fill: str, corner: tuple[int, int]) -> None:
    # A diagonal that passes centres closely, and corners at the snapping limit.
    size = (16384, 16384)
    region = (*corner, 2, 2)
    end = 16383.5 - 1 / 256
    clip = clip_of_window(
        [[(0.5, 0.5), (16383.5, end), (0.5, 16383.5)], [(0.5, 0.5), (65536, 65536), (-65536, 0)]], size
    )
    for triangle in clip:
        drawn = cover_region(triangle[None], size, fill, region)
        assert np.array_equal(drawn, exact_coverage(triangle, size, region=region))


def cover_region(clip, size, fill: str, region) -> np.ndarray:
    edges, raster = edges_of(clip, size), make_raster(size, "half", region)
    covered = np.zeros(raster.shape, bool)
    for fragments, _ in cover(edges, runs_of(edges, raster, fill), raster):
        covered.ravel()[raster.index(fragments.column, fragments.row)] = True
    return covered


@given(ANY_TRIANGLES, BLOCK_SIZES, st.sampled_from(table.names("fill")))
def test_runs_look_at_a_pixel_once_and_stay_in_the_box(case, block_size: int, fill: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size), make_raster(size, "half")
    runs = runs_of(edges, raster, fill, block_size)
    boxes = bound(edges, raster)
    assert (runs.lengths >= 0).all()
    assert (np.diff(runs.group) >= 0).all()
    assert (np.diff(runs.triangle) >= 0).all()
    tests = examine_pixels(edges, runs, raster)
    seen = np.zeros((len(edges), size[1], size[0]), int)
    np.add.at(seen, (tests.primitive, tests.row, tests.column), 1)
    if fill != "scanline-lecture":  # it draws the rows where its parts meet twice over
        assert seen.max() <= 1
    for t in range(len(edges)):
        if fill not in ("brute-force", "scanline-lecture"):
            seen[t, boxes.row[t] : boxes.row_end[t], boxes.column[t] : boxes.column_end[t]] = 0
            assert not seen[t].any()


@given(ANY_TRIANGLES, BLOCK_SIZES, st.sampled_from(table.names("fill")))
def test_the_picture_decides_as_the_examined_pixels(case, block_size: int, fill: str) -> None:
    clip, size = case
    edges, raster = edges_of(clip, size), make_raster(size, "half")
    runs = runs_of(edges, raster, fill, block_size)
    tests = examine_pixels(edges, runs, raster)
    batches = list(cover(edges, runs, raster))
    for name in ("primitive", "column", "row"):
        drawn = [getattr(fragments, name) for fragments, _ in batches] or [np.empty(0, int)]
        assert np.array_equal(np.concatenate(drawn), getattr(tests, name)[tests.covered])
    if fill != "scanline-lecture":
        # Whatever is accepted without a test would have passed it.
        inside = ((tests.values > 0) | ((tests.values == 0) & edges.owns_tie[tests.primitive])).all(axis=1)
        assert inside[tests.accepted].all()


@given(case=grid_triangles(6), fill=st.sampled_from(table.names("fill")), batch=st.integers(1, 40))
def test_the_size_of_a_batch_changes_nothing(case, fill: str, batch: int) -> None:
    clip, size = case
    expected = cover_each(clip, size, fill)
    usual = fills.BATCH
    fills.BATCH = batch
    try:
        assert np.array_equal(cover_each(clip, size, fill), expected)
    finally:
        fills.BATCH = usual


@given(grid_triangles(6), st.sampled_from(TESTING_FILLS))
def test_a_triangle_is_drawn_alike_alone_and_among_others(case, fill: str) -> None:
    clip, size = case
    together = cover_each(clip, size, fill)
    alone = np.concatenate([cover_each(clip[t : t + 1], size, fill) for t in range(len(clip))])
    assert np.array_equal(together, alone)


@given(ANY_TRIANGLES, st.integers(0, 2), st.booleans())
def test_coverage_does_not_depend_on_the_first_corner_or_the_winding(case, first: int, turned: bool) -> None:
    clip, size = case
    other = np.roll(clip, first, axis=1)[:, :: -1 if turned else 1]
    assert np.array_equal(cover_each(other, size), cover_each(clip, size))


@given(ANY_TRIANGLES)
def test_statistics_count_what_happened(case) -> None:
    clip, size = case
    frame = render(ClipScene(clip, size=size), Settings(fill="brute-force", visibility="last-drawn"))
    counts = frame.statistics
    assert counts["transform"].incoming == len(clip)
    assert counts["cull"].outgoing == counts["edges"].incoming
    drawable = int((edges_of(clip, size).doubled_area != 0).sum())
    assert counts["bin"].outgoing <= drawable * size[0] * size[1]
    assert counts["raster"].incoming == counts["bin"].outgoing
    assert counts["raster"].outgoing >= frame.cover_count.sum()
    assert counts["depth"].outgoing == (frame.primitive >= 0).sum()
    assert counts["resolve"].incoming == frame.primitive.size


def test_pixels_reads_a_drawing_from_the_top() -> None:
    assert pixels(["#.", ".."])[1, 0]
