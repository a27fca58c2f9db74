"""A listing repaired in the window, by keys alone: what runs, what cannot, and the input that shows a mistake."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.files.open_any import open_any
from app.files.user_folders import attempt_file
from app.pages.exercises.evidence import OPEN
from app.pages.step.page import StepPage
from app.window.main_window import MainWindow
from tests.app.pages.exercises.acting import Page, check
from widgets.exercises.answer_forms import CODE_NAME
from widgets.inspector.listing_pane import A

pytestmark = pytest.mark.shared_window
CONTROL = Qt.KeyboardModifier.ControlModifier


def test_a_listing_is_repaired_by_keys(page: Page, window: MainWindow, qtbot: QtBot) -> None:
    shown = page("repair-bresenham-lecture", 7)
    view, before = shown.question_view, len(attempt_file().attempts())
    answer, question = view.answer, shown.question
    right = question.draft.answer
    editor = answer.editor
    told = QAccessible.queryAccessibleInterface(editor)
    assert told.text(QAccessible.Text.Name) == CODE_NAME
    assert answer.given() == right.start

    # Nothing is changed: that is asked about first.
    QTest.mouseClick(view.check_button, Qt.MouseButton.LeftButton)
    assert view.note.text().startswith("Nothing is changed yet.")

    # What cannot run is marked, said and read out, and costs nothing.
    lines = right.start.split("\n")
    editor.begin(right.start, 2)
    QTest.keyClicks(editor, " +")
    QTest.keyClick(editor, Qt.Key.Key_Return, CONTROL)
    shown.settle()
    assert view.note.text().startswith("Not checked yet: line 2, column")
    qtbot.waitUntil(
        lambda: view.note.text().startswith("Line 2, column")
    )  # after the pause behind the last key
    assert editor.extraSelections()
    assert editor.accessibleDescription().startswith("Line 2, column")
    assert editor.changed_lines == {2}

    # An endless loop is told with its line.
    loop = right.reference.replace("x += sx", "x += 0")
    answer.show_given(loop)
    answer.answer_changed.emit()
    QTest.mouseClick(view.check_button, Qt.MouseButton.LeftButton)
    shown.settle()
    assert "the loop goes on after" in view.note.text()
    assert len(attempt_file().attempts()) == before

    # A wrong listing: its classes, the smallest input, and that in A | B.
    answer.show_given(right.reference.replace("if D > 0:", "if D >= 0:"))
    answer.answer_changed.emit()
    said = check(shown)
    assert "right in 10 of 11 classes of inputs" in said
    assert "From (7, 6) to (5, 5): yours (5, 5), (6, 6), (7, 6); right (5, 5), (6, 5), (7, 6)." in said
    assert "The line stepped where D = 0." in said
    assert len(attempt_file().attempts()) == before + 1

    # Undo takes it back; the right one, typed line by line, is right.
    window.run_action("undo")
    assert answer.given() == loop
    wrong = next(
        k
        for k, (one, other) in enumerate(zip(lines, right.reference.split("\n"), strict=True))
        if one != other
    )
    answer.reset_button.click()
    assert answer.given() == right.start
    editor.begin(right.start, wrong + 1)
    QTest.keyClick(editor, Qt.Key.Key_Home, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClicks(editor, right.reference.split("\n")[wrong])
    QTest.keyClick(editor, Qt.Key.Key_Return, CONTROL)
    shown.settle()
    assert view.verdict.text().startswith("3 of 3 points"), (answer.given(), view.note.text())
    assert not view.twin_button.isVisible()
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    assert window.focusWidget() is answer.reset_button

    # It is kept, and read again.
    typed = answer.given()
    page("shared-edge")
    shown.questions.open(question.template, None)
    shown.settle()
    assert view.answer.given() == typed


def test_the_smallest_input_is_opened_in_a_b_and_escape_ends_a_check(
    page: Page, window: MainWindow, qtbot: QtBot
) -> None:
    shown = page("write-inside-test", 0)
    view = shown.question_view
    right = shown.question.draft.answer
    answer = view.answer
    answer.show_given(right.named_mistakes["all-edges-inclusive"])
    answer.answer_changed.emit()
    view.check_requested.emit()
    shown.questions.stop_check()
    assert view.note.text() == "Not checked: you have stopped it."
    shown.settle()
    assert view.verdict.parentWidget().isHidden()
    places = [button.geometry() for button in (view.hint_button, view.model_button)]
    assert "Every centre on an edge was counted" in check(shown)
    assert view.twin_button.text() == OPEN
    # The new button stands behind the others: no click that is meant for it shows the model answer.
    assert view.twin_button.geometry() not in places
    assert [button.x() for button in (view.hint_button, view.model_button)] == [each.x() for each in places]
    view.twin_button.click()
    qtbot.waitUntil(lambda: isinstance(window.pages.current, StepPage))
    step = window.pages.current
    assert window.session.document.title == "Write the inside test"
    step.settle()
    document = window.session.document
    assert [edit.part for edit in document.edits] == ["fill"]
    # The right run stands beside it, in a buffer that differs; the right listing is still asked for.
    pane, compared = step.column.code, step.compare_view
    assert [part.isVisible() for part in (pane.sides, pane.reset_button, pane.listing)] == [
        False,
        False,
        True,
    ]
    pane.side_chosen.emit(A)
    window.run_action("undo")
    window.run_action("redo")
    step.settle()
    assert "value >= 0" in pane.listing.toPlainText()
    assert not pane.listing.changed_lines
    assert not compared.notes[2].text().startswith("0 of")
    # The model answer shows it.
    window.run_action("page_exercises")
    shown.questions.show_model()
    shown.settle()
    view.twin_button.click()
    qtbot.waitUntil(lambda: isinstance(window.pages.current, StepPage))
    step.settle()
    assert pane.sides.isVisible()
    # What the exercise has brought along ends with its scene.
    window.files.show_opened(open_any("shared-edge"))
    assert window.session.document.edits == ()


def test_what_differs_is_shown_where_depths_are_alike(page: Page, window: MainWindow, qtbot: QtBot) -> None:
    shown = page("repair-depth-test", 0)
    right = shown.question.draft.answer
    answer = shown.question_view.answer
    answer.show_given(right.named_mistakes["last-wins-ties"])
    answer.answer_changed.emit()
    check(shown)
    shown.question_view.twin_button.click()
    qtbot.waitUntil(lambda: isinstance(window.pages.current, StepPage))
    step = window.pages.current
    step.settle()
    assert window.session.cursor.stage == "depth"
    assert step.compare_view.buffer_box.currentData() == "primitive"


def test_a_wrong_shader_stands_beside_built_in_shading(page: Page, window: MainWindow, qtbot: QtBot) -> None:
    shown = page("repair-diffuse-shader", 0)
    right = shown.question.draft.answer
    answer = shown.question_view.answer
    answer.show_given(right.named_mistakes["light-turned-round"])
    answer.answer_changed.emit()
    assert "The light comes from the wrong side" in check(shown)
    assert shown.question_view.twin_button.text() == OPEN
    shown.question_view.twin_button.click()
    qtbot.waitUntil(lambda: isinstance(window.pages.current, StepPage))
    step = window.pages.current
    step.settle()
    scene = window.session.document.scene
    assert scene.program is None
    assert [title.text().split("\n")[0] for title in step.compare_view.titles[:2]] == [
        "A: built-in shading",
        "B: my shader",
    ]
    assert not step.compare_view.notes[2].text().startswith("0 of")
