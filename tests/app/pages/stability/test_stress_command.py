"""``rasterscope stress`` as a user types it."""

import csv
import json
from pathlib import Path

import pytest
from PIL import Image
from PySide6.QtWidgets import QApplication

from app.export.failures import MARKS, WORDS, atlas_text
from app.export.sheet import sheet_bytes
from app.files.state_files import load_state
from app.pages.stability.atlas_files import atlas_csv, atlas_json, atlas_sheet
from core.study.record import Axis, Outcome
from core.study.stability import experiments, stress
from tests.app.cli.cli_runs import refused, run_program

QUICK = (Axis("offset", "Distance of the centre from the edge", "pixels", (2.0**-12, 2.0**-4), True),)


@pytest.fixture(scope="module")
def atlas():
    return stress("precision-dial", axes=QUICK, machine={"processor": "abacus"})


def test_an_experiment_is_run_printed_and_written(tmp_path: Path) -> None:
    run = run_program("stress", "zero-length-segments", "-o", tmp_path)
    assert run.returncode == 0, run.stderr
    assert run.stderr == ""
    info = experiments.get("zero-length-segments").info
    for words in (info.title, info.question, info.claim, *info.methods):
        assert words in run.stdout
    assert "    ......2......" in run.stdout
    assert "line_clipping=exact               169 right" in run.stdout
    stem = tmp_path / "stress-zero-length-segments"
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".csv", ".json", ".png", ".svg"]
    with Image.open(stem.with_suffix(".png")) as picture:
        assert picture.size[0] == 2200
    assert json.loads(stem.with_suffix(".json").read_text())["machine"]["rasterscope"] in run_version()


def run_version() -> str:
    return run_program("--version").stdout


def test_a_failing_cell_is_made_small_and_written(tmp_path: Path) -> None:
    run = run_program("stress", "shared-edges", "--shrink", "fill_rule=inclusive", "-o", tmp_path)
    assert run.returncode == 0, run.stderr
    assert "2 triangles in 1x1 pixels" in run.stdout
    test = tmp_path / "test_shared_edges_inclusive.py"
    assert test.read_text() in run.stdout
    state, warnings = load_state(tmp_path / "shared-edges-inclusive.rasterscope")
    assert warnings == ()
    assert state.document.scene.size == (1, 1)
    assert state.document.settings.fill_rule == "inclusive"
    assert state.pin == (0, 0)


@pytest.mark.parametrize(
    ("name", "method", "words", "stage"),
    [
        ("line-drift", "line=dda-float32", "1 segment in", "raster"),
        pytest.param(
            *("minification", "texture_filter=nearest", "1 triangle in 1x1 pixels", "shade"),
            marks=pytest.mark.slow,
        ),
        pytest.param(
            *("lost-highlight", "shading=flat", "1 triangle in 1x1 pixels", "shade"), marks=pytest.mark.slow
        ),
    ],
)
def test_segments_textures_and_lit_meshes_are_made_small_and_open_again(
    name: str, method: str, words: str, stage: str, tmp_path: Path
) -> None:
    run = run_program("stress", name, "--shrink", method, "-o", tmp_path)
    assert run.returncode == 0, run.stderr
    assert words in run.stdout
    title = f"{name}-{method.partition('=')[2]}"
    assert (tmp_path / f"test_{title.replace('-', '_')}.py").read_text() in run.stdout
    state, warnings = load_state(tmp_path / f"{title}.rasterscope")
    assert warnings == ()
    assert (state.stage, state.pin is None) == (stage, False)
    # What the file holds still fails, in the same bits.
    verdict = experiments.get(name).judge(state.document.scene, state.document.settings)
    assert verdict.outcome == Outcome.WRONG_PICTURE
    assert verdict.remark in run.stdout


def test_a_method_that_never_fails_has_nothing_to_shrink() -> None:
    run = run_program("stress", "zero-length-segments", "--shrink", "line_clipping=exact")
    assert run.returncode == 0
    assert run.stdout == "line_clipping=exact does not fail anywhere in zero-length-segments.\n"


