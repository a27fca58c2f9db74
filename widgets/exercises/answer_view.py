"""What all forms of answers share."""

from typing import Any

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QLabel, QListWidget, QSizePolicy, QWidget

from core.records.cells import Form, Marks
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme
from widgets.exercises.mark_grid import MarkGrid


class AnswerView(QWidget):
    """A form: what is in it, and what a check found of it. Set by code, it emits nothing."""

    answer_changed = Signal()
    """The learner has changed the answer."""
    note_changed = Signal(str)
    """How what is being typed is understood; empty: nothing is to be said."""

    stop_requested = Signal()
    """A check of the answer that runs is to end."""

    uses_grid = False
    """Whether it is answered on the picture."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        """Make an empty form; ``grid`` is the picture beside it."""
        super().__init__(parent)
        self._form, self._grid = form, grid

    def given(self) -> object:
        """Return what is in the form, as an answer file has it."""
        raise NotImplementedError

    def unread(self) -> str:
        """Say what is typed but is not in the answer, and why; empty: nothing."""
        return ""

    def show_given(self, given: Any) -> None:
        """Fill the form with what was in it; ``None`` empties it."""
        raise NotImplementedError

    def show_problem(self, problem: tuple[int, int, str] | None) -> None:
        """Mark line and column, from 1, at which a listing cannot run; ``None``: it can."""

    def show_marks(self, marks: Marks | None) -> None:
        """Mark what is right and what is not; ``None`` takes the marks away. Where a run decides, words say it."""

    def set_open(self, is_open: bool) -> None:
        """Take an answer, or only show it."""
        self.setEnabled(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""


class ItemList(QListWidget):
    """Items with marks."""

    def fit_height(self, spare: int) -> None:
        """Be as high as all items and ``spare`` pixels."""
        self._spare = spare
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Return the height of all items, where it is to be that."""
        hint = super().sizeHint()
        if self.sizePolicy().verticalPolicy() != QSizePolicy.Policy.Fixed:
            return hint
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        return QSize(hint.width(), rows + 2 * self.frameWidth() + self._spare)

    def show_mark(self, row: int, mark: Mark | None, tip: str = "") -> None:
        """Mark an item; ``None`` takes the mark away."""
        side = current_theme().text_px
        self.setIconSize(QSize(side, side))
        icon = QIcon() if mark is None else QIcon(mark_pixmap(mark, side, self.devicePixelRatioF()))
        self.item(row).setIcon(icon)
        self.item(row).setToolTip(tip if mark is not None else "")


def show_mark(label: QLabel, is_right: bool | None) -> None:
    """Show a tick, a cross, or nothing, with its word for who does not see it."""
    mark = {True: Mark.RIGHT, False: Mark.WRONG}.get(is_right)  # type: ignore[arg-type]
    label.clear()
    label.setAccessibleName(mark.value if mark else "")
    label.setToolTip(mark.value if mark else "")
    if mark is not None:
        label.setPixmap(mark_pixmap(mark, current_theme().text_px, label.devicePixelRatioF()))
