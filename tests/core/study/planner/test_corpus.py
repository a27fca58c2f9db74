"""On generated scenes every plan stays within its tolerance and its predictions, whatever the tolerance."""

import numpy as np
import pytest

from core.study import Plan, Tolerance, plan, plan_and_check
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.corpus import KINDS, corpus_scene
from core.study.planner.measuring import difference, shown

SCENES = 210
PARTS = 7
TOLERANCES = (
    Tolerance(),
    Tolerance.exact(),
    Tolerance(8),
    Tolerance(2, 100),
    Tolerance(32, 20),
    Tolerance(2, 2000),
)


def tolerance_of(seed: int) -> Tolerance:
    """Return a tolerance so that every kind of scene meets all of them."""
    return TOLERANCES[(seed + seed // len(KINDS)) % len(TOLERANCES)]


def check(seed: int) -> Plan:
    """Plan a scene, and compare the picture with everything on."""
    _, scene = corpus_scene(seed)
    tolerance = tolerance_of(seed)
    chosen = plan(scene, tolerance, costs=LectureOrder())
    differences = difference(shown(scene, chosen.settings), shown(scene, chosen.everything))
    assert np.count_nonzero(differences > tolerance.bytes) <= tolerance.pixels, (seed, tolerance)
    assert np.count_nonzero(differences > np.ceil(chosen.predicted_error)) <= chosen.predicted_pixels, (
        seed,
        tolerance,
    )
    assert chosen.predicted_error <= tolerance.color
    assert chosen.predicted_pixels <= tolerance.pixels
    return chosen


@pytest.mark.parametrize("part", range(PARTS))
def test_generated_scenes_stay_within_the_tolerance(part: int) -> None:
    plans = [check(seed) for seed in range(part, SCENES, PARTS)]
    assert sum(each.settings != each.everything for each in plans) > len(plans) // 2


@pytest.mark.parametrize("seed", range(8))
def test_the_prediction_of_every_single_decision_holds(seed: int) -> None:
    report = plan_and_check(corpus_scene(seed)[1], tolerance_of(seed), rounds=1)
    assert report.is_within
    assert report.fallen_back == ()
    assert all(outcome.is_right for outcome in report.outcomes), [each.text for each in report.outcomes]
    assert len(report.seconds_everything) == len(report.seconds_chosen) == 1
