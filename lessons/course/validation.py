"""Whether a lesson says what is so: states open, conditions and quoted numbers hold, wrong answers are wrong."""

from collections.abc import Callable, Collection
from functools import partial
from typing import TypeVar

from core.study.families import study_families
from core.study.stability import experiments
from lessons.course.catalogue import Lesson, headings
from lessons.course.quoted import Situation, is_right, said_instead
from lessons.course.record import StepPart
from lessons.course.state import State, States, solved
from lessons.course.tasks import check_kept, first_open, question_of
from lessons.exercises.answers.answer import NotCheckedError, Response
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.toml_file import Location

Found = TypeVar("Found")


def situation_of(state: State) -> Situation:
    """Return what is open in a state; ValueError where its cursor cannot be found."""
    return Situation(state.run, state.stage, state.position(state.run), state.pixel, state.other, state.edits)


def solved_situation(step: StepPart, state: State) -> Situation:
    """Return what the recorded solution of a step leaves."""
    assert step.solution is not None
    done = solved(state, step.solution)
    if step.solution.at is not None:
        return situation_of(done)
    count = done.run.stage(done.stage).steps.count
    position = 0 if step.solution.stage else min(state.position(state.run), count)
    return Situation(done.run, done.stage, position, done.pixel, done.other, done.edits)


def validate(lesson: Lesson, names: Collection[str]) -> None:
    """Check a lesson among those of ``names``; ValueError with file, line and what was expected."""
    states = States(lesson)
    for field, known in (("exercises", TEMPLATES), ("covers", headings()), ("needs", names)):
        for number, name in enumerate(getattr(lesson.part, field)):
            _expect(lesson, (field, number), name in known, f"expected one that there is, got {name!r}")
    recall, following = lesson.part.recall, lesson.part.next
    _expect(
        lesson, ("recall",), recall is None or recall in TEMPLATES, f"expected an exercise, got {recall!r}"
    )
    about = lesson.part.recall_of
    is_known = about is None or (recall is not None and about in names)
    _expect(lesson, ("recall_of",), is_known, f"expected the lesson of a recall, got {about!r}")
    if following is not None:
        is_there = following.lesson in names
        _expect(lesson, ("next", "lesson"), is_there, f"expected a lesson, got {following.lesson!r}")
    for number in range(len(lesson.steps)):
        _validate_step(lesson, number, states)


def _validate_step(lesson: Lesson, number: int, states: States) -> None:
    step, at = lesson.steps[number], ("step", number)
    for place, name in enumerate(step.covers):
        _expect(
            lesson,
            (*at, "covers", place),
            name in headings(),
            f"expected a slide that there is, got {name!r}",
        )
    state = states.of_step(number)
    start = _said(lesson, (*at, "state"), lambda: situation_of(state))
    _validate_looks(lesson, at, state, start)
    shown = start
    reveal = states.of_reveal(number)
    if reveal is not None:
        shown = _said(lesson, (*at, "reveal"), lambda: situation_of(reveal))
        _validate_looks(lesson, (*at, "reveal"), reveal, shown)
    if step.answer is not None:
        _validate_answer(lesson, number, states)
    if step.until is not None:
        until = step.until
        _said(lesson, (*at, "until"), lambda: check_kept(until.keeps))
        is_open = _said(lesson, (*at, "until"), lambda: first_open(until, start, start))
        _expect(
            lesson, (*at, "until"), bool(is_open), "expected a condition that does not hold from the start"
        )
        done = _said(lesson, (*at, "solution"), lambda: solved_situation(step, state))
        left = _said(lesson, (*at, "until"), lambda: first_open(until, done, start))
        _expect(lesson, (*at, "solution"), not left, f"expected a solution after which {left} holds")
        shown = done if reveal is None else shown
    for field, texts, where in (("check", step.check, start), ("check_after", step.check_after, shown)):
        for place, text in enumerate(texts):
            holds = _said(lesson, (*at, field, place), partial(is_right, text, where))
            if not holds:
                found = said_instead(text, where)
                raise lesson.file.error(
                    (*at, field, place),
                    f"expected {text}{', but ' if found else ', which does not hold'}{found}",
                )
    if step.show is not None:
        page, _, what = step.show.partition("/")
        known = {
            "compare": [family.name for family in study_families()],
            "stability": [experiment.info.name for experiment in experiments],
            "plan": [""],
        }
        is_known = what in known.get(page, [])
        wanted = "expected compare/ and a study, stability/ and an experiment, or plan"
        _expect(lesson, (*at, "show"), is_known, f"{wanted}, got {step.show!r}")


def _validate_looks(lesson: Lesson, at: Location, state: State, start: Situation) -> None:
    """Check what a state shows."""
    buffers = [track.name for track in start.trace.buffers]
    is_known = not state.buffer or state.buffer in buffers
    _expect(
        lesson,
        (*at, "state", "buffer"),
        is_known,
        f"expected one of {', '.join(buffers)}, got {state.buffer!r}",
    )


def _validate_answer(lesson: Lesson, number: int, states: States) -> None:
    """Check that the right answer is right and every wrong one is wrong."""
    question = question_of(lesson, number, states)
    answer = question.draft.answer
    at = ("step", number)
    for name, response in question.draft.mistakes.items():
        shows = bool(response) and not answer.is_same(response, answer.reference)
        _expect(lesson, (*at, "mistakes"), shows, f"expected a mistake that shows here, got {name}")
    seen: list[Response] = []
    for place, wrong in enumerate(lesson.steps[number].wrong):
        location = (*at, "wrong", place, "given")
        try:
            response = answer.read(wrong.given)
        except NotCheckedError as problem:
            raise lesson.file.error(location, f"expected an answer: {problem}") from None
        is_wrong = not answer.is_same(response, answer.reference) and answer.check(response).score < 1
        _expect(lesson, location, is_wrong, f"expected a wrong answer, got the right one, {wrong.given}")
        is_new = not any(answer.is_same(response, other) for other in seen)
        _expect(lesson, location, is_new, f"expected an answer that is not given before, got {wrong.given}")
        seen.append(response)
        refuting = states.of_wrong(number, place)
        if refuting is not None:
            _said(lesson, (*at, "wrong", place, "at"), partial(situation_of, refuting))


def _expect(lesson: Lesson, location: Location, is_so: bool, sentence: str) -> None:
    if not is_so:
        raise lesson.file.error(location, sentence)


def _said(lesson: Lesson, location: Location, ask: Callable[[], Found]) -> Found:
    """Return what is asked; a ValueError gets the line of what asks."""
    try:
        return ask()
    except ValueError as problem:
        raise lesson.file.error(location, str(problem)) from None
