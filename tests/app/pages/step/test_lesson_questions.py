"""Questions of lessons on the Step page: what they hide, judge, refute and keep."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.pages.lessons.walk import LessonWalk
from app.window.main_window import MainWindow
from lessons.scene_edits import scene_digest
from tests.app.pages.step.lesson_walks import DONE, OPEN, SEEN, answered, kept, opened, settled
from tests.lessons.course.lesson_texts import GOOD
from widgets.grid.layers import MaskOverlay

pytestmark = pytest.mark.shared_window


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
    assert answered(walk, qtbot, 3).startswith("Not yet.\nThere is no hint for this answer.")
    walk.return_here()
    settled(window, qtbot)
    assert answered(walk, qtbot, 25) == "That would be right if each edge counted."
    assert walk.view.reveal_button.text() == "Reveal"
    answered(walk, qtbot, 25)
    assert walk.view.reveal_button.text() == "Show me"
    answered(walk, qtbot, 3)
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
        (0, ()),
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


def test_a_digit_chooses_an_option_and_goes_to_no_stage(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    choice = 'answer = { type = "choice", options = ["none", "all", "half"], right = ["half"] }'
    text = GOOD.replace('answer = { type = "pixels", triangle = 0 }', choice)
    text = text.replace('mistakes = ["all-edges-inclusive", "all-edges-exclusive"]', "")
    walk = opened(window, qtbot, tmp_path, 2, text)
    answer = walk.view.answer
    answer.buttons[0].setFocus(Qt.FocusReason.TabFocusReason)
    for key, chosen in (("2", ["all"]), ("9", ["all"]), ("3", ["half"])):
        focused = QApplication.focusWidget()
        assert focused is not None
        QTest.keyClicks(focused, key)
        assert answer.given() == chosen
        assert window.session.cursor.stage == "raster"
    QTest.keyClick(walk.view, Qt.Key.Key_Return)
    settled(window, qtbot)
    assert walk.standings[2] is DONE


def test_alt_and_an_arrow_move_the_item_of_an_order_not_the_pin(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("cutting-polygons", 2)
    answer, pin = settled(window, qtbot).view.answer, window.session.moment.pin
    first, second, *rest = answer.given()
    answer.list.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(answer.list, Qt.Key.Key_Down, Qt.KeyboardModifier.AltModifier)
    assert answer.given() == [second, first, *rest]
    assert window.session.moment.pin == pin


def test_a_clicker_goes_back_to_the_end_of_the_lesson_before(window: MainWindow, qtbot: QtBot) -> None:
    lessons = window.page.lessons
    lessons.open("inside-or-outside")
    walk = settled(window, qtbot)
    lessons.retreat()
    settled(window, qtbot)
    assert (walk.lesson.name, walk.step) == ("pixel-centres", None)
    lessons.open("pixel-centres", 0)
    settled(window, qtbot)
    lessons.retreat()
    settled(window, qtbot)
    assert (walk.lesson.name, walk.number) == ("pixel-centres", 0)


@pytest.mark.slow
def test_revealing_counts_as_seen(window: MainWindow, qtbot: QtBot, walk: LessonWalk) -> None:
    QTest.keyClick(window, Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier)
    settled(window, qtbot)
    assert walk.view.feedback.text().startswith("This is the answer.\nSixteen, and none")
    assert walk.view.answer.given() == [["16"]]
    assert walk.view.check_button.isHidden()
    assert walk.standings[1] is SEEN
    assert kept(walk, window, qtbot)[-1].score == 0


@pytest.mark.slow
def test_p_ends_no_question_and_stepping_on_leaves_a_seen_step(
    window: MainWindow, qtbot: QtBot, walk: LessonWalk
) -> None:
    window.run_action("predict")
    assert window.session.is_predicting
    assert "Answer first" in window.statusBar().currentMessage()
    window.session.step(1)
    assert answered(walk, qtbot, 16).startswith("Right.")
    assert walk.standings[1] is SEEN


@pytest.mark.slow
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


@pytest.mark.slow
def test_a_question_asked_again_has_nothing_marked(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("pixel-centres", 2)
    walk = settled(window, qtbot)
    walk.task.reveal()
    settled(window, qtbot)
    walk.return_here()
    settled(window, qtbot)
    form = walk.view.answer
    assert form.given() == []
    assert form.count.text().startswith("0 ")


@pytest.mark.slow
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


def test_return_on_the_picture_checks_what_is_marked(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("pixel-centres", 2)
    walk = settled(window, qtbot)
    asked = walk.answers.asked
    walk.answers.fill(asked.question.draft.answer.reference)
    QTest.keyClick(walk.task.grid, Qt.Key.Key_Return)
    settled(window, qtbot)
    assert walk.answers.last.outcome.is_right


def test_after_a_click_the_arrows_still_go_to_pixels(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("pixel-centres", 2)
    grid, session = settled(window, qtbot).task.grid, window.session
    center = grid.placement().cells_rect(1, 0).center().toPoint()
    QTest.mouseClick(grid, Qt.MouseButton.LeftButton, pos=center)
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Space):
        QTest.keyClick(grid, key)
    assert grid.marked() == {(1, 0), (2, 0)}
    assert (session.cursor.position, session.is_predicting) == (0, True)


def test_the_pyramid_is_seen_while_a_lesson_asks_about_it(window: MainWindow, qtbot: QtBot) -> None:
    window.page.lessons.open("behind-the-wall", 3)
    settled(window, qtbot)
    beside = window.page.main_area.companions["occluders"]
    assert window.session.is_predicting
    assert beside.widget.isVisibleTo(window)
    assert beside.grid.accessibleDescription() == "Compared with: (2, 2) and (3, 2)."


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
