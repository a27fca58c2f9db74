"""One cell of an atlas: what came of its run, its picture, its pixel in every number format, and where it leads."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QScrollArea, QTabWidget, QWidget

from widgets.atlas.format_probe import DialRow, DialView
from widgets.basics.controls import button_with_tip, column_layout
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import text_label
from widgets.basics.pane_splitter import PaneSplitter
from widgets.grid.buffer import GridBuffer
from widgets.grid.linked_grids import PinnedPictures, Pixel

WORDS = ("Picture", "Times covered")


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
        super().__init__(WORDS, "the case", parent)
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
        scroll = QScrollArea(self)
        scroll.setWidget(words)
        scroll.setWidgetResizable(True)
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
            self.linked.show_buffers(record.buffers, WORDS)
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
