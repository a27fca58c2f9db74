"""One lesson that is walked: its steps, what is asked in them, what is done, and where it leads."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.pages.step.ab_choice import OtherRun
from app.pages.step.lesson_question import (
    RIGHT,
    SHOWN,
    JudgedAnswer,
    LessonAnswers,
    question_with_outline,
)
from app.pages.step.lesson_states import PANES, LessonStates, OpenState, Wanted
from app.pages.step.lesson_watch import LessonWatch
from app.session.moment import Change
from core.scene import ClipScene
from lessons.course.catalogue import Course
from lessons.course.lesson_file import Lesson
from lessons.course.questions import question_of
from lessons.course.record import StepPart
from lessons.course.state import States
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.scene_digest import scene_digest
from lessons.mistakes.shelf import SHELF
from widgets.exercises.mark_grid import MarkGrid
from widgets.lessons.lesson_scroll import LessonScroll
from widgets.lessons.lesson_view import LessonView
from widgets.lessons.records import LessonFeedback, LessonStepRecord, Standing

if TYPE_CHECKING:
    from app.pages.step.page import StepPage

KINDS = {
    "look": "",
    "predict": "Predict",
    "do": "Do it",
    "break": "Break it",
    "measure": "Measure",
}
"""What a step wants to be done, by its kind."""
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
        """Of the step that is shown, or will be in a moment; the number of steps: the end."""
        self.standings: list[Standing] = []
        self._course = Course({})
        self._made: States | None = None
        self._shown: OpenState | None = None
        """What was opened last for the step."""
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

    def begin(self, course: Course, lesson: Lesson, number: int, standings: Sequence[Standing]) -> None:
        """Open a lesson at one of its steps."""
        self._course, self.lesson, self.standings = course, lesson, list(standings)
        self._made = States(lesson)
        self.states.forget()
        self.go(min(max(number, 0), len(lesson.steps)))

    def end(self) -> None:
        """Leave the lesson; what is open stays."""
        self.lesson = self._shown = None
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
        """The step that is shown; ``None``: the end."""
        assert self.lesson is not None
        return self.lesson.steps[self.number] if self.number < len(self.lesson.steps) else None

    @property
    def following(self) -> Lesson | None:
        """The next lesson."""
        return None if self.lesson is None else self._course.after(self.lesson)

    @Slot(int)
    def go(self, number: int) -> None:
        """Open a step, or the end of the lesson."""
        if self.lesson is not None:
            self.number = number
            self.states.want(partial(self._wanted, self.lesson, number), self._show_step)

    @Slot()
    def next(self) -> None:
        """Go to the next step, or from the end to the next lesson."""
        if self.lesson is None:
            return
        if self.number < len(self.lesson.steps):
            self.go(self.number + 1)
        elif self.following is not None:
            self._page.lessons.open(self.following.name)

    @Slot()
    def back(self) -> None:
        """Go to the previous step."""
        if self.number > 0:
            self.go(self.number - 1)

    @Slot()
    def return_here(self) -> None:
        """Open the step as it was at first."""
        self.go(self.number)

    def _wanted(self, lesson: Lesson, number: int) -> Wanted:
        """Return the state of a step, and what it asks; of the end, where the next lesson begins."""
        if number < len(lesson.steps):
            states = self._states_of(lesson)
            state = states.of_step(number)
            if lesson.steps[number].answer is None:
                return state, None
            return state, question_with_outline(lesson, number, question_of(lesson, number, states))
        following = self._course.after(lesson)
        if following is None:
            return self._states_of(lesson).of_step(number - 1), None
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
        self._shown = shown
        self._is_showing = False
        self._show_away()

    def _show_step(self, shown: OpenState) -> None:
        """Show the step that was wanted."""
        assert self.lesson is not None
        step, asked = self.step, shown.asked
        self.answers.end()
        self.watch.end()
        self._has_peeked = self._is_revealed = False
        page = self._page
        is_hidden = asked is not None or (step is None and self._begins_hidden())
        page.tell("")  # What was said of the step before no longer holds.
        self._show(shown, is_hidden=is_hidden)
        page.show_desk_panes((*PANES, *shown.state.panes))
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
        self._prepare()
        self.place_changed.emit()

    def _begins_hidden(self) -> bool:
        """Return whether the next lesson begins with a question."""
        following = self.following
        return following is not None and following.steps[0].answer is not None

    def _record(self) -> LessonStepRecord:
        lesson, step = self.lesson, self.step
        assert lesson is not None
        if step is None:
            return self._end_record(lesson)
        return LessonStepRecord(
            title=lesson.title,
            text=paragraphs(step.text),
            number=self.number,
            standings=tuple(self.standings),
            lead=lesson.question if self.number == 0 else "",
            task=paragraphs(step.task or "") or KINDS[step.kind],
            links=((step.show, "Open it"),) if step.show else (),
        )

    def _end_record(self, lesson: Lesson) -> LessonStepRecord:
        part, following = lesson.part, self.following
        said = [f"You can now answer: {paragraphs(part.answers)}" if part.answers else ""]
        if following is not None:
            question = part.next.text if part.next is not None else following.question
            said.append(f"Next: {following.title}. {paragraphs(question)}")
        links = tuple((f"exercise/{name}", f"Exercise: {TEMPLATES[name].title}") for name in part.exercises)
        return LessonStepRecord(
            title=lesson.title,
            text="\n".join(filter(None, said)) or "This is the end of the lesson.",
            number=self.number,
            standings=tuple(self.standings),
            links=links,
            next_title="Next lesson",
            has_next=following is not None,
        )

    def _stand(self, standing: Standing) -> None:
        """Show how far the learner is with the step; what is done stays so."""
        before = self.standings[self.number]
        if before is not Standing.DONE and before is not standing:
            self.standings[self.number] = standing
            self.view.show_standings(self._record())

    def _show_away(self) -> None:
        """Say whether the learner has left what the step has opened."""
        shown, session = self._shown, self._session
        is_there = shown is not None and session.document is shown.document and session.cursor == shown.cursor
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
        if Change.OPENED in what:
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
        from core import STAGES

        assert self._shown is not None
        here, there = self._session.cursor, self._shown.cursor
        places = [(STAGES.index(cursor.stage), cursor.position) for cursor in (here, there)]
        return places[0] > places[1]

    @Slot(object)
    def _take_judged(self, judged: JudgedAnswer) -> None:
        """Go on after an answer."""
        is_right, is_first = judged.outcome.is_right, not (self._has_peeked or self._is_revealed)
        if is_right:
            self._stand(Standing.DONE if is_first else Standing.SEEN)
            self._conclude(RIGHT, is_right=True)
        elif self.answers.is_evidence_wanted and self._evidence() is not None:
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

    @Slot()
    def reveal(self) -> None:
        """Show the step that refutes the last answer, where that is offered, or else what is right."""
        evidence = self._evidence() if self.answers.is_evidence_wanted and not self._is_revealed else None
        if evidence is not None:
            self._is_revealed = True
            self._stand(Standing.SEEN)
            self.view.reveal_button.setText(REVEAL)
            evidence()
        elif self.answers.is_open:
            self._show_right()

    def _show_right(self) -> None:
        """Show what is right: the step is seen, not done."""
        number = self.number
        self.answers.show_right()
        self._stand(Standing.SEEN)
        self._conclude(SHOWN, is_right=None)
        self.task_ended.emit(number, 0.0, None)

    def _conclude(self, said: str, is_right: bool | None) -> None:
        """Show what comes after the answer."""
        step, asked = self.step, self.answers.asked
        assert step is not None
        after = () if step.after is None else (paragraphs(step.after),)
        self.view.show_feedback(LessonFeedback((said, *after), is_right=is_right))
        lesson, number, states = self.lesson, self.number, self._made
        assert lesson is not None
        assert states is not None
        if step.reveal is not None:
            self.states.want(partial(_revealed, states, number), self._show_revealed)
        elif self._shown is not None:
            is_marked = asked is not None and asked.is_on_picture
            self._show_revealed(self._shown, keeps_picture=is_marked)

    def _show_revealed(self, shown: OpenState, *, keeps_picture: bool = False) -> None:
        """Show the state of the answer; marks on a picture stay in sight where there is no other to be seen."""
        self._page.tell("")
        self._page.side.let_inspector_give_way(False)
        self._show(shown, is_hidden=False)
        if not keeps_picture:
            self._page.main_area.show_asked(None)

    # What refutes an answer.

    def _evidence(self) -> Callable[[], None] | None:
        """Return what shows why the last answer is wrong; ``None``: there is nothing but the right answer."""
        judged, step, states = self.answers.last, self.step, self._made
        if judged is None or step is None or states is None or judged.outcome.is_right:
            return None
        wrong = judged.outcome.wrong
        if wrong is not None and step.wrong[wrong].at is not None:
            wanted = partial(_refuting, states, self.number, wrong)
            return lambda: self.states.want(wanted, self._show_revealed)
        for name in judged.outcome.judgement.mistakes:
            if name in SHELF and SHELF[name].is_run:
                return partial(self._show_mistake, name)
        return None

    def _show_mistake(self, name: str) -> None:
        """Show the run with a mistake beside the right one, at their first difference."""
        assert self._shown is not None
        page, state, twin = self._page, self._shown.state, SHELF[name]
        self._show_revealed(self._shown)
        other = twin.change_settings(state.settings)
        scene = twin.change_scene(state.scene) if isinstance(state.scene, ClipScene) else state.scene
        run = OtherRun(self._session.document.scene, scene, f"with the mistake: {name.replace('-', ' ')}")
        page.comparing.set_differences(state.settings.differences(other), run)
        page.show_view("compare")
        if state.pixel is not None:
            self._session.set_pin(state.pixel)
            page.comparing.meet_at(state.pixel)
            page.tell("")


def paragraphs(text: str) -> str:
    """Return a text of a file, whose lines are those of its author, as paragraphs."""
    return "\n".join(" ".join(part.split()) for part in text.split("\n\n"))


def _revealed(states: States, number: int) -> Wanted:
    state = states.of_reveal(number)
    assert state is not None
    return state, None


def _refuting(states: States, number: int, wrong: int) -> Wanted:
    state = states.of_wrong(number, wrong)
    assert state is not None
    return state, None
