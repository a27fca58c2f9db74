"""What the Exercises page does off the GUI thread: draws a question, checks an answer, keeps the attempt."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from app.background.workers import Progress
from app.files.attempts import attempt_file
from app.pages.exercises.answer_pictures import Live, is_live, live, marks_of
from app.pages.exercises.scene_outline import outline_of
from core.lanes.run import bounded
from core.records.cells import Marks
from core.records.frame import Frame
from lessons.attempts.practice import telling_apart
from lessons.attempts.record import Attempt, attempt_of
from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.answers.code import CannotRunError, CodeAnswer, Opened
from lessons.exercises.coding.shader_task import Beside
from lessons.exercises.question import Draft, Judgement, Question, Template, ask, judge
from widgets.grid.geometry import GridGeometry

SECONDS = 10.0
"""Longest that the runs of one check may take together."""
Work = Callable[[Progress, Callable[[], bool]], "Asked"]


@dataclass(frozen=True, eq=False)
class Asked:
    """A question that is drawn."""

    question: Question
    outline: GridGeometry | None
    is_afresh: bool = False
    """Whether it is asked anew where its answer was checked before."""


@dataclass(frozen=True, eq=False)
class Checked:
    """An answer that is checked."""

    given: object
    """What was in the form."""
    response: Response
    judgement: Judgement
    marks: Marks
    attempt: Attempt | None
    """The attempt to keep; ``None``: the model answer was shown before."""
    trouble: str
    """What to tell of keeping it, in sentences; empty: all is well."""
    opened: Opened | Beside | None = None
    """Of a wrong listing, the smallest input that shows it, for A | B; ``None``: there is none."""
    drawn: Frame | None = None
    """Of a wrong listing, its picture where one is wanted."""


def asking(template: Template, seed: int, *, is_afresh: bool) -> Work:
    """Return the work that draws a question; it raises ValueError where none can be drawn."""

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Asked:
        return drawn(ask(template, seed), is_afresh=is_afresh)

    return work


def drawn(question: Question, *, is_afresh: bool = False) -> Asked:
    """Return a question with its outline."""
    return Asked(question, outline_of(question.draft, question.template.stage), is_afresh)


def asking_apart(template: Template, mistakes: Sequence[str], seeds: Sequence[int]) -> Work:
    """Return the work that draws the first variant that tells the mistakes of an answer apart, or else any."""

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Asked:
        return drawn(telling_apart(mistakes, ((template, seed) for seed in seeds)) or ask(template, seeds[0]))

    return work


def drawing(question: Question, given: object) -> Callable[[Progress, Callable[[], bool]], Live] | None:
    """Return the work that draws an answer while it is given; ``None``: nothing is drawn of this type."""
    draft = question.draft

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Live:
        try:
            response = draft.answer.read(given)
        except NotCheckedError:
            response = None
        return live(draft, response)

    return work if is_live(draft) else None


@dataclass(frozen=True, eq=False)
class Tried:
    """A listing that is being typed, and why it cannot run."""

    given: object
    problem: CannotRunError | None


def trying(draft: Draft, given: object) -> Callable[[Progress, Callable[[], bool]], Tried] | None:
    """Return the work that finds why a listing cannot run while it is typed; ``None``: the answer is no listing."""
    answer = draft.answer

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Tried:
        assert isinstance(answer, CodeAnswer)
        with bounded(SECONDS, is_cancelled):
            return Tried(given, answer.problem(str(given)))

    return work if isinstance(answer, CodeAnswer) else None


def checking(
    question: Question, given: object, response: Response, user: str, seconds: float, *, is_kept: bool
) -> Callable[[Progress, Callable[[], bool]], Checked]:
    """Return the work that checks an answer that was read, and keeps the attempt before anybody sees the verdict."""

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Checked:
        with bounded(SECONDS, is_cancelled):  # A listing may not end by itself.
            judgement = judge(question, response)
            opened, drawn = _seen(question, response, judgement)
        marks = marks_of(question, judgement.verdict)
        if not is_kept:
            return Checked(given, response, judgement, marks, None, "", opened, drawn)
        attempt = attempt_of(user, question, response, judgement, seconds, datetime.now(UTC))
        try:
            trouble = attempt_file().add(attempt)
        except OSError as problem:
            trouble = f"The attempt is not saved: {problem}."
        return Checked(given, response, judgement, marks, attempt, trouble, opened, drawn)

    return work


def _seen(
    question: Question, response: Response, judgement: Judgement
) -> tuple[Opened | Beside | None, Frame | None]:
    """Return what can be shown of a wrong listing: the smallest input in A | B, and its picture."""
    answer = question.draft.answer
    if not isinstance(answer, CodeAnswer) or judgement.verdict.score == 1:
        return None, None
    try:
        drawn = None if answer.picture is None else answer.drawn(response)
        return answer.opened(response), drawn
    except ValueError:  # On a whole picture its run does not end: what is wrong with it is said all the same.
        return None, None
