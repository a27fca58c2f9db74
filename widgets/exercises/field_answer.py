"""Numbers, vectors, matrices and tables: fields, with what was understood of each before it counts."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from core.records.cells import Form, Marks
from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.entry_grid import EntryGrid
from widgets.exercises.mark_grid import MarkGrid


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
