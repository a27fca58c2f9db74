"""The list of a crowded chart's series: linked with the chart by pointer, click and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from tests.widgets.showing import shown
from widgets.charts.legend import ChartLegend
from widgets.charts.records import ChartSeries

SERIES = tuple(
    ChartSeries(f"method{n}", f"Method {n}", n, np.array([1.0 + n]), np.array([1.0])) for n in range(20)
)
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def legend(qtbot: QtBot) -> ChartLegend:
    made = shown(qtbot, ChartLegend(), 200, 300)
    made.show_series(SERIES, ("method3",))
    return made


def center(legend: ChartLegend, row: int) -> QPoint:
    return legend.visualItemRect(legend.item(row)).center()


def test_every_series_has_a_row_and_the_front_stands_out(legend: ChartLegend) -> None:
    assert [legend.item(row).text() for row in range(legend.count())] == [each.title for each in SERIES]
    assert [row for row in range(legend.count()) if legend.item(row).font().bold()] == [3]
    assert not legend.item(0).icon().isNull()


def test_a_row_under_the_pointer_is_told(legend: ChartLegend, qtbot: QtBot) -> None:
    QTest.mouseMove(legend.viewport(), center(legend, 1))
    with qtbot.waitSignal(legend.series_hovered) as hovered:
        QTest.mouseMove(legend.viewport(), center(legend, 4))
    assert hovered.args == ["method4"]


@pytest.mark.parametrize("modifier", ["NoModifier", "ControlModifier", "ShiftModifier"])
def test_a_click_chooses_and_ctrl_or_shift_adds(legend: ChartLegend, qtbot: QtBot, modifier: str) -> None:
    held = Qt.KeyboardModifier[modifier]
    with qtbot.waitSignal(legend.series_chosen) as chosen:
        QTest.mouseClick(legend.viewport(), LEFT, held, center(legend, 2))
    assert chosen.args == ["method2", modifier != "NoModifier"]


def test_arrows_point_and_enter_chooses(legend: ChartLegend, qtbot: QtBot) -> None:
    legend.show_pointed("method5")
    with qtbot.waitSignal(legend.series_hovered) as hovered:
        QTest.keyClick(legend, Qt.Key.Key_Down)
    assert hovered.args == ["method6"]
    with qtbot.waitSignal(legend.series_chosen) as chosen:
        QTest.keyClick(legend, Qt.Key.Key_Return)
    assert chosen.args == ["method6", False]


def test_what_is_set_by_the_program_emits_nothing(legend: ChartLegend, qtbot: QtBot) -> None:
    with qtbot.assertNotEmitted(legend.series_hovered), qtbot.assertNotEmitted(legend.series_chosen):
        legend.show_pointed("method7")
        legend.show_marks({"method7": "A"})
    assert legend.currentRow() == 7
    assert legend.item(7).text() == "A: Method 7"
    legend.show_pointed("")
    assert legend.currentRow() == -1
