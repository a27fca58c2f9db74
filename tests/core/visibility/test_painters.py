"""Drawing orders: as given with the depth test, as given without it, from far to near."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, Mesh, Scene, Settings, draw_triangles, render
from core.methods import table
from tests.core.drawing import cover_each, text
from tests.core.meshes import random_rotation
from tests.core.strategies import clip_of_window, perspective_triangles

BIG = [(0, 0), (20, 0), (0, 20)]


def layers_of(depths, w=1.0) -> np.ndarray:
    clip = clip_of_window([BIG] * len(depths), (4, 4), w)
    clip[..., 2] = np.asarray(depths, float)[:, None] * clip[..., 3]
    return clip


def order_of(name: str, clip) -> list[int]:
    return table.get("visibility", name).function(np.asarray(clip, float)).order.tolist()


@pytest.mark.parametrize("name", ["z-buffer", "last-drawn"])
def test_drawn_as_given(name: str) -> None:
    drawing = table.get("visibility", name).function(layers_of([0.5, -0.5, 0.0]))
    assert drawing.order.tolist() == [0, 1, 2]
    assert drawing.uses_depth_test == (name == "z-buffer")


def test_painters_draws_from_far_to_near_and_level_ones_as_given() -> None:
    clip = layers_of([0, 0, 0, 0])
    clip *= np.array([2.0, 5.0, 2.0, 1.0])[:, None, None]
    assert order_of("painters", clip) == [1, 0, 2, 3]


def test_where_w_is_constant_painters_goes_by_z() -> None:
    assert order_of("painters", layers_of([0.5, -0.5, 0.9, 0.5])) == [2, 0, 3, 1]


def test_painters_of_nothing() -> None:
    assert order_of("painters", np.zeros((0, 3, 4))) == []


@given(perspective_triangles(4))
def test_last_drawn_shows_the_last_triangle_that_covers_a_pixel(case) -> None:
    clip, size = case
    frame = draw_triangles(clip, *size, settings=Settings(visibility="last-drawn"))
    each = cover_each(clip, size)
    expected = np.full(frame.primitive.shape, -1)
    for t in range(len(clip)):
        expected[each[t] > 0] = t
    assert text(frame.primitive + 1) == text(expected + 1)


@given(st.permutations([0.9, 0.5, 0.1, -0.3]), st.floats(0.1, 3))
def test_painters_equals_the_z_buffer_for_parallel_layers(depths, w: float) -> None:
    clip = layers_of(depths, w)
    painted = draw_triangles(clip, 4, 4, settings=Settings(visibility="painters"))
    assert np.array_equal(painted.primitive, draw_triangles(clip, 4, 4).primitive)
    assert np.array_equal(painted.depth, draw_triangles(clip, 4, 4).depth)


@given(st.integers(0, 2**32 - 1))
def test_painters_equals_the_z_buffer_for_scattered_small_triangles(seed: int) -> None:
    # Small against their distance from each other along the view: the mean depth tells which is nearer.
    generator = np.random.default_rng(seed)
    center = np.stack(
        [generator.uniform(-1, 1, 12), generator.uniform(-1, 1, 12), -2.0 - np.arange(12)], axis=1
    )
    positions = generator.permutation(center)[:, None] + generator.uniform(-0.4, 0.4, (12, 3, 3))
    mesh = Mesh(positions.reshape(-1, 3), np.arange(36).reshape(-1, 3))
    camera = Camera([0, 0, 0], [0, 0, -1], near=0.5, far=40)
    scene = Scene((mesh,), camera, size=(16, 12))
    painted, exact = (
        render(scene, Settings(visibility=name, shading="unlit")) for name in ("painters", "z-buffer")
    )
    assert np.array_equal(painted.primitive, exact.primitive)


def test_painters_fails_where_the_table_says_so() -> None:
    # Two triangles that cut through each other: no order is right, the depth test is.
    clip = clip_of_window([BIG, BIG], (4, 4))
    clip[0, :, 2] = 0.2 - 0.4 * (clip[0, :, 0] + 1) / 2
    clip[1, :, 2] = -0.2 + 0.4 * (clip[1, :, 0] + 1) / 2
    exact = draw_triangles(clip, 4, 4).primitive
    assert text(exact + 1) == ["2211", "2211", "2211", "2211"]
    painted = draw_triangles(clip, 4, 4, settings=Settings(visibility="painters")).primitive
    assert len(np.unique(painted)) == 1


@given(st.integers(0, 2**32 - 1))
def test_triangles_keep_their_numbers_in_any_order(seed: int) -> None:
    generator = np.random.default_rng(seed)
    points = generator.normal(size=(10, 3, 3)) @ random_rotation(generator)
    mesh = Mesh(points.reshape(-1, 3), np.arange(30).reshape(-1, 3))
    scene = Scene((mesh,), Camera([0, 0, 6], [0, 0, 0]), size=(12, 12))
    frame = render(scene, Settings(visibility="painters", shading="unlit", clipping="sutherland-hodgman"))
    alone = cover_each_alone(scene, mesh)
    for row, column in np.argwhere(frame.primitive >= 0):
        assert alone[frame.primitive[row, column], row, column]


def cover_each_alone(scene: Scene, mesh: Mesh) -> np.ndarray:
    covered = []
    for t in range(len(mesh.triangles)):
        one = Mesh(mesh.positions, mesh.triangles[t : t + 1])
        settings = Settings(shading="unlit", clipping="sutherland-hodgman")
        covered.append(render(Scene((one,), scene.camera, size=scene.size), settings).primitive >= 0)
    return np.stack(covered)
