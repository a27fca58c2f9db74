"""A lesson before a class: a clicker leads through it, and keeps nothing."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.pages.lessons.walk import LessonWalk
from app.window.main_window import MainWindow
from tests.app.pages.step.lesson_walks import SEEN, kept, opened, settled
from widgets.inspector.listing_editor import ListingEditor

pytestmark = pytest.mark.shared_window


def test_a_clicker_shows_the_answer_first_and_keeps_nothing(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    before = kept(walk, window, qtbot)
    window.resize(1280, 720)
    window.presenter.arrange()
    settled(window, qtbot)
    assert window.page.main_view().width() >= 640
    assert walk.view.isVisible()
    assert window.page.place.text() == "Whose pixel?, step 2 of 4"
    assert walk.view.title.isHidden()
    buttons = walk.view.reveal_button, walk.view.next_button
    assert [button.property("role") for button in buttons] == ["primary", ""]
    QTest.keyClick(window, Qt.Key.Key_PageDown)
    settled(window, qtbot)
    assert (walk.number, walk.view.feedback.isVisible()) == (1, True)
    assert [button.property("role") for button in buttons] == ["", "primary"]
    QTest.keyClick(window, Qt.Key.Key_PageUp)
    assert (settled(window, qtbot).number, walk.answers.is_open) == (1, True)
    for _ in ("the answer", "the next step"):
        QTest.keyClick(window, Qt.Key.Key_PageDown)
        settled(window, qtbot)
    assert walk.number == 2
    QTest.keyClick(window, Qt.Key.Key_PageUp)
    assert settled(window, qtbot).number == 1
    chooser = window.overlays.scenes
    QTest.keyClick(window, Qt.Key.Key_F5)
    assert chooser.isVisible()
    assert [chooser.list.item(row).text() for row in (0, 1)] == ["Lessons", "Start of this lesson"]
    QTest.keyClicks(chooser.field, "start of this")
    QTest.keyClick(chooser.field, Qt.Key.Key_F5)
    assert settled(window, qtbot).number == 0
    assert kept(walk, window, qtbot) == before
    window.presenter.leave()
    assert walk.view.isVisible()


@pytest.mark.own_window
def test_what_is_typed_in_an_editor_is_not_a_clickers(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("repair-a-listing", 2)
    walk = settled(window, qtbot)
    window.presenter.arrange()
    editor, cursor = walk.view.findChild(ListingEditor), window.session.cursor
    editor.setFocus()
    qtbot.waitUntil(editor.hasFocus)
    place, before = editor.textCursor().position(), editor.toPlainText()
    QTest.keyClicks(editor, "b.")
    assert editor.toPlainText() == f"{before[:place]}b.{before[place:]}"
    QTest.keyClick(editor, Qt.Key.Key_Left)
    assert (editor.textCursor().position(), window.session.cursor) == (place + 1, cursor)
    QTest.keyClick(editor, Qt.Key.Key_PageDown)
    assert not settled(window, qtbot).task.is_unsolved


def test_a_clicker_leads_back_from_a_scene_to_the_lesson(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    window.presenter.arrange()
    for _ in ("the answer", "the next step"):
        QTest.keyClick(window, Qt.Key.Key_PageDown)
        settled(window, qtbot)
    window.open_path("cube")
    qtbot.waitUntil(lambda: not window.page.lessons.is_open)
    for _ in ("start of the run", "the list"):
        QTest.keyClick(window, Qt.Key.Key_F5)
    chooser = window.overlays.scenes
    assert chooser.list.currentItem().text() == "Back to: Whose pixel?, step 3 of 4"
    assert chooser.list.count() > 20
    QTest.keyClick(chooser.field, Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: window.page.lessons.is_open)
    assert (settled(window, qtbot).number, walk.standings[1]) == (2, SEEN)


@pytest.mark.slow
def test_a_clicker_shows_how_a_task_is_done(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path, 3)
    scene = window.session.document.scene
    window.presenter.arrange()
    assert walk.view.reveal_button.isVisible()
    QTest.keyClick(window, Qt.Key.Key_PageDown)
    settled(window, qtbot)
    shown = window.session.document.scene.clip[0][2]
    assert (shown[:2] == 2 * 4.25 / 6 - 1).all()
    assert (walk.number, walk.standings[3]) == (3, SEEN)
    assert walk.view.feedback.text() == "This is one way to do it."
    QTest.keyClick(window, Qt.Key.Key_PageUp)
    settled(window, qtbot)
    assert (walk.number, window.session.document.scene) == (3, scene)
    for _ in ("the solution", "the end"):
        QTest.keyClick(window, Qt.Key.Key_PageDown)
        settled(window, qtbot)
    assert walk.number == 4


@pytest.mark.own_window
@pytest.mark.parametrize(
    ("name", "step", "keys", "given"),
    [("shared-edges", 2, "-1", [["-1"]]), ("shared-edges", 4, "2", ["triangle 1"])],
)
def test_a_digit_answers_the_open_question_wherever_the_keyboard_is(
    window: MainWindow, qtbot: QtBot, name: str, step: int, keys: str, given: list[object]
) -> None:
    window.page.lessons.open(name, step)
    walk = settled(window, qtbot)
    window.presenter.arrange()
    settled(window, qtbot)
    window.page.take_focus()
    cursor = window.session.cursor
    for key in keys:
        QTest.keyClick(window.windowHandle(), key)
    assert (walk.view.answer.given(), window.session.cursor) == (given, cursor)
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Return)
    settled(window, qtbot)
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Period)
    assert (window.presenter.end_black(), walk.view.answer.given()) == (True, given)
    for _ in ("the answer", "a black screen"):
        QTest.keyClick(
            window.windowHandle(), Qt.Key.Key_PageDown if walk.answers.is_open else Qt.Key.Key_Period
        )
        settled(window, qtbot)
    assert window.presenter.end_black()


def test_a_class_reads_which_method_solves_a_task(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("who-is-in-front", 5)
    walk = settled(window, qtbot)
    walk.task.reveal()
    settled(window, qtbot)
    assert walk.view.feedback.text().startswith("This is one way to do it (visibility: Z-buffer).")
