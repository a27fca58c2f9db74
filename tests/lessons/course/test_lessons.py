"""Lessons hold: each one says what is so, and a broken one is refused with file, line and what was expected."""

import re
from itertools import chain
from pathlib import Path

import pytest

from lessons.course import catalogue
from lessons.course.record import SolutionPart
from lessons.course.state import States, solved
from lessons.course.tasks import is_done
from lessons.course.validation import situation_of, validate
from tests.lessons.course.lesson_texts import GOOD
from tests.texts import cases_of

FILES = sorted(
    path for path in catalogue.FOLDER.glob("*.toml") if path.name not in ("order.toml", "slides.toml")
)


def lesson_of(folder: Path, text: str, name: str = "whose-pixel") -> catalogue.Lesson:
    path = folder / f"{name}.toml"
    path.write_text(text, encoding="utf-8")
    return catalogue.read_lesson(path)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_lesson_says_what_is_so(path: Path) -> None:
    lesson = catalogue.read_lesson(path)
    validate(lesson, catalogue.shipped().lessons)
    listed, part = catalogue.shipped().named(lesson.name), lesson.part
    assert (listed.question, listed.stage, listed.step_count) == (part.question, lesson.stage, len(part.step))
    assert {**listed.head, "step": lesson.written_steps()} == lesson.head, "all else stands before the steps"


@pytest.mark.parametrize("matrices", ["modelViewMatrix * projectionMatrix", "projectionMatrix"])
def test_matrices_in_a_wrong_order_do_not_write_a_shader(matrices: str) -> None:
    lesson = catalogue.shipped().named("write-a-shader")
    state, until = States(lesson).of_step(2), lesson.steps[2].until
    assert until is not None
    written = solved(state, SolutionPart(edit=[["vertex", "= modelViewMatrix", f"= {matrices}"]]))
    assert not is_done(until, situation_of(written), situation_of(state))


def test_the_minutes_of_all_lessons_mean_the_same() -> None:
    far = {
        name: (lesson.minutes, round(catalogue.estimated_minutes(lesson), 1))
        for name, lesson in catalogue.shipped().lessons.items()
        if abs(lesson.minutes - catalogue.estimated_minutes(lesson)) > max(2, lesson.minutes / 4)
    }
    assert far == {}


def test_a_step_that_measures_says_how_long_that_takes() -> None:
    silent = [
        f"{name}, step {number}"
        for name, lesson in catalogue.shipped().lessons.items()
        for number, step in enumerate(lesson.steps, 1)
        if step.kind == "measure"
        and not re.search(r"\btakes? (a|about) .*(seconds?|minutes?)\b", f"{step.text} {step.task}")
    ]
    assert silent == []


def test_the_order_names_each_lesson_once() -> None:
    assert catalogue.shipped().problems == ()
    names = list(chain(*catalogue.chapters().values()))
    assert sorted(names) == [path.stem for path in FILES]
    assert list(catalogue.shipped().lessons) == names
    assert sorted(
        lesson.name for lessons in catalogue.shipped().by_stage.values() for lesson in lessons
    ) == sorted(names)


def test_each_slide_is_covered_or_has_a_reason() -> None:
    covered = catalogue.coverage(catalogue.shipped().lessons.values())
    assert [
        slide.name for slide in catalogue.slides() if bool(covered[slide.name]) == bool(slide.reason)
    ] == []


def test_the_next_lesson_is_the_named_one_or_the_next_in_the_list() -> None:
    course = catalogue.shipped()
    lessons = list(course.lessons.values())
    for lesson, following in zip(lessons, [*lessons[1:], None], strict=True):
        named = lesson.part.next
        assert course.after(lesson) is (course.lessons[named.lesson] if named else following)


def test_a_lesson_recalls_an_earlier_one() -> None:
    course = catalogue.shipped()
    order = list(course.lessons)
    for place, lesson in enumerate(course.lessons.values()):
        about = course.recalled(lesson)
        if lesson.part.recall is None:
            continue
        assert about is not None, f"{lesson.name}: no lesson closes with {lesson.part.recall}"
        assert order.index(about.name) < place, f"{lesson.name} recalls {about.name}, which comes later"


