"""Where the maps of an experiment stand: side by side, in as many rows as there need to be, cells as large as fit."""

from dataclasses import dataclass
from functools import lru_cache

from PySide6.QtCore import QPoint, QRect, QSize

from widgets.atlas.records import AtlasRecord, CellPlace

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
