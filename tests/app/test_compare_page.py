"""The Compare page: measuring, charts, pictures, two points locked together, and files; with real measurements."""

import csv
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from app.compare_page import ComparePage
from app.main_window import MainWindow
from app.study_charts import TIME
from app.study_desk import StudyOrder
from app.study_files import load_study, save_study
from core.settings import Settings
from core.study import measure
from core.study.families import study_families
from core.study.record import Dial, ErrorMeasure, Point, Study, WorkKind

WRONG = "wrong-visible"


@pytest.fixture
def page(window: MainWindow) -> ComparePage:
    """Return the page at the quickest work there is: three triangles that overlap in a cycle."""
    window.pages.show_page("compare")
    found = window.pages.current
    assert isinstance(found, ComparePage)
    found.studies.show_family("visibility")
    found.studies.choice.work = "cycle"
    found.studies.choice.rounds = 2
    found.studies.refresh()
    return found


def measured(page: ComparePage, qtbot: QtBot) -> Study:
    """Measure by the key and wait."""
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.desk.is_measuring
    qtbot.waitUntil(lambda: not page.desk.is_measuring, timeout=60000)
    result = page.studies.result
    assert result is not None
    return result.study


def click(
    page: ComparePage, method: str, modifier: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
) -> None:
    place = page.scatter.place_of(method)
    assert place is not None
    QTest.mouseClick(page.scatter.viewport(), Qt.MouseButton.LeftButton, modifier, place.toPoint())


def wait_for_pictures(page: ComparePage, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: page.pictures.linked.grids[0].buffer() is not None, timeout=60000)


def drop(window: MainWindow, path: Path) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    left, none = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    place, copy = QPointF(200, 200), Qt.DropAction.CopyAction
    QApplication.sendEvent(window, QDragEnterEvent(place.toPoint(), copy, data, left, none))
    QApplication.sendEvent(window, QDropEvent(place, copy, data, left, none))


def hand_made(family: str = "line") -> Study:
    """Return a study with an exact method, a wrong one, one without the error, and one that refused."""
    length = Dial("length", "Length", "pixels", (4, 8), 4, is_cost=True)

    def point(name: str, seconds: float, **others: object) -> Point:
        times = np.array([seconds, 1.1 * seconds, 1.3 * seconds])
        return Point(f"line={name}", name.title(), times, 10, **others)  # type: ignore[arg-type]

    points = (
        point("bresenham", 1e-4, counts={"pixels drawn": 40}, errors={"far": 0.0, "area": 0.5}),
        point("dda", 2e-4, counts={"pixels drawn": 41}, errors={"far": 12.5, "area": 0.25}),
        point(
            "midpoint",
            3e-4,
            counts={"pixels drawn": 39},
            errors={"far": np.nan, "area": 0.125},
            reasons={"far": "It has no distance."},
        ),
        Point("line=wide", "Wide", refused="It takes whole numbers only."),
    )
    return Study(
        family,
        "Lines",
        WorkKind("any", "Any ends", "line", (length,)),
        {"length": 4.0},
        5,
        (ErrorMeasure("far", "Distance", "pixels"), ErrorMeasure("area", "Area", "")),
        points,
        {4.0: points, 8.0: tuple(replace(each, seconds=2 * each.seconds) for each in points)},
        {"processor": "A processor", "date": "2020-02-02"},
        Settings(depth="inverse-w"),
    )


def test_every_family_of_the_core_is_offered(page: ComparePage) -> None:
    titles = [page.families.item(row).text() for row in range(page.families.count())]
    assert len(titles) == len(study_families())
    assert titles[-1] == "Whole pipeline on the open scene"


def test_an_empty_page_says_what_to_do(page: ComparePage) -> None:
    assert page.scatter.places() == []
    assert "All methods of this family do the same work" in page.readout.text()
    QTest.mouseClick(page.export_button, Qt.MouseButton.LeftButton)
    window = page.window()
    assert isinstance(window, MainWindow)
    assert "measure first" in window.statusBar().currentMessage()


def test_measuring_shows_every_method_and_the_front(page: ComparePage, qtbot: QtBot) -> None:
    drawn: list[int] = []
    page.desk.point_measured.connect(lambda _: drawn.append(len(page.scatter.places())))
    study = measured(page, qtbot)
    assert [point.method for point in study.points] == [key for key, _ in page.scatter.places()]
    assert drawn[0] == 1, "points appear as they are measured"
    picture = page.scatter.picture
    assert picture is not None
    for series, point in zip(picture.series, study.points, strict=True):
        assert (series.x[0], series.y[0]) == (point.median, point.errors[WRONG])
        assert series.x_spread is not None
        assert tuple(series.x_spread[0]) == point.spread
    exact = [point for point in study.points if point.errors[WRONG] == 0]
    assert min(exact, key=lambda point: point.median).method in picture.front
    assert page.families.currentItem().text() == "Hidden surfaces"
    assert not page.controls.cancel_button.isVisible()


