"""The question of a step that is to be predicted: takes the answer, has it judged and kept, and shows marks."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job, Progress
from app.files.kept_work import read_answers
from app.files.user_folders import attempt_file
from app.pages.exercises.answers import (
    SECONDS,
    Live,
    Tried,
    are_marks_shown,
    drawing,
    marks_of,
    outline_of,
    size_of,
    trying,
)
from app.pages.exercises.feedback import not_checked_text, show_tried
from core.lanes.run import bounded
from core.records.cells import Marks
from lessons.attempts.record import (
    DEFAULT_USER,
    Attempt,
    attempt_of,
    begin_anew,
    lesson_attempt,
    recall_for,
    standings,
)
from lessons.course.catalogue import Course, Lesson
from lessons.course.tasks import Outcome, outcome_of
from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.answers.listings import CannotRunError, CodeAnswer
from lessons.exercises.answers.marked import PixelAnswer
from lessons.exercises.question import Question, judge
from lessons.mistakes.shelf import MISTAKES
from widgets.exercises.mark_grid import AnswerView, MarkGrid
from widgets.exercises.records import MOST_WRONG, LessonFeedback, Standing
from widgets.grid.geometry import GridGeometry
from widgets.lessons.lesson_view import LessonView

# The question of a step that is to be predicted: takes the answer, has it judged, and says what is wrong
# with it.


RIGHT, SHOWN = "Right.", "This is the answer."
UNKNOWN = "There is no hint for this answer. Try again, or choose Reveal: that shows the step."


@dataclass(frozen=True, eq=False)
class LessonQuestion:
    """What a step asks, with the outline of its scene."""

    lesson: Lesson
    number: int
    """Of the step; below 0: it is an exercise of an earlier lesson."""
    question: Question
    outline: GridGeometry | None

    @property
    def is_on_picture(self) -> bool:
        """Whether a picture is shown with it: one that it is answered on, or that of an exercise."""
        if self.number < 0:
            return size_of(self.question.draft) is not None
        return self.question.draft.answer.kind in ("pixels", "spot", "places", "break")

    @property
    def is_typed(self) -> bool:
        """Whether a listing is the answer."""
        return self.question.draft.answer.kind == "code"

    def outcome(self, response: Response) -> Outcome:
        """Judge an answer that was read."""
        if self.number < 0:
            return Outcome(judge(self.question, response))
        return outcome_of(self.lesson, self.number, self.question, response)


@dataclass(frozen=True, eq=False)
class JudgedAnswer:
    """An answer that is judged."""

    asked: LessonQuestion
    given: object
    response: Response
    outcome: Outcome
    marks: Marks
    seconds: float
    """Since the question was asked."""


def question_with_outline(lesson: Lesson, number: int, question: Question) -> LessonQuestion:
    """Return a question with the outline of its scene."""
    return LessonQuestion(lesson, number, question, outline_of(question.draft, question.template.stage))


class LessonAnswers(QObject):
    """Asks one question at a time in the lesson's pane."""

    judged = Signal(object)
    """A `JudgedAnswer`."""

    def __init__(self, view: LessonView, grid: MarkGrid, parent: QObject) -> None:
        super().__init__(parent)
        self._view, self._grid = view, grid
        self.asked: LessonQuestion | None = None
        self.is_open = False
        """Whether an answer is wanted."""
        self.last: JudgedAnswer | None = None
        """The last answer; ``None``: there is none yet."""
        self.wrong_count = 0
        self._left_out: object = None
        self._begun = monotonic()
        self._judging = Job(self, succeeded=self._show_judged, failed=self._show_not_checked)
        self._drawing = Job(self, succeeded=self._show_live)
        self._trying = Job(self, succeeded=self._show_tried)
        view.check_requested.connect(self.check)
        view.answer_changed.connect(self._follow_answer)

    def end(self) -> None:
        """Ask nothing any more."""
        self.asked, self.is_open, self.last, self.wrong_count = None, False, None, 0
        for job in (self._judging, self._drawing, self._trying):
            job.cancel()

    def begin(self, asked: LessonQuestion) -> None:
        """Ask a question, whose form is in the pane already; the picture is empty."""
        self.end()
        self.asked, self.is_open, self._left_out, self._begun = asked, True, None, monotonic()
        self._form.stop_requested.connect(self.stop_check)
        draft = asked.question.draft
        size = size_of(draft)
        if size is not None:
            self._grid.show_raster(size, asked.outline, draft.pixel)
        self._draw_live()

    @property
    def _form(self) -> AnswerView:
        assert self._view.answer is not None
        return self._view.answer

    @Slot()
    def _follow_answer(self) -> None:
        """Forget what was found of another answer."""
        if self.is_open:
            self._form.show_marks(None)
            self._view.show_feedback(None)
            self._draw_live()
            self._try()

    def _try(self) -> None:
        """Find why a listing that is typed cannot run."""
        work = None if self.asked is None else trying(self.asked.question.draft, self._form.given())
        if work is not None:
            self._view.show_note("")  # It was about another text.
            self._trying.start(work)

    @Slot(object)
    def _show_tried(self, tried: Tried) -> None:
        if self.is_open and self._form.given() == tried.given and (said := show_tried(self._form, tried)):
            self._view.show_note(said)

    def _draw_live(self) -> None:
        """Draw what is shown of an answer while it is given."""
        work = None if self.asked is None else drawing(self.asked.question, self._form.given())
        if work is not None:
            self._drawing.start(work)

    @Slot(object)
    def _show_live(self, shown: Live) -> None:
        self._grid.show_geometry(shown.outline)
        self._grid.show_picture(shown.picture, shown.overlays)

    def fill(self, response: Response) -> None:
        """Fill the form with an answer, as if the learner had given it."""
        if self.asked is not None:
            self._form.show_given(self.asked.question.draft.answer.given(response))
            self._follow_answer()

    @Slot()
    def check(self) -> None:
        """Judge the answer; what means nothing yet is not judged and costs nothing."""
        asked = self.asked
        if asked is None or not self.is_open or self._judging.is_running:
            return
        answer, given = asked.question.draft.answer, self._form.given()
        try:
            if unread := self._form.unread():
                raise NotCheckedError(unread)
            response = answer.read(given)
        except NotCheckedError as problem:
            self._view.show_note(not_checked_text(problem))
            return
        left_out = answer.left_out(response)
        if left_out and given != self._left_out:
            self._left_out = given
            self._view.show_note(f"{left_out}. Check anyway? Then choose Check again.")
            return
        self._view.show_note("")
        begun = self._begun

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> JudgedAnswer:
            with bounded(SECONDS, is_cancelled):  # A listing may not end by itself.
                outcome = asked.outcome(response)
            marks = marks_of(asked.question, outcome.judgement.verdict)
            return JudgedAnswer(asked, given, response, outcome, marks, monotonic() - begun)

        self._trying.cancel()  # What the check finds holds.
        self._judging.start(work)

    @Slot()
    def stop_check(self) -> None:
        """End a check that runs: nothing is charged."""
        if self._judging.is_running:
            self._judging.cancel()
            self._view.show_note("Not checked: you have stopped it.")

    @Slot(object)
    def _show_not_checked(self, error: Exception) -> None:
        """Say why the answer is not judged: its run could not go on."""
        if self.asked is not None and isinstance(error, CannotRunError):
            self._form.show_problem((*error.place, error.sentence))
        self._view.show_note(not_checked_text(error))

    @Slot(object)
    def _show_judged(self, judged: JudgedAnswer) -> None:
        if judged.asked is not self.asked:
            return
        self.last = judged
        are_shown = are_marks_shown(
            judged.asked.question.draft, is_right=judged.outcome.is_right, is_first=self.wrong_count == 0
        )
        if are_shown and self._form.given() == judged.given:
            self._form.show_marks(judged.marks)
        if judged.outcome.is_right:
            self.close()
        else:
            self.wrong_count += 1
            self._view.show_feedback(LessonFeedback(wrong_sentences(judged), is_right=False))
        self.judged.emit(judged)

    def close(self) -> None:
        """Take no answer any more; what was given stays in sight."""
        self.is_open = False
        self._view.set_asking(False)

    def show_right(self) -> None:
        """Fill in the right answer, and take none any more."""
        if self.asked is not None:
            answer: Any = self.asked.question.draft.answer
            self._drawing.cancel()
            self._form.show_marks(None)
            self._form.show_given(answer.given(answer.reference))
            self._draw_live()
            self.close()

    @property
    def is_evidence_wanted(self) -> bool:
        """Whether the learner was wrong so often that the step which refutes the answer is offered."""
        return self.is_open and self.wrong_count >= MOST_WRONG


