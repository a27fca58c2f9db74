"""Listings that are repaired or written: what is right, what is wrong and where, what cannot run; and their files."""

from datetime import UTC, datetime
from pathlib import Path

import pytest

from core import Settings, render
from core.edits.edit import edits_of, original
from core.methods import table
from lessons.attempts.imports import judged_again
from lessons.attempts.record import Attempt, attempt_of
from lessons.exercises.answers.answer import NotCheckedError
from lessons.exercises.answers.listings import CannotRunError, CodeAnswer, head_alone
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.coding.lines import LECTURE
from lessons.exercises.coding.shader_task import Beside
from lessons.exercises.coding.tasks import TASKS
from lessons.exercises.coding.triangles import INSIDE
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Question, ask, judge
from lessons.mistakes.shelf import SHELF

WRITTEN = CodeAnswer(LECTURE, head_alone(LECTURE))


def changed(*changes: tuple[str, str]) -> str:
    """Return Bresenham's listing with other texts in it."""
    text = LECTURE.text
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


def test_lines_with_a_named_fault_have_the_pixels_of_the_mistake() -> None:
    for name in ("bresenham-lecture", "bresenham"):
        task = TASKS[name]
        for fault in task.faults:
            if not fault.mistake:
                continue
            method = table.get("line", SHELF[fault.mistake].change_settings(Settings(line=name)).line)
            results = zip(task.all_cases, task.results(task.with_fault(fault)), strict=True)
            for (_, case), found in results:
                listed = method.listing(*case.values)
                assert found == sorted([x, y] for x, y, _ in listed), (name, fault.mistake, case.said)


def test_a_named_fault_draws_what_the_mistake_draws() -> None:
    compared = set()
    for task in TASKS.values():
        answer = CodeAnswer(task, head_alone(task))
        for name, text in answer.named_mistakes.items():
            opened = answer.opened(text)
            if isinstance(opened, Beside):
                assert opened.differs, (task.name, name)
                continue
            if opened is None:
                continue
            if (task.name, name) == ("depth-test", "farther-wins"):  # It clears the buffer otherwise, too.
                continue
            shown = opened.shown
            mine, its = render(shown.scene, opened.typed), SHELF[name].draw(shown.scene, shown.settings)
            assert (mine.color == its.color).all(), (task.name, name)
            assert (mine.primitive == its.primitive).all(), (task.name, name)
            compared.add(name)
    assert len(compared) >= 16


@pytest.mark.parametrize(
    "text",
    [
        changed(("if D > 0:", "if not D <= 0:"), ("D += 2 * dy", "D = D + dy + dy")),
        changed(("sx, sy = 1, ", "sx = 1\n  sy = ")),
        "def f(a, b, c, d, last):\n"
        "  steep = abs(d - b) >= abs(c - a)\n"
        "  if steep:\n"
        "    a, b, c, d = b, a, d, c\n"
        "  if a > c:\n"
        "    a, b, c, d = c, d, a, b\n"
        "  s = -1 if d < b else 1\n"
        "  w = abs(d - b)\n"
        "  n = max(c - a, 1)\n"
        "  pixels = []\n"
        "  for k in range(c - a + 1):\n"
        "    y = b + s * ((2 * k * w + n - 1) // (2 * n))\n"
        "    pixels.append((y, a + k) if steep else (a + k, y))\n"
        "  return pixels",
    ],
    ids=["sums", "names", "closed form"],
)
def test_another_way_to_write_the_same_is_right(text: str) -> None:
    try:
        response = WRITTEN.read(text)
    except NotCheckedError as problem:
        pytest.fail(str(problem))
    assert WRITTEN.check(response).score == 1
    assert WRITTEN.is_same(response, WRITTEN.reference)
    assert WRITTEN.reason(response) == WRITTEN.first_wrong(response) == ""


def test_classes_are_scored_not_inputs() -> None:
    ties = changed(("if D > 0:", "if D >= 0:"))
    assert {one.name for one in WRITTEN.wrong(ties)} == {"ties"}
    assert WRITTEN.check(ties).score == 10 / 11
    assert WRITTEN.check(ties).counts == "right in 10 of 11 classes of inputs"
    # What the listing has right at first earns nothing; to lose it costs.
    repair = CodeAnswer(LECTURE, ties)
    assert repair.check(ties).score == repair.check(changed(("D += 2 * dy", "D += dy"))).score == 0
    assert repair.left_out(repair.read(ties)) == "Nothing is changed yet"


def test_the_smallest_input_that_shows_it_is_told_and_opened() -> None:
    lost = changed(("while x <= x1:", "while x < x1:"))
    assert WRITTEN.reason(lost) == "From (2, 2) to (2, 2): yours no pixel; right (2, 2)."
    opened = WRITTEN.opened(lost)
    edit = opened.edit
    assert edits_of(opened.typed) == (edit,)
    assert (edit.part, edit.of) == ("line", "bresenham-lecture")
    mine, its = edit.text.split("\n"), original(edit.part, edit.of).source.split("\n")
    assert [one for one, other in zip(mine, its, strict=True) if one != other] == ["  while x < x1:"]
    question = ask(TEMPLATES["write-bresenham-step"], 0)
    never = question.draft.answer.read("def step(y, D, dx, dy, sy):\n  return y, D + 2 * dy")
    judged = judge(question, never)
    assert judged.sentences == [
        "Y = 3, D = 1, dx = 3, dy = 1, sy = 1: yours y = 3, D = 3; right y = 4, D = -3."
    ]