def test_cancelling_leaves_what_was_measured_before(page: ComparePage, qtbot: QtBot) -> None:
    before = measured(page, qtbot)
    picture = page.scatter.picture
    assert picture is not None
    page.studies.choice.rounds = 90
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.scatter.places() == [], "what is being measured anew is not shown with old numbers"
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.desk.is_measuring
    assert page.studies.study is before
    again = page.scatter.picture
    assert again is not None
    assert [series.x.tolist() for series in again.series] == [series.x.tolist() for series in picture.series]
    qtbot.wait(100)
    assert page.studies.study is before, "no late point of the cancelled measurement comes in"


def test_cancelling_the_first_measurement_draws_nothing(page: ComparePage, qtbot: QtBot) -> None:
    drawn: list[int] = []

    def cancel_at_the_first_point(_: object) -> None:
        if not drawn:
            drawn.append(len(page.scatter.places()))
            page.studies.cancel()

    page.desk.point_measured.connect(cancel_at_the_first_point)
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: bool(drawn), timeout=60000)
    assert drawn == [1]
    assert page.scatter.places() == []
    assert page.studies.result is None


def test_a_failed_measurement_leaves_earlier_results(page: ComparePage, qtbot: QtBot) -> None:
    before = measured(page, qtbot)
    page.desk.measure(StudyOrder("visibility", "cycle", {"length": 3.0}, 1, 0))
    window = page.window()
    assert isinstance(window, MainWindow)
    qtbot.waitUntil(lambda: window.messages.isVisible(), timeout=60000)
    assert "dial of cycle must be one of none" in window.messages.text.text()
    assert page.studies.study is before
    assert len(page.scatter.places()) == len(before.points)


def test_results_are_kept_for_every_family(page: ComparePage, qtbot: QtBot) -> None:
    study = measured(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_PageDown, Qt.KeyboardModifier.ControlModifier)
    assert page.studies.choice.name == "cull"
    assert page.scatter.places() == []
    page.families.setCurrentRow(page.families.currentRow() - 1)
    assert page.studies.study is study
    assert len(page.scatter.places()) == len(study.points)


def test_hover_reads_the_figures_and_is_linked(page: ComparePage) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
    QApplication.processEvents()
    place = page.scatter.place_of("line=dda")
    assert place is not None
    QTest.mouseMove(page.scatter.viewport(), place.toPoint())
    assert page.growth.pointed == "line=dda"
    text = page.readout.text()
    for wanted in ("Dda", "line=dda", "22.0 µs", "12.50 pixels", "Pixels drawn", "Exact for", "Source"):
        assert wanted in text
    QTest.mouseMove(page.scatter.viewport(), QPoint(1, 1))
    assert page.growth.pointed == ""
    assert "line=dda" not in page.readout.text()


def test_a_refusal_and_a_reason_are_listed_and_never_drawn(page: ComparePage) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
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
    assert page.studies.choice.measure == "area"
    assert {key for key, _ in page.scatter.places()} == {"line=bresenham", "line=dda", "line=midpoint"}


def test_the_same_marks_in_both_charts(page: ComparePage) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
    pictures = page.scatter.picture, page.growth.picture
    assert pictures[0] is not None
    assert pictures[1] is not None
    numbers = [{series.key: series.number for series in picture.series} for picture in pictures]
    assert numbers[1] == {"line=bresenham": 0, "line=dda": 1, "line=midpoint": 2}
    assert numbers[0].items() <= numbers[1].items()
    assert pictures[1].series[0].x.tolist() == [4, 8]


def test_a_count_takes_the_place_of_time_in_both_charts(page: ComparePage) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
    QTest.keyClick(page.window(), Qt.Key.Key_X)
    assert page.controls.cost_box.currentText() == "Pixels drawn"
    scatter, growth = page.scatter.picture, page.growth.picture
    assert scatter is not None
    assert growth is not None
    assert [series.x[0] for series in scatter.series] == [40, 41]
    assert scatter.series[0].x_spread is None
    assert scatter.front == ("line=bresenham",)
    assert growth.y_axis.title == "Pixels drawn"
    QTest.keyClick(page.window(), Qt.Key.Key_X)
    assert page.studies.choice.cost == TIME


