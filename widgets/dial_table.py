"""The precision dial: one triangle and one pixel in every number format, with bits, and where the decision flips."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Slot
from PySide6.QtGui import QColor, QFontDatabase, QIcon
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from widgets.marks import Mark, mark_pixmap
from widgets.theme import current_theme, theme_notifier

HEAD = ("Format", "Pixel is", "Edge", "Value", "Exact", "Flipped by", "Bits of the value")
_BITS = HEAD.index("Bits of the value")


@dataclass(frozen=True)
class DialRow:
    """What one format makes of the pixel."""

    cells: tuple[str, ...]
    """One text for each of `HEAD`."""
    is_right: bool


class DialTable(QTableWidget):
    """Shows one row for each format, the weakest first; a wrong decision has a cross and is written in its colour."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, len(HEAD), parent)
        self._rows: tuple[DialRow, ...] = ()
        self.setHorizontalHeaderLabels(list(HEAD))
        self.setAccessibleName("The pixel in every number format")
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setAlternatingRowColors(True)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.verticalHeader().hide()
        self.horizontalHeader().setStretchLastSection(True)
        self.horizontalHeader().setDefaultAlignment(
            Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        )
        theme_notifier().theme_changed.connect(self._rebuild)

    def show_rows(self, rows: Sequence[DialRow]) -> None:
        """Show what every format makes of the pixel."""
        self._rows = tuple(rows)
        self._rebuild()

    @property
    def rows(self) -> tuple[DialRow, ...]:
        """What is shown."""
        return self._rows

    @Slot()
    def _rebuild(self) -> None:
        theme = current_theme()
        bits_font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        bits_font.setPixelSize(theme.text_px - 1)
        self.setRowCount(len(self._rows))
        for number, row in enumerate(self._rows):
            mark = Mark.RIGHT if row.is_right else Mark.WRONG
            icon = QIcon(mark_pixmap(mark, theme.text_px, self.devicePixelRatioF()))
            for column, text in enumerate(row.cells):
                item = QTableWidgetItem(text)
                if column == 0:
                    item.setIcon(icon)
                item.setToolTip(text)
                if column == _BITS:
                    item.setFont(bits_font)
                if not row.is_right:
                    item.setForeground(QColor(theme.bad))
                self.setItem(number, column, item)
        self.verticalHeader().setDefaultSectionSize(theme.text_px + 9)
        self.horizontalHeader().resizeSections(QHeaderView.ResizeMode.ResizeToContents)
