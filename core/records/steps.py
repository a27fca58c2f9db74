"""Stepping: rows with nested ends, in drawing order or pixel by pixel, and the tables that fill on the way."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from core.records.arrays import Integers, cached_property
from core.records.listing import Operation

# Stepping: rows in drawing order with nested ends. A step is an index; back is as cheap as forward.


class Level(IntEnum):
    """How large a step is."""

    STAGE = 0
    TRIANGLE = 1
    GROUP = 2
    """A clip plane, a row or a block of pixels, a vertex, an edge."""
    PIXEL = 3
    """One row of the trace."""
    OPERATION = 4


@dataclass(frozen=True, eq=False)
class Steps:
    """R rows, each of a kind that does a few operations; rows end pixels, groups and triangles.

    Positions count operations done: 0 is the initial state, ``count`` the final one.
    """

    kinds: tuple[str, ...]
    kind: Integers
    """(R,) int64, index of ``kinds``."""
    operations: Mapping[str, tuple[Operation, ...]]
    """What a row of each kind does, in order."""
    triangle_ends: Integers
    """Numbers of rows after which a triangle is done, rising, the last one R."""
    group_ends: Integers
    """The same for groups; every triangle end is a group end."""

    @property
    def row_count(self) -> int:
        """R."""
        return len(self.kind)

    @cached_property
    def starts(self) -> Integers:
        """(R + 1,) int64, position at which every row starts, and the end."""
        per_kind = np.array([len(self.operations[kind]) for kind in self.kinds], np.int64)
        return np.concatenate([[0], np.cumsum(per_kind[self.kind])]).astype(np.int64)

    @property
    def count(self) -> int:
        """Operations of all rows together."""
        return int(self.starts[-1])

    def boundaries(self, level: Level) -> Integers:
        """Return the positions, rising, between which a step of ``level`` goes; 0 and ``count`` are among them."""
        if level == Level.OPERATION:
            return np.arange(self.count + 1)
        if level == Level.STAGE:
            return np.unique([0, self.count])
        if level == Level.PIXEL:
            return self.starts
        # Rows have operations, so that starts rise as ends do: nothing is sorted, however many rows there are.
        ends = self.triangle_ends if level == Level.TRIANGLE else self.group_ends
        after = ends[ends > 0]
        found: Integers = np.concatenate([[0], self.starts[after]])
        return found

    def forward(self, position: int, level: Level) -> int:
        """Return the next boundary after ``position``, or the end."""
        if level == Level.OPERATION:
            return min(position + 1, self.count)
        boundaries = self.boundaries(level)
        after = int(np.searchsorted(boundaries, position, "right"))
        return int(boundaries[min(after, len(boundaries) - 1)])

    def back(self, position: int, level: Level) -> int:
        """Return the last boundary before ``position``, or 0."""
        if level == Level.OPERATION:
            return max(position - 1, 0)
        boundaries = self.boundaries(level)
        return int(boundaries[max(int(np.searchsorted(boundaries, position, "left")) - 1, 0)])

    def row_at(self, position: int) -> tuple[int, int]:
        """Return row and operation that were done last; (-1, -1) at the initial state."""
        if position <= 0 or not self.row_count:
            return -1, -1
        row = int(np.searchsorted(self.starts, min(position, self.count) - 1, "right")) - 1
        return row, min(position, self.count) - 1 - int(self.starts[row])

    def rows_done(self, position: int) -> int:
        """Return how many rows are done as a whole."""
        return int(np.searchsorted(self.starts, position, "right")) - 1

    def position_after(self, row: int) -> int:
        """Return the position at which ``row`` has just been done."""
        return int(self.starts[row + 1])


def ends_of(*keys: Integers) -> Integers:
    """Return after how many rows any of the keys (R,) changes, and R: the ends of runs of equal keys."""
    count = len(keys[0])
    if count == 0:
        return np.zeros(1, np.int64)
    changes = np.zeros(count - 1, bool)
    for key in keys:
        changes |= key[1:] != key[:-1]
    return np.append(np.flatnonzero(changes) + 1, count)


# The order of rows, where it is another one than triangle by triangle.


@dataclass(frozen=True)
class RowOrder:
    """Rows that are listed pixel by pixel or line by line of the picture, from the lowest row of pixels upwards.

    A step of the level TRIANGLE is then all that is done in one row of pixels. Rows about no pixel come first.
    """

    titles: tuple[str, str, str]
    """What a step of the levels TRIANGLE, GROUP and PIXEL is, as ``Row``, ``Pixel``, ``Candidate``."""
    is_by_pixel: bool = False
    """Whether all rows about a pixel stand together, and are one step of the level GROUP."""
    sums: tuple[tuple[str, str, str], ...] = ()
    """What a larger step is summed up as: a count of ``StageTrace.summary``, the noun of what is counted (``place``: a
    pixel or sample), and what was done to it; without that, none of 0 is told. Empty: as the stage sums up."""

    def keys(self, pixel: Integers) -> tuple[Integers, ...]:
        """Return what rows about pixels (R, 2), columns and rows, are sorted by: the outer loop first, each (R,)."""
        return (pixel[:, 1], pixel[:, 0]) if self.is_by_pixel else (pixel[:, 1],)

    @property
    def names(self) -> dict[Level, str]:
        """The titles by level."""
        return dict(zip((Level.TRIANGLE, Level.GROUP, Level.PIXEL), self.titles, strict=True))

    def unit(self, level: Level, column: int, row: int) -> str:
        """Return what the step of a level that a pixel is part of is called in a sentence, as ``Pixel (3, 5)``."""
        outer, group, _ = self.titles
        if row < 0:
            return "Before the first pixel"
        if level <= Level.TRIANGLE:
            return f"{outer} {row}"
        return f"{group} ({column}, {row})" if self.is_by_pixel else f"{outer} {row}, one {group.lower()}"


PIXEL_BY_PIXEL = RowOrder(("Row", "Pixel", "Candidate"), is_by_pixel=True)
"""Pixel after pixel, and of each pixel its candidates in drawing order: the loops of a ray caster."""
ROW_BY_ROW = RowOrder(("Row", "Triangle", "Pixel"))
"""One row of pixels after another, and in each the triangles in drawing order."""


# A table that fills as a stage is stepped: what the rows of a trace have found by one step, and nothing
# later.


Place = tuple[int, int]
"""Row and column of a cell."""


@dataclass(frozen=True)
class TableColumn:
    """One column."""

    symbol: str
    """Its heading: the symbol of formulas and variables, which may have two lines."""
    meaning: str
    """One sentence for the tooltip."""
    vertex: int | None = None
    """0, 1 or 2 where the column belongs to that vertex."""


@dataclass(frozen=True)
class TableCell:
    """What stands in one cell."""

    text: str
    """As formulas write it."""
    full: str
    """With all digits, for copying."""
    position: int
    """Of the step that made it, in the trace of its stage."""


@dataclass(frozen=True)
class StepTable:
    """A table after one step."""

    title: str
    row_title: str
    """What the labels of the rows are, as ``Border``."""
    columns: tuple[TableColumn, ...]
    rows: tuple[str, ...]
    """Labels."""
    cells: tuple[tuple[TableCell | None, ...], ...]
    """One row of cells for each label; ``None``: not found by now, and empty."""
    made: frozenset[Place] = frozenset()
    """The cells that this step has made."""
    row: int = -1
    """The row of this step, -1: none."""
    note: str = ""
    """What the finished table decides, in one sentence; empty before."""

    def text(self) -> str:
        """Return the table as text: cells apart by tabs, numbers with all digits, then the note."""
        lines = ["\t".join([self.row_title, *(" ".join(column.symbol.split()) for column in self.columns)])]
        for label, cells in zip(self.rows, self.cells, strict=True):
            lines.append("\t".join([label, *("" if cell is None else cell.full for cell in cells)]))
        return "\n".join([self.title, *lines, *([self.note] if self.note else [])]) + "\n"
