"""Bands: a large triangle is drawn some rows at a time, as blocks of words.

Where a triangle has tens of thousands of pixels, one operation on a block of rows and columns beats passes over single
pixels: no index is needed, the buffer's block itself is compared. Columns between the ragged ends of the rows need
no mask; at the ends, pixels outside get a word that loses against everything.

Where the buffer is only written, the rows of a block may begin where the triangle does (`Strip`): then hardly a pixel
beside it is computed, and none needs a mask.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.arrays import Integers
from core.raster.schedule import Raster
from core.raster.spans.arena import Arena
from core.raster.spans.lanes import Lanes, TieOwners
from core.raster.spans.rows import bounds_of_rows

BIG_AREA = 1 << 15
"""Pixels; triangles of more are drawn in bands."""
BAND_PIXELS = 1 << 16
"""Pixels of a band: its numbers stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class Band:
    """Neighbouring rows of one triangle, and the columns between the least start and the greatest stop."""

    rows: slice
    """Rows in the buffer."""
    columns: slice
    """Columns in the buffer."""
    row: Integers
    """(R,) int64, numbers of the rows in the window."""
    column: Integers
    """(C,) int64, numbers of the columns in the window."""
    start: Integers
    """(R,) int64, first inside column of every row."""
    stop: Integers
    """(R,) int64, column after the last."""

    @property
    def width(self) -> int:
        """Columns of the block."""
        return len(self.column)

    def spread(self, ramp: NDArray[Any]) -> NDArray[Any]:
        """Return values of the columns, (C,), so that they meet every row of the block: (1, C)."""
        return ramp[None]

    def outside(self) -> Iterator[tuple[slice, np.ndarray]]:
        """Yield column ranges of the block and, as (R, c) bool, which of their pixels the triangle does not have."""
        left = self.column[0]
        width = len(self.column)
        inner = int(self.start.max() - left)
        outer = int(self.stop.min() - left)
        if inner < outer:
            if inner:
                yield slice(0, inner), self.column[:inner] < self.start[:, None]
            if outer < width:
                yield slice(outer, width), self.column[outer:] >= self.stop[:, None]
        else:
            yield (
                slice(0, width),
                (self.column < self.start[:, None]) | (self.column >= self.stop[:, None]),
            )


@dataclass(frozen=True, eq=False)
class Strip:
    """Neighbouring rows of one triangle, each from its first inside column on: a slanted block."""

    row: Integers
    """(R,) int64, numbers of the rows in the window."""
    column: Integers
    """(C,) int64, numbers of all columns of the block in the window."""
    start: Integers
    """(R,) int64, first inside column of every row, where the block's row begins."""
    stop: Integers
    """(R,) int64, column after the last."""
    width: int
    """Columns of the block."""

    def spread(self, ramp: NDArray[Any]) -> NDArray[Any]:
        """Return for values of the columns, (C,) and contiguous, those of every row of the block: (R, width)."""
        size = ramp.itemsize
        windows = np.ndarray((len(ramp) - self.width + 1, self.width), ramp.dtype, ramp, strides=(size, size))
        slanted: NDArray[Any] = windows[self.start - self.column[0]]
        return slanted


def spans_by_row(
    lanes: Lanes, raster: Raster, owners: TieOwners, arena: Arena
) -> tuple[int, Integers, Integers]:
    """Return the first row of one triangle, the only one of ``lanes``, and start and stop (R,) of its rows from there.

    A triangle is convex, but rows between pixel centres may be empty: they have no columns.
    """
    _, start, length = bounds_of_rows(lanes, raster, owners, (), arena)
    inside = np.flatnonzero(length > 0)
    if not len(inside):
        return 0, inside, inside
    used = slice(int(inside[0]), int(inside[-1]) + 1)
    begin = start[used].astype(np.int64)
    return int(lanes.first_row[0]) + used.start, begin, begin + np.maximum(length[used], 0)


def bands(lanes: Lanes, raster: Raster, owners: TieOwners, arena: Arena) -> Iterator[Band]:
    """Yield the bands of one triangle, the only one of ``lanes``, from the lowest up."""
    bottom, begin, end = spans_by_row(lanes, raster, owners, arena)
    if not len(begin):
        return
    first_column, first_row, _, _ = raster.bounds
    for part, row in _parts(bottom, len(begin), int(end.max() - begin.min())):
        left, right = int(begin[part].min()), int(end[part].max())
        yield Band(
            rows=slice(int(row[0]) - first_row, int(row[-1]) + 1 - first_row),
            columns=slice(left - first_column, right - first_column),
            row=row,
            column=np.arange(left, right),
            start=begin[part],
            stop=end[part],
        )


def strips(lanes: Lanes, raster: Raster, owners: TieOwners, arena: Arena) -> Iterator[Strip]:
    """Yield the strips of one triangle, the only one of ``lanes``, from the lowest up."""
    bottom, begin, end = spans_by_row(lanes, raster, owners, arena)
    if not len(begin):
        return
    for part, row in _parts(bottom, len(begin), int((end - begin).max())):
        start, stop = begin[part], end[part]
        width = int((stop - start).max())
        yield Strip(row, np.arange(int(start.min()), int(start.max()) + width), start, stop, width)


def _parts(bottom: int, count: int, width: int) -> Iterator[tuple[slice, Integers]]:
    """Yield which of ``count`` rows from ``bottom`` on are drawn together, and their numbers (R,)."""
    height = max(BAND_PIXELS // width, 1)
    for first in range(0, count, height):
        end = min(first + height, count)
        yield slice(first, end), np.arange(bottom + first, bottom + end)


FARTHEST = np.iinfo(np.int64).max
"""Word that loses against every other."""


def draw_band_words(words: Integers, band: Band, block: Integers) -> int:
    """Keep the least word of the pixels of a band; return how many the triangle has.

    Parameters
    ----------
    words : (H, W) int64
    band : Band
    block : (R, C) int64
        Words of all pixels of the band's block; those outside the triangle are overwritten.
    """
    for columns, outside in band.outside():
        np.copyto(block[:, columns], FARTHEST, where=outside)
    there = words[band.rows, band.columns]
    np.minimum(there, block, out=there)
    return int((band.stop - band.start).sum())
