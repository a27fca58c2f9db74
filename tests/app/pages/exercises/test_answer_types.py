"""Every type of answer, given by mouse and by keyboard alone."""

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file
from app.window.main_window import MainWindow
from core.records.cells import Form
from lessons.exercises.answers.answer import Entry
from lessons.exercises.catalogue import TEMPLATES
from lessons.exercises.question import ask
from tests.app.pages.exercises.acting import LEFT, Page, at, check, paint
from widgets.exercises.choice_answers import (
    MethodAnswerView,
)
from widgets.exercises.field_answers import KEYS
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.picture_answers import SpotAnswerView

pytestmark = pytest.mark.shared_window


def check_that_pixels_are_marked_by_keyboard_alone(page: Page) -> None:
    """Arrows go, Space marks, Shift paints; the rows say the same."""
    shown = page("shared-edge")
    assert shown.question is not None
    shown.grid.setFocus(Qt.FocusReason.TabFocusReason)
    # Who cannot see the outlines hears them, until something is marked.
    assert re.match(
        r"Pixel 0, 8: not marked. 0 marked. Triangle A: \(.*\), \(.*\), \(.*\). Triangle B: \(",
        shown.grid.spoken_description(),
    )
    for is_marked in (True, False):
        QTest.keyClick(shown.grid, Qt.Key.Key_Space)
        assert ((0, 8) in shown.grid.marked()) == is_marked
    for _ in range(8):
        QTest.keyClick(shown.grid, Qt.Key.Key_Down)
    QTest.keyClick(shown.grid, Qt.Key.Key_Space)
    assert shown.grid.marked() == {(0, 0)}
    for _ in range(4):
        QTest.keyClick(shown.grid, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert shown.grid.marked() == {(column, 0) for column in range(5)}
    answer = shown.question_view.answer
    answer.toggle_rows()
    assert answer.rows.text(8, 0) == "0-4"
    field = answer.rows.field(8, 0)
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "2-3, 5")
    assert shown.grid.marked() == {(2, 0), (3, 0), (5, 0)}
    assert shown.grid.spoken_description() == "Pixel 4, 0: not marked. 3 marked."


def check_that_strokes_are_undone(page: Page, window: MainWindow) -> None:
    """A stroke at a time; the scene of the Step page stays as it is."""
    shown = page("shared-edge")
    shown.questions.ask_again()
    shown.settle()
    document = window.session.document
    first, second = frozenset({(1, 1), (2, 1), (3, 1)}), frozenset({(1, 2)})
    paint(shown, first)
    paint(shown, second)
    answer = shown.question_view.answer
    QTest.mouseClick(answer.clear_button, LEFT)
    for action, marked in (
        ("undo", first | second),
        ("undo", first),
        ("undo", frozenset()),
        ("undo", frozenset()),
        ("redo", first),
    ):
        window.run_action(action)
        assert shown.grid.marked() == marked
    assert answer.count.text() == "3 pixels marked"
    assert window.session.document is document
    shown.questions.ask_again()
    shown.settle()


def check_that_a_table_takes_the_keyboard_and_marks_the_wrong_cell(page: Page) -> None:
    """Return goes down; what is typed is said to be understood; a slip costs one cell."""
    shown = page("bresenham-table")
    answer = shown.question_view.answer
    right = [[str(value)] for (value,) in shown.question.draft.answer.reference]
    answer.fields.field(0, 0).setFocus()
    for (text,) in right:
        focused = QApplication.focusWidget()
        assert focused is not None
        QTest.keyClicks(focused, text)
        assert "understood as" in shown.question_view.note.text()
        QTest.keyClick(focused, Qt.Key.Key_Return)
    assert answer.given() == right
    shown.settle()  # Return in the last field has checked the answer.
    assert shown.question_view.verdict.text().startswith("4 of 4 points")
    last = answer.fields.field(len(right) - 1, 0)
    last.setFocus()
    QTest.keyClicks(last, "1")
    assert f"{len(right) - 1} of {len(right)} cells right" in check(shown)
    assert last.accessibleDescription() == "wrong"
    assert answer.fields.field(0, 0).accessibleDescription() == "right"


