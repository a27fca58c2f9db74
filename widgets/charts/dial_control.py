"""One dial of a study's work: a slider over the values that are usual, and a field for any between them."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QLabel, QSizePolicy, QSlider, QWidget

from core.explain.number_text import number_text
from widgets.basics.controls import row_layout
from widgets.basics.typed_value import TypedValue


@dataclass(frozen=True)
class DialChoice:
    """One dial with its present value."""

    name: str
    title: str
    unit: str
    values: tuple[float, ...]
    """The stops of the slider, rising."""
    value: float


class DialControl(QWidget):
    """A label, a slider and a typed value; whatever changes one changes the others."""

    value_chosen = Signal(str, float)
    """Name of the dial and the value that the user has chosen."""

    def __init__(self, dial: DialChoice, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._dial = dial
        unit = f" ({dial.unit})" if dial.unit else ""
        self.label = QLabel(f"{dial.title}{unit}", self)
        self.slider = QSlider(Qt.Orientation.Horizontal, self)
        self.slider.setRange(0, len(dial.values) - 1)
        self.slider.setPageStep(1)
        self.slider.setFixedWidth(112)
        self.slider.setAccessibleName(dial.title)
        self.field = TypedValue(dial.title, self, is_compact=True)
        self.field.set_range(dial.values[0], dial.values[-1])
        self.field.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        stops = ", ".join(number_text(value) for value in dial.values)
        self.setToolTip(f"{dial.title}{unit}: {stops}, or any value between them")
        row = row_layout(self, 4)
        for widget in (self.label, self.slider, self.field):
            row.addWidget(widget)
        self.show_value(dial.value)
        self.slider.valueChanged.connect(self._slide)
        self.field.value_committed.connect(self._choose)

    @property
    def dial(self) -> DialChoice:
        """What is shown."""
        return self._dial

    def show_value(self, value: float) -> None:
        """Show a value set by the program; the slider stands at the nearest stop."""
        self.slider.blockSignals(True)
        self.slider.setValue(int(np.argmin(np.abs(np.array(self._dial.values) - value))))
        self.slider.blockSignals(False)
        self.field.show_value(value)

    @Slot(int)
    def _slide(self, stop: int) -> None:
        self.field.show_value(self._dial.values[stop])
        self._choose(self._dial.values[stop])

    @Slot(float)
    def _choose(self, value: float) -> None:
        self.show_value(value)
        self.value_chosen.emit(self._dial.name, value)
