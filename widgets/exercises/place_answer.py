"""Points placed on the picture, or typed as x and y."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from core.records.cells import Form, Marks
from widgets.exercises.field_answer import FieldAnswerView
from widgets.exercises.mark_grid import MarkGrid

FINE = 1 / 512
"""Pixels: less than any step of a point."""


class PlaceAnswerView(FieldAnswerView):
    """x and y of every point beside the picture."""

    uses_grid = True
    name = "Places of the points"
    how = (
        "Click on the picture to place a point, and drag it. By keyboard: the arrows move it, with Shift by a pixel, "
        "Space chooses the next point."
    )

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        grid.show_points(form.labels)
        grid.set_paintable(True)
        grid.point_moved.connect(self._moved)
        grid.point_nudged.connect(self._nudged)

    def show_given(self, given: Any) -> None:
        """Place the points."""
        super().show_given(given)
        for number in range(len(self._form.labels)):
            self._place(number)

    def show_marks(self, marks: Marks | None) -> None:
        """Mark every point on the picture and in the fields."""
        found = {} if marks is None else {n: n in marks["right"] for n in range(len(self._form.labels))}
        self._grid.mark_points(found)
        for number in range(len(self._form.labels)):
            self.fields.show_mark(number, 1, found.get(number))

    def set_open(self, is_open: bool) -> None:
        """Take places, or only show them."""
        super().set_open(is_open)
        self._grid.set_paintable(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
        self._grid.point_moved.disconnect(self._moved)
        self._grid.point_nudged.disconnect(self._nudged)
        self._grid.set_paintable(False)
        self._grid.show_points(())

    def _number(self, row: int, axis: int) -> float | None:
        """Return the coordinate that a field says; ``None``: it says none."""
        try:
            return float(self._form.cells[row][axis].read(self.fields.text(row, axis)))
        except ValueError:
            return None

    def _place(self, number: int) -> None:
        """Put a point where its fields say."""
        x, y = (self._number(number, axis) for axis in range(2))
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
        place = []
        for axis, (side, move) in enumerate(zip(self._form.size, (across, up), strict=True)):
            value = self._number(number, axis)
            start = side / 2 if value is None else value
            place.append(min(max(start + move if is_whole else self._next(start, move), 0.0), side))
        self._moved(number, *place)

    def _next(self, start: float, direction: int) -> float:
        """Return the next coordinate to one side."""
        here, there = self._form.snapped(start), start
        while direction and self._form.snapped(there) == here and abs(there - start) < 2:
            there += direction * FINE
        return float(self._form.cells[0][0].read(self._form.snapped(there)))

    @Slot(int, int)
    def _edited(self, row: int, column: int) -> None:
        self._place(row)
        super()._edited(row, column)