def check_that_tab_fills_a_large_table_and_empty_cells_are_asked_about(page: Page) -> None:
    """Tab stops at every cell, F6 leaves the table; what is left empty is not charged unasked."""
    shown = page("z-buffer-grid")
    view, before = shown.question_view, len(attempt_file().attempts())
    answer = view.answer
    assert any(label.text() == KEYS for label in answer.findChildren(QLabel))
    rows, columns = len(answer.given()), len(answer.given()[0])
    answer.fields.field(0, 0).setFocus()
    typed = [[f"{row}.{column}" for column in range(columns)] for row in range(rows)]
    for text in (text for row in typed for text in row):
        focused = QApplication.focusWidget()
        assert focused is not None
        QTest.keyClicks(focused, text)
        QTest.keyClick(focused, Qt.Key.Key_Tab)
    assert answer.given() == typed
    focused = answer.fields.field(1, 1)
    focused.setFocus()
    QTest.keyClick(focused, Qt.Key.Key_F6)
    assert shown.grid.hasFocus()
    shown.questions.ask_again()
    answer = view.answer
    QTest.keyClicks(answer.fields.field(0, 0), "1")
    QTest.mouseClick(view.check_button, LEFT)
    shown.settle()
    asked = f"{rows * columns - 1} cells are empty. Check anyway? Then choose Check again."
    assert view.note.text() == asked
    QTest.keyClicks(answer.fields.field(0, 1), "1")
    QTest.mouseClick(view.check_button, LEFT)
    assert view.note.text() == asked.replace(str(rows * columns - 1), str(rows * columns - 2))
    assert len(attempt_file().attempts()) == before
    assert f"of {rows * columns} cells right" in check(shown)
    assert len(attempt_file().attempts()) == before + 1


def check_that_a_typed_point_stands_in_the_sketch(page: Page) -> None:
    """What is given of the plane is drawn beside the question, and the point that is typed; not what is right."""
    shown = page("turn-about-pivot")
    sketch = shown.question_view.sketch
    assert sketch.isVisible()
    names = ["pivot", "point"]
    assert [name for name, _ in sketch.shown.points] == names
    answer = shown.question_view.answer
    for row, (text, typed) in enumerate((("-3/2", names), ("7", [*names, "your answer"]))):
        QTest.keyClicks(answer.fields.field(row, 0), text)
        assert [name for name, _ in sketch.shown.points] == typed
    assert sketch.shown.points[-1] == ("your answer", (-1.5, 7))
    assert sketch.accessibleName().endswith("your answer at (-1.5, 7)")
    sketch.grab()
    sketch = page("highlight").question_view.sketch
    assert sketch.accessibleName().startswith("Sketch: space with three axes; N at (")
    assert page("bresenham-table").question_view.sketch.isHidden()


def check_that_nonsense_costs_nothing(page: Page) -> None:
    shown = page("barycentric-weights")
    before = attempt_file().attempts()
    check(shown)
    assert shown.question_view.note.text() == "Not checked yet: the answer is empty."
    assert attempt_file().attempts() == before


def write(field: QLineEdit, text: str) -> None:
    """Write as by an input method: `QTest` has keys for Latin letters only."""
    field.setText(text)
    field.textEdited.emit(text)


