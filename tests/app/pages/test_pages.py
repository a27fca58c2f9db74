"""The pages of the window: one bar, keys of the page that is shown, and what comes back."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

import app.pages
from app.files.preferences import Preferences
from app.pages.page_bar import StepRequest
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import Settings
from core.study.record import Opening
from lessons.scenes import built_in_scene, make_scene

pytestmark = pytest.mark.shared_window


@pytest.mark.slow
@pytest.mark.own_window
def test_a_click_in_the_bar_shows_a_page_that_is_made_only_then(window: MainWindow) -> None:
    assert [type(page).__name__ for page in window.pages.made] == ["StepPage"]
    bar = window.pages.bar
    QTest.mouseClick(
        bar, Qt.MouseButton.LeftButton, pos=bar.tabRect(window.pages.names.index("compare")).center()
    )
    assert window.pages.current_name == "compare"
    assert len(window.pages.made) == 2
    assert not window.page.isVisible()
    QTest.mouseClick(
        bar, Qt.MouseButton.LeftButton, pos=bar.tabRect(window.pages.names.index("step")).center()
    )
    assert window.page.isVisible()


def test_keys_of_the_step_page_do_nothing_on_another(window: MainWindow) -> None:
    QTest.keyClick(window, Qt.Key.Key_2, Qt.KeyboardModifier.AltModifier)
    assert window.pages.current_name == "compare"
    before = window.session.cursor, window.session.document
    for key in (
        Qt.Key.Key_Right,
        Qt.Key.Key_Home,
        Qt.Key.Key_3,
        Qt.Key.Key_F,
        Qt.Key.Key_Space,
        Qt.Key.Key_B,
    ):
        QTest.keyClick(window, key)
    assert (window.session.cursor, window.session.document) == before
    assert not window.page.timeline.is_playing()
    for name in ("step_forward", "fit_region", "stage_10", "predict"):
        assert not window.menus.actions_by_name[name].isEnabled()
    QTest.keyClick(window, Qt.Key.Key_1, Qt.KeyboardModifier.AltModifier)
    assert window.menus.actions_by_name["step_forward"].isEnabled()
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert window.session.cursor != before[0]


def test_menus_without_anything_for_the_page_are_off(window: MainWindow) -> None:
    window.pages.show_page("compare")
    off = [action.text() for action in window.menuBar().actions() if not action.isEnabled()]
    assert off == ["&Step", "&Stage", "&Lesson", "&Raster", "&Stability", "&Plan", "&Exercises"]


def test_the_chosen_page_stays_checked_when_it_is_chosen_again(window: MainWindow) -> None:
    for _ in range(2):
        window.menus.actions_by_name["page_compare"].trigger()
        checked = [name for name, action in window.menus.actions_by_name.items() if action.isChecked()]
        assert "page_compare" in checked
        assert "page_step" not in checked


@pytest.mark.slow
def test_undo_theme_and_presenter_work_on_every_page(window: MainWindow) -> None:
    window.session.set_setting("fill", "scanline")
    window.pages.show_page("compare")
    QTest.keyClick(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.settings.fill == "bounding-box"
    QTest.keyClick(window, Qt.Key.Key_T, Qt.KeyboardModifier.ControlModifier)
    assert window.memory.preferences.theme == "dark"


def test_playing_ends_when_the_page_is_left(window: MainWindow) -> None:
    window.session.go_to(0)
    window.page.stepping.toggle_play()
    window.pages.show_page("compare")
    assert not window.page.timeline.is_playing()


def test_a_page_that_is_gone_is_the_step_page(qtbot: QtBot) -> None:
    scene = built_in_scene("single-triangle")
    made = MainWindow(open_document(scene.make(), scene.title), Preferences(page="from a later version"))
    qtbot.addWidget(made)
    made.memory.restore(made)
    assert made.pages.current_name == "step"
    made.close()


def test_a_page_opens_a_run_on_the_step_page(window: MainWindow, qtbot: QtBot) -> None:
    window.pages.show_page("compare")
    before = window.session.document
    settings = Settings(fill="scanline")
    opening = Opening(make_scene("single-triangle"), settings, "raster", (20, 20))
    with qtbot.waitSignal(window.opening.opened, timeout=20000):
        window.pages.current.step_requested.emit(StepRequest(opening, "Scanline on one triangle"))
    assert window.pages.current_name == "step"
    assert window.session.document.settings == settings
    assert window.session.document.title == "Scanline on one triangle"
    assert window.session.pin == (20, 20)
    stage = window.session.stage_trace
    row = stage.steps.row_at(window.session.cursor.position)[0]
    assert stage.pixel[row].tolist() == [20, 20]
    window.session.undo()
    assert window.session.document is before


def test_two_settings_open_as_a_and_b(window: MainWindow, qtbot: QtBot) -> None:
    first, second = Settings(fill="scanline"), Settings(fill="scanline-lecture", blend="over")
    opening = Opening(make_scene("single-triangle"), first, "raster", (20, 20))
    with qtbot.waitSignal(window.opening.opened, timeout=20000):
        window.opening.open_request(StepRequest(opening, "Two", second))
    assert window.page.current_view() == "compare"
    assert window.page.comparing.other == second


def test_a_large_picture_is_stepped_around_the_pixel(window: MainWindow, qtbot: QtBot) -> None:
    for pixel in [(0, 0), (399, 299), (200, 150)]:
        scene = replace(make_scene("sphere"), size=(400, 300))
        opening = Opening(scene, Settings(), "depth", pixel)
        with qtbot.waitSignal(window.opening.opened, timeout=20000):
            window.opening.open_request(StepRequest(opening, "Sphere"))
        document = window.session.document
        assert document.raster.origin is not None
        assert window.session.pin == pixel
        assert document.triangle is not None


def test_what_cannot_be_stepped_is_told(window: MainWindow, qtbot: QtBot) -> None:
    before = window.session.document
    scene = make_scene("cube")
    flat = replace(scene, camera=replace(scene.camera, projection="orthographic"))
    window.opening.open_request(StepRequest(Opening(flat, Settings(depth="inverse-w"), "depth"), "Flat"))
    qtbot.waitUntil(lambda: window.messages.isVisible(), timeout=20000)
    assert "perspective" in window.messages.text.text()
    assert window.session.document is before


def test_the_history_of_a_pixel_that_is_opened_from_another_page_is_told(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.session.set_pin((3, 3))
    window.pages.show_page("compare")
    opening = Opening(make_scene("single-triangle"), Settings(), "raster", (20, 20))
    with qtbot.waitSignal(window.opening.opened, timeout=20000):
        window.opening.open_request(StepRequest(opening, "One triangle"))
    window.page.column.setCurrentWidget(window.page.history)
    assert window.page.history.place.text() == "Pixel column 20, row 20"
    assert "Triangle 0 is visible here" in window.page.history.verdict.text()


def test_b_goes_to_a_pixel_that_only_it_looks_at(window: MainWindow, qtbot: QtBot) -> None:
    first, second = Settings(polygon_mode="wireframe"), Settings()
    opening = Opening(make_scene("single-triangle"), first, "raster", (27, 20))
    with qtbot.waitSignal(window.opening.opened, timeout=20000):
        window.opening.open_request(StepRequest(opening, "Two", second))
    other = window.session.document.make_trace(second).stage("raster")
    shown = window.page.comparing.second
    assert shown.row == other.rows_at_pixel(27, 20)[0]


@pytest.mark.slow
@pytest.mark.own_window
def test_side_panes_grow_with_large_type_once_the_window_is_large(window: MainWindow, qtbot: QtBot) -> None:
    window.page.toggle_pane("scene")
    window.resize(1200, 700)
    qtbot.waitUntil(lambda: sum(window.page.columns.sizes()) < 1200)
    before = window.page.columns.sizes()
    window.appearance.set_theme("presenter")
    window.resize(1900, 1000)
    qtbot.waitUntil(lambda: sum(window.page.columns.sizes()) > 1800)
    left, middle, right = window.page.columns.sizes()
    assert left > 1.4 * before[0]
    assert right > 1.4 * before[2]
    assert middle > 0.33 * 1800
    window.appearance.set_theme("light")
    window.resize(1200, 700)
    qtbot.waitUntil(lambda: window.page.columns.sizes()[0] == pytest.approx(before[0], abs=12))


def test_presenters_speak_through_their_page() -> None:
    told = re.compile(r"^    (message_sent|refused|step_requested) = Signal", re.MULTILINE)
    (folder,) = app.pages.__path__
    files = [*Path(folder).rglob("*presenter.py"), *(Path(folder) / "exercises").glob("*.py")]
    assert len(files) > 10
    assert [file.name for file in files if told.search(file.read_text(encoding="utf-8"))] == []
