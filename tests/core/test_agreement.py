"""Picture, trace, pixel history and fast path agree under random settings of all families, and in what was found so."""

import numpy as np
import pytest

from core import ClipScene, Settings, Texture
from tests.core.agreement import Case, check_case, random_case
from tests.core.strategies import clip_of_window
from tests.covering import every_nth


def scene(clip, size: tuple[int, int], values=None, texture: Texture | None = None) -> ClipScene:
    """Return a scene of triangles, grey and half transparent by default."""
    values = np.ones((len(clip), 3, 4)) * [0.2, 0.3, 0.4, 0.5] if values is None else values
    return ClipScene(clip, values, size, texture, np.array([0.1, 0.2, 0.3, 0.25]))


def mipmapped() -> ClipScene:
    """Return a texture whose step from pixel to pixel grows to the right."""
    texture = Texture(np.random.default_rng(7).random((4, 4, 3)).astype(np.float32))
    clip = [[[-1, -1, 0, 1], [5, -1, 0, 4], [-1, 5, 0, 3]]]
    return scene(clip, (4, 3), np.array([[[0, 0], [1.5, 0], [0, 1.5]]]), texture)


FOUND = {
    # The trace took the texture's steps at the sample, the picture at the pixel's centre.
    "mipmaps-of-multisampled-pixels": (
        mipmapped(),
        Settings(antialiasing="msaa-4", texture_filter="trilinear"),
    ),
    # Bytes of samples ended at 1 before they were averaged: of alpha, too.
    "alpha-that-adds-up-over-samples": (
        scene(clip_of_window([[[0, 0], [4.3, 0], [0, 3.2]]] * 3, (4, 3)), (4, 3)),
        Settings(antialiasing="ssaa-4", blend="additive", visibility="last-drawn"),
    ),
    # They ended at 0, too, which light that was given need not.
    "light-below-0-over-samples": (
        scene(
            clip_of_window([[[0, 0], [4.3, 0], [0, 3.2]]], (4, 3)),
            (4, 3),
            np.ones((1, 3, 4)) * [-0.5, 0.2, 0.3, 1],
        ),
        Settings(antialiasing="ssaa-4"),
    ),
    # The picture limited the depth on the plane, the trace did not.
    "printed-scanlines-outside-their-triangle": (
        scene(clip_of_window([[[5.5, 3.5], [4.5, 5.75], [5, 4.5]]], (6, 6), 1.0, [0.6, 0.6, -0.5]), (6, 6)),
        Settings(fill="scanline-lecture", depth="fixed-38", visibility="last-drawn"),
    ),
    # The history asked only triangles whose box contains the pixel.
    "brute-force-in-numbers-that-wrap-around": (
        scene(
            clip_of_window([[[-4000, 3], [5, -3000], [6, 5000]], [[1, 1], [9, 1], [3, 5]]], (9, 6)), (9, 6)
        ),
        Settings(fill="brute-force", coverage="fixed-24.8", visibility="last-drawn"),
    ),
    # Edge functions that overflow: a warning.
    "areas-in-numbers-that-overflow": (
        scene(clip_of_window([[[-6e4, 3], [5, -6e4], [6, 6e4]]], (9, 6)), (9, 6)),
        Settings(antialiasing="area", coverage="float16"),
    ),
}
"""Name to a scene and settings under which they did not agree once."""


@pytest.mark.parametrize("name", FOUND)
def test_what_was_found(name):
    found, settings = FOUND[name]
    pixels = [(column, row) for row in range(found.size[1]) for column in range(found.size[0])]
    check_case(Case(found, settings, pixels))


def test_random_settings():
    for seed in every_nth(range(25), 3):
        check_case(random_case(seed))


@pytest.mark.slow
def test_random_settings_at_length():
    for seed in range(100, 3100):
        check_case(random_case(seed))
