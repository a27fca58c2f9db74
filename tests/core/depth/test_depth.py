"""Depth: what is stored, which of two is nearer, the test one fragment after another, and the depth range."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, ClipScene, Mesh, Scene, Settings, draw_triangles, render
from core.depth.depth import clamp_depth, depth_test, run_depth_tests, stack_fragments
from core.methods import table
from tests.core.strategies import clip_of_window, perspective_triangles

FORMATS = table.names("depth")
STORED = st.sampled_from(
    [0.0, 1e-30, 0.25, 0.5, float(np.nextafter(np.float32(0.5), np.float32(1))), 0.75, 1.0]
)
PIXEL_COUNT = 5


def depth_format(name: str):
    return table.get("depth", name).function()


def in_format(kept, values: np.ndarray) -> np.ndarray:
    """Return values as the format stores them: float32, or whole numbers up to the format's scale."""
    if kept.scale == 1:
        return values.astype(np.float32)
    return np.rint(np.minimum(values, 1.0) * kept.scale).astype(kept.stored_type)


@st.composite
def fragment_lists(draw):
    """Draw (stored (F,) float32, pixel (F,)) with many ties."""
    fragments = draw(st.lists(st.tuples(STORED, st.integers(0, PIXEL_COUNT - 1)), max_size=30))
    stored = np.array([value for value, _ in fragments], np.float32)
    return stored, np.array([at for _, at in fragments], np.int64)


@pytest.mark.parametrize(
    ("name", "cleared", "nearer"),
    [
        ("z-float32", 1.0, 0.2),
        ("inverse-w", 0.0, 2.0),
        ("z-24", 16777215.0, 16777214.0),
        ("z-16", 65535.0, 65534.0),
        ("reversed-z", 0.0, 1e-30),
        ("logarithmic", 1.0, 0.2),
    ],
)
def test_cleared_value_and_direction(name: str, cleared: float, nearer: float) -> None:
    kept = depth_format(name)
    assert kept.cleared == cleared
    assert kept.is_nearer(np.float32(nearer), np.float32(cleared))
    assert not kept.is_nearer(np.float32(cleared), np.float32(nearer))
    assert not kept.is_nearer(np.float32(nearer), np.float32(nearer))


@given(st.sampled_from(FORMATS), st.lists(st.floats(0, 2.0**100, width=32), min_size=2, max_size=2))
def test_keys_are_in_the_order_of_nearness_and_can_be_read_back(name: str, values: list[float]) -> None:
    kept = depth_format(name)
    stored = in_format(kept, np.array(values))
    key = kept.nearness_key(stored)
    assert (key[0] < key[1]) == bool(kept.is_nearer(stored[0], stored[1]))
    assert (key >= 0).all()
    assert (key < 2**kept.nearness_bits).all()
    assert np.array_equal(kept.stored_of_key(key), stored)


@pytest.mark.parametrize("name", FORMATS)
def test_stored_values_have_the_type_of_the_format_and_zero_has_one_key(name: str) -> None:
    kept = depth_format(name)
    stored = kept.store(np.array([0.1, -0.0, 0.0, 1.0]))
    assert stored.dtype == kept.stored_type
    assert stored[0] == (np.float32(0.1) if kept.scale == 1 else np.rint(0.1 * kept.scale))
    key = kept.nearness_key(stored)
    assert key[1] == key[2]


@given(fragment_lists(), st.sampled_from(FORMATS), st.booleans())
def test_layers_give_what_one_fragment_after_another_gives(fragments, name: str, is_tested: bool) -> None:
    stored, pixel = fragments
    kept = depth_format(name)
    initial = np.full(PIXEL_COUNT, kept.cleared, np.float32)
    tests = run_depth_tests(stored, stack_fragments(pixel), initial, kept, is_tested)
    buffer = initial.copy()
    for f in range(len(stored)):
        assert tests.before[f] == buffer[pixel[f]]
        after, passes = depth_test(stored[f], buffer[pixel[f]], kept.larger_is_nearer)
        if not is_tested:
            after, passes = stored[f], True
        assert tests.passes[f] == passes
        buffer[pixel[f]] = after
    assert (initial == kept.cleared).all()


@given(st.lists(st.integers(0, 6), max_size=40))
def test_layers_name_each_pixel_once_and_keep_the_order(pixel: list[int]) -> None:
    at = np.array(pixel, np.int64)
    stacks = stack_fragments(at)
    found = []
    for count, layer in stacks.layers():
        assert at[layer].tolist() == stacks.pixel[:count].tolist()
        assert len(set(at[layer].tolist())) == len(layer)
        found.append(layer)
    assert sorted(np.concatenate(found).tolist() if found else []) == list(range(len(at)))
    number = {int(f): n for n, layer in enumerate(found) for f in layer}
    assert all(number[f] == pixel[:f].count(pixel[f]) for f in range(len(pixel)))


