"""Which widget takes which type of answer; among them a run done by hand, step by step, and code that is typed."""

from typing import Any

from PySide6.QtCore import QSize, Qt, Slot
from PySide6.QtGui import QKeyEvent, QTextCursor
from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from core.records.cells import Form, StepLine
from widgets.basics.accessibility import announce
from widgets.basics.controls import FlowLayout, button_with_tip, column_layout, row_layout, text_label
from widgets.basics.drawing import Mark
from widgets.basics.theme import current_theme
from widgets.basics.typed_value import NumberEdit
from widgets.exercises.choice_answers import (
    ChoiceAnswerView,
    ListingAnswerView,
    MethodAnswerView,
    OrderAnswerView,
)
from widgets.exercises.field_answers import FieldAnswerView, PlaceAnswerView
from widgets.exercises.mark_grid import AnswerView, MarkGrid
from widgets.exercises.marked_items import ItemList
from widgets.exercises.picture_answers import DialAnswerView, PixelAnswerView, SpotAnswerView
from widgets.inspector.listing_editor import ListingEditor

# Be the rasterizer: one step at a time, judged at once; a wrong one is tried again or put right.


FIXED = "fixed"
STEP_MARKS = {"right": Mark.RIGHT, "wrong": Mark.WRONG, "fixed": Mark.INFORMATION}
STEP_WORDS = {
    "right": "right",
    "wrong": "not right at the first try",
    "fixed": "put right",
    "open": "asked now",
    "": "",
}
HOW_STEPS = {
    "pixel": "Click the pixel, or type its column and row, as 3, 2.",
    "place": "Type x and y, as 3.5, 2.",
    "number": "Type the number.",
    "choice": "Choose one.",
}


class StepsAnswerView(AnswerView):
    """The steps so far, the one that is asked, and what may be done about a wrong try."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        assert form.state is not None
        self._state_of = form.state
        self._tries: list[list[str]] = []
        self._state = form.state([])
        self.list = ItemList(self)
        self.list.setAccessibleName("Steps")
        self.list.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.prompt = text_label("", self, role="strong", wraps=True)
        self.how = text_label("", self, role="muted", wraps=True)
        self.field = NumberEdit(self)
        self.field.setAccessibleName("This step")
        self.field.textEdited.connect(self._typed)
        self.field.returnPressed.connect(self._try_text)
        self.try_button = button_with_tip("Try", "Judge this step (Return)", self)
        self.try_button.clicked.connect(self._try_text)
        self.fix_button = button_with_tip("Put it right", "Take the right step; it earns nothing", self)
        self.fix_button.clicked.connect(self._fix)
        self._options = QWidget(self)
        self._option_row = FlowLayout(self._options, spacing=8)
        self.option_buttons: list[QPushButton] = []
        layout = column_layout(self, 8)
        layout.addWidget(self.prompt)
        layout.addWidget(self.how)
        entry = row_layout(spacing=8)
        for widget in (self.field, self.try_button, self.fix_button):
            entry.addWidget(widget)
        entry.addStretch(1)
        layout.addLayout(entry)
        layout.addWidget(self._options)
        layout.addWidget(self.list)
        grid.pixels_painted.connect(self._pointed)
        grid.set_paintable(True)
        self._show()

    def given(self) -> list[list[str]]:
        """Return the tries of every step so far."""
        return [list(tries) for tries in self._tries]

    def unread(self) -> str:
        """Say what is typed for a step but was not tried."""
        text = self.field.text().strip()
        if not text or self.field.isHidden():
            return ""
        return self._problem(text) or f"{text[:20]!a} is not tried yet: Return tries it"

    def show_given(self, given: Any) -> None:
        """Go on from the tries of before."""
        tries = [[str(one) for one in step] for step in given or ()]
        self._state = self._state_of(tries)
        self._tries = tries
        self._show()

    def set_open(self, is_open: bool) -> None:
        """Take steps, or only show them."""
        for widget in (self.field, self.try_button, self.fix_button, self._options):
            widget.setEnabled(is_open)
        self._grid.set_paintable(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
        self._grid.pixels_painted.disconnect(self._pointed)
        self._grid.set_paintable(False)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keep Return: in the field it tries the step, and does not check the whole answer."""
        if event.key() not in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            super().keyPressEvent(event)

    def _tries_with(self, text: str) -> list[list[str]]:
        """Return the tries with one more of the step that is asked."""
        tries, number = self.given(), self._state.number
        tries[number:] = [[*(tries[number] if number < len(tries) else []), text]]
        return tries

    def _problem(self, text: str) -> str:
        """Return why a typed text means nothing as a step; empty: it means something."""
        assert self._state.open is not None
        if text == FIXED:
            return f"expected a {self._state.open.kind}, got {text!r}"
        try:
            self._state_of(self._tries_with(text))
        except ValueError as problem:
            return str(problem)
        return ""

    @Slot(str)
    def _typed(self, text: str) -> None:
        problem = self._problem(text.strip()) if text.strip() else ""
        self.note_changed.emit(f"Not tried yet: {problem}." if problem else "")

    @Slot()
    def _try_text(self) -> None:
        text = self.field.text().strip()
        if text and not self._problem(text):
            self._try(text)

    @Slot()
    def _fix(self) -> None:
        self._try(FIXED)

    @Slot()
    def _choose(self) -> None:
        button = self.sender()
        assert isinstance(button, QPushButton)
        self._try(button.text())

    @Slot(object, bool)
    def _pointed(self) -> None:
        """Try the pixel that was pointed at."""
        pointed = self._grid.marked() ^ self._state.pixels
        self._grid.show_marked(self._state.pixels)
        step = self._state.open
        if step is not None and step.kind == "pixel" and len(pointed) == 1:
            column, row = next(iter(pointed))
            self._try(f"{column}, {row}")

    def _try(self, text: str) -> None:
        """Have one try judged at once."""
        if self._state.open is None:
            return
        number = self._state.number
        tries = self._tries_with(text)
        try:
            self._state = self._state_of(tries)
        except ValueError as problem:
            self.note_changed.emit(f"Not tried yet: {problem}.")
            return
        self._tries = tries
        has_gone_on = self._state.number != number
        self.field.clear()
        self._show()
        said = f"Step {number + 1}: {self._state.lines[number].tries}"
        self.note_changed.emit(
            "" if has_gone_on else f"{said} is not right. Try again, or have it put right."
        )
        announce(self, f"{said}, {STEP_WORDS[self._state.lines[number].standing]}")
        self.answer_changed.emit()

    def _show(self) -> None:
        """Show the steps, and what is asked now."""
        state, step = self._state, self._state.open
        self.prompt.setText(
            "All steps are done."
            if step is None
            else f"Step {state.number + 1} of {len(state.lines)}: {step.label}"
        )
        self.how.setText("" if step is None else HOW_STEPS[step.kind])
        self.how.setVisible(step is not None)
        is_typed = step is not None and step.kind != "choice"
        self.field.setVisible(is_typed)
        self.try_button.setVisible(is_typed)
        self.fix_button.setVisible(step is not None and state.is_missed)
        self._show_options(() if step is None else step.options)
        self._grid.show_marked(state.pixels)
        self.list.clear()
        for row, line in enumerate(state.lines[: state.number + 1]):
            self.list.addItem(_line_text(line))
            # A step that was missed stays open: it may be tried again.
            missed = "wrong" if line.standing == "open" and line.tries else line.standing
            self.list.show_mark(row, STEP_MARKS.get(missed))
        self.list.scrollToBottom()

    def _show_options(self, options: tuple[str, ...]) -> None:
        if tuple(button.text() for button in self.option_buttons) != options:
            for button in self.option_buttons:
                self._option_row.removeWidget(button)
                button.hide()
                button.deleteLater()
            self.option_buttons = [
                button_with_tip(option, f"Try {option}", self._options) for option in options
            ]
            for button in self.option_buttons:
                button.clicked.connect(self._choose)
                self._option_row.addWidget(button)
                button.show()
        self._options.setVisible(bool(options))


