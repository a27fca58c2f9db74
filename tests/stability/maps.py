"""What the tests of the experiments share: cells of a method by outcome, and runs at random places."""

from itertools import product

import numpy as np

from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import is_everything


def outcomes(name: str, method: str, seed: int = 0, every: int = 1) -> dict[tuple[float, ...], Outcome]:
    """Run a method at every place of an experiment, or every n-th of each axis, the first and the last included."""
    experiment = experiments.get(name)
    axes = [sorted({*axis.values[::every], axis.values[-1]}) for axis in experiment.info.axes]
    return {place: experiment.run(method, place, seed).outcome for place in product(*axes)}


def is_right_everywhere(name: str, method: str, every: int = 1) -> bool:
    """Tell whether a method fails nowhere on the grid, of which every day each second place is tried."""
    every = every if is_everything() else 2 * every
    return set(outcomes(name, method, every=every).values()) == {Outcome.RIGHT}


def random_places(name: str, count: int, seed: int) -> list[tuple[float, ...]]:
    """Return places between the values of the axes, at random; of logarithmic ones by their logarithm."""
    source = np.random.default_rng(seed)
    columns = []
    for axis in experiments.get(name).info.axes:
        low, high = axis.values[0], axis.values[-1]
        if axis.is_logarithmic:
            columns.append(np.exp2(source.uniform(np.log2(low), np.log2(high), count)))
        else:
            columns.append(source.uniform(low, high, count))
    return list(zip(*(column.tolist() for column in columns), strict=True))


def wrong_at_random(name: str, method: str, count: int = 40) -> list[tuple[float, ...]]:
    """Return the random places at which a method is not right."""
    experiment = experiments.get(name)
    places = random_places(name, count, 7)[:: 1 if is_everything() else 3]
    return [
        place
        for number, place in enumerate(places)
        if experiment.run(method, place, number).outcome != Outcome.RIGHT
    ]
