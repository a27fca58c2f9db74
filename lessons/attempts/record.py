"""Attempts: one question or step of a lesson, the answer of a user, what came of it; and how far a lesson is done."""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, AwareDatetime, BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from lessons.course.catalogue import STEP_PREFIX, Course, Lesson
from lessons.exercises.numbers import SEED_LIMIT

if TYPE_CHECKING:
    from lessons.exercises.answers.answer import Response
    from lessons.exercises.question import Judgement, Question


# One attempt: a question, the answer of a user, and what came of it; and many of them as JSON or CSV.


FORMAT: Literal["rasterscope attempts"] = "rasterscope attempts"
"""First words of an exported file."""
VERSION: Literal[1] = 1
"""Of the database and of exported files; later ones are refused."""
DEFAULT_USER = "me"
"""Name of the user where nobody has chosen one."""
NOT_CHECKED = "not checked"
"""First words of a verdict that comes from another file and could not be given again."""
ANSWER_LIMIT = 1 << 16
"""Longest answer in characters."""


def _printable(text: str) -> str:
    if not text.isprintable() or text != text.strip():
        raise ValueError(f"expected a name without control characters and outer spaces, got {text!a:.60}")
    return text


def _in_utc(at: datetime) -> datetime:
    if not 1970 < at.year < 9999:
        raise ValueError(f"expected a time from 1971 to 9998, got {at}")
    return at.astimezone(UTC)


def _one_word(text: str) -> str:
    if text.split() != [text] or not text.isprintable():
        raise ValueError(f"expected the name of a mistake without spaces, got {text!a:.60}")
    return text


Name = Annotated[str, Field(min_length=1, max_length=200), AfterValidator(_printable)]
Mistake = Annotated[str, Field(max_length=200), AfterValidator(_one_word)]
Whole = Annotated[int, Field(ge=0, le=SEED_LIMIT)]
Amount = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]


_NAMES: TypeAdapter[str] = TypeAdapter(Name)


def is_name(value: object) -> bool:
    """Return whether a value can be the name of a user: 1 to 200 printable characters."""
    try:
        _NAMES.validate_python(value, strict=True)
    except ValidationError:
        return False
    return True


class Attempt(BaseModel):
    """One answer that was checked."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    user: Name
    at: Annotated[AwareDatetime, AfterValidator(_in_utc)]
    """When it was checked, in UTC, to the microsecond."""
    template: Name
    version: Whole
    """Of the template: with it the seed gives the same question."""
    seed: Whole
    stage: Name
    asked: tuple[Mistake, ...] = ()
    """Names of the mistakes that this question shows."""
    answer: Annotated[str, Field(max_length=ANSWER_LIMIT)]
    """As it was understood."""
    verdict: Annotated[str, Field(max_length=ANSWER_LIMIT)]
    """What was right in words, as ``12 right, 1 missing``."""
    score: Annotated[float, Field(ge=0, le=1)]
    points: Amount
    most: Whole
    """Points of the right answer."""
    mistakes: tuple[Mistake, ...] = ()
    """Names of the mistakes that give exactly this answer."""
    is_slip: bool = False
    seconds: Amount
    """Time taken."""

    @property
    def is_checked(self) -> bool:
        """Whether this program has judged the answer."""
        return not self.verdict.startswith(NOT_CHECKED)


def attempt_of(
    user: str,
    question: "Question",
    response: "Response",
    judgement: "Judgement",
    seconds: float,
    at: datetime,
) -> Attempt:
    """Return the attempt of a ``user`` who gave ``response`` after ``seconds``, checked ``at`` a time with its zone."""
    template, draft = question.template, question.draft
    return Attempt(
        user=user,
        at=at,
        template=template.name,
        version=template.version,
        seed=question.seed,
        stage=template.stage,
        asked=tuple(draft.mistakes),
        answer=draft.answer.text(response)[:ANSWER_LIMIT],
        verdict=judgement.verdict.counts,
        score=judgement.verdict.score,
        points=judgement.points,
        most=template.points,
        mistakes=judgement.mistakes,
        is_slip=judgement.is_slip,
        seconds=seconds,
    )


COLUMNS = tuple(Attempt.model_fields)
"""Of a table with one attempt a row."""
_TIME = "%Y-%m-%dT%H:%M:%S.%fZ"
_FORMULA = re.compile(r"[=+\-@\t\r](?![\s\d.,/e+()-]*$)")
"""Beginning of a text that a spreadsheet would run, if it is not made of numbers."""


def attempt_row(attempt: Attempt) -> dict[str, Any]:
    """Return an attempt as a row of a table: the time as text, the names of mistakes separated by spaces."""
    values = {name: getattr(attempt, name) for name in COLUMNS}
    values["at"] = attempt.at.strftime(_TIME)
    return values | {name: " ".join(values[name]) for name in ("asked", "mistakes")}


def attempts_csv(attempts: Iterable[Attempt]) -> bytes:
    """Return attempts as a table, one a row; a text that a spreadsheet would run begins with an apostrophe."""
    text = io.StringIO()
    table = csv.DictWriter(text, COLUMNS)
    table.writeheader()
    for attempt in attempts:
        row = attempt_row(attempt)
        table.writerow(
            {
                name: f"'{value}" if isinstance(value, str) and _FORMULA.match(value) else value
                for name, value in row.items()
            }
        )
    return text.getvalue().encode("utf-8-sig")


def exported_attempts(attempts: Iterable[Attempt], path: str) -> bytes:
    """Return attempts as the content of a file: a table where its name ends in .csv, else JSON."""
    return (attempts_csv if path.lower().endswith(".csv") else attempts_json)(attempts)


class AttemptList(BaseModel):
    """An exported file."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: Literal["rasterscope attempts"] = FORMAT
    version: Literal[1] = VERSION
    attempts: tuple[Attempt, ...]


