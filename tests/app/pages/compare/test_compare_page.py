"""The Compare page: measuring, charts and figures; with real measurements."""

import time
from dataclasses import replace
from functools import partial

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.pages.compare.charts import TIME
from app.pages.compare.jobs import measured as measured_on
from app.pages.compare.page import ComparePage
from app.window.main_window import MainWindow
from core.study.speed_accuracy import measure
from tests.app.pages.compare.compare_pages import WRONG, compare_page, hand_made, measured
from widgets.basics.theme import LIGHT, current_theme

pytestmark = pytest.mark.shared_window


@pytest.fixture
def page(window: MainWindow) -> ComparePage:
    return compare_page(window)


@pytest.mark.own_window
def test_an_empty_page_says_what_to_do(page: ComparePage) -> None:
    assert page.scatter.places() == []
    assert "All methods of this family do the same work" in page.readout.text()
    QTest.mouseClick(page.export_button, Qt.MouseButton.LeftButton)
    window = page.window()
    assert "measure first" in window.statusBar().currentMessage()


def test_measuring_shows_every_method_and_the_front(page: ComparePage, qtbot: QtBot) -> None:
    drawn: list[int] = []
    page.work.part_done.connect(lambda _: drawn.append(len(page.scatter.places())))
    study = measured(page, qtbot)
    assert [point.method for point in study.points] == [key for key, _ in page.scatter.places()]
    assert drawn[0] == 1, "points appear as they are measured"
    picture = page.scatter.picture
    for series, point in zip(picture.series, study.points, strict=True):
        assert (series.x[0], series.y[0]) == (point.median, point.errors[WRONG])
        assert tuple(series.x_spread[0]) == (point.least, point.interval[1])
    exact = [point for point in study.points if point.errors[WRONG] == 0]
    assert min(exact, key=lambda point: point.median).method in picture.front
    assert page.entries.currentItem().text() == "Hidden surfaces"
    assert not page.controls.cancel_button.isVisible()


@pytest.mark.slow
def test_a_family_that_has_a_result_can_be_shown_while_another_is_measured(
    page: ComparePage, qtbot: QtBot
) -> None:
    page.take_saved(hand_made(), "lines.json")
    page.show_named("visibility")
    showing = page.work.part_done.connect(lambda _: page.show_named("line"))
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    page.work.part_done.disconnect(showing)
    assert [key for key, _ in page.scatter.places()] == ["line=bresenham", "line=dda"]
    page.show_named("visibility")
    study = page.content
    assert [key for key, _ in page.scatter.places()] == [point.method for point in study.points]


def test_cancelling_leaves_what_was_measured_before(page: ComparePage, qtbot: QtBot) -> None:
    before = measured(page, qtbot)
    picture = page.scatter.picture
    page.choice.rounds = 90
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.scatter.places() == [], "what is being measured anew is not shown with old numbers"
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.is_running
    assert page.content is before
    again = page.scatter.picture
    assert [series.x.tolist() for series in again.series] == [series.x.tolist() for series in picture.series]
    qtbot.wait(100)
    assert page.content is before, "no late point of the cancelled measurement comes in"


@pytest.mark.slow
def test_a_failed_measurement_leaves_earlier_results(page: ComparePage, qtbot: QtBot) -> None:
    before = measured(page, qtbot)
    page.begin(partial(measured_on, partial(measure, "visibility", "cycle", {"length": 3.0}), None), "")
    window = page.window()
    qtbot.waitUntil(lambda: window.messages.isVisible(), timeout=60000)
    assert "dial of cycle must be one of none" in window.messages.text.text()
    assert page.content is before
    assert len(page.scatter.places()) == len(before.points)


def test_results_are_kept_for_every_family(page: ComparePage, qtbot: QtBot) -> None:
    study = measured(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_PageDown, Qt.KeyboardModifier.ControlModifier)
    assert page.content is not study
    assert page.scatter.places() == []
    page.entries.setCurrentRow(page.entries.currentRow() - 1)
    assert page.content is study
    assert len(page.scatter.places()) == len(study.points)


def test_hover_reads_the_figures_and_is_linked(page: ComparePage) -> None:
    page.take_saved(hand_made(), "lines.json")
    QApplication.processEvents()
    place = page.scatter.place_of("line=dda")
    QTest.mouseMove(page.scatter.viewport(), place.toPoint())
    assert page.growth.pointed == "line=dda"
    text = page.readout.text()
    for wanted in ("Dda", "line=dda", "22.0 µs", "12.50 pixels", "Pixels drawn", "Exact for", "Source"):
        assert wanted in text
    QTest.mouseMove(page.scatter.viewport(), QPoint(1, 1))
    assert page.growth.pointed == ""
    assert "line=dda" not in page.readout.text()


def test_a_refusal_and_a_reason_are_listed_and_never_drawn(page: ComparePage) -> None:
    page.take_saved(hand_made(), "lines.json")
    assert {key for key, _ in page.scatter.places()} == {"line=bresenham", "line=dda"}
    text = page.readout.text()
    for wanted in (
        "It takes whole numbers only.",
        "It has no distance.",
        "lines.json",
        "A processor",
        "2020-02-02",
    ):
        assert wanted in text
    QTest.keyClick(page.window(), Qt.Key.Key_E)
    assert page.choice.measure == "area"
    assert {key for key, _ in page.scatter.places()} == {"line=bresenham", "line=dda", "line=midpoint"}
    QTest.keyClick(page.window(), Qt.Key.Key_E)
    assert page.choice.measure == "far", "the first comes after the last"


