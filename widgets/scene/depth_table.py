"""The editor of a table of depths: its test, its patches in drawing order, and the cells."""

import numpy as np
from PySide6.QtCore import QEvent, QModelIndex, QObject, QSignalBlocker, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QGuiApplication, QIcon, QKeyEvent, QKeySequence, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHeaderView,
    QListWidget,
    QListWidgetItem,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QWidget,
)

from core.framebuffer.display import to_display
from core.records.depth_table import DEPTH_TESTS, MOST_CELLS, DepthTable, depth_text, text_of_depths
from widgets.basics.accessibility import KeyClaim
from widgets.basics.controls import LEAST_TARGET, column_layout, flat_button, row_layout, text_label
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.basics.typed_value import tabular_font

CELL_WIDTH = 28
"""Least width of a cell, in pixels at 100 %."""
TYPED = "0123456789-–∞iIoO"
"""First characters of what is typed in a cell."""
LIST_ROWS = 3
"""Patches that are seen without scrolling."""


class _Cells(QTableWidget):
    """The cells of one patch, the top row first; what is typed goes into a cell, and never to a key of the window."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        triggers = QAbstractItemView.EditTrigger
        self.setEditTriggers(triggers.AnyKeyPressed | triggers.DoubleClicked | triggers.EditKeyPressed)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setCornerButtonEnabled(False)
        self.horizontalHeader().setMinimumSectionSize(20)
        for header in (self.horizontalHeader(), self.verticalHeader()):
            header.setSectionsClickable(False)
            header.setHighlightSections(False)
            header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        KeyClaim(self, (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right))
        self.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep digits, signs and copying from the shortcuts of the window."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            is_typed = event.text() != "" and event.text() in TYPED
            is_edit = event.key() in (Qt.Key.Key_F2, Qt.Key.Key_Delete, Qt.Key.Key_Backspace)
            is_text = event.matches(QKeySequence.StandardKey.Copy) or event.matches(
                QKeySequence.StandardKey.Paste
            )
            if is_typed or is_edit or is_text:
                event.accept()
                return True
        return super().eventFilter(watched, event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Empty a cell with Delete; copy and paste whole patches."""
        editor = self.parent()
        assert isinstance(editor, DepthTableEditor)
        if event.matches(QKeySequence.StandardKey.Copy):
            editor.copy_patch()
        elif event.matches(QKeySequence.StandardKey.Paste):
            editor.paste_patch()
        elif event.key() in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace) and self.currentItem() is not None:
            self.currentItem().setText("")
        else:
            super().keyPressEvent(event)


