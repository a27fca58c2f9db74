"""Wireframes: outlines as drawings, clipped ones, colours and depth along the edges, corners anywhere."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Frame, Settings, draw_triangles, render
from core.lines import wireframe
from core.lines.drawing import draw_lines
from core.lines.line_method import has_intensities
from core.lines.wireframe import MARGIN, cut_to_window, trace_sides
from core.methods import table
from lessons.scenes import make_scene
from tests.core.drawing import text
from tests.core.strategies import ANY_TRIANGLES, clip_of_window
from tests.covering import in_turn

LINES = list(table.names("line"))
SIZE = (16, 11)
CORNERS = [(1.25, 1.75), (13.5, 3.25), (5.75, 9.5)]


def outlined(clip, size=SIZE, attributes=None, **choices) -> Frame:
    return draw_triangles(
        clip, *size, attributes=attributes, settings=Settings(**{"polygon_mode": "wireframe", **choices})
    )


@pytest.mark.parametrize("line", LINES)
def test_an_outline_is_its_three_edges_in_order(line):
    ends = np.array([CORNERS, np.roll(CORNERS, -1, axis=0)]).swapaxes(0, 1)
    count = np.zeros(SIZE[::-1], int)
    pixels, _, _ = draw_lines(ends, *SIZE, line=line)
    np.add.at(count, (pixels[:, 1], pixels[:, 0]), 1)
    frame = outlined(clip_of_window([CORNERS], SIZE), line=line)
    assert np.array_equal(frame.cover_count, count)
    if not has_intensities(line):  # Pale pixels leave the triangle as it is.
        assert np.array_equal(frame.primitive == 0, count > 0)


def test_two_triangles_draw_the_edge_that_they_share_twice():
    square = clip_of_window(
        [[(1.5, 1.5), (5.5, 1.5), (5.5, 5.5)], [(1.5, 1.5), (5.5, 5.5), (1.5, 5.5)]], (7, 7)
    )
    assert text(outlined(square, (7, 7)).cover_count) == [
        ".......",
        ".11112.",
        ".1..21.",
        ".1.2.1.",
        ".12..1.",
        ".21111.",
        ".......",
    ]


# Clipping


THROUGH_THE_EYE = [[[-0.9, 0.6, 0, 1], [0.2, 0.9, 0, 1], [0.8, -1.5, -1.5, -0.5]]]


@pytest.mark.parametrize("clipping", ["homogeneous", "sutherland-hodgman", "sutherland-hodgman-lecture"])
def test_neither_the_cut_nor_the_diagonal_of_a_clipped_triangle_is_drawn(clipping):
    frame = outlined(THROUGH_THE_EYE, (20, 14), clipping=clipping)
    assert frame.statistics["clip"].outgoing == 2
    assert frame.statistics["clip"].note == ("wireframe" if clipping == "homogeneous" else "")
    assert text(frame.primitive == 0) == [
        ".........####.......",
        "...######....#......",
        "###...........#.....",
        "#..............##...",
        ".#...............#..",
        ".#..................",
        "..#.................",
        "..#.................",
        "...#................",
        *["...................."] * 5,
    ]


def test_the_border_of_the_window_is_no_edge():
    larger = [[[-1.8, -1.2, 0, 1], [1.6, -0.6, 0, 1], [0.3, 1.7, 0, 1]]]
    assert text(outlined(larger, (20, 14)).primitive == 0) == [
        "........#........#..",
        ".......#..........#.",
        "......#............#",
        ".....#.............#",
        "....#...............",
        "..##................",
        ".#..................",
        "#...................",
        *["...................."] * 4,
        "..............######",
        ".....#########......",
    ]
    around = [[[-9, -9, 0, 1], [9, -9, 0, 1], [0, 9, 0, 1]]]
    for clipping in table.names("clipping"):
        assert (outlined(around, (20, 14), clipping=clipping).primitive == -1).all()


def test_sides_of_pieces_lie_on_the_edges_of_their_triangle():
    # Triangle 4 lost corner 2: a quad of corners 0, 1, a point of edge 0 and one of edge 1; triangle 5 is whole.
    a, b, c, d = (1, 0, 0), (0, 1, 0), (0, 0.5, 0.5), (0.5, 0, 0.5)
    shares = np.array([[a, b, c], [a, c, d], np.eye(3)], float)
    is_drawn, edge = trace_sides(shares, np.array([4, 4, 5]))
    assert is_drawn.tolist() == [[True, True, False], [False, False, True], [True, True, True]]
    assert edge[is_drawn].tolist() == [2, 0, 1, 2, 0, 1]


def test_only_triangles_that_need_it_are_clipped_for_a_wireframe():
    reaches_out = [[-0.9, -0.8, -2, 1], [0.9, -0.8, 0.5, 1.5], [0, 0.9, 0.5, 2]]
    alone = outlined([reaches_out], (20, 14)).primitive == 0
    both = outlined([THROUGH_THE_EYE[0], reaches_out], (20, 14), visibility="last-drawn").primitive == 1
    assert alone.any()
    assert np.array_equal(alone, both)


def test_edges_end_where_they_leave_the_depth_range():
    clip = clip_of_window([[(0.5, 0.5), (10.5, 0.5), (0.5, 6.5)]], (12, 8), 1.0, [[-1.5, 0.5, 0.5]])
    drawing = text(outlined(clip, (12, 8), line="diamond-exit").primitive == 0)
    assert drawing[-1] == "...########."
    assert [row[0] for row in drawing] == list(".#####..")


# What is interpolated


def point_on_edge(frame: Frame, column: int, row: int) -> np.ndarray:
    assert frame.primitive[row, column] == 0
    return frame.attributes[row, column].astype(float)


@pytest.mark.parametrize("line", LINES)
def test_colours_along_an_edge(line):
    # The bottom edge runs from 0.5 to 8.5 in window x, w from 1 to 4, the value from 0 to 1.
    clip = clip_of_window([[(0.5, 0.5), (8.5, 0.5), (4.5, 6.5)]], (10, 8), [[1.0, 4.0, 2.0]])
    value = [[[0.0], [1.0], [0.25]]]
    for column in range(1, 8):
        t = column / 8
        perspective = (t / 4) / ((1 - t) + t / 4)
        for interpolation, wanted in (("perspective", perspective), ("affine", t), ("flat", 0.25)):
            frame = outlined(clip, (10, 8), value, line=line, interpolation=interpolation)
            assert point_on_edge(frame, column, 0)[0] == pytest.approx(wanted, abs=1e-7)


def test_a_flat_colour_is_that_of_the_provoking_corner_to_the_bit():
    value = np.array([[[0.1], [0.7], [0.3]]])
    for provoking, wanted in (("last", 0.3), ("first", 0.1)):
        frame = outlined(
            clip_of_window([CORNERS], SIZE), SIZE, value, interpolation="flat", provoking=provoking
        )
        assert set(frame.attributes[frame.primitive == 0].ravel().tolist()) == {float(np.float32(wanted))}


def test_depth_is_linear_along_an_edge_and_stored_in_the_chosen_format():
    clip = clip_of_window(
        [[(0.5, 0.5), (8.5, 0.5), (4.5, 6.5)]], (10, 8), [[1.0, 4.0, 2.0]], [[0.0, 0.5, 0.25]]
    )
    for column in range(1, 8):
        t = column / 8
        assert outlined(clip, (10, 8)).depth[0, column] == pytest.approx(0.5 + t * 0.25, abs=1e-7)
        stored = outlined(clip, (10, 8), depth="inverse-w").depth[0, column]
        assert stored == pytest.approx((1 - t) + t / 4, abs=1e-7)


@pytest.mark.parametrize("blend", table.names("blend"))
def test_the_nearer_outline_is_seen_where_two_cross(blend):
    level = clip_of_window([[(0.5, 4.5), (9.5, 4.5), (5.0, 40.0)]], (10, 10), 1.0, 0.5)[0]
    upright = clip_of_window([[(4.5, 0.5), (4.5, 9.5), (40.0, 5.0)]], (10, 10), 1.0, -0.5)[0]
    for clip, near in (([level, upright], 1), ([upright, level], 0)):
        frame = outlined(clip, (10, 10), np.full((2, 3, 4), 1.0), blend=blend)
        crossing = np.argwhere(frame.cover_count == 2)
        assert [4, 4] in crossing.tolist()
        for row, column in crossing.tolist():
            assert frame.primitive[row, column] == near
            assert frame.depth[row, column] == 0.25
    assert outlined([upright, level], (10, 10), visibility="last-drawn").primitive[4, 4] == 1


def test_a_lit_mesh_is_lit_along_its_edges():
    scene = make_scene("sphere")
    filled, lines = render(scene), render(scene, Settings(polygon_mode="wireframe", cull="back"))
    seen = (lines.primitive >= 0) & (filled.primitive >= 0)
    assert seen.sum() > 1000
    difference = np.abs(lines.color[seen] - filled.color[seen]).max(axis=1)
    assert np.median(difference) < 0.02


def test_a_pixel_beyond_an_end_takes_the_values_of_the_end():
    # An edge of 1/16 pixel that crosses from one pixel to the next: extrapolated, t would be about -8.
    clip = clip_of_window([[(0.96875, 0.5), (1.03125, 0.5), (6.0, 6.5)]], (8, 8))
    frame = outlined(clip, (8, 8), [[[0.25], [0.75], [0.5]]])
    assert frame.primitive[0, 0] == 0
    assert frame.attributes[0, 0, 0] == 0.25


# Corners anywhere


def test_segments_are_cut_at_the_neighbourhood_of_the_window():
    size = (16, 8)
    segments = np.array(
        [
            [[1.0, 1, 1], [5, 6, 1]],
            [[-3 * MARGIN, 4, 1], [MARGIN, 4, 1]],
            [[4, 4, 1], [4, 0, -1]],
            [[0, 5 * MARGIN, 1], [9, 6 * MARGIN, 1]],
            [[1, 1, -1], [2, 3, -2]],
        ]
    )
    cut = cut_to_window(segments, size)
    assert cut[0].tolist() == [0, 1]
    assert cut[1].tolist() == [0.5, 1]
    assert cut[2, 0] == 0
    assert 0.99 < (1 - 2 * cut[2, 1]) * 0 + 2 * cut[2, 1] < 1
    assert (cut[3:, 0] > cut[3:, 1]).all()


@pytest.mark.parametrize(("distance", "line"), in_turn([1e3, 1e5, 1e7, 1e12], LINES))
def test_far_corners_change_nothing_near_the_window(line, distance):
    # Two edges from (2.5, 2.5) to the right and upwards, however far they go.
    clip = clip_of_window([[(2.5, 2.5), (distance, 2.5), (2.5, distance)]], (8, 6))
    # At the corner Gupta and Sproull's edges have half of 0.78 each: too pale to be stored.
    corner = "." if line == "gupta-sproull" else "#"
    assert text(outlined(clip, (8, 6), line=line).primitive == 0) == [
        "..#.....",
        "..#.....",
        "..#.....",
        f"..{corner}#####",
        "........",
        "........",
    ]


@pytest.mark.parametrize("interpolation", ["perspective", "affine"])
def test_values_along_an_edge_that_was_cut(interpolation):
    # Cut at x = -32768 of an edge from x = -65536 (w 1, value 0) to x = 16 (w 3, value 1).
    far = -65536.0
    corners = [(16.0, 2.5), (far, 2.5), (far, 3 * 65536.0)]
    clip = clip_of_window([corners], (16, 6), [[3.0, 1.0, 1.0]])
    frame = outlined(clip, (16, 6), [[[1.0], [0.0], [0.0]]], interpolation=interpolation)
    for column in (0, 7, 15):
        t = (column + 0.5 - far) / (16.0 - far)
        wanted = t if interpolation == "affine" else (t / 3) / ((1 - t) + t / 3)
        assert point_on_edge(frame, column, 2)[0] == pytest.approx(wanted, abs=1e-6)


@pytest.mark.parametrize("line", LINES)
def test_degenerate_triangles_and_points_draw_nothing_and_do_no_harm(line):
    flat = [[-0.5, -0.5, 0, 1], [0, 0, 0, 1], [0.5, 0.5, 0, 1]]
    point = [[0.1, 0.1, 0, 1]] * 3
    nowhere = [[0, 0, 0, 0]] * 3
    touches_eye = [[0.0, 0, 0, 0], [0.5, 0, 0, 1], [0, 0.5, 0, 1]]
    assert (outlined([flat, point, nowhere], line=line).primitive == -1).all()
    assert outlined([touches_eye], line=line).primitive.max() <= 0


@given(ANY_TRIANGLES, st.sampled_from(LINES), st.sampled_from([1.0, 1e4, 1e9, 1e30]), st.booleans())
def test_any_triangles_have_outlines_with_values_of_their_corners(case, line, scale, is_affine):
    clip, size = case
    clip = clip * np.array([scale, 1, 1, 1])
    values = np.linspace(0.25, 0.75, clip.size).reshape(clip.shape)
    interpolation = "affine" if is_affine else "perspective"
    frame = outlined(clip, size, values, line=line, interpolation=interpolation)
    seen = frame.primitive >= 0
    of_seen, corners = frame.attributes[seen], values[frame.primitive[seen]]
    assert (of_seen >= corners.min(axis=1) - 1e-6).all()
    assert (of_seen <= corners.max(axis=1) + 1e-6).all()
    assert ((frame.depth[seen] >= 0) & (frame.depth[seen] <= 1)).all()


# Batches


def test_batches_do_not_matter(monkeypatch):
    scene = make_scene("torus")
    settings = Settings(polygon_mode="wireframe", blend="over")
    wanted = render(scene, settings)
    monkeypatch.setattr(wireframe, "BATCH", 5000)
    found = render(scene, settings)
    for name in ("color", "depth", "primitive", "attributes", "cover_count"):
        assert getattr(found, name).tobytes() == getattr(wanted, name).tobytes()


def test_statistics_count_the_pixels_of_the_lines():
    frame = outlined(clip_of_window([CORNERS], SIZE))
    counts = frame.statistics
    assert (counts["bin"].incoming, counts["edges"].outgoing) == (1, 1)
    assert counts["raster"].outgoing == counts["depth"].incoming == frame.cover_count.sum()


def test_a_scene_without_triangles():
    scene = ClipScene(np.empty((0, 3, 4)), size=(4, 3))
    assert (render(scene, Settings(polygon_mode="wireframe")).primitive == -1).all()
