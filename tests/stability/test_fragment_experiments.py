"""What holds for every experiment on fragments: sentences, repeatable runs, openings at a wrong pixel."""

import numpy as np
import pytest

from core.pipeline import render
from core.settings import Settings
from core.study.family import settings_of
from core.study.record import Axis, Outcome
from core.study.stability import FRAGMENT_EXPERIMENTS, experiments, stress
from tests.covering import every_nth, is_everything

NAMES = [experiment.info.name for experiment in FRAGMENT_EXPERIMENTS]


def random_place(axes: tuple[Axis, ...], seed: int) -> tuple[float, ...]:
    source = np.random.default_rng(seed)
    return tuple(float(source.choice(axis.values)) for axis in axes)


@pytest.mark.parametrize("name", every_nth(NAMES, 4))
def test_weak_methods_fail_somewhere_and_the_last_holds_there(name: str) -> None:
    info = experiments.get(name).info
    ends = tuple(
        Axis(axis.name, axis.title, axis.unit, (axis.values[0], axis.values[-1]), axis.is_logarithmic)
        for axis in info.axes
    )
    maps = stress(name, axes=ends).maps
    assert [each.method for each in maps] == list(info.methods)
    failed = maps[0].outcome != Outcome.RIGHT
    assert failed.any()
    assert (maps[-1].outcome[failed] == Outcome.RIGHT).any()


@pytest.mark.parametrize("name", every_nth(NAMES, 4))
def test_runs_can_be_repeated_and_open_at_a_pixel_that_is_wrong(name: str) -> None:
    experiment = experiments.get(name)
    info = experiment.info
    for seed in (1, 10, 11) if is_everything() else (10,):
        place = random_place(info.axes, seed)
        for method in info.methods if is_everything() else (info.methods[0], info.methods[-1]):
            verdict, again = (experiment.run(method, place, seed) for _ in range(2))
            assert verdict.remark
            assert (verdict.outcome, verdict.remark) == (again.outcome, again.remark)
            opening = experiment.opening(method, place, seed)
            if verdict.outcome == Outcome.REFUSED:
                assert np.isnan(verdict.severity)
                assert opening is None
                continue
            assert verdict.severity >= 0
            assert opening.settings == settings_of(opening.settings, method)
            marked = experiment.work(place, seed).run(settings_of(experiment.base, method)).wrong.any()
            assert (opening.pixel is not None) == marked
            if verdict.outcome == Outcome.RIGHT or experiment.can_shrink:
                assert marked == (verdict.outcome != Outcome.RIGHT)
            if opening.pixel is not None:
                assert (np.array(opening.pixel) >= 0).all()
                assert (np.array(opening.pixel) < opening.scene.size).all()
        # The stepper draws it as it is.
        if opening is not None:
            assert render(opening.scene, opening.settings).color.shape[:2] == opening.scene.size[::-1]


@pytest.mark.parametrize("name", NAMES)
def test_claims_and_questions_are_sentences(name: str) -> None:
    info = experiments.get(name).info
    assert info.claim.endswith(".")
    assert info.question[-1] in ".?"
    assert 1 <= len(info.axes) <= 2
    assert len(set(info.methods)) == len(info.methods)
    for method in info.methods:
        settings_of(Settings(), method)
    for axis in info.axes:
        assert list(axis.values) == sorted(axis.values)
        assert not axis.is_logarithmic or axis.values[0] > 0
