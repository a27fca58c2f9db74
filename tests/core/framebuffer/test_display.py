import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.framebuffer import display
from core.records.listing import listing


def formula(linear):
    """Return the bytes by the formula, one power for each value."""
    values = np.clip(np.asarray(linear, np.float32).astype(np.float64), 0, 1)
    return np.floor(255 * display.srgb(values) + 0.5).astype(np.uint8)


def neighbours(values, reach):
    bits = np.asarray(values, np.float32).view(np.int32).astype(np.int64)[:, None] + np.arange(
        -reach, reach + 1
    )
    return bits.clip(0).astype(np.int32).view(np.float32).ravel()


def test_known_bytes():
    linear = np.array([0, 0.0031308, 0.18, 0.5, 0.7, 1.0, -0.2, 7.0, np.inf, -np.inf], np.float32)
    assert display.encode_srgb(linear).tolist() == [0, 10, 118, 188, 218, 255, 0, 255, 255, 0]


def test_the_curve_is_that_of_the_standard():
    """Values of IEC 61966-2-1 in both directions, computed here with the standard's own constants."""
    linear = np.array([0.001, 0.0031308, 0.004, 0.05, 0.5])
    encoded = [
        12.92 * 0.001,
        12.92 * 0.0031308,
        *(1.055 * x ** (1 / 2.4) - 0.055 for x in (0.004, 0.05, 0.5)),
    ]
    assert display.srgb(linear) == pytest.approx(encoded, rel=1e-12)
    assert display.linear_light(np.array(encoded)) == pytest.approx(linear, rel=1e-12)
    assert display.linear_light(np.array([0.04044, 0.04046])) == pytest.approx(
        [0.04044 / 12.92, ((0.04046 + 0.055) / 1.055) ** 2.4]
    )


def test_all_bytes_survive_the_round_trip():
    every_byte = np.arange(256, dtype=np.uint8)
    assert np.array_equal(display.encode_srgb(display.srgb_decode_table()[every_byte]), every_byte)
    assert (np.diff(display.srgb_decode_table()) > 0).all()
    assert display.srgb_decode_table()[[0, 255]].tolist() == [0, 1]


def test_thresholds_are_the_first_value_of_a_byte():
    thresholds = display.srgb_thresholds()
    assert formula(thresholds).tolist() == list(range(1, 256))
    assert formula(np.nextafter(thresholds, np.float32(0))).tolist() == list(range(255))


def test_bytes_are_those_of_the_formula_near_every_threshold_and_table_border():
    borders = (np.arange(0x3F81, dtype=np.uint32) << 16).view(np.float32)
    for values in (
        neighbours(display.srgb_thresholds(), 100),
        neighbours(borders, 2),
        neighbours([0.0031308, 1.0], 200),
    ):
        assert np.array_equal(display.encode_srgb(values), formula(values))


def test_bytes_are_those_of_the_formula_anywhere():
    bits = np.random.default_rng(5).integers(0, 0x3F900000, 300_000).astype(np.int32)
    assert np.array_equal(display.encode_srgb(bits.view(np.float32)), formula(bits.view(np.float32)))


def test_at_most_one_threshold_for_the_same_upper_bits():
    upper = display.srgb_thresholds().view(np.uint32) >> 16
    assert len(set(upper.tolist())) == 255


@given(values=st.lists(st.floats(width=32, allow_nan=True), min_size=1, max_size=30))
def test_listing_gives_the_same_bytes(values):
    assert display.encode_srgb(np.array(values, np.float32)).tolist() == [
        display.srgb_byte(value) for value in values
    ]
    assert set(listing(display.srgb_byte).lines) == {"clip", "straight-part", "power-part", "round"}


@given(first=st.floats(0, 1, width=32), second=st.floats(0, 1, width=32))
def test_brighter_is_never_darker(first, second):
    low, high = display.encode_srgb(np.array([min(first, second), max(first, second)], np.float32))
    assert low <= high


def test_linear_light_inverts_srgb():
    values = np.linspace(0, 1, 1001)
    assert display.linear_light(display.srgb(values)) == pytest.approx(values, abs=1e-6)


def test_alpha_is_not_gamma_coded_and_half_rounds_up():
    assert display.encode_linear(np.array([0, 0.5, 1, np.nan, -1, 2], np.float32)).tolist() == [
        0,
        128,
        255,
        0,
        0,
        255,
    ]
    image = display.to_display(np.full((1, 2, 4), 0.5, np.float32))
    assert image.pixels.tolist() == [[[188, 188, 188, 128]] * 2]
    assert not image.undefined.any()


def test_plain_bytes_are_those_of_the_formula():
    halves = ((np.arange(256) + 0.5) / 255).astype(np.float32)
    bits = np.random.default_rng(6).integers(0, 0x3F900000, 100_000).astype(np.int32)
    for values in (neighbours(halves, 3), bits.view(np.float32)):
        expected = np.floor(255 * np.clip(values.astype(np.float64), 0, 1) + 0.5)
        assert np.array_equal(display.encode_linear(values), expected)


@pytest.mark.parametrize("channels", [3, 4])
def test_pixels_in_given_memory_are_those_of_the_image(channels):
    color = np.random.default_rng(8).uniform(-0.2, 1.2, (1, 40_000, channels)).astype(np.float32)
    color[0, 7] = np.nan
    pixels = np.empty((40_000, channels), np.uint8)
    display.write_pixels(color[0], pixels)
    assert np.array_equal(pixels, display.to_display(color).pixels[0])
    assert np.array_equal(pixels[:, :3], display.encode_srgb(color[0, :, :3]))
    assert np.array_equal(pixels[:, 3:], display.encode_linear(color[0, :, 3:]))


@pytest.mark.parametrize("bits", [0x7FC00000, 0x7F800001, 0xFFC00000, 0x7FFFFFFF])
def test_every_nan_is_shown_as_zero_and_reported(bits):
    color = np.ones((2, 2, 3), np.float32)
    color.view(np.uint32)[1, 0, 2] = bits
    image = display.to_display(color)
    assert image.pixels[1, 0].tolist() == [255, 255, 0]
    assert image.undefined.tolist() == [[False, False], [True, False]]
    assert np.isnan(color[1, 0, 2])


def test_values_beyond_float32():
    assert display.encode_srgb(np.array([1e300, -1e300])).tolist() == [255, 0]


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_image_bytes_to_texture_and_back(channels):
    pixels = np.random.default_rng(2).integers(0, 256, (5, 4, channels), np.uint8)
    color = display.from_display(pixels)
    assert color.dtype == np.float32
    if channels > 1:
        assert np.array_equal(display.to_display(color).pixels, pixels)
    else:
        assert np.array_equal(display.encode_srgb(color), pixels)


def test_strided_and_empty_pictures():
    color = np.random.default_rng(1).random((6, 8, 4)).astype(np.float32)
    assert np.array_equal(
        display.to_display(color[::-1, ::2]).pixels, display.to_display(color).pixels[::-1, ::2]
    )
    assert display.to_display(np.empty((0, 4, 3), np.float32)).pixels.shape == (0, 4, 3)


def test_bad_input():
    with pytest.raises(ValueError, match=r"color must be \(H, W, 3 or 4\), got \(2, 2\)"):
        display.to_display(np.zeros((2, 2), np.float32))
    with pytest.raises(ValueError, match=r"pixels must be \(h, w, 1, 3 or 4\), got \(2, 2, 2\)"):
        display.from_display(np.zeros((2, 2, 2), np.uint8))
    with pytest.raises(ValueError, match="pixels must be uint8, got float64"):
        display.from_display(np.zeros((2, 2, 3)))
