"""The series of a chart: points of each, their marks, the list of their names, and their numbers as a table.

The shapes are those of pyqtgraph. The colours keep away from what has a meaning in the program: the blue, orange and
green of vertices, the accent of the present step.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from pyqtgraph.graphicsItems.ScatterPlotItem import Symbols
from PySide6.QtCore import QEvent, QModelIndex, QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QGuiApplication,
    QIcon,
    QIconEngine,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QStandardItem,
    QStandardItemModel,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QListWidget,
    QListWidgetItem,
    QTableView,
    QWidget,
)

from core.explain.number_text import number_text
from core.records.arrays import Floats
from widgets.basics.drawing import paint_empty
from widgets.basics.theme import Theme, current_theme, theme_notifier

# What a chart shows: axes, series of points, and the front of those that no other beats.


MOST_NAMED = 12
"""Marks of a chart that are named beside them at once; of more series there is a list too."""


@dataclass(frozen=True)
class ChartAxis:
    """One axis; both are logarithmic, with places of their own for 0 and for infinity."""

    title: str
    """What a person reads, without the unit."""
    unit: str = ""
    """``s`` is written with a prefix, as ``20 µs``; other units stand behind the title."""

    @property
    def label(self) -> str:
        """Title and unit."""
        return f"{self.title} ({self.unit})" if self.unit and self.unit != "s" else self.title


@dataclass(frozen=True, eq=False)
class ChartSeries:
    """One method: a single point, or several that are joined by a line."""

    key: str
    """What signals name it by."""
    title: str
    number: int
    """Which colour and shape it has; the same in every chart of a page."""
    x: Floats
    """(N,) float64, 0 or more; N is at least 1."""
    y: Floats
    """(N,) float64, 0 or more."""
    x_spread: Floats | None = None
    """(N, 2) float64, ends of the horizontal bars; ``None``: no bars."""
    y_spread: Floats | None = None
    """(N, 2) float64, ends of the vertical bars."""
    best: int = -1
    """The point of a line that stands out, whatever is pointed at: where its cost is least; -1: none."""


@dataclass(frozen=True, eq=False)
class ChartPicture:
    """Everything that a chart shows."""

    x_axis: ChartAxis
    y_axis: ChartAxis
    series: tuple[ChartSeries, ...] = ()
    front: tuple[str, ...] = ()
    """Keys of the series of one point that no other beats on both axes, the smallest x first."""
    ringed: tuple[str, ...] = ()
    """Keys of the series that stand out, whatever is pointed at: what a plan chose."""
    is_named: bool = True
    """Whether all names are written beside the marks; else a list beside the chart has them."""


@dataclass(frozen=True)
class ChartEmpty:
    """A chart without anything to show: why, and what to do."""

    text: str


ChartMark = Mapping[str, str]
"""Key of a series to the letter that marks it as chosen: A or B."""


# Colour and shape of a series: the shape alone tells twelve apart, the colour helps.


SHAPES = ("o", "s", "t1", "d", "star", "t", "h", "+", "x", "p", "t2", "t3")
THIN_SHAPES = ("star", "+", "x")
LIGHT_COLORS = ("#4b4fa8", "#0b7a75", "#8a5a00", "#8c2f39", "#3f6b1e", "#5d6670", "#7b3f98", "#1f6f9f")
DARK_COLORS = ("#a9adff", "#55d6cf", "#e0b45a", "#ff9aa5", "#a5d97f", "#c3ccd5", "#d9a3f0", "#7cc7f2")


def series_color(number: int, theme: Theme | None = None) -> str:
    """Return the colour ``#rrggbb`` of a series."""
    colors = DARK_COLORS if (theme or current_theme()).is_dark else LIGHT_COLORS
    return colors[number % len(colors)]


def paint_mark(painter: QPainter, at: QPointF, number: int, size: float) -> None:
    """Draw the mark of a series; shapes that are thin are drawn larger than others, or they would look small."""
    shape = SHAPES[number % len(SHAPES)]
    size *= 1.35 if shape in THIN_SHAPES else 1.0
    painter.save()
    painter.translate(at)
    painter.scale(size, size)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(series_color(number)))
    painter.drawPath(Symbols[shape])
    painter.restore()


