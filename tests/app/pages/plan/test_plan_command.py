"""``rasterscope plan`` as a user types it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.files.open_any import open_any
from core.study.planner.planning import plan
from core.study.planner.records import Tolerance
from core.study.planner.trials import difference, shown
from tests.app.cli.cli_runs import refused, run_program
from tests.covering import in_turn, is_everything


def test_a_scene_is_planned_and_measured() -> None:
    run = run_program("plan", "cube", "--size", "48x48", "--tolerance", "8", "--rounds", "1")
    assert run.returncode == 0, run.stderr
    assert run.stderr == ""
    for word in (
        "setting",
        "instead of",
        "antialiasing",
        "shading: ",
        "Largest ratio of w",
        "Within the tolerance",
    ):
        assert word in run.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "FILE"),
        (("cube", "--tolerance", "300"), "tolerance color must be from 0 to 255, got 300"),
        (("cube", "--pixels", "-1"), "tolerance pixels must be a whole number from 0 on, got -1"),
    ],
)
def test_what_is_wrong_is_told(arguments: tuple[str, ...], said: str) -> None:
    assert said in refused(2, "plan", *arguments)


MODELS, TOLERANCES = ["teapot", "spot", "suzanne"], [Tolerance(), Tolerance(8, 400), Tolerance.exact()]


@pytest.mark.parametrize(("name", "tolerance"), in_turn(MODELS, TOLERANCES))
def test_plans_of_the_models_beside_the_project_hold(
    name: str, tolerance: Tolerance, shared_folder: Path
) -> None:
    side = 72 if is_everything() else 48
    scene = replace(open_any(str(shared_folder / "meshes" / f"{name}.obj")).document.scene, size=(side, side))
    chosen = plan(scene, tolerance)
    differences = difference(shown(scene, chosen.settings), shown(scene, chosen.everything))
    assert np.count_nonzero(differences > tolerance.bytes) <= tolerance.pixels
    assert chosen.settings != chosen.everything
