"""The pictures behind one or two points of a study, side by side with a linked cursor, and where they lead."""

from dataclasses import dataclass

from PySide6.QtCore import Signal, Slot
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.labels import ElidedLabel
from widgets.grid.buffer import GridBuffer
from widgets.grid.linked_grids import PinnedPictures

WORDS = ("Picture", "Reference", "Difference")
EMPTY = ("What the method draws", "What an exact method draws", "Where they differ")
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
        super().__init__(WORDS, "the pictures", parent)
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
        self.linked.show_nothing(EMPTY)
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
