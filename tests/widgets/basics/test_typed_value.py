import math

import pytest
import shiboken6
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLineEdit, QToolTip, QVBoxLayout, QWidget

from core.explain.number_text import fraction_text, full_text, number_text, parse_number
from tests.widgets.showing import shown
from widgets.basics.typed_value import NumberEdit, TypedValue


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.5", 1.5),
        ("  -2 ", -2.0),
        ("−0.25", -0.25),
        ("+.5", 0.5),
        ("0,25", 0.25),
        ("1e-3", 0.001),
        ("3/256", 3 / 256),
        ("-3 / 4", -0.75),
        ("1 1/2", 1.5),
        ("-1 1/2", -1.5),
        ("pi", math.pi),
        ("π/4", math.pi / 4),
        ("2pi", 2 * math.pi),
        ("-3*pi/2", -1.5 * math.pi),
    ],
)
def test_numbers_are_read_as_people_write_them(text: str, value: float) -> None:
    assert parse_number(text) == value


@pytest.mark.parametrize(
    "text", ["", "x", "1..2", "1/0", "--1", "1/", "/2", "nan", "inf", "1e999", "1 2", "pi pi"]
)
def test_what_is_no_finite_number_is_refused_with_a_sentence(text: str) -> None:
    with pytest.raises(ValueError, match=r"number|division by zero"):
        parse_number(text)


@pytest.mark.parametrize(
    ("value", "short", "full", "fraction"),
    [
        (0.0, "0", "0", "0"),
        (1.0, "1", "1", "1"),
        (-1.5, "−1.5", "−1.5", "−1 128/256"),
        (1 / 3, "0.3333", "0.3333333333333333", "~0.3333"),
        (3 / 256, "0.01172", "0.01171875", "3/256"),
        (123456.0, "123456", "123456", "123456"),
        (1.5e-7, "1.5e−7", "1.5e−07", "~1.5e−7"),
        (math.nan, "NaN", "NaN", "NaN"),
        (-math.inf, "−∞", "−∞", "−∞"),
    ],
)
def test_a_number_reads_the_same_everywhere(value: float, short: str, full: str, fraction: str) -> None:
    assert (number_text(value), full_text(value), fraction_text(value)) == (short, full, fraction)


def test_full_text_reads_back_to_the_same_value() -> None:
    for value in (0.1, 1 / 3, -2.5e-11, 1e22):
        assert parse_number(full_text(value)) == value


@pytest.fixture
def field(qtbot) -> TypedValue:
    page = QWidget()
    qtbot.addWidget(page)
    layout = QVBoxLayout(page)
    result = TypedValue("depth", page)
    other = QLineEdit(page)
    layout.addWidget(other)
    layout.addWidget(result)
    result.show_value(0.25)
    page.show()
    qtbot.waitExposed(page)
    other.setFocus()
    result.other = other
    result.page = page
    return result


def replace_text(qtbot, field: TypedValue, text: str) -> None:
    field.edit.setFocus()
    field.edit.selectAll()
    qtbot.keyClicks(field.edit, text)


def test_enter_commits_a_changed_value_once(qtbot, field) -> None:
    seen = []
    field.value_committed.connect(seen.append)
    replace_text(qtbot, field, "3/4")
    assert seen == []
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)
    assert seen == [0.75]
    field.other.setFocus()
    assert seen == [0.75]
    assert field.edit.text() == "0.75"


def test_after_enter_the_next_number_takes_the_place_of_the_one_entered(qtbot, field) -> None:
    seen = []
    field.value_committed.connect(seen.append)
    field.edit.setFocus()
    field.edit.selectAll()
    for text in ("0.5", "0.125"):
        qtbot.keyClicks(field.edit, text)
        qtbot.keyClick(field.edit, Qt.Key.Key_Return)
        field.show_value(seen[-1] / 2)  # Another one may be taken.
        assert field.edit.selectedText() == field.edit.text()
    assert seen == [0.5, 0.125]


def test_leaving_commits(qtbot, field) -> None:
    seen = []
    field.value_committed.connect(seen.append)
    replace_text(qtbot, field, "pi")
    field.other.setFocus()
    assert seen == [math.pi]
    assert field.edit.text() == "3.142"
    assert "3.141592653589793" in field.edit.toolTip()


def test_an_equal_value_and_a_value_set_by_code_emit_nothing(qtbot, field) -> None:
    seen = []
    field.value_committed.connect(seen.append)
    replace_text(qtbot, field, "1/4")
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)
    field.show_value(7.0)
    field.other.setFocus()
    assert seen == []
    assert field.edit.text() == "7"


