"""Severity along the one axis of an experiment: in the chart, in the drawing, and linked with the maps."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.pages.stability.atlas_files import atlas_sheet
from app.pages.stability.page import StabilityPage
from app.pages.stability.records import BELOW_ZERO, NOTHING_RUN, severity_chart
from app.window.main_window import MainWindow
from core.study.cases import Atlas, ExperimentInfo, StabilityMap
from core.study.record import Axis, Outcome
from widgets.basics.theme import LIGHT, paint_as
from widgets.experiments.chart import Chart
from widgets.experiments.maps import CellPlace
from widgets.experiments.series import ChartEmpty

pytestmark = pytest.mark.shared_window

AXIS = Axis("gap", "Gap", "pixels", (0.001, 0.01, 0.1), True)
WEAK, STRONG = "coverage=float16", "coverage=exact"


def hand_made(axis: Axis = AXIS) -> Atlas:
    info = ExperimentInfo("gaps", "Gaps", "What?", (axis,), (WEAK, STRONG), "One fails.")
    hole, right = Outcome.HOLE, Outcome.RIGHT
    maps = (
        StabilityMap(WEAK, WEAK, np.array([[hole, hole, right]], np.uint8), np.array([[40.0, 3.0, 0.0]])),
        StabilityMap(STRONG, STRONG, np.array([[right] * 3], np.uint8), np.zeros((1, 3))),
    )
    return Atlas(info, maps)


def map_of(method: str, *severity: float) -> StabilityMap:
    return StabilityMap(method, method, np.zeros((1, len(severity)), np.uint8), np.array([severity]))


@pytest.fixture
def page(window: MainWindow) -> StabilityPage:
    window.pages.show_page("stability")
    return window.pages.current


@pytest.mark.slow
def test_one_line_for_each_method_and_zero_has_a_place(page: StabilityPage) -> None:
    page.take_saved(hand_made(), "gaps.json")
    QApplication.processEvents()
    chart, legend = page.curves
    picture = chart.picture
    assert [series.y.tolist() for series in picture.series] == [[40.0, 3.0, 0.0], [0.0, 0.0, 0.0]]
    assert picture.series[0].x.tolist() == list(AXIS.values)
    zero, three = chart.place_of(WEAK, 2), chart.place_of(WEAK, 1)
    assert zero.y() > three.y() + 10
    assert [legend.item(row).text() for row in range(legend.count())] == ["float16", "exact"]


def test_a_point_of_a_curve_is_the_cell_of_the_map(page: StabilityPage) -> None:
    page.take_saved(hand_made(), "gaps.json")
    QApplication.processEvents()
    chart, legend = page.curves
    place = chart.place_of(WEAK, 1)
    QTest.mouseMove(chart.viewport(), place.toPoint())
    assert "Severity: <b>3</b>" in page.readout.text()
    assert legend.currentRow() == 0
    QTest.mouseClick(chart.viewport(), Qt.MouseButton.LeftButton, pos=place.toPoint())
    assert page.choice.chosen == CellPlace(WEAK, 1, 0)


def test_a_row_of_the_list_opens_the_first_failure(page: StabilityPage, window: MainWindow) -> None:
    page.take_saved(hand_made(), "gaps.json")
    QApplication.processEvents()
    legend = page.curves[1]
    for row, wanted in ((1, None), (0, CellPlace(WEAK, 0, 0))):
        place = legend.visualItemRect(legend.item(row)).center()
        QTest.mouseClick(legend.viewport(), Qt.MouseButton.LeftButton, pos=place)
        assert page.choice.chosen == wanted
        if wanted is None:
            assert f"No cell of {STRONG} fails" in window.statusBar().currentMessage()


@pytest.mark.slow
def test_curves_come_with_the_cells_and_go_with_a_second_axis(page: StabilityPage, qtbot: QtBot) -> None:
    page.show_named("precision-dial")
    page.choice.resolution = "coarse"
    counts: list[int] = []

    def count_lines() -> None:
        picture = page.curves[0].picture
        counts.append(0 if picture is None else len(picture.series))

    page.work.part_done.connect(count_lines)
    page.start()
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    assert counts[0] == 1, (
        "the first line is there with its cells; the others come as they are run, a few at a time"
    )
    assert counts == sorted(counts)
    picture = page.curves[0].picture
    assert len(picture.series) == len(page.info.methods)
    assert page.curves[0].isVisible()
    page.show_named("slivers")
    assert not page.curves[0].isVisible()
    assert not page.curves[1].isVisible()


def test_an_axis_below_zero_says_where_to_look(qapp: QApplication) -> None:
    axis = Axis("gap", "Gap", "", (-1.0, 1.0))
    found = severity_chart(axis, (map_of(WEAK, 1.0, 0.0),))
    assert found == ChartEmpty(BELOW_ZERO)
    with paint_as(LIGHT):
        sheet = atlas_sheet(hand_made(Axis("gap", "Gap", "", (-1.0, 0.0, 1.0))))
    assert not sheet.findChildren(Chart)


def test_what_has_not_been_run_has_no_line() -> None:
    unknown = map_of(WEAK, *[np.nan] * 3)
    assert severity_chart(AXIS, (unknown, map_of(STRONG, *[np.nan] * 3))) == ChartEmpty(NOTHING_RUN)
    found = severity_chart(AXIS, (unknown, map_of(STRONG, 1.0, np.nan, 0.0)))
    assert [(series.key, series.number) for series in found.series] == [(STRONG, 1)]


def test_a_file_has_the_curves_of_the_page(qapp: QApplication) -> None:
    with paint_as(LIGHT):
        (chart,) = atlas_sheet(hand_made()).findChildren(Chart)
    assert [series.y.tolist() for series in chart.picture.series] == [[40.0, 3.0, 0.0], [0.0, 0.0, 0.0]]
