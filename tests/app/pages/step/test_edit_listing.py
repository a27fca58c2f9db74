"""Change the line: typed keys redraw B, the inspector steps through B's own lines, and nothing that fails is lost."""

from collections.abc import Callable
from dataclasses import replace
from inspect import getsource
from pathlib import Path
from threading import current_thread, main_thread
from time import monotonic, thread_time

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QMenu, QPushButton

from app.files.open_any import open_any
from app.files.state_files import EXTENSION, load_state, save_state
from app.pages.step.ab.shown_runs import titles
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import Settings
from core.edits.edit import Edit, original
from core.records.steps import Level
from core.trace.stage_trace import StageTrace
from lessons.scenes import make_scene
from tests.patience import PATIENCE
from widgets.inspector.listing_editor import ListingEditor
from widgets.inspector.listing_pane import A, B, ListingPane

pytestmark = pytest.mark.shared_window


def pane_of(window: MainWindow) -> ListingPane:
    return window.page.column.code


def wait(holds: Callable[[], object]) -> None:
    end = monotonic() + PATIENCE / 1000
    while not holds():
        assert monotonic() < end, f"this has not come: {getsource(holds).strip()}"
        QTest.qWait(10)


def wait_for_b(window: MainWindow) -> None:
    """Wait until what was typed has run and B is drawn, in the background where the machine is busy."""
    wait(lambda: window.session.document.edits and window.page.comparing.second is not None)


def bresenham(window: MainWindow) -> MainWindow:
    document = open_document(make_scene("segment"), "Segment", settings=Settings(line="bresenham"))
    window.session.open(document)
    window.session.set_level(Level.OPERATION)
    window.session.set_stage("raster", 8)
    return window


def edit(window: MainWindow, before: str) -> ListingEditor:
    """Open the editor by its key, behind some text."""
    window.run_action("edit_line")
    editor = pane_of(window).editor
    assert editor.isVisible()
    put_behind(editor, before)
    return editor


def put_behind(editor: ListingEditor, before: str) -> None:
    cursor = editor.textCursor()
    cursor.setPosition(editor.text.index(before) + len(before))
    editor.setTextCursor(cursor)


def second_raster(window: MainWindow) -> StageTrace:
    wait(lambda: window.page.comparing.second is not None)
    second = window.page.comparing.second
    return second.trace.stage("raster")


def test_typing_behind_if_d_redraws_b(window: MainWindow) -> None:
    bresenham(window)
    editor = edit(window, "if D >")
    assert window.page.current_view() == "compare"
    assert editor.textCursor().block().text() == "    if D >= 0:"
    # Until something is changed, B is the copy.
    assert "my version: Bresenham, integers" in window.page.compare_view.titles[1].text()
    assert second_raster(window).pixel.tolist() == window.session.trace.stage("raster").pixel.tolist()
    QTest.keyClick(editor, Qt.Key.Key_Delete)
    wait_for_b(window)
    (made,) = window.session.document.edits
    assert (made.part, made.of) == ("line", "bresenham")
    assert made.text == original("line", "bresenham").source.replace("D >= 0", "D > 0")
    right, mine = window.session.trace.stage("raster"), second_raster(window)
    assert mine.listings["bresenham"].source == made.text
    assert right.listings["bresenham"].source != made.text
    # A tie that no longer steps; a line of slope 2 / 5 has none, so its pixels stay.
    assert pane_of(window).note.text() == "1 line changed"
    assert pane_of(window).editor.changed_lines == {12}
    assert "my version: Bresenham, integers" in window.page.compare_view.titles[1].text()


def test_the_first_difference_is_one_click_away(window: MainWindow) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + 9")
    wait_for_b(window)
    said: list[str] = []
    window.page.message_sent.connect(said.append)
    pane_of(window).message.linkActivated.emit("first")
    wait(lambda: said)
    assert "is the first that differs" in said[-1]
    mine, other = window.session.moment.pixel, window.page.comparing.second
    assert mine != other.pixel


