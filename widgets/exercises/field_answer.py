"""Numbers, vectors, matrices and tables: fields, with what was understood of each before it counts."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import column_layout
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.entry_grid import EntryGrid
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks, FieldForm, FieldMarks


class FieldAnswerView(AnswerView):
    """The fields of a `FieldForm`."""

    def __init__(self, form: FieldForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._form = form
        self.fields = EntryGrid(form.columns, form.labels, self)
        self.fields.setAccessibleName("Your answer")
        self.fields.field_edited.connect(self._edited)
        self.fields.field_entered.connect(self._tell)
        layout = column_layout(self, 4)
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

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Mark every field."""
        assert marks is None or isinstance(marks, FieldMarks)
        for row in range(len(self._form.labels)):
            for column in range(len(self._form.columns)):
                is_right = None if marks is None else (row, column) not in marks.wrong
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
        found = self._form.understand(0, text) if set(text) & set("/*(") else None
        self.fields.show_note(row, f"= {found.text}" if found is not None and found.is_readable else "")

    @Slot(int, int)
    def _tell(self, row: int, column: int) -> None:
        """Say how the text of a field is understood."""
        self._note(row)
        text = self.fields.text(row, column)
        if not text.strip():
            self.note_changed.emit("")
            return
        found = self._form.understand(column, text)
        name = self.fields.field(row, column).accessibleName()
        said = f"understood as {found.text}" if found.is_readable else found.text
        self.note_changed.emit(f"{name}: {said}" if name else said.capitalize())
