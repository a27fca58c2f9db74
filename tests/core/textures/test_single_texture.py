"""Textures in single precision: as close as stated, of bearable size, and gone when their texture is."""

import gc
from weakref import ref

import numpy as np
import pytest

from core.scene import Texture
from core.textures import single_precision
from core.textures.look_up import texture_colors
from core.textures.packed import PLACES
from core.textures.single_precision import ROUNDING, SingleSampler, is_plain


def noise(rows: int, columns: int, channels: int) -> Texture:
    pixels = np.random.default_rng(rows).random((rows, columns, channels))
    pixels[..., 3:] = 1
    return Texture(pixels.astype(np.float32))


@pytest.mark.parametrize("wrap", list(PLACES))
@pytest.mark.parametrize("shape", [(1, 1, 3), (2, 8, 1), (7, 5, 3), (16, 16, 4), (64, 3, 1)])
def test_no_mean_is_farther_off_than_stated(wrap: str, shape: tuple[int, int, int]) -> None:
    texture = noise(*shape)
    rows, columns, _ = shape
    near = np.random.default_rng(5).uniform(-3, 4, (20_000, 2))
    on_texels = np.round(near[:2000] * 2 * [columns, rows]) / [2 * columns, 2 * rows]
    uv = np.concatenate([near, on_texels, 1e4 * near[:500]])
    sampler = SingleSampler(texture, wrap)
    colors = np.empty((sampler.channels, len(uv)), np.float32)
    sampler.write_colors(uv[:, 0] * columns, uv[:, 1] * rows, colors)
    exact = texture_colors(texture, uv, "bilinear", wrap)[:, : sampler.channels]
    assert np.abs(colors.T - exact).max() <= ROUNDING


def test_a_texture_whose_table_would_be_too_large_is_not_plain(monkeypatch: pytest.MonkeyPatch) -> None:
    texture = noise(6, 8, 3)
    assert is_plain(texture, "mirror")
    monkeypatch.setattr(single_precision, "MOST_TEXELS", 100)
    assert is_plain(texture, "repeat")
    assert not is_plain(texture, "mirror")


def test_nothing_of_a_texture_stays_when_it_goes() -> None:
    texture = noise(4, 4, 3)
    assert is_plain(texture, "repeat")
    SingleSampler(texture, "repeat")
    kept = ref(texture)
    del texture
    gc.collect()
    assert kept() is None
