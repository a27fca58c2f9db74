"""The Stability page: running, maps, cells, the case behind a cell, shrinking, and files; with real runs."""

import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.state_files import load_state
from app.pages.stability.jobs import run_grid
from app.pages.stability.page import StabilityPage
from app.window.main_window import MainWindow
from core.study.fragment_cases import NAME as OPEN_SCENE
from core.study.record import Axis, Outcome
from core.study.stability import experiments, stress
from core.study.stress import axes_at
from tests.app.pages.stability import stability_pages
from widgets.experiments.case_pictures import HEAD
from widgets.experiments.maps import UNKNOWN, CellPlace

pytestmark = pytest.mark.shared_window


@pytest.fixture
def page(window: MainWindow) -> StabilityPage:
    return stability_pages.stability_page(window)


@pytest.mark.slow
@pytest.mark.own_window
def test_every_experiment_is_offered_and_the_open_scene_last(page: StabilityPage) -> None:
    titles = [page.entries.item(row).text() for row in range(page.entries.count())]
    assert titles == [*(each.info.title for each in experiments), "Watertightness of the open scene"]
    assert page.maps.canvas.record is None
    assert page.controls.claim.text() == f"Claim: {experiments.get('shared-edges').info.claim}"
    QTest.mouseClick(page.export_button, stability_pages.LEFT)
    assert "run the experiment first" in stability_pages.status(page)


@pytest.mark.slow
def test_a_run_shows_every_cell_as_it_is_run_elsewhere(page: StabilityPage, qtbot: QtBot) -> None:
    unknown: list[int] = []

    def count_unknown() -> None:
        record = page.maps.canvas.record
        unknown.append(record.count(UNKNOWN))

    page.work.part_done.connect(count_unknown)
    atlas = stability_pages.run(page, qtbot)
    info = experiments.get("shared-edges").info
    alone = stress("shared-edges", axes=axes_at(info.axes, "coarse"))
    record = page.maps.canvas.record
    for shown, wanted in zip(record.maps, alone.maps, strict=True):
        assert shown.key == wanted.method
        assert shown.cells.tolist() == wanted.outcome.tolist()
    assert atlas.experiment.axes == alone.experiment.axes
    row = len(alone.experiment.axes[0].values)
    assert unknown == [row * k for k in reversed(range(len(unknown)))], "cells appear row by row"
    holes = sum(each.count(Outcome.HOLE) for each in alone.maps)
    assert f"hole  {holes}" in page.maps.legend.texts()
    assert not page.controls.cancel_button.isVisible()


def test_cancelling_leaves_the_maps_of_before(page: StabilityPage, qtbot: QtBot) -> None:
    before = stability_pages.run(page, qtbot)
    page.choice.resolution = "fine"
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: page.maps.canvas.record is not None and page.is_partial)
    page.maps.canvas.cell_chosen.emit(CellPlace(stability_pages.EXCLUSIVE, 18, 0))
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.is_running
    record = page.maps.canvas.record
    assert [each.cells.tolist() for each in record.maps] == [each.outcome.tolist() for each in before.maps]
    assert page.choice.chosen is None, "the fine grid's cell is not one of the coarse grid"
    qtbot.wait(100)
    assert page.choice.result.content is before


@pytest.mark.slow
def test_a_failed_run_leaves_the_maps_of_before(page: StabilityPage, qtbot: QtBot) -> None:
    before = stability_pages.run(page, qtbot)
    wrong = (Axis("height", "Height", "", (1.0,)),)
    page.begin(partial(run_grid, experiments.get("shared-edges"), wrong, 0), "")
    window = page.window()
    qtbot.waitUntil(lambda: window.messages.isVisible(), timeout=60000)
    assert "axes of shared-edges must be steps, cells" in window.messages.text.text()
    assert page.choice.result.content is before


def test_atlases_are_kept_for_every_experiment(page: StabilityPage, qtbot: QtBot) -> None:
    atlas = stability_pages.ran(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_PageDown, Qt.KeyboardModifier.ControlModifier)
    assert page.choice.name == "mesh-through-the-eye"
    assert page.maps.canvas.record is None
    page.entries.setCurrentRow(page.entries.currentRow() - 1)
    assert page.choice.result.content is atlas
    assert page.maps.canvas.record is not None


