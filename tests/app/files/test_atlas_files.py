"""Atlases of the Stability page as files: exported, opened again, of earlier versions, refused."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.pages.stability.atlas_files import AtlasFileError, atlas_json, load_atlas
from app.pages.stability.page import StabilityPage
from app.window.main_window import MainWindow
from core.study.record import Axis
from core.study.stability import experiments, stress
from tests.app.pages.stability import stability_pages
from widgets.experiments.maps import CellPlace


@pytest.fixture
def page(window: MainWindow) -> StabilityPage:
    return stability_pages.stability_page(window)


def test_an_atlas_is_exported_and_opened_again(
    window: MainWindow, page: StabilityPage, qtbot: QtBot, tmp_path: Path
) -> None:
    atlas = stability_pages.run(page, qtbot)
    for ending in ("json", "csv", "svg", "png", "pdf"):
        page.export_to(str(tmp_path / f"atlas.{ending}"))
    assert (tmp_path / "atlas.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "atlas.pdf").read_bytes().startswith(b"%PDF")
    rows = list(csv.DictReader((tmp_path / "atlas.csv").read_text().splitlines()))
    assert len(rows) == sum(each.outcome.size for each in atlas.maps)
    assert atlas.experiment.claim.split(". ")[0] in (tmp_path / "atlas.svg").read_text().replace("\n", " ")
    assert {row["date"] for row in rows} == {atlas.machine["date"]}
    page.choice.result = None
    window.pages.show_page("step")
    window.open_path(str(tmp_path / "atlas.json"))
    assert window.pages.current_name == "stability"
    again = page.choice.result.content
    assert (again.experiment, again.seed, again.machine) == (atlas.experiment, atlas.seed, atlas.machine)
    for first, second in zip(atlas.maps, again.maps, strict=True):
        assert np.array_equal(first.outcome, second.outcome)
        assert np.array_equal(first.severity, second.severity, equal_nan=True)
        assert first.remarks == second.remarks
        assert all(all(row) for row in first.remarks)
    said = next(each for each in again.maps if each.method == stability_pages.EXCLUSIVE).remark(0, 0)
    stability_pages.point_at(page, CellPlace(stability_pages.EXCLUSIVE, 0, 0))
    assert "pixels missing" in said
    assert said in page.readout.text()
    stability_pages.click(page, CellPlace(stability_pages.EXCLUSIVE, 0, 0))
    stability_pages.wait_for_case(page, qtbot)
    assert said in page.case.verdict.text(), "a new run says the same"


def test_an_atlas_of_before_there_were_remarks_opens(page: StabilityPage, tmp_path: Path) -> None:
    info = experiments.get("shared-edges").info
    axes = tuple(Axis(a.name, a.title, a.unit, a.values[:1], a.is_logarithmic) for a in info.axes)
    record = json.loads(atlas_json(stress("shared-edges", axes=axes)))
    for each in record["maps"]:
        del each["remarks"]
    (tmp_path / "old.json").write_text(json.dumps(record))
    page.open_path(str(tmp_path / "old.json"))
    assert page.choice.result.content.maps[0].remark(0, 0) == ""
    stability_pages.point_at(page, CellPlace(stability_pages.EXCLUSIVE, 0, 0))
    assert "Outcome" in page.readout.text()


def test_an_atlas_of_an_unknown_experiment_is_shown_and_not_run(
    page: StabilityPage, qtbot: QtBot, tmp_path: Path
) -> None:
    stability_pages.run(page, qtbot)
    page.export_to(str(tmp_path / "atlas.json"))
    record = json.loads((tmp_path / "atlas.json").read_text())
    record["experiment"], record["title"] = "gone", "An experiment of another version"
    (tmp_path / "atlas.json").write_text(json.dumps(record))
    page.open_path(str(tmp_path / "atlas.json"))
    assert page.entries.currentItem().text() == "An experiment of another version"
    assert not page.controls.start_button.isEnabled()
    stability_pages.click(page, CellPlace(stability_pages.EXCLUSIVE, 0, 0))
    assert "no such experiment" in page.case.verdict.text()


@pytest.mark.parametrize(
    ("change", "wanted"),
    [
        (lambda record: record.update(version=2), "it is of version 2, and this Rasterscope opens version 1"),
        (lambda record: record.update(program="another"), "it is not an atlas of Rasterscope"),
        (lambda record: record["maps"][0]["outcome"].pop(), "maps must have"),
        (lambda record: record["maps"][0]["remarks"][0].pop(), "maps must have"),
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


@pytest.mark.slow
def test_a_study_still_opens_on_the_compare_page(window: MainWindow, tmp_path: Path) -> None:
    (tmp_path / "study.json").write_text('{"program": "rasterscope study", "version": 1}')
    window.open_path(str(tmp_path / "study.json"))
    assert window.pages.current_name == "compare"
