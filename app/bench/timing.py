"""Time several calls fairly: in turn, in one process, warm, with the garbage collector off."""

import gc
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from core.study.accuracy.timing import collector_off

SHORT = 0.030
"""Seconds: a shorter call is warmed up in every round by one untimed call, and then timed more than once."""
SHORT_CALLS = 4


@dataclass(frozen=True)
class Times:
    """What was measured of one contender, in milliseconds."""

    median: float
    least: float
    lower_quartile: float
    upper_quartile: float
    count: int
    """Timed calls."""


def time_in_turn(calls: dict[str, Callable[[], object]], rounds: int) -> dict[str, Times]:
    """Call everything ``rounds`` times in turn and return the times by name.

    Every round begins with another contender, so that none always finds the caches as the same one left them.
    """
    seconds: dict[str, list[float]] = {name: [] for name in calls}
    names = list(calls)
    for turn in range(rounds):
        first = turn % max(len(names), 1)
        for name in names[first:] + names[:first]:
            gc.collect()
            with collector_off():
                seconds[name] += _time_round(calls[name])
    return {name: summary(values) for name, values in seconds.items()}


def _time_round(call: Callable[[], object]) -> list[float]:
    """Return the seconds of a long call, or of several short ones after an untimed one."""
    first = _seconds(call)
    if first >= SHORT:
        return [first]
    return [_seconds(call) for _ in range(SHORT_CALLS)]


def _seconds(call: Callable[[], object]) -> float:
    start = perf_counter()
    call()
    return perf_counter() - start


def summary(seconds: list[float]) -> Times:
    """Return the median and the spread of times in seconds."""
    least, lower, median, upper = np.percentile(np.array(seconds) * 1000, [0, 25, 50, 75]).tolist()
    return Times(median, least, lower, upper, len(seconds))
