"""A listing that is typed: an editor, a wave where it cannot run, and why, while it is typed."""

from typing import Any

from PySide6.QtCore import QSize, Qt, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget

from core.records.cells import Form
from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.labels import text_label
from widgets.basics.theme import current_theme
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.inspector.listing_editor import ListingEditor

HOW = (
    "Type in the listing. Tab indents, Ctrl+Return checks, Esc leaves it; while it is checked, Esc ends that."
)
NAME = "Your listing"
FEWEST, MOST, SPARE = 6, 24, 2
"""Lines that the editor shows at least and at most, and those below the last one."""


class CodeAnswerView(AnswerView):
    """An editor with the listing as it is at first."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.editor = AnswerEditor(self)
        self.editor.setAccessibleName(NAME)
        self.editor.setAccessibleDescription(HOW)
        self.reset_button = button_with_tip("Reset", "Put back the listing as it was at first", self)
        self.reset_button.clicked.connect(self._reset)
        self.editor.text_typed.connect(self._typed)
        self.editor.left.connect(self._leave)
        self.editor.document().documentLayout().documentSizeChanged.connect(self.editor.updateGeometry)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW, self, role="muted", wraps=True))
        layout.addWidget(self.editor)
        buttons = row_layout(spacing=8)
        buttons.addWidget(self.reset_button)
        buttons.addStretch(1)
        layout.addLayout(buttons)
        self.show_given(None)

    def given(self) -> str:
        """Return the listing."""
        return self.editor.text

    def show_given(self, given: Any) -> None:
        """Show a listing; ``None``: as it is at first."""
        if given is not None and not isinstance(given, str):
            raise TypeError(f"expected a listing as text, got {type(given).__name__}")
        self.editor.show_text(self._form.start[0] if given is None else given)
        self._mark_changes()
        self.show_problem(None)

    def set_open(self, is_open: bool) -> None:
        """Take text, or only show it."""
        self.editor.setReadOnly(not is_open)
        self.reset_button.setEnabled(is_open)

    def show_problem(self, problem: tuple[int, int, str] | None) -> None:
        """Mark where the listing cannot run, and say why to those who do not see it."""
        self.editor.show_problem(None if problem is None else problem[:2])
        self.editor.setAccessibleDescription(HOW if problem is None else problem_text(problem))

    def _mark_changes(self) -> None:
        """Mark the lines that are not as they were at first."""
        first = self._form.start[0].split("\n")
        lines = self.editor.text.split("\n")
        changed = {number for number, line in enumerate(lines, 1) if line not in first}
        self.editor.show_changed_lines(frozenset(changed))

    @Slot()
    def _typed(self) -> None:
        self._mark_changes()
        self.answer_changed.emit()

    @Slot()
    def _reset(self) -> None:
        if self.editor.text != self._form.start[0]:
            self.show_given(None)
            self.note_changed.emit("")
            self.answer_changed.emit()

    @Slot()
    def _leave(self) -> None:
        """Give the keyboard to what comes next, and end a check that runs."""
        self.stop_requested.emit()
        self.reset_button.setFocus(Qt.FocusReason.TabFocusReason)


def problem_text(problem: tuple[int, int, str]) -> str:
    """Return where a listing cannot run, and why, as a sentence."""
    line, column, said = problem
    return f"Line {line}, column {column}: {said}{'' if said.endswith('?') else '.'}"


class AnswerEditor(ListingEditor):
    """An editor as high as its lines; Ctrl+Return is not its own."""

    def sizeHint(self) -> QSize:
        """Return the height of its lines."""
        # Lines that are too long for the editor are wrapped: they count as often.
        count = min(max(round(self.document().size().height()) + SPARE, FEWEST), MOST)
        return QSize(
            super().sizeHint().width(), count * self.fontMetrics().lineSpacing() + current_theme().text_px
        )

    def minimumSizeHint(self) -> QSize:
        """Return the height of its lines: the page scrolls, not the editor."""
        return QSize(super().minimumSizeHint().width(), self.sizeHint().height())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave Ctrl+Return to the page."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and event.modifiers():
            event.ignore()
        else:
            super().keyPressEvent(event)
