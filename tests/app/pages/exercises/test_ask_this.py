"""Ask this: a step or a value of the Step page becomes a question; while it is asked, the Step page hides it."""

from collections.abc import Callable
from itertools import count

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file
from app.pages.cover import COVERED
from app.pages.exercises.page import ExercisesPage
from app.window.main_window import MainWindow
from core import Settings
from core.records.steps import Level
from lessons.exercises.question import ask, judge
from lessons.exercises.screen import Screen, scene_name, screen_of, screen_template
from lessons.scenes import make_scene
from tests.covering import every_nth
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.question_view import QuestionView

pytestmark = pytest.mark.shared_window
COLUMNS = count(24)


def exercises(window: MainWindow) -> ExercisesPage:
    page = window.pages.current
    page.settle()
    return page


def asked_value(window: MainWindow) -> ExercisesPage:
    """Ask about a pixel that no other test has asked about: what was given up earns nothing any more."""
    window.session.set_stage("raster", 4000)
    window.session.set_pin((next(COLUMNS), 20))
    window.run_action("ask_value")
    return exercises(window)


def test_a_step_is_asked_hidden_and_shown_after_the_check(window: MainWindow) -> None:
    session = window.session
    session.set_stage("raster", 0)
    position = session.stage_trace.steps.position_after(5)
    session.go_to(position)
    window.run_action("ask_step")
    page = exercises(window)
    assert page.question.mark == "ask/shared-edge/64x48/fill=bounding-box/raster/step=5 1, seed 0"
    assert session.is_predicting
    window.run_action("page_step")
    assert window.page.pointed_text((3, 3)) == ""
    window.run_action("page_exercises")
    page.questions.answer(page.question.draft.answer.reference)
    page.questions.check()
    page.settle()
    assert page.question_view.verdict.text().startswith("1 of 1 point")
    assert not session.is_predicting
    window.run_action("page_step")
    session.set_stage("raster", position)
    window.run_action("ask_step")
    page.settle()
    assert session.is_predicting, "it is asked afresh"
    assert not page.question_view.verdict.isVisible()


def test_ending_prediction_gives_the_question_up(window: MainWindow) -> None:
    page = asked_value(window)
    assert page.questions.is_asked
    window.run_action("page_step")
    window.run_action("predict")
    assert not page.questions.is_asked


def end_by_reveal(window: MainWindow) -> None:
    window.page.column.prediction.reveal_requested.emit()


def end_by_clicks(window: MainWindow) -> None:
    window.page.grid.pixel_clicked.emit(24, 20)


def end_by_steps(window: MainWindow) -> None:
    window.session.step(1, Level.PIXEL)


@pytest.mark.parametrize("look", every_nth([end_by_reveal, end_by_clicks, end_by_steps], 3))
def test_what_is_seen_while_predicting_earns_nothing(
    window: MainWindow, look: Callable[[MainWindow], None]
) -> None:
    """The step goes back to before what is asked; whoever goes on from there, or reveals it, has seen it."""
    session, before = window.session, attempt_file().attempts()
    page = asked_value(window)
    assert (session.cursor.stage, session.cursor.position) == ("raster", 0)
    assert page.questions.is_asked
    assert session.is_predicting
    window.run_action("page_step")
    look(window)
    assert not page.questions.is_asked
    assert window.statusBar().currentMessage().startswith("The Step page shows what was asked for.")
    window.run_action("page_exercises")
    page.questions.answer(page.question.draft.answer.reference)
    page.questions.check()
    page.settle()
    assert attempt_file().attempts() == before


def test_earlier_stages_may_be_predicted(window: MainWindow) -> None:
    page = asked_value(window)
    window.run_action("page_step")
    window.session.set_stage("edges", 0)
    end_by_reveal(window)
    end_by_steps(window)
    assert page.questions.is_asked


def test_no_other_page_shows_what_is_asked(window: MainWindow) -> None:
    """Pages that would show the open scene are covered, and hand out nothing, until the question has ended."""
    window.run_action("page_compare")
    compare = window.pages.current
    window.run_action("page_step")
    page = asked_value(window)
    window.run_action("page_compare")
    assert compare.isHidden()
    QApplication.clipboard().setText("nothing")
    window.run_action("copy_view")
    assert QApplication.clipboard().text() == "nothing"
    assert window.statusBar().currentMessage() == COVERED["exercise"]
    window.run_action("page_exercises")
    page.questions.show_model()
    page.questions.show_model()
    window.run_action("page_compare")
    assert not compare.isHidden()


def test_what_has_no_line_is_refused(window: MainWindow) -> None:
    window.session.set_stage("raster", 0)
    window.run_action("ask_step")
    assert window.statusBar().currentMessage() == "Take a step first: the step just done is asked about."
    assert window.pages.current_name == "step"


def test_a_name_gives_the_same_question_everywhere_and_a_seed_another() -> None:
    name = "ask/shared-edge~0.1=9.25,4.5/64x48/fill=bounding-box/raster/step=5"
    template = screen_template(name)
    first, again, other = (ask(template, seed) for seed in (0, 0, 3))
    assert first.draft.text == again.draft.text
    assert first.draft.given == again.draft.given != other.draft.given
    assert "(9.25, 4.5)" in first.draft.given
    assert judge(first, first.draft.answer.reference).verdict.score == 1
    assert screen_of(name).name == name
    scene = first.draft.scene
    assert scene is not None
    assert scene_name(scene, "Two triangles sharing an edge") == "shared-edge~0.1=9.25,4.5"


@pytest.mark.parametrize(
    "name",
    [
        "ask/",
        "ask/nothing/16x12/-/raster/step=1",
        "ask/shared-edge/999x1/-/raster/step=1",
        "ask/shared-edge/16x12/fill=no/raster/step=1",
        "ask/shared-edge/16x12/-/raster/step=x",
        "ask/shared-edge~9.9=1,2/16x12/-/raster/step=1",
        "ask/cube~0.1=1,2/16x12/-/raster/step=1",
        "ask/shared-edge/16x12/-/raster/step=" + "1" * 300,
    ],
)
def test_a_wrong_name_is_one_sentence(name: str) -> None:
    with pytest.raises(ValueError, match=r"expected|must be"):
        screen_template(name)


def test_a_scene_from_a_file_has_no_name() -> None:
    with pytest.raises(ValueError, match="built-in scene"):
        scene_name(make_scene("cube"), "bunny")


def test_a_value_is_asked_with_its_channels() -> None:
    screen = Screen("shared-edge", (64, 48), {}, "blend", buffer="color", pixel=(30, 20), rows_done=10**6)
    draft = ask(screen_template(screen.name), 0).draft
    assert draft.answer.names[:3] == ("red", "green", "blue")
    assert Settings() == draft.settings
    assert screen_of(Screen("cube", (8, 6), {}, "interpolate", buffer="1/w").name).buffer == "1/w"


def test_a_long_line_of_a_question_wraps_in_a_narrow_column(qtbot: QtBot) -> None:
    view = QuestionView(MarkGrid())
    qtbot.addWidget(view)
    widths = []
    for line in ("ask/shared-edge", "ask/shared-edge/64x48/fill=bounding-box/raster/bounding-box/3501"):
        view.mark.setText(line)
        widths.append(view.scroll_area.widget().minimumSizeHint().width())
    assert widths[1] <= 2 * widths[0]
