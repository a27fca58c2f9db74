"""The numbers of a study as a table: sorted by a click on a heading, copied with all their digits."""

from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QGuiApplication,
    QIcon,
    QKeyEvent,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QStandardItem,
    QStandardItemModel,
)
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from widgets.basics.drawn_text import paint_empty
from widgets.basics.theme import current_theme, theme_notifier
from widgets.charts.series_marks import SeriesIcon

EMPTY = "The numbers of each method appear here as they are measured."
_FULL = int(Qt.ItemDataRole.UserRole)
_KEY = _FULL + 1
_NOTE_WIDTH = 360
"""Pixels that the last column takes at least; a long sentence is read in the tooltip."""


@dataclass(frozen=True)
class Cell:
    """One number or word."""

    text: str
    """As it is shown, rounded."""
    value: float | None = None
    """What it is sorted by; ``None``: a word."""
    full: str = ""
    """What is copied; empty: the text."""


@dataclass(frozen=True)
class TableRecord:
    """A table with one row for each method."""

    head: tuple[str, ...]
    keys: tuple[str, ...]
    """Of the rows."""
    rows: tuple[tuple[Cell, ...], ...]


class StudyTable(QTableView):
    """Shows a :class:`TableRecord`; Ctrl+C copies the chosen rows, or all of them."""

    row_chosen = Signal(str)
    """Key of the row that was double-clicked or entered."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._record = TableRecord((), (), ())
        self._items = QStandardItemModel(self)
        self._order: tuple[int, bool] | None = None
        """Column that the rows are sorted by, and whether from the largest down; ``None``: as they were measured."""
        self.setModel(self._items)
        self.setAccessibleName("Numbers of the study")
        self.horizontalHeader().setSectionsClickable(True)
        self.horizontalHeader().sectionClicked.connect(self._sort_by)
        self.setAlternatingRowColors(True)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.verticalHeader().hide()
        self.horizontalHeader().setStretchLastSection(True)
        self.horizontalHeader().setDefaultAlignment(
            Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        )
        self.horizontalHeader().setMinimumSectionSize(48)
        self.activated.connect(self._choose)
        theme_notifier().theme_changed.connect(self._rebuild)

    def show_table(self, record: TableRecord) -> None:
        """Show a table; the order that the user chose stays."""
        self._record = record
        self._rebuild()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the cells, or say what comes here."""
        super().paintEvent(event)
        if not self._record.head:
            with QPainter(self.viewport()) as painter:
                paint_empty(painter, self.viewport().rect(), EMPTY, current_theme())

    def text(self) -> str:
        """Return the chosen rows, or all, with their headings: cells apart by tabs, numbers with all digits."""
        rows = sorted({index.row() for index in self.selectionModel().selectedRows()})
        rows = rows or list(range(self._items.rowCount()))
        lines = ["\t".join(self._record.head)]
        for row in rows:
            cells = (self._items.index(row, column).data(_FULL) for column in range(len(self._record.head)))
            lines.append("\t".join(cells))
        return "\n".join(lines) + "\n"

    def copy(self) -> None:
        """Put the chosen rows, or all, on the clipboard."""
        QGuiApplication.clipboard().setText(self.text())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Copy with Ctrl+C."""
        if event.matches(QKeySequence.StandardKey.Copy):
            self.copy()
        else:
            super().keyPressEvent(event)

    @Slot()
    def _rebuild(self) -> None:
        record = self._record
        side = current_theme().text_px + 3
        self.setIconSize(QSize(side, side))
        self._items.clear()
        self._items.setHorizontalHeaderLabels(list(record.head))
        for number in self._row_order():
            items = [_item(cell, record.keys[number]) for cell in record.rows[number]]
            items[0].setIcon(QIcon(SeriesIcon(number)))
            self._items.appendRow(items)
        self.verticalHeader().setDefaultSectionSize(side + 10)
        self.horizontalHeader().resizeSections(QHeaderView.ResizeMode.ResizeToContents)
        last = len(record.head) - 1
        if last >= 0:
            self.horizontalHeader().resizeSection(last, _NOTE_WIDTH)
        self.horizontalHeader().setSortIndicatorShown(self._order is not None)

    def _row_order(self) -> list[int]:
        """Return the rows as they stand: numbers by size, words by the alphabet, what has no number last."""
        rows = list(range(len(self._record.rows)))
        if self._order is None or self._order[0] >= len(self._record.head):
            return rows
        column, is_falling = self._order
        cells = [row[column] for row in self._record.rows]
        numbers = sorted(
            (row for row in rows if cells[row].value is not None), key=lambda row: cells[row].value or 0.0
        )
        words = sorted(
            (row for row in rows if cells[row].value is None), key=lambda row: cells[row].text.casefold()
        )
        if is_falling:
            (numbers or words).reverse()
        return numbers + words

    @Slot(int)
    def _sort_by(self, column: int) -> None:
        """Sort by a column, from the smallest up; a second click turns that round."""
        is_falling = self._order == (column, False)
        self._order = (column, is_falling)
        order = Qt.SortOrder.DescendingOrder if is_falling else Qt.SortOrder.AscendingOrder
        self.horizontalHeader().setSortIndicator(column, order)
        self._rebuild()

    @Slot(QModelIndex)
    def _choose(self, index: QModelIndex) -> None:
        self.row_chosen.emit(str(index.data(_KEY)))


def _item(cell: Cell, key: str) -> QStandardItem:
    item = QStandardItem(cell.text)
    item.setData(cell.full or cell.text, _FULL)
    item.setData(key, _KEY)
    item.setToolTip(cell.full or cell.text)
    if cell.value is not None:
        item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    return item
