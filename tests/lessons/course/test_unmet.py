"""What a task lacks is said as long as it lacks something, and not a moment longer."""

import pytest

from lessons.course.catalogue import Lesson, shipped
from lessons.course.state import States, solved
from lessons.course.unmet import unmet
from lessons.course.validation import situation_of

LESSONS = [lesson for lesson in shipped().lessons.values() if any(step.until for step in lesson.steps)]


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda lesson: lesson.name)
def test_a_task_says_what_it_lacks_until_it_is_done(lesson: Lesson) -> None:
    states = States(lesson)
    for number, step in enumerate(lesson.steps):
        if step.until is None or step.solution is None:
            continue
        start = states.of_step(number)
        before, after = situation_of(start), situation_of(solved(start, step.solution))
        assert unmet(step.until, before, before).startswith("Not yet: ")
        assert unmet(step.until, after, before) == ""


def test_steps_that_none_should_do_are_counted() -> None:
    lesson = shipped().lessons["row-by-row"]
    start, until = situation_of(States(lesson).of_step(4)), lesson.steps[4].until
    assert until is not None
    assert unmet(until, start, start) == "Not yet: 71 steps are left that the task wants gone."


@pytest.mark.parametrize(
    ("name", "number", "line", "said"),
    [
        ("shared-edges", 5, "value > 0", "no pixel is drawn twice by your version"),
        ("where-d-comes-from", 5, "D = dy - dx", "your version does not draw pixel (1, 1)"),
    ],
)
def test_an_edit_that_does_not_do_it_is_told_what_it_does(
    name: str, number: int, line: str, said: str
) -> None:
    lesson = shipped().lessons[name]
    step = lesson.steps[number]
    assert step.until is not None
    assert step.solution is not None
    [(listing, old, _)] = step.solution.edit
    start = States(lesson).of_step(number)
    wrong = solved(start, step.solution.model_copy(update={"edit": ((listing, old, line),)}))
    assert unmet(step.until, situation_of(wrong), situation_of(start)) == f"Not yet: {said}."
