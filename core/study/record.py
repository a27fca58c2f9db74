"""What a study says: the methods of one family on the same work, their time, their work, their errors.

A machine that does something else makes some blocks longer, and none shorter. So the blocks of all methods take turns;
the least time of a method stays what it was, the interval of its median grows, and two methods whose intervals overlap
are not told apart.

References
----------
W. J. Conover, *Practical Nonparametric Statistics*, 1971 (an interval of the median from ordered values).
"""

import gc
import os
import platform
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from enum import IntEnum
from itertools import combinations
from math import comb
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core.methods import table
from core.records.arrays import Flags, Floats, cached_property
from core.scene import AnyScene
from core.settings import Settings

# What timed blocks tell: the median with an interval that holds it, who is faster for sure, and when to
# stop.


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


# What a study says: the methods of one family on the same work, their time, their work counts and their
# errors.


class StudyCancelledError(Exception):
    """Whoever asked for the measurement does not want it any more; nothing is left of it."""


@dataclass(frozen=True)
class ErrorMeasure:
    """One way to say how wrong a result is; 0 is exact."""

    name: str
    """Key in `Point.errors`, as ``misclassified``."""
    title: str
    """What a person reads at an axis, without the unit: ``Misclassified pixels``."""
    unit: str
    """``per million``, ``pixels``, ``ulp``, ``1/255``; empty: a plain number."""


class Outcome(IntEnum):
    """What came of one real run."""

    RIGHT = 0
    HOLE = 1
    """A pixel that belongs to the shape was not drawn."""
    DOUBLE_HIT = 2
    """A pixel was drawn twice, or one that does not belong to the shape was drawn."""
    WRONG_ORDER = 3
    """The farther surface is seen."""
    NOT_A_NUMBER = 4
    OVERFLOW = 5
    WRONG_PICTURE = 6
    """Wrong in another way: values, colours, ends of segments."""
    REFUSED = 7
    """The method does not take this input, and said so."""


@dataclass(frozen=True)
class Verdict:
    """What came of one run."""

    outcome: Outcome
    severity: float = 0.0
    """How wrong, in the experiment's own unit: pixels, ulp, levels of colour; 0: not at all."""
    remark: str = ""
    """One sentence with the numbers of this run: ``3 pixels of 96 are drawn twice``."""


Errors = Mapping[str, float | str]
"""By `ErrorMeasure.name`: a number, or a sentence why there is none."""


@dataclass(frozen=True, eq=False)
class Judgement:
    """What came of one run, and where."""

    verdict: Verdict
    wrong: Flags = field(default_factory=lambda: np.zeros((0, 0), bool))
    """(H, W) bool, the pixels that are wrong; empty: it is about no pixels, or nothing is known of them."""
    errors: Errors = field(default_factory=dict)
    """What a study compares methods by."""


def judged(errors: Errors, by: str = "", tolerance: float = 0.0) -> Judgement:
    """Return what errors come to: right if all that have a number, or the one called ``by``, are within a tolerance.

    The severity is the first that is not.
    """
    numbers = {name: value for name, value in errors.items() if not isinstance(value, str)}
    decisive = [value for name, value in numbers.items() if by in ("", name)]
    if not decisive:
        return Judgement(Verdict(Outcome.REFUSED, np.nan, str(next(iter(errors.values())))), errors=errors)
    wrong = [value for value in decisive if value > tolerance]
    outcome = Outcome.WRONG_PICTURE if wrong else Outcome.RIGHT
    remark = ", ".join(f"{name} {value:.4g}" for name, value in numbers.items())
    return Judgement(Verdict(outcome, (wrong or decisive)[0], remark), errors=errors)


@dataclass(frozen=True)
class Axis:
    """One quantity of the work that is varied: triangle size, line length, sliver angle, distance from an edge."""

    name: str
    title: str
    unit: str
    values: tuple[float, ...]
    """Rising; a study takes one of them, or one between, and a map all."""
    is_logarithmic: bool = False
    default: float = 0.0
    """What a study takes, unless another value is chosen."""
    is_cost: bool = False
    """Whether the second chart shows how cost grows with it; one axis of a work at most."""
    setting: str = ""
    """The setting that it turns, of methods that take it: the value of least cost is looked for. Empty: none."""


@dataclass(frozen=True)
class WorkKind:
    """A kind of work that all methods of a family can be put to."""

    name: str
    title: str
    """As ``Random triangles``."""
    unit: str
    """What time is divided by: ``pixel``, ``line``, ``triangle``, ``frame``."""
    dials: tuple[Axis, ...] = ()