class DepthTableEditor(QWidget):
    """Shows a :class:`core.records.depth_table.DepthTable` and says what the user wants of it.

    Rows are counted as the picture does: row 0 is the bottom row.
    """

    cell_edited = Signal(int, int, int, str)
    """Patch, row and column, and what was typed."""
    patch_pasted = Signal(int, str)
    """Patch, and the text of all its cells."""
    patch_moved = Signal(int, int)
    """The patch is to be drawn at another place of the order."""
    patch_added = Signal()
    patch_removed = Signal(int)
    test_chosen = Signal(str)
    size_chosen = Signal(int, int)
    """Columns and rows."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._table: DepthTable | None = None
        self.test_box, self.patches, self.cells = QComboBox(self), QListWidget(self), _Cells(self)
        for name, sign in DEPTH_TESTS.items():
            self.test_box.addItem(f"new {sign} buffer", name)
        self.test_box.setAccessibleName("Depth test")
        self.test_box.setToolTip("How a depth must compare with the buffer's to pass")
        self.patches.setAccessibleName("Patches in drawing order")
        self.patches.setToolTip("Drag a patch, or press Earlier and Later, to draw it at another place")
        self.patches.setDragDropMode(QAbstractItemView.DragDropMode.InternalMove)
        KeyClaim(self.patches, (Qt.Key.Key_Up, Qt.Key.Key_Down))
        self.columns, self.rows = (self._size_box(name) for name in ("Columns", "Rows"))
        self.earlier_button = self._button("↑", "Earlier", "Draw the patch earlier")
        self.later_button = self._button("↓", "Later", "Draw the patch later")
        self.add_button = self._button("+", "Add a patch", "Add a patch, which is drawn last")
        self.remove_button = self._button("✕", "Remove the patch", "Remove the chosen patch")
        self._title = text_label("", self, role="strong")
        self._hint = text_label(
            "A number, ∞ (inf) or – (none). Ctrl+C and Ctrl+V copy and paste a whole patch.",
            self,
            role="muted",
            wraps=True,
        )
        self._lay_out()
        self.test_box.activated.connect(self._choose_test)
        self.patches.currentRowChanged.connect(self._show_patch)
        self.patches.model().rowsMoved.connect(self._dragged)
        self.cells.itemChanged.connect(self._edited)
        for box in (self.columns, self.rows):
            box.editingFinished.connect(self._choose_size)
        self.earlier_button.clicked.connect(self._move_earlier)
        self.later_button.clicked.connect(self._move_later)
        self.add_button.clicked.connect(self.patch_added)
        self.remove_button.clicked.connect(self._remove)
        theme_notifier().theme_changed.connect(self._follow_theme)

    def _size_box(self, name: str) -> QSpinBox:
        box = QSpinBox(self)
        box.setRange(1, MOST_CELLS)
        box.setAccessibleName(name)
        box.setKeyboardTracking(False)
        return box

    def _button(self, text: str, name: str, tip: str) -> QToolButton:
        button = flat_button(text, name, tip, self)
        button.setMinimumSize(LEAST_TARGET, LEAST_TARGET)
        return button

    def _lay_out(self) -> None:
        layout = column_layout(self, 4, margins=(8, 4, 8, 8))
        layout.addWidget(text_label("Depth test", self, role="muted"))
        layout.addWidget(self.test_box)
        layout.addWidget(text_label("Patches in drawing order", self, role="muted"))
        layout.addWidget(self.patches)
        row = row_layout(spacing=4)
        for button in (self.earlier_button, self.later_button, self.add_button, self.remove_button):
            row.addWidget(button)
        row.addStretch(1)
        layout.addLayout(row)
        layout.addWidget(self._title)
        layout.addWidget(self.cells, 1)
        size = row_layout(spacing=4)
        for label, box in (("Columns", self.columns), ("rows", self.rows)):
            size.addWidget(text_label(label, self, role="muted"))
            size.addWidget(box)
        size.addStretch(1)
        layout.addLayout(size)
        layout.addWidget(self._hint)

    def show_table(self, table: DepthTable) -> None:
        """Show a table; the chosen patch stays while there are as many."""
        chosen = self.current_patch()
        self._table = table
        count = len(table.depths)
        with QSignalBlocker(self.patches), QSignalBlocker(self.patches.model()):
            self.patches.clear()
            for number, color in enumerate(
                to_display(table.colors[None].astype(np.float32)).pixels[0, :, :3].tolist()
            ):
                self.patches.addItem(QListWidgetItem(_swatch(QColor(*color)), f"Patch {number}"))
            self.patches.setCurrentRow(min(max(chosen, 0), count - 1))
        with QSignalBlocker(self.test_box):
            self.test_box.setCurrentIndex(self.test_box.findData(table.test))
        for box, value in zip((self.columns, self.rows), table.size, strict=True):
            with QSignalBlocker(box):
                box.setValue(value)
        self.remove_button.setEnabled(count > 1)
        self._show_patch(self.current_patch())

    def current_patch(self) -> int:
        """Return the number of the chosen patch, -1: none."""
        return self.patches.currentRow()

    def show_current_patch(self, patch: int) -> None:
        """Choose a patch."""
        self.patches.setCurrentRow(patch)

    @Slot()
    def copy_patch(self) -> None:
        """Put the cells of the chosen patch on the clipboard."""
        if self._table is not None:
            QGuiApplication.clipboard().setText(text_of_depths(self._table.depths[self.current_patch()]))

    @Slot()
    def paste_patch(self) -> None:
        """Ask for the cells of the clipboard in the chosen patch."""
        self.patch_pasted.emit(self.current_patch(), QGuiApplication.clipboard().text())

    @Slot(int)
    def _show_patch(self, patch: int) -> None:
        """Write the cells of a patch."""
        if self._table is None or patch < 0:
            return
        columns, rows = self._table.size
        self._title.setText(f"Cells of patch {patch}")
        self.cells.setAccessibleName(f"Cells of patch {patch}")
        self.earlier_button.setEnabled(patch > 0)
        self.later_button.setEnabled(patch < len(self._table.depths) - 1)
        with QSignalBlocker(self.cells):
            self.cells.setRowCount(rows)
            self.cells.setColumnCount(columns)
            self.cells.setHorizontalHeaderLabels([str(column) for column in range(columns)])
            self.cells.setVerticalHeaderLabels([str(row) for row in range(rows - 1, -1, -1)])
            for line in range(rows):
                for column in range(columns):
                    item = self.cells.item(line, column)
                    if item is None:
                        item = QTableWidgetItem()
                        item.setTextAlignment(Qt.AlignmentFlag.AlignCenter)
                        self.cells.setItem(line, column, item)
                    item.setText(depth_text(float(self._table.depths[patch, rows - 1 - line, column])))
        self._follow_theme()

    @Slot()
    def _follow_theme(self) -> None:
        """Fit cells and list to the size of the text."""
        theme = current_theme()
        self.cells.setFont(tabular_font(text_font(theme)))
        width = max(
            round(CELL_WIDTH * theme.text_px / 13), self.cells.fontMetrics().horizontalAdvance("0000")
        )
        height = max(self.cells.fontMetrics().height() + 6, LEAST_TARGET)
        self.cells.horizontalHeader().setDefaultSectionSize(width)
        self.cells.verticalHeader().setDefaultSectionSize(height)
        self.patches.setIconSize(QSize(theme.text_px, theme.text_px))
        self.patches.setFixedHeight(LIST_ROWS * height + 4)
        self.cells.setMinimumHeight(4 * height)

    @Slot(QTableWidgetItem)
    def _edited(self, item: QTableWidgetItem) -> None:
        if self._table is not None:
            row = self._table.size[1] - 1 - item.row()
            self.cell_edited.emit(self.current_patch(), row, item.column(), item.text())

    @Slot(QModelIndex, int, int, QModelIndex, int)
    def _dragged(self, _: QModelIndex, first: int, last: int, into: QModelIndex, before: int) -> None:
        self.patch_moved.emit(first, before - (before > last))

    @Slot()
    def _move_earlier(self) -> None:
        self.patch_moved.emit(self.current_patch(), self.current_patch() - 1)

    @Slot()
    def _move_later(self) -> None:
        self.patch_moved.emit(self.current_patch(), self.current_patch() + 1)

    @Slot()
    def _remove(self) -> None:
        self.patch_removed.emit(self.current_patch())

    @Slot(int)
    def _choose_test(self, index: int) -> None:
        self.test_chosen.emit(str(self.test_box.itemData(index)))

    @Slot()
    def _choose_size(self) -> None:
        wanted = self.columns.value(), self.rows.value()
        if self._table is not None and wanted != self._table.size:
            self.size_chosen.emit(*wanted)


def _swatch(color: QColor) -> QIcon:
    """Return a square of one colour."""
    square = QPixmap(16, 16)
    square.fill(color)
    return QIcon(square)
