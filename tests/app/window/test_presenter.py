"""Presenting begins and ends: a clicker's keys, states and charts, and the way back to the desk."""

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.files.open_any import Opened, open_any
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import STAGES
from lessons.lectures.scenes import ALL_SCENES
from tests.covering import in_turns, is_everything
from widgets.basics.accessibility import KeyClaim
from widgets.basics.message_bar import Message, MessageKind
from widgets.basics.theme import current_theme

SIZES = [(1280, 720), (1920, 1080)]
CTRL_SHIFT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier


def press(
    window: MainWindow, key: Qt.Key, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
) -> None:
    """Press a key where the keyboard is, as a person or a clicker does."""
    QTest.keyClick(window.focusWidget() or window, key, modifiers)


def test_a_clicker_steps_starts_and_blacks_out_here_and_only_here(window: MainWindow) -> None:
    session, stepping = window.session, window.page.stepping
    before = session.cursor
    session.set_pin((20, 20))
    QTest.keyClick(window, Qt.Key.Key_B)
    assert stepping.breaks.pixels == {(20, 20)}
    QTest.keyClick(window, Qt.Key.Key_PageDown)
    assert session.cursor == before
    window.presenter.arrange()
    window.page.grid.setFocus()
    QTest.keyClick(window.page.grid, Qt.Key.Key_PageDown)
    assert session.cursor.position > before.position
    QTest.keyClick(window.page.grid, Qt.Key.Key_PageUp)
    assert session.cursor == before
    for key in (Qt.Key.Key_B, Qt.Key.Key_Period):
        QTest.keyClick(window, key)
        assert window.grab().toImage().pixelColor(640, 360) == Qt.GlobalColor.black
        QTest.keyClick(window, Qt.Key.Key_PageDown)
        assert window.grab().toImage().pixelColor(640, 5) != Qt.GlobalColor.black
        assert session.cursor == before
    assert stepping.breaks.pixels == {(20, 20)}
    QTest.keyClick(window, Qt.Key.Key_F5)
    assert (session.cursor.stage, session.cursor.position) == (STAGES[0], 0)
    window.overlays.ask_pixel()
    QTest.keyClicks(window.overlays.ask_bar.field, "b.")
    assert window.overlays.ask_bar.field.text() == "b."


@pytest.mark.parametrize("theme", [pytest.param("light", marks=pytest.mark.slow), "dark"])
def test_leaving_brings_the_window_back(window: MainWindow, qtbot: QtBot, theme: str) -> None:
    page = window.page
    window.appearance.set_theme(theme)
    page.show_panes(["methods", "inspector", "details", "run"])
    page.settle()

    def desk() -> tuple[object, ...]:
        bars = (window.menuBar(), window.pages.bar, page.side_tabs, page.card, page.main_area.view_bar)
        return (
            window.geometry(),
            window.windowState(),
            window.appearance.name,
            page.shown_panes(),
            [part.geometry() for part in (page.main_area, page.column, page.listing, page.column.variables)],
            [widget.isVisible() for widget in (*bars, page.place)],
        )

    window.presenter.toggle()  # once: a style that is new changes a height by a pixel or two
    window.presenter.toggle()
    for _ in range(5):
        page.settle()
    before = desk()
    keys = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(window, Qt.Key.Key_P, keys)
    assert window.isFullScreen()
    assert window.appearance.name == ("presenter" if theme == "light" else "presenter-dark")
    large = page.sentence.font().pixelSize()
    QTest.keyClick(window, Qt.Key.Key_T, Qt.KeyboardModifier.ControlModifier)
    assert window.appearance.name == ("presenter-dark" if theme == "light" else "presenter")
    assert page.sentence.font().pixelSize() == large
    QTest.keyClick(window, Qt.Key.Key_T)
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert not window.isFullScreen()
    qtbot.waitUntil(lambda: desk() == before)


def test_a_table_of_depths_has_large_numbers_or_stands_alone(window: MainWindow) -> None:
    scene = ALL_SCENES["jubair-z-buffer"]
    window.session.open(open_document(scene.make(), scene.title))
    window.session.set_stage("depth")
    assert window.page.main_area.beside.isVisible()
    window.resize(1280, 720)
    window.presenter.arrange()
    window.page.settle()
    assert not window.page.main_area.beside.isVisible()
    assert current_theme().small_px >= 0.9 * current_theme().text_px


@pytest.mark.slow
def test_a_state_of_the_desk_opens_clean_and_one_of_the_presenter_whole(window: MainWindow) -> None:
    page = window.page
    page.show_panes(["scene", "inspector", "details", "thumbnails", "navigator", "run"])
    desk, panes = window.files.state(), page.shown_panes()
    page.show_panes(["inspector"])
    window.presenter.arrange()
    presented = page.shown_panes()
    window.files.show_opened(Opened(desk.document, state=desk))
    assert page.shown_panes() == presented
    assert window.files.state().look.panes == panes
    window.presenter.leave()
    assert page.shown_panes() == panes


