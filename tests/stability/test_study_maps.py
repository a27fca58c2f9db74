"""Maps of studies: error and time of every method at all values of a dial."""

from dataclasses import replace

import numpy as np
import pytest

from core.study.families import study_family
from core.study.record import Outcome, Verdict, judged
from core.study.stability import stress, study_experiment
from core.study.stress import shrink_cell

ANGLES = study_experiment(study_family("coverage"), ("angle",), "slivers")


@pytest.mark.slow
def test_speed_and_accuracy_of_number_formats_over_the_angle_of_slivers() -> None:
    (angle,) = ANGLES.info.axes
    assert angle.values == (0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8)
    atlas = stress(ANGLES, axes=(replace(angle, values=(0.05, 0.25, 4)),), with_times=True)
    maps = {each.method: each for each in atlas.maps}
    assert all(each.seconds.shape == (1, 3) and (each.seconds > 0).all() for each in atlas.maps)
    assert maps["coverage=exact"].count(Outcome.RIGHT) == 3
    snapped = maps["coverage=snapped"]
    assert snapped.count(Outcome.WRONG_PICTURE) > 0
    assert (snapped.severity[0, :2] > 0).all()
    assert snapped.remark(0, 0) == f"misclassified {snapped.severity[0, 0]:.4g}"


def test_every_error_with_a_number_decides_or_the_one_that_is_named() -> None:
    found = judged({"ulp": 0.0, "decisions": 333.0, "cracks": "No mesh."}, tolerance=4.0)
    assert found.verdict == Verdict(Outcome.WRONG_PICTURE, 333.0, "ulp 0, decisions 333")
    assert judged({"ulp": 3.0, "far": 9.0}, "ulp", 4.0).verdict.outcome == Outcome.RIGHT
    assert judged({"cracks": "No mesh."}).verdict.remark == "No mesh."


def test_a_cell_of_a_study_opens_and_is_not_made_smaller() -> None:
    opened = ANGLES.opening("coverage=snapped", (0.05,), 0)
    assert opened.pixel is not None
    with pytest.raises(ValueError, match="nothing of coverage-slivers can be made smaller"):
        shrink_cell(ANGLES, "coverage=snapped", (0.05,))


def test_what_is_not_an_axis_stays_and_is_named() -> None:
    walls = study_experiment(study_family("depth"), ("far", "gap"), dials={"side": 32})
    assert walls.question.endswith("Side of the picture: 32 pixels.")
    assert walls.run("depth=z-16", (1e4, 1e-5), 0).outcome == Outcome.WRONG_ORDER
    assert walls.run("depth=reversed-z", (1e4, 1e-5), 0).outcome == Outcome.RIGHT


def test_a_refused_run_has_no_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("core.study.frame_task.MOST_TESTS", 1000)
    fills = study_experiment(study_family("fill"), ("size",))
    assert fills.run("fill=brute-force", (2.0,), 1).outcome == Outcome.REFUSED
    assert np.isnan(fills.time("fill=brute-force", (2.0,), 1))


@pytest.mark.parametrize("across", [(), ("size",), ("angle", "angle")])
def test_other_axes_are_refused(across: tuple[str, ...]) -> None:
    with pytest.raises(ValueError, match="axes of slivers must be one or two of angle, got"):
        study_experiment(study_family("fill"), across, "slivers")
