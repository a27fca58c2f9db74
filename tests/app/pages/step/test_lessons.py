"""Lessons on the Step page: what they open, hide, judge and notice; what was open before is there after them."""

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from types import FrameType

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file
from app.pages.lessons.walk import LessonWalk
from app.pages.step.kept_look import show_state
from app.window.main_window import MainWindow
from core.stages.vertices import process_geometry
from core.trace.tracers import trace_stage
from lessons.attempts.record import Attempt
from lessons.scene_edits import scene_digest
from tests.lessons.course.lesson_texts import GOOD
from widgets.exercises.picture_answers import PixelAnswerView
from widgets.exercises.records import Standing
from widgets.grid.display import GridDisplay
from widgets.grid.layers import MaskOverlay
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.listing_editor import ListingEditor

pytestmark = pytest.mark.shared_window
OPEN, SEEN, DONE = Standing.OPEN, Standing.SEEN, Standing.DONE


def settled(window: MainWindow, qtbot: QtBot) -> LessonWalk:
    """Wait until nothing is worked on any more; return the lesson."""
    qtbot.waitUntil(lambda: not window.page.lessons.is_working)
    QApplication.processEvents()
    walk = window.page.lessons.walk
    assert walk is not None
    return walk


def opened(window: MainWindow, qtbot: QtBot, folder: Path, step: int = 0, text: str = GOOD) -> LessonWalk:
    """Open the lesson of a text, which nobody has begun, at a step from 0."""
    folder.mkdir(exist_ok=True)
    path = folder / f"{folder.name[:40].strip('_').replace('_', '-')}.toml"
    path.write_text(text, encoding="utf-8")
    window.open_path(str(path))
    walk = settled(window, qtbot)
    if step:
        walk.go(step)
        settled(window, qtbot)
    return walk


def answered(walk: LessonWalk, qtbot: QtBot, given: object) -> str:
    """Type an answer, press Return, and return what is said of it."""
    asked = walk.answers.asked
    assert asked is not None
    walk.answers.fill(asked.question.draft.answer.read(given))
    QTest.keyClick(walk.view, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: not walk.is_working)
    return walk.view.feedback.text()


def kept(walk: LessonWalk, window: MainWindow, qtbot: QtBot) -> list[Attempt]:
    """Return what is kept of a lesson."""
    assert walk.lesson is not None
    settled(window, qtbot)
    prefix = f"lesson/{walk.lesson.name}/"
    return [attempt for attempt in attempt_file().attempts() if attempt.template.startswith(prefix)]


# What is open.


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


# Predicting.


