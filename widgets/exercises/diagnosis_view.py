"""A picture that another program drew, beside what makes it: the pixels that differ, and the mistakes by name."""

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QFrame, QPushButton, QScrollArea, QWidget

from widgets.basics.accessibility import announce
from widgets.basics.controls import (
    FlowLayout,
    button_with_tip,
    column_layout,
    row_layout,
    set_role,
    text_label,
)
from widgets.basics.panes import PaneSplitter
from widgets.exercises.records import DiagnosisRecord
from widgets.grid.layers import CellMark, MaskOverlay
from widgets.grid.pixel_grid import PixelGrid

TITLE = "Which mistake makes this picture?"


class DiagnosisView(QWidget):
    """Shows a `DiagnosisRecord`."""

    closed = Signal()
    open_requested = Signal()
    """Another picture is wanted."""
    run_requested = Signal(int)
    """The run of something that was found is wanted, by its place."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(TITLE)
        self.grid = PixelGrid(self)
        self.about = text_label("", self, role="muted", wraps=True)
        self.verdict = text_label("", self, wraps=True, is_selectable=True, name="Verdict")
        self._sentences: list[str] = []
        self.run_buttons: list[QPushButton] = []
        self.close_button = button_with_tip("Back to the question", "Close the picture (Escape)", self)
        self.close_button.clicked.connect(self.closed)
        self.open_button = button_with_tip(
            "Another picture…", "Open another picture of the same scene: an image, npz or CSV", self
        )
        self.open_button.clicked.connect(self.open_requested)
        self._found = QWidget(self)
        self._rows = column_layout(self._found, 8)
        content = QWidget(self)
        column = column_layout(content, 12, margins=(4, 4, 12, 8))
        for part in (
            text_label(TITLE, self, role="title", wraps=True),
            self.about,
            self.verdict,
            self._found,
        ):
            column.addWidget(part)
        column.addStretch(1)
        area = QScrollArea(self, widgetResizable=True)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(content)
        buttons = FlowLayout(spacing=8)
        for button in (self.open_button, self.close_button):
            buttons.addWidget(button)
        side = QWidget(self)
        left = column_layout(side, 8)
        left.addWidget(area, 1)
        left.addLayout(buttons)
        self.panes = PaneSplitter(Qt.Orientation.Horizontal, self)
        for pane, stretch in ((side, 2), (self.grid, 3)):
            self.panes.addWidget(pane)
            self.panes.setStretchFactor(self.panes.count() - 1, stretch)
        self.panes.setSizes([400, 600])
        column_layout(self).addWidget(self.panes)

    def show_diagnosis(self, record: DiagnosisRecord) -> None:
        """Show a picture and what was found of it."""
        self.about.setText(record.about)
        self.verdict.setText(record.verdict)
        set_role(self.verdict, "good" if record.is_right else "strong")
        self.grid.show_buffer(record.picture)
        self.grid.show_overlays((MaskOverlay("differs", CellMark.EXTRA, record.differing, title="differs"),))
        self.grid.fit()
        self._show_found(record)
        self._sentences = [record.verdict, *(each.sentence for each in record.found)]
        announce(self, self.spoken_text())

    def spoken_text(self) -> str:
        """Return what was found, as a screen reader says it."""
        return "\n".join(self._sentences)

    def _show_found(self, record: DiagnosisRecord) -> None:
        for row in self._found.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly):
            self._rows.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.run_buttons = []
        for number, each in enumerate(record.found):
            row = QWidget(self._found)
            layout = column_layout(row, 4)
            layout.addWidget(text_label(each.sentence, row, wraps=True, is_selectable=True))
            if each.has_run:
                button = button_with_tip(
                    "Show that run",
                    "Step the right run beside this one, from the first pixel that differs on",
                    row,
                )
                button.setAccessibleDescription(each.sentence)
                button.setProperty("number", number)
                button.clicked.connect(self._ask_run)
                line = row_layout()
                line.addWidget(button)
                line.addStretch(1)
                layout.addLayout(line)
                self.run_buttons.append(button)
            self._rows.addWidget(row)
            row.show()

    @Slot()
    def _ask_run(self) -> None:
        self.run_requested.emit(self.sender().property("number"))