def test_explorations_are_steps_that_surprise() -> None:
    assert len(catalogue.explorations()) == 8
    for each in catalogue.explorations():
        assert 0 <= each.step < len(catalogue.shipped().named(each.lesson).steps)
        assert each.title.isprintable()


def test_a_good_lesson_holds(tmp_path: Path) -> None:
    validate(lesson_of(tmp_path, GOOD), [])


BROKEN = cases_of(__file__, "broken.txt")
"""What stands in the good lesson, what is typed, and what is said of it."""


@pytest.mark.parametrize(("old", "new", "said"), BROKEN, ids=[f"{said:.60}" for _, _, said in BROKEN])
def test_a_broken_lesson_is_refused(tmp_path: Path, old: str, new: str, said: str) -> None:
    before, _, after = GOOD.partition(old)
    with pytest.raises(ValueError, match=r"^[^\n]*whose-pixel\.toml: line \d+: [^\n]*$") as refusal:
        validate(lesson_of(tmp_path, before + new + after), ["whose-pixel"])
    _, line, sentence = re.split(r": line (\d+): ", str(refusal.value))
    assert said in sentence
    changed = range(before.count("\n") + 1, (before + new).count("\n") + 2)
    named = (before + new + after).split("\n")[int(line) - 1]
    assert int(line) in {1, *changed} or named.startswith(("[[step]]", "[step.")), named


def test_two_steps_to_look_at_do_not_follow_each_other(tmp_path: Path) -> None:
    look = '[[step]]\nkind = "look"\ntext = "And here?"\n\n[[step]]\nkind = "predict"\ntext = "How many'
    with pytest.raises(ValueError, match=r"line 2\d: step\.1\.kind: expected a task after a step to look at"):
        lesson_of(tmp_path, GOOD.replace('[[step]]\nkind = "predict"\ntext = "How many', look))


def test_a_lesson_has_four_to_six_steps(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="expected at least 4 items"):
        lesson_of(tmp_path, GOOD[: GOOD.index('[[step]]\nkind = "break"')])
    with pytest.raises(ValueError, match="line 1: expected a lesson, with"):
        lesson_of(tmp_path, GOOD[: GOOD.index("[[step]]")])


def test_the_rest_of_a_folder_opens(tmp_path: Path) -> None:
    for name, text in {"mine": GOOD, "shared-edges": GOOD, "broken": "version = ", "Bad name": GOOD}.items():
        (tmp_path / f"{name}.toml").write_text(text)
    with (tmp_path / "huge.toml").open("wb") as file:
        file.truncate(50_000_000)
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe")
    (tmp_path / "folder.toml").mkdir()
    course = catalogue.with_folders([tmp_path, tmp_path / "none"])
    assert [*course.lessons] == [*catalogue.shipped().lessons, "mine"]
    assert len(course.problems) == 7
    assert f"{tmp_path / 'huge.toml'}: expected a file of up to 64 KiB" in course.problems
    taken = f"{tmp_path / 'shared-edges.toml'}: expected another name: there is a lesson shared-edges already"
    assert taken in course.problems
    with pytest.raises(ValueError, match=r"expected a lesson such as shared-edges, .*got 'shared-edge'"):
        course.named("shared-edge")


def test_states_join_settings_and_replace_the_rest(tmp_path: Path) -> None:
    lesson = lesson_of(tmp_path, GOOD)
    states = States(lesson)
    first, second, third = (states.of_step(number) for number in range(3))
    assert (first.settings.fill, first.settings.fill_rule) == ("bounding-box", "inclusive")
    assert (first.stage, first.buffer, first.pixel) == ("raster", "overdraw", (32, 24))
    assert (second.stage, second.buffer, second.pixel) == ("raster", "", None)
    assert second.scene is third.scene, "two steps on one scene share it"
    reveal = states.of_reveal(1)
    assert reveal.scene is second.scene
    assert (second.position(second.run), reveal.position(reveal.run) > 0) == (0, True)
    refuting = states.of_wrong(1, 0)
    assert refuting.place.at == "tie"
