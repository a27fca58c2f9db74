"""One cell of an atlas: what came of its run, its picture, and where it leads."""

from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QToolButton, QVBoxLayout, QWidget

from widgets.elided_label import ElidedLabel
from widgets.grid_buffer import GridBuffer
from widgets.linked_grids import LinkedGrids

Pixel = tuple[int, int]
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
    can_step: bool = False
    can_shrink: bool = False
    can_save: bool = False
    """Whether it has been made small: that is worth a file."""


class CaseView(QWidget):
    """Two linked grids under a heading and a verdict; tells what the user wants to do with the case."""

    step_requested = Signal()
    shrink_requested = Signal()
    save_requested = Signal()
    closing_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._record: CaseRecord | None = None
        self._pin: Pixel | None = None
        self._hover: Pixel | None = None
        self.heading = ElidedLabel(self)
        self.heading.setAccessibleName("Chosen cell")
        self.verdict = QLabel(self)
        self.verdict.setWordWrap(True)
        self.verdict.setAccessibleName("What came of it")
        self.verdict.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.linked = LinkedGrids(WORDS, self)
        self.values = QLabel(self)
        self.values.setProperty("role", "muted")
        self.step_button = self._button(
            "Open in the stepper",
            "Step this very run, at the pixel that is wrong (Enter on the cell, Ctrl+Return)",
        )
        self.shrink_button = self._button(
            "Shrink", "Make the scene as small as it can be and still fail in the same way (S)"
        )
        self.save_button = self._button("Save case…", "Save the small case as a scene, or as a Python test")
        self.close_button = QToolButton(self)
        self.close_button.setText("✕")
        self.close_button.setProperty("flat", True)
        self.close_button.setAccessibleName("Close the case")
        self.close_button.setToolTip("Close the case (Escape)")
        self.step_button.clicked.connect(self.step_requested)
        self.shrink_button.clicked.connect(self.shrink_requested)
        self.save_button.clicked.connect(self.save_requested)
        self.close_button.clicked.connect(self.closing_requested)
        self.linked.pixel_hovered.connect(self._hover_pixel)
        self.linked.pixel_left.connect(self._leave)
        self.linked.pixel_clicked.connect(self._pin_pixel)
        self._lay_out()

    def _button(self, text: str, tip: str) -> QPushButton:
        button = QPushButton(text, self)
        button.setToolTip(tip)
        return button

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(self.heading, 1)
        for button in (self.step_button, self.shrink_button, self.save_button, self.close_button):
            top.addWidget(button)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 4, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(top)
        layout.addWidget(self.verdict)
        layout.addWidget(self.linked, 1)
        layout.addWidget(self.values)

    @property
    def pin(self) -> Pixel | None:
        """The pixel that is pinned: where the run is wrong first, or another one that the user has clicked."""
        return self._pin

    def show_case(self, record: CaseRecord) -> None:
        """Show a case."""
        self._record, self._pin, self._hover = record, record.pixel, None
        self.heading.setText(record.heading)
        self.verdict.setText(record.verdict)
        self.linked.setVisible(record.buffers is not None)
        self.values.setVisible(record.buffers is not None)
        if record.buffers is None:
            self.linked.show_nothing()
        else:
            self.linked.show_buffers(record.buffers, WORDS)
        self.step_button.setEnabled(record.can_step)
        self.shrink_button.setVisible(not record.can_save)
        self.shrink_button.setEnabled(record.can_shrink)
        self.save_button.setVisible(record.can_save)
        self._show_pointing()

    def show_waiting(self, heading: str, text: str) -> None:
        """Say what is awaited, or why there is nothing; the grids stay to be seen, so that nothing jumps."""
        self.heading.setText(heading)
        self.verdict.setText(text)
        for button in (self.step_button, self.shrink_button, self.save_button):
            button.setEnabled(False)

    def _show_pointing(self) -> None:
        self.linked.show_pointing(self._pin, self._hover)
        buffers = None if self._record is None else self._record.buffers
        pixel = self._hover or self._pin
        if buffers is None or pixel is None:
            self.values.setText("" if buffers is None else "Point at a pixel to read its values.")
            return
        read = ", ".join(f"{buffer.label} {buffer.text_at(*pixel)}" for buffer in buffers)
        self.values.setText(f"pixel ({pixel[0]}, {pixel[1]}): {read}")

    @Slot(int, int)
    def _hover_pixel(self, column: int, row: int) -> None:
        self._hover = (column, row)
        self._show_pointing()

    @Slot()
    def _leave(self) -> None:
        self._hover = None
        self._show_pointing()

    @Slot(int, int)
    def _pin_pixel(self, column: int, row: int) -> None:
        self._pin = None if self._pin == (column, row) else (column, row)
        self._show_pointing()