def wrong_sentences(judged: JudgedAnswer) -> tuple[str, ...]:
    """Return what is said of a wrong answer: its belief, or its mistake by name, or at least where it goes wrong."""
    judgement, draft = judged.outcome.judgement, judged.asked.question.draft
    if judged.outcome.wrong is not None:
        return (" ".join(judgement.reason.split()),)
    named = tuple(MISTAKES[name].sentence for name in judgement.mistakes)
    if draft.answer.kind == CodeAnswer.kind:
        named = tuple(judgement.sentences)  # Beside the mistake, the input that shows it.
    said = (
        named
        or tuple(judgement.sentences)
        or tuple(filter(None, [draft.answer.first_wrong(judged.response)]))
    )
    counts = judgement.verdict.counts
    if named and isinstance(draft.answer, PixelAnswer):
        counts = f"{counts}. {draft.answer.first_wrong(judged.response).rstrip('.')}"
    return (
        "Not yet." if counts == "wrong" or counts.startswith("0 of 1 ") else f"Not yet: {counts}.",
        *(said or (UNKNOWN,)),
    )


# What is kept of lessons: read when one is opened, and written in the background, one attempt after the
# other.


@dataclass(frozen=True)
class LessonProgress:
    """How far a user is with a lesson."""

    user: str
    standings: tuple[Standing, ...]
    recall: str
    """Name of the exercise that comes before the first step; empty: none does."""
    trouble: str = ""
    """Why it cannot be read, as a sentence; empty: all is well."""


def progress_in(lesson: Lesson, course: Course) -> LessonProgress:
    """Return how far the chosen user is with a lesson; who cannot be read begins."""
    user = DEFAULT_USER
    # Where nobody has been chosen there is no file; the Exercises page says what is wrong with a broken one.
    with suppress(OSError, ValueError):
        user = read_answers().user
    try:
        attempts = attempt_file().attempts(user)
    except OSError as problem:
        return LessonProgress(user, (Standing.OPEN,) * len(lesson.steps), "", f"{problem}.")
    found = tuple(Standing(each.value) for each in standings(attempts, lesson))
    return LessonProgress(user, found, recall_for(attempts, course, lesson))


class LessonAttempts(QObject):
    """Keeps what a user does in lessons."""

    failed = Signal(str)
    """Why something is not kept, in sentences."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.user = DEFAULT_USER
        self._waiting: list[Attempt] = []
        self._job = Job(self, (OSError,), succeeded=self._go_on, failed=self._fail)

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
            self._job.call(partial(attempt_file().add, self._waiting.pop(0)))

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self.failed.emit(f"This is not kept for the next start: {error}.")
        self._go_on()
