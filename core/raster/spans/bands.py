"""Bands: a large triangle is drawn some rows at a time, as blocks of words.

Where a triangle has tens of thousands of pixels, one operation on a block of rows and columns beats passes over single
pixels: no index is needed, the buffer's block itself is compared. Columns between the ragged ends of the rows need
no mask; at the ends, pixels outside get a word that loses against everything.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

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
    height = max(BAND_PIXELS // int(end.max() - begin.min()), 1)
    for first in range(0, len(begin), height):
        part = slice(first, first + height)
        left, right = int(begin[part].min()), int(end[part].max())
        row = np.arange(bottom + first, bottom + first + len(begin[part]))
        yield Band(
            rows=slice(int(row[0]) - first_row, int(row[-1]) + 1 - first_row),
            columns=slice(left - first_column, right - first_column),
            row=row,
            column=np.arange(left, right),
            start=begin[part],
            stop=end[part],
        )


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