def test_a_click_and_escape_give_the_arrows_back_to_stepping(window: MainWindow) -> None:
    page, session = window.page, window.session
    page.show_view("scene")
    view = page.main_view()
    view.setFocus(Qt.FocusReason.TabFocusReason)
    before, orbit = session.cursor, view.orbit()
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert session.cursor == before
    assert view.orbit() != orbit
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, pos=QPoint(8, 8))
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert session.cursor != before
    page.listing.setFocus(Qt.FocusReason.TabFocusReason)
    view.setFocus(Qt.FocusReason.TabFocusReason)
    before = session.cursor
    QTest.keyClick(view, Qt.Key.Key_Escape)
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert session.cursor != before


def test_escape_ends_run_editor_message_orbiting_pin_and_presenting_in_this_order(window: MainWindow) -> None:
    page = window.page
    page.show_view("scene")
    window.presenter.arrange()
    window.session.set_pin((20, 20))
    page.main_view().clearFocus()  # The timeline, put away by presenting, gave it the keyboard but not the arrows.
    page.main_view().setFocus(Qt.FocusReason.TabFocusReason)
    claim = page.main_view().findChild(KeyClaim)
    window.messages.show_message(Message(MessageKind.WARNING, "A message that stays."))
    window.overlays.toggle_keys()
    window.run_action("toggle_play")
    there = {
        "run": page.timeline.is_playing,
        "editor": window.overlays.key_help.isVisible,
        "message": window.messages.isVisible,
        "orbiting": lambda: claim.is_kept,
        "pin": lambda: window.session.pin is not None,
        "presenting": lambda: window.presenter.is_presenting,
    }
    for number in range(len(there) + 1):
        assert [name for name, is_there in there.items() if is_there()] == list(there)[number:]
        window.run_action("unpin")


def test_at_the_desk_a_step_goes_on_to_the_next_stage(window: MainWindow) -> None:
    window.session.set_stage("cull")
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert window.session.cursor.stage == "clip"


def test_states_of_a_folder_follow_each_other(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    session, files = window.session, window.files
    press(window, Qt.Key.Key_PageDown, CTRL_SHIFT)
    assert "Open or save a state first" in window.statusBar().currentMessage()
    positions = {"lecture 2": 20, "lecture 10": 100, "Lecture 1": 10}
    for name, position in positions.items():
        session.go_to(position)
        files.save_to(str(tmp_path / f"{name}.rasterscope"))
    window.presenter.arrange()
    window.open_path(str(tmp_path / "Lecture 1.rasterscope"))
    qtbot.waitUntil(lambda: session.cursor.position == 10)
    for key, position in ((Qt.Key.Key_PageDown, 20), (Qt.Key.Key_PageDown, 100), (Qt.Key.Key_PageUp, 20)):
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


@pytest.mark.slow
@pytest.mark.parametrize("size", [SIZES[0], pytest.param(SIZES[1], marks=pytest.mark.slow)], ids=str)
def test_charts_have_half_of_the_screen_and_the_desk_comes_back(
    window: MainWindow, size: tuple[int, int]
) -> None:
    window.resize(*size)
    window.pages.show_page("compare")
    page = window.pages.current
    panes = (page.columns.left, page.controls, page.charts, page.pictures)
    window.presenter.arrange()  # once: a style that is new changes a width by a pixel or two
    window.presenter.leave()
    window.page.settle()
    before = [(pane.isVisible(), pane.width()) for pane in panes]
    window.presenter.arrange()
    window.pages.show_page("stability")  # made while presenting
    for name in ("stability", "compare"):
        window.pages.show_page(name)
        shown = window.pages.current
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


def test_arrows_step_wherever_the_keyboard_is_but_in_a_field(window: MainWindow) -> None:
    page, session = window.page, window.session
    page.show_view("scene")
    window.presenter.arrange()
    page.show_panes(["scene", "inspector", "run"])
    view = page.main_view()
    azimuth = view.orbit().azimuth
    for widget in (view, page.column.tabBar(), page.listing, page.timeline.bar):
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        before = session.cursor
        QTest.keyClick(widget, Qt.Key.Key_Right)
        assert session.cursor.position > before.position, widget
    assert view.orbit().azimuth == azimuth
    field = page.outline.field("corner/0/0/x").edit
    field.setFocus(Qt.FocusReason.TabFocusReason)
    before = session.cursor
    QTest.keyClick(field, Qt.Key.Key_Right)
    assert session.cursor == before


TABLES = [
    ("cube", "cull"),
    ("polygon-window", "raster"),
    ("polygon-holes", "raster"),
    ("connecting-edges", "clip"),
]


@in_turns(size=SIZES if is_everything() else SIZES[:1], table=TABLES if is_everything() else TABLES[::3])
def test_tables_are_seen_whole(window: MainWindow, size: tuple[int, int], table: tuple[str, str]) -> None:
    scene, stage = table
    page, session = window.page, window.session
    window.files.show_opened(open_any(scene))
    window.resize(*size)
    window.presenter.arrange()
    session.set_stage(stage)
    page.settle()
    view = page.main_area.companions[stage].widget
    for position in np.linspace(0, session.cursor.position, 6 if is_everything() else 2).astype(int).tolist():
        session.go_to(position)
        page.settle()
        assert view.isVisible()
        bars = view.cells.horizontalScrollBar(), view.cells.verticalScrollBar()
        assert [bar.maximum() for bar in bars] == [0, 0], view.table()
        assert page.main_view().height() >= 0.38 * page.main_area.height()
    assert view.cells.font().pixelSize() >= 0.6 * page.sentence.font().pixelSize()
