"""Scenes whose triangles have their number for a colour, so that a picture tells which of them it shows."""

import numpy as np

from core import ClipScene, Frame, Settings, draw_picture, render


def numbered(clip, size: tuple[int, int]) -> ClipScene:
    """Return a scene whose triangle k is of one colour: k + 1 in the bytes of red, green and blue."""
    clip = np.asarray(clip, float)
    code = np.arange(1, len(clip) + 1)
    color = np.stack([code & 255, code >> 8 & 255, code >> 16, np.full(len(clip), 255)], axis=1) / 255
    return ClipScene(clip, np.repeat(color[:, None], 3, axis=1), size)


def numbers(pixels: np.ndarray) -> np.ndarray:
    """Return the triangles (H, W) that linear bytes (H, W, 4) show, -1 where there is none."""
    red, green, blue, _ = np.moveaxis(pixels.astype(int), 2, 0)
    return red + (green << 8) + (blue << 16) - 1


def assert_same(
    clip, size: tuple[int, int], settings: Settings, region: tuple[int, int, int, int] | None = None
) -> Frame:
    """Compare a picture by spans, and its depth buffer, with all buffers of `render`; return these."""
    scene = numbered(clip, size)
    frame = render(scene, settings)
    by_spans = Settings(**{**vars(settings), "fill": "spans"})
    column, row, columns, rows = region or (0, 0, *size)
    part = slice(row, row + rows), slice(column, column + columns)
    picture = draw_picture(scene, by_spans, encoding="linear", region=region)
    with_depth = draw_picture(scene, by_spans, encoding="linear", region=region, with_depth=True)
    assert np.array_equal(numbers(picture.pixels), frame.primitive[part]), picture.route
    assert np.array_equal(numbers(with_depth.pixels), frame.primitive[part]), with_depth.route
    assert np.array_equal(with_depth.depth, frame.depth[part])
    assert with_depth.depth.dtype == frame.depth.dtype
    return frame
