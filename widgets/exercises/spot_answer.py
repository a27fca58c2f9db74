"""What is wrong with a picture: pixels pointed at, and the name of the mistake."""

from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.choice_answer import ChoiceAnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.pixel_answer import PixelAnswerView
from widgets.exercises.records import AnswerMarks, ChoiceForm, ItemMarks, SpotForm, SpotMarks


class SpotAnswerView(AnswerView):
    """The marks on a picture, over the options."""

    uses_grid = True

    def __init__(self, form: SpotForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        grid.show_picture(form.picture)
        self.pixels = PixelAnswerView(form.pixels, grid, self)
        self.pixels.answer_changed.connect(self._changed)
        self.pixels.note_changed.connect(self.note_changed)
        self._options = form.options
        self.choice = ChoiceAnswerView(ChoiceForm(form.options, is_several=False), grid, self)
        self.choice.answer_changed.connect(self._changed)
        self.choice.setVisible(bool(form.options))
        layout = column_layout(self, 8)
        layout.addWidget(self.pixels)
        if form.options:
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

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Mark what is right on the picture and among the options."""
        assert marks is None or isinstance(marks, SpotMarks)
        self.pixels.show_marks(None if marks is None else marks.pixels)
        chosen = self.choice.given()
        if marks is None or marks.option is None or not chosen:
            self.choice.show_marks(None)
        else:
            place = frozenset({self._options.index(chosen[0])})
            self.choice.show_marks(ItemMarks(right=place) if marks.option else ItemMarks(wrong=place))

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
