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
