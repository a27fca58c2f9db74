"""What is kept of lessons: read when one is opened, and written in the background, one attempt after the other."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job
from app.files.attempts import attempt_file
from app.files.unfinished_answers import read_answers
from app.pages.step.lesson_question import JudgedAnswer
from lessons.attempts.lesson_steps import begin_anew, lesson_attempt, standings
from lessons.attempts.record import DEFAULT_USER, Attempt, attempt_of
from lessons.course.lesson_file import Lesson
from widgets.lessons.records import Standing


@dataclass(frozen=True)
class Progress:
    """How far a user is with a lesson."""

    user: str
    standings: tuple[Standing, ...]
    trouble: str = ""
    """Why it cannot be read, as a sentence; empty: all is well."""


def progress_in(lesson: Lesson) -> Progress:
    """Return how far the chosen user is with a lesson; who cannot be read begins."""
    user = DEFAULT_USER
    # Where nobody has been chosen there is no file; the Exercises page says what is wrong with a broken one.
    with suppress(OSError, ValueError):
        user = read_answers().user
    try:
        found = standings(attempt_file().attempts(user), lesson)
    except OSError as problem:
        return Progress(user, (Standing.OPEN,) * len(lesson.steps), f"{problem}.")
    return Progress(user, tuple(Standing(each.value) for each in found))


class LessonAttempts(QObject):
    """Keeps what a user does in lessons."""

    failed = Signal(str)
    """Why something is not kept, in sentences."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.user = DEFAULT_USER
        self._waiting: list[Attempt] = []
        self._job = Job(self, expected=(OSError,))
        self._job.succeeded.connect(self._go_on)
        self._job.failed.connect(self._fail)

    @property
    def is_working(self) -> bool:
        """Whether something is being written."""
        return self._job.is_running

    def stop(self) -> None:
        """Write what waits, and end."""
        self._job.shut_down()
        for attempt in self._waiting:
            try:
                attempt_file().add(attempt)
            except OSError as problem:
                self._fail(problem)
        self._waiting.clear()

    def keep(self, lesson: Lesson, number: int, score: float, judged: JudgedAnswer | None) -> None:
        """Keep what became of a step: an answer, or a task that is done, or shown."""
        now = datetime.now(UTC)
        if judged is None:
            if number >= 0:  # An exercise that was only looked at is no attempt.
                self._add(lesson_attempt(self.user, lesson, number, now, score=score))
            return
        question, response, judgement = judged.asked.question, judged.response, judged.outcome.judgement
        if number < 0:
            self._add(attempt_of(self.user, question, response, judgement, judged.seconds, now))
            return
        wrong = (part.mistake for part in lesson.steps[number].wrong)
        self._add(
            lesson_attempt(
                self.user,
                lesson,
                number,
                now,
                score=score,
                answer=question.draft.answer.text(response),
                verdict=judgement.verdict.counts,
                asked=tuple(dict.fromkeys([*question.draft.mistakes, *filter(None, wrong)])),
                mistakes=judgement.mistakes,
                seconds=judged.seconds,
            )
        )

    def begin_anew(self, lesson: Lesson) -> None:
        """Keep that a lesson is begun once more."""
        self._add(begin_anew(self.user, lesson, datetime.now(UTC)))

    def _add(self, attempt: Attempt) -> None:
        self._waiting.append(attempt)
        if not self._job.is_running:
            self._go_on()

    @Slot()
    def _go_on(self) -> None:
        if self._waiting:
            self._job.call(_adding(self._waiting.pop(0)))

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self.failed.emit(f"This is not kept for the next start: {error}.")
        self._go_on()


def _adding(attempt: Attempt) -> Callable[[], str]:
    return partial(attempt_file().add, attempt)
