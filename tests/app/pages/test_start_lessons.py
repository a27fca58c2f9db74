"""The Start page lists the lessons first, says where to begin or to go on, and opens one at the right step."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file, own_lesson_folder
from app.pages.lessons.lesson_list import EXPLORATIONS, OTHERS
from app.pages.start_page import StartPage
from app.window.main_window import MainWindow
from lessons.attempts.record import lesson_attempt
from lessons.course.catalogue import Course, Exploration, Lesson, read_lesson
from tests.lessons.course.lesson_texts import GOOD

pytestmark = pytest.mark.shared_window
NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)


@pytest.fixture
def lessons(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Lesson]:
    """Two lessons of a lecturer, and no others."""
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "data"))
    monkeypatch.setattr("lessons.course.catalogue.shipped", lambda: Course({}))
    own_lesson_folder().mkdir(parents=True)
    texts = {"one": GOOD, "two": GOOD.replace("Whose pixel?", "Whose row?").replace("raster", "resolve", 1)}
    for name, text in texts.items():
        (own_lesson_folder() / f"{name}.toml").write_text(text)
    return [read_lesson(own_lesson_folder() / f"{name}.toml") for name in texts]


@pytest.fixture
def page(window: MainWindow, lessons: list[Lesson], qtbot: QtBot) -> StartPage:
    return shown(window, qtbot)


def shown(window: MainWindow, qtbot: QtBot) -> StartPage:
    window.pages.show_page("step")
    window.pages.show_page("start")
    page = window.pages.current
    qtbot.waitUntil(lambda: not page.is_drawing)
    return page


def test_who_is_new_is_told_where_to_begin_above_the_scenes(page: StartPage, qtbot: QtBot) -> None:
    said = page.lesson_list.lead.text()
    assert said.startswith("You are new here?")
    assert said.endswith("Begin with “Whose pixel?”.")
    (part,) = page.lesson_list.parts
    assert (part.button.text(), part.is_open) == (f"{OTHERS}: 2 lessons, 10 minutes", True)
    card = part.cards[0]
    assert (card.accessibleName(), card.toolTip()) == ("Whose pixel?", "5 minutes, 0 of 4 steps done")
    assert card.accessibleDescription() == (
        "Who draws the pixels of a diagonal? 5 minutes, 0 of 4 steps done. Go on here."
    )
    scene = page.cards.cards[0]
    assert card.mapTo(page, card.rect().bottomLeft()).y() < scene.mapTo(page, scene.rect().topLeft()).y()
    for is_new in (False, True):
        page.lesson_button.setHidden(is_new)
        page.begin_button.setFocus()
        page.lessons.place_changed.emit()
        assert page.focusWidget() is (page.lesson_button if is_new else page.begin_button)
    with qtbot.waitSignal(page.lesson_requested) as asked:
        QTest.keyClick(page.lesson_button, Qt.Key.Key_Return)
    assert (page.lesson_button.text(), asked.args) == ("Begin: Whose pixel?", ["one", 0])
    with qtbot.waitSignal(page.lesson_requested) as asked:
        QTest.keyClick(part.cards[1], Qt.Key.Key_Return)
    assert asked.args == ["two", 0]


def test_who_comes_back_goes_on_where_he_stopped(
    window: MainWindow, page: StartPage, lessons: list[Lesson], qtbot: QtBot
) -> None:
    one, _ = lessons
    for step, (button, lead) in enumerate(
        [
            ("Go on: Whose pixel?", "You stopped in “Whose pixel?”: step 3 is next."),
            ("Go on: Whose pixel?", "You stopped in “Whose pixel?”: step 4 is next."),
            ("Begin: Whose row?", "After “Whose pixel?” comes “Whose row?”."),
        ],
        1,
    ):
        attempt_file().add(lesson_attempt("me", one, step, NOW + timedelta(minutes=step), score=1))
        shown(window, qtbot)
        assert (page.lesson_button.text(), page.lesson_list.lead.text()) == (button, lead)
        assert page.lesson_list.cards[0].entry.progress == f"5 minutes, {step + 1} of 4 steps done"
    assert page.lesson_list.parts[0].button.text() == f"{OTHERS}: 2 lessons, 10 minutes, 1 done"


def test_the_lesson_that_comes_next_is_read_while_one_looks_at_the_list(
    page: StartPage, qtbot: QtBot
) -> None:
    with qtbot.waitSignal(page.lessons.preparing.succeeded) as read:
        page.lessons.rest.start(0)
    assert read.args[0].lesson.name == "one"


def test_the_lessons_are_listed_by_stage_too_and_fold_away(page: StartPage) -> None:
    page.lesson_list.order_button.click()
    parts = page.lesson_list.parts
    assert [[card.entry.name for card in part.cards] for part in parts] == [["one"], ["two"]]
    assert [part.is_open for part in parts] == [True, False]
    for part in parts:
        part.button.click()
    assert [part.is_open for part in parts] == [False, True]
    page.lesson_list.order_button.click()
    assert [part.part.title for part in page.lesson_list.parts] == [OTHERS]


def test_single_steps_open_where_they_surprise(
    window: MainWindow, page: StartPage, lessons: list[Lesson], monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    tried = (Exploration("Whose is it?", "two", 2),)
    monkeypatch.setattr("lessons.course.catalogue.explorations", lambda: tried)
    shown(window, qtbot)
    part = page.lesson_list.parts[-1]
    assert (part.button.text(), part.is_open) == (f"{EXPLORATIONS}: 1 surprise", False)
    assert part.cards[0].accessibleDescription() == "From “Whose row?”. 2 minutes."
    with qtbot.waitSignal(page.lesson_requested) as asked:
        part.cards[0].click()
    assert asked.args == ["two", 2]


def test_a_broken_lesson_is_named_and_the_others_are_listed(
    window: MainWindow, page: StartPage, qtbot: QtBot
) -> None:
    (own_lesson_folder() / "three.toml").write_text(GOOD.replace("minutes = 5", "minutes = 0"))
    shown(window, qtbot)
    assert "three.toml: line 4: minutes: expected" in window.messages.text.text()
    assert [card.entry.name for card in page.lesson_list.cards] == ["one", "two"]


def test_a_card_opens_its_lesson_on_the_step_page(window: MainWindow, page: StartPage, qtbot: QtBot) -> None:
    page.lesson_list.cards[0].click()
    qtbot.waitUntil(lambda: window.page.lessons.is_open and not window.page.lessons.is_working)
    assert window.pages.current_name == "step"
    lesson, step = window.page.lessons.last
    assert (lesson.name, step) == ("one", 0)
