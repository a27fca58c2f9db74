"""Colours interpolated as bytes are at most one byte away from the exact ones; what says so never says too little."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import STAGES, ClipScene, Material, Picture, Settings, draw_picture, render
from core.fast_path import byte_colors
from core.fast_path.byte_colors import VertexBytes, chord_error, perspective_error, product_error
from core.framebuffer.display import srgb
from core.records.frame import StageCount
from core.stages.vertices import process_geometry
from tests.core.fast_path.band_scenes import SPANS, ball
from tests.core.fast_path.references import exact_bytes, shows_thin_triangle
from tests.core.spans.adversarial import projected
from tests.core.strategies import clip_of_window
from tests.covering import in_turns

SEEDS = st.integers(0, 2**32 - 1)
ENCODINGS = st.sampled_from(["srgb", "linear"])


def assert_within_a_byte(scene: ClipScene, chosen: Settings, encoding: str) -> Picture:
    picture = draw_picture(scene, Settings(**{**vars(chosen), "fill": "spans"}), encoding=encoding)
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding))
    if picture.route.color == "deferred":
        assert away.max(initial=0) == 0
    else:
        away[shows_thin_triangle(scene, chosen)] = 0
        assert away.max(initial=0) <= 1, picture.route
    return picture


def linear_of_bytes(levels: np.ndarray, encoding: str) -> np.ndarray:
    """Return linear colours (..., 4) whose encoded bytes (..., 3) are ``levels``, opaque."""
    encoded = levels / 255
    if encoding == "srgb":
        encoded = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return np.concatenate([encoded, np.ones((*levels.shape[:-1], 1))], axis=-1)


@given(
    SEEDS,
    st.sampled_from([(1, 1), (61, 97), (200, 150), (600, 40)]),
    st.sampled_from([1, 12, 60]),
    st.sampled_from([2, 8, 30, 255]),
    st.sampled_from(["perspective", "affine", "flat"]),
    st.sampled_from(["z-buffer", "last-drawn"]),
    ENCODINGS,
)
def test_pictures_are_within_a_byte(
    seed: int, size, count: int, spread: int, interpolation: str, visibility: str, encoding: str
) -> None:
    generator = np.random.default_rng(seed)
    # Corners of triangles with pixels enough that snapping moves no colour by half a byte.
    corners = generator.uniform(-20, np.array(size) + 20, (count, 1, 2)) + 30 * generator.normal(
        size=(count, 3, 2)
    )
    (x1, y1), (x2, y2) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    corners = corners[np.abs(x1 * y2 - x2 * y1) > 300]
    count = len(corners)
    base = generator.uniform(0, 255 - spread, (count, 1, 3)) if spread < 255 else np.zeros((count, 1, 3))
    levels = base + spread * generator.choice([0.0, 0.3, 1.0], (count, 3, 3))
    w = generator.choice([1.0, 1.05, 1.5], (count, 1)) * generator.uniform(
        1, generator.choice([1, 1.02, 3]), (count, 3)
    )
    clip = clip_of_window(corners, size, w, generator.uniform(-0.9, 0.9, (count, 3)))
    scene = ClipScene(clip, linear_of_bytes(levels, encoding), size)
    assert_within_a_byte(scene, Settings(interpolation=interpolation, visibility=visibility), encoding)


@in_turns(shift=range(3), turned=[False, True], extent=[(250, 250), (3000, 14), (14, 3000), (500, 400)])
def test_long_ramps_from_black_and_from_white(shift: int, turned: bool, extent: tuple[int, int]) -> None:
    # Steps are rounded and add up over the triangle: no channel may run below 0 or above 255.
    width, height = extent
    corners = np.array([[(0.25, 0.25), (width + 0.7, 1.5), (1.3, height + 0.6)]])
    generator = np.random.default_rng(width)
    for low, high in ((0, 101), (0, 255), (0, 7), (155, 255)):
        levels = np.where(generator.random((1, 3, 3)) < 0.5, low, high)
        clip = clip_of_window(np.roll(corners, shift, axis=1)[:, :: -1 if turned else 1], extent)
        scene = ClipScene(clip, linear_of_bytes(levels, "linear"), extent)
        assert_within_a_byte(scene, Settings(), "linear")


@given(SEEDS, st.sampled_from([3, 40, 255]), ENCODINGS)
def test_thin_triangles_have_colours_between_those_of_their_corners(
    seed: int, spread: int, encoding: str
) -> None:
    generator, size, count = np.random.default_rng(seed), (61, 97), 60
    clip = clip_of_window(projected(generator, count, size), size)
    levels = generator.uniform(0, 255 - spread, (count, 1, 3)) + spread * generator.random((count, 3, 3))
    scene = ClipScene(clip, linear_of_bytes(levels, encoding), size)
    picture = assert_within_a_byte(scene, Settings(), encoding)
    if picture.route.color == "corners":
        primitive = render(scene).primitive
        shown, seen = picture.pixels[primitive >= 0, :3], primitive[primitive >= 0]
        assert (shown >= np.floor(levels.min(axis=1)[seen])).all()
        assert (shown <= np.ceil(levels.max(axis=1)[seen])).all()


@pytest.mark.parametrize("w", [1e-250, 1e-9, 1e-3])
def test_any_ratio_of_w_is_drawn(w: float) -> None:
    clip = np.array([[[0, 0, 0, w], [0.5e60, 0, 0, 1e60], [0, 0.5e60, 0, 1e60]]])
    levels = np.array([[[10.0, 200, 30], [250, 20, 0], [90, 90, 90]]])
    for encoding in ("srgb", "linear"):
        scene = ClipScene(clip, linear_of_bytes(levels, encoding), (16, 12))
        assert_within_a_byte(scene, Settings(), encoding)


@given(SEEDS, st.sampled_from([0.01, 0.1, 2.0]), ENCODINGS)
def test_light_brighter_than_1_is_cut_off_after_interpolation(
    seed: int, beyond: float, encoding: str
) -> None:
    generator, size = np.random.default_rng(seed), (61, 97)
    corners = [[(2.25, 3.5), (55, 8), (12.5, 90)], [(60, 20), (58, 95), (20, 92)]]
    levels = generator.choice([1.0, 250.0]) + generator.uniform(-3, 3, (2, 3, 3))
    color = linear_of_bytes(np.clip(levels, 0, 255), encoding)
    color[..., :3] += generator.uniform(-beyond, beyond, (2, 3, 3)) * (generator.random((2, 3, 3)) < 0.5)
    assert_within_a_byte(ClipScene(clip_of_window(corners, size), color, size), Settings(), encoding)


def test_chord_error_is_never_below_the_true_one() -> None:
    level = np.arange(0, 255.5, 0.5)
    low, high = (side.ravel() for side in np.meshgrid(level, level))
    low, high = low[low < high], high[low < high]
    bound = chord_error(np.tile(low, (3, 1)), np.tile(high - low, (3, 1)))
    start, end = (linear_of_bytes(side[:, None], "linear")[:, 0] for side in (decoded(low), decoded(high)))
    for share in np.linspace(0.02, 0.98, 49):
        exact = 255 * srgb(start + share * (end - start))
        assert (np.abs(exact - (low + share * (high - low))) <= bound + 1e-9).all()


def decoded(level: np.ndarray) -> np.ndarray:
    """Return 255 times the linear light of sRGB levels 0 to 255."""
    return 255 * linear_of_bytes(level[:, None], "srgb")[:, 0]


def shares(count: int) -> np.ndarray:
    """Return barycentric coordinates (F, 3), ``count`` steps along every side."""
    first, second = np.meshgrid(np.arange(count + 1), np.arange(count + 1))
    inside = first + second <= count
    first, second = first[inside] / count, second[inside] / count
    return np.stack([first, second, 1 - first - second], axis=1)


@given(SEEDS, st.floats(1, 1e6))
def test_perspective_error_is_never_below_the_true_one(seed: int, ratio: float) -> None:
    generator = np.random.default_rng(seed)
    w = ratio ** generator.choice([0.0, 0.5, 1.0, generator.random()], 3)
    scene = ClipScene(clip_of_window([[(1, 1), (5, 2), (3, 6)]], (8, 8), w), size=(8, 8))
    geometry = process_geometry(scene, Settings(), {stage: StageCount() for stage in STAGES})
    values = generator.choice([0.0, 255.0, generator.uniform(0, 255)], 3)
    over_window = shares(40)
    divided = over_window / w
    exact = (divided * values).sum(axis=1) / divided.sum(axis=1)
    bound = perspective_error(geometry, np.array([np.ptp(values)]))
    assert np.abs(exact - over_window @ values).max() <= bound[0] + 1e-9


@given(SEEDS, st.sampled_from([0.01, 0.2, 1.0]), ENCODINGS)
def test_product_error_is_never_below_the_true_one(seed: int, spread: float, encoding: str) -> None:
    generator = np.random.default_rng(seed)
    albedo, light = generator.uniform(0, 1 - spread, (2, 1)) + spread * generator.random((2, 3))
    level = 255 * (srgb(albedo * light) if encoding == "srgb" else albedo * light)
    low = np.tile(level.min(), (3, 1))
    vertices = VertexBytes(np.tile(level, (3, 1)), [(0, albedo, light)], True, None)
    bound = product_error(vertices, np.arange(3)[:, None], low, encoding)[0]
    linear = (shares(40) @ albedo) * (shares(40) @ light)
    exact = 255 * (srgb(linear) if encoding == "srgb" else linear)
    if encoding == "srgb":
        bound += chord_error(low, np.full((3, 1), np.ptp(level)))[0]
    assert np.abs(exact - shares(40) @ level).max() <= bound + 1e-9


def test_the_bound_of_all_triangles_decides_as_those_that_are_drawn_do() -> None:
    scene, chosen = ball(5, (200, 200)), replace(SPANS, cull="back", shading="gouraud")
    mesh = scene.meshes[0]
    colors = np.concatenate([0.5 + 0.2 * mesh.positions, np.ones((len(mesh.positions), 1))], axis=1)
    scene = replace(
        scene,
        meshes=(replace(mesh, colors=colors, material=Material(0.4, 0.5, 0.0)),),
        lights=scene.lights[:1],
    )
    for eye in ((0.4, 0.8, 2.6), (0.4, 0.8, 2.6), (-2.0, 0.3, 1.7), (0.1, -2.5, 0.4)):
        turned = replace(scene, camera=replace(scene.camera, eye=np.array(eye)))
        again = draw_picture(turned, chosen)  # from the second time on with the bound
        byte_colors._last.clear()
        alone = draw_picture(turned, chosen)
        assert again.route.color == alone.route.color == "corners"
        assert np.array_equal(again.pixels, alone.pixels)
        draw_picture(turned, chosen)
        assert 0 < byte_colors._last[0][2].most_product < 1


@pytest.mark.parametrize("encoding", ["srgb", "linear"])
@pytest.mark.parametrize("seed", range(4))
def test_a_large_triangle_has_the_same_bytes_where_nothing_overlaps_as_where_something_does(
    seed: int, encoding: str
) -> None:
    size, generator = (400, 300), np.random.default_rng(seed)
    corners = [[(3, 2), (395, 10), (20, 290)], [(300, 280), (390, 280), (350, 200)]]
    clip = clip_of_window(np.array([*corners, corners[1]]), size, 1.0, 0.0)
    levels = generator.uniform(80, 200, (3, 1, 3)) + generator.uniform(-6, 6, (3, 3, 3))
    scene = ClipScene(clip, linear_of_bytes(levels, encoding), size)
    whole = draw_picture(scene, SPANS, encoding=encoding)
    part = draw_picture(scene, SPANS, encoding=encoding, region=(0, 0, 400, 150))
    assert [(picture.route.visibility, picture.route.color) for picture in (whole, part)] == [
        ("packed-depth", "corners"),
        ("layer", "corners"),
    ]
    assert np.array_equal(part.pixels, whole.pixels[:150])
