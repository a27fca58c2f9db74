"""Many lines at once: the pixels of ``bresenham`` without a record of how they were chosen.

Lines stand in drawing order and are written out block by block, so that everything stays in the cache; a pixel that
several lines cover keeps the colour of the last.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.raster.lines.records import COORDINATE_LIMIT
from core.raster.spans.line_words import Bounds, set_up_line_words
from core.records.arrays import Integers, checked, checked_size
from core.scene import SIZE_LIMIT

LINES = 8192
"""Lines that are set up in one go."""
PIXELS = 3 << 14
"""Pixels that are found in one go, about."""


def paint_lines(
    pixels: NDArray[np.uint32],
    segments: ArrayLike,
    colors: ArrayLike,
    width: int | None = None,
    last_pixel: bool = False,
) -> int:
    """Paint lines over a picture, later ones over earlier ones: the pixels of the method ``bresenham``.

    Parameters
    ----------
    pixels : (H, S) uint32
        The picture, rows one after the other in memory, row 0 at the bottom. It is written to.
    segments : (N, 4) array_like of int
        Pixels of the ends: x0, y0, x1, y1. They may lie outside; only what is outside is left out.
    colors : (N,) array_like of int
        What each line writes, any packed colour of 32 bits.
    width : int, optional
        Columns of the picture, S by default. Those beyond, which only fill up the rows, are left alone.
    last_pixel : bool
        Whether the pixel of the second end is painted too.

    Returns
    -------
    int
        Pixels that were written, each as often as lines cover it.

    Raises
    ------
    ValueError
        For a shape, type or size that is not allowed, or an end farther than `COORDINATE_LIMIT` pixels from the
        origin.

    Notes
    -----
    Rows of 4096 bytes or a multiple compete for the same few places of a cache: a steep line is then painted at
    half the speed. Rows filled up by 16 pixels do not.

    Examples
    --------
    >>> pixels = np.zeros((3, 6), np.uint32)
    >>> paint_lines(pixels, [[0, 0, 5, 2], [2, 2, 2, 0]], [1, 2], last_pixel=True)
    9
    >>> print(pixels[::-1])
    [[0 0 2 0 1 1]
     [0 0 2 1 0 0]
     [1 1 2 0 0 0]]
    """
    if pixels.ndim != 2 or pixels.dtype != np.uint32 or not pixels.flags.c_contiguous:
        raise ValueError(f"pixels must be (H, S) uint32, row after row, got {pixels.shape} {pixels.dtype}")
    height, stride = pixels.shape
    width, height = checked_size("picture", (stride if width is None else width, height), SIZE_LIMIT)
    if width > stride:
        raise ValueError(f"width must be at most {stride}, the length of a row, got {width}")
    ends = checked("segments", segments, ("N", 4), np.int64, limit=COORDINATE_LIMIT)
    color = checked("colors", colors, (len(ends),), np.uint32)
    picture = pixels.reshape(-1)
    bounds = (0, 0, width, height)
    painted = 0
    for first in range(0, len(ends), LINES):
        words = set_up_line_words(ends[first : first + LINES], bounds, stride, last_pixel)
        ink = color[first : first + LINES].take(words.line)
        for lines, block in words.blocks(PIXELS):
            place = words.layout.places(block, words.shift_of(lines), stride)
            picture[place.view(np.int64)] = ink[lines].repeat(words.count[lines])
            painted += len(place)
    return painted


def find_line_pixels(
    segments: Integers, bounds: Bounds, last_pixel: bool
) -> tuple[Integers, Integers, Integers]:
    """Return column, row and line (P,) int64 of all pixels of lines, in drawing order.

    Parameters
    ----------
    segments : (N, 4) int64
        Pixels of the ends, as in `paint_lines`.
    bounds : Bounds
        Pixels outside are left out; columns and rows count from its corner.
    """
    batches = [
        set_up_line_words(segments[first : first + LINES], bounds, 1, last_pixel)
        for first in range(0, len(segments), LINES)
    ]
    count = sum(int(words.count.sum()) for words in batches)
    column, row, owner = (np.empty(count, np.int64) for _ in range(3))
    first = 0
    for number, words in enumerate(batches):
        line = words.line + number * LINES
        for lines, block in words.blocks(PIXELS):
            end = first + len(block)
            columns = words.layout.split(block, words.shift_of(lines), row[first:end].view(np.uint64))
            column[first:end] = columns
            owner[first:end] = line[lines].repeat(words.count[lines])
            first = end
    return column, row, owner
