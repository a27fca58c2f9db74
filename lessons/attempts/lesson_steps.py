"""Lessons among the attempts: what of a lesson is done, and where a user goes on."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from enum import Enum

from lessons.attempts.record import ANSWER_LIMIT, Attempt
from lessons.course.catalogue import Course
from lessons.course.lesson_file import STEP_PREFIX, Lesson

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
    found = [Standing.OPEN] * len(lesson.steps)
    for attempt, step in _tries(attempts, lesson):
        if found[step] is not Standing.DONE:
            found[step] = Standing.DONE if attempt.score == 1 else Standing.SEEN
    last = max((k for k, standing in enumerate(found) if standing is not Standing.OPEN), default=0)
    for step, part in enumerate(lesson.steps[:last]):
        if part.answer is None and part.until is None:
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
    asked = [k for k, part in enumerate(lesson.steps) if part.answer is not None or part.until is not None]
    is_behind = found[last] is Standing.DONE or attempt.verdict == SHOWN
    if is_behind and all(found[k] is not Standing.OPEN for k in asked):
        return len(lesson.steps)
    step = last + (found[last] is Standing.DONE)
    is_left = any(part.answer is not None or part.until is not None for part in lesson.steps[step:])
    return step if is_left else len(lesson.steps)


def next_place(attempts: Sequence[Attempt], course: Course) -> Place | None:
    """Return where a user goes on: in the lesson that was tried last, or at the start of the one after it.

    ``None``: there are no lessons, or all are finished.
    """
    lessons = list(course.lessons.values())
    last = next((attempt for attempt in reversed(attempts) if is_of_lesson(attempt)), None)
    names = {lesson.name: lesson for lesson in lessons}
    latest = None if last is None else names.get(last.template.split("/")[1])
    if latest is not None and place_in(attempts, latest) < len(latest.steps):
        return Place(latest, place_in(attempts, latest))
    following = None if latest is None else course.after(latest)
    for lesson in ([] if following is None else [following], lessons):
        for each in lesson:
            step = place_in(attempts, each)
            if step < len(each.steps):
                return Place(each, step)
    return None


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
        elif number.isdecimal() and 1 <= int(number) <= len(lesson.steps):
            found.append((attempt, int(number) - 1))
    return found
