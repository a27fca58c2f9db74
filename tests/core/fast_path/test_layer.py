"""A picture without depth, of a single layer, is drawn only where it is the picture that depth would give."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Camera, ClipScene, DirectionalLight, Mesh, Picture, Scene, Settings, draw_picture, render
from core.fast_path.draw_context import Split
from core.methods import table
from lessons.shapes import cube, knot, sphere, torus
from tests.core.fast_path.numbered import assert_same, numbered, numbers
from tests.core.fast_path.references import exact_bytes
from tests.core.spans.adversarial import slivers, tiny
from tests.core.strategies import clip_of_window
from tests.covering import every_pair

SEEDS = st.integers(0, 2**32 - 1)
SIZE = (64, 48)


def picture_of(clip, **chosen: str) -> Picture:
    """Draw triangles by their numbers; the picture is that of `render`."""
    assert_same(clip, SIZE, Settings(**chosen))
    return draw_picture(numbered(clip, SIZE), Settings(fill="spans", **chosen), encoding="linear")


def square(left: float, bottom: float, side: float, z: float) -> list[np.ndarray]:
    """Return clip positions (2, 3, 4) of a square."""
    a, b, c, d = ((left, bottom), (left + side, bottom), (left + side, bottom + side), (left, bottom + side))
    return list(clip_of_window([[a, b, c], [a, c, d]], SIZE, 1.0, z))


@pytest.mark.parametrize("depth", ["z-float32", "fixed-38"])
def test_triangles_side_by_side_are_a_layer(depth: str) -> None:
    assert picture_of(square(3.5, 2.5, 20, 0.2), depth=depth).route.visibility == "layer"
    apart = square(3.5, 2.5, 20, 0.2) + square(23.5, 2.5, 20, -0.2)
    assert picture_of(apart, depth=depth).route.visibility == "layer"


@pytest.mark.parametrize("depth", table.names("depth"))
@pytest.mark.parametrize("overlap", [1.0, 19.0, 20.0])
def test_triangles_one_over_another_are_not(depth: str, overlap: float) -> None:
    for z in ([0.2, -0.2], [-0.2, 0.2]):
        clip = square(3.5, 2.5, 20, z[0]) + square(23.5 - overlap, 2.5, 20, z[1])
        assert picture_of(clip, depth=depth).route.visibility == "packed-depth"


@pytest.mark.parametrize("depth", table.names("depth"))
def test_the_same_triangle_twice_keeps_the_first(depth: str) -> None:
    clip = square(3.5, 2.5, 20, 0.2) * 2
    picture = picture_of(clip, depth=depth)
    assert picture.route.visibility == "packed-depth"
    assert set(np.unique(numbers(picture.pixels))) == {-1, 0, 1}


@every_pair(
    depth=table.names("depth"),
    visibility=["z-buffer", "last-drawn"],
    z=[1.0, 1 - 1e-9, 1 - 2.0**-26, 1 - 2.0**-20, 1 - 2.0**-12, -1.0],
)
def test_what_is_as_far_as_the_cleared_buffer_is_not_drawn(depth: str, visibility: str, z: float) -> None:
    single = clip_of_window([[(0, 0), (130, 0), (0, 100)]], SIZE, 1.0, z)
    slanted = clip_of_window([[(0, 0), (130, 0), (0, 100)]], SIZE, 1.0, [[0.5, z, z]])
    for clip in (single, slanted, square(3.5, 2.5, 20, z)):
        picture_of(clip, depth=depth, visibility=visibility)


@given(
    SEEDS, st.sampled_from([1, 4, 16]), st.booleans(), st.floats(0, 6), st.sampled_from(table.names("depth"))
)
def test_thin_triangles_near_the_far_plane(
    seed: int, count: int, is_tiny: bool, nearness: float, depth: str
) -> None:
    # Corners a little off the grid: the unsnapped plane, extrapolated, may reach the far plane.
    generator = np.random.default_rng(seed)
    corners = (tiny if is_tiny else slivers)(generator, count, SIZE)
    corners = corners + generator.uniform(-0.002, 0.002, corners.shape)
    z = 1 - 10.0**-nearness * generator.random((count, 3))
    assert_same(clip_of_window(corners, SIZE, 1.0, z), SIZE, Settings(depth=depth))


@given(SEEDS, st.integers(1, 16))
def test_few_triangles_anywhere(seed: int, count: int) -> None:
    generator = np.random.default_rng(seed)
    corners = generator.uniform(-4, np.array(SIZE) + 4, (count, 1, 2)) + generator.normal(0, 9, (count, 3, 2))
    clip = clip_of_window(corners, SIZE, 1.0, generator.uniform(-1, 0.99, (count, 3)))
    picture_of(clip)


def solid(mesh: Mesh, turn: float, size: tuple[int, int] = SIZE) -> Scene:
    eye = np.array([3.2 * np.cos(turn), 1.1, 3.2 * np.sin(turn)])
    light = DirectionalLight(np.array([-1.0, -2.0, -0.5]))
    return Scene((mesh,), Camera(eye, np.zeros(3)), (light,), size, np.array([0.1, 0.2, 0.3, 1.0]))


def without(mesh: Mesh, kept: slice) -> Mesh:
    """Return an open mesh: some triangles of a closed one."""
    return Mesh(mesh.positions, mesh.triangles[kept], mesh.normals)


MESHES = {
    "cube": (lambda: cube(1.6), True),
    "sphere": (lambda: sphere(1.0, 40, 20), True),
    "torus": (torus, False),
    "knot": (lambda: knot(columns=120, rows=8), False),
    "open sphere": (lambda: without(sphere(1.0, 40, 20), slice(0, 900)), True),
    "open torus": (lambda: without(torus(), slice(0, 1500)), False),
}
"""Name to what makes a mesh, and whether it is convex. Of a mesh that was drawn it is known whether it overlaps."""


@every_pair(mesh=list(MESHES), cull=["back", "front", "none"], turn=[0.1, 0.9, 2.0, 3.3])
def test_meshes(mesh: str, cull: str, turn: float) -> None:
    make, is_convex = MESHES[mesh]
    scene = solid(make(), turn)
    chosen = Settings(cull=cull, shading="flat", interpolation="flat")
    picture = draw_picture(scene, Settings(**{**vars(chosen), "fill": "spans"}))
    assert np.array_equal(picture.pixels, exact_bytes(scene, chosen, "srgb"))
    if cull == "back" and is_convex:
        assert picture.route.visibility == "layer"
    elif picture.route.visibility == "layer":
        assert render(scene, chosen).cover_count.max() == 1


def test_a_scene_that_turned_out_to_overlap_may_become_a_layer_again() -> None:
    mesh = torus()
    for turn in (0.2, 0.5):
        scene = solid(mesh, turn)
        for cull in ("none", "back", "none"):
            picture = draw_picture(scene, Settings(fill="spans", cull=cull, shading="flat"))
            assert np.array_equal(
                picture.pixels, exact_bytes(scene, Settings(cull=cull, shading="flat"), "srgb")
            )


def test_background_shows_where_nothing_is() -> None:
    background = np.array([0.2, 0.4, 0.6, 0.5])
    clip = np.array(square(3.5, 2.5, 20, 0.2))
    for color in (np.array([0.0, 0.0, 0.0, 1.0]), np.array([0.5, 0.0, 0.0, 0.0])):
        scene = ClipScene(clip, np.tile(color, (2, 3, 1)), SIZE, None, background)
        picture = draw_picture(scene, Settings(fill="spans"))
        assert np.array_equal(picture.pixels, exact_bytes(scene, Settings(), "srgb")), picture.route


def test_large_triangles_of_a_layer_are_counted_as_drawn_in_bands() -> None:
    clip = clip_of_window(
        [[(0, 0), (400, 0), (0, 300)], [(390, 290), (395, 290), (390, 295)]], (400, 300), 1.0, 0.0
    )
    picture = draw_picture(ClipScene(clip, size=(400, 300)))
    assert picture.route.visibility == "layer"
    assert picture.route.split == Split(1, 1, 0, picture.route.visible)
