"""Each triangle that is not drawn has its reason, and nothing that could be seen is dropped."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.coverage.edges import orient
from core.coverage.snapping import place_corners
from core.culling.culling import PLANES, REASONS, CullVerdicts, cull, outcodes, plane_distances
from core.methods import table
from core.records.primitives import Primitives, index_corners
from tests.core.strategies import clip_of_window, homogeneous_triangles

FRONT = [[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.5, 0, 1]]
SIZE = (8, 8)


def cull_corners(clip: np.ndarray, facing: np.ndarray, faces: str) -> CullVerdicts:
    """Cull triangles (T, 3, 4) that share no vertices."""
    number = np.arange(len(clip))
    assembled = index_corners(Primitives(clip, np.zeros((len(clip), 3, 0)), number, number, {}))
    return cull(assembled, outcodes(assembled.vertex_clip.T), facing, table.get("cull", faces).function)


def verdict_of(triangle, faces: str = "none") -> tuple[str, int]:
    clip = np.array([triangle], float)
    verdicts = cull_corners(clip, orient(place_corners(clip, SIZE, "snapped")), faces)
    return REASONS[verdicts.verdict[0]], int(verdicts.plane[0])


@pytest.mark.parametrize(
    ("faces", "front", "back"),
    [("none", "kept", "kept"), ("back", "kept", "back-facing"), ("front", "front-facing", "kept")],
)
def test_counter_clockwise_is_the_front(faces: str, front: str, back: str) -> None:
    assert verdict_of(FRONT, faces) == (front, -1)
    assert verdict_of(FRONT[::-1], faces) == (back, -1)


@pytest.mark.parametrize("plane", range(6))
def test_outside_each_plane(plane: int) -> None:
    axis, sign = ((2, -1), (2, 1), (0, -1), (0, 1), (1, -1), (1, 1))[plane]
    moved = np.array(FRONT)
    moved[:, axis] += 1.51 * sign
    if axis == 2:
        moved[:, axis] = 1.01 * sign
    assert verdict_of(moved) == ("outside-plane", plane)
    assert PLANES[plane] == ("near", "far", "left", "right", "bottom", "top")[plane]
    touching = moved.copy()
    touching[0, axis] = sign  # exactly on the plane is inside
    assert verdict_of(touching)[0] == "kept"


@pytest.mark.parametrize("w", [(-1, -2, -3), (0, 0, 0), (0, -1, 0)])
def test_behind_the_eye_comes_first(w) -> None:
    triangle = np.array(FRONT)
    triangle[:, 3] = w
    assert verdict_of(triangle, "back") == ("behind-eye", -1)


@pytest.mark.parametrize(
    "points",
    [
        [(1, 1), (3, 3), (6, 6)],
        [(2, 2), (2, 2), (5, 1)],
        [(1, 1), (1 + 1 / 1024, 1), (1, 1 + 1 / 1024)],  # falls onto one grid point
    ],
)
def test_no_area_on_the_grid_is_degenerate(points) -> None:
    assert verdict_of(clip_of_window([points], SIZE)[0]) == ("degenerate", -1)


def test_turned_over_by_snapping_is_the_back() -> None:
    # The snapped area decides, as it does for coverage.
    points = [(1, 1), (3, 1 + 0.6 / 256), (5, 1 + 1.3 / 256)]
    (x0, y0), (x1, y1), (x2, y2) = points
    assert (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) > 0
    assert verdict_of(clip_of_window([points], SIZE)[0], "back") == ("back-facing", -1)


@pytest.mark.parametrize("flips", [(1, 1, -1), (1, -1, -1), (-1, 1, 1)])
def test_facing_does_not_care_which_corners_are_behind_the_eye(flips) -> None:
    # A plane seen from one side: moving corners on it through the eye plane does not show its back.
    normal, corner = np.array([0.3, -0.2, 1.0]), np.array([[-1, -1], [1, -0.5], [0.2, 1]], float)
    for first, expected in ((corner, "kept"), (corner[::-1], "back-facing")):
        camera = np.concatenate([first, np.array(flips)[:, None] * -2.0], axis=1)
        eye_side = np.linalg.det(camera)
        turned = camera if (eye_side < 0) == (expected == "kept") else camera[[0, 2, 1]]
        clip = np.stack([turned[:, 0], turned[:, 1], np.zeros(3), -turned[:, 2]], axis=1)
        assert verdict_of(clip, "back")[0] == expected, normal


@given(homogeneous_triangles())
def test_distances_are_w_plus_and_minus_each_coordinate(case) -> None:
    clip, _ = case
    x, y, z, w = np.moveaxis(clip, -1, 0)
    expected = [w + z, w - z, w + x, w - x, w + y, w - y]
    assert np.array_equal(plane_distances(clip), np.stack(expected, axis=-1))


@given(homogeneous_triangles(), st.sampled_from(["back", "front"]))
def test_fronts_and_backs_make_up_the_whole(case, faces: str) -> None:
    clip, size = case
    scene = ClipScene(clip, size=size)
    other = {"back": "front", "front": "back"}[faces]
    whole, part, rest = (
        render(scene, Settings(cull=name, visibility="last-drawn")).cover_count
        for name in ("none", faces, other)
    )
    assert np.array_equal(whole, part + rest)
