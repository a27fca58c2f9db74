"""The Stability page: running, maps, cells, the case behind a cell, shrinking, and files; with real runs."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.atlas_export import atlas_json
from app.atlas_files import AtlasFileError, load_atlas
from app.main_window import MainWindow
from app.stability_desk import StressOrder
from app.stability_page import StabilityPage
from app.state_files import load_state
from core.study.stability import Atlas, Axis, Outcome, experiments, stress
from core.study.stability.open_scene import NAME as OPEN_SCENE
from core.study.stability.resolution import axes_at
from widgets.atlas_records import UNKNOWN, CellPlace
from widgets.dial_table import HEAD

EXCLUSIVE = "fill_rule=exclusive"
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def page(window: MainWindow) -> StabilityPage:
    """Return the page at a mesh whose edges pass through pixel centres, on a coarse grid."""
    QTest.keyClick(window, Qt.Key.Key_3, Qt.KeyboardModifier.AltModifier)
    found = window.pages.current
    assert isinstance(found, StabilityPage)
    found.runs.show_experiment("shared-edges")
    found.runs.choice.resolution = "coarse"
    found.runs.refresh()
    return found


def run(page: StabilityPage, qtbot: QtBot) -> Atlas:
    """Run by the key and wait."""
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    assert page.desk.is_running
    qtbot.waitUntil(lambda: not page.desk.is_running, timeout=60000)
    assert page.runs.result is not None
    return page.runs.result.atlas


def click(page: StabilityPage, place: CellPlace) -> None:
    QTest.mouseClick(page.maps.canvas, LEFT, pos=page.maps.canvas.cell_area(place).center())


def wait_for_case(page: StabilityPage, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: page.opened.found is not None, timeout=60000)


def status(page: StabilityPage) -> str:
    window = page.window()
    assert isinstance(window, MainWindow)
    return window.statusBar().currentMessage()


def test_every_experiment_is_offered_and_the_open_scene_last(page: StabilityPage) -> None:
    titles = [page.experiments.item(row).text() for row in range(page.experiments.count())]
    assert titles == [*(each.info.title for each in experiments), "Watertightness of the open scene"]
    assert page.maps.canvas.record is None
    assert page.controls.claim.text() == f"Claim: {experiments.get('shared-edges').info.claim}"
    QTest.mouseClick(page.export_button, LEFT)
    assert "run the experiment first" in status(page)


def test_a_run_shows_every_cell_as_it_is_run_elsewhere(page: StabilityPage, qtbot: QtBot) -> None:
    unknown: list[int] = []

    def count_unknown() -> None:
        record = page.maps.canvas.record
        assert record is not None
        unknown.append(record.count(UNKNOWN))

    page.desk.cells_run.connect(count_unknown)
    atlas = run(page, qtbot)
    info = experiments.get("shared-edges").info
    alone = stress("shared-edges", axes=axes_at(info.axes, "coarse"))
    record = page.maps.canvas.record
    assert record is not None
    for shown, wanted in zip(record.maps, alone.maps, strict=True):
        assert shown.key == wanted.method
        assert shown.cells.tolist() == wanted.outcome.tolist()
    assert atlas.experiment.axes == alone.experiment.axes
    row = len(alone.experiment.axes[0].values)
    assert unknown == [row * k for k in reversed(range(len(unknown)))], "cells appear row by row"
    holes = sum(each.count(Outcome.HOLE) for each in alone.maps)
    assert f"hole  {holes}" in page.maps.legend.texts()
    assert not page.controls.running.cancel_button.isVisible()


def test_cancelling_leaves_the_maps_of_before(page: StabilityPage, qtbot: QtBot) -> None:
    before = run(page, qtbot)
    page.runs.choice.resolution = "fine"
    QTest.keyClick(page.window(), Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: page.maps.canvas.record is not None and page.runs.is_partial, timeout=10000)
    page.maps.canvas.cell_chosen.emit(CellPlace(EXCLUSIVE, 18, 0))
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.desk.is_running
    record = page.maps.canvas.record
    assert record is not None
    assert [each.cells.tolist() for each in record.maps] == [each.outcome.tolist() for each in before.maps]
    assert page.runs.choice.chosen is None, "the fine grid's cell is not one of the coarse grid"
    qtbot.wait(100)
    assert page.runs.result is not None
    assert page.runs.result.atlas is before


def test_a_failed_run_leaves_the_maps_of_before(page: StabilityPage, qtbot: QtBot) -> None:
    before = run(page, qtbot)
    wrong = (Axis("height", "Height", "", (1.0,)),)
    page.desk.run(StressOrder(experiments.get("shared-edges"), wrong, 0))
    window = page.window()
    assert isinstance(window, MainWindow)
    qtbot.waitUntil(lambda: window.messages.isVisible(), timeout=60000)
    assert "axes of shared-edges must be steps, cells" in window.messages.text.text()
    assert page.runs.result is not None
    assert page.runs.result.atlas is before


def test_atlases_are_kept_for_every_experiment(page: StabilityPage, qtbot: QtBot) -> None:
    atlas = run(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_PageDown, Qt.KeyboardModifier.ControlModifier)
    assert page.runs.choice.name == "mesh-through-the-eye"
    assert page.maps.canvas.record is None
    page.experiments.setCurrentRow(page.experiments.currentRow() - 1)
    assert page.runs.result is not None
    assert page.runs.result.atlas is atlas
    assert page.maps.canvas.record is not None


def test_hover_reads_the_cell_and_leaving_reads_the_experiment(page: StabilityPage, qtbot: QtBot) -> None:
    run(page, qtbot)
    place = page.maps.canvas.cell_area(CellPlace(EXCLUSIVE, 0, 0)).center()
    QTest.mouseMove(page.maps.canvas, place)
    for wanted in (EXCLUSIVE, "Outcome: <b>hole</b>", "of 1,024 pixels missing", "Severity"):
        assert wanted in page.readout.text()
    QTest.mouseMove(page.maps.canvas, QPoint(1, 1))
    assert "Methods, weakest first" in page.readout.text()


def test_keys_go_from_cell_to_cell_and_from_map_to_map(page: StabilityPage, qtbot: QtBot) -> None:
    run(page, qtbot)
    canvas = page.maps.canvas
    canvas.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Up, Qt.Key.Key_Down):
        QTest.keyClick(canvas, key)
    assert canvas.chosen == CellPlace("fill=scanline-lecture", 1, 1)
    QTest.keyClick(canvas, Qt.Key.Key_Tab)
    assert canvas.chosen == CellPlace(EXCLUSIVE, 1, 1)
    QTest.keyClick(canvas, Qt.Key.Key_Backtab, Qt.KeyboardModifier.ShiftModifier)
    assert canvas.chosen == CellPlace("fill=scanline-lecture", 1, 1)
    assert page.runs.choice.chosen == canvas.chosen
    assert canvas.accessibleDescription().startswith("fill=scanline-lecture, steps of the corners' lattice")
    QTest.keyClick(canvas, Qt.Key.Key_Backtab, Qt.KeyboardModifier.ShiftModifier)
    assert not canvas.hasFocus(), "before the first map Shift+Tab leaves the maps"


def test_a_click_shows_the_case_and_another_opens_it_in_the_stepper(
    window: MainWindow, page: StabilityPage, qtbot: QtBot
) -> None:
    run(page, qtbot)
    before = window.session.document
    place = CellPlace(EXCLUSIVE, 0, 0)
    click(page, place)
    wait_for_case(page, qtbot)
    found = page.opened.found
    assert found is not None
    assert found.frame is not None
    cover = page.case.linked.grids[1].buffer()
    assert cover is not None
    assert int(np.count_nonzero(cover.values == 0)) == found.verdict.severity > 0
    assert page.case.pin is not None
    assert cover.values[page.case.pin[1], page.case.pin[0]] == 0
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.case.step_button, LEFT)
    assert window.pages.current_name == "step"
    assert window.session.document.settings.fill_rule == "exclusive"
    assert window.session.pin == page.case.pin
    window.session.undo()
    assert window.session.document is before


@pytest.mark.parametrize("by", ["double click", "enter"])
def test_a_cell_is_opened_at_once(window: MainWindow, page: StabilityPage, qtbot: QtBot, by: str) -> None:
    run(page, qtbot)
    place = CellPlace("fill_rule=inclusive", 0, 0)
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        click(page, place)
        if by == "enter":
            QTest.keyClick(page.maps.canvas, Qt.Key.Key_Return)
        else:
            QTest.mouseDClick(page.maps.canvas, LEFT, pos=page.maps.canvas.cell_area(place).center())
    assert window.session.document.settings.fill_rule == "inclusive"


def test_a_picture_that_is_too_large_is_only_opened(
    window: MainWindow, page: StabilityPage, qtbot: QtBot
) -> None:
    page.runs.show_experiment("line-drift")
    page.runs.choice.resolution = "coarse"
    atlas = run(page, qtbot)
    worst = next(each for each in atlas.maps if each.method == "line=dda-float32")
    column = worst.outcome.shape[1] - 1
    row = int(np.flatnonzero(worst.outcome[:, column] != Outcome.RIGHT)[0])
    click(page, CellPlace(worst.method, column, row))
    wait_for_case(page, qtbot)
    found = page.opened.found
    assert found is not None
    assert found.opening is not None
    assert found.frame is None
    assert "open it in the stepper" in page.case.verdict.text()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.mouseClick(page.case.step_button, LEFT)
    assert window.session.pin == found.opening.pixel


def test_escape_closes_the_case(page: StabilityPage, qtbot: QtBot) -> None:
    run(page, qtbot)
    click(page, CellPlace(EXCLUSIVE, 0, 0))
    wait_for_case(page, qtbot)
    QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert not page.case.isVisible()
    assert page.maps.canvas.chosen is None


def test_a_cell_of_depth_is_shrunk_and_one_of_normals_says_why_not(page: StabilityPage, qtbot: QtBot) -> None:
    for name, method in (("painters-cycle", "visibility=painters"), ("opposite-normals", "shading=flat")):
        page.runs.show_experiment(name)
        page.runs.choice.resolution = "coarse"
        found = next(each for each in run(page, qtbot).maps if each.method == method)
        row, column = np.argwhere(found.outcome > Outcome.RIGHT)[0].tolist()
        click(page, CellPlace(method, column, row))
        wait_for_case(page, qtbot)
        QTest.keyClick(page.window(), Qt.Key.Key_S)
        if name == "painters-cycle":
            qtbot.waitUntil(lambda: page.opened.shrunk is not None, timeout=60000)
            assert page.opened.shrunk.shrunk.scene.size == (1, 1)
            QTest.keyClick(page.window(), Qt.Key.Key_Escape)
    assert page.opened.shrunk is None
    assert status(page).startswith(
        "Cells of opposite-normals cannot be made smaller: what is right belongs to"
    )


def test_a_failing_cell_is_shrunk_saved_and_opened(
    window: MainWindow, page: StabilityPage, qtbot: QtBot, tmp_path: Path
) -> None:
    run(page, qtbot)
    click(page, CellPlace(EXCLUSIVE, 0, 0))
    wait_for_case(page, qtbot)
    QTest.keyClick(window, Qt.Key.Key_S)
    qtbot.waitUntil(lambda: page.opened.shrunk is not None, timeout=60000)
    found = page.opened.shrunk
    assert found is not None
    assert found.shrunk.sentence in page.case.verdict.text()
    assert page.case.save_button.isEnabled()
    page.save_case_to(str(tmp_path / "small.rasterscope"))
    page.save_case_to(str(tmp_path / "test_small.py"))
    assert (tmp_path / "test_small.py").read_text() == found.shrunk.test
    saved, _ = load_state(tmp_path / "small.rasterscope")
    assert saved.document.settings.fill_rule == "exclusive"
    assert saved.document.scene.size == found.shrunk.scene.size
    page.save_case_to(str(tmp_path / "small.txt"))
    assert "must end in .rasterscope or .py" in window.messages.text.text()
    with qtbot.waitSignal(window.opening.opened, timeout=60000):
        QTest.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.scene.size == found.shrunk.scene.size


def test_a_right_cell_cannot_be_shrunk(page: StabilityPage, qtbot: QtBot) -> None:
    run(page, qtbot)
    click(page, CellPlace("coverage=exact", 0, 0))
    wait_for_case(page, qtbot)
    assert not page.case.shrink_button.isEnabled()
    QTest.keyClick(page.window(), Qt.Key.Key_S)
    assert "Only a cell that fails" in status(page)
    QTest.mouseClick(page.case.close_button, LEFT)
    QTest.keyClick(page.window(), Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert "Click a cell first" in status(page)


def test_the_precision_dial_of_a_cell_and_of_another_pixel(page: StabilityPage, qtbot: QtBot) -> None:
    page.runs.show_experiment("precision-dial")
    page.runs.choice.resolution = "coarse"
    run(page, qtbot)
    click(page, CellPlace("coverage=float16", 0, 0))
    wait_for_case(page, qtbot)
    qtbot.waitUntil(lambda: bool(page.case.formats.rows), timeout=60000)
    assert page.case.formats.isVisible()
    by_format = {row.cells[0]: row for row in page.case.formats.rows}
    assert by_format["exact"].is_right
    assert not by_format["float16"].is_right
    assert by_format["float16"].cells[HEAD.index("Bits of the value")].replace(" ", "") == "0" * 16
    page.case.linked.pixel_clicked.emit(0, 0)
    qtbot.waitUntil(lambda: all(row.is_right for row in page.case.formats.rows), timeout=60000)


def test_the_open_scene_is_counted(window: MainWindow, page: StabilityPage, qtbot: QtBot) -> None:
    page.runs.show_experiment(OPEN_SCENE)
    page.runs.choice.resolution = "coarse"
    assert window.session.document.title in page.controls.question.text()
    atlas = run(page, qtbot)
    right = {each.method for each in atlas.maps if each.count(Outcome.RIGHT) == each.outcome.size}
    assert {"coverage=exact", "fill_rule=shared-edge", "fill=spans"} <= right
    assert "fill=scanline-lecture" not in right
    window.session.set_setting("fill", "blocks")
    assert page.runs.result is not None
    assert page.runs.result.atlas is atlas, "what has been run stays when the scene changes"


def test_an_atlas_is_exported_and_opened_again(
    window: MainWindow, page: StabilityPage, qtbot: QtBot, tmp_path: Path
) -> None:
    atlas = run(page, qtbot)
    for ending in ("json", "csv", "svg", "png", "pdf"):
        page.export_to(str(tmp_path / f"atlas.{ending}"))
    assert (tmp_path / "atlas.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "atlas.pdf").read_bytes().startswith(b"%PDF")
    rows = list(csv.DictReader((tmp_path / "atlas.csv").read_text().splitlines()))
    assert len(rows) == sum(each.outcome.size for each in atlas.maps)
    assert atlas.experiment.claim.split(";")[0] in (tmp_path / "atlas.svg").read_text().replace("\n", " ")
    assert {row["date"] for row in rows} == {atlas.machine["date"]}
    page.runs.choice.result = None
    window.pages.show_page("step")
    window.open_path(str(tmp_path / "atlas.json"))
    assert window.pages.current_name == "stability"
    assert page.runs.result is not None
    again = page.runs.result.atlas
    assert (again.experiment, again.seed, again.machine) == (atlas.experiment, atlas.seed, atlas.machine)
    for first, second in zip(atlas.maps, again.maps, strict=True):
        assert np.array_equal(first.outcome, second.outcome)
        assert np.array_equal(first.severity, second.severity, equal_nan=True)
    click(page, CellPlace(EXCLUSIVE, 0, 0))
    wait_for_case(page, qtbot)
    assert "pixels missing" in page.case.verdict.text(), "the remark comes of a new run"


def test_an_atlas_of_an_unknown_experiment_is_shown_and_not_run(
    page: StabilityPage, qtbot: QtBot, tmp_path: Path
) -> None:
    run(page, qtbot)
    page.export_to(str(tmp_path / "atlas.json"))
    record = json.loads((tmp_path / "atlas.json").read_text())
    record["experiment"], record["title"] = "gone", "An experiment of another version"
    (tmp_path / "atlas.json").write_text(json.dumps(record))
    page.open_path(str(tmp_path / "atlas.json"))
    assert page.experiments.currentItem().text() == "An experiment of another version"
    assert not page.controls.running.start_button.isEnabled()
    click(page, CellPlace(EXCLUSIVE, 0, 0))
    assert "no such experiment" in page.case.verdict.text()


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        (lambda record: record.update(version=2), "it is of version 2, and this Rasterscope opens version 1"),
        (lambda record: record.update(program="another"), "it is not an atlas of Rasterscope"),
        (lambda record: record["maps"][0]["outcome"].pop(), "maps must have"),
        (lambda record: record["maps"][0]["outcome"][0].__setitem__(0, 99), "outcomes must be below"),
        (lambda record: record["outcomes"].__setitem__(0, "perfect"), "an outcome must be one of"),
        (lambda record: record["axes"][0].pop("unit"), "unit"),
    ],
)
def test_a_broken_atlas_is_refused_with_a_sentence(tmp_path: Path, change: object, wanted: str) -> None:
    info = experiments.get("shared-edges").info
    axes = tuple(Axis(a.name, a.title, a.unit, a.values[:1], a.is_logarithmic) for a in info.axes)
    record = json.loads(atlas_json(stress("shared-edges", axes=axes)))
    assert callable(change)
    change(record)
    (tmp_path / "broken.json").write_text(json.dumps(record))
    with pytest.raises(AtlasFileError, match=r"^broken\.json cannot be opened: ") as refused:
        load_atlas(tmp_path / "broken.json")
    assert wanted in str(refused.value)


def test_a_study_still_opens_on_the_compare_page(window: MainWindow, tmp_path: Path) -> None:
    (tmp_path / "study.json").write_text('{"program": "rasterscope study", "version": 1}')
    window.open_path(str(tmp_path / "study.json"))
    assert window.pages.current_name == "compare"


def test_cells_grow_with_the_type(window: MainWindow, page: StabilityPage, qtbot: QtBot) -> None:
    run(page, qtbot)
    window.look.set_theme("presenter")
    QApplication.processEvents()
    assert page.maps.canvas.cell_area(CellPlace(EXCLUSIVE, 0, 0)).width() >= 24
