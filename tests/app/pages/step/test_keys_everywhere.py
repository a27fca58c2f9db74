"""Keys do what the page of keys says wherever the focus is, and a key that can do nothing says why."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QLineEdit,
    QSplitterHandle,
    QTabBar,
    QTabWidget,
    QTreeWidget,
    QWidget,
)

from app.session.document import open_document
from app.window.main_window import MainWindow
from core import STAGES
from core.records.steps import Level
from lessons.scenes import make_scene
from widgets.inspector.listing import ListingView
from widgets.timeline.chapters import ChapterButton

pytestmark = pytest.mark.shared_window

SIDEWAYS = {Qt.Key.Key_Left, Qt.Key.Key_Right}
UP_DOWN = {Qt.Key.Key_Up, Qt.Key.Key_Down}
KEYS = (*SIDEWAYS, *UP_DOWN, Qt.Key.Key_Home, Qt.Key.Key_3, Qt.Key.Key_N)
OWN_USE: tuple[tuple[type[QWidget], set[Qt.Key]], ...] = (
    (QLineEdit, {*SIDEWAYS, Qt.Key.Key_Home, Qt.Key.Key_3, Qt.Key.Key_N}),
    (QTabBar, SIDEWAYS),
    (QTabWidget, SIDEWAYS),
    (ChapterButton, {*SIDEWAYS, Qt.Key.Key_Home}),
    (QTreeWidget, SIDEWAYS | UP_DOWN),
    (ListingView, UP_DOWN),
    (QAbstractButton, SIDEWAYS | UP_DOWN),
    (QSplitterHandle, SIDEWAYS | UP_DOWN),
)
"""What these controls do with keys, as the page of keys tells."""


@pytest.mark.parametrize("pane", ["scene", pytest.param("methods", marks=pytest.mark.slow)])
def test_a_key_steps_wherever_the_focus_is_unless_it_has_a_use_there(window: MainWindow, pane: str) -> None:
    session = window.session
    window.page.show_panes([pane, "inspector", "thumbnails"])
    QApplication.processEvents()
    swallowed: list[tuple[str, str, str]] = []
    walked: list[type[QWidget]] = []
    document = session.document
    for widget in window.page.findChildren(QWidget):
        is_stop = widget.focusPolicy() & Qt.FocusPolicy.TabFocus and widget.isVisible() and widget.isEnabled()
        if not is_stop or type(widget) in walked:
            continue
        walked.append(type(widget))
        own: set[Qt.Key] = set().union(*(keys for kind, keys in OWN_USE if isinstance(widget, kind)))
        for key in KEYS:
            if key not in own:
                session.set_stage("raster", 4000)
                session.set_level(Level.PIXEL)
                widget.setFocus(Qt.FocusReason.TabFocusReason)
                before = session.cursor
                QTest.keyClick(widget, key)
                if session.cursor == before:
                    swallowed.append((type(widget).__name__, widget.accessibleName(), key.name))
    assert swallowed == []
    assert len(set(walked)) >= 8
    assert session.document is document


def test_a_number_that_was_typed_gives_the_keys_back(window: MainWindow) -> None:
    session, field = window.session, window.page.timeline.position_box
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "400")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert session.cursor.position == 400
    QTest.keyClick(window.focusWidget() or window, Qt.Key.Key_Right)
    assert session.cursor.position > 400


def test_a_value_keeps_the_keys_till_escape(window: MainWindow) -> None:
    session, page = window.session, window.page
    session.open(open_document(make_scene("cube"), "Cube"))
    page.show_panes(["scene"])
    field = page.outline.field("camera/eye/x").edit
    QTest.mouseDClick(field, Qt.MouseButton.LeftButton)
    for text in ("3", "2"):
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        assert session.latest.scene.camera.eye[0] == float(text)
    assert window.focusWidget() is field
    window.run_action("unpin")
    assert window.focusWidget() in (page.main_view(), *page.main_view().findChildren(QWidget))


@pytest.mark.own_window
def test_a_command_that_can_do_nothing_says_why(window: MainWindow) -> None:
    reasons = {
        "undo": "no edit to undo",
        "redo": "no edit to redo",
        "step_forward": "picture is finished",
        "larger_forward": "picture is finished",
        "next_stage": "last stage",
        "visited_forward": "No jump",
        "level_in": "no smaller steps",
        "next_at_pin": "Pin a pixel first",
    }
    for action, reason in reasons.items():
        window.session.set_stage(STAGES[-1])
        window.session.set_level(Level.OPERATION)
        window.statusBar().clearMessage()
        window.menus.actions_by_name[action].trigger()
        assert reason in window.statusBar().currentMessage()


def test_menus_of_pages_that_are_not_shown_are_not_there(window: MainWindow) -> None:
    def menus() -> set[str]:
        return {action.text().strip("&") for action in window.menuBar().actions() if action.isVisible()}

    assert {"Step", "Stage", "Raster"} <= menus()
    assert not {"Compare", "Stability", "Plan"} & menus()
    window.run_action("page_compare")
    assert "Compare" in menus()
    assert not {"Step", "Stage", "Raster", "Stability"} & menus()