def check_that_nonsense_in_a_row_or_a_step_is_said_and_not_passed_over(page: Page) -> None:
    """Also by Check, which reads the marks on the picture and the steps that were tried."""
    before = attempt_file().attempts()
    for name in ("shared-edge", "wrong-picture"):
        shown = page(name)
        view = shown.question_view
        shown.questions.ask_again()
        shown.settle()
        shown.toggle_rows()
        answer = view.answer.pixels if isinstance(view.answer, SpotAnswerView) else view.answer
        last = len(answer.rows.texts()) - 1
        for text in ("1e400", "NaN", "\u0661", "0-99999999", "2-1"):
            field = answer.rows.field(last, 0)
            write(field, text)
            assert view.note.text().startswith("Row 0: expected "), text
            QTest.keyClicks(answer.rows.field(0, 0), "1")
            answer.rows.field(0, 0).selectAll()
            assert field.text() == text, "another row leaves it alone"
            check(shown)
            assert view.note.text().startswith("Not checked yet: row 0: expected "), text
            assert ascii(text)[1:-1] in view.note.text()
        paint(shown, frozenset({(1, 0)}))
        assert (field.text(), view.note.text()) == ("1", "")
        answer.toggle_rows()
        answer.clear_button.click()
    shown = page("bresenham-steps")
    view = shown.question_view
    for text in ("1e400", "NaN", "\u0661", " fixed "):
        write(view.answer.field, text)
        QTest.keyClick(view.answer.field, Qt.Key.Key_Return)
        assert view.note.text().startswith("Not tried yet: expected "), text
        check(shown)
        assert view.note.text().startswith("Not checked yet: expected "), text
        view.answer.field.clear()
    QTest.keyClicks(view.answer.field, "5")
    assert view.note.text() == ""
    check(shown)
    assert view.note.text() == "Not checked yet: '5' is not tried yet: Return tries it."
    view.answer.field.clear()
    assert attempt_file().attempts() == before


def check_that_an_order_is_moved_by_keys(page: Page) -> None:
    shown = page("stage-order")
    answer = shown.question_view.answer
    for place, item in enumerate(shown.question.draft.answer.options):
        answer.list.setCurrentRow(answer.given().index(item))
        while answer.given().index(item) > place:
            QTest.keyClick(answer.list, Qt.Key.Key_Up, Qt.KeyboardModifier.AltModifier)
    assert check(shown).startswith("2 of 2 points")


def check_that_options_are_chosen_by_space_and_marked(page: Page) -> None:
    shown = page("facing")
    answer = shown.question_view.answer
    right = shown.question.draft.answer.reference
    answer.buttons[0].setFocus(Qt.FocusReason.TabFocusReason)
    for place, button in enumerate(answer.buttons):
        assert button.hasFocus()
        if place in right:
            QTest.keyClick(button, Qt.Key.Key_Space)
        QTest.keyClick(button, Qt.Key.Key_Tab)
    assert check(shown).startswith("2 of 2 points")
    assert answer.buttons[min(right)].accessibleDescription() == "right"


def check_that_hints_come_in_order_and_the_model_answer_asks_first(page: Page) -> None:
    shown = page("triangle-coverage")
    view = shown.question_view
    QTest.mouseClick(view.hint_button, LEFT)
    assert view.hints.text().startswith("Hint 1 of 3: Look at one row")
    assert view.hint_button.text() == "Hint 2 of 3"
    QTest.mouseClick(view.model_button, LEFT)
    assert shown.grid.marked() == frozenset()
    QTest.mouseClick(view.model_button, LEFT)
    assert shown.grid.marked() == shown.question.draft.answer.reference
    QTest.mouseClick(shown.grid, LEFT, pos=at(shown, (0, 0)))
    assert (0, 0) not in shown.grid.marked()


