"""Watertight: the signed cover of every pixel is right; it is drawn once where no triangle turns over."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.clipping.sutherland_hodgman import ALL_PLANES, DEPTH_PLANES, clip_primitives
from core.culling.culling import plane_distances
from core.records.primitives import Primitives
from tests.core.drawing import TESTING_FILLS, cover_each, edges_of, facing_of, signed_cover, text
from tests.core.meshes import clip_of_view, fan, icosphere, random_rotation, tiling, torus
from tests.core.strategies import clip_of_window

SEEDS = st.integers(0, 2**32 - 1)


def round_rim(center, radius: float, count: int, turn: float = 0.0) -> np.ndarray:
    angle = np.arange(count) * 2 * np.pi / count + turn
    return np.asarray(center) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize("fill", TESTING_FILLS)
def test_fan_around_a_pixel_centre(fill: str) -> None:
    # Its 8 triangles share the centre (4.5, 3.5) and have centres on their sides in all 8 directions.
    size = (9, 7)
    rim = [
        (9.5, 3.5),
        (9.5, 8.5),
        (4.5, 8.5),
        (-0.5, 8.5),
        (-0.5, 3.5),
        (-0.5, -1.5),
        (4.5, -1.5),
        (9.5, -1.5),
    ]
    each = cover_each(clip_of_window(fan((4.5, 3.5), rim), size), size, fill)
    owner = each.argmax(axis=0) + 1
    assert (each.sum(axis=0) == 1).all()
    assert text(owner) == [
        "433322211",
        "443322111",
        "444321111",
        "444411111",
        "555678888",
        "556677888",
        "566677788",
    ]


@given(SEEDS, st.sampled_from([1, 2, 256]), st.sampled_from([(0.0, 0.0), (0.5, 0.5), (0.5, 0.0), (0.0, 0.5)]))
def test_fans_with_hubs_on_centres_edges_and_corners_of_pixels(seed: int, steps: int, offset) -> None:
    generator = np.random.default_rng(seed)
    size = (12, 10)
    hub = np.array([5, 4]) + offset
    rim = (
        np.round(round_rim(hub, 40, int(generator.integers(3, 24)), generator.uniform(0, 6.3)) * steps)
        / steps
    )
    assert (cover_each(clip_of_window(fan(hub, rim), size), size).sum(axis=0) == 1).all()


@given(SEEDS, st.sampled_from([1, 2, 16, 256, 1000]), st.sampled_from(TESTING_FILLS))
def test_random_tilings(seed: int, steps: int, fill: str) -> None:
    generator = np.random.default_rng(seed)
    size = (11, 9)
    clip = clip_of_window(tiling(generator, size, steps, 14), size)
    each = cover_each(clip, size, fill)
    assert (signed_cover(clip, size, fill) == 1).all()
    if (facing_of(clip, size) == 1).all():
        assert (each.sum(axis=0) == 1).all()


@given(SEEDS, st.sampled_from([1.0, 0.5, 0.01, 0.002]))
def test_jittered_grids(seed: int, cell: float) -> None:
    # Down to cells below 1/256 pixel, which snapping folds up: the signed cover stays right.
    generator = np.random.default_rng(seed)
    size = (7, 5)
    count = 8
    column, row = np.meshgrid(np.arange(count + 1.0), np.arange(count + 1.0))
    grid = np.stack([column, row], axis=-1)
    grid[1:-1, 1:-1] += generator.uniform(-0.3, 0.3, grid[1:-1, 1:-1].shape)
    grid = 3.5 - cell * count / 2 + grid * cell
    grid[[0, -1]], grid[:, [0, -1]] = np.round(grid[[0, -1]] * 2) / 2, np.round(grid[:, [0, -1]] * 2) / 2
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    triangles = np.stack([np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)]).reshape(-1, 3, 2)
    low, high = grid[0, 0], grid[-1, -1]
    square = clip_of_window([[low, (high[0], low[1]), high], [low, high, (low[0], high[1])]], size)
    assert np.array_equal(signed_cover(clip_of_window(triangles, size), size), signed_cover(square, size))


@given(SEEDS, st.sampled_from(TESTING_FILLS))
def test_sphere_from_inside_covers_every_pixel_once(seed: int, fill: str) -> None:
    # From inside a closed surface every ray leaves once, through a back face; many triangles cross the eye.
    generator = np.random.default_rng(seed)
    positions, triangles = icosphere(int(generator.integers(0, 3)))
    eye = generator.normal(size=3)
    eye *= generator.uniform(0, 0.75) / np.linalg.norm(eye)
    clip = clip_of_view(positions, triangles, eye, random_rotation(generator))
    size = (21, 17)
    assert ((clip[..., 3] > 0).any(axis=1) & (clip[..., 3] < 0).any(axis=1)).any()
    assert (signed_cover(clip, size, fill) == -1).all()
    assert (cover_each(clip, size, fill).sum(axis=0) == 1).all()


@given(SEEDS)
def test_torus_from_inside_its_tube_and_from_outside(seed: int) -> None:
    generator = np.random.default_rng(seed)
    positions, triangles = torus(int(generator.integers(5, 24)), int(generator.integers(3, 12)))
    rotation = random_rotation(generator)
    size = (23, 19)
    outside = generator.normal(size=3)
    outside *= generator.uniform(1.5, 4) / np.linalg.norm(outside)
    assert not signed_cover(clip_of_view(positions, triangles, outside, rotation), size).any()
    hole = np.array([0, 0, generator.uniform(-2, 2)])
    assert not signed_cover(clip_of_view(positions, triangles, hole, rotation), size).any()
    # And with the eye in the tube, where a part of the surface lies on every side.
    within = np.array([1.0, 0, 0]) + generator.uniform(-0.1, 0.1, 3)
    positions, triangles = torus(24, 8)
    assert (signed_cover(clip_of_view(positions, triangles, within, rotation), size) == -1).all()


@given(SEEDS)
def test_a_mesh_drawn_by_the_pipeline_is_watertight_with_the_depth_test_off(seed: int) -> None:
    generator = np.random.default_rng(seed)
    positions, triangles = icosphere(1)
    clip = clip_of_view(
        positions, triangles, generator.uniform(-0.4, 0.4, 3), random_rotation(generator), near=0.01
    )
    frame = render(ClipScene(clip, size=(20, 20)), Settings(visibility="last-drawn"))
    assert (frame.cover_count == 1).all()
    assert (frame.primitive >= 0).all()


@given(SEEDS, st.sampled_from([DEPTH_PLANES, ALL_PLANES]))
def test_clipped_meshes_stay_watertight(seed: int, planes: tuple[int, ...]) -> None:
    generator = np.random.default_rng(seed)
    positions, triangles = icosphere(1)
    eye = generator.normal(size=3)
    eye *= generator.uniform(0, 0.7) / np.linalg.norm(eye)
    clip = clip_of_view(positions, triangles, eye, random_rotation(generator), near=0.02)
    primitives = Primitives(
        clip, np.zeros((len(clip), 3, 0)), np.arange(len(clip)), np.zeros(len(clip), int), {}
    )
    pieces = clip_primitives(primitives, plane_distances(clip), planes).primitives.clip
    size = (19, 13)
    assert (pieces[..., 3] >= 0).all()
    assert (signed_cover(pieces, size) == -1).all()


@given(SEEDS, st.integers(1, 3))
def test_the_sides_of_an_edge_decide_alike_whatever_lies_behind_the_eye(seed: int, unprojected: int) -> None:
    # Two triangles on one edge: not both and not none draw a pixel near it; third corners lie anywhere.
    generator = np.random.default_rng(seed)
    size = (16, 16)
    start, end = generator.integers(-2, 36, (2, 2)) / 2
    w = generator.uniform(0.1, 3, 2) * [-1 if unprojected & 1 else 1, -1 if unprojected & 2 else 1]
    start, end = clip_of_window([[start, end]], size, [w])[0]
    far = generator.uniform(-5, 5, (2, 4))
    clip = np.stack([[start, end, far[0]], [end, start, far[1]]])
    first, second = edges_of(clip, size), edges_of(clip[::-1], size)
    columns, rows = np.meshgrid(np.arange(16) + 0.5, np.arange(16) + 0.5)
    sign = np.sign(first.doubled_area)
    values = [first.a[t, 2] * columns + (first.b[t, 2] * rows + first.c[t, 2]) for t in (0, 1)]
    assert np.array_equal(sign[0] * values[0], -sign[1] * values[1])
    # A point on the edge belongs to one of two triangles that lie on either side of it.
    if sign[0] * sign[1] > 0:
        inside = [(v > 0) | ((v == 0) & first.owns_tie[t, 2]) for t, v in enumerate(values)]
        assert np.array_equal(inside[0], ~inside[1]) or not (first.a[0, 2] or first.b[0, 2])
    assert np.array_equal(second.a[0], first.a[1])
