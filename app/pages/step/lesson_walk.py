"""One lesson that is walked: its steps, what is asked in them, what is done, and where it leads."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from random import SystemRandom
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, Signal, Slot
from PySide6.QtWidgets import QApplication

from app.pages.step.lesson_evidence import has_refuting_step, mistake_of, show_mistake
from app.pages.step.lesson_question import (
    RIGHT,
    SHOWN,
    JudgedAnswer,
    LessonAnswers,
    question_with_outline,
)
from app.pages.step.lesson_records import end_record, paragraphs, recall_record, step_record
from app.pages.step.lesson_states import PANES, LessonStates, OpenState, Wanted
from app.pages.step.lesson_watch import LessonWatch
from app.session.moment import Change
from core import STAGES
from lessons.course.catalogue import Course
from lessons.course.lesson_file import Lesson
from lessons.course.questions import question_of
from lessons.course.record import StepPart
from lessons.course.state import States
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask
from lessons.exercises.scene_digest import scene_digest
from lessons.run_place import RunPlace
from widgets.basics.focus_order import give_focus, tab_stops
from widgets.exercises.mark_grid import MarkGrid
from widgets.lessons.lesson_scroll import LessonScroll
from widgets.lessons.lesson_view import LessonView
from widgets.lessons.records import LessonFeedback, LessonStepRecord, Standing

if TYPE_CHECKING:
    from app.pages.step.page import StepPage

RECALL = -1
"""Number of what comes before the first step: an exercise of an earlier lesson."""
SEEDS = 10_000
"""Seeds of that exercise."""
DONE = "Done."
PEEKED = "You have stepped on. An answer counts as seen now."
SHOW_ME, REVEAL = "Show me", "Reveal"


class LessonWalk(QObject):
    """The pane of a lesson and all that moves in it; one lesson after the other."""

    place_changed = Signal()
    """Another step is shown, or another lesson."""
    task_ended = Signal(int, float, object)
    """Number of a step, its score, and the `JudgedAnswer` that it was given, or ``None``."""
    left = Signal()
    """Something else was opened."""

    def __init__(self, page: "StepPage") -> None:
        super().__init__(page)
        self._page, self._session = page, page.session
        self.grid = MarkGrid(page)
        self.grid.hide()
        self.view = LessonView(self.grid, page)
        self.scroll = LessonScroll(self.view, page)
        self.states = LessonStates(page)
        self.answers = LessonAnswers(self.view, self.grid, self)
        self.watch = LessonWatch(page.session, self)
        self.lesson: Lesson | None = None
        self.number = 0
        """Of the step that is shown; below 0: what comes before the first; the number of steps: the end."""
        self._next_number = 0
        """Of the one that is wanted, and shown in a moment."""
        self.standings: list[Standing] = []
        self.course = Course({})
        self._made: States | None = None
        self._home: OpenState | None = None
        """Where the step began."""
        self._seed = 0
        """Of the exercise that comes first."""
        self._is_showing = self._has_peeked = self._is_revealed = False
        self._connect()

    def _connect(self) -> None:
        view, page = self.view, self._page
        view.back_requested.connect(self.back)
        view.next_requested.connect(self.next)
        view.return_requested.connect(self.return_here)
        view.step_chosen.connect(self.go)
        view.reveal_requested.connect(self.reveal)
        view.link_chosen.connect(page.link_requested)
        # Queued: it has its place then.
        view.feedback_shown.connect(self._show_feedback, Qt.ConnectionType.QueuedConnection)
        self.states.refused.connect(self._refuse)
        self.answers.judged.connect(self._take_judged)
        self.watch.done.connect(self._take_done)
        page.grid.view_changed.connect(self.grid.set_view)
        self._session.changed.connect(self._follow)

    @property
    def is_working(self) -> bool:
        """Whether a state is being traced, or an answer or a task is being looked at."""
        return self.states.is_working or self.answers.is_working or self.watch.is_working

    def stop(self) -> None:
        """End all work."""
        for part in (self.states, self.answers, self.watch):
            part.stop()

    # Going through the lesson.

    def begin(
        self, course: Course, lesson: Lesson, number: int | None, standings: Sequence[Standing]
    ) -> None:
        """Open a lesson at one of its steps; ``None``: at its beginning."""
        self.course, self.lesson, self.standings = course, lesson, list(standings)
        self._made = States(lesson)
        self._seed = SystemRandom().randrange(SEEDS)
        self.states.forget()
        self.go(self.first if number is None else min(max(number, self.first), len(lesson.steps)))

    def begin_anew(self) -> None:
        """Go to the beginning, with nothing done."""
        if self.lesson is not None:
            self.begin(self.course, self.lesson, None, [Standing.OPEN] * len(self.lesson.steps))

    def end(self) -> None:
        """Leave the lesson; what is open stays."""
        self.lesson = self._home = None
        self.states.forget()
        self._end_task()
        self._session.set_predicting(False)

    def _end_task(self) -> None:
        self.answers.end()
        self.watch.end()
        self._page.main_area.show_asked(None)
        self._session.set_asked("", is_open=False, by="lesson")

    @property
    def step(self) -> StepPart | None:
        """The step that is shown; ``None``: what comes before the first one, or the end."""
        assert self.lesson is not None
        is_step = 0 <= self.number < len(self.lesson.steps)
        return self.lesson.steps[self.number] if is_step else None

    @property
    def is_listed(self) -> bool:
        """Whether the lesson is found again by its name."""
        return self.lesson is not None and self.course.lessons.get(self.lesson.name) is self.lesson

    @property
    def following(self) -> Lesson | None:
        """The next lesson."""
        return None if self.lesson is None else self.course.after(self.lesson)

    @property
    def first(self) -> int:
        """The number of what a lesson begins with."""
        return RECALL if self.lesson is not None and self.lesson.part.recall is not None else 0

    @Slot(int)
    def go(self, number: int) -> None:
        """Open a step, or the end of the lesson."""
        if self.lesson is not None:
            self._next_number = number
            show = partial(self._show_step, self.lesson, number)
            self.states.want(partial(self._wanted, self.lesson, number), show)

    @Slot()
    def next(self) -> None:
        """Go to the next step, or from the end to the next lesson."""
        if self.lesson is None:
            return
        if self._next_number < len(self.lesson.steps):
            self.go(self._next_number + 1)
        elif self.following is not None:
            self._page.lessons.open(self.following.name)

    @Slot()
    def back(self) -> None:
        """Go to the previous step."""
        if self._next_number > self.first:
            self.go(self._next_number - 1)

    @Slot()
    def return_here(self) -> None:
        """Open the step as it was at first."""
        self.go(self.number)

    def _wanted(self, lesson: Lesson, number: int) -> Wanted:
        """Return the state of a step, and what it asks; of the end, where the next lesson begins."""
        states = self._states_of(lesson)
        if number < 0 and lesson.part.recall is not None:
            question = ask(TEMPLATES[lesson.part.recall], self._seed)
            first = states.of_step(0)
            before = replace(
                first, place=RunPlace(first.stage), other=None, printed="", buffer="", view="pixels"
            )
            return before, question_with_outline(lesson, number, question)
        if number < len(lesson.steps):
            state = states.of_step(number)
            if lesson.steps[number].answer is None:
                return state, None
            return state, question_with_outline(lesson, number, question_of(lesson, number, states))
        following = self.course.after(lesson)
        if following is None:
            return states.of_step(number - 1), None
        return States(following).of_step(0), None

    def _states_of(self, lesson: Lesson) -> States:
        made = self._made
        return made if made is not None and self.lesson is lesson else States(lesson)

    def _prepare(self) -> None:
        """Trace the next state while this one is looked at."""
        assert self.lesson is not None
        lesson, number = self.lesson, self.number
        if number < len(lesson.steps):
            self.states.prepare(partial(self._wanted, lesson, number + 1))

    # Showing.

    def _show(self, shown: OpenState, *, is_hidden: bool) -> None:
        """Show a state, as the lesson's own doing."""
        self._is_showing = True
        digest = scene_digest(shown.document.scene) if is_hidden else ""
        self._session.set_asked(digest, is_open=is_hidden, by="lesson")
        self.states.show(shown, is_hidden=is_hidden)
        self._is_showing = False
        self._show_away()

    def _show_step(self, lesson: Lesson, number: int, shown: OpenState) -> None:
        """Show the step that was wanted."""
        if lesson is not self.lesson:
            return
        self.number, self._home = number, shown
        step, asked = self.step, shown.asked
        self.answers.end()
        self.watch.end()
        self._has_peeked = self._is_revealed = False
        page = self._page
        is_hidden = asked is not None or (step is None and self._begins_hidden())
        page.tell("")  # What was said of the step before no longer holds.
        self._show(shown, is_hidden=is_hidden)
        page.show_desk_panes((*PANES, *shown.state.panes))
        self.scroll.keep_in_sight(None)
        form = None if asked is None else asked.question.draft.answer.form
        self.view.show_step(self._record(), form)
        self.view.reveal_button.setText(REVEAL)
        page.side.let_inspector_give_way(asked is not None and shown.cursor.position == 0)
        if asked is not None:
            self.answers.begin(asked)
        page.main_area.show_asked(self.grid if asked is not None and asked.is_on_picture else None)
        if step is not None and step.until is not None:
            self.watch.begin(step.until)
        elif step is not None and step.answer is None:
            self._stand(Standing.DONE)
        self._give_keyboard()
        self._prepare()
        self.place_changed.emit()

    @Slot()
    def _show_feedback(self) -> None:
        """Bring what is said of a task into sight, where the pane scrolls."""
        self.scroll.keep_in_sight(self.view.feedback)

    def _give_keyboard(self) -> None:
        """Let the next key answer: a digit would go to a stage else. A clicker's keys are nobody's."""
        page, focused = self._page, QApplication.focusWidget()
        if page.is_presenting or not page.isVisible():
            return
        home = self._home
        if home is not None and home.asked is not None and self.answers.is_open:
            stops = [self.grid] if home.asked.is_on_picture else tab_stops([self.view])
            by_mouse = QApplication.mouseButtons() != Qt.MouseButton.NoButton
            reason = Qt.FocusReason.MouseFocusReason if by_mouse else Qt.FocusReason.TabFocusReason
            inside = [stop for stop in stops if stop is self.grid or self.view.is_of_answer(stop)]
            if inside:
                give_focus(inside[0], reason)
        elif focused is None or focused is self.grid or self.view.is_of_answer(focused):
            page.take_focus()

    def _begins_hidden(self) -> bool:
        """Return whether the next lesson begins with a question."""
        following = self.following
        return following is not None and following.steps[0].answer is not None

    def _record(self) -> LessonStepRecord:
        lesson, home = self.lesson, self._home
        assert lesson is not None
        if self.number < 0 and home is not None and home.asked is not None:
            return recall_record(lesson, home.asked.question, self.standings)
        if self.step is None:
            return end_record(lesson, self.following, self.standings)
        return step_record(lesson, self.number, self.standings)

    def _stand(self, standing: Standing) -> None:
        """Show how far the learner is with the step; what is done stays so."""
        if self.step is None:
            return
        before = self.standings[self.number]
        if before is not Standing.DONE and before is not standing:
            self.standings[self.number] = standing
            self.view.show_standings(self._record())

    def _show_away(self) -> None:
        """Say whether the learner has left where the step began."""
        home, session = self._home, self._session
        is_there = home is not None and session.document is home.document and session.cursor == home.cursor
        self.view.show_away(not is_there)

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._page.refuse(f"This step cannot be opened: {error}. The open scene is unchanged.")

    # What the learner does.

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        """Follow what is done outside of the pane."""
        if self.lesson is None or self._is_showing:
            return
        if Change.OPENED in what and Change.RETURNED not in what:
            self.left.emit()
            return
        if self.answers.is_open and not self._session.is_predicting and not self._is_revealed:
            self._show_right()
        elif self.answers.is_open and Change.CURSOR in what and self._is_ahead() and not self._has_peeked:
            self._has_peeked = True
            self._page.tell(PEEKED)
        self._show_away()

    def _is_ahead(self) -> bool:
        """Return whether the cursor has gone beyond where the question is asked."""
        assert self._home is not None
        here, there = self._session.cursor, self._home.cursor
        places = [(STAGES.index(cursor.stage), cursor.position) for cursor in (here, there)]
        return places[0] > places[1]

    @Slot(object)
    def _take_judged(self, judged: JudgedAnswer) -> None:
        """Go on after an answer."""
        is_right, is_first = judged.outcome.is_right, not (self._has_peeked or self._is_revealed)
        if is_right:
            self._stand(Standing.DONE if is_first else Standing.SEEN)
            self._conclude(RIGHT, is_right=True)
        elif self._has_evidence():
            self.view.reveal_button.setText(SHOW_ME)
        self.task_ended.emit(self.number, float(is_right and is_first), judged)

    @Slot()
    def _take_done(self) -> None:
        """Say at once that a task is done."""
        self._stand(Standing.DONE)
        step = self.step
        after = () if step is None or step.after is None else (paragraphs(step.after),)
        self.view.show_feedback(LessonFeedback((DONE, *after), is_right=True))
        self.task_ended.emit(self.number, 1.0, None)

    def _has_evidence(self) -> bool:
        """Return whether the step or the run that refutes the last answer is offered."""
        judged, step = self.answers.last, self.step
        if judged is None or step is None or self._is_revealed or not self.answers.is_evidence_wanted:
            return False
        return has_refuting_step(judged, step) or bool(mistake_of(judged))

    @Slot()
    def reveal(self) -> None:
        """Show what refutes the last answer, where that is offered, or else what is right."""
        if self._has_evidence():
            self._is_revealed = True
            self._stand(Standing.SEEN)
            self.view.reveal_button.setText(REVEAL)
            self._refute()
        elif self.answers.is_open:
            self._show_right()

    def _refute(self) -> None:
        judged, step, states, home = self.answers.last, self.step, self._made, self._home
        assert judged is not None
        assert step is not None
        assert states is not None
        assert home is not None
        if has_refuting_step(judged, step):
            self.states.want(
                partial(_refuting, states, self.number, judged.outcome.wrong), self._show_revealed
            )
        else:
            self._show_revealed(home)
            show_mistake(self._page, home.state, mistake_of(judged))

    def _show_right(self) -> None:
        """Show what is right: the step is seen, not done."""
        number = self.number
        self.answers.show_right()
        self._stand(Standing.SEEN)
        self._conclude(SHOWN, is_right=None)
        self.task_ended.emit(number, 0.0, None)

    def _conclude(self, said: str, is_right: bool | None) -> None:
        """Show what comes after the answer."""
        step, asked, states, home = self.step, self.answers.asked, self._made, self._home
        assert asked is not None
        assert home is not None
        after = paragraphs(asked.question.draft.reveal)
        self.view.show_feedback(LessonFeedback((said, *filter(None, [after])), is_right=is_right))
        self._give_keyboard()
        if step is not None and step.reveal is not None and states is not None:
            self.states.want(partial(_revealed, states, self.number), self._show_revealed)
        elif step is not None:
            self._show_revealed(home, keeps_picture=asked.is_on_picture)

    def _show_revealed(self, shown: OpenState, *, keeps_picture: bool = False) -> None:
        """Show the state of the answer; marks on a picture stay in sight where there is no other to be seen."""
        self._page.tell("")
        self._page.side.let_inspector_give_way(False)
        self._show(shown, is_hidden=False)
        if not keeps_picture:
            self._page.main_area.show_asked(None)


def _revealed(states: States, number: int) -> Wanted:
    state = states.of_reveal(number)
    assert state is not None
    return state, None


def _refuting(states: States, number: int, wrong: int | None) -> Wanted:
    assert wrong is not None
    state = states.of_wrong(number, wrong)
    assert state is not None
    return state, None
