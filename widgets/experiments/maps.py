"""The maps of an experiment as records, cells of a few kinds over two axes, and where they stand side by side."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPoint, QRect, QSize

# What the maps of an experiment show: cells of a few kinds over two axes, one map for each method.


UNKNOWN = 255
"""Kind of a cell that has not been run."""


@dataclass(frozen=True)
class CellKind:
    """How cells of one outcome look: a fill and a character, in light and in dark."""

    title: str
    """What it means, in words."""
    mark: str
    """One character, so that no outcome depends on colour alone."""
    fills: tuple[str, str]
    """``#rrggbb`` on a light and on a dark background."""
    inks: tuple[str, str]
    """Colours of the character."""


@dataclass(frozen=True)
class AtlasAxis:
    """One parameter."""

    title: str
    """What a person reads, with the unit."""
    texts: tuple[str, ...]
    """Its values."""
    is_logarithmic: bool = False


@dataclass(frozen=True, eq=False)
class AtlasMap:
    """The cells of one method."""

    key: str
    """What signals name it by."""
    title: str
    cells: NDArray[np.uint8]
    """(rows, columns) uint8, index of the kind or `UNKNOWN`; row 0 is the lowest."""


@dataclass(frozen=True, eq=False)
class AtlasRecord:
    """All maps of one experiment; they have one shape."""

    kinds: tuple[CellKind, ...]
    across: AtlasAxis
    up: AtlasAxis | None
    """``None``: there is one parameter, and each map is a strip."""
    maps: tuple[AtlasMap, ...]

    @property
    def columns(self) -> int:
        """Cells of a map from left to right."""
        return len(self.across.texts)

    @property
    def rows(self) -> int:
        """Cells of a map from bottom to top."""
        return 1 if self.up is None else len(self.up.texts)

    def count(self, kind: int) -> int:
        """Return how many cells of all maps are of a kind."""
        return sum(int(np.count_nonzero(each.cells == kind)) for each in self.maps)


@dataclass(frozen=True)
class CellPlace:
    """One cell: a map, a column and a row."""

    key: str
    column: int
    row: int


# Where the maps of an experiment stand: side by side, in as many rows as there need to be, cells as large
# as fit.


LARGEST_CELL = 30
GAP = 20
"""Pixels between maps."""
MARGIN = 8


@dataclass(frozen=True)
class AtlasMetrics:
    """Sizes that follow from the font."""

    line: int
    """Height of a line of text."""
    tick: int
    """Width of the widest value of the axis that goes up; 0: there is none."""
    smallest_cell: int
    title: int
    """Width of the widest title."""


@dataclass(frozen=True, eq=False)
class AtlasLayout:
    """The cells' side, and the rectangle of cells of every map."""

    cell: int
    areas: tuple[QRect, ...]
    """Cells of each map, without title and ticks."""
    size: QSize
    """Of everything."""

    def area_of(self, place: CellPlace, record: AtlasRecord) -> QRect:
        """Return the rectangle of one cell."""
        number = next(k for k, each in enumerate(record.maps) if each.key == place.key)
        area = self.areas[number]
        x = area.left() + place.column * self.cell
        return QRect(x, area.top() + (record.rows - 1 - place.row) * self.cell, self.cell, self.cell)

    def place_at(self, point: QPoint, record: AtlasRecord) -> CellPlace | None:
        """Return the cell under a point, if there is one."""
        for area, each in zip(self.areas, record.maps, strict=True):
            if area.contains(point):
                column = (point.x() - area.left()) // self.cell
                row = record.rows - 1 - (point.y() - area.top()) // self.cell
                return CellPlace(each.key, column, row)
        return None


@lru_cache(maxsize=32)
def lay_out_maps(
    count: int, columns: int, rows: int, width: int, height: int, metrics: AtlasMetrics
) -> AtlasLayout:
    """Return the layout with the largest cells that fit into ``width`` x ``height``, or scroll if the smallest do not.

    Parameters
    ----------
    count : int
        Maps.
    columns, rows : int
        Cells of each.
    width, height : int
        Room in pixels.
    """
    cell = metrics.smallest_cell
    for candidate in range(LARGEST_CELL, metrics.smallest_cell, -1):
        layout = _placed(count, columns, rows, width, candidate, metrics)
        if layout.size.height() <= height and layout.size.width() <= width:
            cell = candidate
            break
    return _placed(count, columns, rows, width, cell, metrics)


def _placed(count: int, columns: int, rows: int, width: int, cell: int, metrics: AtlasMetrics) -> AtlasLayout:
    left = metrics.tick + 4 if metrics.tick else 0
    cells_wide, cells_high = columns * cell, rows * cell
    step_x = max(left + cells_wide, min(metrics.title, width - 2 * MARGIN)) + GAP
    step_y = metrics.line + 2 + cells_high + metrics.line + GAP // 2
    in_row = min(max(1, (width - 2 * MARGIN + GAP) // step_x), count)
    areas = tuple(
        QRect(
            MARGIN + step_x * (number % in_row) + left,
            MARGIN + step_y * (number // in_row) + metrics.line + 2,
            cells_wide,
            cells_high,
        )
        for number in range(count)
    )
    size = QSize(2 * MARGIN + step_x * in_row - GAP, 2 * MARGIN + step_y * -(-count // in_row) - GAP // 2)
    return AtlasLayout(cell, areas, size)