def test_the_list_names_every_experiment() -> None:
    text = run_program("stress", "--list").stdout
    for experiment in experiments:
        assert f"\n{experiment.info.name} " in f"\n{text}"
        assert experiment.info.claim in text


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "EXPERIMENT is required; --list shows all"),
        (["earthquake"], "experiment must be one of precision-dial, slivers"),
        (["slivers", "-o", "no such folder"], "there is no folder no such folder"),
        (["slivers", "--shrink", "coverage=decimal"], "--shrink takes a method of slivers: coverage=float16"),
        (["slivers", "--seed", "x"], "must be a whole number from 0"),
    ],
)
def test_wrong_usage_is_one_line(arguments: list[str], words: str) -> None:
    assert words in refused(2, "stress", *arguments)


def test_every_outcome_has_its_own_mark_and_words() -> None:
    assert set(MARKS) == set(WORDS) == set(Outcome)
    assert len(set(MARKS.values())) == len(Outcome)
    assert all(len(mark) == 1 for mark in MARKS.values())


def test_the_map_of_a_method_is_printed_from_the_top(atlas) -> None:
    lines = atlas_text(atlas)
    assert lines[lines.index("coverage=snapped") + 1] == "    o."
    assert lines[lines.index("coverage=float32") + 1] == "    .."
    assert any(line.startswith("coverage=snapped") and "1 right, 1 hole" in line for line in lines)


def test_every_cell_is_in_the_table(atlas) -> None:
    rows = list(csv.DictReader(atlas_csv(atlas).splitlines()))
    assert len(rows) == 2 * len(atlas.maps)
    found = {(row["method"], float(row["offset"])): row for row in rows}
    lost = found["coverage=snapped", 2.0**-12]
    assert lost["outcome"] == "hole"
    assert float(lost["severity"]) >= 1
    assert lost["remark"] == "8 of 4,096 pixels missing, 0 drawn too often"
    assert lost["processor"] == "abacus"
    assert found["coverage=exact", 2.0**-12]["outcome"] == "right"


def test_times_are_in_text_table_and_json_only_where_they_were_taken(atlas) -> None:
    timed = stress("precision-dial", axes=QUICK, with_times=True)
    assert not atlas.maps[0].seconds.size
    assert timed.maps[0].seconds.shape == (1, 2)
    assert (timed.maps[0].seconds > 0).all()
    rows = list(csv.DictReader(atlas_csv(timed).splitlines()))
    assert [float(row["seconds"]) for row in rows[:2]] == timed.maps[0].seconds[0].tolist()
    assert json.loads(atlas_json(timed))["maps"][0]["seconds"] == timed.maps[0].seconds.tolist()
    assert "seconds" not in atlas_csv(atlas) + atlas_json(atlas)
    assert "s a run" in "\n".join(atlas_text(timed))
    assert "s a run" not in "\n".join(atlas_text(atlas))


def test_everything_is_in_the_json(atlas) -> None:
    found = json.loads(atlas_json(atlas))
    assert found["experiment"] == "precision-dial"
    assert found["axes"][0]["values"] == [2.0**-12, 2.0**-4]
    for each, saved in zip(atlas.maps, found["maps"], strict=True):
        assert saved["method"] == each.method
        assert saved["outcome"] == each.outcome.tolist()
        assert saved["severity"] == each.severity.tolist()
        assert saved["remarks"] == [[each.remark(column, 0) for column in range(2)]]


def test_the_drawing_names_every_method_and_outcome(atlas, qapp: QApplication) -> None:
    words = sheet_bytes(lambda: atlas_sheet(atlas), ".svg").decode()
    seen = {Outcome(value) for each in atlas.maps for value in each.outcome.ravel().tolist()}
    for shown in (atlas.experiment.title, "abacus", *(WORDS[outcome] for outcome in seen)):
        assert shown in words
    for each in atlas.maps:
        assert f">{each.method.partition('=')[2]}<" in words
    assert "<image" not in words, "cells are squares and characters"
