"""What is behind a point of a chart or a cell of a map: its pictures, and a pixel in every number format."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QColor, QFontDatabase, QIcon
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QScrollArea,
    QTableWidget,
    QTableWidgetItem,
    QTabWidget,
    QWidget,
)

from widgets.basics.controls import (
    ElidedLabel,
    FlowLayout,
    button_with_tip,
    column_layout,
    row_layout,
    text_label,
)
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.panes import PaneSplitter
from widgets.basics.theme import current_theme, theme_notifier
from widgets.grid.layers import GridBuffer
from widgets.grid.linked_grids import PinnedPictures, Pixel

# The pictures behind one or two points of a study, side by side with a linked cursor, and where they lead.


PICTURE_WORDS = ("Picture", "Reference", "Difference")
NO_PICTURES = ("What the method draws", "What an exact method draws", "Where they differ")
"""What comes where there is no picture yet."""


@dataclass(frozen=True, eq=False)
class PicturesRecord:
    """Three pictures of one size."""

    heading: str
    buffers: tuple[GridBuffer, GridBuffer, GridBuffer]
    titles: tuple[str, str, str]
    can_step: bool = False
    """Whether the run can be opened on the Step page."""
    can_diverge: bool = False
    """Whether there are two runs that may part ways."""


class StudyPictures(PinnedPictures):
    """Three linked grids under a heading; reports what the user wants to do with them."""

    divergence_requested = Signal()
    copy_requested = Signal()
    hint = "Point at a pixel to read its values; click it, or use the arrow keys, to pin one."

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(PICTURE_WORDS, "the pictures", parent)
        self.heading = ElidedLabel(self)
        self.step_button = button_with_tip(
            "Open in the stepper",
            "Step this run at the pinned pixel, or at its first error (Ctrl+Return)",
            self,
        )
        self.divergence_button = button_with_tip(
            "Step to first divergence",
            "Step both runs, A | B, at their first divergence (Ctrl+Shift+Return)",
            self,
        )
        self.copy_button = button_with_tip("Copy picture", "Put the three pictures on the clipboard", self)
        self.step_button.clicked.connect(self.step_requested)
        self.divergence_button.clicked.connect(self.divergence_requested)
        self.copy_button.clicked.connect(self.copy_requested)
        self._lay_out()

    def _lay_out(self) -> None:
        top = row_layout(spacing=8)
        top.addWidget(self.heading, 1)
        for button in (self.step_button, self.divergence_button, self.copy_button, self.close_button):
            top.addWidget(button)
        layout = column_layout(self, 4, margins=(0, 4, 0, 0))
        layout.addLayout(top)
        layout.addWidget(self.linked, 1)
        layout.addWidget(self.values)

    def show_pictures(self, record: PicturesRecord) -> None:
        """Show three pictures; a pin stays where it was if there is such a pixel."""
        self._buffers = record.buffers
        self.heading.setText(record.heading)
        self.linked.show_buffers(record.buffers, record.titles)
        shape = record.buffers[0].columns, record.buffers[0].rows
        if self._pin is not None and not (self._pin[0] < shape[0] and self._pin[1] < shape[1]):
            self._pin = None
        self._hover = None
        self._show_actions(record)
        self._show_pointing()

    def show_waiting(self, text: str) -> None:
        """Show no pictures and say what is awaited, or why there are none."""
        self._buffers = None
        self._hover = None
        self.heading.setText(text)
        self.linked.show_nothing(NO_PICTURES)
        self._show_actions(None)
        self._show_pointing()

    def show_busy(self, text: str) -> None:
        """Say what is being looked for, with the pictures left as they are."""
        self.heading.setText(text)
        self.divergence_button.setEnabled(False)

    def _show_actions(self, record: PicturesRecord | None) -> None:
        self.step_button.setEnabled(record is not None and record.can_step)
        self.divergence_button.setVisible(record is not None and record.can_diverge)
        self.divergence_button.setEnabled(record is not None and record.can_diverge)
        self.copy_button.setEnabled(record is not None)

    @Slot(int, int)
    def _pin_pixel(self, column: int, row: int) -> None:
        """Pin a pixel, or unpin it."""
        self._pin = None if self._pin == (column, row) else (column, row)
        self._show_pointing()


# The precision dial: a pixel and its triangles in every number format, with bits, and where the decision
# flips.


HEAD = (
    *("Format", "Pixel covered", "Whole picture", "Triangle", "Decision", "Edge", "Value", "Exact"),
    *("Flipped by", "Bits of the value"),
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


# One cell of an atlas: what came of its run, its picture, its pixel in every number format, and where it
# leads.


CASE_WORDS = ("Picture", "Times covered")


@dataclass(frozen=True, eq=False)
class CaseRecord:
    """What is known of one run."""

    heading: str
    """The method and the place."""
    verdict: str
    """What came of it, with the numbers."""
    buffers: tuple[GridBuffer, GridBuffer] | None = None
    """Its picture, and how often each pixel is covered; ``None``: it draws none."""
    pixel: Pixel | None = None
    """Where it is wrong first."""
    has_formats: bool = False
    """Whether its pixels can be tested in every number format."""
    can_step: bool = False
    can_shrink: bool = False
    can_save: bool = False
    """Whether it has been made small: that is worth a file."""


class CaseView(PinnedPictures):
    """Two linked grids under a heading and a verdict; reports what the user wants to do with the case."""

    shrink_requested = Signal()
    save_requested = Signal()
    pixel_pinned = Signal(int, int)
    """The user has pinned another pixel."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(CASE_WORDS, "the case", parent)
        self.heading = text_label("", self, name="Chosen cell", wraps=True)
        self.verdict = text_label("", self, name="Outcome", wraps=True, is_selectable=True)
        self.values.setWordWrap(True)
        self.formats = DialView(self)
        self.tabs = QTabWidget(self)
        self.step_button = button_with_tip(
            "Open in the stepper", "Step this run at the wrong pixel (Enter on the cell, Ctrl+Return)", self
        )
        self.shrink_button = button_with_tip(
            "Shrink", "Find the smallest scene that still fails in the same way (S)", self
        )
        self.save_button = button_with_tip(
            "Save case…", "Save the small case as a scene, or as a Python test", self
        )
        self.step_button.clicked.connect(self.step_requested)
        self.shrink_button.clicked.connect(self.shrink_requested)
        self.save_button.clicked.connect(self.save_requested)
        self._lay_out()

    def _lay_out(self) -> None:
        self.tabs.setDocumentMode(True)
        self.tabs.tabBar().setDrawBase(False)
        self.tabs.addTab(self.linked, "Pictures")
        self.tabs.addTab(self.formats, "Number formats")
        self.tabs.setCornerWidget(self.close_button)
        buttons = QWidget(self)
        flow = FlowLayout(buttons, 8)
        for button in (self.step_button, self.shrink_button, self.save_button):
            flow.addWidget(button)
        words = QWidget(self)
        column = column_layout(words, 8, margins=(0, 4, 0, 0))
        for widget in (self.heading, buttons, self.verdict, self.values):
            column.addWidget(widget)
        column.addStretch(1)
        scroll = QScrollArea(self, widgetResizable=True)
        scroll.setWidget(words)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setMinimumWidth(200)
        self.parts = PaneSplitter(Qt.Orientation.Horizontal, self)
        self.parts.addWidget(scroll)
        self.parts.addWidget(self.tabs)
        self.parts.setStretchFactor(1, 1)
        self.parts.setSizes([330, 660])
        layout = column_layout(self, margins=(0, 4, 0, 0))
        layout.addWidget(self.parts, 1)

    def show_case(self, record: CaseRecord) -> None:
        """Show a case."""
        self._buffers, self._pin, self._hover = record.buffers, record.pixel, None
        self.heading.setText(record.heading)
        self.verdict.setText(record.verdict)
        self.tabs.setTabEnabled(0, record.buffers is not None)
        self.tabs.setTabEnabled(1, record.has_formats)
        if record.buffers is None:
            self.linked.show_nothing()
        else:
            self.linked.show_buffers(record.buffers, CASE_WORDS)
        self.step_button.setEnabled(record.can_step)
        self.shrink_button.setVisible(not record.can_save)
        self.shrink_button.setEnabled(record.can_shrink)
        self.save_button.setVisible(record.can_save)
        self.save_button.setEnabled(record.can_save)
        self._show_pointing()

    def show_formats(self, sentence: str, rows: Sequence[DialRow]) -> None:
        """Show what every number format makes of the pinned pixel, and say which pixel that is."""
        self.formats.show_pixel(sentence, rows)

    def show_tab(self, name: str) -> None:
        """Show ``pictures`` or ``formats``."""
        self.tabs.setCurrentIndex(("pictures", "formats").index(name))

    def show_waiting(self, heading: str, text: str) -> None:
        """Say what is awaited, or why there is nothing; the grids stay to be seen, so that nothing jumps."""
        self.heading.setText(heading)
        self.verdict.setText(text)
        for button in (self.step_button, self.shrink_button, self.save_button):
            button.setEnabled(False)

    @Slot(int, int)
    def _pin_pixel(self, column: int, row: int) -> None:
        super()._pin_pixel(column, row)
        self.pixel_pinned.emit(column, row)
