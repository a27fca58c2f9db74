"""The table of keys: complete, without a key twice, and what menus, tooltips and the page of keys are made from."""

import ast
import re
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel, QMenu, QPushButton, QRadioButton, QTabBar
from pytestqt.qtbot import QtBot

import bootstrap
from app.window.actions import ACTIONS, ACTIONS_BY_NAME
from app.window.keys import has_use_for, key_text
from app.window.main_window import MainWindow
from app.window.menus import MENUS
from app.window.presenter import CLICKER
from core import STAGES
from widgets.basics.theme import DARK, current_theme

pytestmark = pytest.mark.shared_window


def test_no_key_stands_twice() -> None:
    for page in ("step", "compare", "stability"):
        shown = [action for action in ACTIONS if action.page in ("", page)]
        keys = [QKeySequence(key).toString() for action in shown for key in action.keys]
        assert "" not in keys
        assert sorted(keys) == sorted(set(keys))


def test_names_are_unique_and_menus_exist() -> None:
    names = [action.name for action in ACTIONS]
    assert len(names) == len(set(names))
    assert {action.menu for action in ACTIONS} <= {*MENUS, ""}


def test_every_action_can_be_reached() -> None:
    assert [action.name for action in ACTIONS if not action.keys and not action.menu] == []


def test_every_stage_has_an_entry() -> None:
    names = [action.name for action in ACTIONS if action.name.startswith("stage_")]
    assert names == [f"stage_{k}" for k in range(len(STAGES))]


def test_keys_are_shown_as_they_are_called() -> None:
    texts = {action.name: key_text(action) for action in ACTIONS}
    assert texts["next_stage"] == "Ctrl+Page Down"
    assert texts["redo"] == "Ctrl+Shift+Z, Ctrl+Y"


def test_menus_are_made_from_the_table(window: MainWindow) -> None:
    titles = {title.rpartition("/")[2] for title in MENUS}
    menus = [menu for menu in window.menuBar().findChildren(QMenu) if menu.title().lstrip("&") in titles]
    assert max(len(menu.actions()) for menu in menus) <= 30, "one column of a window of 800 pixels"
    texts = [action.text() for menu in menus for action in menu.actions()]
    for action in ACTIONS:
        made = window.menus.actions_by_name[action.name]
        assert [key.toString() for key in made.shortcuts()] == [
            QKeySequence(key).toString() for key in action.keys
        ]
        if action.menu:
            assert action.title in texts
        if action.keys:
            assert key_text(action) in made.toolTip()


def test_menus_that_are_not_of_the_table(window: MainWindow) -> None:
    actions = {action.text(): action for menu in window.findChildren(QMenu) for action in menu.actions()}
    assert not actions["No files yet"].isEnabled()
    actions["16 × 12"].trigger()
    raster = window.session.document.raster
    assert (raster.columns, raster.rows) == (16, 12)
    assert window.statusBar().currentMessage() == "Raster: whole view at 16×12."
    actions["Dark"].trigger()
    assert current_theme() == DARK
    assert window.memory.preferences.theme == "dark"
    assert [action.text() for action in window.menus.theme_group.actions() if action.isChecked()] == ["Dark"]


def test_the_page_of_keys_shows_the_table(window: MainWindow) -> None:
    QTest.keyClicks(window, "?")
    assert window.overlays.key_help.isVisible()
    shown = " ".join(label.text() for label in window.overlays.key_help.findChildren(QLabel))
    for action in ACTIONS:
        if action.keys and action.page in ("", "step"):
            assert action.title in shown
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert not window.overlays.key_help.isVisible()
    window.notices.tell("said beside the pages")
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert window.statusBar().currentMessage() == ""


def test_what_controls_need_while_they_have_the_keyboard(qtbot: QtBot) -> None:
    def pressed(key: Qt.Key, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> QKeyEvent:
        return QKeyEvent(QKeyEvent.Type.ShortcutOverride, key, modifiers)

    button, radio, combo, tabs = QPushButton(), QRadioButton(), QComboBox(), QTabBar()
    for widget in (button, radio, combo, tabs):
        qtbot.addWidget(widget)
    assert has_use_for(button, pressed(Qt.Key.Key_Space))
    assert not has_use_for(button, pressed(Qt.Key.Key_Right))
    assert not has_use_for(button, pressed(Qt.Key.Key_Space, Qt.KeyboardModifier.ControlModifier))
    assert has_use_for(radio, pressed(Qt.Key.Key_Down))
    assert has_use_for(radio, pressed(Qt.Key.Key_Space))
    assert has_use_for(combo, pressed(Qt.Key.Key_Space))
    assert not has_use_for(combo, pressed(Qt.Key.Key_Down)), (
        "Down makes steps smaller, also after a look at a list"
    )
    assert has_use_for(tabs, pressed(Qt.Key.Key_Left))
    assert not has_use_for(None, pressed(Qt.Key.Key_Space))


def test_actions_that_are_named_in_the_program_exist() -> None:
    """By a page that asks for one, a button of the Start page, and a key of the clicker."""
    named = set()
    for file in sorted(Path(bootstrap.ROOT, "app").rglob("*.py")):
        source = file.read_text(encoding="utf-8")
        if not re.search("run_action|action_requested|_action_button", source):
            continue
        for node in ast.walk(ast.parse(source)):
            if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
                continue
            called = ast.unparse(node.func).rpartition(".")
            if called[2] == "run_action" or called[0].endswith("action_requested"):
                named |= {arg.value for arg in node.args if isinstance(arg, ast.Constant)}
            if called[2] == "_action_button" and isinstance(node.args[1], ast.Constant):
                named.add(node.args[1].value)
    assert len(named) >= 8
    assert (named | set(CLICKER.values())) - {"start", "black"} <= set(ACTIONS_BY_NAME)
