"""A study as JSON, CSV and charts: what is written is what was measured, and it opens again."""

import csv
import io
import json
import re
from dataclasses import fields, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

from app.pages.compare import study_files
from app.pages.words import digits, time_text
from core import Settings
from core.study.record import Axis, ErrorMeasure, Point, Study, WorkKind, machine, pareto_front
from core.study.speed_accuracy import measure
from widgets.basics.theme import DARK, LIGHT, current_theme, paint_as
from widgets.experiments.chart import Chart


@pytest.fixture(scope="module")
def study() -> Study:
    """One that has all that a study can have: growth, a refusal, an error that is not defined, several families."""
    seconds = [
        np.array([0.002, 0.0021, 0.0019]),
        np.array([0.004, 0.005, 0.0041]),
        np.array([0.001, 0.001, 0.001]),
    ]
    points = (
        Point("fill=spans", "Spans", seconds[0], 10, {"pixels tested": 0}, {"wrong": 0.0, "late": 3.5}),
        Point("fill=blocks", "Blocks", seconds[1], 10, {"pixels tested": 7}, {"wrong": 0.0, "late": 2.5}),
        Point(
            "coverage=float64",
            "<Float & 64>",
            seconds[2],
            10,
            {"bytes": 9},
            {"wrong": 12.25, "late": np.nan},
            {"late": "It has none."},
        ),
        Point("fill=brute-force", "Brute force", refused="It takes too long."),
    )
    dial = Axis("size", "Triangle size", "pixels", (2, 4, 8), default=4, is_cost=True)
    return Study(
        family="fill",
        title="Fills",
        work=WorkKind("triangles", "Random triangles", "triangle", (dial,)),
        dials={"size": 4.0},
        seed=3,
        measures=(ErrorMeasure("wrong", "Wrong pixels", "per million"), ErrorMeasure("late", "Late", "")),
        points=points,
        growth={2.0: points[:2], 4.0: points, 8.0: points[:1]},
        machine=machine("9.8.7"),
        settings=Settings(cull="back"),
    )


def field_values(record: Study | Point) -> dict:
    """Return what a record was made of, without what it has computed since."""
    return {field.name: getattr(record, field.name) for field in fields(record)}


def as_dict(study: Study) -> dict:
    found = field_values(study)
    found["growth"] = {
        value: [point_dict(point) for point in points] for value, points in study.growth.items()
    }
    found["points"] = [point_dict(point) for point in study.points]
    return found


def point_dict(point: Point) -> dict:
    return field_values(point) | {
        "seconds": point.seconds.tolist(),
        "errors": {k: repr(v) for k, v in point.errors.items()},
    }


def test_a_saved_study_opens_again(study: Study, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(study_files.study_json(study), encoding="utf-8")
    again = study_files.load_study(tmp_path / "a.json")
    assert as_dict(again) == as_dict(study)
    (tmp_path / "b.json").write_text(study_files.study_json(again), encoding="utf-8")
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_a_measured_study_opens_again(tmp_path: Path) -> None:
    measured = measure("cull", dials={"rings": 4}, rounds=1, grow=False, machine=machine("1"))
    (tmp_path / "a.json").write_text(study_files.study_json(measured), encoding="utf-8")
    assert as_dict(study_files.load_study(tmp_path / "a.json")) == as_dict(measured)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda found: found.pop("points"), "a.json cannot be opened: points is missing"),
        (lambda found: found.update(version=2), "it is of version 2, and this Rasterscope opens version 1"),
        (lambda found: found.update(program="rasterscope"), "it is not a study of Rasterscope"),
        (lambda found: found["settings"].update(fill="magic"), "settings: fill must be one of"),
        (lambda found: found["settings"].update(magic="fill"), "settings: setting must be one of"),
        (lambda found: found["points"][0].update(seconds=[-1.0]), "points.0.seconds.0 "),
        (lambda found: found.update(user="somebody"), "user is not a known field"),
    ],
)
def test_a_file_that_is_not_right_is_told_in_one_sentence(
    study: Study, tmp_path: Path, change, message: str
) -> None:
    path = tmp_path / "a.json"
    path.write_text(study_files.study_json(study), encoding="utf-8")
    found = json.loads(path.read_text())
    change(found)
    path.write_text(json.dumps(found))
    with pytest.raises(study_files.StudyFileError) as problem:
        study_files.load_study(path)
    assert message in str(problem.value)
    assert "\n" not in str(problem.value)


