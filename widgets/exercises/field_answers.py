"""Answers that are typed: numbers, vectors, matrices and tables in rows of fields, and points by x and y."""

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QWidget

from core.records.cells import Form, Marks
from widgets.basics.accessibility import give_focus
from widgets.basics.controls import column_layout, text_label
from widgets.basics.typed_value import NumberEdit
from widgets.exercises.mark_grid import AnswerView, MarkGrid
from widgets.exercises.marked_items import show_mark

# Text fields in rows and columns with their heads: Tab, arrows and Return go from one to the next.


Cell = tuple[int, int]
"""Row and column of a field."""
WIDEST = 240
"""Pixels of a field that stands alone in its row."""
MANY = 12
"""Fields of a table of which is said how to leave it: Tab takes so many presses."""
KEYS = "Tab goes to the next cell, Return down. F6 leaves the table, Ctrl+Tab the page."
_RETURN = Qt.Key.Key_Return, Qt.Key.Key_Enter
_UPRIGHT = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, **dict.fromkeys(_RETURN, 1)}


class EntryGrid(QWidget):
    """The fields; ``row`` and ``column`` count from 0 at the top left."""

    field_edited = Signal(int, int)
    """Row and column of a field in which the user has typed."""
    field_entered = Signal(int, int)
    """Row and column of the field that has the keyboard now."""

    def __init__(
        self,
        columns: Sequence[str],
        labels: Sequence[str],
        parent: QWidget | None = None,
        read_only: Sequence[int] = (),
    ) -> None:
        """Make empty fields; ``read_only`` columns show what the program writes there."""
        super().__init__(parent)
        self._shape = len(labels), len(columns)
        self._fields: dict[Cell, QLineEdit] = {}
        self._marks: dict[Cell, QLabel] = {}
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setHorizontalSpacing(4)
        layout.setVerticalSpacing(4)
        for column, name in enumerate(columns):
            if name:
                layout.addWidget(text_label(name, self, role="muted"), 0, 1 + 2 * column)
            layout.setColumnStretch(1 + 2 * column, 4)
        for row, label in enumerate(labels):
            layout.addWidget(text_label(label, self), 1 + row, 0)
            for column, name in enumerate(columns):
                field = NumberEdit(self)
                field.setAccessibleName(" ".join(text for text in (name, label) if text) or "Answer")
                field.setReadOnly(column in read_only)
                field.setMaximumWidth(WIDEST if len(columns) == 1 else 16_777_215)
                field.setFocusPolicy(
                    Qt.FocusPolicy.NoFocus if column in read_only else Qt.FocusPolicy.StrongFocus
                )
                field.textEdited.connect(self._edited)
                field.installEventFilter(self)
                mark = QLabel(self)
                self._fields[row, column], self._marks[row, column] = field, mark
                layout.addWidget(field, 1 + row, 1 + 2 * column)
                layout.addWidget(mark, 1 + row, 2 + 2 * column)
        self._notes = [text_label("", self, role="muted") for _ in labels]
        for row, note in enumerate(self._notes):
            layout.addWidget(note, 1 + row, 1 + 2 * len(columns))
        layout.setColumnStretch(1 + 2 * len(columns), 4 if len(columns) == 1 else 1)
        if sum(not field.isReadOnly() for field in self._fields.values()) > MANY:
            keys = text_label(KEYS, self, role="muted", wraps=True)
            layout.addWidget(keys, 1 + len(labels), 0, 1, layout.columnCount())

    def text(self, row: int, column: int) -> str:
        """Return what is in a field."""
        return self._fields[row, column].text()

    def texts(self) -> list[list[str]]:
        """Return what is in all fields, row by row."""
        rows, columns = self._shape
        return [[self.text(row, column) for column in range(columns)] for row in range(rows)]

    def show_text(self, row: int, column: int, text: str) -> None:
        """Write into a field."""
        if self.text(row, column) != text:
            self._fields[row, column].setText(text)

    def show_mark(self, row: int, column: int, is_right: bool | None) -> None:
        """Mark a field as right or wrong; ``None`` takes the mark away."""
        show_mark(self._marks[row, column], is_right)
        word = {True: "right", False: "wrong", None: ""}[is_right]
        self._fields[row, column].setAccessibleDescription(word)

    def show_note(self, row: int, text: str) -> None:
        """Write behind a row how it is understood."""
        self._notes[row].setText(text)

    def set_open(self, is_open: bool) -> None:
        """Take text, or only show it."""
        for field in self._fields.values():
            if field.focusPolicy() != Qt.FocusPolicy.NoFocus:
                field.setReadOnly(not is_open)

    def field(self, row: int, column: int) -> QLineEdit:
        """Return a field."""
        return self._fields[row, column]

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Go to a neighbour by the arrows: to the sides only from the end of a text."""
        if event.type() == QEvent.Type.FocusIn:
            self.field_entered.emit(*self._cell(watched))
        if not isinstance(event, QKeyEvent) or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            return False
        move = self._move(watched, Qt.Key(event.key()))
        if move is None:
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        # Return in the last field is not this grid's: it checks the answer.
        return event.type() == QEvent.Type.KeyPress and (
            self._go(self._cell(watched), move) or event.key() not in _RETURN
        )

    def _cell(self, watched: QObject | None) -> Cell:
        return next(cell for cell, field in self._fields.items() if field is watched)

    def _move(self, watched: QObject, key: Qt.Key) -> Cell | None:
        """Return rows and columns to go by; ``None``: the key is the field's own."""
        if key in _UPRIGHT:
            return _UPRIGHT[key], 0
        if not isinstance(watched, QLineEdit) or watched.hasSelectedText():
            return None
        if key == Qt.Key.Key_Left and watched.cursorPosition() == 0:
            return 0, -1
        if key == Qt.Key.Key_Right and watched.cursorPosition() == len(watched.text()):
            return 0, 1
        return None

    def _go(self, cell: Cell, move: Cell) -> bool:
        """Go to a neighbour, from the last row down to the next column's first; return whether there is one."""
        row, column = cell[0] + move[0], cell[1] + move[1]
        if row >= self._shape[0]:
            row, column = 0, column + 1
        there = self._fields.get((row, column))
        has_neighbour = there is not None and there.focusPolicy() != Qt.FocusPolicy.NoFocus
        if there is not None and has_neighbour:
            give_focus(there)
        return has_neighbour

    @Slot()
    def _edited(self) -> None:
        self.field_edited.emit(*self._cell(self.sender()))


