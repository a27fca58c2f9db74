import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QPushButton, QToolTip

from widgets.basics.theme import current_theme
from widgets.grid.layers import GridBuffer
from widgets.grid.range_control import _BINS as BINS
from widgets.grid.range_control import Histogram, RangeControl

LEFT, NO_KEY = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def control(qtbot) -> RangeControl:
    widget = RangeControl()
    qtbot.addWidget(widget)
    widget.resize(600, 48)
    values = np.linspace(0, 10, 200).reshape(10, 20)
    widget.show_buffer(GridBuffer("z", values, range=(2.0, 8.0)))
    widget.show()
    qtbot.waitExposed(widget)
    return widget


def edits(control: RangeControl) -> list[QLineEdit]:
    return control.findChildren(QLineEdit)


def button(control: RangeControl, text: str) -> QPushButton:
    return next(item for item in control.findChildren(QPushButton) if item.text() == text)


def histogram(control: RangeControl) -> Histogram:
    return control.findChildren(Histogram)[0]


def type_text(edit: QLineEdit, text: str) -> None:
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)


def test_it_shows_the_range_and_emits_nothing(control: RangeControl, qtbot) -> None:
    assert [edit.text() for edit in edits(control)] == ["2", "8"]
    with qtbot.assertNotEmitted(control.range_changed):
        control.show_range(1.0, 3.0)
    assert [edit.text() for edit in edits(control)] == ["1", "3"]


def test_dragging_a_handle_changes_its_end(control: RangeControl, qtbot) -> None:
    bars = histogram(control)
    start = QPoint(int(bars.position_of(8.0)), 20)
    end = QPoint(int(bars.position_of(6.0)), 20)
    QTest.mousePress(bars, LEFT, NO_KEY, start)
    with qtbot.waitSignal(control.range_changed) as changed:
        QTest.mouseMove(bars, end)
    QTest.mouseRelease(bars, LEFT, NO_KEY, end)
    assert changed.args == pytest.approx([2.0, 6.0], abs=0.05)
    assert edits(control)[1].text().startswith(("5.9", "6"))


def test_bars_stand_where_their_values_are_the_largest_in_the_last(control: RangeControl) -> None:
    control.show_buffer(GridBuffer("z", np.array([[0.0] * 5 + [7.0] * 5 + [8.0] * 5]), range=(0.0, 0.1)))
    bars = histogram(control)
    image, ground = bars.grab().toImage(), QColor(current_theme().outline)
    painted = [x for x in range(bars.width()) if image.pixelColor(x, bars.height() // 2) == ground]
    width = (bars.position_of(8.0) - bars.position_of(0.0)) / BINS
    for value in (7.0, 8.0):
        left = bars.position_of(0.0) + min(int(value / 8 * BINS), BINS - 1) * width
        assert any(left <= x + 0.5 <= left + width for x in painted), value
    assert max(painted) < bars.position_of(8.0)


def test_handles_do_not_pass_each_other(control: RangeControl) -> None:
    bars = histogram(control)
    heard: list[tuple[float, float]] = []
    control.range_changed.connect(lambda low, high: heard.append((low, high)))
    QTest.mousePress(bars, LEFT, NO_KEY, QPoint(int(bars.position_of(2.0)), 20))
    QTest.mouseMove(bars, QPoint(int(bars.position_of(9.5)), 20))
    QTest.mouseRelease(bars, LEFT, NO_KEY, QPoint(int(bars.position_of(9.5)), 20))
    assert heard[-1] == (8.0, 8.0)


def test_fit_takes_the_finite_values(control: RangeControl, qtbot) -> None:
    values = np.array([[np.nan, -4.0, 3.0, np.inf]])
    control.show_buffer(GridBuffer("z", values, range=(0.0, 1.0)))
    with qtbot.waitSignal(control.range_changed) as changed:
        QTest.mouseClick(button(control, "Fit"), LEFT)
    assert changed.args == [-4.0, 3.0]


def test_a_right_click_keeps_fitting(control: RangeControl, qtbot) -> None:
    fit = button(control, "Fit")
    with qtbot.waitSignal(control.fitting_changed) as changed:
        fit.customContextMenuRequested.emit(QPoint(2, 2))
    assert changed.args == [True]
    assert control.keeps_fitting()
    assert fit.isChecked()
    with qtbot.waitSignal(control.fitting_changed) as changed:
        QTest.mouseClick(fit, LEFT)
    assert changed.args == [False]
    assert not fit.isChecked()


def test_choosing_a_range_ends_the_fitting(control: RangeControl, qtbot) -> None:
    control.set_keeps_fitting(True)
    with qtbot.waitSignal(control.fitting_changed), qtbot.waitSignal(control.range_changed) as changed:
        type_text(edits(control)[0], "4.5")
    assert changed.args == [4.5, 8.0]


def test_typed_ends(control: RangeControl, qtbot) -> None:
    with qtbot.waitSignal(control.range_changed) as changed:
        type_text(edits(control)[1], "1e3")
    assert changed.args == [2.0, 1000.0]
    for wrong in ("abc", "nan", "-5"):
        with qtbot.assertNotEmitted(control.range_changed):
            type_text(edits(control)[1], wrong)
        qtbot.waitUntil(lambda: QToolTip.text().startswith("expected"))
        assert edits(control)[1].text() == "1000"


def test_reset_is_asked_for(control: RangeControl, qtbot) -> None:
    with qtbot.waitSignal(control.range_reset):
        QTest.mouseClick(button(control, "Reset"), LEFT)


def test_signed_ranges_stay_symmetric(control: RangeControl, qtbot) -> None:
    control.show_buffer(GridBuffer("e", np.array([[-2.0, 1.0]]), "signed"))
    assert [edit.text() for edit in edits(control)] == ["−2", "2"]
    with qtbot.waitSignal(control.range_changed) as changed:
        type_text(edits(control)[1], "0.5")
    assert changed.args == [-0.5, 0.5]


def test_kinds_without_a_range_switch_it_off(control: RangeControl) -> None:
    control.show_buffer(GridBuffer("p", np.zeros((2, 2), np.int32), "ids"))
    assert not control.isEnabled()
    control.show_buffer(GridBuffer("z", np.zeros((2, 2))))
    assert control.isEnabled()
    assert [edit.text() for edit in edits(control)] != ["", ""]
    control.show_buffer(GridBuffer("p", np.zeros((2, 2), np.int32), "ids"))
    assert not any(edit.isVisible() for edit in edits(control)), (
        "the ends of another buffer are not left behind"
    )
    control.show_buffer(None)
    assert not control.isEnabled()


@pytest.mark.parametrize(
    "values",
    [
        np.full((2, 2), np.nan),
        np.full((2, 2), 7.0),
        np.array([[-1.7e308, 1.7e308]]),
        np.array([[1e-320, 2e-320]]),
    ],
)
def test_odd_values_can_be_painted(control: RangeControl, values: np.ndarray) -> None:
    control.show_buffer(GridBuffer("z", values))
    assert not control.grab().isNull()
    QTest.mouseMove(histogram(control), QPoint(40, 20))
    QTest.mouseClick(histogram(control), LEFT, NO_KEY, QPoint(60, 20))
    assert not control.grab().isNull()
