"""A listing that a lesson asks for: judged on hidden inputs, and not charged where it cannot run."""

from pathlib import Path

from pytestqt.qtbot import QtBot

from app.window.main_window import MainWindow
from lessons.course import catalogue
from tests.app.pages.step.test_lessons import answered, kept, opened
from widgets.exercises.code_answer import CodeAnswerView

LESSON = Path(catalogue.__file__).with_name("repair-a-listing.toml").read_text(encoding="utf-8")


def test_a_lesson_asks_for_a_listing(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path, 2, LESSON)
    assert walk.answers.asked is not None
    right = walk.answers.asked.question.draft.answer.reference
    endless = right.replace("x += sx", "x += 0")
    assert answered(walk, qtbot, endless) == ""
    assert walk.view.note.text().startswith("Not checked yet: line 12, column 3: the loop goes on after")
    form = walk.view.answer
    assert isinstance(form, CodeAnswerView)
    assert form.editor.accessibleDescription().startswith("Line 12, column 3")
    assert kept(walk, window, qtbot) == []
    assert answered(walk, qtbot, right.replace("while x <= x1", "while x < x1")) == ""
    assert walk.view.note.text().startswith("Nothing is changed yet.")
    said = answered(walk, qtbot, right.replace("if D > 0:", "if D >= 0:"))
    assert "From (7, 6) to (5, 5): yours (5, 5), (6, 6), (7, 6); right (5, 5), (6, 5), (7, 6)." in said
    assert answered(walk, qtbot, right.replace("x <= x1", "not x > x1")).startswith("Right.")
    assert [attempt.score for attempt in kept(walk, window, qtbot)] == [0, 1]