@pytest.fixture
def walk(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> LessonWalk:
    """Return a lesson at its first question."""
    return opened(window, qtbot, tmp_path, 1)


def test_a_question_hides_its_scene_until_it_is_answered(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    session = window.session
    asked = scene_digest(session.document.scene)
    assert session.is_predicting
    assert asked in session.asked_scenes
    window.pages.show_page("compare")
    assert window.pages.is_covered
    window.pages.cover.back_button.click()
    assert window.pages.current is window.page
    window.pages.show_page("start")
    assert not window.pages.is_covered
    assert "a question about" in window.pages.current.now_label.text()
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert (window.pages.current, session.cursor.position) == (window.page, 0)
    assert answered(walk, qtbot, 16).startswith("Right.")
    settled(window, qtbot)
    assert not session.is_predicting
    assert asked not in session.asked_scenes
    assert session.stage_trace.columns["values"][session.moment.row][1] == 0
    assert walk.standings == [DONE, DONE, OPEN, OPEN]
    attempt = kept(walk, window, qtbot)[-1]
    assert (attempt.score, attempt.mistakes, attempt.asked) == (1, (), ("all-edges-inclusive",))


def test_a_wrong_answer_is_refuted_and_twice_wrong_offers_the_step(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    assert answered(walk, qtbot, 3).startswith("Not yet.\nIt is none of the known mistakes.")
    walk.return_here()
    settled(window, qtbot)
    assert answered(walk, qtbot, 25) == "That would be right if each edge counted."
    assert walk.view.reveal_button.text() == "Reveal"
    answered(walk, qtbot, 25)
    assert walk.view.reveal_button.text() == "Show me"
    assert window.session.is_predicting
    walk.view.reveal_button.click()
    settled(window, qtbot)
    assert window.session.stage_trace.marks["tie"][window.session.moment.row]
    assert answered(walk, qtbot, 16).startswith("Right.")
    assert walk.standings[1] is SEEN
    attempts = kept(walk, window, qtbot)[-3:]
    assert [(attempt.score, attempt.mistakes) for attempt in attempts] == [
        (0, ("all-edges-inclusive",)),
        (0, ("all-edges-inclusive",)),
        (0, ()),
    ]


def test_without_a_refuting_step_the_run_with_the_mistake_stands_beside(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    walk = opened(window, qtbot, tmp_path / "without-step", 1, GOOD.replace('at = "tie"\n', ""))
    for _ in range(2):
        answered(walk, qtbot, 25)
    walk.task.reveal()
    assert window.page.current_view() == "compare"
    assert "all edges inclusive" in window.page.compare_view.linked.titles[1].text()


def test_check_and_next_keep_their_place(window: MainWindow, qtbot: QtBot, walk: LessonWalk) -> None:
    view, places = walk.view, []
    for given in (None, 25, 3, 16):
        if given is not None:
            answered(walk, qtbot, given)
            settled(window, qtbot)
        places.append((view.check_button.y(), view.next_button.y()))
    assert places == places[:1] * 4


def test_revealing_counts_as_seen(window: MainWindow, qtbot: QtBot, walk: LessonWalk) -> None:
    QTest.keyClick(window, Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier)
    settled(window, qtbot)
    assert walk.view.feedback.text().startswith("This is the answer.\nSixteen, and none")
    assert walk.view.answer.given() == [["16"]]
    assert walk.view.check_button.isHidden()
    assert walk.standings[1] is SEEN
    assert kept(walk, window, qtbot)[-1].score == 0


def test_p_ends_no_question_and_stepping_on_leaves_a_seen_step(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    window.run_action("predict")
    assert window.session.is_predicting
    assert "Answer first" in window.statusBar().currentMessage()
    window.session.step(1)
    assert answered(walk, qtbot, 16).startswith("Right.")
    assert walk.standings[1] is SEEN


def test_a_hidden_page_offers_to_leave_the_lesson(window: MainWindow, walk: LessonWalk) -> None:
    window.pages.show_page("compare")
    window.pages.cover.leave_button.click()
    assert walk.lesson is None
    assert not window.pages.is_covered


def test_pixels_are_marked_on_the_page_s_picture(window: MainWindow, qtbot: QtBot, walk: LessonWalk) -> None:
    walk.go(2)
    settled(window, qtbot)
    assert window.page.main_view() is walk.task.grid
    extra = [(column, row) for row in range(5) for column in range(row, 5)]
    said = answered(walk, qtbot, [list(pixel) for pixel in extra])
    assert "5 extra" in said
    assert "row with a wrong one: row 0" in said
    assert len(said.splitlines()) == 2  # the mistake by its name
    assert not any(isinstance(each, MaskOverlay) and each.mask.any() for each in walk.task.grid.overlays())
    answered(walk, qtbot, [list(pixel) for pixel in extra])
    assert any(isinstance(each, MaskOverlay) and each.mask.any() for each in walk.task.grid.overlays())
    assert window.page.main_view() is walk.task.grid
    walk.next()
    settled(window, qtbot)
    assert window.page.main_view() is window.page.grid


def test_a_question_asked_again_has_nothing_marked(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("pixel-centres", 2)
    walk = settled(window, qtbot)
    walk.task.reveal()
    settled(window, qtbot)
    walk.return_here()
    settled(window, qtbot)
    form = walk.view.answer
    assert isinstance(form, PixelAnswerView)
    assert form.given() == []
    assert form.count.text().startswith("0 ")


def test_two_answers_look_alike(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    """Two scenes that differ by a hair, in the answer alone, show the same in every pixel while they are asked."""
    seen: list[QImage] = []
    for left, answer in (("1.5", 10), ("1.500000000001", 6)):
        head = GOOD.split("[state.scene]")[0].replace(
            '"bounding-box"', '"bounding-box", coverage = "float64"'
        )
        scene = (
            f"[state.scene]\nsize = [6, 6]\ntriangles = [[[{left}, 0.75], [5.25, 0.75], [{left}, 4.75]]]\n"
        )
        step = f"""
[[step]]
kind = "predict"
text = "How many pixels are drawn?"
state = {{ pixel = [1, 2] }}
answer = {{ type = "numbers", values = [{answer}] }}
check_after = ["drawn == {answer}"]
"""
        walk = opened(window, qtbot, tmp_path / f"alike-{answer}", 0, head + scene + 4 * step)
        assert walk.answers.is_open
        window.page.settle()
        window.statusBar().clearMessage()
        seen.append(window.grab().toImage())
    assert seen[0] == seen[1]


# Doing.


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
    assert task.view.feedback.isHidden()
    session.edit(replace(document, scene=scene))
    qtbot.waitUntil(lambda: task.view.feedback.text() == "Done.")
    assert [attempt.score for attempt in kept(task, window, qtbot)[-1:]] == [1]


def test_a_lesson_begun_anew_has_nothing_done(window: MainWindow, qtbot: QtBot, walk: LessonWalk) -> None:
    answered(walk, qtbot, 16)
    settled(window, qtbot)
    window.run_action("lesson_anew")
    settled(window, qtbot)
    assert walk.number == 0
    assert walk.standings == [DONE, OPEN, OPEN, OPEN]  # A step to look at is done once it is open.
    assert walk.lesson is not None
    window.page.lessons.open(walk.lesson, 2)
    assert settled(window, qtbot).standings[1] is OPEN


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


def test_an_exercise_without_a_picture_has_none_and_names_its_lesson(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    text = GOOD.replace("minutes = 5", 'minutes = 5\nrecall = "edge-values"')
    walk = opened(window, qtbot, tmp_path / "with-picture", 0, text)
    assert walk.view.lead.text() == "From the lesson “Inside or outside?”. You may skip it: choose Begin."
    assert window.page.main_view() is walk.task.grid
    text = text.replace("edge-values", "divide-by-w")
    walk = opened(window, qtbot, tmp_path / "without-picture", 0, text)
    assert walk.view.lead.text() == "From the exercise “The divide by w”. You may skip it: choose Begin."
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
    back.click()
    assert window.pages.current is window.page
    assert settled(window, qtbot).number == 4
    window.page.lessons.close()
    window.pages.show_page("exercises")
    assert back.isHidden()


def test_return_on_the_picture_checks_what_is_marked(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("pixel-centres", 2)
    walk = settled(window, qtbot)
    asked = walk.answers.asked
    assert asked is not None
    walk.answers.fill(asked.question.draft.answer.reference)
    QTest.keyClick(walk.task.grid, Qt.Key.Key_Return)
    settled(window, qtbot)
    assert walk.answers.last is not None
    assert walk.answers.last.outcome.is_right


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


@pytest.mark.own_window
@pytest.mark.parametrize(
    ("name", "step"), [("one-row", 3), pytest.param("spaces", 4, marks=pytest.mark.slow)]
)
def test_a_formula_beside_a_lesson_is_whole_before_a_class(
    window: MainWindow, qtbot: QtBot, name: str, step: int
) -> None:
    window.appearance.set_theme("light")
    window.resize(1280, 720)
    window.presenter.arrange()
    window.page.lessons.open(name, step)
    walk = settled(window, qtbot)
    for _ in ("the question", "the answer"):
        window.page.settle()
        column = window.page.column
        if column.isVisible():
            assert column.step.verticalScrollBar().maximum() == 0
            assert column.formula.height() >= column.formula.heightForWidth(column.formula.width())
            assert column.formula.visibleRegion().boundingRect() == column.formula.rect()
            assert column.tabBar().visibleRegion().boundingRect().height() in (0, column.tabBar().height())
        walk.task.reveal()
        settled(window, qtbot)


# In front of a class, and what is refused.


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
    assert editor is not None
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


def test_the_picture_has_the_place_of_what_a_question_hides(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("two-walls", 1)
    walk = settled(window, qtbot)
    before = window.page.grid.height()
    assert window.page.main_area.beside.isHidden()
    walk.task.reveal()
    settled(window, qtbot)
    assert not window.page.main_area.beside.isHidden()
    assert window.page.grid.height() < before


def test_a_lesson_shows_the_inspector_from_the_first_step_on(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    opened(window, qtbot, tmp_path, 2)
    window.session.go_to(0)
    assert not window.page.column.isVisible()
    window.session.go_to(1)
    assert window.page.column.isVisible()


def test_the_end_keeps_the_last_picture_and_gives_no_answer_away(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    head, *steps = GOOD.split("[[step]]\n")
    last_asks = "[[step]]\n".join([head, *(f"{steps[k]}\n" for k in (0, 2, 3, 1))])
    walk = opened(window, qtbot, tmp_path, 3, last_asks)
    scene = window.session.document.scene
    walk.next()
    settled(window, qtbot)
    assert (walk.number, window.session.document.scene, window.session.is_predicting) == (4, scene, True)
    walk.back()
    settled(window, qtbot)
    walk.task.reveal()
    settled(window, qtbot)
    place = window.session.cursor
    walk.next()
    settled(window, qtbot)
    assert (walk.number, window.session.cursor, window.session.is_predicting) == (4, place, False)


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