def test_numbers_shown_are_the_numbers_exported(page: ComparePage, qtbot: QtBot, tmp_path: Path) -> None:
    study = measured(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_T)
    assert page.table.isVisible()
    QTest.mouseClick(page.copy_button, Qt.MouseButton.LeftButton)
    copied = list(csv.DictReader(QGuiApplication.clipboard().text().splitlines(), delimiter="\t"))
    page.export_to(str(tmp_path / "study.csv"))
    exported = list(csv.DictReader((tmp_path / "study.csv").read_text().splitlines()))[: len(study.points)]
    picture = page.scatter.picture
    assert picture is not None
    for shown, written, series in zip(copied, exported, picture.series, strict=True):
        assert shown["Time per frame"] == written["median_seconds_per_unit"] == repr(float(series.x[0]))
        assert shown["Lower quartile"] == written["lower_quartile"]
        assert (
            shown["Pixels that show the wrong triangle (per million)"]
            == written[WRONG]
            == repr(float(series.y[0]))
        )
        assert shown["Depth tests"] == written["depth tests"]


def test_a_point_opens_its_picture_the_reference_and_the_difference(page: ComparePage, qtbot: QtBot) -> None:
    study = measured(page, qtbot)
    assert not page.pictures.isVisible()
    click(page, "visibility=painters")
    wait_for_pictures(page, qtbot)
    assert page.pictures.isVisible()
    point = next(point for point in study.points if point.method == "visibility=painters")
    buffers = [grid.buffer() for grid in page.pictures.linked.grids]
    wrong = round(point.errors[WRONG] * buffers[2].values.size / 1e6)
    assert np.count_nonzero(buffers[2].values) == wrong > 0
    assert f"{wrong:,} of" in page.pictures.heading.text()
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.pictures.isVisible()


def test_a_run_opens_on_the_step_page_and_undo_leads_back(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    before = window.session.document
    measured(page, qtbot)
    click(page, "visibility=painters")
    wait_for_pictures(page, qtbot)
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.pictures.step_button, Qt.MouseButton.LeftButton)
    assert window.pages.current_name == "step"
    assert window.session.document.settings.visibility == "painters"
    pin = window.session.pin
    assert pin is not None
    window.session.undo()
    assert window.session.document is before


