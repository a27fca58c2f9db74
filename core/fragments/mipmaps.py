"""Mipmaps: a texture at half, a quarter ... of its size, so that a pixel reads about one texel at any distance.

Level k + 1 has floor(size / 2) texels of level k each way, but at least one, as OpenGL has it. Its texels are means of
the exact area that each covers, in linear light: two texels each way where the size is even, and where it is odd,
2 m + 1 texels becoming m, three with the weights m - i, m and i + 1 over 2 m + 1 for texel i. So the mean of every
level is the mean of the texture. Alpha is straight, and colours are averaged as they are, like bilinear filtering does.

References
----------
L. Williams, *Pyramidal parametrics*, SIGGRAPH 1983.
S. Guthe, P. Heckbert, *Non-power-of-two mipmapping*, NVIDIA 2005 (the three weights).
M. Segal, K. Akeley, *The OpenGL Graphics System 4.6*, 2022, section 8.14.3.
"""

from weakref import WeakKeyDictionary

import numpy as np

from core.records.arrays import Floats
from core.scene import Texture

_smaller: WeakKeyDictionary[Texture, tuple[Texture, ...]] = WeakKeyDictionary()
"""The levels below each texture; they go when the texture goes."""


def mipmap_levels(texture: Texture) -> tuple[Texture, ...]:
    """Return the levels of a texture, level 0 first: the texture itself, down to a single texel.

    Notes
    -----
    They are made once for every texture and kept as long as it is. Each is made from the level above it in float64 and
    rounded to float32 once.

    Examples
    --------
    >>> board = Texture(np.array([[[0.0], [1.0], [1.0]], [[1.0], [0.0], [0.0]]]))
    >>> [level.pixels[..., 0].tolist() for level in mipmap_levels(board)]
    [[[0.0, 1.0, 1.0], [1.0, 0.0, 0.0]], [[0.5]]]
    """
    if texture not in _smaller:
        _smaller[texture] = tuple(_make_levels(texture))
    return (texture, *_smaller[texture])


def _make_levels(texture: Texture) -> list[Texture]:
    levels: list[Texture] = []
    pixels = texture.pixels.astype(np.float64)
    while max(pixels.shape[:2]) > 1:
        pixels = halve(halve(pixels).swapaxes(0, 1)).swapaxes(0, 1)
        levels.append(Texture(pixels.astype(np.float32), f"{texture.name}, level {len(levels) + 1}"))
    return levels


def halve(rows: Floats) -> Floats:
    """Return the means of rows (N, ...) float64 by area: (floor(N / 2), ...), or the single row as it is."""
    count = len(rows) // 2
    if not count:
        return rows
    first, second = rows[0 : 2 * count : 2], rows[1 : 2 * count : 2]
    if len(rows) % 2 == 0:
        return np.asarray((first + second) * 0.5)
    third = rows[2 : 2 * count + 1 : 2]
    number = np.arange(count, dtype=np.float64).reshape(-1, *[1] * (rows.ndim - 1))
    return np.asarray((first * (count - number) + second * count + third * (number + 1)) / len(rows))
