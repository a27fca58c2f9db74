"""Break it: numbers changed by sliders and fields, corners dragged on the picture."""

from typing import Any

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QGridLayout, QLineEdit, QSlider, QWidget

from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks, DialForm

HOW = (
    "Drag a corner on the picture, or a slider, or type a number. On the picture the arrows move a corner and "
    "Space chooses the next one."
)


class DialAnswerView(AnswerView):
    """A slider and a field for every number."""

    uses_grid = True

    def __init__(self, form: DialForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._form, self._grid = form, grid
        self.sliders: list[QSlider] = []
        self.fields: list[QLineEdit] = []
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW, self, role="muted", wraps=True))
        rows = QGridLayout()
        rows.setHorizontalSpacing(8)
        for row, dial in enumerate(form.dials):
            slider, field = QSlider(Qt.Orientation.Horizontal, self), QLineEdit(self)
            slider.setRange(0, dial.count - 1)
            slider.setAccessibleName(dial.name)
            field.setAccessibleName(f"{dial.name} as a number")
            field.setFixedWidth(field.fontMetrics().horizontalAdvance("-00000.0000") + 16)
            slider.valueChanged.connect(self._slid)
            field.editingFinished.connect(self._typed)
            for column, widget in enumerate((text_label(dial.name, self), slider, field)):
                rows.addWidget(widget, row, column)
            self.sliders.append(slider)
            self.fields.append(field)
        layout.addLayout(rows)
        grid.show_points(tuple(corner.name for corner in form.corners))
        grid.set_paintable(bool(form.corners))
        grid.point_moved.connect(self._moved)
        grid.point_nudged.connect(self._nudged)
        self.show_given(None)

    def given(self) -> list[str]:
        """Return the numbers as texts."""
        return [
            dial.text(slider.value()) for dial, slider in zip(self._form.dials, self.sliders, strict=True)
        ]

    def show_given(self, given: Any) -> None:
        """Set the dials; ``None`` sets them to what they begin with."""
        for number, text in enumerate(given or self._form.start):
            place = self._form.dials[number].place(text)
            self._set(number, 0 if place is None else place)
        self._show_corners()

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Do nothing: runs decide, and words say what came of them."""

    def release(self) -> None:
        """Leave the picture to the next form."""
        self._grid.point_moved.disconnect(self._moved)
        self._grid.point_nudged.disconnect(self._nudged)
        self._grid.set_paintable(False)
        self._grid.show_points(())

    def set_open(self, is_open: bool) -> None:
        """Take numbers, or only show them."""
        super().set_open(is_open)
        self._grid.set_paintable(is_open and bool(self._form.corners))

    def _set(self, number: int, place: int) -> None:
        """Set one dial without a word."""
        slider = self.sliders[number]
        slider.blockSignals(True)
        slider.setValue(place)
        slider.blockSignals(False)
        self.fields[number].setText(self._form.dials[number].text(slider.value()))

    def _show_corners(self) -> None:
        given = self.given()
        for number, corner in enumerate(self._form.corners):
            self._grid.place_point(number, corner.at(given))

    @Slot()
    def _slid(self) -> None:
        slider = self.sender()
        assert isinstance(slider, QSlider)
        self._change({self.sliders.index(slider): slider.value()})

    @Slot()
    def _typed(self) -> None:
        field = self.sender()
        assert isinstance(field, QLineEdit)
        number = self.fields.index(field)
        dial = self._form.dials[number]
        place = dial.place(field.text())
        if place is None:
            low, high = dial.text(0), dial.text(dial.count - 1)
            self.note_changed.emit(
                f"{dial.name}: expected a step from {low} to {high}, got {field.text()[:20]!r}."
            )
            self._set(number, self.sliders[number].value())
        elif place != self.sliders[number].value():
            self.note_changed.emit("")
            self._change({number: place})

    @Slot(int, float, float)
    def _moved(self, number: int, x: float, y: float) -> None:
        """Set the dials of a corner that was dragged."""
        corner = self._form.corners[number]
        changed = {}
        for dial, value in ((corner.x, x), (corner.y, y)):
            place = None if dial is None else self._form.dials[dial].place(self._form.snapped(dial, value))
            if dial is not None and place is not None:
                changed[dial] = place
        self._change(changed)

    @Slot(int, int, int, bool)
    def _nudged(self, number: int, across: int, up: int, is_whole: bool) -> None:
        """Set the dials of a corner one step on, or ten."""
        corner, reach = self._form.corners[number], 10 if is_whole else 1
        moves = ((corner.x, across), (corner.y, up))
        self._change(
            {dial: self.sliders[dial].value() + reach * move for dial, move in moves if dial is not None}
        )

    def _change(self, places: dict[int, int]) -> None:
        before = self.given()
        for number, place in places.items():
            self._set(number, place)
        self._show_corners()
        if self.given() != before or places:
            self.answer_changed.emit()
