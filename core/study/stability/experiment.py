"""An experiment: what is varied, and what comes of one real run of one method at one place."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from core.study.record import Opening
from core.study.stability.record import ExperimentInfo, Outcome


@dataclass(frozen=True)
class Verdict:
    """What came of one run."""

    outcome: Outcome
    severity: float = 0.0
    """How wrong, in the experiment's own unit: pixels, ulp, levels of colour; 0: not at all."""
    remark: str = ""
    """One sentence with the numbers of this run: ``3 pixels of 96 are drawn twice``."""


class Experiment(Protocol):
    """What is varied and what should hold."""

    @property
    def info(self) -> ExperimentInfo:
        """What it asks, over which axes, of which methods."""

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Run a method of ``info.methods`` at one value of every axis; nothing is assumed, all is run."""

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return what opens in the stepper to look at that very run; ``None``: the stepper has no such stage."""


class ExperimentTable:
    """Experiments by name, in the order of registration."""

    def __init__(self) -> None:
        self._experiments: dict[str, Experiment] = {}

    def __iter__(self) -> Iterator[Experiment]:
        return iter(self._experiments.values())

    def add(self, experiment: Experiment) -> None:
        """Register ``experiment``; a name that is taken is refused with ValueError."""
        name = experiment.info.name
        if name in self._experiments:
            raise ValueError(f"there is an experiment {name} already")
        self._experiments[name] = experiment

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the experiments."""
        return tuple(self._experiments)

    def get(self, name: str) -> Experiment:
        """Return one experiment, or raise ValueError with the names that there are."""
        if name not in self._experiments:
            raise ValueError(f"experiment must be one of {', '.join(self._experiments)}, got {name}")
        return self._experiments[name]


experiments = ExperimentTable()
"""All experiments of the program."""
