"""What timed blocks tell: the median with an interval that holds it, who is faster for sure, and when to stop.

A machine that does something else makes some blocks longer, and none shorter. So the blocks of all methods take turns;
the least time of a method stays what it was, the interval of its median grows, and two methods whose intervals overlap
are not told apart.

References
----------
W. J. Conover, *Practical Nonparametric Statistics*, 1971 (an interval of the median from ordered values).
"""

import gc
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import combinations
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from core.records.arrays import Floats

if TYPE_CHECKING:
    from core.study.accuracy.record import Point

CHANCE = 0.05
"""That the median lies outside its interval, at most, from six runs on."""
SURE = 6
"""Runs from which on an interval has that chance."""
CLOSE = 1.3
"""Ratio of two medians below which the order may stay open; fewer than `SURE` runs tell only larger ones apart."""


@contextmanager
def collector_off() -> Iterator[None]:
    """Keep the garbage collector from running in the block; afterwards it is as it was."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def median_interval(seconds: Floats) -> tuple[float, float]:
    """Return the narrowest pair of times (R,), equally far from both ends in order, that hold the true median.

    Notes
    -----
    The median lies below the k-th of R times with the chance of fewer than k heads in R throws of a coin. Of fewer than
    `SURE` runs it is the least and the longest one.
    """
    ordered, rank, below = np.sort(seconds), 0, 0.0
    while 2 * (below := below + comb(len(ordered), rank) / 2.0 ** len(ordered)) <= CHANCE:
        rank += 1
    index = max(rank - 1, 0)
    return float(ordered[index]), float(ordered[-1 - index])


def is_faster(first: "Point", second: "Point") -> bool:
    """Return whether the ``first`` method is faster for sure: least, median and the whole interval are below."""
    needed = CLOSE if min(len(first.seconds), len(second.seconds)) < SURE else 1.0
    return (
        first.interval[1] < second.interval[0]
        and first.least < second.least
        and needed * first.median < second.median
    )


def ranks(points: Sequence["Point"]) -> dict[str, tuple[int, int]]:
    """Return the first and the last place that each method may have by its time, the fastest first."""
    timed = [point for point in points if point.is_measured]
    found = {}
    for point in sorted(timed, key=lambda each: each.median):
        faster = sum(is_faster(other, point) for other in timed)
        slower = sum(is_faster(point, other) for other in timed)
        found[point.method] = (faster + 1, len(timed) - slower)
    return found


def is_settled(points: Sequence["Point"]) -> bool:
    """Return whether all methods whose medians differ by more than `CLOSE` are told apart."""
    for first, second in combinations([point for point in points if point.is_measured], 2):
        low, high = sorted((first.median, second.median))
        if CLOSE * low < high and not (is_faster(first, second) or is_faster(second, first)):
            return False
    return True


@dataclass(eq=False)
class Load:
    """How much of the timed seconds the processor worked for this program."""

    elapsed: float = 0.0
    own: float = 0.0

    def add(self, elapsed: float, own: float) -> None:
        """Count a block: its seconds, and those of them that the thread was on a processor."""
        self.elapsed += elapsed
        self.own += own

    def sentence(self) -> str:
        """Return the share, and what the system says of its load where it says so."""
        share = min(self.own / self.elapsed, 1.0) if self.elapsed else 1.0
        text = f"the processor was free for {share:.0%} of the timed seconds"
        if hasattr(os, "getloadavg"):
            text += f", load {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors"
        return text
