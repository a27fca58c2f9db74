"""A question: its text and numbers, the form of its answer, hints, what a check found, and what to do next."""

import re
from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QFont, QFontDatabase
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QScrollArea, QSizePolicy, QWidget

from core.records.cells import Form
from widgets.basics.accessible import announce
from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import set_role, text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.answer_forms import make_view
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import Feedback, QuestionRecord
from widgets.exercises.sketch_view import SketchView

MODEL_TIP = "Show the right answer; before a check this ends the variant without points (Ctrl+M)"
_ART = re.compile(r"^[.#?A-Z]{4,}$", re.MULTILINE)
WIDEST = 720
"""Pixels of a line of text at a size of 13: longer ones are hard to read."""


class QuestionView(QWidget):
    """Shows a `QuestionRecord` with the form for its answer; what is to be done is asked for by signals."""

    check_requested = Signal()
    hint_requested = Signal()
    variant_requested = Signal()
    again_requested = Signal()
    twin_requested = Signal()
    model_requested = Signal()
    step_requested = Signal()
    copy_requested = Signal()
    list_requested = Signal()
    """The list of exercises is to be unfolded, or folded away."""

    def __init__(self, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._grid = grid
        self._feedback: Feedback | None = None
        self._has_art = False
        """Whether the numbers hold a picture as text, whose columns must line up."""
        self.answer: AnswerView | None = None
        self.setAccessibleName("Question")
        self.list_button = self._button("All exercises", "Unfold the list of exercises, or fold it away")
        self.list_button.setCheckable(True)
        self.list_button.hide()
        self.title = text_label("", self, role="title", wraps=True)
        self.mark = text_label(
            "", self, role="muted", wraps=True, is_selectable=True, name="Line that gives this question again"
        )
        self.copy_button = self._button(
            "Copy line", "Copy the line that gives this question to anybody", flat=True
        )
        self.text, self.given, self.credit = (
            text_label("", self, role=role, wraps=True, is_selectable=True)
            for role in ("", "strong", "muted")
        )
        self.sketch = SketchView(self)
        self.note = text_label("", self, role="muted", wraps=True)
        self.hints = text_label("", self, wraps=True, is_selectable=True, name="Hints")
        self.check_button = self._button("Check", "Check the answer (Return)")
        self.check_button.setProperty("role", "primary")
        self.hint_button = self._button("Hint", "Show the next hint (Ctrl+H)")
        self.variant_button = self._button("New variant", "Ask the same with other numbers (Ctrl+N)")
        self.again_button = self._button(
            "Start again", "The same question again, without your answer (Ctrl+R)"
        )
        self.twin_button = self._button(
            "Show that run", "Step the right run beside the one with this mistake (Ctrl+D)"
        )
        self.model_button = self._button(
            "Model answer",
            "Show the right answer; before a check this ends the variant without points (Ctrl+M)",
        )
        self.step_button = self._button(
            "Step it, hidden", "Step the scene on the Step page, which hides what comes next (Ctrl+G)"
        )
        self.lesson_button = self._button("Back to the lesson", "Go on in the lesson that is open")
        self.lesson_button.setObjectName("back to the lesson")
        self.lesson_button.hide()
        self._icon = QLabel(self)
        self.verdict = text_label("", self, wraps=True, name="Verdict")
        self._arrange()
        for button, signal in (
            (self.check_button, self.check_requested),
            (self.hint_button, self.hint_requested),
            (self.variant_button, self.variant_requested),
            (self.again_button, self.again_requested),
            (self.twin_button, self.twin_requested),
            (self.model_button, self.model_requested),
            (self.copy_button, self.copy_requested),
            (self.step_button, self.step_requested),
            (self.list_button, self.list_requested),
        ):
            button.clicked.connect(signal)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    def _button(self, text: str, tip: str, *, flat: bool = False) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.setProperty("flat", flat)
        return button

    def _arrange(self) -> None:
        self._content = QWidget(self)
        column = column_layout(self._content, 12, margins=(4, 4, 12, 8))
        head = row_layout(spacing=4)
        head.addWidget(self.mark, 1)
        head.addWidget(self.copy_button, 0, Qt.AlignmentFlag.AlignTop)
        column.addWidget(self.list_button, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(self.title)
        column.addLayout(head)
        for label in (self.text, self.given, self.credit):
            column.addWidget(label)
        column.addWidget(self.sketch)
        self._answer_place = column_layout(spacing=4)
        column.addLayout(self._answer_place)
        column.addWidget(self.note)
        column.addWidget(self.hints)
        column.addStretch(1)
        self.scroll_area = QScrollArea(self)
        self.scroll_area.setWidgetResizable(True)
        self.scroll_area.setFrameShape(QFrame.Shape.NoFrame)
        self.scroll_area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.scroll_area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.scroll_area.setAlignment(Qt.AlignmentFlag.AlignHCenter)
        self.scroll_area.setWidget(self._content)
        self._result = QWidget(self)
        self._result.setProperty("role", "panel")
        self._result.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        result = row_layout(self._result, spacing=8, margins=(8, 8, 8, 8))
        result.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignTop)
        result.addWidget(self.verdict, 1)
        buttons = FlowLayout(spacing=8)
        for button in (
            self.check_button,
            self.hint_button,
            self.model_button,
            self.variant_button,
            self.again_button,
            # Behind those that stay: what comes and goes must not push another one under the pointer.
            self.step_button,
            self.twin_button,
            self.lesson_button,
        ):
            buttons.addWidget(button)
        self._foot = QWidget(self)
        foot = column_layout(self._foot, 8, margins=(4, 0, 4, 0))
        foot.addWidget(self._result)
        foot.addLayout(buttons)
        middle = row_layout()
        middle.addStretch(1)
        middle.addWidget(self._foot, 1000)
        middle.addStretch(1)
        page = column_layout(self, 8)
        page.addWidget(self.scroll_area, 1)
        page.addLayout(middle)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)

    # What is shown.

    def show_question(self, record: QuestionRecord, form: Form) -> AnswerView:
        """Ask a question; return the form for its answer."""
        for label, text in (
            (self.title, record.title),
            (self.mark, record.mark),
            (self.text, record.text),
            (self.given, record.given),
            (self.credit, record.credit),
        ):
            label.setText(text)
            label.setVisible(bool(text))
        self.sketch.show_sketch(record.sketch)
        self._has_art = _ART.search(record.given) is not None
        self._follow_theme()
        if self.answer is not None:
            self.answer.release()
            self._answer_place.removeWidget(self.answer)
            self.answer.hide()
            self.answer.deleteLater()
        self.answer = make_view(form, self._grid, self._content)
        self.answer.note_changed.connect(self.show_note)
        self._answer_place.addWidget(self.answer)
        # At once, not with the next turn of events: it may be given the keyboard now.
        self.answer.show()
        column = self._content.layout()
        assert column is not None
        column.activate()
        self.show_note("")
        self.show_feedback(None)
        self.scroll_area.verticalScrollBar().setValue(0)
        return self.answer

    def show_list_button(self, is_shown: bool, is_open: bool) -> None:
        """Offer to unfold the list of exercises, where it has no room of its own."""
        self.list_button.setVisible(is_shown)
        self.list_button.setChecked(is_open)

    @Slot(str)
    def show_note(self, text: str) -> None:
        """Say how the answer is understood, or why it is not checked yet."""
        self.note.setText(text)
        self.note.setVisible(bool(text))
        announce(self, text)

    def show_not_checked(self, text: str) -> None:
        """Say why the answer is not checked, and bring that into sight."""
        self.show_note(text)
        column = self._content.layout()
        assert column is not None
        column.activate()
        self.scroll_area.ensureWidgetVisible(self.note)

    def show_hints(self, shown: Sequence[str], count: int) -> None:
        """Show the hints so far, of ``count``."""
        before, numbered = self.hints.text(), enumerate(shown, 1)
        self.hints.setText("\n".join(f"Hint {number} of {count}: {hint}" for number, hint in numbered))
        self.hints.setVisible(bool(shown))
        self.hint_button.setText(f"Hint {min(len(shown) + 1, count)} of {count}" if count else "Hint")
        self.hint_button.setEnabled(len(shown) < count)
        if shown and not before.endswith(shown[-1]):
            announce(self, shown[-1])

    def show_feedback(self, feedback: Feedback | None, *, is_stale: bool = False) -> None:
        """Show what a check found; ``is_stale``: the answer has changed since."""
        self._feedback = feedback
        self._result.setVisible(feedback is not None)
        if feedback is None:
            return
        lines = [f"{feedback.heading}: {feedback.counts}.", *feedback.sentences]
        if is_stale:
            lines = [f"Last check: {feedback.heading}. The answer has changed since."]
        self.verdict.setText("\n".join(lines))
        set_role(self.verdict, "muted" if is_stale else "good" if feedback.is_right else "")
        self._icon.setVisible(not is_stale)
        self._follow_theme()
        if not is_stale:
            announce(self, self.verdict.text())
            if self.answer is not None:
                self.scroll_area.ensureWidgetVisible(self.answer)

    def show_choices(self, *, twin: str, model: str, step: str) -> None:
        """Offer the run of a mistake, the model answer and the scene by these texts; empty: there is no such."""
        for button, text in ((self.twin_button, twin), (self.model_button, model), (self.step_button, step)):
            button.setVisible(bool(text))
            button.setText(text)

    @Slot()
    def _follow_theme(self) -> None:
        theme = current_theme()
        for part in (self._content, self._foot):
            part.setMaximumWidth(WIDEST * theme.text_px // 13)
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont) if self._has_art else QFont()
        if self._has_art:
            font.setPixelSize(theme.code_px)
        set_role(self.given, "")
        self.given.setFont(font)
        set_role(self.given, "" if self._has_art else "strong")
        if self._feedback is not None:
            mark = Mark.RIGHT if self._feedback.is_right else Mark.WRONG
            self._icon.setPixmap(mark_pixmap(mark, theme.text_px + 4, self.devicePixelRatioF()))
