"""Keys are changed and turned off; what is taken is refused; menus and the page of keys show what holds."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest

from app.session.document import open_document
from app.window.actions import ACTIONS
from app.window.keys import KeyChoices, choices_from, is_character
from app.window.main_window import MainWindow
from lessons.scenes import built_in_scene

BY_NAME = {action.name: action for action in ACTIONS}


def shown_keys(window: MainWindow, title: str) -> str:
    """Return the keys of an action on the page of keys."""
    entries = window.overlays.key_help.shown_entries()
    return next((entry.keys for entry in entries if entry.what == title), "")


def test_a_key_that_is_taken_is_refused_with_a_sentence() -> None:
    """On another page, or after the other action was changed, the key is free."""
    with pytest.raises(ValueError, match="“Next step at the pinned pixel”"):
        KeyChoices().with_keys(BY_NAME["next_event"], ("J",), ACTIONS)
    freed = KeyChoices().with_keys(BY_NAME["next_at_pin"], ("Ctrl+Alt+Y",), ACTIONS)
    assert freed.with_keys(BY_NAME["next_event"], ("J",), ACTIONS).keys_of(BY_NAME["next_event"]) == ("J",)
    assert KeyChoices().with_keys(BY_NAME["next_error"], ("J",), ACTIONS).changed == {"next_error": ("J",)}
    assert KeyChoices().with_keys(BY_NAME["next_error"], BY_NAME["next_error"].keys, ACTIONS) == KeyChoices()


def test_no_first_key_is_taken_twice() -> None:
    """Every action can have its own keys again."""
    for action in ACTIONS:
        assert KeyChoices().with_keys(action, action.keys, ACTIONS) == KeyChoices()


def test_characters_can_be_turned_off() -> None:
    """Then no action has a letter, digit or sign alone, with or without Shift; other keys stay."""
    quiet = KeyChoices(has_characters=False).table(ACTIONS)
    keys = [key for action in quiet for key in action.keys]
    assert not any(map(is_character, keys))
    assert {"Right", "Space", "Ctrl+Z", "F9"} <= set(keys)


def test_what_was_saved_may_be_of_another_version() -> None:
    """Unknown actions, keys that are none and keys that are taken are left out."""
    saved = {"no_such": ["Q"], "next_event": ["J"], "faster": ["", "Ctrl+Alt+F"]}
    assert choices_from(saved, True, ACTIONS) == KeyChoices({"faster": ("Ctrl+Alt+F",)})
    swapped = {"next_event": ("J",), "next_at_pin": ("N",)}
    assert choices_from(swapped, False, ACTIONS) == KeyChoices(swapped, has_characters=False)


def test_a_changed_key_works_is_shown_and_remembered(window: MainWindow) -> None:
    """By the page of keys: choose the action, press the key, use it."""
    desk, editor = window.overlays.keys, window.overlays.keys.editor
    window.overlays.key_help.change_button.click()
    place = [action.name for action in ACTIONS].index("fit_view")
    editor.table.setCurrentItem(editor.table.topLevelItem(place))
    editor.field.setKeySequence(QKeySequence("J"))
    editor.use_button.click()
    assert "Change that key first" in editor.note.text()
    QTest.keyClick(
        editor.field, Qt.Key.Key_Y, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier
    )
    editor.use_button.click()
    assert desk.choices.changed == {"fit_view": ("Ctrl+Alt+Y",)}
    assert shown_keys(window, "Show all stepped pixels") == "Ctrl+Alt+Y"
    assert window.menus.actions_by_name["fit_view"].shortcut() == QKeySequence("Ctrl+Alt+Y")
    window.overlays.close_top()
    window.page.grid.zoom_by(2.0)
    before = window.page.grid.view()
    window.page.grid.setFocus()
    QTest.keyClick(window.page.grid, Qt.Key.Key_W)
    assert window.page.grid.view() == before
    QTest.keySequence(window, QKeySequence("Ctrl+Alt+Y"))
    assert window.page.grid.view() != before
    editor.characters_wanted.emit(False)
    position = window.session.cursor.stage
    QTest.keyClick(window.page.grid, Qt.Key.Key_3)
    assert window.session.cursor.stage == position
    document = open_document(built_in_scene("single-triangle").make(), "")
    later = MainWindow(document, window.memory.preferences)
    assert later.menus.actions_by_name["fit_view"].shortcut() == QKeySequence("Ctrl+Alt+Y")
    assert later.menus.actions_by_name["stage_2"].shortcuts() == []
    later.close()
    later.deleteLater()
