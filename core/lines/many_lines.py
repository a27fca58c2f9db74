"""Many lines at once: the pixels of ``bresenham`` as words, without a record of how they were chosen.

Along both axes pixel i of ``bresenham`` lies ``floor((4 d i + 2 du + sign(d)) / (4 du))`` pixels from the first, where
du is the length of the line and d how far it goes along that axis: a tie steps, whichever way the line runs. On the
major axis, where d is plus or minus du, that is plus or minus i.

A word holds row and column as fixed-point numbers side by side, ``row.fraction | column.fraction``. The fixed-point
step to the next pixel is the same all along a line, so a line is a first word and a step, and the words of a whole
block of lines are one running sum.

Why the rounded step never leads to a wrong pixel: the numerator above is odd where the fraction matters, so the exact
coordinate stays 1 / (4 du) away from whole numbers. With g bits of fraction the first word and every step are
rounded by half a unit of 2^-g at most, together n / 2 units over n pixels. That leads to no other pixel as long as
2 n du < 2^g. A raster of 2^14 rows and columns leaves 36 bits for the fraction of one axis, enough for the n = 2^14
pixels that it can show of a line of du < 2^21; the longest line that is accepted, du = 2^21, has steps that need no
rounding.

References
----------
J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4(1), 1965.
E. Angel, D. Morrison, *Speeding up Bresenham's algorithm*, 1991 (lines by fixed-point addition).

Lines stand in drawing order and are written out block by block, so that everything stays in the cache; a pixel that
several lines cover keeps the colour of the last.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.lines.line_method import COORDINATE_LIMIT
from core.records.arrays import Flags, Integers, checked, checked_size
from core.scene import SIZE_LIMIT

# Lines as words: the row and the column of a line's pixels in one 64-bit number, moved on by one addition.


Words = NDArray[np.uint64]
Bounds = tuple[int, int, int, int]
"""First column, first row, end column, end row of the part of the raster that is drawn."""

FRACTION_BITS = 36
"""Bits of fraction that are enough for every line that is accepted."""
PRODUCT_BITS = 32
"""Least distance between the fields of a word that `WordLayout.places` can multiply."""
NEVER = 1 << 22
"""Step that no line has."""


@dataclass(frozen=True, eq=False)
class WordLayout:
    """Where the fields of a word begin, counted in bits from below."""

    column_bits: int
    row_shift: int
    """Lowest bit of the row's whole part."""
    column_shift: int | None
    """Lowest bit of the column's whole part, if it is the same in all lines: both axes have a fraction. ``None``: only
    the minor axis has one, so columns begin at bit 0 in flat lines, above the fraction in steep ones."""

    def fraction_bits(self, is_minor: Flags) -> Integers:
        """Return the bits of fraction of columns and rows, (2, L) int64; ``is_minor`` (2, L) says which need one."""
        if self.column_shift is None:
            return is_minor * FRACTION_BITS
        bits = np.empty(is_minor.shape, np.int64)
        bits[0], bits[1] = self.column_shift, self.row_shift - self.column_bits - self.column_shift
        return bits

    def split(self, words: Words, column_shift: Words | int, row: Words) -> Words:
        """Write the rows of words (P,) to ``row`` (P,) and return the columns (P,), in the memory of the words.

        ``column_shift`` is one number or (P,).
        """
        np.right_shift(words, np.uint64(self.row_shift), out=row)
        np.right_shift(words, column_shift, out=words)
        np.bitwise_and(words, np.uint64((1 << self.column_bits) - 1), out=words)
        return words

    def places(self, words: Words, column_shift: Words | int, stride: int) -> Words:
        """Return ``row * stride + column`` (P,) of words (P,), which are used up; ``column_shift`` is one or (P,).

        Notes
        -----
        Where the column begins at the same bit everywhere, one product does both: of ``row << a | column`` with
        ``stride + (1 << a)``. Its bits from a up are the place; the part ``row << 2 a`` leaves the word, and
        ``column * stride`` stays below.
        """
        if self.column_shift is None:
            row = np.empty_like(words)
            column = self.split(words, column_shift, row)
            row *= np.uint64(stride)
            row += column
            return row
        distance = self.row_shift - self.column_shift
        fields = ((1 << 64 - self.row_shift) - 1) << distance | (1 << self.column_bits) - 1
        np.right_shift(words, np.uint64(self.column_shift), out=words)
        np.bitwise_and(words, np.uint64(fields), out=words)
        np.multiply(words, np.uint64(stride + (1 << distance)), out=words)
        np.right_shift(words, np.uint64(distance), out=words)
        return words