@pytest.mark.parametrize("content", [b"", b"{", b"[1]", b"\xff\xfe"])
def test_a_file_of_something_else_is_told(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(content)
    with pytest.raises(study_files.StudyFileError, match=r"a\.json cannot be opened: it is not a study"):
        study_files.load_study(path)
    with pytest.raises(study_files.StudyFileError, match="there is no file"):
        study_files.load_study(tmp_path / "none.json")


def test_the_table_has_the_numbers_of_the_study(study: Study) -> None:
    rows = list(csv.DictReader(io.StringIO(study_files.study_csv(study))))
    assert len(rows) == 4 + 2 + 1
    for row, point in zip(rows, study.points, strict=False):
        assert row["method"] == point.method
        assert row["dial_size"] == "4.0"
        assert row["setting_cull"] == "back"
        assert row["processor"] == study.machine["processor"]
        if not point.is_measured:
            assert row["refused"] == "It takes too long."
            assert row["median_seconds_per_unit"] == row["wrong"] == ""
            continue
        assert float(row["median_seconds_per_unit"]) == point.median
        assert float(row["least"]) == point.least
        assert (float(row["interval_low"]), float(row["interval_high"])) == point.interval
        for name, value in point.errors.items():
            assert row[name] == ("" if np.isnan(value) else repr(value))
        for name, count in point.counts.items():
            assert row[name] == str(count)
        assert row["on_front_wrong"] == str(int(point in pareto_front(study.points, "wrong")))
    assert rows[2]["not_defined"] == "late: It has none."
    assert [row["dial_size"] for row in rows[4:]] == ["2.0", "2.0", "8.0"]


def words_of(study: Study, measure: str | None = None) -> str:
    """Return all texts of the charts as one line."""
    svg = study_files.study_content(study, measure, ".svg")
    assert svg is not None
    return " ".join(
        node.text or "" for node in ElementTree.fromstring(svg).iter() if node.tag.endswith("text")
    )


def test_charts_name_everything(study: Study, qapp: QApplication) -> None:
    words = words_of(study)
    for needed in (
        "Spans",
        "Blocks",
        "<Float & 64>",
        "It takes too long.",
        "cull=back",
        "seed 3",
        "Pareto front",
    ):
        assert needed in words
    for name in ("processor", "python", "numpy", "rasterscope", "date"):
        assert study.machine[name] in words
    assert words.count("Time per triangle") == 2, "of the chart of errors, and of the chart of growth"


def test_charts_on_paper_are_those_of_the_page(study: Study, qapp: QApplication) -> None:
    with paint_as(LIGHT):
        sheet = study_files.study_sheet(study, study.measures[0])
    scatter, growth = (chart.picture for chart in sheet.findChildren(Chart))
    assert [float(series.y[0]) for series in scatter.series] == [0.0, 0.0, 12.25]
    assert scatter.front == ("coverage=float64", "fill=spans")
    assert [len(series.x) for series in growth.series] == [3, 2, 1]


def test_the_theme_of_the_window_does_not_change_a_file(study: Study, qapp: QApplication) -> None:
    light = study_files.study_content(study, None, ".svg")
    with paint_as(DARK):
        assert study_files.study_content(study, None, ".svg") == light
        assert current_theme() == DARK


def test_the_chart_of_another_error_says_what_is_left_out(study: Study, qapp: QApplication) -> None:
    assert "<Float & 64>. It has none." in words_of(study, "late")
    with pytest.raises(ValueError, match="error of fill must be one of wrong, late, got speed"):
        study_files.study_content(study, "speed", ".svg")


def test_a_study_without_numbers_has_an_empty_chart(study: Study, qapp: QApplication) -> None:
    assert "Every method refused this work" in words_of(replace(study, points=study.points[3:], growth={}))


def test_files_are_written_and_say_nothing_of_the_user(study: Study, tmp_path: Path, qapp) -> None:
    written = study_files.export_study(study, tmp_path)
    assert sorted(path.name for path in written) == [
        f"study-fill-triangles{ending}" for ending in (".csv", ".json", ".png", ".svg")
    ]
    for path in written:
        content = path.read_bytes()
        assert content
        assert str(tmp_path).encode() not in content
        assert str(Path.home()).encode() not in content
    png = next(path for path in written if path.suffix == ".png").read_bytes()
    assert png.startswith(b"\x89PNG")


def test_numbers_as_they_are_read() -> None:
    assert [time_text(value) for value in (2.0, 0.0123, 4.5e-6, 7e-9, 3e-10)] == [
        "2.00 s",
        "12.3 ms",
        "4.50 µs",
        "7.00 ns",
        "0.300 ns",
    ]
    assert [digits(value) for value in (0, 12345.6, 0.00123, 1e-9, np.nan)] == [
        "0",
        "12,346",
        "0.00123",
        "1.00e-09",
        "–",
    ]
    assert re.fullmatch(r"\d{4}-\d{2}-\d{2}", machine("1")["date"])
