"""A | B | difference: two settings on the same input, three linked grids."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QLabel, QPushButton, QWidget

from widgets.basics.controls import column_layout, row_layout
from widgets.basics.settings_panel import ChoiceBox, Setting
from widgets.grid.buffer import GridBuffer
from widgets.grid.geometry import GridGeometry
from widgets.grid.linked_grids import LinkedGrids
from widgets.grid.overlay import Overlay


@dataclass(frozen=True, eq=False)
class Comparison:
    """What the three grids show."""

    first: GridBuffer
    second: GridBuffer
    difference: GridBuffer
    first_title: str
    second_title: str
    summary: str
    """How much they differ, in words."""
    marks: tuple[Overlay, ...] = ()
    """Overlays on the difference."""


class CompareView(QWidget):
    """Three linked grids; what B does otherwise is chosen above them."""

    pixel_hovered = Signal(int, int)
    pixel_left = Signal()
    pixel_clicked = Signal(int, int)
    setting_chosen = Signal(str, str)
    """The user has chosen another value for B: family and value."""
    buffer_chosen = Signal(str)
    """The user wants to compare another buffer."""
    reset_requested = Signal()
    """The user wants B to be like A again."""
    swap_requested = Signal()
    """The user wants A to become B and B to become A."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.figure = QWidget(self)
        """The pictures with what is said of them, without the choices: what is exported and copied."""
        self.figure.setAccessibleName("A, B and difference")
        self.linked = LinkedGrids(("A", "B", "Difference"), self.figure)
        self.grids, self.titles = self.linked.grids, self.linked.titles
        self.buffer_box, self.family_box, self.value_box = (ChoiceBox(self) for _ in range(3))
        self.summary = QLabel(self.figure)
        self._settings: tuple[Setting, ...] = ()
        self.linked.pixel_hovered.connect(self.pixel_hovered)
        self.linked.pixel_left.connect(self.pixel_left)
        self.linked.pixel_clicked.connect(self.pixel_clicked)
        for box, name, tip in (
            (self.buffer_box, "Buffer", "Which buffer is compared"),
            (self.family_box, "Family of B", "The family in which B differs from A"),
            (self.value_box, "Method of B", "The method that B uses"),
        ):
            box.setAccessibleName(name)
            box.setToolTip(tip)
        self.buffer_box.activated.connect(self._choose_buffer)
        self.family_box.activated.connect(self._show_values)
        self.value_box.activated.connect(self._choose_value)
        self._lay_out()

    def _lay_out(self) -> None:
        reset, swap = QPushButton("B = A", self), QPushButton("Swap", self)
        reset.setToolTip("Give B the settings of A")
        swap.setToolTip("Swap the settings of A and B")
        reset.clicked.connect(self.reset_requested)
        swap.clicked.connect(self.swap_requested)
        row = row_layout(spacing=8)
        for widget in (
            QLabel("Compare", self),
            self.buffer_box,
            QLabel("B:", self),
            self.family_box,
            self.value_box,
        ):
            row.addWidget(widget)
        row.addWidget(reset)
        row.addWidget(swap)
        row.addStretch(1)
        layout = column_layout(self, 8, margins=(0, 4, 0, 0))
        layout.addLayout(row)
        layout.addWidget(self.figure, 1)
        figure = column_layout(self.figure, 8)
        figure.addWidget(self.linked, 1)
        figure.addWidget(self.summary)

    def show_buffers(self, names: Sequence[tuple[str, str]], current: str) -> None:
        """Offer buffers (name, title) for comparison."""
        if [self.buffer_box.itemData(k) for k in range(self.buffer_box.count())] != [
            name for name, _ in names
        ]:
            self.buffer_box.clear()
            for name, title in names:
                self.buffer_box.addItem(title, name)
        self.buffer_box.setCurrentIndex(self.buffer_box.findData(current))

    def show_settings(self, settings: Sequence[Setting]) -> None:
        """Show the settings of B."""
        family = self.family_box.currentData()
        self._settings = tuple(settings)
        self.family_box.clear()
        for setting in settings:
            self.family_box.addItem(setting.label, setting.family)
        self.family_box.setCurrentIndex(max(self.family_box.findData(family), 0))
        self._show_values()

    def show_family(self, family: str) -> None:
        """Bring a family to the choice."""
        self.family_box.setCurrentIndex(max(self.family_box.findData(family), 0))
        self._show_values()

    def show_comparison(self, comparison: Comparison) -> None:
        """Show both pictures and their difference."""
        buffers = (comparison.first, comparison.second, comparison.difference)
        name = self.buffer_box.currentText().lower()
        titles = (
            comparison.first_title,
            comparison.second_title,
            f"Difference, {name}" if name else "Difference",
        )
        self.linked.show_buffers(buffers, titles)
        self.grids[2].show_overlays(comparison.marks)
        self.summary.setText(comparison.summary)

    def show_refusal(self, text: str) -> None:
        """Show no pictures, and why."""
        self.linked.show_nothing()
        self.summary.setText(text)

    def set_pixel_center(self, pixel_center: str) -> None:
        """Say where the centres of pixels lie, as ``PixelGrid.set_pixel_center``."""
        self.linked.set_pixel_center(pixel_center)

    def show_geometry(self, geometry: GridGeometry | None) -> None:
        """Show the triangles in all grids."""
        self.linked.show_geometry(geometry)

    def show_pointing(self, pin: tuple[int, int] | None, hover: tuple[int, int] | None) -> None:
        """Mark pin and hover in all grids."""
        self.linked.show_pointing(pin, hover)

    @Slot()
    def _show_values(self) -> None:
        setting = next((s for s in self._settings if s.family == self.family_box.currentData()), None)
        self.value_box.clear()
        if setting is None:
            return
        for choice in setting.choices:
            self.value_box.addItem(choice.label, choice.value)
            tip = choice.refusal or choice.tooltip
            self.value_box.setItemData(self.value_box.count() - 1, tip, Qt.ItemDataRole.ToolTipRole)
        self.value_box.setCurrentIndex(self.value_box.findData(setting.current))

    @Slot()
    def _choose_value(self) -> None:
        self.setting_chosen.emit(self.family_box.currentData(), self.value_box.currentData())

    @Slot()
    def _choose_buffer(self) -> None:
        self.buffer_chosen.emit(self.buffer_box.currentData())
