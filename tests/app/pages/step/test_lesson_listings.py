"""A listing that a lesson asks for: judged on hidden inputs, and not charged where it cannot run."""

from collections.abc import Callable
from pathlib import Path
from threading import Event

import pytest
from PySide6.QtCore import QPoint
from pytestqt.qtbot import QtBot

from app.pages.exercises import answers
from app.window.main_window import MainWindow
from lessons.course.catalogue import FOLDER
from lessons.exercises.question import Draft
from tests.app.pages.step.lesson_walks import answered, kept, opened, settled
from widgets.exercises.answer_forms import CodeAnswerView
from widgets.exercises.records import Standing


def lesson_text(name: str) -> str:
    return (FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def test_a_listing_that_is_edited_is_a_task(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path, 5, lesson_text("shared-edges"))
    pane, box = window.page.column.code, window.page.compare_view.buffer_box
    window.run_action("edit_line")
    window.page.settle()
    editor, right, place = pane.editor, pane.editor.text, window.page.column.mapTo(window, QPoint())
    editor.begin(right.replace("value > 0 or", "value > 0 and"), 1)
    editor.text_typed.emit(editor.text)
    settled(window, qtbot)
    assert walk.standings[5] is Standing.OPEN
    assert walk.view.feedback.text().startswith("Not yet")
    window.page.settle()
    assert window.page.column.mapTo(window, QPoint()) == place, "moved under who types"
    editor.begin(right.replace("value > 0 or", "value >= 0 or"), 1)
    editor.text_typed.emit(editor.text)
    qtbot.waitUntil(lambda: walk.standings[5] is Standing.DONE)
    assert (window.page.current_view(), box.currentData()) == ("compare", "overdraw")
    # One way to do it is shown with the text that draws it.
    walk.return_here()
    settled(window, qtbot)
    assert (window.page.current_view(), window.session.document.edits) == ("pixels", ())
    walk.task.reveal()
    settled(window, qtbot)
    assert [edit.part for edit in window.session.document.edits] == ["fill"]
    assert (window.page.current_view(), box.currentData()) == ("compare", "overdraw")


def test_what_is_typed_takes_the_place_of_the_gap_and_next_keeps_its_own(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    walk = opened(window, qtbot, tmp_path, 5, lesson_text("repair-a-listing"))
    answer, view = walk.view.answer, walk.view
    assert isinstance(answer, CodeAnswerView)
    assert answer.editor.textCursor().selectedText() == "# write the rest"
    window.page.settle()
    place = view.next_button.mapTo(window, QPoint())
    view.show_note("Line 2, column 3: the lines that belong to the line above must stand further right.")
    window.page.settle()
    assert view.next_button.mapTo(window, QPoint()) == place, "moved under who types"


def test_a_shader_that_is_typed_is_a_task(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path, 2, lesson_text("write-a-shader"))
    pane = window.page.shader_pane
    editor = pane.editor("vertex")
    assert editor.isVisible()
    right = editor.toPlainText().replace("= modelView", "= projectionMatrix * modelView")
    for text in (right.replace("1.0)", "1.0"), right):
        assert walk.standings[2] is Standing.OPEN
        editor.setPlainText(text)
        editor.text_settled.emit(text)
        settled(window, qtbot)
    qtbot.waitUntil(lambda: walk.standings[2] is Standing.DONE)
    assert walk.view.feedback.text().startswith("Done.")


@pytest.mark.slow
def test_what_a_check_finds_stays_marked(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A listing that is tried while it is typed may take longer than its check: the check holds."""
    walk = opened(window, qtbot, tmp_path, 2, lesson_text("repair-a-listing"))
    assert walk.answers.asked is not None
    checked = Event()

    def tried_late(draft: Draft, given: object) -> Callable[..., answers.Tried]:
        def tried(*_: object) -> answers.Tried:
            checked.wait()
            return answers.Tried(given, None)

        return tried

    monkeypatch.setattr("app.pages.lessons.question.trying", tried_late)
    form = walk.view.answer
    assert isinstance(form, CodeAnswerView)
    endless = walk.answers.asked.question.draft.answer.reference.replace("x += sx", "x += 0")
    assert answered(walk, qtbot, endless) == ""
    checked.set()
    settled(window, qtbot)
    assert form.editor.has_problem


@pytest.mark.own_window
def test_next_keeps_its_place_below_a_listing_that_scrolls(window: MainWindow, qtbot: QtBot) -> None:
    window.resize(1280, 640)
    window.page.lessons.open("repair-a-listing", 2)
    walk = settled(window, qtbot)
    assert walk.answers.asked is not None
    right = walk.answers.asked.question.draft.answer.reference
    window.page.settle()
    assert walk.task.scroll.verticalScrollBar().maximum() > 0
    place = walk.view.next_button.mapTo(window, QPoint())
    for given in (right.replace("if D > 0:", "if D >= 0:"), right):
        assert answered(walk, qtbot, given)
        settled(window, qtbot)
        window.page.settle()
        # At the end there is the margin of the pane below it.
        assert abs(walk.view.next_button.mapTo(window, QPoint()).y() - place.y()) <= 8
        feedback, bar = walk.view.feedback, walk.view.bar
        assert feedback.mapTo(window, feedback.rect().bottomLeft()).y() < bar.mapTo(window, QPoint()).y()


def test_a_lesson_asks_for_a_listing(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path, 2, lesson_text("repair-a-listing"))
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


def test_undo_in_a_shader_leads_to_no_text_before_the_step(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("write-a-shader", 1)
    walk = settled(window, qtbot)
    for number in (2, 3, 4):
        walk.next()
        assert settled(window, qtbot).number == number
        editor = window.page.shader_pane.editor("vertex")
        given = editor.toPlainText()
        editor.undo()
        assert (editor.toPlainText(), walk.task.is_unsolved) == (given, True)


def test_a_listing_is_wrapped_for_the_width_that_it_has(window: MainWindow, qtbot: QtBot) -> None:
    page, seen = window.page, 0
    page.lessons.keeps_attempts = False
    for name in ("behind-the-wall", "the-middle"):
        page.lessons.open(name, 0)
        walk = settled(window, qtbot)
        for _ in range(len(walk.lesson.steps)):
            page.settle()
            listing = page.listing
            line = listing.document().firstBlock().layout().lineAt(0)
            if listing.isVisible() and line.isValid():
                seen += 1
                room = listing.viewport().width() - 2 * listing.document().documentMargin()
                assert line.width() == room, (name, walk.number)
            walk.next()
            settled(window, qtbot)
    assert seen > 4
