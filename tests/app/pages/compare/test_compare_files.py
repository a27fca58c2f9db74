"""The Compare page's studies as files: exported, dropped, opened again, refused."""

import csv
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.file_dialogs import SaveDialog
from app.pages.compare.charts import TIME
from app.pages.compare.page import ComparePage
from app.pages.compare.study_files import load_study, study_json
from app.window.main_window import MainWindow
from core.study.speed_accuracy import measure
from tests.app.pages.compare.compare_pages import WRONG, compare_page, hand_made, measured

pytestmark = pytest.mark.shared_window


@pytest.fixture
def page(window: MainWindow) -> ComparePage:
    return compare_page(window)


def drop(window: MainWindow, path: Path) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    left, none = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    place, copy = QPointF(200, 200), Qt.DropAction.CopyAction
    QApplication.sendEvent(window, QDragEnterEvent(place.toPoint(), copy, data, left, none))
    QApplication.sendEvent(window, QDropEvent(place, copy, data, left, none))


def test_numbers_shown_are_the_numbers_exported(page: ComparePage, qtbot: QtBot, tmp_path: Path) -> None:
    study = measured(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_T)
    assert page.table.isVisible()
    QTest.mouseClick(page.copy_button, Qt.MouseButton.LeftButton)
    copied = list(csv.DictReader(QGuiApplication.clipboard().text().splitlines(), delimiter="\t"))
    page.export_to(str(tmp_path / "study.csv"))
    exported = list(csv.DictReader((tmp_path / "study.csv").read_text().splitlines()))[: len(study.points)]
    picture = page.scatter.picture
    for shown, written, series in zip(copied, exported, picture.series, strict=True):
        assert shown["Time per frame"] == written["median_seconds_per_unit"] == repr(float(series.x[0]))
        assert shown["Least"] == written["least"]
        assert shown["Interval to"] == written["interval_high"]
        assert (
            shown["Pixels that show the wrong triangle (per million)"]
            == written[WRONG]
            == repr(float(series.y[0]))
        )
        assert shown["Depth tests"] == written["depth tests"]


def test_a_saved_study_is_dropped_and_shown_as_what_it_is(window: MainWindow, tmp_path: Path) -> None:
    path = tmp_path / "old.json"
    path.write_text(study_json(hand_made()), encoding="utf-8")
    drop(window, path)
    page = window.pages.current
    assert page.choice.name == "line"
    assert "2020-02-02" in page.shown_text.text()
    assert page.controls.seed_box.value() == 5
    assert len(page.scatter.places()) == 2


def test_a_study_of_an_unknown_family_is_looked_at_but_not_measured(
    window: MainWindow, page: ComparePage
) -> None:
    page.take_saved(hand_made("from-a-later-version"), "later.json")
    assert len(page.scatter.places()) == 2
    assert not page.controls.start_button.isEnabled()
    QTest.keyClick(window, Qt.Key.Key_F5)
    assert "no such family" in window.messages.text.text()


def test_a_broken_study_leaves_what_is_shown(window: MainWindow, page: ComparePage, tmp_path: Path) -> None:
    page.take_saved(hand_made(), "lines.json")
    path = tmp_path / "broken.json"
    path.write_text("{}")
    drop(window, path)
    assert "not a study of Rasterscope" in window.messages.text.text()
    assert len(page.scatter.places()) == 2


@pytest.mark.parametrize("cost", [TIME, "pixels drawn"])
def test_a_study_is_exported(
    window: MainWindow, page: ComparePage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cost: str
) -> None:
    page.take_saved(hand_made(), "lines.json")
    page.choice.cost = cost
    page.refresh()
    for ending in (".json", ".csv", ".svg", ".png", ".pdf"):
        path = str(tmp_path / f"study{ending}")
        monkeypatch.setattr(SaveDialog, "ask", lambda dialog, path=path: path)
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
    page.take_saved(hand_made(), "lines.json")
    page.export_to(str(tmp_path / "study.xls"))
    assert "must end with" in window.messages.text.text()
    page.export_to(str(tmp_path / "nowhere" / "study.csv"))
    assert "The study was not exported" in window.messages.text.text()


def test_a_saved_pipeline_study_has_no_pictures(page: ComparePage) -> None:
    study = measure("visibility", "cycle", rounds=1)
    page.take_saved(replace(study, scene="teapot"), "old.json")
    page.choose("visibility=z-buffer")
    assert "without its scene, teapot" in page.pictures.heading.text()
