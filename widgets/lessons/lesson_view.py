"""The pane of a lesson beside the picture: text, task, the form of an answer, what came of it, a dot for each step."""

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QSize, Qt, Signal, SignalInstance, Slot
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QLabel, QPushButton, QWidget

from core.records.cells import Form
from widgets.basics.accessibility import ArrowGroup, announce, sentences
from widgets.basics.controls import (
    LEAST_TARGET,
    FlowLayout,
    button_with_tip,
    column_layout,
    flat_button,
    keep_room,
    row_layout,
    set_role,
    text_label,
    unbroken,
    wrap_text,
)
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.answer_forms import make_view
from widgets.exercises.mark_grid import AnswerView, MarkGrid
from widgets.exercises.records import LessonFeedback, LessonStepRecord, Standing
from widgets.lessons.lesson_scroll import FloatingBar

# A dot for each step of a lesson: which are done or seen, which one is shown; a click opens any of them.


class StepDot(QAbstractButton):
    """One dot: filled when its step is done, with a point in it when it was only seen, in a ring when it is shown."""

    def __init__(self, number: int, parent: QWidget) -> None:
        super().__init__(parent)
        self.number = number
        self._standing, self._is_current = Standing.OPEN, False
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def show_standing(self, standing: Standing, is_current: bool) -> None:
        """Show how far the learner is with the step, and whether it is the one that is shown."""
        self._standing, self._is_current = standing, is_current
        shown = ", shown now" if is_current else ""
        name = f"Step {self.number + 1}: {standing.value}{shown}"
        self.setAccessibleName(name)
        self.setToolTip(f"{name}. Click to open it.")
        self.update()

    def sizeHint(self) -> QSize:
        """Return the size of what is clicked."""
        side = max(LEAST_TARGET, round(1.4 * current_theme().text_px))
        return QSize(side, side)

    def minimumSizeHint(self) -> QSize:
        """Return the same: a dot is not squeezed."""
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the dot, and the ring of the focus."""
        theme = current_theme()
        radius = 0.34 * theme.text_px
        middle = QPointF(self.width() / 2, self.height() / 2)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            ink = QColor(theme.text)
            painter.setPen(QPen(ink, max(1.4, 0.1 * theme.text_px)))
            is_done = self._standing is Standing.DONE
            painter.setBrush(ink if is_done else Qt.BrushStyle.NoBrush)
            painter.drawEllipse(middle, radius, radius)
            if self._standing is Standing.SEEN:
                painter.setBrush(ink)
                painter.setPen(Qt.PenStyle.NoPen)
                painter.drawEllipse(middle, 0.45 * radius, 0.45 * radius)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            if self._is_current:
                painter.setPen(QPen(ink, max(1.4, 0.1 * theme.text_px)))
                painter.drawLine(
                    QPointF(middle.x() - 1.3 * radius, self.height() - 2.0),
                    QPointF(middle.x() + 1.3 * radius, self.height() - 2.0),
                )
            if self.hasFocus():
                painter.setPen(QPen(QColor(theme.focus), 2))
                painter.drawRoundedRect(self.rect().adjusted(1, 1, -1, -1), 3, 3)


class StepDots(QWidget):
    """The dots of a lesson, one stop of Tab."""

    step_chosen = Signal(int)
    """Number of a step, from 0."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.dots: list[StepDot] = []
        self._row = row_layout(self, 0)
        self._group = ArrowGroup((), self)
        self.setAccessibleName("Steps of the lesson")

    def show_standings(self, standings: Sequence[Standing], number: int) -> None:
        """Show how far the learner is with each step; the one with this number is shown."""
        while len(self.dots) > len(standings):
            dot = self.dots.pop()
            self._row.removeWidget(dot)
            dot.hide()
            dot.deleteLater()
        while len(self.dots) < len(standings):
            dot = StepDot(len(self.dots), self)
            dot.clicked.connect(self._choose)
            self.dots.append(dot)
            self._row.addWidget(dot)
            dot.show()
        for place, (dot, standing) in enumerate(zip(self.dots, standings, strict=True)):
            dot.show_standing(standing, place == number)
        self._group.show_buttons(self.dots)

    @Slot()
    def _choose(self) -> None:
        dot = self.sender()
        assert isinstance(dot, StepDot)
        self.step_chosen.emit(dot.number)


# The pane of a lesson beside the picture: text, task, the form of an answer, what came of it, and where to
# go next.