@pytest.mark.slow
def test_the_inspector_steps_through_the_lines_of_b(window: MainWindow) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + 9")
    wait_for_b(window)
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    pane, page = pane_of(window), window.page
    assert not pane.is_editing
    assert window.session.document.edits
    window.session.go_to(5)
    assert "Line 8: D = " in page.sentence.text()
    assert pane.listing.line == 8
    assert 8 in pane.listing.changed_lines
    page.editing.show_side(A)
    assert "Line 8" not in page.sentence.text()
    assert "+ 9" not in pane.listing.toPlainText()
    assert 8 in pane.listing.changed_lines
    page.editing.show_side(B)
    assert "+ 9" in pane.listing.toPlainText()


def test_a_text_that_fails_leaves_the_last_picture_greyed(window: MainWindow) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + 9")
    wait_for_b(window)
    edits = window.session.document.edits
    QTest.keyClicks(editor, "d")
    pane, view = pane_of(window), window.page.compare_view
    wait(lambda: editor.has_problem)
    assert pane.message.text().startswith("✕ line 8, column ")
    assert editor.accessibleDescription().startswith("✕ line 8")
    assert window.session.document.edits == edits
    assert view.grids[1].graphicsEffect() is not None
    assert "the last version that ran" in view.titles[1].text()
    assert "numbers are those of the last version that ran" in pane.message.text()
    QTest.keyClick(editor, Qt.Key.Key_Backspace)
    wait(lambda: not editor.has_problem)
    assert view.grids[1].graphicsEffect() is None
    # An endless loop is one of them.
    put_behind(editor, "range(dx + last_pixel):")
    cursor = editor.textCursor()
    cursor.select(QTextCursor.SelectionType.LineUnderCursor)
    editor.setTextCursor(cursor)
    QTest.keyClicks(editor, "  while True:")
    wait(lambda: editor.has_problem)
    assert "line 10" in pane.message.text()
    assert "does it ever end?" in pane.message.text()
    assert window.session.document.edits == edits
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    assert not pane.is_editing
    assert "is kept" in pane.message.text()
    window.run_action("edit_line")
    assert "while True:" in editor.text
    wait(lambda: editor.has_problem)


def test_marks_follow_what_is_typed_though_it_does_not_run(window: MainWindow) -> None:
    bresenham(window)
    window.session.go_to(5)
    editor = edit(window, "D = 2 * dy - dx")
    pane = pane_of(window)
    assert editor.line == 8
    QTest.keyClick(editor, Qt.Key.Key_Home)
    QTest.keyClicks(editor, "d =")
    QTest.keyClick(editor, Qt.Key.Key_Return)
    wait(lambda: editor.has_problem)
    assert window.session.document.edits == ()
    assert editor.line == 9
    assert 8 in editor.changed_lines
    assert pane.note.text() == "1 line changed"
    # It can be taken back, though it never ran.
    assert pane.reset_button.isVisible()
    pane.reset_button.click()
    assert editor.text == original("line", "bresenham").source
    assert not editor.has_problem
    assert not pane.reset_button.isVisible()
    # Taken back by hand there is no first difference, either.
    QTest.keyClicks(editor, "=")
    wait(lambda: editor.has_problem)
    QTest.keyClick(editor, Qt.Key.Key_Backspace)
    wait(lambda: not editor.has_problem)
    assert pane.message.text() == ""


