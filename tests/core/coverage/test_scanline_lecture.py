"""The lecture's scanline fill draws what the printed program draws, and is wrong where the lecture slips."""

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from core import Settings, draw_triangles
from core.coverage.pixel_runs import make_raster
from core.coverage.scanline import draw_triangle, halves, round_half_up, sort_corners
from core.coverage.snapping import place_corners
from tests.core.drawing import cover_each, edges_of, facing_of, runs_of, text
from tests.core.strategies import clip_of_window, window_points

SIZE = (16, 16)
CORNERS = st.tuples(st.integers(-6, 22), st.integers(-6, 22))


def lines_drawn(corners, size=SIZE) -> list[tuple[int, float, float]]:
    """Return row, x1, x2 of the runs of a triangle whose corners are pixels, in drawing order."""
    clip = clip_of_window([[(x + 0.5, y + 0.5) for x, y in corners]], size)
    edges = edges_of(clip, size)
    runs = runs_of(edges, make_raster(size, "half"), "scanline-lecture")
    return list(zip(runs.row.tolist(), *runs.crossings[:, :2].T.tolist(), strict=True))


@given(CORNERS, CORNERS, CORNERS)
@example((1, 9), (9, 9), (4, 2))  # flat top, level corners first
@example((4, 2), (1, 9), (9, 9))  # flat top, level corners last
@example((4, 12), (1, 3), (9, 3))  # flat bottom, level corners last
@example((1, 3), (9, 3), (4, 12))  # flat bottom, level corners first
@example((1, 5), (4, 12), (9, 5))  # level first and last corner: division by zero as printed
def test_lines_are_those_of_the_listing(v1, v2, v3) -> None:
    area = (v2[0] - v1[0]) * (v3[1] - v1[1]) - (v3[0] - v1[0]) * (v2[1] - v1[1])
    assume(area != 0)
    assert lines_drawn((v1, v2, v3)) == draw_triangle(v1, v2, v3, SIZE[1])


@given(CORNERS, CORNERS, CORNERS)
def test_pixels_are_those_of_the_listing(v1, v2, v3) -> None:
    clip = clip_of_window([[(x + 0.5, y + 0.5) for x, y in (v1, v2, v3)]], SIZE)
    assume(facing_of(clip, SIZE)[0] != 0)
    expected = np.zeros((SIZE[1], SIZE[0]), bool)
    for row, x1, x2 in draw_triangle(v1, v2, v3, SIZE[1]):
        first, last = sorted((int(np.floor(x1 + 0.5)), int(np.floor(x2 + 0.5))))
        expected[row, max(first, 0) : max(last + 1, 0)] = True
    assert np.array_equal(cover_each(clip, SIZE, "scanline-lecture")[0] > 0, expected)


@given(window_points(SIZE, 64), window_points(SIZE, 64), window_points(SIZE, 64))
def test_corners_are_rounded_to_whole_pixels_first(v1, v2, v3) -> None:
    clip = clip_of_window([(v1, v2, v3)], SIZE)
    rounded = round_half_up(place_corners(clip, SIZE, "snapped").window - 0.5) + 0.5
    whole = clip_of_window(rounded, SIZE)
    assume(facing_of(whole, SIZE)[0] != 0)
    assume(facing_of(clip, SIZE)[0] != 0)
    drawn = cover_each(clip, SIZE, "scanline-lecture")
    assert np.array_equal(drawn, cover_each(whole, SIZE, "scanline-lecture"))


def test_both_ends_of_a_span_are_drawn() -> None:
    clip = clip_of_window([[(0.5, 0.5), (2.5, 4.5), (5.5, 2.5)]], (7, 6))
    assert text(cover_each(clip, (7, 6), "scanline-lecture")[0] > 0) == [
        ".......",
        "..#....",
        "..###..",
        ".#####.",
        ".###...",
        "#......",
    ]


def test_neighbours_overlap_along_their_shared_edge() -> None:
    # Each of the two draws both ends of its spans, so the side between them is drawn twice over.
    size = (7, 6)
    pair = clip_of_window([[(1.5, 0.5), (4.5, 5.5), (0.5, 3.5)], [(4.5, 5.5), (1.5, 0.5), (6.5, 2.5)]], size)
    assert cover_each(pair, size, "scanline").sum(axis=0).max() == 1
    assert text(cover_each(pair, size, "scanline-lecture").sum(axis=0)) == [
        "....2..",
        "..1211.",
        "111211.",
        "1121111",
        ".1211..",
        ".2.....",
    ]


@pytest.mark.parametrize(
    ("name", "corners"),
    [
        ("flat top", [(1.5, 6.5), (6.5, 6.5), (3.5, 1.5)]),
        ("flat bottom", [(3.5, 6.5), (1.5, 1.5), (6.5, 1.5)]),
        ("level first and last corner", [(1.5, 1.5), (3.5, 6.5), (6.5, 1.5)]),
    ],
)
def test_flat_sides_are_lost(name: str, corners) -> None:
    clip = clip_of_window([corners], (8, 8))
    assert cover_each(clip, (8, 8), "scanline").any()
    assert not cover_each(clip, (8, 8), "scanline-lecture").any(), name


def test_strict_comparisons_leave_level_corners_unsorted() -> None:
    x, y = np.array([[1.0, 2.0, 3.0]]), np.array([[4.0, 4.0, 9.0]])
    assert sort_corners(x, y)[1].tolist() == [[4.0, 4.0, 9.0]]
    x, y = np.array([[1.0, 2.0, 3.0]]), np.array([[4.0, 5.0, 9.0]])
    assert [part.tolist() for part in sort_corners(x, y)] == [[[3.0, 2.0, 1.0]], [[9.0, 5.0, 4.0]]]


def test_a_half_is_drawn_only_where_it_has_rows() -> None:
    upper, lower = halves(np.array([[1.0, 2.0, 3.0]]), np.array([[9.0, 5.0, 5.0]]))
    assert upper.count == 0
    assert lower.count == 0  # from row 9 up to row 5: no row at all, the printed loss


def test_clips_first_where_a_corner_cannot_be_projected() -> None:
    clip = np.array([[[-1.0, -1, 0.5, 1], [1, -0.5, 0.5, 1], [0, 2, -2, -1]]])
    frame = draw_triangles(clip, 12, 12, settings=Settings(fill="scanline-lecture"))
    assert frame.statistics["clip"].note == "scanline-lecture"
    assert (frame.primitive == 0).any()
