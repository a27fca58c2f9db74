"""The exact referee of coverage against a second derivation: pixel by pixel, from the definition."""

from fractions import Fraction

import numpy as np
import pytest

from core.coverage.measured_exactly import (
    columns_inside,
    count_pixels,
    exact_spans,
    homogeneous_corner,
    may_hold_a_center,
    triangle_lines,
    whole_corner,
)
from core.study.workloads import clip_of_window, window_mesh
from tests.core.exact_reference import exact_coverage
from tests.core.one_ended import one_ended_triangles

SIZE = (9, 7)


def random_clip(seed: int, count: int, on_centers: bool) -> np.ndarray:
    """Return triangles with corners on pixel centres or anywhere, some with corners behind the eye."""
    source = np.random.default_rng(seed)
    window = source.uniform(-4, 12, (count, 3, 2))
    if on_centers:
        window = np.floor(window) + 0.5
    w = source.uniform(0.5, 3, (count, 3)) * source.choice([1, 1, 1, -1], (count, 3))
    return clip_of_window(window, SIZE, np.full((count, 3), 0.5), w)


@pytest.mark.parametrize("rule", ["shared-edge", "inclusive", "exclusive"])
@pytest.mark.parametrize("is_snapped", [True, False])
@pytest.mark.parametrize("on_centers", [True, False])
def test_rows_solved_for_columns_are_the_pixels_tested_one_by_one(
    rule: str, is_snapped: bool, on_centers: bool
) -> None:
    clip = random_clip(11, 40, on_centers)
    triangle, column, row = exact_spans(clip, SIZE, is_snapped=is_snapped, rule=rule).pixels()
    assert len(triangle) > 100
    for number, corners in enumerate(clip):
        chosen = triangle == number
        expected = exact_coverage(corners, SIZE, rule, snaps=is_snapped)
        assert np.array_equal(count_pixels(column[chosen], row[chosen], SIZE), expected), number


def test_edges_with_one_end_are_moved_and_not_turned() -> None:
    clip = one_ended_triangles(3, 60, SIZE)
    triangle, column, row = exact_spans(clip, SIZE).pixels()
    for number, corners in enumerate(clip):
        chosen = triangle == number
        expected = exact_coverage(corners, SIZE)
        assert np.array_equal(count_pixels(column[chosen], row[chosen], SIZE), expected), number


def test_centres_on_whole_numbers() -> None:
    clip = random_clip(5, 10, True)
    spans = exact_spans(clip, SIZE, pixel_center="integer")
    triangle, column, row = spans.pixels()
    for number, corners in enumerate(clip):
        chosen = triangle == number
        expected = exact_coverage(corners, SIZE, doubled_center=0)
        assert np.array_equal(count_pixels(column[chosen], row[chosen], SIZE), expected)


@pytest.mark.parametrize("steps", [2, 1024])
def test_a_mesh_without_gaps_covers_every_pixel_once(steps: int) -> None:
    window = window_mesh((24, 16), 5, 3, steps)
    level = np.ones(window.shape[:2])
    spans = exact_spans(clip_of_window(window, (24, 16), 0.5 * level, level), (24, 16), is_snapped=False)
    _, column, row = spans.pixels()
    assert (count_pixels(column, row, (24, 16)) == 1).all()


def test_nothing_is_covered_edge_on_or_behind_the_eye() -> None:
    flat = [[-1, -1, 0, 1], [0, 0, 0, 1], [1, 1, 0, 1]]
    behind = [[-1, -1, 0, -1], [3, -1, 0, -1], [-1, 3, 0, -1]]
    assert len(exact_spans(np.array([flat, behind], float), SIZE).row) == 0


@pytest.mark.parametrize("is_snapped", [True, False])
@pytest.mark.parametrize("pixel_center", ["half", "integer"])
def test_only_triangles_that_cover_nothing_are_passed_over(is_snapped: bool, pixel_center: str) -> None:
    source = np.random.default_rng(7)
    doubled = 1 if pixel_center == "half" else 0
    place = source.uniform(-2, 11, (600, 1, 2))
    # From 1/1000 of a pixel to a pixel wide, half of them with a corner within 1/512 pixel of a centre.
    window = place + source.normal(size=(600, 3, 2)) * 10.0 ** source.uniform(-3, 0, (600, 1, 1))
    window[::2, 0] = np.floor(place[::2, 0]) + doubled / 2 + source.uniform(-1, 1, (300, 2)) / 512
    clip = clip_of_window(window, SIZE, np.full((600, 3), 0.5), source.uniform(0.5, 3, (600, 3)))
    may_cover = may_hold_a_center(clip, SIZE, doubled / 2)
    assert 0.2 < may_cover.mean() < 0.8
    for corners in clip[~may_cover]:
        lines, rows = triangle_lines(corners, SIZE, is_snapped)
        stretches = [
            columns_inside(lines, 2 * row + doubled, doubled, "inclusive", SIZE[0]) for row in rows if lines
        ]
        assert all(start >= stop for start, stop in stretches)


def test_triangles_without_a_box_are_looked_at() -> None:
    behind = [[-1, -1, 0, 1], [3, -1, 0, 1], [0, 3, 0, -1]]
    far = [[1e300, 0, 0, 1e-300], [-1, -1, 0, 1], [1, -1, 0, 1]]
    beside = [[2, 0, 0, 1], [3, 0, 0, 1], [2, 1, 0, 1]]
    assert may_hold_a_center(np.array([behind, far, beside], float), SIZE, 0.5).tolist() == [
        True,
        True,
        False,
    ]


@pytest.mark.parametrize("is_snapped", [True, False])
def test_whole_corners_are_where_the_corners_are(is_snapped: bool) -> None:
    for corners in random_clip(2, 20, False):
        for corner in corners:
            x, y, w = homogeneous_corner(corner, SIZE)
            whole = whole_corner(corner, SIZE, is_snapped)
            assert (whole[2] > 0) == (w > 0)
            for value, exact in zip(whole[:2], (x / w, y / w), strict=True):
                there = Fraction(value, whole[2])
                assert there == (Fraction(round(256 * exact), 256) if is_snapped and w > 0 else exact)
