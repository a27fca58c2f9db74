"""The five matrices: column vectors, a right-handed camera that looks along -z, NDC in [-1, 1]^3."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera
from core.transform import matrices

NUMBERS = st.floats(-1e3, 1e3)


def camera(**changes) -> Camera:
    return Camera(**{"eye": [1.0, 2.0, 3.0], "target": [0.0, 0.5, -1.0], "near": 0.5, "far": 20.0, **changes})


def project(matrix, point) -> np.ndarray:
    clip = matrices.transform(matrix, np.array([[*point, 1.0]]))[0]
    return clip[:3] / clip[3]


@given(st.lists(NUMBERS, min_size=16, max_size=16), st.integers(1, 50))
def test_a_vertex_comes_out_alike_in_a_batch_of_any_size(matrix: list[float], count: int) -> None:
    M = np.reshape(matrix, (4, 4))
    points = np.random.default_rng(count).normal(size=(count, 4))
    together = matrices.transform(M, points)
    assert np.array_equal(
        together, np.concatenate([matrices.transform(M, points[n : n + 1]) for n in range(count)])
    )
    assert np.allclose(together, points @ M.T, atol=1e-9)


def test_vectors_are_columns() -> None:
    moved = matrices.transform(matrices.translation(1, 2, 3), np.array([[10.0, 20.0, 30.0, 1.0]]))
    assert moved.tolist() == [[11.0, 22.0, 33.0, 1.0]]
    assert matrices.transform(matrices.scaling(1, 2, 3), np.ones((1, 4))).tolist() == [[1.0, 2.0, 3.0, 1.0]]
    turned = matrices.translation(1, 0, 0) @ matrices.scaling(2, 2, 2)  # scaled first, then moved
    assert matrices.transform(turned, np.ones((1, 4))).tolist() == [[3.0, 2.0, 2.0, 1.0]]


@pytest.mark.parametrize(
    ("axis", "start", "end"), [((0, 0, 1), 0, 1), ((1, 0, 0), 1, 2), ((0, 1, 0), 2, 0), ((0, 0, 7), 0, 1)]
)
def test_a_quarter_turn_is_counter_clockwise(axis, start: int, end: int) -> None:
    # Seen against the axis: x to y about z, y to z about x, z to x about y.
    turned = matrices.rotation(np.array(axis), np.pi / 2)[:3, :3] @ np.eye(3)[start]
    assert np.allclose(turned, np.eye(3)[end])


@given(
    st.lists(st.floats(-1, 1), min_size=3, max_size=3).filter(lambda axis: np.linalg.norm(axis) > 0.1),
    NUMBERS,
)
def test_a_rotation_keeps_lengths_and_handedness(axis: list[float], angle: float) -> None:
    R = matrices.rotation(np.array(axis), angle)[:3, :3]
    assert np.allclose(R @ R.T, np.eye(3), atol=1e-9)
    assert np.isclose(np.linalg.det(R), 1)
    assert np.allclose(R @ axis, axis, atol=1e-9)


def test_the_camera_looks_along_minus_z_and_is_right_handed() -> None:
    looking = camera()
    C = matrices.world_to_camera(looking)
    assert np.allclose(matrices.transform(C, np.array([[1.0, 2.0, 3.0, 1.0]])), [[0, 0, 0, 1]])
    ahead = matrices.transform(C, np.array([[0.0, 0.5, -1.0, 1.0]]))[0]
    assert np.allclose(ahead[:2], 0)
    assert ahead[2] < 0
    right, up, backward = matrices.camera_axes(looking)
    assert np.allclose(np.cross(right, up), backward)
    assert up[1] > 0
    assert np.allclose(C @ np.linalg.inv(C), np.eye(4))


def test_w_is_the_distance_in_front_of_the_eye() -> None:
    P = matrices.projection(camera(), 1.5)
    points = np.array([[0.3, 0.2, -2.0, 1.0], [0.3, 0.2, 2.0, 1.0], [5.0, -1.0, 0.0, 1.0]])
    assert matrices.transform(P, points)[:, 3].tolist() == [2.0, -2.0, 0.0]


@pytest.mark.parametrize("aspect", [1.0, 16 / 9, 0.5])
def test_perspective_takes_the_frustum_to_the_cube(aspect: float) -> None:
    view = camera(field_of_view=np.pi / 2, near=0.5, far=20.0)
    P = matrices.projection(view, aspect)
    assert np.allclose(project(P, (0, 0, -0.5)), (0, 0, -1))
    assert np.allclose(project(P, (0, 0, -20)), (0, 0, 1))
    for depth in (0.5, 3.0, 20.0):
        # The opening angle is the vertical one.
        assert np.allclose(project(P, (aspect * depth, depth, -depth))[:2], (1, 1))
        assert np.allclose(project(P, (-aspect * depth, -depth, -depth))[:2], (-1, -1))


@pytest.mark.parametrize("aspect", [1.0, 2.0])
def test_orthographic_takes_the_box_to_the_cube(aspect: float) -> None:
    view = camera(projection="orthographic", view_height=4.0, near=-1.0, far=9.0)
    P = matrices.projection(view, aspect)
    assert np.allclose(project(P, (2 * aspect, 2, 1)), (1, 1, -1))
    assert np.allclose(project(P, (-2 * aspect, -2, -9)), (-1, -1, 1))
    assert matrices.transform(P, np.array([[3.0, 4.0, 5.0, 1.0]]))[0, 3] == 1


def test_viewport_is_y_up_with_depth_from_0_to_1() -> None:
    D = matrices.viewport(8, 6)
    assert project(D, (-1, -1, -1)).tolist() == [0, 0, 0]
    assert project(D, (1, 1, 1)).tolist() == [8, 6, 1]
    assert project(D, (0, 0, 0)).tolist() == [4, 3, 0.5]