class _Head(BaseModel):
    format: Literal["rasterscope attempts"]
    version: int


def attempts_json(attempts: Iterable[Attempt]) -> bytes:
    """Return attempts as the content of a file."""
    return AttemptList(attempts=tuple(attempts)).model_dump_json(indent=1).encode() + b"\n"


def read_attempts_json(content: bytes, name: object) -> Sequence[Attempt]:
    """Return the attempts of a file, all of them or none.

    Raises ValueError if ``content`` is no such file, or one of a later version; the message is one sentence with
    ``name``.
    """
    try:
        head = _Head.model_validate_json(content)
        if head.version > VERSION:
            raise ValueError(
                f"{name} was written by a later version of the program: "
                f"its version is {head.version}, this one reads {VERSION}"
            )
        return AttemptList.model_validate_json(content).attempts
    except ValidationError as problem:
        first = problem.errors(include_url=False)[0]
        place = ".".join(map(str, first["loc"]))
        reason = f"{place}: {first['msg']}" if place else first["msg"]
        raise ValueError(f"{name} is no file of attempts: {' '.join(reason.split()):.200}") from None


# Lessons among the attempts: what of a lesson is done, and where a user goes on.


SHOWN = "shown"
"""Verdict of a step whose answer was shown."""
ANEW = "begun anew"
"""Verdict of step 0, with which a lesson begins once more: what was before it counts no longer."""


class Standing(Enum):
    """What became of a step."""

    OPEN = "open"
    SEEN = "seen"
    """Its answer was shown, or is not right yet."""
    DONE = "done"


@dataclass(frozen=True, eq=False)
class Place:
    """A step of a lesson, from 0."""

    lesson: Lesson
    step: int
    after: Lesson | None = None
    """The finished lesson that this one follows; ``None``: it is the one tried last, or the first not finished."""


def is_of_lesson(attempt: Attempt) -> bool:
    """Return whether an attempt is a step of a lesson: exercises have other names."""
    return attempt.template.startswith(STEP_PREFIX)


def lesson_attempt(
    user: str,
    lesson: Lesson,
    step: int,
    at: datetime,
    *,
    score: float,
    answer: str = "",
    verdict: str = "",
    asked: Sequence[str] = (),
    mistakes: Sequence[str] = (),
    seconds: float = 0.0,
) -> Attempt:
    """Return the attempt at a step: right with a ``score`` of 1; a lesson earns no points."""
    return Attempt(
        user=user,
        at=at,
        template=lesson.step_name(step),
        version=lesson.revision,
        seed=0,
        stage=lesson.steps[max(step, 0)].state.stage or lesson.stage,
        asked=tuple(asked),
        answer=answer[:ANSWER_LIMIT],
        verdict=verdict or ("right" if score == 1 else SHOWN),
        score=score,
        points=0,
        most=0,
        mistakes=tuple(mistakes),
        seconds=seconds,
    )