def _line_text(line: StepLine) -> str:
    word = "" if line.standing in ("open", "right") else STEP_WORDS[line.standing]
    tail = ", ".join(text for text in (line.tries, word) if text)
    return f"{line.prompt}: {tail}" if tail else line.prompt


# A listing that is typed: an editor, a wave where it cannot run, and why, while it is typed.


HOW_CODE = (
    "Type in the listing. Tab indents, Ctrl+Return checks, Esc leaves it; while it is checked, Esc ends that."
)
CODE_NAME = "Your listing"
FEWEST, MOST, SPARE = 6, 24, 2
"""Lines that the editor shows at least and at most, and those below the last one."""


class CodeAnswerView(AnswerView):
    """An editor with the listing as it is at first."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.editor = AnswerEditor(self)
        self.editor.setAccessibleName(CODE_NAME)
        self.editor.setAccessibleDescription(HOW_CODE)
        self.reset_button = button_with_tip("Reset", "Put back the listing as it was at first", self)
        self.reset_button.clicked.connect(self._reset)
        self.editor.text_typed.connect(self._typed)
        self.editor.left.connect(self._leave)
        self.editor.document().documentLayout().documentSizeChanged.connect(self.editor.updateGeometry)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW_CODE, self, role="muted", wraps=True))
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
        if given is None and (place := self.editor.text.find("#")) >= 0:
            # What says that something is missing is typed over.
            cursor = self.editor.textCursor()
            cursor.setPosition(place)
            cursor.movePosition(QTextCursor.MoveOperation.EndOfLine, QTextCursor.MoveMode.KeepAnchor)
            self.editor.setTextCursor(cursor)
        self._mark_changes()
        self.show_problem(None)

    def set_open(self, is_open: bool) -> None:
        """Take text, or only show it."""
        self.editor.setReadOnly(not is_open)
        self.reset_button.setEnabled(is_open)

    def show_problem(self, problem: tuple[int, int, str] | None) -> None:
        """Mark where the listing cannot run, and say why to those who do not see it."""
        self.editor.show_problem(None if problem is None else problem[:2])
        self.editor.setAccessibleDescription(HOW_CODE if problem is None else problem_text(problem))

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


# Which widget takes which type of answer.


VIEWS: dict[str, type[AnswerView]] = {
    "pixels": PixelAnswerView,
    "numbers": FieldAnswerView,
    "table": FieldAnswerView,
    "order": OrderAnswerView,
    "choice": ChoiceAnswerView,
    "places": PlaceAnswerView,
    "line": ListingAnswerView,
    "code": CodeAnswerView,
    "spot": SpotAnswerView,
    "steps": StepsAnswerView,
    "break": DialAnswerView,
    "cheapest": MethodAnswerView,
}
"""By `Form.kind`."""


def make_view(form: Form, grid: MarkGrid, parent: QWidget) -> AnswerView:
    """Return an empty form for an answer; ``grid`` is the picture beside it."""
    return VIEWS[form.kind](form, grid, parent)
