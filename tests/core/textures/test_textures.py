import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.methods import table
from core.scene import Texture
from core.textures.look_up import bilinear_color, nearest_color, sample_texture, texture_colors, wrapped_index

ORACLE = Path(__file__).resolve().parents[4] / "shared" / "oracle"
FILTERS = ["bilinear", "nearest"]
WRAPS = ["repeat", "clamp", "mirror"]
GREY = Texture(np.array([[0, 1, 2, 3], [4, 5, 6, 7]], np.float32)[..., None])
"""Four columns, two rows; row 0 (0 1 2 3) is the bottom."""

coordinates = st.floats(-40, 40)


def random_texture(width, height, channels):
    return Texture(np.random.default_rng(7).random((height, width, channels)).astype(np.float32))


def grey(u, v, texture_filter, wrap):
    return sample_texture(GREY, np.array([[u, v]]), texture_filter, wrap).color[0, 0]


@pytest.mark.parametrize(
    ("wrap", "expected"), [("repeat", "2301230123"), ("clamp", "0001233333"), ("mirror", "1001233210")]
)
def test_wraps_of_four_texels(wrap, expected):
    index = np.arange(-2, 8)
    assert "".join(map(str, table.get("wrap", wrap).function(index, 4))) == expected
    assert "".join(str(wrapped_index(int(i), 4, wrap)) for i in index) == expected


@given(index=st.integers(-(2**40), 2**40), size=st.integers(1, 5000), wrap=st.sampled_from(WRAPS))
def test_wrap_laws(index, size, wrap):
    rule = table.get("wrap", wrap).function
    wrapped = int(rule(np.array([index]), size)[0])
    assert 0 <= wrapped < size
    assert wrapped == wrapped_index(index, size, wrap)
    assert int(rule(np.array([wrapped]), size)[0]) == wrapped
    if wrap == "repeat":
        assert int(rule(np.array([index + size]), size)[0]) == wrapped
    if wrap == "mirror":
        assert int(rule(np.array([-1 - index]), size)[0]) == wrapped


def test_row_zero_is_at_v_zero_and_the_right_texel_wins_a_tie():
    assert grey(0.0, 0.0, "nearest", "clamp") == 0
    assert grey(0.99, 0.99, "nearest", "clamp") == 7
    assert grey(0.25, 0.5, "nearest", "clamp") == 5


def test_bilinear_between_four_centres():
    samples = sample_texture(GREY, np.array([[0.5, 0.5], [0.4375, 0.375]]))
    assert samples.texels[0].tolist() == [[1, 0], [2, 0], [1, 1], [2, 1]]
    assert samples.position.tolist() == [[2.0, 1.0], [1.75, 0.75]]
    assert samples.weights.tolist() == [[0.5, 0.5], [0.25, 0.25]]
    assert samples.texel_colors[0, :, 0].tolist() == [1, 2, 5, 6]
    assert samples.color[:, 0].tolist() == [3.5, 2.25]


def test_border_by_wrap():
    assert grey(0.0, 0.25, "bilinear", "repeat") == 1.5
    assert grey(0.0, 0.25, "bilinear", "clamp") == 0.0
    assert grey(0.0, 0.25, "bilinear", "mirror") == 0.0
    assert grey(1.0, 0.25, "nearest", "repeat") == 0.0
    assert grey(1.0, 0.25, "nearest", "clamp") == 3.0
    assert grey(1.25, 0.25, "nearest", "mirror") == 2.0  # the tie goes to the right, mirrored
    assert grey(-7.0, 0.25, "nearest", "clamp") == 0.0


@pytest.mark.parametrize("channels", [1, 3, 4])
@pytest.mark.parametrize("texture_filter", FILTERS)
def test_channels_become_four(channels, texture_filter):
    texture = random_texture(3, 2, channels)
    samples = sample_texture(texture, np.array([[0.5 / 3, 0.25]]), texture_filter)
    pixel = texture.pixels[0, 0].astype(np.float64).tolist()
    expected = {1: pixel * 3 + [1.0], 3: [*pixel, 1.0], 4: pixel}[channels]
    assert samples.color.tolist() == [expected]
    assert samples.texel_colors[0, 0].tolist() == expected


@pytest.mark.parametrize("wrap", WRAPS)
def test_bilinear_at_texel_centres_is_nearest(wrap):
    texture = random_texture(8, 4, 4)
    u, v = np.meshgrid((np.arange(-16, 24) + 0.5) / 8, (np.arange(-8, 12) + 0.5) / 4)
    uv = np.stack((u.ravel(), v.ravel()), axis=1)
    assert np.array_equal(
        texture_colors(texture, uv, "bilinear", wrap), texture_colors(texture, uv, "nearest", wrap)
    )


