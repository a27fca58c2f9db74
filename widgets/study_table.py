"""The numbers of a study as a table: sorted by a click on a heading, copied with all their digits."""

from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSortFilterProxyModel, Qt, Signal, Slot
from PySide6.QtGui import QGuiApplication, QKeyEvent, QKeySequence, QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from widgets.series_marks import series_icon
from widgets.theme import current_theme, theme_notifier

Index = QModelIndex | QPersistentModelIndex
_SORT = int(Qt.ItemDataRole.UserRole)
_FULL = _SORT + 1
_KEY = _SORT + 2
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


class _Sorted(QSortFilterProxyModel):
    """Sorts numbers by size; words, and rows without a number, stand behind them."""

    def lessThan(self, left: Index, right: Index) -> bool:
        """Compare two cells."""
        a, b = left.data(_SORT), right.data(_SORT)
        if a is None and b is None:
            return str(left.data()).casefold() < str(right.data()).casefold()
        if a is None or b is None:
            # Behind the numbers whichever way they are sorted.
            return (a is not None) == (self.sortOrder() == Qt.SortOrder.AscendingOrder)
        return bool(a < b)


class StudyTable(QTableView):
    """Shows a :class:`TableRecord`; Ctrl+C copies the chosen rows, or all of them."""

    row_chosen = Signal(str)
    """Key of the row that was double-clicked or entered."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._record = TableRecord((), (), ())
        self._items = QStandardItemModel(self)
        self._sorted = _Sorted(self)
        self._sorted.setSourceModel(self._items)
        self.setModel(self._sorted)
        self.setAccessibleName("Numbers of the study")
        self.horizontalHeader().setSortIndicator(-1, Qt.SortOrder.AscendingOrder)
        self.setSortingEnabled(True)
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

    def text(self) -> str:
        """Return the chosen rows, or all, with their headings: cells apart by tabs, numbers with all digits."""
        rows = sorted({index.row() for index in self.selectionModel().selectedRows()})
        rows = rows or list(range(self._sorted.rowCount()))
        lines = ["\t".join(self._record.head)]
        for row in rows:
            cells = (self._sorted.index(row, column).data(_FULL) for column in range(len(self._record.head)))
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
        self._items.clear()
        self._items.setHorizontalHeaderLabels(list(record.head))
        for number, (key, cells) in enumerate(zip(record.keys, record.rows, strict=True)):
            items = [_item(cell, key) for cell in cells]
            items[0].setIcon(series_icon(number, side, self.devicePixelRatioF()))
            self._items.appendRow(items)
        self.verticalHeader().setDefaultSectionSize(side + 10)
        self.horizontalHeader().resizeSections(QHeaderView.ResizeMode.ResizeToContents)
        last = len(record.head) - 1
        if last >= 0:
            self.horizontalHeader().resizeSection(last, _NOTE_WIDTH)
        header = self.horizontalHeader()
        self._sorted.sort(header.sortIndicatorSection(), header.sortIndicatorOrder())

    @Slot(QModelIndex)
    def _choose(self, index: QModelIndex) -> None:
        self.row_chosen.emit(str(index.data(_KEY)))


def _item(cell: Cell, key: str) -> QStandardItem:
    item = QStandardItem(cell.text)
    item.setData(cell.value, _SORT)
    item.setData(cell.full or cell.text, _FULL)
    item.setData(key, _KEY)
    item.setToolTip(cell.full or cell.text)
    if cell.value is not None:
        item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    return item