def test_the_same_marks_in_both_charts(page: ComparePage) -> None:
    page.take_saved(hand_made(), "lines.json")
    pictures = page.scatter.picture, page.growth.picture
    assert pictures[0] is not None
    assert pictures[1] is not None
    numbers = [{series.key: series.number for series in picture.series} for picture in pictures]
    assert numbers[1] == {"line=bresenham": 0, "line=dda": 1, "line=midpoint": 2}
    assert numbers[0].items() <= numbers[1].items()
    assert pictures[1].series[0].x.tolist() == [4, 8]


def test_a_count_takes_the_place_of_time_in_both_charts(page: ComparePage) -> None:
    page.take_saved(hand_made(), "lines.json")
    QTest.keyClick(page.window(), Qt.Key.Key_X)
    assert page.controls.cost_box.currentText() == "Pixels drawn"
    scatter, growth = page.scatter.picture, page.growth.picture
    assert [series.x[0] for series in scatter.series] == [40, 41]
    assert scatter.series[0].x_spread is None
    assert scatter.front == ("line=bresenham",)
    assert growth.y_axis.title == "Pixels drawn"
    QTest.keyClick(page.window(), Qt.Key.Key_X)
    assert page.choice.cost == TIME


def test_the_whole_pipeline_is_measured_on_the_open_scene(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    page.show_named("pipeline")
    page.choice.rounds = 1
    scene = window.session.document.scene
    page.start()
    qtbot.waitUntil(lambda: len(page.scatter.places()) > 2, timeout=60000)
    study = page.content
    assert study.scene == "Two triangles sharing an edge"
    assert study.settings == window.session.document.settings
    page.cancel()
    assert window.session.document.scene is scene


@pytest.mark.slow
def test_the_controls_say_when_they_are_set_otherwise(page: ComparePage, qtbot: QtBot) -> None:
    measured(page, qtbot)
    assert "settings have changed" not in page.shown_text.text()
    page.controls.seed_box.setValue(3)
    assert "settings have changed" in page.shown_text.text()


def test_panes_come_back_as_they_were(page: ComparePage) -> None:
    page.columns.setSizes([300, 900])
    state = page.layout_state()
    page.columns.setSizes([400, 800])
    page.restore_layout(state)
    assert page.columns.sizes()[0] == pytest.approx(300, abs=8)


@pytest.mark.own_window
def test_closing_while_measuring_ends_the_thread(page: ComparePage) -> None:
    page.choice.rounds = 99
    page.start()
    start = time.perf_counter()
    page.window().close()
    assert not page.is_running
    assert time.perf_counter() - start < 20


def test_a_crowded_chart_has_a_list_of_its_marks(page: ComparePage) -> None:
    study = hand_made()
    page.take_saved(study, "few.json")
    assert not page.legend.isVisible()
    many = tuple(replace(study.points[n % 2], method=f"line=m{n}", title=f"Method {n}") for n in range(20))
    growth = dict.fromkeys(study.growth, many)
    page.take_saved(replace(study, points=many, growth=growth), "many.json")
    QApplication.processEvents()
    assert page.legend.isVisible()
    assert page.legend.count() == 20
    row = page.legend.visualItemRect(page.legend.item(3)).center()
    QTest.mouseMove(page.legend.viewport(), row)
    assert page.scatter.pointed == page.growth.pointed == "line=m3"
    assert "line=m3" in page.readout.text()
    QTest.mouseClick(page.legend.viewport(), Qt.MouseButton.LeftButton, pos=row)
    assert page.chosen == ("line=m3",)
    assert page.legend.item(3).text() == "A: Method 3"
    QApplication.processEvents()
    place = page.scatter.place_of("line=m1")
    QTest.mouseMove(page.scatter.viewport(), place.toPoint())
    assert page.legend.currentItem().text().startswith("Method ")


@pytest.mark.slow
def test_a_hidden_page_draws_no_points_until_it_is_seen(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    page.choice.rounds = 90
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    window.pages.show_page("step")
    measured_first: list[object] = []
    page.work.part_done.connect(measured_first.append)
    qtbot.waitUntil(lambda: len(measured_first) > 20, timeout=60000)
    assert page.scatter.places() == []
    window.pages.show_page("compare")
    assert len(page.scatter.places()) > 1, "what came meanwhile is there at once"
    page.cancel()


@pytest.mark.slow
@pytest.mark.own_window
def test_the_left_column_grows_with_the_type_and_comes_back(window: MainWindow, page: ComparePage) -> None:
    window.resize(1800, 700)
    QApplication.processEvents()
    before = page.columns.sizes()[0]
    window.appearance.set_theme("presenter")
    large = page.columns.sizes()[0]
    assert large == pytest.approx(before * current_theme().text_px / LIGHT.text_px, abs=2)
    state = page.layout_state()
    assert page.columns.sizes()[0] == large, "saving moves nothing"
    window.appearance.set_theme("light")
    assert page.columns.sizes()[0] == pytest.approx(before, abs=2)
    page.columns.setSizes([500, 1200])
    page.restore_layout(state)
    assert page.columns.sizes()[0] == pytest.approx(before, abs=2), "widths are saved for the usual type"
    window.appearance.set_theme("presenter")
    page.restore_layout(state)
    assert page.columns.sizes()[0] == pytest.approx(large, abs=2)
