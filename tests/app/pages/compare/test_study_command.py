"""``rasterscope study`` as a user types it."""

from pathlib import Path

import pytest

from app.pages.compare.study_files import load_study
from app.pages.stability.atlas_files import load_atlas
from core.study.families import study_families
from tests.app.cli.cli_runs import refused, run_program

QUICK = ("--rounds", 1, "--no-growth")


def test_a_family_is_measured_printed_and_written(tmp_path: Path) -> None:
    run = run_program("study", "cull", "--dial", "rings=4", *QUICK, "-o", tmp_path)
    assert run.returncode == 0, run.stderr
    assert run.stderr == ""
    study = load_study(tmp_path / "study-cull-closed.json")
    assert study.dials == {"rings": 4.0}
    for point in study.points:
        assert point.method in run.stdout
    assert "* on the Pareto front" in run.stdout
    assert study.machine["rasterscope"] in run.stdout
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".csv", ".json", ".png", ".svg"]


def test_a_study_is_mapped_over_a_dial_and_opens_again_with_its_times(tmp_path: Path) -> None:
    run = run_program("study", "cull", "--map", "rings", "-o", tmp_path)
    assert run.returncode == 0, run.stderr
    assert "across: Rings of the sphere" in run.stdout
    atlas = load_atlas(tmp_path / "stress-cull-closed.json")
    assert [axis.name for axis in atlas.experiment.axes] == ["rings"]
    for each in atlas.maps:
        assert each.outcome.shape == each.seconds.shape == (1, 7)
        assert (each.seconds > 0).all()


def test_the_pipeline_takes_a_scene_and_settings(tmp_path: Path) -> None:
    run = run_program(
        *(
            "study",
            "pipeline",
            "--scene",
            "shared-edge",
            "--set",
            "shading=flat",
            "--dial",
            "scale=0.5",
            *QUICK,
        ),
        *("-o", tmp_path),
    )
    assert run.returncode == 0, run.stderr
    study = load_study(tmp_path / "study-pipeline-scene.json")
    assert study.scene == "Two triangles sharing an edge"
    assert study.settings.shading == "flat"
    assert "fill_rule=inclusive" in run.stdout


def test_the_list_names_every_family_and_work() -> None:
    text = run_program("study", "--list").stdout
    for family in study_families():
        assert f"\n{family.name} " in f"\n{text}"
        for work in family.works:
            assert f"--work {work.name}" in text


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "FAMILY is required; --list shows all"),
        (["colour"], "family must be one of line, fill"),
        (["fill", "--work", "circles"], "work of fill must be one of triangles"),
        (["fill", "--dial", "size"], "must be NAME=NUMBER such as size=64, got size"),
        (["fill", "--dial", "size=1e9"], "size must be from 2 to 256"),
        (["fill", "--rounds", "0"], "must be a whole number from 1 to 1000, got 0"),
        (["fill", "--seed", "x"], "must be a whole number from 0"),
        (["fill", "--error", "none"], "error of fill must be one of misclassified, cracks, got none"),
        (["fill", "--map", "angle"], "axes of triangles must be one or two of size, got angle"),
        (["fill", "--scene", "cube"], "--scene and --set are for pipeline"),
        (["fill", "-o", "no such folder"], "there is no folder no such folder"),
        (["pipeline", "--set", "fill=magic"], "fill must be one of"),
    ],
)
def test_wrong_usage_is_one_line(arguments: list[str], words: str) -> None:
    assert words in refused(2, "study", *arguments)
