"""Progress in lessons is kept among the attempts; practice asks of a lesson's mistakes, never of its steps."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from lessons.attempts import record
from lessons.attempts.imports import judged_again
from lessons.attempts.practice import next_question, progress
from lessons.course.catalogue import Course, Lesson, read_lesson, shipped
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import judge
from tests.lessons.course.lesson_texts import GOOD

NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)
OPEN, SEEN, DONE = record.Standing.OPEN, record.Standing.SEEN, record.Standing.DONE


@pytest.fixture
def course(tmp_path: Path) -> Course:
    lessons = {}
    for name in ("one", "two"):
        path = tmp_path / f"{name}.toml"
        path.write_text(GOOD)
        lessons[name] = read_lesson(path)
    return Course(lessons)


def tried(
    lesson: Lesson, step: int, score: float, minute: int, mistakes: tuple[str, ...] = ()
) -> record.Attempt:
    at = NOW + timedelta(minutes=minute)
    return record.lesson_attempt("me", lesson, step, at, score=score, mistakes=mistakes, asked=mistakes)


def test_steps_are_open_seen_or_done_until_a_lesson_begins_anew(course: Course) -> None:
    one, two = course.lessons.values()
    attempts: list[record.Attempt] = []
    for step, score, wanted, goes_on in (
        (1, 0, (DONE, SEEN, OPEN, OPEN), 1),
        (1, 1, (DONE, DONE, OPEN, OPEN), 2),
        (1, 0, (DONE, DONE, OPEN, OPEN), 2),
        (3, 1, (DONE, DONE, OPEN, DONE), 4),
    ):
        attempts.append(tried(one, step, score, len(attempts)))
        assert (record.standings(attempts, one), record.place_in(attempts, one)) == (wanted, goes_on)
    assert record.standings(attempts, two) == (OPEN,) * 4
    place = record.next_place(attempts, course)
    assert (place.lesson, place.step) == (two, 0)
    attempts.append(record.begin_anew("me", one, NOW))
    assert record.standings(attempts, one) == (OPEN,) * 4
    anew = record.next_place(attempts, course)
    assert (anew.lesson, anew.step) == (one, 0)


def test_a_lesson_is_finished_when_no_step_is_open(course: Course) -> None:
    one = course.named("one")
    seen = [tried(one, 3, 1, 0), tried(one, 2, 0, 1), tried(one, 1, 0, 2)]
    assert record.standings(seen, one) == (DONE, SEEN, SEEN, DONE)
    assert record.place_in(seen, one) == 4
    assert record.place_in(seen[:2], one) == 2


def test_who_is_new_begins_at_the_first_and_who_has_all_is_finished(course: Course) -> None:
    one, two = course.lessons.values()
    first = record.next_place([], course)
    assert (first.lesson, first.step) == (one, 0)
    done = [tried(lesson, step, 1, step) for lesson in (two, one) for step in (1, 2, 3)]
    assert record.next_place(done[:3], course) is not None
    assert record.next_place(done, course) is None
    assert record.next_place([], Course({})) is None


def test_after_a_lesson_comes_the_one_that_follows_and_after_the_last_the_first_not_finished() -> None:
    course = shipped()
    glass, *_, last = (course.named("glass"), *course.lessons.values())
    first, following = course.named("pixel-centres"), course.after(glass)
    assert course.after(last) is None
    done = {lesson: [tried(lesson, k, 1, k) for k in range(lesson.step_count)] for lesson in (glass, last)}
    for lesson, wanted in ((glass, (following, 0, glass)), (last, (first, 0, None))):
        place = record.next_place(done[lesson], course)
        assert (place.lesson, place.step, place.after) == wanted
    assert record.first_unfinished(done[glass], course) is first


def test_what_comes_before_a_lesson_is_of_one_that_was_finished() -> None:
    course = shipped()

    def finished(name: str) -> list[record.Attempt]:
        lesson = course.named(name)
        return [tried(lesson, step, 1, step) for step in range(len(lesson.steps))]

    lines = course.named("where-d-comes-from")
    assert lines.part.recall == "midpoint-line"  # With which the lesson "midpoint" closes.
    assert record.recall_for([], course, lines) == ""
    assert record.recall_for(finished("midpoint"), course, lines) == "midpoint-line"
    assert record.recall_for(finished("midpoint")[:-1], course, lines) == ""
    # Of what else was finished, where its own lesson was not.
    assert record.recall_for(finished("weights"), course, lines) == "barycentric-weights"
    assert record.recall_for(finished("where-d-comes-from"), course, lines) == ""


def test_another_question_is_another_step(course: Course) -> None:
    one = course.named("one")
    one.path.write_text(GOOD.replace('text = "How many', 'text = "Now how many'))
    assert read_lesson(one.path).revision == one.revision
    one.path.write_text(GOOD.replace("values = [16]", "values = [17]"))
    assert record.standings([tried(one, 1, 1, 0)], read_lesson(one.path)) == (OPEN,) * 4


def test_a_mistake_of_a_lesson_is_asked_in_practice_and_its_step_never(course: Course) -> None:
    one = course.named("one")
    attempts = [tried(one, 1, 0, -3, ("all-edges-inclusive",)), tried(one, 2, 1, -2)]
    choice = next_question(attempts, TEMPLATES, "me", NOW)
    assert choice.reason == "In a lesson an answer came from this mistake: all edges inclusive."
    assert "all-edges-inclusive" in choice.question.draft.mistakes
    question = choice.question
    right = question.draft.answer.reference
    answered = record.attempt_of("me", question, right, judge(question, right), 20, NOW)
    later = next_question([*attempts, answered], TEMPLATES, "me", NOW)
    assert later.reason == "This one is new."
    without = next_question([tried(one, 1, 0, -3)], TEMPLATES, "me", NOW)
    assert without.question.template.name == next(iter(TEMPLATES))


def test_lessons_count_mistakes_and_no_points(course: Course) -> None:
    attempts = [tried(course.named("one"), 1, 0, 0, ("all-edges-inclusive",))]
    reached = progress(attempts)
    assert [(each.stage, each.mistake, each.made) for each in reached.mistakes] == [
        ("raster", "all-edges-inclusive", 1)
    ]
    assert (reached.points, reached.tried) == (0, {})


def test_steps_of_lessons_are_exported_and_imported_as_they_are(course: Course) -> None:
    attempts = [tried(course.named("one"), 1, 1, 0), record.begin_anew("me", course.named("one"), NOW)]
    read = record.read_attempts_json(record.exported_attempts(attempts, "answers.json"), "answers.json")
    assert [*judged_again(read, TEMPLATES, NOW + timedelta(days=1)).attempts] == attempts
    given = attempts[0].model_copy(update={"points": 7.0, "most": 9})
    assert judged_again([given], TEMPLATES, NOW + timedelta(days=1)).attempts == (attempts[0],)
