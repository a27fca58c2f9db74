"""One lesson that is walked: its steps one after the other, what comes before and after them."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from importlib import import_module
from random import SystemRandom
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.pages.lessons.question import JudgedAnswer, question_with_outline
from app.pages.lessons.states import OpenState, Wanted, end_record, recall_record, step_record
from app.pages.lessons.task import LessonTask
from lessons.course.catalogue import Course, Lesson
from lessons.course.record import StepPart
from lessons.course.state import States
from lessons.course.tasks import question_of
from lessons.exercises.question import ask
from lessons.run_place import RunPlace
from widgets.exercises.records import LessonStepRecord, Standing

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


RECALL = -1
"""Number of what comes before the first step: an exercise of an earlier lesson."""
SEEDS = 10_000
"""Seeds of that exercise."""


class LessonWalk(QObject):
    """Goes through lessons, one after the other."""

    place_changed = Signal()
    """Another step is shown, or another lesson."""
    task_ended = Signal(int, float, object)
    """Number of a step, its score, and the `JudgedAnswer` that it was given, or ``None``."""
    begun_in_vain = Signal()
    """Nothing of the lesson can be shown."""

    def __init__(self, page: "StepPage") -> None:
        super().__init__(page)
        self._page = page
        self.task = LessonTask(page)
        self.view, self.answers, self.states = self.task.view, self.task.answers, self.task.states
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
        self._was_done = False
        """Whether the step had been done when it was opened."""
        self._recall, self._seed = "", 0
        """The exercise that comes first, and its seed; empty: none does."""
        self.view.back_requested.connect(self.back)
        self.view.next_requested.connect(self.next)
        self.view.return_requested.connect(self.return_here)
        self.view.step_chosen.connect(self.go)
        self.view.link_chosen.connect(page.link_requested)
        self.states.refused.connect(self._refuse)
        self.task.standing_changed.connect(self._stand)
        self.task.ended.connect(self._end_task)

    @property
    def is_working(self) -> bool:
        """Whether a state is being traced, or an answer or a task is being looked at."""
        return self.task.is_working

    def begin(
        self, course: Course, lesson: Lesson, number: int | None, standings: Sequence[Standing], recall: str
    ) -> None:
        """Open a lesson at one of its steps; ``None``: at its beginning, which is the exercise ``recall`` if any."""
        self.course, self.lesson, self.standings = course, lesson, list(standings)
        self._recall = recall
        self._made = States(lesson)
        self._seed = SystemRandom().randrange(SEEDS)
        self.states.forget()
        self.go(self.first if number is None else min(max(number, self.first), len(lesson.steps)))

    def begin_anew(self) -> None:
        """Go to the beginning, with nothing done."""
        if self.lesson is not None:
            standings = [Standing.OPEN] * len(self.lesson.steps)
            self.begin(self.course, self.lesson, None, standings, self._recall)

    def end(self) -> None:
        """Leave the lesson; what is open stays."""
        self.lesson = self._home = None
        self.task.end()

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
    def preceding(self) -> Lesson | None:
        """The lesson that this one follows."""
        lessons = self.course.lessons.values()
        return next((each for each in lessons if self.course.after(each) is self.lesson), None)

    @property
    def first(self) -> int:
        """The number of what a lesson begins with."""
        return RECALL if self._recall else 0

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
        else:
            self._page.tell("This is the end of the last lesson.")

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
        """Return the state of a step, and what it asks; the end keeps the last step's, or what it revealed."""
        states = self._states_of(lesson)
        if number < 0 and self._recall:
            from lessons.exercises.catalogue import TEMPLATES  # Not before one of them is asked.

            question = ask(TEMPLATES[self._recall], self._seed)
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
        import_module("lessons.exercises.catalogue")  # The end names some of them: `end_record`.
        if self._is_last_open():
            return states.of_step(number - 1), None
        return states.of_reveal(number - 1) or states.of_solution(number - 1), None

    def _is_last_open(self) -> bool:
        """Return whether the last step is neither done nor seen: the end does not give its answer away."""
        return self.standings[-1] is Standing.OPEN

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

    def _show_step(self, lesson: Lesson, number: int, shown: OpenState) -> None:
        """Show the step that was wanted."""
        made = self._made
        if lesson is not self.lesson or made is None:
            return
        self.number, self._home = number, shown
        self._was_done = self.step is not None and self.standings[number] is Standing.DONE
        is_end = number == len(lesson.steps)
        is_open = is_end and lesson.steps[-1].answer is not None and self._is_last_open()
        is_hidden = shown.asked is not None or is_open
        self._page.side.show_lesson(self.task.scroll)  # Not before there is something to read.
        self.task.begin(self.step, number, made, shown, self._record(), is_hidden=is_hidden)
        self._prepare()
        self.place_changed.emit()

    def _record(self) -> LessonStepRecord:
        lesson, home = self.lesson, self._home
        assert lesson is not None
        if self.number < 0 and home is not None and home.asked is not None:
            return recall_record(lesson, self.course, home.asked.question, self.standings)
        if self.step is None:
            return end_record(lesson, self.following, self.standings)
        number = self.number
        record = step_record(lesson, number, self.standings, was_done=self._was_done)
        return replace(record, has_previous=number > self.first)

    @Slot(object)
    def _stand(self, standing: Standing) -> None:
        """Show how far the learner is with the step; what is done stays so."""
        before = Standing.DONE if self.step is None else self.standings[self.number]
        if before is not Standing.DONE and before is not standing:
            self.standings[self.number] = standing
            self.view.show_standings(self._record())

    @Slot(float, object)
    def _end_task(self, score: float, judged: JudgedAnswer | None) -> None:
        self.task_ended.emit(self.number, score, judged)

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._page.refuse(f"This step cannot be opened: {error}. The open scene is unchanged.")
        if self._home is None:
            self.begun_in_vain.emit()
