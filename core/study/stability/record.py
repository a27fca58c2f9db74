"""What a stability experiment says: one outcome for every cell of a grid of parameters, one map for every method."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Floats


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


class StressCancelledError(Exception):
    """Whoever asked for the experiment does not want it any more."""


@dataclass(frozen=True)
class Axis:
    """One parameter of an experiment."""

    name: str
    title: str
    unit: str
    values: tuple[float, ...]
    is_logarithmic: bool = False


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