def test_the_picture_to_be_drawn_is_that_of_the_right_listing() -> None:
    answer = ask(TEMPLATES["draw-dashes"], 0).draft.answer
    wanted, plain = answer.picture.primitive >= 0, answer.drawn(answer.start).primitive >= 0
    assert 0 < wanted.sum() < plain.sum()
    assert not (wanted & ~plain).any()


CANNOT = {
    "for k in range(3)": "a colon is missing",
    "return __import__('os')": "__import__",
    "return open('/etc/passwd')": "open",
    "return a.__class__": "line 2",
    "return [0] * 10 ** 9": "line 2",
    "return eval('1')": "eval",
    "return 1": "the three values",
    "return values, True": "values has no value",
}


@pytest.mark.parametrize("line", CANNOT)
def test_what_cannot_run_is_no_wrong_answer(line: str) -> None:
    answer = CodeAnswer(INSIDE, head_alone(INSIDE))
    with pytest.raises(CannotRunError, match=CANNOT[line].replace("(", ".")) as caught:
        answer.check(answer.read(f"{INSIDE.head}\n  {line}"))
    assert caught.value.place.line == 2
    assert answer.problem(f"{INSIDE.head}\n  {line}") is not None


def test_a_loop_without_end_is_told_with_its_line_and_costs_nothing() -> None:
    endless = changed(("x += sx", "x += 0"))
    response = WRITTEN.read(endless)
    with pytest.raises(CannotRunError, match="the loop goes on after") as caught:
        WRITTEN.check(response)
    assert LECTURE.text.split("\n")[caught.value.place.line - 1].strip() == "while x <= x1:"
    for nothing in ("", "\n\n", None, []):
        with pytest.raises(NotCheckedError, match="empty"):
            WRITTEN.read(nothing)
    with pytest.raises(NotCheckedError, match="as text"):
        WRITTEN.read(["def"])


def test_attempts_are_judged_again() -> None:
    question = ask(TEMPLATES["write-over"], 0)
    over = TASKS["over"]
    texts = (over.text, question.draft.mistakes["alpha-kept"])
    attempts = [_attempt(question, text) for text in texts]
    imported = judged_again(attempts, TEMPLATES, datetime.now(UTC))
    assert list(imported.attempts) == attempts
    assert [attempt.mistakes for attempt in attempts] == [(), ("alpha-kept",)]
    claimed = attempts[0].model_copy(
        update={"answer": f"{over.head}\n  while True:\n    x = 1\n  return [0, 0, 0, 0]"}
    )
    (judged,) = judged_again([claimed], TEMPLATES, datetime.now(UTC)).attempts
    assert not judged.is_checked


def _attempt(question: Question, text: str) -> Attempt:
    response = question.draft.answer.read(text)
    return attempt_of("Ada", question, response, judge(question, response), 1.0, datetime.now(UTC))


FILE = """
version = 1
title = "A listing"
stage = "raster"
question = "Repair it."

[answer]
type = "code"
"""


def test_a_file_asks_for_a_listing(tmp_path: Path) -> None:
    started = {
        'task = "bresenham-lecture"\nline = 14\nwrong = "if D >= 0:"': "    if D >= 0:",
        'task = "bresenham-lecture"\nline = 14': "    # this line is missing",
        'task = "edge-function"': "  # write the rest",
    }
    path = tmp_path / "listing.toml"
    for part, line in started.items():
        path.write_text(FILE + part, encoding="utf-8")
        answer = ask(read_exercise(path), 0).draft.answer
        assert line in answer.start.split("\n")
        assert answer.check(answer.reference).score == 1
    dots = LECTURE.text.replace("while x <= x1:", "while x <= x1 and x < x0 + 1:")
    path.write_text(
        f'{FILE}task = "bresenham-lecture"\nlisting = """{LECTURE.text}"""\nright = """{dots}"""',
        encoding="utf-8",
    )
    answer = ask(read_exercise(path), 0).draft.answer
    assert answer.check(dots).score == 1 > answer.check(LECTURE.text).score
    for part, said in {
        'task = "bresenham-lectures"': "expected one of bresenham-lecture",
        'task = "edge-function"\nline = 9': "expected a line from 2 to 3",
        'task = "edge-function"\nline = 2\nwrong = "dx, dy = x1 - x0, y1 - y0"': "wrong at first",
        'task = "edge-function"\nright = "def edge(x0, y0, x1, y1, x, y): return z"': "cannot run: line 1",
        'task = "edge-function"\nwrong = "x"': "expected line",
    }.items():
        path.write_text(FILE + part, encoding="utf-8")
        with pytest.raises(ValueError, match=said):
            read_exercise(path)
