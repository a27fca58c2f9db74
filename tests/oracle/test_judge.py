"""The exact judge of where OpenGL may draw other pixels: only centres beside an edge."""

import numpy as np
import pytest

from app.cli.opengl_check import describe
from app.opengl_check.cases import STEP, Case, Picture, clip_positions
from app.opengl_check.compare import BOUND, compare, edge_distances, edge_lines
from core import draw_triangles

SIZE = (8, 8)


def case_of(clip: np.ndarray, family: str = "any-w") -> Case:
    return Case(family, clip.astype(np.float32), np.ones((len(clip), 3, 3), np.float32), SIZE)


def upright(column: float, depth: float | np.ndarray = 0.5) -> np.ndarray:
    """Return a triangle (1, 3, 4) with its left side at ``column`` pixels, over all rows."""
    return clip_positions(np.array([[[column, -20], [30, 4], [column, 28]]]), depth, 1, SIZE)


def picture_of(case: Case, primitive: np.ndarray) -> Picture:
    frame = draw_triangles(case.clip, *SIZE, case.attributes, None, case.settings())
    return Picture(frame.color, frame.depth, primitive.astype(np.int32))


@pytest.mark.parametrize("steps", [0.25, 1, 3])
def test_distance_from_the_nearest_edge(steps: float) -> None:
    case = case_of(upright(3.5 + steps * STEP))
    found = edge_distances(case, np.array([[3, 2, 0, -1]]))
    assert found == pytest.approx([steps * STEP], abs=1e-6)
    assert (found[0] < BOUND) == (steps < 2**0.5)


def test_the_later_triangle_is_the_one_that_differs() -> None:
    case = case_of(np.concatenate([upright(3.5), upright(6.5)]))
    found = edge_distances(case, np.array([[3, 2, 0, -1], [3, 2, 1, 0], [6, 2, 0, 1]]))
    assert found.tolist() == [0, 3, 0]


def test_near_and_far_plane_cut_edges_of_their_own() -> None:
    # Depth rises from -0.5 to 1.5 along x, 0 at column 2 and 1 at column 6.
    clip = clip_positions(np.array([[[0, 0], [8, 0], [0, 8]]]), [[-0.5, 1.5, -0.5]], 1, SIZE)
    lines = edge_lines(clip[0].astype(float), SIZE)
    assert len(lines) == 5
    upright_lines = [-c / a for a, b, c in lines if a and not b]
    assert sorted(map(float, upright_lines)) == [0, 2, 6]


def test_other_pixels_beside_an_edge_are_explained_and_no_others() -> None:
    case = case_of(upright(3.5 + 0.9 * STEP))
    seen = draw_triangles(case.clip, *SIZE, case.attributes, None, case.settings()).primitive
    assert seen[2, 3] == -1
    beside = seen.copy()
    beside[2, 3] = 0
    result = compare(case, picture_of(case, beside))
    assert result.agrees
    assert result.unexplained == 0
    assert result.distance == pytest.approx([0.9 * STEP], abs=1e-6)
    beside[2, 2] = 0
    result = compare(case, picture_of(case, beside))
    assert not result.agrees
    assert "2 pixels show another primitive, 1 of them not beside an edge (0 allowed)" in describe(result)


def test_on_the_grid_no_pixel_may_differ() -> None:
    case = case_of(upright(3.5), "single")
    seen = draw_triangles(case.clip, *SIZE, case.attributes, None, case.settings()).primitive.copy()
    seen[2, 3] = -1
    assert not compare(case, picture_of(case, seen)).agrees
