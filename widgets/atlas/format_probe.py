"""The precision dial: a pixel and its triangles in every number format, with bits, and where the decision flips."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Slot
from PySide6.QtGui import QColor, QFontDatabase, QIcon
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier

HEAD = (
    "Format",
    "Pixel covered",
    "Whole picture",
    "Triangle",
    "Decision",
    "Edge",
    "Value",
    "Exact",
    "Flipped by",
    "Bits of the value",
)
_BITS = HEAD.index("Bits of the value")
EXPLANATIONS = (
    "Number format of the coverage test",
    "Number of triangles that cover the pixel in this format; a tick marks the right number",
    "Pixels of the whole picture with a wrong cover count in this format: the count of a map's cell",
    "A triangle that decides this pixel",
    "The format's decision for this triangle and the pixel",
    "The edge that decides",
    "Edge function at the pixel's centre in this format",
    "The same in exact arithmetic, with unsnapped corners",
    "The first operation after which the decision stays wrong, even if all others were exact",
    "Bit pattern of the value",
)
"""What each column of `HEAD` says."""


@dataclass(frozen=True)
class DialRow:
    """What one format makes of the pixel and one triangle."""

    cells: tuple[str, ...]
    """One text for each of `HEAD`."""
    is_right: bool
    """Whether the decision on the triangle is."""
    is_count_right: bool | None
    """Whether the pixel is covered as often as it should; ``None``: not said in this row."""


class DialTable(QTableWidget):
    """Shows rows for each format; a wrong count has a cross, and a wrong decision is written in its colour."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, len(HEAD), parent)
        self._rows: tuple[DialRow, ...] = ()
        for column, (title, explanation) in enumerate(zip(HEAD, EXPLANATIONS, strict=True)):
            item = QTableWidgetItem(title)
            item.setToolTip(explanation)
            self.setHorizontalHeaderItem(column, item)
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
            for column, text in enumerate(row.cells):
                item = QTableWidgetItem(text)
                if column == 0 and row.is_count_right is not None:
                    mark = Mark.RIGHT if row.is_count_right else Mark.WRONG
                    item.setIcon(QIcon(mark_pixmap(mark, theme.text_px, self.devicePixelRatioF())))
                item.setToolTip(text)
                if column == _BITS:
                    item.setFont(bits_font)
                if not row.is_right:
                    item.setForeground(QColor(theme.bad))
                self.setItem(number, column, item)
        self.verticalHeader().setDefaultSectionSize(theme.text_px + 9)
        self.horizontalHeader().resizeSections(QHeaderView.ResizeMode.ResizeToContents)


class DialView(QWidget):
    """The table under a sentence that says which pixel and which triangles it is about."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sentence = text_label("", self, name="What the table is about", wraps=True, is_selectable=True)
        self.table = DialTable(self)
        column = column_layout(self, 4, margins=(0, 4, 0, 0))
        column.addWidget(self.sentence)
        column.addWidget(self.table, 1)

    @property
    def rows(self) -> tuple[DialRow, ...]:
        """What the table shows."""
        return self.table.rows

    def show_pixel(self, sentence: str, rows: Sequence[DialRow]) -> None:
        """Show what every format makes of a pixel."""
        self.sentence.setText(sentence)
        self.sentence.setVisible(bool(sentence))
        self.table.show_rows(rows)
