"""Break it: numbers changed by sliders and fields, corners dragged on the picture."""

from typing import Any

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QGridLayout, QLineEdit, QSlider, QWidget

from core.records.cells import Form, Lattice
from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.basics.typed_value import NumberEdit
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid

HOW = "Drag a slider, or type a number."
HOW_CORNERS = (
    "Drag a corner on the picture, or a slider, or type a number. On the picture the arrows move a corner and "
    "Space chooses the next one."
)


class DialAnswerView(AnswerView):
    """A slider and a field for every number."""

    uses_grid = True

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._dials = [cell for (cell,) in form.cells if isinstance(cell, Lattice)]
        self._refused: dict[int, str] = {}
        """Why the text of a field is not taken, by the number of its dial."""
        self.sliders: list[QSlider] = []
        self.fields: list[QLineEdit] = []
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW_CORNERS if form.corners else HOW, self, role="muted", wraps=True))
        rows = QGridLayout()
        rows.setHorizontalSpacing(8)
        for row, dial in enumerate(self._dials):
            slider, field = QSlider(Qt.Orientation.Horizontal, self), NumberEdit(self)
            slider.setRange(0, dial.count - 1)
            slider.setAccessibleName(dial.label)
            field.setAccessibleName(f"{dial.label} as a number")
            field.setAccessibleDescription(dial.values)
            field.setFixedWidth(field.fontMetrics().horizontalAdvance("-00000.0000") + 16)
            slider.valueChanged.connect(self._slid)
            field.textEdited.connect(self._type)
            field.editingFinished.connect(self._end_typing)
            for column, widget in enumerate((text_label(dial.label, self), slider, field)):
                rows.addWidget(widget, 2 * row, column)
            rows.addWidget(text_label(dial.values, self, role="muted", wraps=True), 2 * row + 1, 0, 1, 3)
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
        return [self._text(number) for number in range(len(self._dials))]

    def _text(self, number: int) -> str:
        dial = self._dials[number]
        return dial.typed(dial.value(self.sliders[number].value()))

    def _index(self, number: int, text: str) -> int:
        """Return the place of the value that a text means; ValueError with a sentence where it means none."""
        dial = self._dials[number]
        return dial.index(dial.read(text))

    def unread(self) -> str:
        """Say which text is not taken as a number, and why."""
        return next(iter(self._refused.values()), "")

    def show_given(self, given: Any) -> None:
        """Set the dials; ``None`` sets them to what they begin with."""
        for number, text in enumerate(given or self._form.start):
            self._set(number, self._index(number, text))
        self._show_corners()

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

    def _set(self, number: int, place: int, *, is_typed: bool = False) -> None:
        """Set one dial without a word; what ``is_typed`` stays as it is typed."""
        slider = self.sliders[number]
        slider.blockSignals(True)
        slider.setValue(place)
        slider.blockSignals(False)
        self._refused.pop(number, None)
        if not is_typed:
            self.fields[number].setText(self._text(number))

    def _show_corners(self) -> None:
        given = self.given()
        for number, corner in enumerate(self._form.corners):
            self._grid.place_point(number, corner.at(given))

    @Slot()
    def _slid(self) -> None:
        slider = self.sender()
        assert isinstance(slider, QSlider)
        self._change({self.sliders.index(slider): slider.value()})

    @Slot(str)
    def _type(self, text: str) -> None:
        """Take a number as it is typed; what means none stays in its field, and is not checked."""
        number = self._number_of_field()
        try:
            place = self._index(number, text)
        except ValueError as problem:
            said = self._refused[number] = str(problem)
            self.note_changed.emit(f"{said[:1].upper()}{said[1:]}.")
        else:
            self.note_changed.emit("")
            self._change({number: place}, is_typed=True)

    @Slot()
    def _end_typing(self) -> None:
        """Write a number that was taken as the dial writes it."""
        number = self._number_of_field()
        if number not in self._refused:
            self._set(number, self.sliders[number].value())

    def _number_of_field(self) -> int:
        field = self.sender()
        assert isinstance(field, QLineEdit)
        return self.fields.index(field)

    @Slot(int, float, float)
    def _moved(self, number: int, x: float, y: float) -> None:
        """Set the dials of a corner that was dragged."""
        corner = self._form.corners[number]
        values = ((corner.x, x), (corner.y, y))
        self._change({dial: self._dials[dial].nearest(value) for dial, value in values if dial is not None})

    @Slot(int, int, int, bool)
    def _nudged(self, number: int, across: int, up: int, is_whole: bool) -> None:
        """Set the dials of a corner one step on, or ten."""
        corner, reach = self._form.corners[number], 10 if is_whole else 1
        moves = ((corner.x, across), (corner.y, up))
        self._change(
            {dial: self.sliders[dial].value() + reach * move for dial, move in moves if dial is not None}
        )

    def _change(self, places: dict[int, int], *, is_typed: bool = False) -> None:
        for number, place in places.items():
            self._set(number, place, is_typed=is_typed)
        self._show_corners()
        if places:
            self.answer_changed.emit()
