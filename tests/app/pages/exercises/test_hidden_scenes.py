"""What is asked is hidden from the start of the program on, also where its scene is edited, or is not the open one."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.files.state_files import save_state
from app.pages.exercises.page import EDITED, ExercisesPage
from app.pages.start_page import HIDDEN
from app.session.document import open_document
from app.window.kept_question import KeptQuestion
from app.window.main_window import MainWindow
from lessons.exercises.catalogue import TEMPLATES
from lessons.scenes import built_in_scene

pytestmark = pytest.mark.shared_window
EXERCISE = """version = 1
title = "Mine"
stage = "raster"
question = "Which?"
scene = {size = [8, 6], triangles = [[[1, 1], [7, 1], [4, 5]]]}
answer = {type = "pixels"}
"""


def exercises(window: MainWindow) -> ExercisesPage:
    page = window.pages.page("exercises")
    page.settle()
    return page


def ask_value(window: MainWindow, column: int) -> ExercisesPage:
    window.session.set_stage("raster", 4000)
    window.session.set_pin((column, 20))
    window.run_action("ask_value")
    return exercises(window)


def restarted(window: MainWindow, qtbot: QtBot, name: str) -> MainWindow:
    """Return another window with a scene, as the program begins with it."""
    exercises(window).unfinished.finish()
    scene = built_in_scene(name)
    second = MainWindow(open_document(scene.make(), scene.title))
    qtbot.addWidget(second)
    KeptQuestion(second.session, second.pages, second)
    return second


def test_the_next_start_hides_what_is_asked(window: MainWindow, qtbot: QtBot) -> None:
    """At once where its scene is open, else on its card, and as soon as it is opened."""
    page = ask_value(window, 29)
    second = restarted(window, qtbot, "single-triangle")
    second.run_action("page_start")
    start = second.pages.current
    assert not second.pages.is_made("exercises")
    start._show_picture(("shared-edge", page.questions.asked_scene, np.zeros((48, 64, 4), np.uint8)))
    (card,) = [card for card in start.cards.cards if card.entry.name == "shared-edge"]
    assert card.accessibleDescription().endswith(HIDDEN)
    second.open_path("shared-edge")
    qtbot.waitUntil(lambda: second.session.is_asked_about)
    assert second.session.is_predicting
    cursor = second.session.cursor
    assert (cursor.stage, cursor.position) == ("raster", 0), "not at the pixel that its card promises"
    asked = second.pages.page("exercises")
    asked.settle()
    asked.questions.answer(page.question.draft.answer.reference)
    asked.questions.check()
    asked.settle()
    assert not second.session.is_predicting
    assert card.accessibleDescription() == card.entry.description
    asked.unfinished.finish()
    third = restarted(second, qtbot, "shared-edge")
    assert not third.session.is_predicting, "what was checked is asked no more"
    for each in (second, third):
        each.close()


def test_a_scene_stays_hidden_while_it_is_edited(window: MainWindow, qtbot: QtBot) -> None:
    page = ask_value(window, 30)
    document = window.session.document
    clip = document.scene.clip.copy()
    clip[0, 1, 0] += 1e-3
    window.session.edit(replace(document, scene=replace(document.scene, clip=clip)))
    assert window.session.is_predicting
    assert page.questions.is_asked
    assert window.statusBar().currentMessage() == EDITED
    window.run_action("page_step")
    assert window.page.pointed_text((30, 20)) == ""
    page.unfinished.finish()
    second = MainWindow(window.session.document)
    qtbot.addWidget(second)
    KeptQuestion(second.session, second.pages, second)
    assert second.session.is_predicting, "also after a new start"
    second.close()
    window.run_action("predict")
    assert not page.questions.is_asked
    assert not window.session.is_asked_about


def test_a_state_past_the_asked_step_opens_there_hidden(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    path = tmp_path / "later.rasterscope"
    window.session.set_stage("depth")
    save_state(path, window.files.state())
    page = ask_value(window, 33)
    asked, before = window.session.cursor, window.session.document
    window.open_path(str(path))
    qtbot.waitUntil(lambda: window.session.document is not before)
    assert page.questions.is_asked
    assert window.session.is_asked_about
    assert window.session.is_predicting
    assert window.session.cursor == asked
    window.session.set_stage("depth")
    assert not page.questions.is_asked, "stepping there shows it"


def test_another_scene_is_not_hidden(window: MainWindow, qtbot: QtBot) -> None:
    page = ask_value(window, 31)
    window.open_path("single-triangle")
    qtbot.waitUntil(lambda: window.session.document.triangle_count == 1)
    assert not window.session.is_asked_about
    assert page.questions.is_asked
    page.questions.give_up()


@pytest.mark.slow
def test_another_question_hides_its_own_scene(window: MainWindow) -> None:
    page = ask_value(window, 32)
    page.questions.open(TEMPLATES["triangle-coverage"], 7)
    page.settle()
    assert page.questions.is_asked
    assert not window.session.is_asked_about
    assert not window.session.is_predicting


def test_a_teachers_exercise_is_found_again(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    """Also where it was dropped on the window from a folder of no exercises."""
    path = tmp_path / "mine.toml"
    path.write_text(EXERCISE)
    window.open_path(str(path))
    page = exercises(window)
    page.questions.answer(frozenset({(4, 3)}))
    second = restarted(window, qtbot, "single-triangle")
    again = exercises(second)
    assert again.question.mark == page.question.mark
    assert again.grid.marked() == {(4, 3)}
    page.unfinished.finish()
    path.write_text(EXERCISE.replace("[4, 5]", "[5, 5]"))
    later = restarted(second, qtbot, "single-triangle")
    third = exercises(later)
    assert third.question.template.version != again.question.template.version
    assert third.grid.marked() == frozenset(), "the answer was to another question"
    for each in (second, later):
        each.close()
