"""Lessons on the Step page: what they open, hide, judge and notice; what was open before is there after them."""

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import FrameType

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton, QScrollBar
from pytestqt.qtbot import QtBot

from app.background import is_working
from app.files.open_any import open_any
from app.files.user_folders import attempt_file
from app.pages.exercises.page import ExercisesPage
from app.pages.lessons.walk import LessonWalk
from app.pages.step.ab.pictures import seen_of
from app.pages.step.kept_look import show_state
from app.window.main_window import MainWindow
from core.stages.vertices import process_geometry
from core.trace.tracers import trace_stage
from tests.app.pages.step.lesson_walks import DONE, OPEN, kept, opened, settled
from tests.lessons.course.lesson_texts import GOOD
from widgets.grid.display import GridDisplay
from widgets.grid.pixel_grid import PixelGrid

pytestmark = pytest.mark.shared_window


def test_a_step_is_one_entry_of_undo_and_closing_brings_back_what_was_open(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    session = window.session
    session.set_setting("fill_rule", "exclusive")
    session.set_pin((3, 4))
    window.page.show_panes(["methods", "inspector", "details", "run"])
    before, cursor, panes = session.document, session.cursor, window.page.shown_panes()
    walk = opened(window, qtbot, tmp_path)
    assert (session.document.title, session.pin) == ("Fan of shared edges", (32, 24))
    assert window.page.grid.buffer().name == "overdraw"
    assert window.page.shown_panes() == ["inspector", "run"]
    assert window.page.card.isHidden()
    session.undo()
    assert session.document is before
    walk.return_here()
    settled(window, qtbot)
    assert session.document is not before
    walk.view.close_button.click()
    assert not window.page.lessons.is_open
    assert session.document is before
    assert (session.cursor, session.pin, window.page.shown_panes()) == (cursor, (3, 4), panes)
    assert window.page.card.isVisible()


def test_steps_on_one_scene_share_its_document(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path, 1)
    document = window.session.document
    walk.next()
    assert settled(window, qtbot).number == 2
    assert window.session.document is document


def test_keys_and_dots_go_through_a_lesson(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path)
    numbers = []
    keys = Qt.Key.Key_PageDown, Qt.Key.Key_PageDown, Qt.Key.Key_PageUp
    for key, focused in zip(keys, (window.page.grid, window.page.timeline.bar, walk.view), strict=True):
        focused.setFocus()
        QTest.keyClick(focused, key)
        numbers.append(settled(window, qtbot).number)
    assert numbers == [1, 2, 1]
    walk.view.dots.dots[3].click()
    assert settled(window, qtbot).number == 3
    assert [dot.accessibleName() for dot in walk.view.dots.dots[::3]] == [
        "Step 1: done",
        "Step 4: open, shown now",
    ]
    walk.next()
    assert settled(window, qtbot).number == 4
    buttons = walk.view.findChildren(type(walk.view.next_button))
    assert any(button.text().startswith("Exercise: ") for button in buttons)


@pytest.mark.slow
def test_wandering_off_costs_nothing(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    walk = opened(window, qtbot, tmp_path)
    session, home = window.session, window.session.cursor
    assert not walk.view.return_button.isEnabled()
    session.set_setting("fill_rule", "exclusive")
    session.set_stage("depth", 0)
    assert walk.view.return_button.isEnabled()
    QTest.keyClick(window, Qt.Key.Key_Home, Qt.KeyboardModifier.ControlModifier)
    settled(window, qtbot)
    assert (session.cursor, session.document.settings.fill_rule) == (home, "inclusive")
    assert not walk.view.return_button.isEnabled()


def test_another_scene_closes_the_lesson_and_a_key_opens_it_again(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    looks = window.page.grids.look()
    opened(window, qtbot, tmp_path, 1)
    window.open_path("single-triangle")
    qtbot.waitUntil(lambda: window.session.document.title == "Single triangle")
    assert not window.page.lessons.is_open
    assert not window.session.is_predicting
    assert not window.session.is_asked_about
    assert window.page.grids.look().overlays == looks.overlays
    window.run_action("lesson_return")
    assert settled(window, qtbot).number == 1
    assert window.session.is_predicting


def test_what_is_opened_while_a_lesson_is_waited_for_stays_open(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("inside-or-outside", 1)
    window.files.show_opened(open_any("single-triangle"))
    qtbot.waitUntil(lambda: not window.page.lessons.is_working)
    assert not window.page.lessons.is_open
    assert window.session.document.title == "Single triangle"


def test_what_was_open_is_kept_for_the_next_start_with_the_lesson_over_it(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    folder = tmp_path / "lessons"
    folder.mkdir()
    (folder / "kept-lesson.toml").write_text(GOOD, encoding="utf-8")
    before = window.session.document
    window.page.lessons.open("kept-lesson", 1)
    settled(window, qtbot)
    state = window.files.kept_state()
    assert state.document is before
    assert state.look.lesson == ("kept-lesson", 1)
    assert window.files.state().look.lesson is None
    window.page.lessons.close()
    show_state(window.page, state)
    assert settled(window, qtbot).number == 1
    window.page.lessons.close()
    assert window.session.document is before


def test_a_task_is_noticed_when_it_is_done(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    task = opened(window, qtbot, tmp_path, 3)
    session, document = window.session, window.session.document
    corners = np.array(document.scene.clip)
    session.go_to(3)
    settled(window, qtbot)
    assert task.standings[3] is OPEN
    for triangle, corner in ((0, 2), (1, 1)):
        corners[triangle, corner, :2] = 2 * 4.25 / 6 - 1
    scene = replace(document.scene, clip=corners)
    session.edit(replace(document, scene=scene))
    qtbot.waitUntil(lambda: task.standings[3] is DONE)
    assert task.view.feedback.text() == "Done."
    session.undo()
    settled(window, qtbot)
    assert task.view.feedback.text().endswith("no longer does it.")
    assert task.standings[3] is DONE
    task.return_here()
    settled(window, qtbot)
    assert task.view.place.text() == "4 of 4, done before"
    assert task.view.task_icon.isHidden()
    session.go_to(2)
    settled(window, qtbot)
    assert task.view.feedback.text() == ""
    session.edit(replace(document, scene=scene))
    qtbot.waitUntil(lambda: task.view.feedback.text() == "Done.")
    assert [attempt.score for attempt in kept(task, window, qtbot)[-1:]] == [1]


def test_an_exercise_of_an_earlier_lesson_comes_first(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    text = GOOD.replace("minutes = 5", 'minutes = 5\nrecall = "shared-edge"')
    walk = opened(window, qtbot, tmp_path, 0, text)
    assert (walk.number, walk.view.next_button.text()) == (-1, "Begin")
    assert window.page.main_view() is walk.task.grid
    assert walk.answers.asked is not None
    template = walk.answers.asked.question.template
    before = len(attempt_file().attempts())
    walk.task.reveal()
    settled(window, qtbot)
    assert len(attempt_file().attempts()) == before
    walk.return_here()
    settled(window, qtbot)
    walk.answers.fill(walk.answers.asked.question.draft.answer.reference)
    walk.answers.check()
    settled(window, qtbot)
    assert attempt_file().attempts()[-1].template == template.name
    walk.next()
    assert settled(window, qtbot).number == 0
    assert not window.session.is_predicting


@pytest.mark.slow
def test_an_exercise_without_a_picture_has_none_and_names_its_lesson(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    text = GOOD.replace("minutes = 5", 'minutes = 5\nrecall = "edge-values"')
    walk = opened(window, qtbot, tmp_path / "with-picture", 0, text)
    assert walk.view.lead.text() == (
        "First, a question from the lesson “Inside or outside?”. To skip it, choose Begin."
    )
    assert window.page.main_view() is walk.task.grid
    text = text.replace("edge-values", "divide-by-w")
    walk = opened(window, qtbot, tmp_path / "without-picture", 0, text)
    assert walk.view.lead.text() == (
        "First, a question from the exercise “The divide by w”. To skip it, choose Begin."
    )
    shown = window.page.main_view()
    assert isinstance(shown, PixelGrid)
    assert shown.buffer() is None
    walk.next()
    settled(window, qtbot)
    assert window.page.main_view() is window.page.grid


def test_the_exercise_that_closes_a_lesson_leads_back_to_it(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    walk.go(4)
    settled(window, qtbot)
    walk.view.link_chosen.emit("exercise/shared-edge")
    assert window.pages.current_name == "exercises"
    back = window.pages.current.findChild(QPushButton, "back to the lesson")
    assert back is not None
    assert isinstance(window.pages.current, ExercisesPage)
    QApplication.processEvents()
    view, place = window.pages.current.question_view, back.mapTo(window, QPoint())
    view.step_button.setVisible(view.step_button.isHidden())
    QApplication.processEvents()
    assert back.mapTo(window, QPoint()) == place, "another button would come under the pointer"
    back.click()
    assert window.pages.current is window.page
    assert settled(window, qtbot).number == 4
    window.page.lessons.close()
    window.pages.show_page("exercises")
    assert back.isHidden()


def test_what_a_step_asks_on_another_page_stays_in_sight_there(window: MainWindow, qtbot: QtBot) -> None:
    lessons = window.page.lessons
    lessons.open("row-by-row", 5)
    walk = settled(window, qtbot)
    task, link = walk.step.task, walk.view.findChild(QPushButton, "compare/visibility")
    assert [button.property("role") for button in (link, walk.view.next_button)] == ["primary", ""]
    link.click()
    assert [button.property("role") for button in (link, walk.view.next_button)] == ["", "primary"]
    intros = []
    for name in ("compare", "stability"):
        window.pages.show_page(name)
        intros.append(window.pages.current.controls.intro)
    assert [task in intro.text() for intro in intros] == [True, False]
    lessons.close()
    window.pages.show_page("compare")
    assert task not in intros[0].text()


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_a_message_leaves_the_lesson_readable(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk, size: tuple[int, int]
) -> None:
    window.resize(*size)
    settled(window, qtbot)
    window.notices.warn(
        "A warning that says more than a line has room for, as it names what was expected. " * 3
    )
    QApplication.processEvents()
    message, lesson = (
        QRect(w.mapTo(window, QPoint()), w.size()) for w in (window.messages, window.page.side)
    )
    assert message.width() > 300
    assert not message.intersects(lesson)


@pytest.mark.slow
def test_no_step_stands_beside_a_whole_picture_and_a_listing_that_is_typed(
    window: MainWindow, qtbot: QtBot
) -> None:
    column = window.page.column
    for name in ("pixel-centres", "who-is-in-front"):
        window.page.lessons.open(name, 0)
        settled(window, qtbot)
        assert not column.isVisible()
        window.run_action("step_back")
        assert column.isVisible()
    window.page.lessons.open("repair-a-listing", 2)
    assert settled(window, qtbot).number == 2
    assert window.session.cursor.position > 0
    assert not column.isVisible()


@pytest.mark.slow
@pytest.mark.own_window
@pytest.mark.parametrize(
    ("name", "step"),
    [("one-row", 3), *(pytest.param(name, 4, marks=pytest.mark.slow) for name in ("spaces", "one-addition"))],
)
def test_a_formula_beside_a_lesson_is_whole_before_a_class(
    window: MainWindow, qtbot: QtBot, name: str, step: int
) -> None:
    window.appearance.set_theme("light")
    window.resize(1280, 720)
    window.presenter.arrange()
    column = window.page.column
    window.page.lessons.open("inside-or-outside", 3)  # Its answer leaves the history of a pixel.
    settled(window, qtbot).task.reveal()
    settled(window, qtbot)
    window.page.settle()
    assert column.history.view.isVisibleTo(column.history)
    window.page.lessons.open(name, step)
    walk = settled(window, qtbot)
    for _ in ("the question", "the answer"):
        window.page.settle()
        if column.isVisible():
            assert column.step.verticalScrollBar().maximum() == 0
            assert column.formula.height() >= column.formula.heightForWidth(column.formula.width())
            assert column.formula.visibleRegion().boundingRect() == column.formula.rect()
            text = window.page.side.panes()[0]
            assert text.geometry().bottom() < column.parentWidget().y(), "the formula is below the text"
            assert column.tabBar().visibleRegion().boundingRect().height() in (0, column.tabBar().height())
        walk.task.reveal()
        settled(window, qtbot)


@pytest.mark.slow
@pytest.mark.own_window
@pytest.mark.parametrize(("name", "step"), [("cutting-polygons", 2), ("repair-a-listing", 5)])
def test_a_list_or_a_listing_that_is_answered_does_not_scroll_before_a_class(
    window: MainWindow, qtbot: QtBot, name: str, step: int
) -> None:
    window.appearance.set_theme("light")
    window.resize(1280, 720)
    window.presenter.arrange()
    window.page.lessons.open(name, step)
    settled(window, qtbot).task.reveal()
    settled(window, qtbot)
    window.page.settle()
    side = window.page.side.panes()[0]
    bars = side.findChildren(QScrollBar)
    assert [bar.maximum() for bar in bars if bar.isVisible() and bar.maximum() > 0] == []


def test_a_broken_lesson_is_refused_with_its_line(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    document, path = window.session.document, tmp_path / "broken.toml"
    path.write_text(GOOD.replace('"drawn == 16"', '"drawn == 17"'), encoding="utf-8")
    window.open_path(str(path))
    qtbot.waitUntil(lambda: not window.page.lessons.is_working)
    assert "broken.toml: line" in window.messages.text.text()
    assert window.session.document is document
    assert not window.page.lessons.is_open


def test_a_file_of_an_exercise_is_none_of_a_lesson(window: MainWindow, tmp_path: Path) -> None:
    from app.files.user_folders import is_lesson_file

    path = tmp_path / "step.toml"
    path.write_text('question = "[[step]]"', encoding="utf-8")
    assert not is_lesson_file(str(path))
    assert not is_lesson_file(str(tmp_path / "none.toml"))


def test_a_step_beside_another_method_is_traced_in_the_background_and_painted_once(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    text = GOOD.replace('at = "end", buffer', 'at = "end", other = { fill = "scanline" }, buffer')
    assert text != GOOD
    walk = opened(window, qtbot, tmp_path, 1, text)
    codes = {each.__code__ for each in (trace_stage, process_geometry)}
    traced: list[str] = []
    painted: Counter[int] = Counter()

    def look(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code in codes:
            traced.append(frame.f_code.co_name)
        if event == "call" and frame.f_code is GridDisplay.paintEvent.__code__:
            painted[id(frame.f_locals["self"])] += 1

    sys.setprofile(look)
    try:
        walk.go(0)
        settled(window, qtbot)
        qtbot.wait(20)
    finally:
        sys.setprofile(None)
    comparing = window.page.comparing
    assert window.page.current_view() == "compare"
    assert comparing.second is not None
    assert comparing.second.trace.source.settings.fill == "scanline"
    assert not traced, "by the thread of the window"
    assert sorted(painted.values()) == [1, 1, 1]


def test_what_was_traced_and_seen_ahead_of_a_step_is_shown(window: MainWindow, qtbot: QtBot) -> None:
    page = window.page
    page.lessons.keeps_attempts = False
    page.lessons.open("the-middle", 4)
    walk = settled(window, qtbot)
    qtbot.waitUntil(lambda: not (is_working(walk.states) or page.inspector.ahead.is_working))
    looked: list[FrameType] = []

    def look(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code is seen_of.__code__:
            looked.append(frame)

    sys.setprofile(look)
    try:
        walk.next()
        settled(window, qtbot)
    finally:
        sys.setprofile(None)
    assert walk.number == 5
    assert page.comparing.second is not None
    assert page.comparing.second.trace.source.settings.interpolation == "affine-n"
    assert looked == []
