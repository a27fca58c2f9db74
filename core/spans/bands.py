"""Bands: a large triangle is drawn some rows at a time, as blocks of words.

Where a triangle has tens of thousands of pixels, one operation on a block of rows and columns beats passes over single
pixels: no index is needed, the buffer's block itself is compared. Columns between the ragged ends of the rows need
no mask; at the ends, pixels outside get a word that loses against everything.

Where the buffer is only written, the rows of a block may begin where the triangle does (`Strip`): then hardly a pixel
beside it is computed, and none needs a mask.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.pixel_runs import Raster
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Floats, Integers
from core.spans.fill import rows_in_order
from core.spans.lanes import TieOwners, set_up_lanes

BIG_AREA = 1 << 15
"""Pixels; triangles of more are drawn in bands."""
BAND_PIXELS = 1 << 16
"""Pixels of a band: its numbers stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class TriangleRows:
    """The rows of one triangle in the raster, from its lowest one that has pixels to its highest one."""

    row: Integers
    """(R,) int64, numbers of the rows in the window."""
    origin: Integers
    """(R,) int64, first inside column of the window, in a region of it or not."""
    start: Integers
    """(R,) int64, first inside column."""
    stop: Integers
    """(R,) int64, column after the last; the start of a row without columns."""

    def __len__(self) -> int:
        return len(self.row)

    @property
    def pixel_count(self) -> int:
        """Pixels of all rows."""
        return int((self.stop - self.start).sum())

    def part(self, first: int, end: int) -> "TriangleRows":
        """Return rows ``first`` to ``end``."""
        at = slice(first, end)
        return TriangleRows(self.row[at], self.origin[at], self.start[at], self.stop[at])


@dataclass(frozen=True, eq=False)
class Steps:
    """Columns of a block, counted in each row from the row's origin: so a value has the same share in every block."""

    first: Integers
    """(R,) int64, of the first column of every row."""
    width: int
    """Columns of the block."""

    @property
    def number(self) -> Integers:
        """(N,) int64, all numbers that occur."""
        return np.arange(int(self.first.min()), int(self.first.max()) + self.width)

    def spread(self, ramp: NDArray[Any]) -> NDArray[Any]:
        """Return for values of `number`, (N,) and contiguous, those of every row of the block: (R or 1, width)."""
        if len(ramp) == self.width:
            return ramp[None]
        size = ramp.itemsize
        windows = np.ndarray((len(ramp) - self.width + 1, self.width), ramp.dtype, ramp, strides=(size, size))
        slanted: NDArray[Any] = windows[self.first - self.first.min()]
        return slanted


@dataclass(frozen=True, eq=False)
class Band:
    """Neighbouring rows of one triangle, and the columns between the least start and the greatest stop."""

    inside: TriangleRows
    rows: slice
    """Rows in the buffer."""
    columns: slice
    """Columns in the buffer."""
    column: Integers
    """(C,) int64, numbers of the columns in the window."""

    @property
    def steps(self) -> Steps:
        """The columns of the block."""
        return Steps(self.column[0] - self.inside.origin, len(self.column))

    def outside(self) -> Iterator[tuple[slice, np.ndarray]]:
        """Yield column ranges of the block and, as (R, c) bool, which of their pixels the triangle does not have."""
        start, stop = self.inside.start[:, None], self.inside.stop[:, None]
        width = len(self.column)
        inner = int(start.max() - self.column[0])
        outer = int(stop.min() - self.column[0])
        if inner < outer:
            if inner:
                yield slice(0, inner), self.column[:inner] < start
            if outer < width:
                yield slice(outer, width), self.column[outer:] >= stop
        else:
            yield slice(0, width), (self.column < start) | (self.column >= stop)


@dataclass(frozen=True, eq=False)
class Strip:
    """Neighbouring rows of one triangle, each from its first inside column on: a slanted block."""

    inside: TriangleRows
    width: int
    """Columns of the block."""

    @property
    def steps(self) -> Steps:
        """The columns of the block."""
        return Steps(self.inside.start - self.inside.origin, self.width)


def rows_of_triangles(
    x: Floats, y: Floats, doubled_area: Floats, raster: Raster, owners: TieOwners, scratch: ScratchBuffers
) -> list[TriangleRows]:
    """Return the rows of triangles, of all of them at once.

    Parameters
    ----------
    x, y : (3, P) float64
        Snapped window coordinates of the corners.
    doubled_area : (P,) float64
    """
    first_column, first_row, end_column, end_row = raster.bounds
    all_columns = replace(raster, region=(0, first_row, raster.width, end_row - first_row))
    lanes = set_up_lanes(x, y, doubled_area, all_columns, owners, scratch)
    count = len(doubled_area)
    rows = rows_in_order(lanes, count, all_columns, owners, scratch)
    start, stop = rows.start, rows.stop
    if (first_column, end_column) != (0, raster.width):
        start, stop = (np.clip(of, first_column, end_column) for of in (start, stop))
    whole = TriangleRows(rows.row, rows.start, start, stop)
    inside = np.flatnonzero(stop > start)
    firsts = np.searchsorted(rows.triangle[inside], np.arange(count + 1)).tolist()
    return [
        whole.part(int(inside[first]), int(inside[end - 1]) + 1) if first < end else whole.part(0, 0)
        for first, end in pairwise(firsts)
    ]


def bands(rows: TriangleRows, raster: Raster) -> Iterator[Band]:
    """Yield the bands of one triangle, from the lowest up."""
    if not len(rows):
        return
    first_column, first_row, _, _ = raster.bounds
    for part in _parts(rows, int(rows.stop.max() - rows.start.min())):
        left, right = int(part.start.min()), int(part.stop.max())
        yield Band(
            inside=part,
            rows=slice(int(part.row[0]) - first_row, int(part.row[-1]) + 1 - first_row),
            columns=slice(left - first_column, right - first_column),
            column=np.arange(left, right),
        )


def strips(rows: TriangleRows) -> Iterator[Strip]:
    """Yield the strips of one triangle, from the lowest up."""
    if not len(rows):
        return
    for part in _parts(rows, int((rows.stop - rows.start).max())):
        yield Strip(part, int((part.stop - part.start).max()))


def _parts(rows: TriangleRows, width: int) -> Iterator[TriangleRows]:
    """Yield the rows that are drawn together."""
    height = max(BAND_PIXELS // width, 1)
    for first in range(0, len(rows), height):
        yield rows.part(first, first + height)


FARTHEST = np.iinfo(np.int64).max
"""Word that loses against every other."""


def draw_band_words(words: Integers, band: Band, block: Integers) -> int:
    """Keep the least word of the pixels of a band; return how many the triangle has.

    Parameters
    ----------
    words : (H, W) int64
    block : (R, C) int64
        Words of all pixels of the band's block; those outside the triangle are overwritten.
    """
    for columns, outside in band.outside():
        np.copyto(block[:, columns], FARTHEST, where=outside)
    there = words[band.rows, band.columns]
    np.minimum(there, block, out=there)
    return band.inside.pixel_count