_MARKS = {True: Mark.RIGHT, False: Mark.WRONG}


class LessonView(QWidget):
    """Shows a `LessonStepRecord`; what is to be done is asked for by signals."""

    back_requested = Signal()
    next_requested = Signal()
    return_requested = Signal()
    """The state of the step is to be opened again."""
    step_chosen = Signal(int)
    close_requested = Signal()
    check_requested = Signal()
    reveal_requested = Signal()
    """What is right is to be shown, or the step that refutes the last answer."""
    link_chosen = Signal(str)
    """Address of what is to be opened."""
    answer_changed = Signal()
    feedback_shown = Signal()
    """There is something to be read of the task."""

    def __init__(self, grid: MarkGrid, parent: QWidget | None = None) -> None:
        """Make an empty pane; ``grid`` is the picture on which answers are marked."""
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.setAccessibleName("Lesson")
        self._grid = grid
        self._feedback: LessonFeedback | None = None
        self._is_presenting = self._is_asking = self._has_solution = False
        self._record: LessonStepRecord | None = None
        self.answer: AnswerView | None = None
        self.bar = FloatingBar(self)
        """The buttons of a step."""
        self.title = text_label("", self, role="strong", wraps=True)
        self.place = text_label("", self, role="muted", name="Step of the lesson")
        self.close_button = flat_button(
            "✕", "Close the lesson", "Close the lesson: what was open before it comes back", self
        )
        self.lead = text_label("", self, role="muted", wraps=True)
        self.text = text_label("", self, wraps=True, is_selectable=True, name="What this step is about")
        self.task_icon = QLabel(self)
        self.task = text_label("", self, role="strong", wraps=True, name="What is to be done")
        self.note = text_label("", self, role="muted", wraps=True)
        self.check_button = self._button("Check", "Check the answer (Return)", self.check_requested)
        self.reveal_button = self._button(
            "Reveal", "Show what is right: the step counts as seen (Ctrl+M)", self.reveal_requested
        )
        self.back_button = self._button("Back", "Previous step of the lesson (Page Up)", self.back_requested)
        self.next_button = self._button("Next", "Next step of the lesson (Page Down)", self.next_requested)
        self.return_button = self._button(
            "Return here",
            "Open this step of the lesson as it was at first (Ctrl+Home)",
            self.return_requested,
        )
        self.dots = StepDots(self)
        self._icon = QLabel(self)
        self.feedback = text_label("", self, wraps=True, is_selectable=True, name="What came of it")
        self._result = QWidget(self)
        self._links = FlowLayout(spacing=8)
        self._link_buttons: dict[QPushButton, str] = {}
        """Those that lead elsewhere, and their texts."""
        self._arrange()
        self.close_button.clicked.connect(self.close_requested)
        self.dots.step_chosen.connect(self.step_chosen)
        theme_notifier().theme_changed.connect(self._follow_theme)

    def _button(self, text: str, tip: str, signal: SignalInstance) -> QPushButton:
        button = button_with_tip(text, tip, self)
        button.clicked.connect(signal)
        return button

    def _arrange(self) -> None:
        head, task, result = row_layout(spacing=8), row_layout(spacing=8), row_layout(self._result, spacing=8)
        head.addWidget(self.title, 1)
        head.addWidget(self.place)
        head.addWidget(self.close_button, 0, Qt.AlignmentFlag.AlignTop)
        task.addWidget(self.task, 1)
        # Its room is kept, or a task that is done might take one line more.
        task.addWidget(self.task_icon, 0, Qt.AlignmentFlag.AlignTop)
        result.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignTop)
        result.addWidget(self.feedback, 1)
        checks, ways = row_layout(spacing=8), FlowLayout(spacing=8)
        buttons = column_layout(self.bar, 6)
        for button in (self.check_button, self.reveal_button):
            checks.addWidget(button, 0, Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        # Beside the buttons: what is typed must not move them.
        checks.addWidget(self.note, 1)
        for widget in (self.back_button, self.next_button, self.return_button, self.dots):
            ways.addWidget(widget)
        column = column_layout(self, 6, margins=(8, 6, 4, 8))
        column.addLayout(head)
        column.addWidget(self.lead)
        column.addWidget(self.text)
        column.addLayout(task)
        self._answer_place = column_layout(spacing=4)
        column.addLayout(self._answer_place)
        buttons.addLayout(checks)
        buttons.addLayout(ways)
        column.addWidget(self.bar.place)
        column.addWidget(self._result)
        column.addLayout(self._links)
        self._column = column

    # What is shown.

    def show_step(self, record: LessonStepRecord, form: Form | None) -> AnswerView | None:
        """Show a step; return the form for its answer, if it asks for one."""
        self._record = record
        self.title.setText(record.title)
        for label, text in ((self.lead, record.lead), (self.text, record.text), (self.task, record.task)):
            label.setText(unbroken(text))
            label.setVisible(bool(text))
        self._show_links(record.links)
        self._show_form(form)
        # Where a listing cannot run is said while it is typed: the buttons below keep their place.
        lines = 3 if form is not None and form.kind == "code" else 0
        self.note.setMinimumHeight(lines * (self.note.fontMetrics().lineSpacing() + 1))
        self.show_note("")
        self.show_feedback(None)
        self.show_standings(record)
        announce(self, sentences((self.spoken_place(), record.lead, record.text, record.task)))
        return self.answer

    def show_standings(self, record: LessonStepRecord) -> None:
        """Show how far the learner is with the steps."""
        self._record = record
        self.place.setText(record.place)
        self._follow_theme()
        self.dots.show_standings(record.standings, record.number)
        self.back_button.setEnabled(record.has_previous)
        self.next_button.setVisible(record.has_next)
        self.next_button.setText(record.next_title or "Next")
        self.next_button.setToolTip(f"{record.next_title or 'Next step of the lesson'} (Page Down)")

    def spoken_place(self) -> str:
        """Return title and step for a screen reader."""
        record = self._record
        if record is None:
            return ""
        is_step = 0 <= record.number < len(record.standings)
        return f"{record.title}, {'step ' if is_step else ''}{record.place}"

    def _show_links(self, links: tuple[tuple[str, str], ...]) -> None:
        for old in self._link_buttons:
            self._links.removeWidget(old)
            old.hide()
            old.deleteLater()
        self._link_buttons.clear()
        for address, title in links:
            button = button_with_tip(title, f"Open: {title}", self)
            button.setObjectName(address)
            button.clicked.connect(self._choose_link)
            self._links.addWidget(button)
            self._link_buttons[button] = title
            wrap_text(button, title, self._links.geometry().width() or self.width())
            button.show()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Write long texts of buttons in several lines."""
        super().resizeEvent(event)
        for button, title in self._link_buttons.items():
            wrap_text(button, title, self._links.geometry().width())

    @Slot()
    def _choose_link(self) -> None:
        self.link_chosen.emit(self.sender().objectName())

    def _show_form(self, form: Form | None) -> None:
        if self.answer is not None:
            self.answer.release()
            self._answer_place.removeWidget(self.answer)
            self.answer.hide()
            self.answer.deleteLater()
            self.answer = None
        if form is not None:
            self.answer = make_view(form, self._grid, self)
            self.answer.note_changed.connect(self.show_note)
            self.answer.answer_changed.connect(self.answer_changed)
            self._answer_place.addWidget(self.answer)
            self.answer.show()
        self._keep_room_of_check()
        self.set_asking(form is not None)

    def _keep_room_of_check(self) -> None:
        """Keep the room of Check when the question is answered, and so Next its place; a class needs the room."""
        keep_room(self.check_button, self.answer is not None and not self._is_presenting)

    def is_of_answer(self, widget: QWidget) -> bool:
        """Return whether a widget is a part of the answer's form."""
        return self.answer is not None and self.answer.isAncestorOf(widget)

    def set_asking(self, is_asking: bool) -> None:
        """Take an answer, or only show what was given."""
        self._is_asking = is_asking
        if not is_asking:
            self._keep_height()
        self.check_button.setVisible(is_asking)
        self._show_next_press()
        self.note.setVisible(is_asking)
        if self.answer is not None:
            self.answer.set_open(is_asking)

    def _keep_height(self) -> None:
        """Let the form get no lower once it was checked, or Next would move under the pointer."""
        if self.answer is not None and self.answer.isVisible():
            self.answer.setMinimumHeight(self.answer.height())

    def offer_solution(self, is_offered: bool) -> None:
        """Offer to reveal how the task is done, in front of a class."""
        self._has_solution = is_offered
        self._show_next_press()

    def set_presenting(self, is_presenting: bool) -> None:
        """Fill the button that a clicker presses next, or Next; title and place are shown over the picture."""
        self._is_presenting = is_presenting
        self._keep_room_of_check()
        for widget in (self.title, self.place, self.close_button):
            widget.setVisible(not is_presenting)
        self._show_return()
        self._show_next_press()

    def _show_next_press(self) -> None:
        """Show Reveal where there is something to reveal; a clicker presses it before Next.

        Where a task is done on another page, what leads there comes before Next.
        """
        can_reveal = self._is_asking or (self._has_solution and self._is_presenting)
        is_next = can_reveal and self._is_presenting
        self.reveal_button.setVisible(can_reveal)
        is_there = self._feedback is None and self._record is not None and bool(self._record.task)
        leads_on = is_there and bool(self._link_buttons) and not self._is_presenting
        for button in self._link_buttons:
            set_role(button, "primary" if leads_on else "")
        set_role(self.reveal_button, "primary" if is_next else "")
        set_role(self.next_button, "" if is_next or leads_on else "primary")

    @Slot(str)
    def show_note(self, text: str) -> None:
        """Say how the answer is understood, or why it is not checked yet."""
        self.note.setText(text)
        announce(self, text)

    def show_feedback(self, feedback: LessonFeedback | None) -> None:
        """Show what came of the task, and say it; ``None``: nothing yet."""
        self._feedback = feedback
        self._show_next_press()
        if feedback is not None:
            self._keep_height()
        # A task is judged while it is done: what is said must not move a listing that is typed below.
        is_task = self._record is not None and bool(self._record.task) and self.answer is None
        self._result.setVisible(feedback is not None or (is_task and not self._is_presenting))
        seen = self.parentWidget()
        scrolls = feedback is not None and seen is not None and self.height() > seen.height()
        self._place_result(scrolls=scrolls)
        self._follow_theme()
        said = "" if feedback is None else "\n".join(feedback.sentences)
        self.feedback.setText(unbroken(said))
        if feedback is not None:
            set_role(self.feedback, {True: "good", False: "bad", None: ""}[feedback.is_right])
            announce(self, said)
            self.feedback_shown.emit()

    def _place_result(self, *, scrolls: bool) -> None:
        """Let what is said move no buttons: it stands below them, or above them where they float at the lower edge."""
        is_above = self._column.indexOf(self._result) < self._column.indexOf(self.bar.place)
        if scrolls != is_above:
            self._column.removeWidget(self._result)
            self._column.insertWidget(self._column.indexOf(self.bar.place) + (not scrolls), self._result)

    def show_hint(self, text: str) -> None:
        """Show what a task lacks so far, where that has changed; empty: nothing."""
        before = () if self._feedback is None else self._feedback.sentences
        if (text,) != before and (text or before):
            self.show_feedback(LessonFeedback((text,)) if text else None)

    def show_away(self, is_away: bool) -> None:
        """Offer to return where the learner has left the state of the step."""
        self.return_button.setEnabled(is_away)
        self._show_return()

    def _show_return(self) -> None:
        """Leave out a button that does nothing where there is little room: Page Up returns, too."""
        self.return_button.setVisible(self.return_button.isEnabled() or not self._is_presenting)

    @Slot()
    def _follow_theme(self) -> None:
        theme, ratio = current_theme(), self.devicePixelRatioF()
        record = self._record
        is_right = self._feedback is not None and self._feedback.is_right is True
        is_done = record is not None and bool(record.task) and (record.is_done or is_right)
        keep_room(self.task_icon, record is not None and bool(record.task))
        self.task_icon.setFixedWidth(theme.text_px)
        self.task_icon.setVisible(is_done)
        if is_done:
            # No higher than the line beside it, or the buttons below would move.
            self.task_icon.setPixmap(mark_pixmap(Mark.RIGHT, theme.text_px, ratio))
            self.task_icon.setAccessibleName("done")
        mark = None if self._feedback is None else _MARKS.get(self._feedback.is_right)  # type: ignore[arg-type]
        self._icon.setVisible(mark is not None)
        if mark is not None:
            self._icon.setPixmap(mark_pixmap(mark, theme.text_px + 4, ratio))
            self._icon.setAccessibleName(mark.value)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press a button with Return; elsewhere Return checks the answer."""
        focused = self.focusWidget()
        if event.key() not in (Qt.Key.Key_Return, Qt.Key.Key_Enter) or event.modifiers():
            super().keyPressEvent(event)
        elif isinstance(focused, QPushButton):
            focused.click()
        elif self.check_button.isVisible():
            self.check_requested.emit()
