"""A table that fills as a stage is stepped: the cells of the step stand out, each leads to its step."""

from collections.abc import Sequence
from math import ceil

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSignalBlocker, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QAction,
    QColor,
    QFont,
    QFontMetrics,
    QGuiApplication,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QStandardItem,
    QStandardItemModel,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QLabel,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from core.records.steps import StepTable, TableCell
from widgets.basics.accessibility import KeyClaim
from widgets.basics.controls import LEAST_TARGET, column_layout, text_label
from widgets.basics.drawing import paint_empty
from widgets.basics.theme import LIGHT, Theme, current_theme, text_font, theme_notifier
from widgets.basics.typed_value import tabular_font

EMPTY = "The numbers of each step appear here."
_POSITION = int(Qt.ItemDataRole.UserRole)
_FULL, _MADE, _HERE = _POSITION + 1, _POSITION + 2, _POSITION + 3
_MARK_WIDTH, _MARK_ROOM = 4, 6
"""Pixels of the bar before a cell, and what is left free for it before every text."""
_SPACING = 4
_WIDE = 40
"""Width, in heights of the text, from which what a step decides mostly takes one line."""
_CELL_ROOM = 8 + _MARK_ROOM
"""Pixels around the text of a cell, and around the lines of a heading."""
_LEAST_TYPE = 0.6
"""Least type of a table that has no room for larger type, relative to the text; never less than a desk's."""


class _CellDelegate(QStyledItemDelegate):
    """Draws a bar before each cell that the step has made, and a line below the row of the step."""

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        text = QStyleOptionViewItem(option)
        text.rect = option.rect.adjusted(_MARK_ROOM, 0, 0, 0)
        super().paint(painter, text, index)
        accent = QColor(current_theme().accent)
        if index.data(_MADE):
            bar = option.rect.adjusted(1, 3, 0, -3)
            bar.setWidth(_MARK_WIDTH)
            painter.fillRect(bar, accent)
        if index.data(_HERE):
            line = QRect(option.rect.left(), option.rect.bottom() - 1, option.rect.width(), 2)
            painter.fillRect(line, accent)

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        """Return the size of a text, with room for the bar before it."""
        return super().sizeHint(option, index) + QSize(_MARK_ROOM, 0)


