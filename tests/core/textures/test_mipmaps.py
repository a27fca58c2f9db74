"""Mipmaps: means by exact area, whatever the size; made once and gone with their texture."""

import gc
import weakref
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from core import Texture
from core.textures.mipmaps import halve, mipmap_levels

SIZES = [(1, 1), (8, 8), (5, 3), (7, 1), (1, 6), (13, 10), (3, 17)]


def random_texture(width: int, height: int, channels: int = 3) -> Texture:
    return Texture(np.random.default_rng(width * height).random((height, width, channels)).astype(np.float32))


def means_by_area(row: list[Fraction]) -> list[Fraction]:
    """Halve a row by the definition: the part of every texel that lies in each stretch of n / m."""
    count = len(row) // 2
    if count == 0:
        return row
    length = Fraction(len(row), count)
    means = []
    for i in range(count):
        start, end = i * length, (i + 1) * length
        parts = [(min(end, k + 1) - max(start, k), value) for k, value in enumerate(row)]
        means.append(sum(part * value for part, value in parts if part > 0) / length)
    return means


@pytest.mark.parametrize("count", range(1, 20))
def test_halves_are_means_by_area(count: int) -> None:
    row = [Fraction(k * k % 11, 8) for k in range(count)]
    found = halve(np.array([float(value) for value in row]))
    assert found.shape == (max(count // 2, 1),)
    assert np.allclose(found, [float(value) for value in means_by_area(row)], rtol=1e-15, atol=0)


@pytest.mark.parametrize("size", SIZES)
def test_sizes_are_halved_and_rounded_down_to_a_single_texel(size: tuple[int, int]) -> None:
    levels = mipmap_levels(random_texture(*size))
    sizes = [level.pixels.shape[1::-1] for level in levels]
    assert sizes[0] == size
    assert sizes[-1] == (1, 1)
    assert len(levels) == max(size).bit_length()
    for (width, height), smaller in pairwise(sizes):
        assert smaller == (max(width // 2, 1), max(height // 2, 1))


@pytest.mark.parametrize("channels", [1, 3, 4])
@pytest.mark.parametrize("size", SIZES)
def test_every_level_has_the_mean_of_the_texture(size: tuple[int, int], channels: int) -> None:
    levels = mipmap_levels(random_texture(*size, channels))
    mean = levels[0].pixels.astype(np.float64).mean(axis=(0, 1))
    for level in levels:
        assert np.allclose(level.pixels.astype(np.float64).mean(axis=(0, 1)), mean, rtol=2e-7)


def test_two_by_two_texels_become_one() -> None:
    pixels = np.array([[0, 1, 8, 8], [1, 2, 8, 8]], np.float32)[..., None]
    assert [level.pixels[..., 0].tolist() for level in mipmap_levels(Texture(pixels))[1:]] == [
        [[1, 8]],
        [[4.5]],
    ]


def test_levels_are_made_once_and_go_with_the_texture() -> None:
    texture = random_texture(8, 8)
    first, again = mipmap_levels(texture), mipmap_levels(texture)
    assert all(one is other for one, other in zip(first, again, strict=True))
    assert first[0] is texture
    smaller = weakref.ref(first[1])
    del first, again, texture
    gc.collect()
    assert smaller() is None
