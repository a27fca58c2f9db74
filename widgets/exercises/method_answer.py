"""No more than needed: one method of each family, with what they cost together."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QComboBox, QGridLayout, QWidget

from core.records.cells import Form
from widgets.basics.choice_box import ChoiceBox
from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid


class MethodAnswerView(AnswerView):
    """A list of methods for every family."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.boxes: list[QComboBox] = []
        self.cost = text_label("", self, role="muted", wraps=True)
        rows = QGridLayout()
        rows.setHorizontalSpacing(8)
        for row, ((family,), names) in enumerate(zip(form.cells, form.names, strict=True)):
            box = ChoiceBox(self)
            box.setAccessibleName(family.label)
            # The longest method must not make the question wider than its column.
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
            box.setMinimumContentsLength(10)
            box.addItem("choose", "")
            for name, text in zip(names, family.options, strict=True):
                box.addItem(text, name)
            box.activated.connect(self._chosen)
            rows.addWidget(text_label(family.label, self), row, 0)
            rows.addWidget(box, row, 1)
            self.boxes.append(box)
        rows.setColumnStretch(1, 1)
        layout = column_layout(self, 8)
        layout.addLayout(rows)
        layout.addWidget(self.cost)
        self._show_cost()

    def given(self) -> dict[str, str]:
        """Return the methods by family; empty: none is chosen yet."""
        return {family: box.currentData() for family, box in zip(self._form.labels, self.boxes, strict=True)}

    def show_given(self, given: Any) -> None:
        """Choose methods."""
        for family, box in zip(self._form.labels, self.boxes, strict=True):
            box.setCurrentIndex(max(box.findData((given or {}).get(family, "")), 0))
        self._show_cost()

    def _show_cost(self) -> None:
        for box in self.boxes:
            box.setToolTip(box.currentText())  # The box may be too narrow for it.
        assert self._form.told is not None
        self.cost.setText(self._form.told(self.given()) if all(self.given().values()) else "")

    @Slot()
    def _chosen(self) -> None:
        self._show_cost()
        self.answer_changed.emit()
