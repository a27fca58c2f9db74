"""What is wrong with a picture: pixels pointed at, and the name of the mistake."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from core.records.cells import Form, Marks
from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.choice_answer import ChoiceAnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.pixel_answer import PixelAnswerView


class SpotAnswerView(AnswerView):
    """The marks on a picture, over the options."""

    uses_grid = True

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