def test_depth_is_clamped_where_every_corner_is_in_range_and_tested_elsewhere() -> None:
    depth = np.array([-0.1, 0.0, 0.5, 1.0, 1.1])
    clamped, keeps = clamp_depth(depth, np.ones(5, bool))
    assert clamped.tolist() == [0, 0, 0.5, 1, 1]
    assert keeps.all()
    tested, keeps = clamp_depth(depth, np.zeros(5, bool))
    assert tested.tolist() == depth.tolist()
    assert keeps.tolist() == [False, True, True, True, False]


def test_a_depth_that_is_no_number_is_not_drawn() -> None:
    _, keeps = clamp_depth(np.array([np.nan, np.inf, -np.inf]), np.zeros(3, bool))
    assert not keeps.any()


def test_depth_of_the_picture_is_linear_in_the_window() -> None:
    size = (8, 4)
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)]], size, [[1.0, 4.0, 2.0]], [[-1.0, 1.0, 0.0]])
    depth = draw_triangles(clip, *size).depth
    columns, rows = np.meshgrid(np.arange(8) + 0.5, np.arange(4) + 0.5)
    expected = np.where(columns + rows < 8, columns / 8 + rows / 16, 1.0)
    covered = draw_triangles(clip, *size).primitive == 0
    assert np.allclose(depth[covered], expected[covered], atol=1e-6)
    assert (depth[~covered] == 1).all()


def test_inverse_w_of_the_picture() -> None:
    size = (8, 4)
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)]], size, [[1.0, 4.0, 2.0]])
    frame = draw_triangles(clip, *size, settings=Settings(depth="inverse-w"))
    columns, rows = np.meshgrid(np.arange(8) + 0.5, np.arange(4) + 0.5)
    expected = 1 + (1 / 4 - 1) * columns / 8 + (1 / 2 - 1) * rows / 8
    covered = frame.primitive == 0
    assert np.allclose(frame.depth[covered], expected[covered], atol=1e-6)
    assert (frame.depth[~covered] == 0).all()


@given(perspective_triangles(3), st.permutations([0, 1, 2]))
def test_without_ties_the_order_of_the_triangles_does_not_matter(case, order) -> None:
    clip, size = case
    clip = np.concatenate([clip] * 3)[:3]
    # Three depths that cannot meet: the picture is that of the nearest.
    clip[..., 2] = np.array([-0.5, 0.0, 0.5])[:, None] * clip[..., 3]
    first = draw_triangles(clip, *size)
    other = draw_triangles(clip[order], *size)
    assert np.array_equal(first.depth, other.depth)
    named = np.where(other.primitive < 0, -1, np.array(order)[other.primitive])
    assert np.array_equal(first.primitive, named)


@pytest.mark.parametrize("depth", FORMATS)
def test_a_tie_keeps_the_triangle_drawn_first(depth: str) -> None:
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)]] * 3, (4, 4), 2.0, 0.25)
    settings = Settings(depth=depth)
    assert (draw_triangles(clip, 4, 4, settings=settings).primitive == 0).all()
    assert (draw_triangles(clip, 4, 4, settings=settings).cover_count == 3).all()


def test_on_the_far_plane_nothing_is_nearer_than_the_cleared_buffer() -> None:
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)]], (4, 4), 1.0, 1.0)
    frame = draw_triangles(clip, 4, 4)
    assert (frame.primitive == -1).all()
    assert (frame.cover_count == 1).all()
    assert (draw_triangles(clip, 4, 4, settings=Settings(visibility="last-drawn")).primitive == 0).all()


def test_a_triangle_that_reaches_out_of_range_is_cut_per_pixel() -> None:
    # Window depth runs from -1 at the left side to 1 at the right: the left half lies before the near plane.
    clip = clip_of_window([[(0, 0), (8, 0), (0, 8)], [(8, 0), (8, 8), (0, 8)]], (8, 4), 1.0, 0.0)
    clip[..., 2] = 4 * ((clip[..., 0] + 1) / 2) - 3
    frame = draw_triangles(clip, 8, 4)
    assert (frame.primitive[:, :4] == -1).all()
    assert (frame.primitive[:, 4:] >= 0).all()


@pytest.mark.parametrize("name", [row.name for row in table if "perspective" in row.needs])
def test_what_is_made_of_w_is_refused_for_an_orthographic_camera(name: str) -> None:
    mesh = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    camera = Camera([0, 0, 5], [0, 0, 0], projection="orthographic")
    with pytest.raises(ValueError, match=f"{name} needs a perspective camera"):
        render(Scene((mesh,), camera, size=(4, 4)), Settings(depth=name))
    render(Scene((mesh,), camera, size=(4, 4)), Settings())


def test_an_empty_scene_is_clear() -> None:
    frame = render(ClipScene(np.zeros((0, 3, 4)), size=(3, 2), background=[0.25, 0.5, 0.75, 1]))
    assert (frame.depth == 1).all()
    assert (frame.primitive == -1).all()
    assert not frame.cover_count.any()
    assert (frame.color == np.array([0.25, 0.5, 0.75, 1])).all()
