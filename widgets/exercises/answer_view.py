"""What all forms of answers share, and which of them a type of answer has."""

from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QWidget

from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks


class AnswerView(QWidget):
    """A form: what is in it, and what a check found of it. Set by code, it emits nothing."""

    answer_changed = Signal()
    """The learner has changed the answer."""
    note_changed = Signal(str)
    """How what is being typed is understood; empty: nothing is to be said."""

    uses_grid = False
    """Whether it is answered on the picture."""

    def __init__(self, form: Any, grid: MarkGrid, parent: QWidget | None = None) -> None:
        """Make an empty form; ``grid`` is the picture beside it."""
        super().__init__(parent)
        del form, grid

    def given(self) -> object:
        """Return what is in the form, as an answer file has it."""
        raise NotImplementedError

    def unread(self) -> str:
        """Say what is typed but is not in the answer, and why; empty: nothing."""
        return ""

    def show_given(self, given: Any) -> None:
        """Fill the form with what was in it; ``None`` empties it."""
        raise NotImplementedError

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Mark what is right and what is not; ``None`` takes the marks away."""
        raise NotImplementedError

    def set_open(self, is_open: bool) -> None:
        """Take an answer, or only show it."""
        self.setEnabled(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""


def show_mark(label: QLabel, is_right: bool | None) -> None:
    """Show a tick, a cross, or nothing, with its word for who does not see it."""
    mark = {True: Mark.RIGHT, False: Mark.WRONG}.get(is_right)  # type: ignore[arg-type]
    label.clear()
    label.setAccessibleName(mark.value if mark else "")
    label.setToolTip(mark.value if mark else "")
    if mark is not None:
        label.setPixmap(mark_pixmap(mark, current_theme().text_px, label.devicePixelRatioF()))
