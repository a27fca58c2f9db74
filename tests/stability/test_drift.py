"""Sums that drift, and sums that do not."""

import numpy as np
import pytest

from core import draw_lines
from core.coverage.measured_sums import long_line
from core.study.record import Outcome
from core.study.stability import experiments
from core.trace import trace
from tests.covering import every_nth
from tests.stability.maps import is_right_everywhere, outcomes

LONG = (4096.0, 8192.0)
STEADY = (
    "coverage=float64 fill=incremental",
    "coverage=snapped fill=incremental",
    "coverage=int64 fill=incremental",
)


@pytest.mark.slow
def test_sums_in_float32_drift_where_values_in_float32_do_not() -> None:
    experiment = experiments.get("incremental-drift")
    rises = experiment.info.axes[1].values
    drifted = {
        method: sum(experiment.run(method, (LONG[1], rise), 0).severity for rise in rises)
        for method in ("coverage=float32 fill=incremental", "coverage=float32")
    }
    assert drifted["coverage=float32"] == 0
    assert drifted["coverage=float32 fill=incremental"] > 10


def test_sums_in_float16_drift_at_once() -> None:
    experiment = experiments.get("incremental-drift")
    assert experiment.run("coverage=float16 fill=incremental", (128.0, 3.3), 0).outcome != Outcome.RIGHT
    assert experiment.run("coverage=float16 fill=incremental", (8192.0, 3.3), 0).outcome == Outcome.OVERFLOW


@pytest.mark.parametrize("method", STEADY)
def test_float64_and_whole_numbers_do_not_drift(method: str) -> None:
    experiment = experiments.get("incremental-drift")
    source = np.random.default_rng(11)
    for length, rise in [
        (2048.0, 3.3),
        *zip(source.integers(20, 1000, 6), source.uniform(0.5, 7, 6), strict=True),
    ]:
        assert experiment.run(method, (float(length), float(rise)), 0).outcome == Outcome.RIGHT


def test_slopes_added_in_float32_drift_over_thousands_of_columns() -> None:
    found = outcomes("line-drift", "line=dda-float32", every=2)
    assert {outcome for (length, _), outcome in found.items() if length < 1000} == {Outcome.RIGHT}
    assert sum(outcome != Outcome.RIGHT for (length, _), outcome in found.items() if length > 4000) > 4


@pytest.mark.parametrize(
    "method", every_nth(["line=bresenham", "line=midpoint", "line=dda", "line=bresenham-float"], 2)
)
def test_other_lines_take_a_nearest_pixel(method: str) -> None:
    assert is_right_everywhere("line-drift", method, every=4)


def test_a_drifted_line_opens_where_it_goes_wrong() -> None:
    place = (4096.0, 0.8)
    experiment = experiments.get("line-drift")
    assert experiment.run("line=dda-float32", place, 0).outcome == Outcome.WRONG_PICTURE
    opened = experiment.opening("line=dda-float32", place, 0)
    column, row = opened.pixel
    part = trace(opened.scene, opened.settings, 0, (column - 4, row - 4, 8, 8)).stage("raster")
    assert [column, row] in part.pixel.tolist()
    drawn = draw_lines(long_line(place)[None], *opened.scene.size, "bresenham").pixels
    assert [column, row] not in drawn.tolist()


@pytest.mark.slow
def test_added_inverse_slopes_round_another_way_and_closed_forms_do_not() -> None:
    found = outcomes("inverse-slopes", "fill=scanline-lecture")
    assert Outcome.WRONG_PICTURE in found.values()
    assert Outcome.RIGHT in found.values()
    assert is_right_everywhere("inverse-slopes", "fill=scanline", every=2)
