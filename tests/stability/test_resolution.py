"""Coarser and finer grids of an experiment."""

import pytest

from core.study.record import Axis
from core.study.stability import experiments
from core.study.stress import axes_at


def values(axis: Axis, resolution: str) -> tuple[float, ...]:
    return axes_at((axis,), resolution)[0].values


def test_coarse_leaves_every_other_value_and_both_ends() -> None:
    assert values(Axis("a", "A", "", (1.0, 2.0, 3.0, 4.0, 5.0)), "coarse") == (1, 3, 5)
    assert values(Axis("a", "A", "", (1.0, 2.0, 3.0, 4.0)), "coarse") == (1, 3, 4)
    assert values(Axis("a", "A", "", (1.0, 2.0, 3.0)), "coarse") == (1, 2, 3)


def test_fine_puts_a_middle_between_two_values() -> None:
    assert values(Axis("a", "A", "", (0.5, 1.0)), "fine") == (0.5, 0.75, 1)
    assert values(Axis("a", "A", "", (0.25, 1.0), True), "fine") == (0.25, 0.5, 1)


def test_between_whole_numbers_only_whole_numbers() -> None:
    assert values(Axis("a", "A", "", (1.0, 2.0, 4.0)), "fine") == (1, 2, 3, 4)
    assert values(Axis("a", "A", "", (4.0, 16.0), True), "fine") == (4, 8, 16)


@pytest.mark.parametrize("name", experiments.names)
def test_every_experiment_takes_the_values_between(name: str) -> None:
    experiment = experiments.get(name)
    axes = axes_at(experiment.info.axes, "fine")
    for axis in axes:
        assert list(axis.values) == sorted(set(axis.values))
    place = tuple(axis.values[1] for axis in axes)
    experiment.run(experiment.info.methods[-1], place, 0)


def test_another_resolution_is_refused() -> None:
    with pytest.raises(ValueError, match="resolution must be one of coarse, normal, fine, got finest"):
        axes_at((), "finest")