class _Cells(QTableView):
    """The cells below their headings."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._items = QStandardItemModel(self)
        self._row, self._column = -1, 0
        self._written: tuple[StepTable, Theme, int] | None = None
        self._pixels = current_theme().text_px
        """Size of the type."""
        self.setModel(self._items)
        self.setItemDelegate(_CellDelegate(self))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setCornerButtonEnabled(False)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        for header in (self.horizontalHeader(), self.verticalHeader()):
            header.setSectionsClickable(False)
            header.setHighlightSections(False)
        self.horizontalHeader().setMinimumSectionSize(28)
        KeyClaim(self, (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Return))

    def set_type(self, pixels: int) -> None:
        """Write in type of a size in pixels."""
        if pixels != self._pixels:
            self._pixels = pixels
            if self._written is not None:
                self.show_cells(self._written[0])

    def show_cells(self, table: StepTable) -> None:
        """Show a table; where headings and theme are those shown, only cells that differ are written and painted."""
        theme, old = current_theme(), None
        if self._written is not None and self._written[1:] == (theme, self._pixels):
            shown = self._written[0]
            old = shown if (shown.columns, shown.rows) == (table.columns, table.rows) else None
        if old is None:
            self._write_headings(table)
        for row, cells in enumerate(table.cells):
            for place, cell in enumerate(cells):
                if old is None or _look(old, row, place) != _look(table, row, place):
                    self._write(table, row, place, cell)
        if old is None or _texts(old) != _texts(table):
            self._fit_columns()
        self._written = table, theme, self._pixels
        self._row = table.row
        self._column = max((column for _, column in table.made), default=0)
        self._bring_row_into_view()

    def _fit_columns(self) -> None:
        """Give every column the width of its texts, in one painting: left to itself, the table paints twice."""
        header, widths = self.horizontalHeader(), self._widths()
        with QSignalBlocker(header):
            header.resizeSections(QHeaderView.ResizeMode.ResizeToContents)
        if widths != self._widths():
            self.updateGeometries()
            self.viewport().update()

    def _widths(self) -> list[int]:
        return [self.columnWidth(place) for place in range(self._items.columnCount())]

    def _write_headings(self, table: StepTable) -> None:
        items, shape = self._items, (len(table.rows), len(table.columns))
        if (items.rowCount(), items.columnCount()) != shape:
            items.clear()
            items.setRowCount(shape[0])
            items.setColumnCount(shape[1])
        font = tabular_font(text_font(current_theme(), self._pixels))
        self.setFont(font)
        for place, label in enumerate(table.rows):
            items.setVerticalHeaderItem(place, _heading(label, font))
        for place, column in enumerate(table.columns):
            items.setHorizontalHeaderItem(place, _heading(column.symbol, font, column.meaning))
        height = _row_height(QFontMetrics(font), self._pixels)
        self.verticalHeader().setMinimumSectionSize(height)
        self.verticalHeader().setDefaultSectionSize(height)

    def _write(self, table: StepTable, row: int, place: int, cell: TableCell | None) -> None:
        item = self._items.item(row, place) or QStandardItem()
        _fill(item, cell, (row, place) in table.made, row == table.row)
        vertex = table.columns[place].vertex
        if vertex is not None:
            item.setForeground(QColor(current_theme().vertex_text[vertex % 3]))
        if item.model() is None:
            self._items.setItem(row, place, item)

    def _bring_row_into_view(self) -> None:
        if self._row >= 0:
            self.scrollTo(self._items.index(self._row, self._column))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the row of the step in view."""
        super().resizeEvent(event)
        self._bring_row_into_view()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the cells, or say what comes here."""
        super().paintEvent(event)
        if not self._items.rowCount():
            with QPainter(self.viewport()) as painter:
                paint_empty(painter, self.viewport().rect(), EMPTY, current_theme())


class StepTableView(QWidget):
    """Shows a :class:`core.records.steps.StepTable` below its title, and what it decides below it."""

    step_requested = Signal(int)
    """A position in the trace: the user asks for the step that made a number."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._table: StepTable | None = None
        self._largest: tuple[StepTable, ...] = ()
        """Those that are to be seen whole."""
        self._wanted: tuple[int, Theme, tuple[int, int]] | None = None
        """A width, a theme and the size that is wanted with them."""
        self._sizes: dict[Theme, list[tuple[int, int]]] = {}
        """Sizes of the largest in the usual type of a theme."""
        # Without a layout of its own: a title of two lines is laid out here, and not in all that is around.
        self._pane = pane = QWidget(self)
        self._title = text_label("", pane, role="strong", wraps=True)
        self._note = text_label("", pane, role="sentence", wraps=True, is_selectable=True)
        self.cells = _Cells(pane)
        for text, key, do in (
            ("Go to the step that made it", QKeySequence(Qt.Key.Key_Return), self._choose_current),
            ("Copy the table", QKeySequence(QKeySequence.StandardKey.Copy), self.copy),
        ):
            action = QAction(text, self.cells)
            action.setShortcut(key)
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
            action.triggered.connect(do)
            self.cells.addAction(action)
        self.cells.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        layout = column_layout(pane, _SPACING)
        layout.addWidget(self._title)
        layout.addWidget(self.cells, 1)
        layout.addWidget(self._note)
        self.cells.clicked.connect(self._choose)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self.show_table(None)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for what the longest steps decide, so that the table keeps its place."""
        super().resizeEvent(event)
        self._pane.setGeometry(self.rect())
        self._fit()

    def make_room(self, tables: Sequence[StepTable]) -> None:
        """Want room from now on in which these tables are seen whole."""
        self._largest, self._wanted = tuple(tables), None
        self._sizes.clear()
        self._fit()

    def wanted_size(self, width: int) -> tuple[int, int]:
        """Return the width of the largest tables in the usual type, and the height that they need in ``width``."""
        theme = current_theme()
        if self._wanted is None or self._wanted[:2] != (width, theme):
            sizes = self._usual_sizes()
            widest, highest = (max((size[k] for size in sizes), default=0) for k in (0, 1))
            self._wanted = width, theme, (widest, highest + self._height_around(width))
        return self._wanted[2]

    def _fit(self) -> None:
        """Give the table the largest type in which it is seen whole, and what it decides as much room as it needs."""
        width = self.width()
        note = _wrapped_height(self._note, self._note.text(), width)
        self._note.setFixedHeight(max(self._note_height(width), note))
        self.cells.set_type(self._type(width, self.height() - self._height_around(width)))

    def _type(self, width: int, height: int) -> int:
        """Return the largest type in which the table fits; the usual one where all do, or where none helps."""
        usual, shown = current_theme().text_px, self._table
        if shown is None or all(w <= width and h <= height for w, h in self._usual_sizes()):
            return usual
        least = min(usual, max(LIGHT.small_px, round(_LEAST_TYPE * usual)))
        if len(shown.rows) * _row_height(_metrics(least), least) > height:
            return usual
        sizes = ((pixels, _size_of(shown, pixels)) for pixels in range(usual, least, -1))
        return next((pixels for pixels, (w, h) in sizes if w <= width and h <= height), least)

    def _usual_sizes(self) -> list[tuple[int, int]]:
        """Return the sizes of the largest tables in the usual type."""
        theme = current_theme()
        if theme not in self._sizes:
            self._sizes = {theme: [_size_of(table, theme.text_px) for table in self._largest]}
        return self._sizes[theme]

    def _note_height(self, width: int) -> int:
        lines = min(ceil(_WIDE * current_theme().text_px / max(width, 1)), 3)
        notes = [_wrapped_height(self._note, table.note, width) for table in self._largest]
        return max([lines * self._note.fontMetrics().lineSpacing(), *notes])

    def _height_around(self, width: int) -> int:
        """Return the height of title and note in a width, with what is between."""
        title = max((_wrapped_height(self._title, table.title, width) for table in self._largest), default=0)
        return title + self._note_height(width) + 2 * _SPACING + 2 * self.cells.frameWidth()

    def show_table(self, table: StepTable | None) -> None:
        """Show a table as it is after a step; ``None``: nothing yet."""
        self._table = table
        shown = table or StepTable("", "", (), (), ())
        self._title.setText(shown.title)
        self._note.setText(shown.note)
        self.cells.setAccessibleName(shown.title or "Table")
        self.cells.setAccessibleDescription(shown.note)
        self._fit()
        self.cells.show_cells(shown)

    def table(self) -> StepTable | None:
        """Return what is shown."""
        return self._table

    @Slot()
    def copy(self) -> None:
        """Put the table on the clipboard, with all digits."""
        if self._table is not None:
            QGuiApplication.clipboard().setText(self._table.text())

    @Slot()
    def _choose_current(self) -> None:
        self._choose(self.cells.currentIndex())

    @Slot(QModelIndex)
    def _choose(self, index: QModelIndex) -> None:
        position = index.data(_POSITION)
        if position is not None and position >= 0:
            self.step_requested.emit(position)

    @Slot()
    def _follow_theme(self) -> None:
        self.show_table(self._table)


def _wrapped_height(label: QLabel, text: str, width: int) -> int:
    flags = int(Qt.TextFlag.TextWordWrap)
    return label.fontMetrics().boundingRect(QRect(0, 0, width, 1), flags, text).height()


def _metrics(pixels: int) -> QFontMetrics:
    return QFontMetrics(tabular_font(text_font(current_theme(), pixels)))


def _row_height(metrics: QFontMetrics, pixels: int) -> int:
    """Return the height of a row: where type had to be made smaller, rows are as low as they can be read."""
    is_usual = pixels == current_theme().text_px
    return max(metrics.height() + 6, LEAST_TARGET) if is_usual else metrics.height() + 2


def _size_of(table: StepTable, pixels: int) -> tuple[int, int]:
    """Return width and height of a table, with its headings, in type of a size."""
    metrics = _metrics(pixels)

    def advance(*texts: str) -> int:
        return max(map(metrics.horizontalAdvance, texts), default=0)

    width, lines = advance(*table.rows) + _CELL_ROOM + pixels, 1
    for place, column in enumerate(table.columns):
        symbols = column.symbol.split("\n")
        texts = [cell.text for cells in table.cells if (cell := cells[place]) is not None]
        width += max(advance(*texts), advance(*symbols) + pixels // 2) + _CELL_ROOM
        lines = max(lines, len(symbols))
    return width, lines * metrics.height() + _CELL_ROOM + len(table.rows) * _row_height(metrics, pixels)


def _heading(text: str, font: QFont, meaning: str = "") -> QStandardItem:
    item = QStandardItem(text)
    item.setFont(font)
    item.setToolTip(meaning)
    return item


def _look(table: StepTable, row: int, place: int) -> tuple[TableCell | None, bool, bool]:
    return table.cells[row][place], (row, place) in table.made, row == table.row


def _texts(table: StepTable) -> list[list[str]]:
    return [["" if cell is None else cell.text for cell in cells] for cells in table.cells]


def _fill(item: QStandardItem, cell: TableCell | None, is_made: bool, is_here: bool) -> None:
    item.setText("" if cell is None else cell.text)
    item.setToolTip("" if cell is None else cell.full)
    is_word = cell is not None and cell.text[:1].isalpha()
    side = Qt.AlignmentFlag.AlignLeft if is_word else Qt.AlignmentFlag.AlignRight
    item.setTextAlignment(side | Qt.AlignmentFlag.AlignVCenter)
    item.setData(-1 if cell is None else cell.position, _POSITION)
    item.setData(is_made, _MADE)
    item.setData(is_here, _HERE)
    empty = "empty" if cell is None else cell.full
    item.setAccessibleText(f"{empty}, made in this step" if is_made else empty)
