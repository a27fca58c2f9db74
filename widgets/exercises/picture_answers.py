"""Answers on the picture: pixels marked, what is wrong pointed at, corners dragged until a method breaks."""

import re
from collections.abc import Collection
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, Slot
from PySide6.QtWidgets import QGridLayout, QLineEdit, QSlider, QWidget

from core.records.cells import Form, Lattice, Marks
from widgets.basics.controls import button_with_tip, column_layout, row_layout, text_label
from widgets.basics.typed_value import NumberEdit
from widgets.exercises.choice_answers import ChoiceAnswerView
from widgets.exercises.field_answers import EntryGrid
from widgets.exercises.mark_grid import NOTHING, AnswerView, MarkGrid
from widgets.exercises.records import Pixel

# Pixels marked on the picture; the same as a list of rows, with the same marks.


HOW_PIXELS = (
    "Click or drag on the picture. By keyboard: the arrows go to a pixel, Space marks it, and Shift with an arrow "
    "gives the next pixel the same mark."
)

LEGEND = {
    "right": "Tick: right.",
    "missing": "Square: missing.",
    "extra": "Cross: extra.",
    "double": "Two bars: double, another triangle or line has the pixel.",
}
"""By kind, what its mark means."""

_RUN = re.compile(r"\s*(\d{1,3})(?:\s*[-–]\s*(\d{1,3}))?\s*", re.ASCII)