def test_bad_text_shows_why_and_escape_restores(qtbot, field) -> None:
    seen = []
    field.value_committed.connect(seen.append)
    replace_text(qtbot, field, "abc")
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)
    assert "expected a number" in field.error_text()
    assert field.error.isVisible()
    qtbot.keyClick(field.edit, Qt.Key.Key_Escape)
    assert field.edit.text() == "0.25"
    assert not field.error.isVisible()
    assert seen == []
    assert field.value() == 0.25


def test_bad_text_stays_after_leaving_until_it_is_mended(qtbot, field) -> None:
    seen = []
    field.value_committed.connect(seen.append)
    replace_text(qtbot, field, "1..5")
    field.other.setFocus()
    assert field.edit.text() == "1..5"
    replace_text(qtbot, field, "1.5")
    assert field.error_text() == ""
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)
    assert seen == [1.5]


def test_a_value_out_of_range_is_refused(qtbot, field) -> None:
    field.set_range(0.0, 1.0)
    replace_text(qtbot, field, "2")
    qtbot.keyClick(field.edit, Qt.Key.Key_Return)
    assert field.error_text() == "expected a number between 0 and 1"
    assert field.value() == 0.25


def test_typing_is_not_overwritten_by_the_program(qtbot, field) -> None:
    replace_text(qtbot, field, "0.5")
    field.show_value(9.0)
    assert field.edit.text() == "0.5"


def test_full_precision_while_editing_and_four_digits_otherwise(field) -> None:
    field.show_value(1 / 3)
    assert field.edit.text() == "0.3333"
    field.edit.setFocus()
    assert field.edit.text() == "0.3333333333333333"
    field.other.setFocus()
    assert field.edit.text() == "0.3333"


def test_showing_the_same_value_again_leaves_the_field_alone(field) -> None:
    field.show_value(1 / 3)
    field.edit.setFocus()
    field.show_value(1 / 3)
    assert field.edit.text() == "0.3333333333333333"
    field.show_value(0.0)
    field.show_value(-0.0)
    assert field.edit.text() == "−0"


def test_a_narrow_field_rounds_rather_than_cutting_digits_off(qtbot) -> None:
    field = TypedValue("x", is_compact=True)
    field.show_value(-1 / 3)
    shown(qtbot, field, field.fontMetrics().horizontalAdvance("−0.33") + 14, 24)
    assert field.edit.text() == "−0.33"


def test_the_largest_number_allowed_is_shown_whole_however_little_room_there_is(qtbot) -> None:
    page = QWidget()
    qtbot.addWidget(page)
    row = QHBoxLayout(page)
    field = TypedValue("triangle", page, is_compact=True)
    field.set_range(0, 199999)
    field.show_value(199999)
    row.addWidget(field)
    row.addStretch(1)
    page.resize(10, 30)
    page.show()
    qtbot.waitExposed(page)
    assert field.edit.text() == "199999"
    assert field.edit.fontMetrics().horizontalAdvance("199999") <= field.edit.width() - 10


def test_a_double_click_takes_the_whole_number_and_a_narrow_field_says_why_it_refuses(qtbot) -> None:
    """At once, below the field: it has no room for a line of its own."""
    row = QWidget()
    layout = QHBoxLayout(row)
    first, second = (TypedValue(name, row, is_compact=True) for name in ("x", "y"))
    for field in (first, second):
        layout.addWidget(field)
        field.set_range(-100, 100)
        field.show_value(-12.75)
    shown(qtbot, row)
    QTest.mouseDClick(first.edit, Qt.MouseButton.LeftButton, pos=first.edit.rect().center())
    assert first.edit.selectedText() == "−12.75"
    row.activateWindow()
    assert QTest.qWaitForWindowActive(row)
    for leave in (Qt.Key.Key_Return, Qt.Key.Key_Tab):
        first.edit.setFocus()
        first.edit.selectAll()
        qtbot.keyClicks(first.edit, "1000")
        qtbot.keyClick(first.edit, leave)
        qtbot.waitUntil(lambda: "expected a number between −100 and 100" in QToolTip.text())
        QToolTip.hideText()
        qtbot.waitUntil(lambda: not QToolTip.isVisible())


def test_a_field_that_is_gone_says_nothing(qtbot) -> None:
    edit = NumberEdit()
    edit.tell("expected a number")
    shiboken6.delete(edit)
    QApplication.processEvents()
