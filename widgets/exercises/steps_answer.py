"""Be the rasterizer: one step at a time, judged at once; a wrong one is tried again or put right."""

from typing import Any

from PySide6.QtCore import QSize, Qt, Slot
from PySide6.QtGui import QIcon, QKeyEvent
from PySide6.QtWidgets import QListWidget, QPushButton, QSizePolicy, QWidget

from widgets.basics.accessible import announce
from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme
from widgets.basics.typed_value import NumberEdit
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks, StepLine, StepsForm

FIXED = "fixed"
MARKS = {"right": Mark.RIGHT, "wrong": Mark.WRONG, "fixed": Mark.INFORMATION}
WORDS = {
    "right": "right",
    "wrong": "not right at the first try",
    "fixed": "put right",
    "open": "asked now",
    "": "",
}
HOW = {
    "pixel": "Click the pixel, or type its column and row, as 3, 2.",
    "place": "Type x and y, as 3.5, 2.",
    "number": "Type the number.",
    "choice": "Choose one.",
    "": "",
}


class StepsAnswerView(AnswerView):
    """The steps so far, the one that is asked, and what may be done about a wrong try."""

    uses_grid = True

    def __init__(self, form: StepsForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._form, self._grid = form, grid
        self._tries: list[list[str]] = []
        self._state = form.state([])
        self.list = QListWidget(self)
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
        self._state = self._form.state(tries)
        self._tries = tries
        self._show()

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Do nothing: every step has its mark as soon as it is tried."""

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
        tries, number = self.given(), self._state.open
        assert number is not None
        tries[number:] = [[*(tries[number] if number < len(tries) else []), text]]
        return tries

    def _problem(self, text: str) -> str:
        """Return why a typed text means nothing as a step; empty: it means something."""
        if text == FIXED:
            return f"expected a {self._state.kind}, got {text!r}"
        try:
            self._form.state(self._tries_with(text))
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
        if self._state.kind == "pixel" and len(pointed) == 1:
            column, row = next(iter(pointed))
            self._try(f"{column}, {row}")

    def _try(self, text: str) -> None:
        """Have one try judged at once."""
        number = self._state.open
        if number is None:
            return
        tries = self._tries_with(text)
        try:
            self._state = self._form.state(tries)
        except ValueError as problem:
            self.note_changed.emit(f"Not tried yet: {problem}.")
            return
        self._tries = tries
        has_gone_on = self._state.open != number
        self.field.clear()
        self._show()
        said = f"Step {number + 1}: {self._state.lines[number].tries}"
        self.note_changed.emit(
            "" if has_gone_on else f"{said} is not right. Try again, or have it put right."
        )
        announce(self, f"{said}, {WORDS[self._state.lines[number].standing]}")
        self.answer_changed.emit()

    def _show(self) -> None:
        """Show the steps, and what is asked now."""
        state = self._state
        is_asked = state.open is not None
        prompt = "" if state.open is None else state.lines[state.open].prompt
        number = 0 if state.open is None else state.open + 1
        self.prompt.setText(
            f"Step {number} of {len(state.lines)}: {prompt}" if is_asked else "All steps are done."
        )
        self.how.setText(HOW[state.kind])
        self.how.setVisible(is_asked)
        self.field.setVisible(is_asked and state.kind != "choice")
        self.try_button.setVisible(is_asked and state.kind != "choice")
        self.fix_button.setVisible(is_asked and state.is_missed)
        self._show_options(state.options)
        self._grid.show_marked(state.pixels)
        side = current_theme().text_px
        self.list.setIconSize(QSize(side, side))
        self.list.clear()
        for line in state.lines[:number] if is_asked else state.lines:
            self.list.addItem(_line_text(line))
            # A step that was missed stays open: it may be tried again.
            mark = MARKS.get("wrong" if line.standing == "open" and line.tries else line.standing)
            if mark is not None:
                self.list.item(self.list.count() - 1).setIcon(
                    QIcon(mark_pixmap(mark, side, self.devicePixelRatioF()))
                )
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
    word = "" if line.standing in ("open", "right") else WORDS[line.standing]
    tail = ", ".join(text for text in (line.tries, word) if text)
    return f"{line.prompt}: {tail}" if tail else line.prompt