class PixelAnswerView(AnswerView):
    """How many are marked, and the rows as text on request."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._marks: Marks | None = None
        self._is_open = True
        self._unread: dict[int, str] = {}
        """Why the text of a row means nothing, by the field's number."""
        self.how = text_label(HOW_PIXELS, self, role="muted", wraps=True)
        self.count = text_label("", self)
        self.clear_button = button_with_tip("Clear", f"Mark no {form.noun}", self)
        self.clear_button.clicked.connect(self._clear)
        self.rows_button = button_with_tip("Rows", "Show and type the marks row by row (Ctrl+L)", self)
        self.rows_button.setCheckable(True)
        self.rows_button.toggled.connect(self._show_rows)
        labels = tuple(str(row) for row in reversed(range(form.size[1])))
        self.rows = EntryGrid(("marked columns, as 3-7, 9", "found"), labels, self, read_only=(1,))
        self.rows.setAccessibleName(f"Marked {form.noun}, row by row")
        self.rows.hide()
        self.rows.field_edited.connect(self._type)
        layout = column_layout(self, 8)
        layout.addWidget(self.how)
        row = row_layout(spacing=8)
        for widget in (self.count, self.clear_button, self.rows_button):
            row.addWidget(widget)
        row.insertStretch(1)
        layout.addLayout(row)
        layout.addWidget(self.rows)
        grid.installEventFilter(self)
        grid.pixels_painted.connect(self._painted)
        grid.set_paintable(True)
        self._show()

    def given(self) -> list[list[int]]:
        """Return the marked pixels as [column, row]."""
        return [list(pixel) for pixel in sorted(self._grid.marked())]

    def unread(self) -> str:
        """Say which row means nothing."""
        return next(iter(self._unread.values()), "")

    def show_given(self, given: Any) -> None:
        """Mark pixels."""
        self._unread.clear()
        self._grid.show_marked(frozenset((column, row) for column, row in given or ()))
        self._show()

    def show_marks(self, marks: Marks | None) -> None:
        """Mark what is right on the picture and in the rows."""
        self._marks = marks
        self._grid.show_marks(marks)
        self._show_legend()
        self._show()

    def _show_legend(self) -> None:
        """Say how pixels are marked, or what the marks mean that are seen."""
        marks = {} if self._marks is None or self._grid.isHidden() else self._marks
        legend = " ".join(text for kind, text in LEGEND.items() if marks.get(kind))
        self.how.setText(HOW_PIXELS if self._marks is None else legend)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the picture, which is left for another one."""
        if event.type() in (QEvent.Type.ShowToParent, QEvent.Type.HideToParent):
            self._show_legend()
        return False

    def set_open(self, is_open: bool) -> None:
        """Take marks, or only show them."""
        self._is_open = is_open
        self._grid.set_paintable(is_open)
        self.clear_button.setEnabled(is_open)
        self._show()
        self.rows.set_open(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
        self._grid.removeEventFilter(self)
        self._grid.pixels_painted.disconnect(self._painted)
        self._grid.set_paintable(False)
        self._grid.show_marked(frozenset())

    def toggle_rows(self) -> None:
        """Show the rows, or fold them away."""
        self.rows_button.toggle()

    @Slot(object, bool)
    def _painted(self) -> None:
        self._forget_unread()
        self._show()
        self.answer_changed.emit()

    @Slot()
    def _clear(self) -> None:
        if self._grid.marked():
            self._grid.show_marked(NOTHING)
            self._painted()

    @Slot(bool)
    def _show_rows(self, is_shown: bool) -> None:
        self._forget_unread()
        self.rows.setVisible(is_shown)
        self._show()

    @Slot(int, int)
    def _type(self, number: int, column: int) -> None:
        """Mark the columns that are typed for a row."""
        row = self._form.size[1] - 1 - number
        try:
            columns = read_columns(self._form.size[0], self.rows.text(number, column))
        except ValueError as problem:
            self._unread[number] = f"row {row}: {problem}"
            self._tell_unread()
            return
        self._unread.pop(number, None)
        self._tell_unread()
        others = frozenset(pixel for pixel in self._grid.marked() if pixel[1] != row)
        self._grid.show_marked(others | frozenset((place, row) for place in columns))
        self._show(typed=number)
        self.answer_changed.emit()

    def _forget_unread(self) -> None:
        """Let the rows show what is marked, whatever was typed there."""
        if self._unread:
            self._unread.clear()
            self._tell_unread()

    def _tell_unread(self) -> None:
        unread = self.unread()
        self.note_changed.emit(f"{unread[:1].upper()}{unread[1:]}." if unread else "")

    def _show(self, typed: int = -1) -> None:
        """Show the count and the rows; the one that is being ``typed`` and those that mean nothing are left alone."""
        marked, noun = self._grid.marked(), self._form.noun
        said = f"{len(marked)} {noun[:-1] if len(marked) == 1 else noun}"
        self.count.setText(f"{said} marked" if self._is_open else said)
        if self.rows.isHidden():
            return
        for number in range(self._form.size[1]):
            row = self._form.size[1] - 1 - number
            if number != typed and number not in self._unread:
                self.rows.show_text(number, 0, columns_text(marked, row))
            self.rows.show_text(number, 1, "" if self._marks is None else found_text(self._marks, row))


def read_columns(columns: int, text: str) -> frozenset[int]:
    """Return the columns of a text such as ``3-7, 9``; ValueError where it means nothing."""
    found: set[int] = set()
    for part in text.split(",") if text.strip() else ():
        run = _RUN.fullmatch(part)
        if run is None:
            raise ValueError(f"expected columns such as 3-7, 9; got {part.strip()[:20]!a}")
        first, last = int(run[1]), int(run[2] or run[1])
        if first > last:
            raise ValueError(f"expected the smaller column first, got {part.strip()}")
        if last >= columns:
            raise ValueError(f"expected columns from 0 to {columns - 1}, got {part.strip()}")
        found.update(range(first, last + 1))
    return frozenset(found)


def columns_text(pixels: Collection[Pixel], row: int) -> str:
    """Return the columns of the pixels in a row, as ``3-7, 9``."""
    columns = sorted(column for column, its in pixels if its == row)
    runs: list[list[int]] = []
    for column in columns:
        if runs and column == runs[-1][1] + 1:
            runs[-1][1] = column
        else:
            runs.append([column, column])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def found_text(marks: Marks, row: int) -> str:
    """Return what a check found in a row, as ``right 3-7; missing 8``."""
    found = (
        (name, columns_text(marks.get(name, ()), row)) for name in ("right", "missing", "extra", "double")
    )
    return "; ".join(f"{name} {columns}" for name, columns in found if columns)


# What is wrong with a picture: pixels pointed at, and the name of the mistake.


class SpotAnswerView(AnswerView):
    """The marks on a picture, over the options."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.pixels = PixelAnswerView(form, grid, self)
        self.pixels.answer_changed.connect(self._changed)
        self.pixels.note_changed.connect(self.note_changed)
        self.choice = ChoiceAnswerView(form, grid, self)
        self.choice.answer_changed.connect(self._changed)
        self.choice.setVisible(bool(form.items))
        layout = column_layout(self, 8)
        layout.addWidget(self.pixels)
        if form.items:
            layout.addWidget(text_label("Which mistake made this picture?", self, wraps=True))
        layout.addWidget(self.choice)

    def given(self) -> dict[str, object]:
        """Return the pixels and the option."""
        return {"pixels": self.pixels.given(), "option": (self.choice.given() or [""])[0]}

    def unread(self) -> str:
        """Say which row of pixels means nothing."""
        return self.pixels.unread()

    def show_given(self, given: Any) -> None:
        """Mark pixels and choose an option."""
        self.pixels.show_given(given["pixels"] if given else None)
        self.choice.show_given([given["option"]] if given and given["option"] else None)

    def show_marks(self, marks: Marks | None) -> None:
        """Mark what is right on the picture and among the options."""
        self.choice.show_marks(marks)
        if marks is not None:
            marks = {name: [key for key in keys if isinstance(key, tuple)] for name, keys in marks.items()}
        self.pixels.show_marks(marks)

    def set_open(self, is_open: bool) -> None:
        """Take an answer, or only show it."""
        self.pixels.set_open(is_open)
        self.choice.set_open(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
        self.pixels.release()

    def toggle_rows(self) -> None:
        """Show the rows, or fold them away."""
        self.pixels.toggle_rows()

    @Slot()
    def _changed(self) -> None:
        self.answer_changed.emit()


# Break it: numbers changed by sliders and fields, corners dragged on the picture.


HOW_DIALS = "Drag a slider, or type a number."
HOW_CORNERS = (
    "Drag a corner on the picture, or a slider, or type a number. On the picture the arrows move a corner and "
    "Space chooses the next one."
)


class DialAnswerView(AnswerView):
    """A slider and a field for every number."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._dials = [cell for (cell,) in form.cells if isinstance(cell, Lattice)]
        self._refused: dict[int, str] = {}
        """Why the text of a field is not taken, by the number of its dial."""
        self.sliders: list[QSlider] = []
        self.fields: list[QLineEdit] = []
        layout = column_layout(self, 8)
        layout.addWidget(
            text_label(HOW_CORNERS if form.corners else HOW_DIALS, self, role="muted", wraps=True)
        )
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