def test_what_does_not_run_is_kept_in_a_state_and_in_other_scenes(window: MainWindow, tmp_path: Path) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + d")
    wait(lambda: editor.has_problem)
    typed, path = editor.text, tmp_path / f"mine{EXTENSION}"
    save_state(path, window.files.state())
    _, notes = load_state(path)
    assert len(notes) == 1
    assert notes[0].startswith(
        "A text that does not run is kept for the listing of Bresenham, integers: line 8"
    )
    window.session.open(open_any("single-triangle").document)
    assert [draft.text for draft in window.page.editing.drafts] == [typed]
    window.page.editing.show_drafts([])
    window.files.show_opened(open_any(str(path)))
    assert pane_of(window).note.text() == "Your text has not run"
    window.run_action("edit_line")
    assert editor.text == typed
    wait(lambda: editor.has_problem)
    pane_of(window).reset_button.click()
    assert window.page.editing.drafts == []


def test_an_edit_can_be_named_and_taken_back_from_everywhere(window: MainWindow, tmp_path: Path) -> None:
    bresenham(window)
    editor, pane = edit(window, "D = 2 * dy - dx"), pane_of(window)
    QTest.keyClicks(editor, " + 9")
    wait(lambda: window.session.document.edits)
    view = window.page.compare_view
    buttons = {button.text(): button for button in view.findChildren(QPushButton)}
    assert not buttons["Use B"].isEnabled()
    assert not buttons["Swap"].isEnabled()
    assert "A keeps the method itself" in buttons["Use B"].toolTip()
    pane.sides.tabBarDoubleClicked.emit(B)
    QTest.keyClicks(pane.name_field, "too early")
    QTest.keyClick(pane.name_field, Qt.Key.Key_Return)
    assert window.session.document.edits[0].name == "too early"
    assert pane.sides.tabText(B) == "B: too early"
    wait(lambda: "my version “too early”: Bresenham, integers" in view.titles[1].text())
    QTest.keyClicks(editor, "9")
    wait(lambda: "+ 99" in window.session.document.edits[0].text)
    assert window.session.document.edits[0].name == "too early"
    path = tmp_path / f"mine{EXTENSION}"
    save_state(path, window.files.state())
    _, notes = load_state(path)
    assert notes == ("This runs a listing that was edited, “too early”: listing of Bresenham, integers.",)
    window.files.show_opened(open_any(str(path)))
    assert window.session.document.edits[0].name == "too early"
    window.session.set_stage("transform", 1)
    wait(lambda: pane.note.text() == "Edited: listing of Bresenham, integers")
    assert pane.reset_button.isVisible()
    pane.reset_button.click()
    assert window.session.document.edits == ()
    assert not pane.reset_button.isVisible()
    window.page.show_view("compare")
    wait(buttons["Use B"].isEnabled)


def test_a_click_on_a_line_goes_to_a_step_that_runs_it(window: MainWindow) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + 9")
    wait(lambda: window.session.document.edits)
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    said: list[str] = []
    window.page.message_sent.connect(said.append)
    window.session.go_to(0)
    listing = pane_of(window).listing
    source = listing.toPlainText().splitlines()
    line = next(k for k, text in enumerate(source, 1) if text.strip().startswith("for "))
    second = window.page.comparing.second
    assert second is not None
    labelled = set(window.page.inspector.shown_listing.lines.values())
    assert line not in labelled
    listing.line_clicked.emit(line)
    assert said[-1] == f"Line {line} runs in this step."
    listing.line_clicked.emit(1)
    assert said[-1].startswith("No further step runs line 1")


