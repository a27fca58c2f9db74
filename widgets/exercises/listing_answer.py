"""The wrong line of a listing, pointed at."""

from typing import Any

from PySide6.QtCore import QSize, Qt, Slot
from PySide6.QtGui import QFontDatabase, QIcon
from PySide6.QtWidgets import QListWidget, QSizePolicy, QWidget

from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks, ItemMarks, ListingForm

HOW = "Choose the line: click it, or go with the arrows."


class ListingAnswerView(AnswerView):
    """Numbered lines, of which one is chosen."""

    def __init__(self, form: ListingForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.list = _Lines(self)
        self.list.setAccessibleName("Lines of the listing")
        for number, line in enumerate(form.lines, 1):
            self.list.addItem(f"{number:>2}  {line}")
            self.list.item(number - 1).setData(
                Qt.ItemDataRole.AccessibleTextRole, f"line {number}: {line.strip()}"
            )
        # Not the current line: Qt makes the first one that as soon as the list has the keyboard.
        self.list.itemSelectionChanged.connect(self._chosen)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW, self, role="muted", wraps=True))
        layout.addWidget(self.list)

    def given(self) -> str:
        """Return the number of the line, from 1; empty: none is chosen."""
        rows = [self.list.row(item) for item in self.list.selectedItems()]
        return str(rows[0] + 1) if rows else ""

    def show_given(self, given: Any) -> None:
        """Choose a line."""
        self.list.blockSignals(True)
        self.list.clearSelection()
        if given:
            self.list.setCurrentRow(int(given) - 1)
        self.list.blockSignals(False)

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Mark the chosen line."""
        assert marks is None or isinstance(marks, ItemMarks)
        side = current_theme().text_px
        self.list.setIconSize(QSize(side, side))
        for row in range(self.list.count()):
            kinds = [] if marks is None else [row in marks.right, row in marks.wrong]
            mark = Mark.RIGHT if any(kinds[:1]) else Mark.WRONG if any(kinds) else None
            item = self.list.item(row)
            item.setIcon(QIcon(mark_pixmap(mark, side, self.devicePixelRatioF())) if mark else QIcon())
            item.setToolTip(
                "" if mark is None else "the wrong line" if mark is Mark.RIGHT else "as it should be"
            )

    @Slot()
    def _chosen(self) -> None:
        self.answer_changed.emit()


class _Lines(QListWidget):
    """A list as high as its lines, in the type of listings."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setTextElideMode(Qt.TextElideMode.ElideNone)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    def sizeHint(self) -> QSize:
        """Return the height of all lines, and of the bar below long ones."""
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        return QSize(super().sizeHint().width(), rows + 2 * self.frameWidth() + 16)

    @Slot()
    def _follow_theme(self) -> None:
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPixelSize(current_theme().code_px)
        self.setFont(font)
