"""Every key of the table does something that can be seen."""

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtGui import QGuiApplication, QKeySequence
from PySide6.QtPrintSupport import QPrintPreviewDialog
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from app.files.file_dialogs import SaveDialog
from app.session.document import Document, open_document
from app.window.actions import ACTIONS
from app.window.main_window import MainWindow
from core import Settings
from core.records.steps import Level
from lessons.scenes import make_scene
from widgets.basics.theme import current_theme

pytestmark = pytest.mark.shared_window


def seen(window: MainWindow) -> tuple[object, ...]:
    """Return everything that an action may change, as a user could see it."""
    session, page = window.session, window.page
    document = session.document
    return (
        session.cursor,
        session.pin,
        document.raster,
        document.triangle,
        document.before,
        document.settings,
        getattr(document.scene, "shared", None) is None,
        page.timeline.is_playing(),
        page.timeline.speed_box.currentText(),
        page.current_view(),
        page.grid.view(),
        page.prediction.isVisible(),
        tuple(page.shown_panes()),
        frozenset(page.stepping.breaks.pixels),
        tuple(page.stepping.bookmarks.marks),
        window.overlays.ask_bar.isVisible(),
        window.overlays.key_help.isVisible(),
        window.help.is_visible(),
        window.isVisible(),
        window.isFullScreen(),
        current_theme().name,
        current_theme().text_px,
        QGuiApplication.clipboard().image().size().width(),
        window.statusBar().currentMessage(),
        window.pages.current_name,
        window.focusWidget(),
    )


def prepare(window: MainWindow, name: str) -> None:
    """Bring the window where the action has something to do."""
    session, page = window.session, window.page
    session.set_pin((20, 20))
    if name.startswith("bookmark_"):
        for k in range(10):
            session.go_to(40 * k + 4)
            page.stepping.bookmarks.toggle()
        session.go_to(4000)
    elif name in ("visited_back", "visited_forward"):
        session.set_stage("depth")
        if name == "visited_forward":
            session.go_back()
    elif name in ("undo", "redo"):
        session.set_setting("fill", "scanline")
        if name == "redo":
            session.undo()
    elif name == "fit_view":
        page.grid.zoom_by(3.0)
    elif name == "focus_all":
        window.edits.focus_triangle(1)
    elif name == "stage_5":
        session.set_stage("cull")
    elif name.startswith(("level_", "larger_")):
        session.set_level(Level.GROUP)
    elif name in ("run_forward", "run_back", "next_event"):
        session.go_to(400)
    elif name == "page_step":
        window.pages.show_page("compare")
    elif name == "text_smaller":
        window.appearance.set_text_size(110)
    elif name == "whole_picture":
        page.grid.zoom_by(3.0)
    elif name == "open_pass":
        shadowed = Settings(shadow="map", map_size=16)
        scene = replace(make_scene("box-in-light"), size=(32, 24))
        session.open(open_document(scene, "Box in the light", settings=shadowed))
    elif name == "copy_view":
        QGuiApplication.clipboard().clear()


def put_back(window: MainWindow, document: Document) -> None:
    """Bring the window back to where it was before any action, so that the next one can use it too."""
    window.pages.show_page("step")
    while window.overlays.close_top():
        pass
    window.presenter.leave()
    if window.page.prediction.isVisible():
        window.run_action("predict")
    if current_theme().name != "light":
        window.appearance.set_theme("light")
    window.page.show_view("pixels")
    window.page.stepping.set_places()
    if window.session.document is not document:
        window.session.open(document)
    window.session.set_level(Level.OPERATION)
    window.session.set_stage("raster", 4000)


STEPPED = [action for action in ACTIONS if action.keys and action.page in ("", "step")]


@pytest.mark.own_window
def test_every_key_does_something(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    state = tmp_path / "other.rasterscope"
    window.files.save_to(str(state))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *args: (str(state), ""))
    monkeypatch.setattr(SaveDialog, "ask", lambda dialog: str(tmp_path / "view.png"))
    monkeypatch.setattr(QPrintPreviewDialog, "exec", lambda dialog: 1)
    document, files, comparing = window.session.document, window.files, window.page.comparing
    idle = []
    # A new theme takes the longer the more pages there are, and without a window there is nothing more to try.
    window.resize(853, 533)  # Small is painted sooner.
    early = ["presenter", "toggle_theme", "text_larger", "text_smaller"]
    order = dict.fromkeys(early, -1) | {"quit": 1}
    for action in sorted(STEPPED, key=lambda action: order.get(action.name, 0)):
        put_back(window, document)
        prepare(window, action.name)
        window.statusBar().clearMessage()
        window.page.grid.setFocus()
        before = seen(window)
        QTest.keySequence(window, QKeySequence(action.keys[0]))
        qtbot.waitUntil(lambda: not (files.job.is_running or comparing.meeting.is_searching))
        idle += [action.name] if seen(window) == before else []
    assert idle == []


def test_the_stage_without_a_key_is_in_the_menu(window: MainWindow) -> None:
    window.menus.actions_by_name["stage_10"].trigger()
    assert window.session.cursor.stage == "resolve"


def test_menus_show_what_is_on_whatever_has_switched_it(window: MainWindow) -> None:
    actions, session = window.menus.actions_by_name, window.session
    for _ in range(2):
        window.edits.toggle_cleared()
        assert actions["toggle_cleared"].isChecked() == (session.document.before == "cleared")
        window.page.set_predicting(not session.is_predicting)
        assert actions["predict"].isChecked() == session.is_predicting
