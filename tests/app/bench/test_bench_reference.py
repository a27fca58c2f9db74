"""The benchmark's reference: pictures from whole numbers, and what counts as a difference."""

import numpy as np
import pytest

from app.bench.records import Lines, WindowTriangles, project
from app.bench.reference import compare, cover_triangles, make_reference
from app.bench.workloads import WORKLOADS, small_triangles
from core import draw_lines

RED, GREEN = (255, 20, 30, 255), (40, 250, 50, 255)


def triangles(
    corners, colors=(RED, GREEN), depth=(0.5, 0.25), size=(6, 4), is_blended=False
) -> WindowTriangles:
    corner_colors = np.repeat(np.array(colors, np.uint8)[:, None], 3, axis=1)
    corner_depth = np.repeat(np.array(depth)[:, None], 3, axis=1)
    return WindowTriangles(np.array(corners, float), corner_depth, corner_colors, size, is_blended)


SQUARE = [[[0.5, 0.5], [4.5, 0.5], [4.5, 3.5]], [[0.5, 0.5], [4.5, 3.5], [0.5, 3.5]]]


def test_a_square_of_two_triangles_through_pixel_centres() -> None:
    """Centres on the left and bottom edges belong to the square, those on the diagonal to one triangle."""
    letters = np.full((4, 6), ".")
    for cover in cover_triangles(np.array(SQUARE), (6, 4)):
        assert (letters[cover.rows, cover.columns] == ".").all()
        letters[cover.rows, cover.columns] = "ab"[cover.triangle]
        np.testing.assert_allclose(cover.weights.sum(axis=1), 1)
    assert ["".join(row) for row in letters[::-1]] == ["......", "bbba..", "bbaa..", "aaaa.."]


def test_the_nearest_is_seen_and_the_first_of_those_that_tie() -> None:
    whole = [[0, 0], [6, 0], [0, 4]]
    near_last = make_reference(triangles([whole, whole]))
    tied = make_reference(triangles([whole, whole], depth=(0.5, 0.5)))
    assert near_last.colors[0, 0].tolist() == list(GREEN[:3])
    assert tied.colors[0, 0].tolist() == list(RED[:3])
    assert near_last.fragment_count == 2 * near_last.pixel_count


def test_blending_is_in_drawing_order_whatever_the_depth() -> None:
    whole = [[0, 0], [6, 0], [0, 4]]
    half = (100, 200, 40, 128)
    reference = make_reference(triangles([whole, whole], (RED, half), (0.1, 0.9), is_blended=True))
    alpha = 128 / 255
    wanted = [round(alpha * h + (1 - alpha) * r) for h, r in zip(half[:3], RED[:3], strict=True)]
    assert reference.colors[0, 0].tolist() == wanted


def test_lines_are_those_of_bresenham() -> None:
    rng = np.random.default_rng(1)
    ends = rng.integers(0, 24, (40, 4))
    reference = make_reference(Lines(ends, np.full((40, 3), 200, np.uint8), (24, 24)))
    pixels, _, _ = draw_lines(ends.reshape(-1, 2, 2) + 0.5, 24, 24, last_pixel=True)
    covered = np.zeros((24, 24), bool)
    covered[pixels[:, 1], pixels[:, 0]] = True
    np.testing.assert_array_equal(reference.covered, covered)
    assert reference.fragment_count == len(pixels)


def test_differences_are_counted_and_small_ones_of_colour_forgiven() -> None:
    reference = make_reference(triangles(SQUARE))
    pixels = reference.colors.copy()
    assert compare(pixels[::-1], True, reference).is_none
    pixels[0, 0, 1] += 2
    assert compare(pixels, False, reference).is_none
    pixels[0, 1, 1] += 3
    pixels[3, 5] = 9
    difference = compare(pixels, False, reference)
    assert (difference.covered, difference.colored) == (1, 1)
    with pytest.raises(ValueError, match="picture must be"):
        compare(pixels[:2], False, reference)


def test_workloads_are_the_same_every_time_and_lie_on_the_grid() -> None:
    first, second = small_triangles(), small_triangles()
    np.testing.assert_array_equal(first.corners, second.corners)
    np.testing.assert_array_equal(first.colors, second.colors)
    assert (first.corners * 256 == np.rint(first.corners * 256)).all()
    assert len({workload.name for workload in WORKLOADS}) == len(WORKLOADS)


def test_a_mesh_behind_the_eye_has_no_place_in_the_window() -> None:
    floor = next(workload for workload in WORKLOADS if workload.name == "E").make()
    with pytest.raises(ValueError, match="in front of the eye"):
        project(floor)
