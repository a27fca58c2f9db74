"""Text that is longer than its place."""

from PySide6.QtWidgets import QRadioButton

from widgets.basics.controls import CutLabel, unbroken, wrap_text


def test_a_text_ends_with_a_whole_word_and_an_ellipsis_where_it_has_no_room(qtbot) -> None:
    label = CutLabel()
    qtbot.addWidget(label)
    label.setText(
        "Pixel (3, 2) is drawn: its centre is at t = 0.5 of the segment, half a pixel above the line."
    )
    label.setFixedSize(160, 3 * label.fontMetrics().lineSpacing() + 4)
    words = label.seen_text().removesuffix(" …").split()
    assert label.seen_text().endswith(" …")
    assert words == label.text().split()[: len(words)]
    assert len(words) > 4
    label.setFixedHeight(400)
    assert label.seen_text() == label.text()


def test_a_button_writes_a_long_text_in_several_lines_and_is_heard_as_one(qtbot) -> None:
    button = QRadioButton()
    qtbot.addWidget(button)
    text = "From no t: N . D is 0, and N . (P0 - PE) decides"
    wrap_text(button, text, 160)
    assert button.text().count("\n") >= 1
    assert button.text().split() == text.split()
    assert button.sizeHint().width() <= 160
    assert button.accessibleName() == text
    wrap_text(button, text, 2000)
    assert button.text() == text


def test_a_line_ends_before_an_operator_and_not_behind_a_short_symbol() -> None:
    assert unbroken("E0 = 12 − 3x, w = 5; (1 − 0)").split(" ") == [
        "E0\u00a0=\u00a012",
        "−\u00a03x,",
        "w\u00a0=\u00a05;",
        "(1",
        "−\u00a00)",
    ]
    assert unbroken("no formula - at all: a, b") == "no formula -\u00a0at all: a, b"
