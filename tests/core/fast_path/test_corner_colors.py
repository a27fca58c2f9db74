"""Triangles have the colours that each of them allows: bytes, light, or attributes and light per pixel."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Mesh, Picture, Scene, Settings, draw_picture, render
from tests.core.fast_path.band_scenes import (
    SPANS,
    ball,
    behind_the_eye_below_and_smooth_above,
    shiny_rings,
    smooth_below_and_steep_above,
)
from tests.core.fast_path.references import exact_bytes, shows_thin_triangle
from tests.core.strategies import clip_of_window

ENCODINGS = st.sampled_from(["srgb", "linear"])


def gentle_and_steep(seed: int, size: tuple[int, int], with_ties: bool) -> tuple[ClipScene, np.ndarray]:
    """Return a scene of overlapping triangles, and which (T,) have colours that differ too much between corners."""
    generator, count = np.random.default_rng(seed), 40
    corners = generator.uniform(-10, np.array(size) + 10, (count, 1, 2)) + 25 * generator.normal(
        size=(count, 3, 2)
    )
    is_steep = generator.random(count) < 0.4
    color = np.ones((count, 3, 4))
    color[..., :3] = generator.uniform(0.2, 0.35, (count, 1, 3)) + 0.004 * generator.random((count, 3, 3))
    color[is_steep, :, :3] += 0.6 * np.eye(3)
    w = np.where(is_steep[:, None], [1.0, 2.0, 3.0], 1.0)
    depth = generator.uniform(-0.9, 0.9, (count, 3))
    if with_ties:  # the second half lies in the very places of the first half, in other colours
        corners[count // 2 :], depth[count // 2 :] = corners[: count // 2], depth[: count // 2]
    return ClipScene(clip_of_window(corners, size, w, depth), color, size), is_steep


def assert_each_as_it_allows(
    scene: ClipScene, is_steep: np.ndarray, chosen: Settings, encoding: str
) -> Picture:
    picture = draw_picture(scene, chosen, encoding=encoding)
    primitive = render(scene, chosen).primitive
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    away[shows_thin_triangle(scene, chosen) & ~is_steep[primitive]] = 0
    assert away.max(initial=0) <= 1
    assert away[is_steep[primitive] | (primitive < 0)].max(initial=0) == 0
    return picture


@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([(61, 97), (200, 150)]),
    st.booleans(),
    st.sampled_from(["fixed-38", "z-float32", "inverse-w"]),
    st.sampled_from(["z-buffer", "last-drawn"]),
    ENCODINGS,
    st.data(),
)
def test_parts_have_the_bytes_of_the_whole(
    seed: int, size, with_ties: bool, depth: str, visibility: str, encoding: str, data
) -> None:
    scene, is_steep = gentle_and_steep(seed, size, with_ties)
    chosen = replace(SPANS, depth=depth, visibility=visibility)
    picture = assert_each_as_it_allows(scene, is_steep, chosen, encoding)
    column, row = (data.draw(st.integers(0, length - 1)) for length in size)
    width, height = (data.draw(st.integers(1, n - at)) for n, at in zip(size, (column, row), strict=True))
    part = draw_picture(scene, chosen, encoding=encoding, region=(column, row, width, height))
    np.testing.assert_array_equal(
        part.pixels, picture.pixels[row : row + height, column : column + width], str(part.route)
    )


def test_of_triangles_at_one_depth_the_first_is_seen_whatever_colours_it_allows() -> None:
    corners = [[(3, 2), (90, 10), (20, 80)]]
    clip = clip_of_window(np.array(corners * 2), (100, 90), 1.0, 0.0)
    gentle = np.full((3, 4), [0.3, 0.3, 0.3, 1.0])
    gentle[1, 0] += 0.003
    steep = np.array([[1.0, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]])
    for first, second in ((gentle, steep), (steep, gentle)):
        scene = ClipScene(clip, np.stack([first, second]), (100, 90))
        alone = ClipScene(clip[:1], first[None], (100, 90))
        together = draw_picture(scene, SPANS)
        assert together.route.color == "corners"
        np.testing.assert_array_equal(together.pixels, draw_picture(alone, SPANS).pixels)


@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_a_steep_triangle_does_not_change_the_bytes_of_others(encoding: str) -> None:
    both = smooth_below_and_steep_above()
    smooth = ClipScene(both.clip[:1], both.attributes[:1], both.size)
    pictures = [draw_picture(scene, SPANS, encoding=encoding) for scene in (both, smooth)]
    assert [picture.route.color for picture in pictures] == ["corners", "corners"]
    lower = slice(0, both.size[1] // 4)
    np.testing.assert_array_equal(*(picture.pixels[lower] for picture in pictures))


def test_a_triangle_without_area_is_one_that_does_not_allow_bytes() -> None:
    both = smooth_below_and_steep_above()
    clip = both.clip.copy()
    clip[1] = clip[1, :1]
    scene = ClipScene(clip, both.attributes, both.size)
    alone = ClipScene(clip[:1], both.attributes[:1], both.size)
    np.testing.assert_array_equal(draw_picture(scene, SPANS).pixels, draw_picture(alone, SPANS).pixels)


@pytest.mark.parametrize("cull", ["back", "none"])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_several_meshes_are_within_a_byte_and_parts_agree(encoding: str, cull: str) -> None:
    scene, chosen = shiny_rings(), replace(SPANS, shading="gouraud", cull=cull)
    picture = draw_picture(scene, chosen, encoding=encoding, with_depth=True)
    assert picture.route.color == "corners"
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding))
    away[shows_thin_triangle(scene, chosen)] = 0
    assert away.max() == 1
    np.testing.assert_array_equal(picture.depth, render(scene, chosen).depth)
    for row in range(0, 110, 11):
        part = draw_picture(scene, chosen, encoding=encoding, region=(0, row, 140, 11))
        np.testing.assert_array_equal(part.pixels, picture.pixels[row : row + 11])


def test_plain_colours_are_asked_for() -> None:
    scene, chosen = shiny_rings(), replace(SPANS, shading="gouraud")
    plain = draw_picture(scene, chosen, plain_colors=True)
    assert (plain.route.color, plain.route.allowed) == ("deferred", "corners")
    np.testing.assert_array_equal(plain.pixels, exact_bytes(scene, chosen, "srgb"))


def noisy_ball(seed: int, size: tuple[int, int] = (300, 260)) -> Scene:
    """Return a ball of small triangles whose corners have unlike colours, dark and bright."""
    scene = ball(5, size)
    colors = np.ones((len(scene.meshes[0].positions), 4))
    colors[:, :3] = np.random.default_rng(seed).uniform(0.03, 1, (len(colors), 3))
    return replace(scene, meshes=(replace(scene.meshes[0], colors=colors),))


@pytest.mark.parametrize("shading", ["gouraud", "unlit"])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_unlike_corners_are_within_a_byte_also_in_thin_triangles(encoding: str, shading: str) -> None:
    scene = noisy_ball(3)
    for cull in ("back", "none"):
        chosen = replace(SPANS, shading=shading, cull=cull)
        picture = draw_picture(scene, chosen, encoding=encoding)
        assert picture.route.color == "corners"
        assert (picture.route.visibility == "layer") == (cull == "back") or shading == "gouraud"
        away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding))
        assert away.max() <= 1
        part = draw_picture(scene, chosen, encoding=encoding, region=(40, 50, 150, 120))
        np.testing.assert_array_equal(part.pixels, picture.pixels[50:170, 40:190])


def test_snapping_does_not_move_unlike_colours_by_more_than_a_byte() -> None:
    # Triangles of a few hundredths of a pixel, seen from the side, had bytes up to 26 away from those of the pipeline.
    scene = noisy_ball(3, (900, 780))
    chosen = replace(SPANS, shading="unlit", cull="back")
    picture = draw_picture(scene, chosen, encoding="linear")
    assert np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, "linear")).max() <= 1


def far_apart(seed: int, size: tuple[int, int], interpolation: str) -> tuple[ClipScene, Settings]:
    """Return small triangles side by side, from 1 to 40 pixels, w and colours differing within each."""
    generator = np.random.default_rng(seed)
    extent = 2.0 ** generator.uniform(0, 5.3, (150, 1, 1))
    corners = generator.uniform(0, size, (150, 1, 2)) + extent * generator.uniform(-0.5, 0.5, (150, 3, 2))
    w = 1 + generator.choice([0.0, 0.01, 0.2], (150, 1)) * generator.random((150, 3))
    color = np.ones((150, 3, 4))
    color[..., :3] = generator.uniform(-0.1, 1.1, (150, 3, 3)) ** 3
    clip = clip_of_window(corners, size, w, generator.uniform(-0.9, 0.9, (150, 3)))
    return ClipScene(clip, color, size), replace(SPANS, interpolation=interpolation)


@given(st.integers(0, 2**32 - 1), st.sampled_from(["perspective", "affine", "affine-n"]), ENCODINGS)
def test_small_triangles_of_any_colours_and_depths_are_within_a_byte(
    seed: int, interpolation: str, encoding: str
) -> None:
    scene, chosen = far_apart(seed, (160, 120), interpolation)
    picture = draw_picture(scene, chosen, encoding=encoding)
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    assert away.max() <= 1


@pytest.mark.parametrize("count", [1, 2, 3])
def test_colours_of_fewer_than_four_numbers_are_opaque_and_what_is_missing_is_black(count: int) -> None:
    scene, chosen = far_apart(7, (160, 120), "perspective")
    scene = replace(scene, attributes=scene.attributes[..., :count])
    for encoding in ("srgb", "linear"):
        picture = draw_picture(scene, chosen, encoding=encoding)
        assert np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max() <= 1


def test_where_no_triangle_allows_bytes_all_have_attributes_and_light() -> None:
    both = smooth_below_and_steep_above()
    scene = ClipScene(both.clip[1:], both.attributes[1:], both.size)
    for encoding in ("srgb", "linear"):
        picture = draw_picture(scene, SPANS, encoding=encoding)
        assert picture.route.color == "corners"
        np.testing.assert_array_equal(picture.pixels, exact_bytes(scene, SPANS, encoding))


def test_a_part_that_only_shows_what_reaches_behind_the_eye_allows_what_the_whole_allows() -> None:
    scene = behind_the_eye_below_and_smooth_above()
    lower = draw_picture(scene, SPANS, region=(0, 0, 160, 60))
    assert lower.route.allowed == draw_picture(scene, SPANS).route.allowed == "corners"


def test_a_see_through_triangle_leaves_others_their_bytes() -> None:
    both = smooth_below_and_steep_above()
    see_through = both.attributes.copy()
    see_through[1, 2, 3] = 0.5
    scene = ClipScene(both.clip, see_through, both.size)
    picture = draw_picture(scene, SPANS)
    assert picture.route.color == "corners"
    lower = slice(0, both.size[1] // 4)
    np.testing.assert_array_equal(picture.pixels[lower], draw_picture(both, SPANS).pixels[lower])
    shows_it = render(scene, SPANS).primitive == 1
    np.testing.assert_array_equal(picture.pixels[shows_it], exact_bytes(scene, SPANS, "srgb")[shows_it])


@pytest.mark.parametrize("clipping", ["homogeneous", "sutherland-hodgman"])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_a_floor_behind_the_eye_leaves_others_their_bytes(encoding: str, clipping: str) -> None:
    corners = np.array([[-9.0, -0.9, -9.0], [-9.0, -0.9, 9.0], [9.0, -0.9, 9.0], [9.0, -0.9, -9.0]])
    floor = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    rings, chosen = shiny_rings(), replace(SPANS, shading="gouraud", clipping=clipping)
    scene = replace(rings, meshes=(*rings.meshes, floor))
    picture = draw_picture(scene, chosen, encoding=encoding)
    assert picture.route.color == "corners"
    frame = render(scene, chosen)
    shows_floor = frame.primitive >= sum(len(mesh.triangles) for mesh in rings.meshes)
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    away[shows_thin_triangle(scene, chosen)] = 0
    assert away.max() == 1
    if clipping == "homogeneous":
        assert shows_floor.any()
        assert away[shows_floor].max() == 0
    alone = draw_picture(rings, chosen, encoding=encoding)
    shows_rings = (frame.primitive >= 0) & ~shows_floor
    np.testing.assert_array_equal(picture.pixels[shows_rings], alone.pixels[shows_rings])
    for row in range(0, 110, 11):
        part = draw_picture(scene, chosen, encoding=encoding, region=(0, row, 140, 11))
        np.testing.assert_array_equal(part.pixels, picture.pixels[row : row + 11])
