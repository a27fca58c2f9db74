"""Every run of an experiment that fails opens in the stepper, at the pixel where it goes wrong."""

import numpy as np
import pytest

from app.session.document import document_at
from core.study.record import Outcome
from core.study.stability import COVERAGE_EXPERIMENTS, experiments

CASES = [
    pytest.param(experiment.info.name, method, marks=marks)
    for experiment in COVERAGE_EXPERIMENTS
    for method, marks in zip(experiment.info.methods, ((), pytest.mark.slow), strict=False)
]


@pytest.mark.parametrize(("name", "method"), CASES)
def test_a_failing_cell_can_be_stepped(name: str, method: str) -> None:
    experiment = experiments.get(name)
    source = np.random.default_rng(5)
    for _ in range(60):
        place = tuple(float(source.choice(axis.values)) for axis in experiment.info.axes)
        if experiment.run(method, place, 0).outcome != Outcome.RIGHT:
            break
    opening = experiment.opening(method, place, 0)
    family, _, chosen = method.split()[0].partition("=")
    assert getattr(opening.settings, family) == chosen
    document = document_at(opening, experiment.info.title)
    stage = document.make_trace().stage(opening.stage)
    if opening.settings.polygon_mode == "wireframe":
        assert stage.steps.row_count > 0
    if opening.pixel is not None:
        first_column, first_row, end_column, end_row = document.make_trace().source.raster.bounds
        assert first_column <= opening.pixel[0] < end_column
        assert first_row <= opening.pixel[1] < end_row
