"""Packed textures: no linear value is farther off than stated, and bytes of pictures come back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.framebuffer.display import encode_linear, encode_srgb, from_display
from core.scene import Texture
from core.textures.look_up import texture_colors
from core.textures.packed import PackedSampler, has_bytes, is_packable, linear_levels

WRAPS = ["repeat", "clamp", "mirror"]
SIZES = [(1, 1), (2, 8), (7, 5), (16, 16), (64, 3)]
SRGB = encode_srgb(linear_levels())
EVERY_GREY = Texture(from_display(np.arange(256, dtype=np.uint8).reshape(16, 16, 1)))


def linear_error(contrast: float) -> float:
    """Return the stated bound of a linear value where neighbouring texels differ by ``contrast`` at most."""
    return contrast / 128 + 1 / 8191


def random_texture(size, channels=3, seed=0):
    width, height = size
    return Texture(np.random.default_rng(seed).random((height, width, channels)).astype(np.float32))


def wave(size):
    """Return a texture that is smooth everywhere, across its borders too."""
    x, y = (2 * np.pi * (np.arange(size) + 0.5) / size for _ in range(2))
    waves = [0.5 + 0.25 * (np.sin(x + k)[None] + np.cos(y - k)[:, None]) for k in range(3)]
    return Texture(np.stack(waves, axis=2).astype(np.float32))


def looked_up(texture, uv, texture_filter="bilinear", wrap="repeat", level_bytes=SRGB):
    words = np.zeros(len(uv), np.uint32)
    PackedSampler(texture, texture_filter, wrap, level_bytes).write_words(*uv.T, words)
    return np.stack([words >> shift & 255 for shift in (0, 8, 16, 24)], axis=1).astype(int)


def exact_bytes(texture, uv, texture_filter="bilinear", wrap="repeat", off=0.0):
    linear = texture_colors(texture, uv.astype(np.float64), texture_filter, wrap)[:, :3]
    return encode_srgb(linear + off).astype(int)


def places(count, dtype=np.float64):
    return np.random.default_rng(9).uniform(-2, 3, (count, 2)).astype(dtype)


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("size", SIZES)
def test_no_linear_value_is_farther_off_than_stated(size, wrap):
    # A byte between those of the ends of the interval: the linear value lies in it.
    for texture, contrast in ((random_texture(size), 1.0), (random_texture(size, 1), 1.0)):
        uv = places(40000)
        found = looked_up(texture, uv, wrap=wrap)[:, :3]
        error = linear_error(contrast)
        assert (found >= exact_bytes(texture, uv, wrap=wrap, off=-error)).all()
        assert (found <= exact_bytes(texture, uv, wrap=wrap, off=error)).all()


def test_single_precision_coordinates_cost_little():
    texture, uv = random_texture((16, 16)), places(40000, np.float32)
    found, error = looked_up(texture, uv)[:, :3], linear_error(1.0) + 1e-5
    assert (found >= exact_bytes(texture, uv, off=-error)).all()
    assert (found <= exact_bytes(texture, uv, off=error)).all()


def test_how_many_bytes_that_is():
    uv = places(40000)
    smooth, rough = wave(64), random_texture((64, 64))
    off_where_smooth = np.abs(looked_up(smooth, uv)[:, :3] - exact_bytes(smooth, uv))
    off_where_rough = np.abs(looked_up(rough, uv)[:, :3] - exact_bytes(rough, uv))
    assert off_where_smooth.max() <= 1
    assert off_where_rough.max() <= 8
    assert (off_where_rough > 1).mean() < 0.002


@pytest.mark.parametrize("wrap", WRAPS)
def test_nearest_gives_the_bytes_of_a_picture_file(wrap):
    pixels = np.random.default_rng(3).integers(0, 256, (11, 13, 3), np.uint8)
    texture, uv = Texture(from_display(pixels)), places(5000)
    found = looked_up(texture, uv, "nearest", wrap)[:, :3]
    assert np.array_equal(found, exact_bytes(texture, uv, "nearest", wrap))


def test_an_even_texture_keeps_its_bytes_and_a_texel_centre_its_colour():
    for byte in range(256):
        even = Texture(from_display(np.full((3, 4, 3), byte, np.uint8)))
        assert (looked_up(even, places(64))[:, :3] == byte).all()
    centres = np.stack(np.meshgrid(np.arange(16) + 0.5, np.arange(16) + 0.5), axis=2).reshape(-1, 2) / 16
    for channel in range(3):
        assert looked_up(EVERY_GREY, centres)[:, channel].tolist() == list(range(256))


def test_words_hold_red_lowest_and_are_opaque():
    texture = Texture(np.array([[[1.0, 0.5, 0.0]]], np.float32))
    words = np.zeros(1, np.uint32)
    sampler = PackedSampler(texture, "bilinear", "repeat", encode_linear(linear_levels()))
    sampler.write_words(np.zeros(1), np.zeros(1), words)
    assert hex(words[0]) == "0xff0080ff"


@pytest.mark.parametrize("texture_filter", ["bilinear", "nearest"])
@pytest.mark.parametrize("wrap", WRAPS)
def test_positions_are_counted_in_256ths_of_a_texel(texture_filter, wrap):
    texture, (u, v) = random_texture((16, 4)), places(4096).T
    sampler = PackedSampler(texture, texture_filter, wrap, SRGB)
    by_coordinate, by_position = np.zeros((2, len(u)), np.uint32)
    sampler.write_words(u, v, by_coordinate)
    half = 127.5 if texture_filter == "bilinear" else 0
    sampler.write_words_at(u * 16 * 256 - half, v * 4 * 256 - half, by_position)
    assert np.array_equal(by_coordinate, by_position)


@given(
    u=st.floats(-4, 4, width=16),
    v=st.floats(-4, 4, width=16),
    turns=st.integers(-(2**24), 2**24),
    texture_filter=st.sampled_from(["bilinear", "nearest"]),
)
def test_far_repetitions_look_the_same(u, v, turns, texture_filter):
    texture = random_texture((8, 4))
    near, far = np.array([[u, v]]), np.array([[u + 2 * turns, v - 2 * turns]])
    for wrap in ("repeat", "mirror"):
        assert np.array_equal(
            looked_up(texture, near, texture_filter, wrap), looked_up(texture, far, texture_filter, wrap)
        )


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("texture_filter", ["bilinear", "nearest"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_undefined_and_huge_coordinates(texture_filter, wrap, dtype):
    texture = random_texture((4, 4))
    uv = np.array([[np.nan, 0.3], [np.inf, -np.inf], [1e38, -1e38], [0.0, 0.3]], dtype)
    kept = uv.copy()
    found = looked_up(texture, uv, texture_filter, wrap)
    assert np.array_equal(found[0], found[3])
    assert (found[:, 3] == 255).all()
    assert np.array_equal(uv, kept, equal_nan=True)
    if wrap == "clamp":
        assert np.array_equal(found[2, :3], exact_bytes(texture, np.array([[1.0, 0.0]]), "nearest", wrap)[0])


def test_every_block_alike():
    texture, uv = random_texture((9, 6)), places(70000)
    together = looked_up(texture, uv, wrap="mirror")
    for one in (0, 32767, 32768, 69999):
        assert np.array_equal(together[one : one + 1], looked_up(texture, uv[one : one + 1], wrap="mirror"))
    assert looked_up(texture, uv[:0]).shape == (0, 4)


def test_what_can_be_packed():
    assert is_packable(random_texture((3, 2)), "repeat")
    assert is_packable(random_texture((3, 2), 1), "repeat")
    assert not is_packable(random_texture((3, 2), 4), "repeat")
    assert not is_packable(Texture(np.full((1, 1, 3), 1.25, np.float32)), "repeat")
    assert not is_packable(Texture(np.full((1, 1, 1), -0.1, np.float32)), "repeat")


def test_tables_of_too_many_places_are_not_made():
    texture = Texture(np.zeros((1500, 1500, 1), np.float32))
    assert is_packable(texture, "repeat")
    assert not is_packable(texture, "mirror")  # four times as many places


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("size", SIZES)
def test_a_texture_of_bytes_is_mixed_in_bytes(size, wrap):
    width, height = size
    pixels = np.random.default_rng(4).integers(0, 256, (height, width, 3))
    texture, uv = Texture((pixels / 255).astype(np.float32)), places(40000)
    assert has_bytes(texture)
    assert not has_bytes(random_texture((5, 5)))
    found = looked_up(texture, uv, wrap=wrap, level_bytes=None)
    exact = 255 * texture_colors(texture, uv, "bilinear", wrap)[:, :3]
    assert np.abs(found[:, :3] - exact).max() <= 0.5 + 255 * linear_error(1.0)
    assert (found[:, 3] == 255).all()
    nearest = looked_up(texture, uv, "nearest", wrap, level_bytes=None)
    assert np.array_equal(nearest[:, :3], np.rint(255 * texture_colors(texture, uv, "nearest", wrap)[:, :3]))
