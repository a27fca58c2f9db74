"""The editor of a listing: a pause tells the text, Tab indents, Escape leaves, a wave marks the problem."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent, QTextCharFormat

from tests.widgets.showing import shown
from widgets.inspector.listing_editor import ListingEditor
from widgets.inspector.listing_pane import B, ListingPane, PaneHead

SOURCE = "def f(a):\n  if a > 0:\n    return a\n  return 0"


@pytest.fixture
def editor(qtbot) -> ListingEditor:
    made = shown(qtbot, ListingEditor(), 420, 240)
    made.begin(SOURCE, 2)
    return made


def test_what_is_typed_is_told_once_after_a_pause(qtbot, editor) -> None:
    told: list[str] = []
    editor.text_typed.connect(told.append)
    qtbot.keyClicks(editor, "  # and more")
    assert told == []
    qtbot.waitUntil(lambda: bool(told))
    assert told == [SOURCE.replace("0:", "0:  # and more")]


def test_a_text_that_the_program_sets_is_not_told(editor) -> None:
    editor.show_text(SOURCE.replace("a > 0", "a >= 0"))
    assert not editor.is_pausing
    editor.undo()
    assert editor.text == SOURCE


def test_what_follows_a_pause_is_undone_by_itself(qtbot, editor) -> None:
    for text in ("12", "34"):
        qtbot.keyClicks(editor, text)
        qtbot.waitUntil(lambda: not editor.is_pausing)
    editor.undo()
    assert editor.text.count("12") == 1
    editor.undo()
    assert editor.text == SOURCE


def test_tab_indents_and_enter_goes_on_at_the_same_depth(qtbot, editor) -> None:
    qtbot.keyClick(editor, Qt.Key.Key_Return)
    assert editor.textCursor().block().text() == "    "
    qtbot.keyClick(editor, Qt.Key.Key_Tab)
    assert editor.textCursor().block().text() == "      "
    qtbot.keyClick(editor, Qt.Key.Key_Backtab)
    assert editor.textCursor().block().text() == "    "
    assert editor.hasFocus()


def test_a_wave_stands_under_the_place_of_a_problem(editor) -> None:
    editor.show_problem((2, 6))
    waves = [
        mark.cursor.selectedText()
        for mark in editor.extraSelections()
        if mark.format.underlineStyle() == QTextCharFormat.UnderlineStyle.WaveUnderline
    ]
    assert waves == ["a"]
    editor.show_problem((2, 40))
    assert editor.extraSelections()[-1].cursor.selectedText() == ":"
    editor.show_problem(None)
    assert not editor.has_problem


def test_its_keys_are_no_shortcuts_of_the_window(editor) -> None:
    for key, text, is_own in (
        (Qt.Key.Key_D, "d", True),
        (Qt.Key.Key_Escape, "", True),
        (Qt.Key.Key_F2, "", False),
    ):
        event = QKeyEvent(QKeyEvent.Type.ShortcutOverride, key, Qt.KeyboardModifier.NoModifier, text)
        event.ignore()
        editor.event(event)
        assert event.isAccepted() == is_own, key


def test_the_pane_offers_what_can_be_done(qtbot) -> None:
    pane = shown(qtbot, ListingPane(), 420, 300)
    pane.show_head(PaneHead(is_shown=True))
    assert pane.edit_button.isVisible()
    assert not pane.sides.isVisible()
    pane.show_head(PaneHead(is_shown=True, refusal="It cannot be edited."))
    assert not pane.edit_button.isVisible()
    assert not pane.reset_button.isVisible()
    pane.show_head(PaneHead(is_shown=True, is_edited=True, note="1 line changed", resets="all changes"))
    assert pane.sides.isVisible()
    assert pane.reset_button.isVisible()
    assert pane.reset_button.toolTip() == "Take back all changes"
    asked: list[int] = []
    pane.side_chosen.connect(asked.append)
    qtbot.mouseClick(pane.sides, Qt.MouseButton.LeftButton, pos=pane.sides.tabRect(B).center())
    assert asked[-1] == B


def test_a_version_is_named_in_the_head_and_escape_leaves_the_name(qtbot) -> None:
    pane = shown(qtbot, ListingPane(), 420, 300)
    pane.show_head(PaneHead(is_shown=True, is_edited=True, resets="all changes", name="mine & yours"))
    assert pane.sides.tabText(B) == "B: mine && yours"
    given: list[str] = []
    pane.name_given.connect(given.append)
    pane.ask_name()
    assert pane.name_field.isVisible()
    assert pane.name_field.selectedText() == "mine & yours"
    qtbot.keyClicks(pane.name_field, " early ")
    qtbot.keyClick(pane.name_field, Qt.Key.Key_Return)
    assert given == ["early"]
    assert not pane.name_field.isVisible()
    pane.ask_name()
    qtbot.keyClick(pane.name_field, Qt.Key.Key_Escape)
    assert given == ["early"]
    assert not pane.name_field.isVisible()
    assert pane.note.isVisible()


def test_a_step_keeps_its_mark_while_lines_are_typed_above(qtbot) -> None:
    editor = shown(qtbot, ListingEditor(), 420, 300)
    source = "def f(x):\n  y = x\n  return y"
    editor.begin(source, 1)
    editor.show_step(2, source)
    assert editor.line == 2
    editor.show_text("def f(x):\n  z = 1\n  y = x\n  return y")
    assert editor.line == 3
    editor.show_text("def f(x):\n  y = x + 1\n  return y")
    assert editor.line == 2
    editor.show_text("def f(x):\n  return y")
    assert editor.line is None


def test_a_step_comes_into_sight_unless_something_is_typed(qtbot) -> None:
    editor = shown(qtbot, ListingEditor(), 420, 200)
    source = "\n".join(f"a{number} = {number}" for number in range(60))
    editor.begin(source, 1)

    def in_sight() -> list[int]:
        room = editor.viewport().height()
        return [line for line, box in editor.visible_lines() if box.bottom() <= room]

    editor.show_step(3, source)
    assert editor.verticalScrollBar().value() == 0
    for line in (40, 60, 20):
        editor.show_step(line, source)
        assert line in in_sight()
    at = editor.verticalScrollBar().value()
    editor.show_step(50, source + " ")
    qtbot.keyClicks(editor, "b")
    at = editor.verticalScrollBar().value()
    editor.show_step(55, source + " ")
    assert editor.verticalScrollBar().value() == at


def test_a_problem_is_told_without_its_colour(qtbot) -> None:
    pane = shown(qtbot, ListingPane(), 420, 300)
    pane.begin_editing(SOURCE, 1)
    pane.show_message("✕ line 1, column 3: a &lt; b", is_problem=True)
    assert pane.message.isVisible()
    assert pane.editor.accessibleDescription() == "✕ line 1, column 3: a < b"
    pane.show_message("")
    assert not pane.message.isVisible()
    assert pane.editor.accessibleDescription() == ""