@given(u=coordinates, v=coordinates, wrap=st.sampled_from(WRAPS), texture_filter=st.sampled_from(FILTERS))
def test_colour_is_the_weighted_mean_of_its_texels(u, v, wrap, texture_filter):
    samples = sample_texture(random_texture(5, 3, 3), np.array([[u, v]]), texture_filter, wrap)
    assert (samples.weights >= 0).all()
    assert (samples.weights < 1).all()
    assert samples.shares.sum() == pytest.approx(1, abs=1e-15)
    assert (samples.shares >= 0).all()
    mean = (samples.shares[0, :, None] * samples.texel_colors[0]).sum(axis=0)
    assert samples.color[0] == pytest.approx(mean, abs=1e-15)


@given(
    uv=st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=20),
    wrap=st.sampled_from(WRAPS),
    channels=st.sampled_from([1, 3, 4]),
)
def test_listings_give_the_same_bits(uv, wrap, channels):
    texture = random_texture(7, 3, channels)
    pixels = texture.pixels.astype(np.float64).tolist()
    for name, scalar in (("nearest", nearest_color), ("bilinear", bilinear_color)):
        color = sample_texture(texture, np.array(uv), name, wrap).color
        assert color[:, :channels].tolist() == [list(scalar(pixels, u, v, wrap)) for u, v in uv]


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("texture_filter", FILTERS)
def test_picture_and_record_give_the_same_bits(texture_filter, wrap):
    uv = np.random.default_rng(3).uniform(-2, 3, (40000, 2))
    texture = random_texture(13, 7, 3)
    color = texture_colors(texture, uv, texture_filter, wrap)
    assert np.array_equal(color, sample_texture(texture, uv, texture_filter, wrap).color)
    assert np.array_equal(color[777:778], texture_colors(texture, uv[777:778], texture_filter, wrap))


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("texture_filter", FILTERS)
def test_undefined_and_huge_coordinates(texture_filter, wrap):
    uv = np.array([[np.nan, 0.3], [np.inf, -np.inf], [1e308, -1e308], [0.0, 0.3]])
    samples = sample_texture(GREY, uv, texture_filter, wrap)
    assert np.isfinite(samples.color).all()
    assert samples.undefined.tolist() == [[True, False], [False, False], [False, False], [False, False]]
    assert np.array_equal(samples.color[0], samples.color[3])
    assert np.isnan(uv[0, 0])
    edge = {"repeat": 0, "clamp": 3, "mirror": 0}[wrap]
    assert sample_texture(GREY, np.array([[1e308, 0.25]]), "nearest", wrap).texels[0, 0, 0] == edge


def test_no_fragments_and_one_texel():
    assert texture_colors(GREY, np.empty((0, 2))).shape == (0, 4)
    assert sample_texture(GREY, np.empty((0, 2))).texels.shape == (0, 4, 2)
    single = Texture(np.full((1, 1, 1), 0.25, np.float32))
    for wrap in WRAPS:
        assert texture_colors(single, np.array([[0.9, -3.2]]), "bilinear", wrap).tolist() == [
            [0.25, 0.25, 0.25, 1]
        ]


def test_bad_input():
    with pytest.raises(ValueError, match=r"uv must be \(F, 2\), got \(2,\)"):
        texture_colors(GREY, np.zeros(2))
    with pytest.raises(ValueError, match="texture_filter must be one of bilinear, nearest"):
        texture_colors(GREY, np.zeros((1, 2)), "cubic")
    with pytest.raises(ValueError, match="wrap must be one of repeat, clamp, mirror"):
        texture_colors(GREY, np.zeros((1, 2)), "nearest", "border")


@pytest.mark.skipif(not ORACLE.is_dir(), reason="the recorded OpenGL cases are not here")
@pytest.mark.parametrize(("number", "tolerance"), [(0, 0), (1, 5e-4), (4, 0)])
def test_recorded_opengl(number, tolerance):
    case = np.load(ORACLE / f"tex_{number:02d}.npz")
    meta = json.loads(str(case["meta"]))
    drawn = case["prim"] >= 0
    texture_filter = {"nearest": "nearest", "linear": "bilinear"}[meta["filter"]]
    uv = case["uv"][drawn].astype(np.float64)
    color = texture_colors(Texture(case["texture"]), uv, texture_filter, meta["wrap"])
    difference = np.abs(color.astype(np.float32) - case["color"][drawn]).max(axis=1)
    assert np.count_nonzero(difference > tolerance) == 0
    assert drawn.sum() > 4000