@dataclass(frozen=True, eq=False)
class Point:
    """One method, measured; or why it could not be."""

    method: str
    """``family=name`` of the table, as ``line=dda``; several joined by a blank where a point is a choice of several."""
    title: str
    seconds: Floats = field(default_factory=lambda: np.empty(0))
    """(R,) float64 seconds of one run, the least of a block, in the R interleaved rounds; empty: not measured."""
    unit_count: int = 0
    """Units of work (`WorkKind.unit`) in one run."""
    counts: Mapping[str, int] = field(default_factory=dict)
    """Work that does not depend on the machine: ``pixels tested``, ``operations``, ``bytes``."""
    errors: Mapping[str, float] = field(default_factory=dict)
    """By `ErrorMeasure.name`; NaN: this error is not defined for the method."""
    reasons: Mapping[str, str] = field(default_factory=dict)
    """By `ErrorMeasure.name`, a sentence for every NaN: why the error is not defined."""
    refused: str = ""
    """A sentence: why there are no numbers. Empty: there are."""

    @property
    def is_measured(self) -> bool:
        """Whether there are numbers."""
        return not self.refused and len(self.seconds) > 0

    @property
    def seconds_per_unit(self) -> Floats:
        """(R,) float64."""
        return self.seconds / max(self.unit_count, 1)

    @cached_property
    def median(self) -> float:
        """Median of the seconds per unit."""
        return float(np.median(self.seconds_per_unit))

    @cached_property
    def least(self) -> float:
        """Least of the seconds per unit: what a machine that does something else cannot lengthen."""
        return float(self.seconds_per_unit.min())

    @cached_property
    def interval(self) -> tuple[float, float]:
        """Seconds per unit between which the true median lies, with a chance of 95 % from six rounds on."""
        return median_interval(self.seconds_per_unit)


@dataclass(frozen=True, eq=False)
class Pictures:
    """What one method made, what would have been right, and where they differ; row 0 is the bottom row."""

    result: NDArray[np.float32]
    """(H, W) float32 scalars or (H, W, 4) float32 linear colours."""
    reference: NDArray[np.float32]
    """The same shape."""
    difference: NDArray[np.float32]
    """(H, W) float32, signed where the values are scalars (result minus reference), else the largest channel's."""


@dataclass(frozen=True, eq=False)
class Opening:
    """What opens in the stepper to look at one method's run."""

    scene: AnyScene
    settings: Settings
    stage: str
    """Where to look first, a name of ``core.records.frame.STAGES``."""
    pixel: tuple[int, int] | None = None
    """Column and row to pin: where it goes wrong first."""


@dataclass(frozen=True, eq=False)
class Study:
    """One family's methods on one work."""

    family: str
    title: str
    work: WorkKind
    dials: Mapping[str, float]
    """The chosen value of every dial of the work."""
    seed: int
    measures: tuple[ErrorMeasure, ...]
    """The chart opens with the first."""
    points: tuple[Point, ...]
    growth: Mapping[float, tuple[Point, ...]] = field(default_factory=dict)
    """Value of the cost dial to the points there."""
    machine: Mapping[str, str] = field(default_factory=dict)
    """Processor, system, versions of Python, NumPy and Rasterscope, date."""
    settings: Settings = field(default_factory=Settings)
    """What all points share; a point's method changes one or a few of them."""
    scene: str = ""
    """What the scene that was measured on is called; empty: the work itself makes it."""


def pareto_front(points: tuple[Point, ...], measure: str, count: str = "") -> tuple[Point, ...]:
    """Return the measured points that no other beats in both cost and the error ``measure``, cheapest first.

    Parameters
    ----------
    points : tuple of Point
    measure : str
        Key of `Point.errors`.
    count : str, optional
        What the methods are charged with: a key of `Point.counts`; their time by default.

    Notes
    -----
    Of two methods whose times are not told apart, the one with the larger error is beaten.
    """
    known = [
        point
        for point in points
        if point.is_measured
        and np.isfinite(point.errors.get(measure, np.nan))
        and (not count or count in point.counts)
    ]

    def cost(point: Point) -> float:
        return float(point.counts[count]) if count else point.median

    def is_cheaper(first: Point, second: Point) -> bool:
        return cost(first) < cost(second) if count else is_faster(first, second)

    front: list[Point] = []
    for point in sorted(known, key=lambda each: (each.errors[measure], cost(each))):
        error = point.errors[measure]
        if not any(
            is_cheaper(other, point) or (other.errors[measure] < error and not is_cheaper(point, other))
            for other in front
        ):
            front.append(point)
    return tuple(sorted(front, key=cost))


@dataclass(frozen=True)
class BestValue:
    """The value of a setting at which a method was fastest, on the machine that measured."""

    method: str
    title: str
    value: float
    others: tuple[float, ...]
    """Values at which its time is not told apart from the least."""


def best_values(study: Study) -> tuple[BestValue, ...]:
    """Return the best value of the setting that the work's cost dial turns, for every method that takes it."""
    setting = next((dial.setting for dial in study.work.dials if dial.is_cost), "")
    found = []
    for point in study.points:
        family, _, name = point.method.partition("=")
        measured = {
            value: each
            for value, points in study.growth.items()
            for each in points
            if each.method == point.method and each.is_measured
        }
        is_taken = family in table.families and name in table.names(family)
        if not setting or not is_taken or setting not in table.get(family, name).takes or not measured:
            continue
        best = min(measured, key=lambda value: measured[value].median)
        others = [v for v in measured if v != best and not is_faster(measured[best], measured[v])]
        found.append(BestValue(point.method, point.title, best, tuple(others)))
    return tuple(found)


def machine(program_version: str) -> dict[str, str]:
    """Return processor, system, versions of Python, NumPy and Rasterscope, and the date (ISO): nothing of a user."""
    return {
        "processor": processor_name(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "numpy": np.__version__,
        "rasterscope": program_version,
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
    }


def processor_name() -> str:
    """Return the processor's name, where the system tells it."""
    table = Path("/proc/cpuinfo")
    if table.is_file():
        for line in table.read_text(encoding="utf-8", errors="replace").splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                return " ".join(value.split())
    return platform.processor() or platform.machine()