def test_the_pinned_pixel_is_where_stepping_begins(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    measured(page, qtbot)
    click(page, "visibility=z-buffer")
    wait_for_pictures(page, qtbot)
    grid = page.pictures.linked.grids[0]
    QTest.mouseClick(
        grid, Qt.MouseButton.LeftButton, pos=grid.placement().cells_rect(60, 64).center().toPoint()
    )
    assert page.pictures.pin is not None
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert window.session.pin == page.pictures.pin


def test_two_points_are_locked_and_stepped_to_where_they_part(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    measured(page, qtbot)
    click(page, "visibility=z-buffer")
    click(page, "visibility=last-drawn", Qt.KeyboardModifier.ControlModifier)
    assert page.opened.chosen == ("visibility=z-buffer", "visibility=last-drawn")
    wait_for_pictures(page, qtbot)
    first, second, difference = (grid.buffer() for grid in page.pictures.linked.grids)
    assert np.array_equal((first.values != second.values).any(axis=2), difference.values != 0)
    assert page.pictures.divergence_button.isVisible()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.pictures.divergence_button, Qt.MouseButton.LeftButton)
    assert window.page.current_view() == "compare"
    assert window.session.document.settings.visibility == "z-buffer"
    assert window.page.comparing.other.visibility == "last-drawn"
    pin = window.session.pin
    assert pin is not None
    assert difference.values[pin[1], pin[0]] != 0
    assert window.session.cursor.stage == "depth"


def test_two_points_that_never_part_say_so(window: MainWindow, page: ComparePage, qtbot: QtBot) -> None:
    measured(page, qtbot)
    click(page, "visibility=last-drawn")
    page.opened.choose("visibility=painters", is_added=True)
    wait_for_pictures(page, qtbot)
    page.opened.step_to_divergence()
    qtbot.waitUntil(
        lambda: window.pages.current_name == "step" or "do not part" in window.statusBar().currentMessage(),
        timeout=60000,
    )
    buffers = [grid.buffer() for grid in page.pictures.linked.grids]
    assert (window.pages.current_name == "step") or not np.count_nonzero(buffers[2].values)


def test_without_a_point_the_keys_say_what_to_do(window: MainWindow, page: ComparePage) -> None:
    QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert "Click a point first" in window.statusBar().currentMessage()
    both = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(window, Qt.Key.Key_Return, both)
    assert "Lock two points together first" in window.statusBar().currentMessage()


def test_a_saved_study_is_dropped_and_shown_as_what_it_is(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    path = tmp_path / "old.json"
    save_study(path, hand_made())
    drop(window, path)
    page = window.pages.current
    assert isinstance(page, ComparePage)
    assert page.studies.choice.name == "line"
    assert "2020-02-02" in page.shown_text.text()
    assert page.controls.seed_box.value() == 5
    assert len(page.scatter.places()) == 2


def test_a_study_of_an_unknown_family_is_looked_at_but_not_measured(
    window: MainWindow, page: ComparePage
) -> None:
    page.studies.take_saved(hand_made("from-a-later-version"), "later.json")
    assert len(page.scatter.places()) == 2
    assert not page.controls.measure_button.isEnabled()
    QTest.keyClick(window, Qt.Key.Key_F5)
    assert "no such family" in window.messages.text.text()


def test_a_broken_study_leaves_what_is_shown(window: MainWindow, page: ComparePage, tmp_path: Path) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
    path = tmp_path / "broken.json"
    path.write_text("{}")
    drop(window, path)
    assert "not a study of Rasterscope" in window.messages.text.text()
    assert len(page.scatter.places()) == 2


@pytest.mark.parametrize("cost", [TIME, "pixels drawn"])
def test_a_study_is_exported(
    window: MainWindow, page: ComparePage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cost: str
) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
    page.studies.choice.cost = cost
    page.studies.refresh()
    for ending in (".json", ".csv", ".svg", ".png", ".pdf"):
        path = str(tmp_path / f"study{ending}")
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *args, path=path: (path, ""))
        QTest.keyClick(window, Qt.Key.Key_E, Qt.KeyboardModifier.ControlModifier)
        assert window.statusBar().currentMessage() == f"Exported study{ending}."
    loaded = load_study(tmp_path / "study.json")
    assert [point.method for point in loaded.points] == [point.method for point in hand_made().points]
    assert "line=dda" in (tmp_path / "study.csv").read_text()
    assert "dda" in (tmp_path / "study.svg").read_text().lower()
    assert QImage(str(tmp_path / "study.png")).width() > 400
    assert (tmp_path / "study.pdf").read_bytes().startswith(b"%PDF")


def test_an_export_that_is_not_possible_is_told(
    window: MainWindow, page: ComparePage, tmp_path: Path
) -> None:
    page.studies.take_saved(hand_made(), "lines.json")
    page.export_to(str(tmp_path / "study.xls"))
    assert "must end with" in window.messages.text.text()
    page.export_to(str(tmp_path / "nowhere" / "study.csv"))
    assert "The study was not exported" in window.messages.text.text()


def test_the_whole_pipeline_is_measured_on_the_open_scene(
    window: MainWindow, page: ComparePage, qtbot: QtBot
) -> None:
    page.studies.show_family("pipeline")
    page.studies.choice.rounds = 1
    scene = window.session.document.scene
    page.studies.measure()
    qtbot.waitUntil(lambda: len(page.scatter.places()) > 2, timeout=60000)
    study = page.studies.study
    assert study is not None
    assert study.scene == "Two triangles sharing an edge"
    assert study.settings == window.session.document.settings
    page.studies.cancel()
    assert window.session.document.scene is scene


def test_the_controls_say_when_they_are_set_otherwise(page: ComparePage, qtbot: QtBot) -> None:
    measured(page, qtbot)
    assert "set otherwise" not in page.shown_text.text()
    page.controls.seed_box.setValue(3)
    assert "set otherwise" in page.shown_text.text()


def test_a_saved_pipeline_study_has_no_pictures(page: ComparePage) -> None:
    study = measure("visibility", "cycle", rounds=1)
    page.studies.take_saved(replace(study, scene="teapot"), "old.json")
    page.opened.choose("visibility=z-buffer")
    assert "without its scene, teapot" in page.pictures.heading.text()


def test_panes_come_back_as_they_were(page: ComparePage) -> None:
    page.columns.setSizes([300, 900])
    state = page.layout_state()
    page.columns.setSizes([400, 800])
    page.restore_layout(state)
    assert page.columns.sizes()[0] == pytest.approx(300, abs=8)


def test_closing_while_measuring_ends_the_thread(page: ComparePage) -> None:
    page.studies.choice.rounds = 99
    page.studies.measure()
    start = time.perf_counter()
    page.window().close()
    assert not page.desk.is_measuring
    assert time.perf_counter() - start < 20
