"""What a stability experiment says: one outcome for every cell of a grid of parameters, one map for every method."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats
from core.study.accuracy.record import Axis, Outcome


class StressCancelledError(Exception):
    """Whoever asked for the experiment does not want it any more."""


@dataclass(frozen=True)
class ExperimentInfo:
    """What an experiment asks, before it is run."""

    name: str
    """As ``slivers``."""
    title: str
    question: str
    """One sentence: what is varied and what should hold."""
    axes: tuple[Axis, ...]
    """One or two."""
    methods: tuple[str, ...]
    """``family=name``, several joined by a blank; in the order of the maps, the exact ones last. Which fails most is
    measured, not said here."""
    claim: str
    """One sentence that tests/stability pins down: who fails where, and who holds."""


@dataclass(frozen=True, eq=False)
class StabilityMap:
    """The outcomes of one method."""

    method: str
    title: str
    outcome: NDArray[np.uint8]
    """(rows, columns) uint8 `Outcome`, the second axis up, the first to the right; one row where there is one axis."""
    severity: Floats
    """(rows, columns) float64, how wrong: pixels, values; 0 where right, NaN where there is no number."""
    remarks: tuple[tuple[str, ...], ...] = ()
    """(rows, columns) what was said of each run, in a sentence; empty: nothing was kept."""
    seconds: Floats = field(default_factory=lambda: np.empty((0, 0)))
    """(rows, columns) float64 seconds of a run, the least of a block; NaN where it was refused; empty: not timed."""

    def count(self, outcome: Outcome) -> int:
        """Return how many cells ended so."""
        return int(np.count_nonzero(self.outcome == outcome))

    def remark(self, column: int, row: int) -> str:
        """Return what was said of one run; empty: nothing."""
        return self.remarks[row][column] if self.remarks else ""


@dataclass(frozen=True, eq=False)
class Atlas:
    """One experiment, run."""

    experiment: ExperimentInfo
    maps: tuple[StabilityMap, ...]
    """In the order of ``experiment.methods``."""
    seed: int = 0
    machine: Mapping[str, str] = field(default_factory=dict)