class SeriesIcon(QIconEngine):
    """The mark of a series as an icon, sharp in every size and in files."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self._number = number

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Draw the mark in the middle of a rectangle."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_mark(painter, QRectF(rect).center(), self._number, 0.72 * rect.height())

    def clone(self) -> QIconEngine:
        """Return the same."""
        return SeriesIcon(self._number)


# The series of a crowded chart as a list: the mark and the whole name of each, linked with the marks in the
# chart.


_ADDS = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier


class ChartLegend(QListWidget):
    """One row for each series; pointing at a row points at the series."""

    series_hovered = Signal(str)
    """Key of the series of the row under the pointer, or gone to by an arrow key."""
    series_left = Signal()
    series_chosen = Signal(str, bool)
    """Key of a row that was clicked or entered, and whether Ctrl or Shift asks for it beside another one."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._series: tuple[ChartSeries, ...] = ()
        self._strong: tuple[str, ...] = ()
        self._marks: ChartMark = {}
        self.setAccessibleName("Marks of the chart")
        self.setMouseTracking(True)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.entered.connect(self._point_at_row)
        theme_notifier().theme_changed.connect(self._refresh)

    def show_series(self, series: tuple[ChartSeries, ...], strong: tuple[str, ...] = ()) -> None:
        """Show series in their order; those of the ``strong`` keys stand out: no other beats them."""
        self._series, self._strong = series, strong
        self.clear()
        for _ in series:
            self.addItem(QListWidgetItem())
        self._refresh()

    def show_pointed(self, key: str) -> None:
        """Mark the row of a series that is pointed at elsewhere; empty: none."""
        keys = [series.key for series in self._series]
        self.blockSignals(True)
        self.setCurrentRow(keys.index(key) if key in keys else -1)
        self.blockSignals(False)

    def show_marks(self, marks: ChartMark) -> None:
        """Write the letters of the chosen series before their names."""
        self._marks = dict(marks)
        self._refresh()

    @Slot()
    def _refresh(self) -> None:
        side = current_theme().text_px
        self.setIconSize(QSize(side, side))
        for row, series in enumerate(self._series):
            item, letter = self.item(row), self._marks.get(series.key, "")
            is_strong = series.key in self._strong
            item.setText(f"{letter}: {series.title}" if letter else series.title)
            item.setToolTip(
                f"{series.title}\nPareto front: no other is better in both." if is_strong else series.title
            )
            item.setIcon(QIcon(SeriesIcon(series.number)))
            font = self.font()
            font.setBold(is_strong)
            points = zip(series.x.tolist(), series.y.tolist(), strict=True)
            values = ", ".join(f"{number_text(y, 3)} at {number_text(x, 3)}" for x, y in points)
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{item.text()}: {values}")
            item.setFont(font)

    # Pointer and keyboard.

    @Slot(QModelIndex)
    def _point_at_row(self, index: QModelIndex) -> None:
        self.series_hovered.emit(self._series[index.row()].key)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Choose the row that is clicked."""
        super().mouseReleaseEvent(event)
        row = self.indexAt(event.position().toPoint()).row()
        if row >= 0 and event.button() == Qt.MouseButton.LeftButton:
            self.series_chosen.emit(self._series[row].key, bool(event.modifiers() & _ADDS))

    def leaveEvent(self, event: QEvent) -> None:
        """Point at nothing."""
        super().leaveEvent(event)
        self.series_left.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Point at the row that an arrow goes to; choose with Enter."""
        row = self.currentRow()
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space) and row >= 0:
            self.series_chosen.emit(self._series[row].key, bool(event.modifiers() & _ADDS))
            return
        super().keyPressEvent(event)
        if self.currentRow() != row:
            self.series_hovered.emit(self._series[self.currentRow()].key)


# The numbers of a study as a table: sorted by a click on a heading, copied with all their digits.


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
