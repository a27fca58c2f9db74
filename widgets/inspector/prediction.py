"""Predict, then reveal: a question about the next step, an answer, and the verdict beside it."""

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QLabel, QPushButton, QWidget

from core.explain.number_text import parse_number
from core.explain.records import AnswerKind, Question, Verdict
from widgets.basics.accessibility import announce
from widgets.basics.controls import column_layout, row_layout, set_role, text_label
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier
from widgets.basics.typed_value import NumberEdit


class PredictionView(QWidget):
    """Asks a `Question`, hands on the answer, shows the `Verdict` and the count of right ones."""

    answer_given = Signal(object)
    """The user has answered: a float for a number, the place of a choice as int."""
    reveal_requested = Signal()
    """The user wants to see the value without answering."""
    next_requested = Signal()
    """The user wants the next question."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.setAccessibleName("Prediction")
        self._question: Question | None = None
        self._verdict: Verdict | None = None
        self.question = text_label("", self, wraps=True)
        self.field = NumberEdit(self)
        self.field.setMaximumWidth(140)
        self.field.setAccessibleName("Your answer")
        self.field.setToolTip("Accepts decimals, fractions (3/256) and pi; Enter checks")
        self.field.returnPressed.connect(self._check_number)
        self.field.textEdited.connect(self._forget_note)
        self.check_button = QPushButton("Check", self)
        self.check_button.setToolTip("Check the answer (Enter)")
        self.check_button.clicked.connect(self._check_number)
        self.reveal_button = QPushButton("Reveal", self)
        self.reveal_button.setProperty("flat", True)
        self.reveal_button.setToolTip("Show the value without answering; this does not count")
        self.reveal_button.clicked.connect(self.reveal_requested)
        self.next_button = QPushButton("Next question", self)
        self.next_button.setToolTip("Ask about the next step")
        self.next_button.clicked.connect(self.next_requested)
        self.choice_buttons: tuple[QPushButton, ...] = ()
        self._choices = column_layout(spacing=4)
        self._icon = QLabel(self)
        self.verdict = text_label("", self, name="Verdict", wraps=True)
        self.count = text_label("", self, role="muted")
        self._arrange()
        theme_notifier().theme_changed.connect(self._follow_theme)
        self.show_question(None)

    def show_question(self, question: Question | None, hint: str = "") -> None:
        """Ask a question, or say why there is none (by default: what the pane is for)."""
        self._question = question
        self._verdict = None
        hint = hint or "Turn prediction on to predict each value before it appears."
        text = question.text if question else hint
        self.question.setText(text)
        set_role(self.question, "" if question else "muted")
        self._show_choices(question.choices if question and question.kind is AnswerKind.CHOICE else ())
        self.field.clear()
        self._show_note("")
        self._show_controls()

    @Slot(object)
    def show_verdict(self, verdict: Verdict) -> None:
        """Show whether the answer was right; the question is then closed."""
        self._verdict = verdict
        self._show_controls()
        self._follow_theme()
        announce(self, self.verdict.text())

    @Slot(int, int)
    def show_count(self, right: int, asked: int) -> None:
        """Show how many answers were right; nothing before the first."""
        self.count.setText(f"{right} of {asked} right" if asked else "")

    def _arrange(self) -> None:
        answer, going, result = (row_layout(spacing=8) for _ in range(3))
        answer.addWidget(self.field)
        answer.addWidget(self.check_button)
        answer.addStretch(1)
        going.addWidget(self.next_button)
        going.addWidget(self.reveal_button)
        going.addStretch(1)
        going.addWidget(self.count)
        result.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignTop)
        result.addWidget(self.verdict, 1)
        layout = column_layout(self, 8, margins=(12, 8, 12, 8))
        layout.addWidget(self.question)
        layout.addLayout(answer)
        layout.addLayout(self._choices)
        layout.addLayout(result)
        layout.addLayout(going)

    def _show_choices(self, choices: tuple[str, ...]) -> None:
        for button in self.choice_buttons:
            self._choices.removeWidget(button)
            button.hide()
            button.deleteLater()
        buttons = []
        for text in choices:
            button = QPushButton(text, self)
            button.setToolTip(f"Answer: {text}")
            button.clicked.connect(self._answer_choice)
            self._choices.addWidget(button)
            buttons.append(button)
        self.choice_buttons = tuple(buttons)

    def _show_controls(self) -> None:
        kind = self._question.kind if self._question else None
        is_grid = kind is AnswerKind.GRID
        is_open = self._question is not None and (self._verdict is None or is_grid)
        self.field.setVisible(kind is AnswerKind.NUMBER)
        self.field.setReadOnly(not is_open)
        self.check_button.setVisible(kind is AnswerKind.NUMBER and is_open)
        self.reveal_button.setVisible(is_open)
        self.next_button.setVisible(self._question is not None and not is_open)
        for button in self.choice_buttons:
            button.setEnabled(is_open)

    @Slot()
    def _check_number(self) -> None:
        if self._verdict is not None:
            return
        try:
            value = parse_number(self.field.text())
        except ValueError as problem:
            self._show_note(f"Not checked yet: {problem}.")
            return
        self._show_note("")
        self.answer_given.emit(value)

    @Slot()
    def _answer_choice(self) -> None:
        button = self.sender()
        for place, candidate in enumerate(self.choice_buttons):
            if candidate is button:
                self.answer_given.emit(place)

    @Slot()
    def _forget_note(self) -> None:
        if self._verdict is None:
            self._show_note("")

    def _show_note(self, text: str) -> None:
        self._icon.hide()
        self.verdict.setText(text)
        self.verdict.setVisible(bool(text))
        set_role(self.verdict, "muted")

    @Slot()
    def _follow_theme(self) -> None:
        if self._verdict is None:
            return
        is_right = self._verdict.is_right
        if is_right is not None:
            mark = Mark.RIGHT if is_right else Mark.WRONG
            self._icon.setPixmap(mark_pixmap(mark, current_theme().text_px + 4, self.devicePixelRatioF()))
        self._icon.setVisible(is_right is not None)
        heading = {True: "Right: ", False: "Wrong: ", None: "Answer: "}[is_right]
        self.verdict.setText(heading + self._verdict.text)
        self.verdict.show()
        set_role(self.verdict, {True: "good", False: "bad", None: ""}[is_right])