@pytest.mark.own_window
def test_hover_reads_the_cell_and_leaving_reads_the_experiment(page: StabilityPage, qtbot: QtBot) -> None:
    stability_pages.ran(page, qtbot)
    place = page.maps.canvas.cell_area(CellPlace(stability_pages.EXCLUSIVE, 0, 0)).center()
    QTest.mouseMove(page.maps.canvas, place + QPoint(3, 0))  # Where it may be already, there is no move.
    QTest.mouseMove(page.maps.canvas, place)
    for wanted in ("Fill rule: exclusive", "Outcome: <b>hole</b>", "of 1,024 pixels missing", "Severity"):
        assert wanted in page.readout.text()
    QTest.mouseMove(page.maps.canvas, QPoint(1, 1))
    text = page.readout.text()
    assert "Methods, most failures first" in text
    fails = [int(found) for found in re.findall(r": (\d+) of \d+ fail<", text)]
    assert len(fails) == len(page.info.methods)
    assert fails == sorted(fails, reverse=True)
    assert fails[0] > fails[-1] == 0


@pytest.mark.own_window
def test_keys_go_from_cell_to_cell_and_from_map_to_map(page: StabilityPage, qtbot: QtBot) -> None:
    stability_pages.ran(page, qtbot)
    canvas = page.maps.canvas
    canvas.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Up, Qt.Key.Key_Down):
        QTest.keyClick(canvas, key)
    assert canvas.chosen == CellPlace("fill=scanline-lecture", 1, 1)
    QTest.keyClick(canvas, Qt.Key.Key_Tab)
    assert canvas.chosen == CellPlace(stability_pages.EXCLUSIVE, 1, 1)
    QTest.keyClick(canvas, Qt.Key.Key_Backtab, Qt.KeyboardModifier.ShiftModifier)
    assert canvas.chosen == CellPlace("fill=scanline-lecture", 1, 1)
    assert page.choice.chosen == canvas.chosen
    assert canvas.accessibleDescription().startswith("Fill: scanline-lecture, grid steps of the corners")
    QTest.keyClick(canvas, Qt.Key.Key_Backtab, Qt.KeyboardModifier.ShiftModifier)
    assert not canvas.hasFocus(), "before the first map Shift+Tab leaves the maps"


@pytest.mark.own_window
def test_a_click_shows_the_case_and_another_opens_it_in_the_stepper(
    window: MainWindow, page: StabilityPage, qtbot: QtBot
) -> None:
    stability_pages.ran(page, qtbot)
    before = window.session.document
    place = CellPlace(stability_pages.EXCLUSIVE, 0, 0)
    stability_pages.click(page, place)
    stability_pages.wait_for_case(page, qtbot)
    found = page.opened.found
    assert found.frame is not None
    cover = page.case.linked.grids[1].buffer()
    assert int(np.count_nonzero(cover.values == 0)) == found.verdict.severity > 0
    assert cover.values[page.case.pin[1], page.case.pin[0]] == 0
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.case.step_button, stability_pages.LEFT)
    assert window.pages.current_name == "step"
    assert window.session.document.settings.fill_rule == "exclusive"
    assert window.session.pin == page.case.pin
    window.session.undo()
    assert window.session.document is before


@pytest.mark.parametrize("by", ["double click", "enter"])
def test_a_cell_is_opened_at_once(window: MainWindow, page: StabilityPage, qtbot: QtBot, by: str) -> None:
    stability_pages.ran(page, qtbot)
    place = CellPlace("fill_rule=inclusive", 0, 0)
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        stability_pages.click(page, place)
        if by == "enter":
            QTest.keyClick(page.maps.canvas, Qt.Key.Key_Return)
        else:
            QTest.mouseDClick(
                page.maps.canvas, stability_pages.LEFT, pos=page.maps.canvas.cell_area(place).center()
            )
    assert window.session.document.settings.fill_rule == "inclusive"