@dataclass(frozen=True, eq=False)
class LineWords:
    """L lines that have visible pixels, in drawing order."""

    line: Integers
    """(L,) int64, which of the segments."""
    count: Integers
    """(L,) int64, visible pixels."""
    start: Integers
    """(L,) int64, word of the first visible pixel."""
    step: Integers
    """(L,) int64, what the word grows by from pixel to pixel."""
    column_shift: Words
    """(L,) uint64, lowest bit of the column's whole part."""
    layout: WordLayout

    def blocks(self, pixel_count: int) -> Iterator[tuple[slice, Words]]:
        """Yield blocks of about ``pixel_count`` pixels: which lines, and the words (P,) of their pixels in order."""
        end = np.cumsum(self.count)
        place = end - self.count
        jump = self.start.copy()
        jump[1:] -= (self.start + (self.count - 1) * self.step)[:-1]
        first = 0
        for last in (np.flatnonzero(np.diff(end // pixel_count, append=-1)) + 1).tolist():
            words = self.step[first:last].repeat(self.count[first:last])
            words[place[first:last] - place[first]] = jump[first:last]
            words[0] = self.start[first]
            np.add.accumulate(words, out=words)
            yield slice(first, last), words.view(np.uint64)
            first = last

    def shift_of(self, lines: slice) -> Words | int:
        """Return where columns begin in the words of a block: one number, or (P,)."""
        if self.layout.column_shift is not None:
            return self.layout.column_shift
        return self.column_shift[lines].repeat(self.count[lines])


def set_up_line_words(segments: Integers, bounds: Bounds, stride: int, last_pixel: bool) -> LineWords:
    """Turn segments into first words and steps.

    Parameters
    ----------
    segments : (N, 4) int64
        Columns and rows of the end pixels, x0, y0, x1, y1, within `COORDINATE_LIMIT` of the origin.
    bounds : Bounds
        What lies outside is left out; columns and rows of the words count from its corner.
    stride : int
        What will be given to `WordLayout.places`.
    last_pixel : bool
        Whether the pixel of the second end is drawn too.
    """
    ends = np.ascontiguousarray(segments.T).reshape(2, 2, -1)
    first, count = visible_steps(ends, bounds, last_pixel)
    line = np.flatnonzero(count)
    if len(line) < len(segments):
        ends, first, count = ends.take(line, axis=2), first.take(line), count.take(line)
    start, d = ends[0] - np.array(bounds[:2])[:, None], ends[1] - ends[0]
    size = np.abs(d)
    du = np.maximum(size.max(axis=0), 1)
    is_minor = np.empty(size.shape, np.bool_)
    np.greater(size[1], size[0], out=is_minor[0])
    np.logical_not(is_minor[0], out=is_minor[1])
    layout = choose_layout(count * du, is_minor, bounds, stride)
    bits = layout.fraction_bits(is_minor)

    numerator = 4 * d * first + is_minor * (2 * du + np.sign(d))
    whole = numerator // (4 * du)
    rest = numerator - 4 * du * whole
    coordinate = (start + whole << bits) + _rounded_share(rest, 4 * du, bits)
    step = _rounded_share(d, du, bits)
    row_place = layout.row_shift - bits[1]
    return LineWords(
        line,
        count,
        (coordinate[1] << row_place) + coordinate[0],
        (step[1] << row_place) + step[0],
        bits[0].astype(np.uint64),
        layout,
    )


def _rounded_share(part: Integers, whole: Integers, bits: Integers) -> Integers:
    """Return ``part / whole`` in units of ``2 ** -bits``, rounded to the nearest; any shape, int64."""
    return ((part << bits + 1) + whole) // (2 * whole)


def choose_layout(precision: Integers, is_minor: Flags, bounds: Bounds, stride: int) -> WordLayout:
    """Choose the fields of words: a fraction for each axis if that leaves both enough bits, else for one.

    Parameters
    ----------
    precision : (L,) int64
        Visible pixels times length of each line.
    is_minor : (2, L) bool
        Whether the columns, the rows have a fraction.
    """
    left, bottom, right, top = bounds
    column_bits, row_bits = (right - left - 1).bit_length(), (top - bottom - 1).bit_length()
    needed = (precision * is_minor).max(axis=1, initial=0)
    for_columns, for_rows = ((2 * int(most)).bit_length() for most in needed)
    for_rows = max(for_rows, PRODUCT_BITS - column_bits, stride.bit_length())
    if row_bits + for_rows + column_bits + max(for_columns, stride.bit_length()) <= 64:
        return WordLayout(column_bits, for_rows + column_bits + for_columns, for_columns)
    return WordLayout(column_bits, column_bits + FRACTION_BITS, None)


def visible_steps(ends: Integers, bounds: Bounds, last_pixel: bool) -> tuple[Integers, Integers]:
    """Return the first step whose pixel is within bounds, and how many are, (N,) int64 each.

    Parameters
    ----------
    ends : (2, 2, N) int64
        First and second end, column and row.

    Notes
    -----
    Along both axes pixels only move one way, so those within form one stretch; its ends are found in integers.
    """
    low, high = np.array(bounds).reshape(2, 2, 1)
    length = np.abs(ends[1] - ends[0]).max(axis=0)
    first, last = np.zeros_like(length), length + last_pixel
    cut = np.flatnonzero(((ends < low) | (ends >= high)).any(axis=(0, 1)))
    if len(cut):
        start, end = ends.take(cut, axis=2)
        d = end - start
        du = np.maximum(length.take(cut), 1)
        is_forward = d >= 0
        entry = np.where(is_forward, low - start, start - high + 1)
        exit = np.where(is_forward, high - start, start - low + 1)
        enters = _first_step_at(entry, np.abs(d), du).max(axis=0, initial=0)
        leaves = np.minimum(_first_step_at(exit, np.abs(d), du).min(axis=0), last.take(cut))
        first[cut], last[cut] = enters, np.maximum(enters, leaves)
    return first, last - first


def _first_step_at(climbed: Integers, d: Integers, du: Integers) -> Integers:
    """Return the first step at which ``floor((2 d i + du) / (2 du))`` is at least ``climbed``, (2, N) int64."""
    step = -((1 - 2 * climbed) * du // np.maximum(2 * d, 1))
    return np.where(d > 0, step, np.where(climbed > 0, NEVER, 0))


# Many lines at once: the pixels of ``bresenham`` without a record of how they were chosen.


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
