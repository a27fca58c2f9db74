"""On generated scenes every plan stays within its tolerance and its predictions, and says why in sentences."""

import re

import numpy as np
import pytest

from core.methods import table
from core.study.planner.measuring import plan_and_check
from core.study.planner.planning import STAGES, plan
from core.study.planner.records import Plan, Tolerance
from core.study.planner.trials import Costs, difference, shown
from tests.core.study.planner.corpus import KINDS, corpus_scene

SCENES, ALL_SCENES = 7, 210
TOLERANCES = (
    Tolerance(),
    Tolerance.exact(),
    Tolerance(8),
    Tolerance(2, 100),
    Tolerance(32, 20),
    Tolerance(2, 2000),
)
CODED = {name for family in STAGES for name in table.names(family) if "-" in name}
"""Names of methods that are no words."""


def tolerance_of(seed: int) -> Tolerance:
    """Return a tolerance so that every kind of scene meets all of them."""
    return TOLERANCES[(seed + seed // len(KINDS)) % len(TOLERANCES)]


@pytest.fixture(scope="module")
def plans(request: pytest.FixtureRequest) -> list[Plan]:
    """Plan some scenes, or with --all many."""
    count = ALL_SCENES if request.config.getoption("--all") else SCENES
    return [plan(corpus_scene(seed)[1], tolerance_of(seed), costs=Costs()) for seed in range(count)]


def test_pictures_stay_within_the_tolerance_and_the_prediction(plans: list[Plan]) -> None:
    for seed, chosen in enumerate(plans):
        scene, tolerance = corpus_scene(seed)[1], chosen.tolerance
        differences = difference(shown(scene, chosen.settings), shown(scene, chosen.everything))
        assert np.count_nonzero(differences > tolerance.bytes) <= tolerance.pixels, seed
        assert np.count_nonzero(differences > chosen.predicted_error) <= chosen.predicted_pixels, seed
        assert chosen.predicted_error <= tolerance.color
        assert chosen.predicted_pixels <= tolerance.pixels
    assert sum(each.settings != each.everything for each in plans) > len(plans) // 2


def test_reasons_are_sentences_with_what_was_measured(plans: list[Plan]) -> None:
    for chosen in plans:
        assert tuple(each.setting for each in chosen.decisions) == STAGES
        for decision in chosen.decisions:
            assert re.fullmatch(r"[A-Z1-9].*\.", decision.reason), decision.reason
            assert not CODED & set(decision.reason.split()), decision.reason
            assert "e+" not in decision.reason
            assert "  " not in decision.reason
            if decision.predicted_error:
                assert f"{decision.predicted_error:g}/255 at most" in decision.reason
            assert not decision.is_needed or "kept." in decision.reason


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [0, pytest.param(2, marks=pytest.mark.slow), pytest.param(4, marks=pytest.mark.slow)]
)
def test_the_prediction_of_every_single_decision_holds(seed: int) -> None:
    report = plan_and_check(corpus_scene(seed)[1], tolerance_of(seed), rounds=1)
    assert report.is_within
    assert report.fallen_back == ()
    assert all(outcome.is_right for outcome in report.outcomes), [each.text for each in report.outcomes]
    assert len(report.seconds_everything) == len(report.seconds_chosen) == 1