def begin_anew(user: str, lesson: Lesson, at: datetime) -> Attempt:
    """Return the attempt with which a lesson begins once more."""
    return lesson_attempt(user, lesson, -1, at, score=0, verdict=ANEW)


def standings(attempts: Sequence[Attempt], lesson: Lesson) -> tuple[Standing, ...]:
    """Return what became of each step, from a user's attempts in the order of time.

    A step to look at asks nothing: it is done when a later one was tried.
    """
    found = [Standing.OPEN] * lesson.step_count
    for attempt, step in _tries(attempts, lesson):
        if found[step] is not Standing.DONE:
            found[step] = Standing.DONE if attempt.score == 1 else Standing.SEEN
    last = max((k for k, standing in enumerate(found) if standing is not Standing.OPEN), default=0)
    for step in range(last):
        if not _asks(lesson, step):
            found[step] = Standing.DONE
    return tuple(found)


def place_in(attempts: Sequence[Attempt], lesson: Lesson) -> int:
    """Return the step at which a user goes on: the one after the last that was tried, or that one where it is not done.

    It is the number of steps where the lesson is finished: no step is open, and of the last one the answer is known.
    """
    tries = _tries(attempts, lesson)
    if not tries:
        return 0
    found, (attempt, last) = standings(attempts, lesson), tries[-1]
    asked = [k for k in range(lesson.step_count) if _asks(lesson, k)]
    is_behind = found[last] is Standing.DONE or attempt.verdict == SHOWN
    if is_behind and all(found[k] is not Standing.OPEN for k in asked):
        return lesson.step_count
    step = last + (found[last] is Standing.DONE)
    return step if any(k >= step for k in asked) else lesson.step_count


def next_place(attempts: Sequence[Attempt], course: Course) -> Place | None:
    """Return where a user goes on: in the lesson that was tried last, or that follows it, or the first not finished.

    ``None``: there are no lessons, or all are finished.
    """
    last = next((attempt for attempt in reversed(attempts) if is_of_lesson(attempt)), None)
    each = None if last is None else course.lessons.get(last.template.split("/")[1])
    before: Lesson | None = None
    met: set[str] = set()
    while each is not None and each.name not in met:
        if (step := place_in(attempts, each)) < each.step_count:
            return Place(each, step, before)
        met.add(each.name)
        before, each = each, course.after(each)
    first = first_unfinished(attempts, course)
    return None if first is None else Place(first, place_in(attempts, first))


def first_unfinished(attempts: Sequence[Attempt], course: Course) -> Lesson | None:
    """Return the first lesson of the course that is not finished; ``None``: all are."""
    return next(
        (each for each in course.lessons.values() if place_in(attempts, each) < each.step_count), None
    )


def recall_for(attempts: Sequence[Attempt], course: Course, lesson: Lesson) -> str:
    """Return the exercise that comes before a lesson: its own, or an earlier one's, of a lesson that was finished.

    Empty: none of them was. A lesson that is not in the course asks its own.
    """
    own = lesson.part.recall or ""
    if not own or course.lessons.get(lesson.name) is not lesson:
        return own
    lessons = list(course.lessons.values())
    for each in [lesson, *reversed(lessons[: lessons.index(lesson)])]:
        about = course.recalled(each)
        if about is not None and place_in(attempts, about) == about.step_count:
            return str(each.head.get("recall", ""))
    return ""


def _asks(lesson: Lesson, step: int) -> bool:
    """Return whether a step has a question or a task."""
    return any(key in lesson.written_steps()[step] for key in ("answer", "until"))


def _tries(attempts: Sequence[Attempt], lesson: Lesson) -> list[tuple[Attempt, int]]:
    """Return the attempts at a lesson as it is now, with the step of each, since it was last begun anew."""
    prefix = f"{STEP_PREFIX}{lesson.name}/"
    found: list[tuple[Attempt, int]] = []
    for attempt in attempts:
        if not attempt.template.startswith(prefix) or attempt.version != lesson.revision:
            continue
        number = attempt.template.removeprefix(prefix)
        if number == "0":
            found = []
        elif number.isdecimal() and 1 <= int(number) <= lesson.step_count:
            found.append((attempt, int(number) - 1))
    return found