def test_each_text_that_ran_is_one_entry_of_undo(window: MainWindow) -> None:
    bresenham(window)
    trace = window.session.trace
    editor = edit(window, "D = 2 * dy - dx")
    for typed in (" + 9", " - 9"):
        QTest.keyClicks(editor, typed)
        wait(lambda typed=typed: any(typed in made.text for made in window.session.document.edits))
    assert window.session.trace is trace
    window.session.undo()
    assert editor.text == window.session.document.edits[0].text
    assert editor.text.count("- 9") == 0
    window.session.undo()
    assert window.session.document.edits == ()
    assert pane_of(window).is_editing
    assert editor.text == original("line", "bresenham").source
    window.session.redo()
    assert len(window.session.document.edits) == 1
    assert window.session.trace is trace
    pane_of(window).reset_button.click()
    assert window.session.document.edits == ()
    window.session.undo()
    assert len(window.session.document.edits) == 1
    # The editor has an undo of its own, and B follows it.
    put_behind(editor, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " * 1")
    wait(lambda: "* 1" in window.session.document.edits[0].text)
    QTest.keyClick(editor, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    wait(lambda: "* 1" not in window.session.document.edits[0].text)


def test_a_long_run_leaves_the_window_free_and_escape_ends_it(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    # In the background the clock stands still, so that only the key ends the run, however busy the machine is.
    monkeypatch.setattr(
        "core.lanes.run.thread_time", lambda: thread_time() if current_thread() is main_thread() else 0.0
    )
    window.session.open(open_any("shared-edge").document)
    window.session.set_stage("interpolate", 40)
    editor = edit(window, "value =")
    loops = "".join(f"{'  ' * depth}for i{depth} in range(900):\n" for depth in (1, 2, 3))
    put_behind(editor, editor.text.splitlines()[0])
    editor.insertPlainText(f"\n{loops}        j = 0")
    editor.settle()
    QTest.qWait(1)
    assert window.page.comparing.is_drawing, f"it is not being run: {pane_of(window).message.text()!r}"
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    assert not window.page.comparing.is_drawing
    assert pane_of(window).is_editing
    assert pane_of(window).message.text().startswith("Stopped")
    # What was stopped is not lost either.
    typed = editor.text
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    assert not pane_of(window).is_editing
    assert [draft.text for draft in window.page.editing.drafts] == [typed]
    window.page.editing.show_drafts([])


@pytest.mark.slow
def test_an_edit_that_is_a_mistake_of_the_shelf_is_named(window: MainWindow) -> None:
    window.session.open(open_any("shared-edge").document)
    window.session.set_stage("raster", 4000)
    editor = edit(window, "value >")
    QTest.keyClicks(editor, "=")
    message = pane_of(window).message
    wait(lambda: "mistake" in message.text())
    assert "“all edges inclusive”" in message.text()
    assert 'href="lesson/shared-edges/' in message.text()
    assert 'href="exercise/' in message.text()
    # Most pixels that differ are covered by both, and drawn twice by one.
    assert window.page.compare_view.buffer_box.currentData() == "overdraw"


def test_one_that_draws_the_same_is_said_to(window: MainWindow) -> None:
    window.session.open(open_any("shared-edge").document)
    window.session.set_stage("raster", 4000)
    editor = edit(window, "value > 0")
    QTest.keyClicks(editor, ".0")
    wait(lambda: "same picture" in pane_of(window).message.text())


@pytest.mark.slow
def test_the_pixel_history_of_b_asks_the_edited_decision(window: MainWindow) -> None:
    window.session.open(open_any("shared-edge").document)
    window.session.set_stage("raster", 4000)
    editor = edit(window, "value >")
    QTest.keyClicks(editor, "=")
    wait_for_b(window)
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    window.session.set_pin((12, 6))
    column, page = window.page.column, window.page
    column.setCurrentWidget(column.history)
    told = []
    for side in (B, A):
        page.editing.show_side(side)
        column.setCurrentWidget(column.history)
        page.inspector.refresh_history(window.session.moment)
        told.append([label.text() for label in column.history.findChildren(QLabel)])
    assert any("Triangle 0 is visible here" in text for text in told[0])
    assert not any("is visible here" in text for text in told[1])
    column.setCurrentWidget(column.step)


def test_another_scene_keeps_the_edit_where_it_runs(window: MainWindow) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + 9")
    wait_for_b(window)
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    said: list[str] = []
    window.page.message_sent.connect(said.append)
    window.files.show_opened(open_any("single-triangle"))
    assert window.page.current_view() != "compare"
    assert "does not run on this scene" in said[-1]
    window.files.show_opened(open_any("segment"))
    assert window.page.current_view() == "compare"
    assert window.session.document.edits[0].of == "bresenham"
    wait_for_b(window)


def test_an_edit_that_does_not_fit_the_scene_sleeps(window: MainWindow) -> None:
    window.session.open(open_any("shared-edge").document)
    window.session.set_stage("raster", 4000)
    QTest.keyClicks(edit(window, "value >"), "=")
    wait_for_b(window)
    QTest.keyClick(pane_of(window).editor, Qt.Key.Key_Escape)
    window.files.show_opened(open_any("segment"))
    assert window.page.editing.side == A
    assert "D" in pane_of(window).listing.toPlainText()
    assert pane_of(window).message.text() == ""
    window.page.show_view("compare")
    comparing = window.page.comparing
    sides = titles(window.session.moment, comparing.second, comparing.b)
    assert "Bounding box" not in "".join(sides)
    assert "cannot be drawn" not in window.page.comparing.refusal
    assert pane_of(window).note.text().startswith("Edited: inside test")
    pane_of(window).reset_button.click()
    assert window.session.document.edits == ()
    window.session.undo()
    QTest.keyClicks(edit(window, "if D >= 0"), ".5")
    wait(lambda: len(window.session.document.edits) == 2)
    wait_for_b(window)


@pytest.mark.slow
def test_a_state_opens_with_the_edit_in_b(window: MainWindow, tmp_path: Path) -> None:
    bresenham(window)
    editor = edit(window, "D = 2 * dy - dx")
    QTest.keyClicks(editor, " + 9")
    wait_for_b(window)
    edits = window.session.document.edits
    path = tmp_path / f"mine{EXTENSION}"
    save_state(path, window.files.state())
    _, notes = load_state(path)
    assert notes == ("This runs a listing that was edited: listing of Bresenham, integers.",)
    window.session.open(open_any("single-triangle").document)
    assert window.session.document.edits == ()
    window.files.show_opened(open_any(str(path)))
    assert window.session.document.edits == edits
    assert window.session.document.settings.replacements == {}
    wait_for_b(window)


def test_no_listing_is_edited_while_predicting(window: MainWindow) -> None:
    bresenham(window)
    window.run_action("predict")
    said: list[str] = []
    window.page.message_sent.connect(said.append)
    window.run_action("edit_line")
    assert not pane_of(window).is_editing
    assert not pane_of(window).edit_button.isVisible()
    assert "no listing can be edited" in said[-1]
    window.run_action("predict")


def test_a_listing_that_cannot_be_edited_says_why_in_its_menu(window: MainWindow) -> None:
    window.session.open(open_any("shared-edge").document)
    window.session.set_stage("transform", 4)
    menu = QMenu()
    pane_of(window)._add_to_menu(menu, 1)
    entry = menu.actions()[-1]
    assert not entry.isEnabled()
    assert entry.text().startswith("This listing cannot be edited")
    window.session.set_stage("raster", 4)
    wait(pane_of(window).edit_button.isVisible)
    menu = QMenu()
    pane_of(window)._add_to_menu(menu, 5)
    assert menu.actions()[-1].text() == "Edit line 5"


def test_another_b_takes_the_place_of_the_edit_and_undo_brings_it_back(window: MainWindow) -> None:
    bresenham(window)
    edits = (Edit("line", "bresenham", original("line", "bresenham").source.replace(">= 0", "> 0")),)
    window.session.edit(replace(window.session.document, edits=edits))
    window.page.show_view("compare")
    comparing = window.page.comparing
    assert "line" in comparing.other.replacements
    comparing._choose("line", "dda")
    assert window.session.document.edits == ()
    assert comparing.other.line == "dda"
    window.session.undo()
    assert window.session.document.edits == edits
    assert "my version" in window.page.compare_view.titles[1].text()