@pytest.mark.slow
def test_a_picture_that_is_too_large_is_only_opened(
    window: MainWindow, page: StabilityPage, qtbot: QtBot
) -> None:
    page.show_named("line-drift")
    page.choice.resolution = "coarse"
    atlas = stability_pages.run(page, qtbot)
    worst = next(each for each in atlas.maps if each.method == "line=dda-float32")
    column = worst.outcome.shape[1] - 1
    row = int(np.flatnonzero(worst.outcome[:, column] != Outcome.RIGHT)[0])
    stability_pages.click(page, CellPlace(worst.method, column, row))
    stability_pages.wait_for_case(page, qtbot)
    found = page.opened.found
    assert found.frame is None
    assert "open it in the stepper" in page.case.verdict.text()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.case.step_button, stability_pages.LEFT)
    assert window.session.pin == found.opening.pixel


def test_escape_closes_the_case(page: StabilityPage, qtbot: QtBot) -> None:
    stability_pages.ran(page, qtbot)
    stability_pages.click(page, CellPlace(stability_pages.EXCLUSIVE, 0, 0))
    stability_pages.wait_for_case(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.case.isVisible()
    assert page.maps.canvas.chosen is None


@pytest.mark.parametrize(
    ("name", "method", "stage"),
    [
        pytest.param("painters-cycle", "visibility=painters", "depth", marks=pytest.mark.slow),
        pytest.param("opposite-normals", "shading=flat", "shade", marks=pytest.mark.slow),
        pytest.param("minification", "texture_filter=nearest", "shade", marks=pytest.mark.slow),
        pytest.param("line-drift", "line=dda-float32", "raster", marks=pytest.mark.slow),
        pytest.param(
            "parallel-segments", "line_clipping=cyrus-beck-lecture", "raster", marks=pytest.mark.slow
        ),
    ],
)
def test_every_kind_of_cell_is_shrunk_and_opens_in_the_stepper(
    window: MainWindow, page: StabilityPage, qtbot: QtBot, name: str, method: str, stage: str
) -> None:
    page.show_named(name)
    page.choice.resolution = "coarse"
    found = next(each for each in stability_pages.run(page, qtbot).maps if each.method == method)
    failing = np.argwhere((found.outcome != Outcome.RIGHT) & (found.outcome != Outcome.REFUSED))
    row, column = failing[0].tolist()
    stability_pages.click(page, CellPlace(method, column, row))
    stability_pages.wait_for_case(page, qtbot)
    QTest.keyClick(window, Qt.Key.Key_S)
    shrunk = stability_pages.wait_for_shrunk(page, qtbot)
    assert shrunk.sentence in page.case.verdict.text()
    assert page.case.step_button.isEnabled()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    document = window.session.document
    assert document.scene.size == shrunk.scene.size
    assert document.settings == shrunk.settings
    assert window.session.cursor.stage == stage


def test_a_failing_cell_is_shrunk_saved_and_opened(
    window: MainWindow, page: StabilityPage, qtbot: QtBot, tmp_path: Path
) -> None:
    stability_pages.ran(page, qtbot)
    stability_pages.click(page, CellPlace(stability_pages.EXCLUSIVE, 0, 0))
    stability_pages.wait_for_case(page, qtbot)
    QTest.keyClick(window, Qt.Key.Key_S)
    shrunk = stability_pages.wait_for_shrunk(page, qtbot)
    assert shrunk.sentence in page.case.verdict.text()
    assert page.case.save_button.isEnabled()
    page.save_case_to(str(tmp_path / "small.rasterscope"))
    page.save_case_to(str(tmp_path / "test_small.py"))
    assert (tmp_path / "test_small.py").read_text() == shrunk.test
    saved, _ = load_state(tmp_path / "small.rasterscope")
    assert saved.document.settings.fill_rule == "exclusive"
    assert saved.document.scene.size == shrunk.scene.size
    page.save_case_to(str(tmp_path / "small.txt"))
    assert "must end in .rasterscope or .py" in window.messages.text.text()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.scene.size == shrunk.scene.size


def test_a_right_cell_cannot_be_shrunk(page: StabilityPage, qtbot: QtBot) -> None:
    stability_pages.ran(page, qtbot)
    stability_pages.click(page, CellPlace("coverage=exact", 0, 0))
    stability_pages.wait_for_case(page, qtbot)
    assert not page.case.shrink_button.isEnabled()
    QTest.keyClick(page.window(), Qt.Key.Key_S)
    assert "Only a failing cell" in stability_pages.status(page)
    QTest.mouseClick(page.case.close_button, stability_pages.LEFT)
    QTest.keyClick(page.window(), Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert "Click a cell first" in stability_pages.status(page)


def test_the_precision_dial_of_a_cell_and_of_another_pixel(page: StabilityPage, qtbot: QtBot) -> None:
    page.show_named("precision-dial")
    page.choice.resolution = "coarse"
    stability_pages.run(page, qtbot)
    stability_pages.click(page, CellPlace("coverage=float16", 0, 0))
    stability_pages.wait_for_case(page, qtbot)
    qtbot.waitUntil(lambda: bool(page.case.formats.rows), timeout=60000)
    assert page.case.formats.isVisible()
    by_format = {row.cells[0]: row for row in page.case.formats.rows}
    assert by_format["exact"].is_right
    assert not by_format["float16"].is_right
    assert by_format["float16"].is_count_right is False
    assert by_format["float16"].cells[HEAD.index("Bits of the value")].replace(" ", "") == "0" * 16
    pin = page.case.pin
    sentence = page.case.formats.sentence.text()
    place = f"({pin[0]}, {pin[1]})"
    assert sentence == f"Pixel {place}, triangle 0: expected once, 0 times by coverage=float16 (hole)."
    assert by_format["float16"].cells[HEAD.index("Whole picture")].endswith(f"first {place}")
    page.case.linked.pixel_clicked.emit(0, 0)
    qtbot.waitUntil(lambda: all(row.is_right for row in page.case.formats.rows), timeout=60000)
    assert page.case.formats.sentence.text().startswith(
        "Pixel (0, 0), not covered in any format, nearest triangle 0: "
    )


def test_the_dial_of_a_crack_reads_the_triangles_at_it(page: StabilityPage, qtbot: QtBot) -> None:
    stability_pages.ran(page, qtbot)
    stability_pages.click(page, CellPlace(stability_pages.EXCLUSIVE, 1, 0))
    stability_pages.wait_for_case(page, qtbot)
    qtbot.waitUntil(lambda: bool(page.case.formats.rows), timeout=60000)
    rows = page.case.formats.rows
    triangles = {row.cells[HEAD.index("Triangle")] for row in rows}
    assert len(triangles) > 1
    assert len(rows) == 8 * len(triangles)
    assert {row.cells[HEAD.index("Flipped by")] for row in rows} >= {"fill rule"}
    assert [row.cells[0] for row in rows].count("") == len(rows) - 8
    sentence = page.case.formats.sentence.text()
    assert ", triangles " in sentence
    assert sentence.endswith("0 times by fill_rule=exclusive (hole), and all formats with this rule.")


@pytest.mark.slow
def test_the_open_scene_is_counted(window: MainWindow, page: StabilityPage, qtbot: QtBot) -> None:
    page.show_named(OPEN_SCENE)
    page.choice.resolution = "coarse"
    assert window.session.document.title in page.controls.question.text()
    atlas = stability_pages.run(page, qtbot)
    right = {each.method for each in atlas.maps if each.count(Outcome.RIGHT) == each.outcome.size}
    assert {"coverage=exact", "fill_rule=shared-edge", "fill=spans"} <= right
    assert "fill=scanline-lecture" not in right
    window.session.set_setting("fill", "blocks")
    assert page.choice.result.content is atlas, "what has been run stays when the scene changes"


@pytest.mark.slow
def test_cells_grow_with_the_type(window: MainWindow, page: StabilityPage, qtbot: QtBot) -> None:
    stability_pages.ran(page, qtbot)
    window.appearance.set_theme("presenter")
    QApplication.processEvents()
    assert page.maps.canvas.cell_area(CellPlace(stability_pages.EXCLUSIVE, 0, 0)).width() >= 24
