"""Textured triangles made smaller: fewer texels and fewer digits of their colours as well."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from core.records.arrays import Singles
from core.scene import Texture
from core.study.stability.minimization.kind import Kind
from core.study.stability.minimization.triangles import (
    VALUED_TRIANGLES,
    Triangles,
    in_words,
    put_together,
    take_apart,
)

MOST_TEXELS = 16
"""Texels of a texture that are looked at one by one."""


def with_smaller_texture(triangles: Triangles) -> Iterator[Triangles]:
    """Yield the same with one half of the texture, texels staying where they are or growing twice as wide."""
    assert triangles.texture is not None
    pixels = triangles.texture.pixels
    for axis in (0, 1):
        kept = pixels.shape[axis] // 2
        for first in (0, pixels.shape[axis] - kept):
            part = np.take(pixels, np.arange(first, first + kept), axis=axis)
            if kept:
                values = triangles.values.copy()
                # Rows of texels are v, the second coordinate.
                values[..., 1 - axis] *= pixels.shape[axis] / kept
                yield replace(_textured(triangles, part), values=values)
                yield _textured(triangles, part)


def with_simpler_texels(triangles: Triangles) -> Iterator[Triangles]:
    """Yield the same in one channel, in black and white, and with single texels black or white."""
    assert triangles.texture is not None
    pixels = triangles.texture.pixels
    if pixels.shape[2] > 1:
        for channel in range(pixels.shape[2]):
            yield _textured(triangles, pixels[..., channel : channel + 1])
    stark = (pixels > (pixels.min() + pixels.max()) / 2).astype(np.float32)
    if (stark != pixels).any():
        yield _textured(triangles, stark)
    if pixels.size <= MOST_TEXELS:
        for place in np.ndindex(pixels.shape):
            # Black before white, so that it comes to an end.
            for simpler in (0.0, 1.0):
                if pixels[place] != simpler and (simpler == 0.0 or pixels[place] != 0.0):
                    changed = pixels.copy()
                    changed[place] = simpler
                    yield _textured(triangles, changed)


def _textured(triangles: Triangles, pixels: Singles) -> Triangles:
    return replace(triangles, texture=Texture(pixels))


TEXTURED_TRIANGLES = Kind(
    take_apart,
    put_together,
    (*VALUED_TRIANGLES.ways[:2], with_smaller_texture, with_simpler_texels, *VALUED_TRIANGLES.ways[2:]),
    in_words,
)
"""Triangles with a texture."""