# Numbers, vectors, matrices and tables: fields, with what was understood of each before it counts.


class FieldAnswerView(AnswerView):
    """A field for each cell."""

    name = "Your answer"
    how = ""
    """How it is answered; empty: that is plain."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.fields = EntryGrid(form.columns, form.labels, self)
        self.fields.setAccessibleName(self.name)
        self.fields.field_edited.connect(self._edited)
        self.fields.field_entered.connect(self._tell)
        layout = column_layout(self, 8)
        if self.how:
            layout.addWidget(text_label(self.how, self, role="muted", wraps=True))
        layout.addWidget(self.fields)

    def given(self) -> list[list[str]]:
        """Return the texts, row by row."""
        return self.fields.texts()

    def show_given(self, given: Any) -> None:
        """Write texts into the fields."""
        for row in range(len(self._form.labels)):
            for column in range(len(self._form.columns)):
                self.fields.show_text(row, column, given[row][column] if given else "")
            self._note(row)

    def show_marks(self, marks: Marks | None) -> None:
        """Mark every field."""
        for row in range(len(self._form.labels)):
            for column in range(len(self._form.columns)):
                is_right = None if marks is None else (row, column) not in marks["wrong"]
                self.fields.show_mark(row, column, is_right)

    def set_open(self, is_open: bool) -> None:
        """Take text, or only show it."""
        self.fields.set_open(is_open)

    @Slot(int, int)
    def _edited(self, row: int, column: int) -> None:
        self._tell(row, column)
        self.answer_changed.emit()

    def _note(self, row: int) -> None:
        """Write behind a single field what a fraction or a root in it comes to."""
        if len(self._form.columns) > 1:
            return
        text = self.fields.text(row, 0).strip()
        understood, is_read = self._understood(row, 0) if set(text) & set("/*(") else ("", False)
        self.fields.show_note(row, f"= {understood}" if is_read else "")

    def _understood(self, row: int, column: int) -> tuple[str, bool]:
        """Return how the text of a field is understood, or why it means nothing, and whether it means something."""
        try:
            return self._form.cells[row][column].understood(self.fields.text(row, column)), True
        except ValueError as problem:
            return str(problem), False

    @Slot(int, int)
    def _tell(self, row: int, column: int) -> None:
        """Say how the text of a field is understood."""
        self._note(row)
        if not self.fields.text(row, column).strip():
            self.note_changed.emit("")
            return
        understood, is_read = self._understood(row, column)
        name = self.fields.field(row, column).accessibleName()
        said = f"understood as {understood}" if is_read else understood
        self.note_changed.emit(f"{name}: {said}" if name else said.capitalize())


# Points placed on the picture, or typed as x and y.


FINE = 1 / 512
"""Pixels: less than any step of a point."""


class PlaceAnswerView(FieldAnswerView):
    """x and y of every point beside the picture."""

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
