"""Presenting: other scenes and states are opened without leaving it, and charts get at least half of the screen."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from app.pages.compare.page import ComparePage
from app.pages.experiment_page import ExperimentPage
from app.window.main_window import MainWindow
from core import STAGES

SIZES = [(1280, 720), (1920, 1080)]
CTRL_SHIFT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier


def present(window: MainWindow, size: tuple[int, int]) -> None:
    """Arrange a window of a size for presenting."""
    window.resize(*size)
    window.presenter.arrange()
    window.page.settle()


def press(
    window: MainWindow, key: Qt.Key, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
) -> None:
    """Press a key where the keyboard is, as a person or a clicker does."""
    QTest.keyClick(window.focusWidget() or window, key, modifiers)


def test_a_clicker_opens_another_scene(window: MainWindow, qtbot: QtBot) -> None:
    present(window, (1280, 720))
    chooser = window.overlays.scenes
    press(window, Qt.Key.Key_F5)
    assert window.session.cursor.stage == STAGES[0]
    assert not chooser.isVisible()
    press(window, Qt.Key.Key_F5)
    assert chooser.isVisible()
    first = chooser.current()
    press(window, Qt.Key.Key_PageDown)
    second = chooser.current()
    assert second not in ("", first)
    press(window, Qt.Key.Key_PageUp)
    assert chooser.current() == first
    press(window, Qt.Key.Key_PageDown)
    press(window, Qt.Key.Key_F5)
    assert not chooser.isVisible()
    qtbot.waitUntil(lambda: second in (window.files.shown, window.page.lessons.path))
    assert window.presenter.is_presenting
    assert window.pages.current_name == "step"


def test_typed_words_find_a_scene_from_any_page(window: MainWindow, qtbot: QtBot) -> None:
    present(window, (1280, 720))
    window.pages.show_page("compare")
    press(window, Qt.Key.Key_O, CTRL_SHIFT)
    field = window.overlays.scenes.field
    QTest.keyClicks(field, "bresenham jubair zzz")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.overlays.scenes.isVisible(), "nothing has these words, so nothing is chosen"
    field.clear()
    QTest.keyClicks(field, "polygon b. weiler")
    assert window.overlays.scenes.current() == ""
    field.clear()
    QTest.keyClicks(field, "weiler-ath")
    QTest.keyClick(field, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: window.files.shown == "weiler-atherton")
    assert window.pages.current_name == "step"
    assert window.presenter.is_presenting
    press(window, Qt.Key.Key_O, CTRL_SHIFT)
    press(window, Qt.Key.Key_Escape)
    assert not window.overlays.scenes.isVisible()
    assert window.presenter.is_presenting


def test_states_of_a_folder_follow_each_other(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    session, files = window.session, window.files
    press(window, Qt.Key.Key_PageDown, CTRL_SHIFT)
    assert "Open or save a state first" in window.statusBar().currentMessage()
    positions = {"lecture 2": 20, "lecture 10": 100, "Lecture 1": 10}
    for name, position in positions.items():
        session.go_to(position)
        files.save_to(str(tmp_path / f"{name}.rasterscope"))
    present(window, (1280, 720))
    window.open_path(str(tmp_path / "Lecture 1.rasterscope"))
    qtbot.waitUntil(lambda: session.cursor.position == 10)
    for key, position in (
        (Qt.Key.Key_PageDown, 20),
        (Qt.Key.Key_PageDown, 100),
        (Qt.Key.Key_PageUp, 20),
    ):
        press(window, key, CTRL_SHIFT)
        qtbot.waitUntil(lambda position=position: session.cursor.position == position)
    assert window.presenter.hint.text() == "State 2 of 3: lecture 2"
    assert window.presenter.is_presenting
    window.run_action("choose_scene")
    assert Path(window.overlays.scenes.current()).stem == "lecture 10"
    window.overlays.close_top()
    (tmp_path / "lecture 2.rasterscope").unlink()
    press(window, Qt.Key.Key_PageDown, CTRL_SHIFT)
    qtbot.waitUntil(lambda: session.cursor.position == 100)
    press(window, Qt.Key.Key_PageDown, CTRL_SHIFT)
    assert window.presenter.hint.text() == f"There is no next state in {tmp_path.name}."


def test_what_an_entry_is_about_finds_it_and_nothing_is_said(window: MainWindow) -> None:
    window.run_action("choose_scene")
    chooser = window.overlays.scenes
    QTest.keyClicks(chooser.field, "affine")
    assert chooser.current()
    QTest.keyClicks(chooser.field, "zzz")
    assert (chooser.current(), chooser.list.item(0).text()) == ("", "Nothing here is about “affinezzz”.")
    window.overlays.close_top()


def test_a_printed_listing_is_shown_without_the_menu(window: MainWindow, qtbot: QtBot) -> None:
    window.open_path("pellacini-line")
    qtbot.waitUntil(lambda: window.session.document.scene.corner_count == 2)
    present(window, (1280, 720))
    window.run_action("choose_scene")
    chooser = window.overlays.scenes
    QTest.keyClicks(chooser.field, "printed bresenham")
    QTest.keyClick(chooser.field, Qt.Key.Key_Return)
    assert window.page.current_view() == "compare"
    assert window.page.comparing.printed


def test_f5_measures_on_compare(window: MainWindow) -> None:
    window.pages.show_page("compare")
    present(window, (1280, 720))
    page = window.pages.current
    assert isinstance(page, ComparePage)
    press(window, Qt.Key.Key_F5)
    assert page.is_running
    page.cancel()
    assert window.pages.current is page


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_charts_have_half_of_the_screen_and_the_desk_comes_back(
    window: MainWindow, size: tuple[int, int]
) -> None:
    window.resize(*size)
    window.pages.show_page("compare")
    page = window.pages.current
    assert isinstance(page, ComparePage)
    panes = (page.columns.left, page.controls, page.charts, page.pictures)
    present(window, size)  # once: a style that is new changes a width by a pixel or two
    window.presenter.leave()
    window.page.settle()
    before = [(pane.isVisible(), pane.width()) for pane in panes]
    present(window, size)
    window.pages.show_page("stability")  # made while presenting
    for name in ("stability", "compare"):
        window.pages.show_page(name)
        shown = window.pages.current
        assert isinstance(shown, ExperimentPage)
        window.page.settle()
        view = shown.main_view()
        assert view.width() * view.height() >= 0.5 * size[0] * size[1], name
        assert shown.place.isVisible()
        assert shown.place.text()
    page.pictures.show()
    page.dismiss()
    assert not page.pictures.isVisible()
    window.presenter.leave()
    window.page.settle()
    assert [(pane.isVisible(), pane.width()) for pane in panes] == before


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_flow_grows_and_is_seen_whole(window: MainWindow, size: tuple[int, int]) -> None:
    window.page.show_view("flow")
    present(window, size)
    view = window.page.main_view()
    assert view.width() * view.height() >= 0.5 * size[0] * size[1]
    sizes = {label.font().pixelSize() for label in view.findChildren(QLabel) if not label.property("role")}
    assert len(sizes) == 1
    assert sizes.pop() >= 0.024 * size[1]
    assert view.verticalScrollBar().maximum() == view.horizontalScrollBar().maximum() == 0
