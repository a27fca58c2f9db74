"""Pictures of transparent and of textured triangles are those of the buffers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, Texture, draw_picture
from core.fast_path.blended import strip_height
from core.methods import table
from tests.core.fast_path.references import exact_bytes, shows_thin_triangle
from tests.core.spans.adversarial import mixed, projected
from tests.core.strategies import clip_of_window

SEEDS = st.integers(0, 2**32 - 1)
SIZE = (61, 47)
BLENDS = [name for name in table.names("blend") if name != "opaque"]


def by_spans(chosen: Settings) -> Settings:
    return Settings(**{**vars(chosen), "fill": "spans"})


@given(
    SEEDS,
    st.sampled_from([0, 1, 3, 60]),
    st.booleans(),
    st.booleans(),
    st.sampled_from(BLENDS),
    st.sampled_from(table.names("visibility")),
    st.sampled_from(table.names("depth")),
)
def test_transparent_triangles(
    seed: int, count: int, is_mixed: bool, is_flat: bool, blend: str, visibility: str, depth: str
) -> None:
    generator = np.random.default_rng(seed)
    clip = clip_of_window(projected(generator, count, SIZE), SIZE, 1.0, generator.uniform(-1, 1, (count, 3)))
    if is_mixed:
        clip = mixed(generator, count, SIZE)
    color = generator.random((count, 3, 4))
    if is_flat:
        color[:] = color[:, :1]
    scene = ClipScene(clip, color, SIZE, background=np.array([0.3, 0.2, 0.1, 1.0]))
    chosen = Settings(blend=blend, visibility=visibility, depth=depth)
    expected = exact_bytes(scene, chosen, "srgb")
    assert np.array_equal(draw_picture(scene, by_spans(chosen)).pixels, expected)
    part = draw_picture(scene, by_spans(chosen), region=(13, 7, 21, 30)).pixels
    assert np.array_equal(part, expected[7:37, 13:34])


def test_triangles_beyond_the_picture_ask_for_no_narrower_strips() -> None:
    shape = (480, 640)
    assert strip_height(np.full(3, 1e9), shape) == strip_height(np.full(3, 480 * 640), shape) == 68
    assert strip_height(np.full(9000, 10.0), shape) > 480
    assert strip_height(np.full(9000, 1e9), shape) == 1
    assert strip_height(np.zeros(0), shape) > 480


@pytest.mark.parametrize("region", [(0, 0, 0, 0), (61, 47, 3, 3), (5, 5, 0, 4), (5, 5, 4, 0)])
@pytest.mark.parametrize("blend", table.names("blend"))
def test_regions_without_pixels(region: tuple[int, int, int, int], blend: str) -> None:
    scene = ClipScene(mixed(np.random.default_rng(1), 9, SIZE), size=SIZE)
    picture = draw_picture(scene, Settings(fill="spans", blend=blend), region=region)
    assert picture.pixels.size == 0


@given(
    SEEDS,
    st.sampled_from([1, 2, 12]),
    st.booleans(),
    st.sampled_from(["bilinear", "nearest"]),
    st.sampled_from(table.names("wrap")),
    st.sampled_from(["srgb", "linear"]),
)
def test_textured_triangles(
    seed: int, count: int, is_mixed: bool, texture_filter: str, wrap: str, encoding: str
) -> None:
    generator = np.random.default_rng(seed)
    corners = generator.uniform(-20, np.array(SIZE) + 20, (count, 3, 2))
    w = generator.uniform(1, 2, (count, 3))
    clip = clip_of_window(corners, SIZE, w, generator.uniform(-0.9, 0.9, (count, 3)))
    if is_mixed:
        clip = mixed(generator, count, SIZE)
    texture = Texture(generator.random((8, 8, 3)).astype(np.float32))
    scene = ClipScene(clip, generator.uniform(-1, 2, (count, 3, 2)), SIZE, texture)
    chosen = Settings(texture_filter=texture_filter, wrap=wrap)
    picture = draw_picture(scene, by_spans(chosen), encoding=encoding)
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    if picture.route.color == "texture":
        away[shows_thin_triangle(scene, chosen)] = 0
        if texture_filter == "nearest":
            # Another texel where the sample lies on its border, to single precision.
            assert (away > 1).mean() <= 0.001
        else:
            # Neighbouring texels differ by up to 1: see `packed_texture`, and single-precision coordinates.
            assert away.max() <= 3
    else:
        assert away.max() == 0


@pytest.mark.parametrize(
    ("repeats", "color"), [(3.0, "texture"), (1e3, "texture"), (1e5, "deferred"), (1e9, "deferred")]
)
@pytest.mark.parametrize("encoded_as_bytes", [False, True])
def test_coordinates_that_single_precision_cannot_tell_are_looked_up_in_double(
    repeats: float, color: str, encoded_as_bytes: bool
) -> None:
    pixels = np.random.default_rng(1).random((8, 8, 3))
    texture = Texture((np.round(255 * pixels) / 255 if encoded_as_bytes else pixels).astype(np.float32))
    clip = clip_of_window(np.array([[[-3.0, 5.0], [400.0, 20.0], [60.0, 330.0]]]), (320, 240))
    uv = repeats * np.array([[[0.1, 0.2], [1.0, 0.1], [0.3, 1.0]]])
    scene = ClipScene(clip, uv, (320, 240), texture)
    chosen = Settings(texture_filter="bilinear")
    picture = draw_picture(scene, chosen, encoding="linear")
    assert picture.route.color == color
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, "linear"))
    assert away.max() <= (2 if color == "texture" else 0)
