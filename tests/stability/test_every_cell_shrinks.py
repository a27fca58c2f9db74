"""No kind of failing cell is left out: of every experiment that shrinks, for every method that fails, a cell does."""

import numpy as np
import pytest

from core import ClipScene
from core.scene import AnyScene
from core.study.family import settings_of
from core.study.record import Outcome
from core.study.stability import experiments
from core.study.stress import shrink_cell
from tests.stability.failing_cells import FAILING_CELLS
from tests.stability.shrunk_tests import run_test

FEW_RUNS = 10
"""Enough to see that it gets smaller; other tests go to the end."""


def triangle_count(scene: AnyScene) -> int:
    return len(scene.clip) if isinstance(scene, ClipScene) else sum(len(m.triangles) for m in scene.meshes)


def test_every_experiment_has_a_failing_cell_that_shrinks() -> None:
    assert list(dict.fromkeys(name for name, _, _ in FAILING_CELLS)) == [
        name for name in experiments.names if experiments.get(name).can_shrink
    ]


@pytest.mark.parametrize(
    ("name", "method", "place"),
    [
        pytest.param(*cell, id=f"{cell[0]}-{cell[1]}", marks=[pytest.mark.slow] if number % 6 else [])
        for number, cell in enumerate(FAILING_CELLS)
    ],
)
def test_a_failing_cell_gets_smaller_and_fails_alike(name: str, method: str, place: tuple) -> None:
    experiment = experiments.get(name)
    before, settings = experiment.case(method, place, 0)
    outcome = experiment.run(method, place, 0).outcome
    assert outcome not in (Outcome.RIGHT, Outcome.REFUSED)
    shrunk = shrink_cell(name, method, place, most_runs=FEW_RUNS)
    assert shrunk.verdict.outcome == outcome
    assert experiment.judge(shrunk.scene, shrunk.settings) == shrunk.verdict
    assert shrunk.settings == settings == settings_of(settings, method)
    assert triangle_count(shrunk.scene) <= triangle_count(before)
    assert np.prod(shrunk.scene.size) <= np.prod(before.size)
    if shrunk.pixel is not None:
        assert (np.array(shrunk.pixel) < shrunk.scene.size).all()
    with pytest.raises(AssertionError):
        run_test(shrunk.test)
