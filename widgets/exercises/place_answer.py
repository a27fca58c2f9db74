"""Points placed on the picture, or typed as x and y."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.entry_grid import EntryGrid
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks, ItemMarks, PlaceForm

HOW = (
    "Click on the picture to place a point, and drag it. By keyboard: the arrows move it, with Shift by a pixel, Space "
    "chooses the next point."
)
FINE = 1 / 512
"""Pixels: less than any step of a point."""


class PlaceAnswerView(AnswerView):
    """x and y of every point beside the picture."""

    uses_grid = True

    def __init__(self, form: PlaceForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._form, self._grid = form, grid
        self.fields = EntryGrid(("x", "y"), form.names, self)
        self.fields.setAccessibleName("Places of the points")
        self.fields.field_edited.connect(self._edited)
        self.fields.field_entered.connect(self._tell)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW, self, role="muted", wraps=True))
        layout.addWidget(self.fields)
        grid.show_points(form.names)
        grid.set_paintable(True)
        grid.point_moved.connect(self._moved)
        grid.point_nudged.connect(self._nudged)

    def given(self) -> list[list[str]]:
        """Return x and y of every point as texts."""
        return self.fields.texts()

    def show_given(self, given: Any) -> None:
        """Place the points."""
        for number in range(len(self._form.names)):
            for axis in range(2):
                self.fields.show_text(number, axis, given[number][axis] if given else "")
            self._place(number)

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Mark every point on the picture and in the fields."""
        assert marks is None or isinstance(marks, ItemMarks)
        found = {} if marks is None else {n: n in marks.right for n in range(len(self._form.names))}
        self._grid.mark_points(found)
        for number in range(len(self._form.names)):
            self.fields.show_mark(number, 1, found.get(number))

    def set_open(self, is_open: bool) -> None:
        """Take places, or only show them."""
        self._grid.set_paintable(is_open)
        self.fields.set_open(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
        self._grid.point_moved.disconnect(self._moved)
        self._grid.point_nudged.disconnect(self._nudged)
        self._grid.set_paintable(False)
        self._grid.show_points(())

    def _place(self, number: int) -> None:
        """Put a point where its fields say."""
        x, y = (self._form.number(self.fields.text(number, axis)) for axis in range(2))
        self._grid.place_point(number, None if x is None or y is None else (x, y))

    @Slot(int, float, float)
    def _moved(self, number: int, x: float, y: float) -> None:
        for axis, value in enumerate((x, y)):
            self.fields.show_text(number, axis, self._form.snapped(value))
        self._place(number)
        self.answer_changed.emit()

    @Slot(int, int, int, bool)
    def _nudged(self, number: int, across: int, up: int, is_whole: bool) -> None:
        """Move a point to the next coordinate that it can have; one without a place begins in the middle."""
        now = [self._form.number(self.fields.text(number, axis)) for axis in range(2)]
        place = []
        for value, side, move in zip(now, self._form.size, (across, up), strict=True):
            start = side / 2 if value is None else value
            place.append(min(max(start + move if is_whole else self._next(start, move), 0.0), side))
        self._moved(number, *place)

    def _next(self, start: float, direction: int) -> float:
        """Return the next coordinate to one side."""
        here, there = self._form.snapped(start), start
        while direction and self._form.snapped(there) == here and abs(there - start) < 2:
            there += direction * FINE
        found = self._form.number(self._form.snapped(there))
        return start if found is None else found

    @Slot(int, int)
    def _edited(self, row: int, column: int) -> None:
        self._place(row)
        self._tell(row, column)
        self.answer_changed.emit()

    @Slot(int, int)
    def _tell(self, row: int, column: int) -> None:
        """Say how the text of a field is understood."""
        text = self.fields.text(row, column)
        found = self._form.understand(column, text) if text.strip() else None
        said = "" if found is None else f"understood as {found.text}" if found.is_readable else found.text
        name = self.fields.field(row, column).accessibleName()
        self.note_changed.emit(f"{name}: {said}" if said else "")