def check_that_a_point_is_placed_by_mouse_and_moved_by_keys(page: Page) -> None:
    shown = page("clip-ends")
    answer = shown.question_view.answer
    placement = shown.grid.placement()
    QTest.mouseClick(shown.grid, LEFT, pos=placement.to_widget(2.0, 1.0).toPoint())
    QTest.mouseClick(shown.grid, LEFT, pos=placement.to_widget(6.0, 3.0).toPoint())
    assert [round(float(text)) for row in answer.given() for text in row] == [2, 1, 6, 3]
    before = answer.given()[0]
    shown.grid.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(shown.grid, Qt.Key.Key_Space)
    QTest.keyClick(shown.grid, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(shown.grid, Qt.Key.Key_Up)
    assert float(answer.given()[0][0]) == float(before[0]) + 1
    assert float(answer.given()[0][1]) > float(before[1])
    assert "of 2 points right" in check(shown)


def check_that_a_line_of_a_listing_is_chosen_by_keys(page: Page) -> None:
    shown = page("wrong-line")
    answer = shown.question_view.answer
    assert answer.given() == ""
    QTest.keyClick(answer.list, Qt.Key.Key_Home)
    for _ in range(shown.question.draft.answer.reference):
        QTest.keyClick(answer.list, Qt.Key.Key_Down)
    assert check(shown).startswith("2 of 2 points")


def check_that_what_is_wrong_with_a_picture_is_pointed_at_and_named(page: Page) -> None:
    shown = page("wrong-picture")
    answer = shown.question_view.answer
    right = shown.question.draft.answer
    answer.choice.buttons[0].setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(shown, Qt.Key.Key_F6)
    assert shown.grid.hasFocus()
    QTest.mouseClick(shown.grid, LEFT, pos=at(shown, min(right.wrong)))
    QTest.keyClick(answer.choice.buttons[right.right], Qt.Key.Key_Space)
    assert check(shown).startswith("4 of 4 points")


def check_that_steps_are_judged_at_once_and_put_right(page: Page) -> None:
    """A pixel is clicked, a number typed; a wrong try may be put right and earns nothing."""
    shown = page("bresenham-steps")
    answer = shown.question_view.answer
    steps = shown.question.draft.answer.steps
    QTest.keyClicks(answer.field, "77")
    QTest.keyClick(answer.field, Qt.Key.Key_Return)
    shown.questions.go_back(-1)
    assert answer.given() == [["77"]], "a step that was tried counts"
    assert shown.question_view.note.text() == "Step 1: 77 is not right. Try again, or have it put right."
    QTest.mouseClick(answer.fix_button, LEFT)
    for step in steps[1:]:
        if step.kind == "pixel":
            QTest.mouseClick(shown.grid, LEFT, pos=at(shown, step.right))
        else:
            QTest.keyClicks(answer.field, str(step.right))
            QTest.keyClick(answer.field, Qt.Key.Key_Return)
    assert answer.prompt.text() == "All steps are done."
    assert f"{len(steps) - 1} of {len(steps)} steps right" in check(shown)
    assert shown.grid.marked() == {step.right for step in steps if step.kind == "pixel"}


def check_that_a_weak_method_is_broken_by_a_drag_and_by_keys(page: Page) -> None:
    shown = page("break-inclusive")
    answer = shown.question_view.answer
    right = shown.question.draft.answer
    x, y = map(float, right.reference)
    placement = shown.grid.placement()
    start, end = (placement.to_widget(*place).toPoint() for place in (map(float, right.start), (x, y)))
    QTest.mousePress(shown.grid, LEFT, pos=start)
    QTest.mouseMove(shown.grid, end)
    QTest.mouseRelease(shown.grid, LEFT, pos=end)
    assert [float(text) for text in answer.given()] == [x, y]
    assert check(shown).startswith("3 of 3 points")
    QTest.keyClick(answer.sliders[0], Qt.Key.Key_Right)
    shown.settle()
    assert float(answer.given()[0]) == x + float(right.dials[0].step)


def check_that_a_number_which_a_dial_refuses_is_not_checked(page: Page) -> None:
    """It stays in its field; what the dial takes is said beside it, and the one before is not checked instead."""
    shown = page("break-depth-format")
    view, before = shown.question_view, attempt_file().attempts()
    answer = view.answer
    assert answer.fields[0].accessibleDescription() == "0 to 5e-05 in steps of 2.5e-06"
    assert any(label.text() == "0 to 5e-05 in steps of 2.5e-06" for label in answer.findChildren(QLabel))
    for text in ("1e-6", "x", "1", ""):
        answer.fields[0].selectAll()
        QTest.keyClick(answer.fields[0], Qt.Key.Key_Delete)
        QTest.keyClicks(answer.fields[0], text)
        check(shown)
        QTest.keyClick(answer.fields[0], Qt.Key.Key_Return)
        shown.settle()
        assert answer.fields[0].text() == text
        assert view.note.text().startswith(
            ("Not checked yet: expected gap from 0 to 5e-05 in", "Not checked yet: gap: ")
        )
    assert attempt_file().attempts() == before
    QTest.keyClick(answer.sliders[0], Qt.Key.Key_Left)
    assert answer.fields[0].text() == answer.given()[0] == "4.75e-05"
    answer.fields[0].selectAll()
    QTest.keyClicks(answer.fields[0], "0.0000025")
    assert answer.given() == ["2.5e-06"]
    assert "fail" in check(shown)
    assert attempt_file().attempts()[-1].answer == "gap = 2.5e-06"


def check_that_the_cheapest_methods_are_chosen(page: Page) -> None:
    shown = page("cheapest-methods")
    answer = shown.question_view.answer
    for box, method in zip(answer.boxes, shown.question.draft.answer.reference, strict=True):
        box.setFocus()
        for _ in range(method + 1):
            QTest.keyClick(box, Qt.Key.Key_Down)
    assert check(shown).startswith("4 of 4 points")


def test_every_form_takes_every_answer_of_its_questions() -> None:
    """What a form holds for an answer is read as that answer."""
    for template in list(TEMPLATES.values())[::4]:
        draft = ask(template, 3).draft
        for response in (draft.answer.reference, *draft.mistakes.values()):
            given = draft.answer.given(response)
            assert draft.answer.is_same(draft.answer.read(given), response), template.name


def test_every_type_is_answered_in_one_window(page: Page, window: MainWindow) -> None:
    """One window for all of them: making one takes longer than answering."""
    check_that_strokes_are_undone(page, window)
    check_that_pixels_are_marked_by_keyboard_alone(page)
    check_that_a_table_takes_the_keyboard_and_marks_the_wrong_cell(page)
    check_that_tab_fills_a_large_table_and_empty_cells_are_asked_about(page)
    check_that_a_typed_point_stands_in_the_sketch(page)
    check_that_nonsense_costs_nothing(page)
    check_that_nonsense_in_a_row_or_a_step_is_said_and_not_passed_over(page)
    check_that_an_order_is_moved_by_keys(page)
    check_that_options_are_chosen_by_space_and_marked(page)
    check_that_hints_come_in_order_and_the_model_answer_asks_first(page)
    check_that_a_point_is_placed_by_mouse_and_moved_by_keys(page)
    check_that_a_line_of_a_listing_is_chosen_by_keys(page)
    check_that_what_is_wrong_with_a_picture_is_pointed_at_and_named(page)
    check_that_steps_are_judged_at_once_and_put_right(page)
    check_that_a_weak_method_is_broken_by_a_drag_and_by_keys(page)
    check_that_a_number_which_a_dial_refuses_is_not_checked(page)
    check_that_the_cheapest_methods_are_chosen(page)


def test_a_long_method_makes_the_question_no_wider(qtbot: QtBot) -> None:
    """A list of methods that is wider than its column would cut the text of the question off."""

    def width(text: str) -> int:
        cell = Entry("Fill", "choice", options=(text,))
        form = Form("cheapest", ((cell,),), labels=("fill",), names=(("one",),), told=str)
        grid = MarkGrid()
        view = MethodAnswerView(form, grid)
        qtbot.addWidget(grid)
        qtbot.addWidget(view)
        return view.minimumSizeHint().width()

    assert width("a method of many words, with its cost") == width("a")


def test_a_step_that_was_missed_has_its_mark(page: Page) -> None:
    shown = page("space-steps")
    answer = shown.question_view.answer
    answer.show_given([["99"]])
    assert not answer.list.item(0).icon().isNull()
