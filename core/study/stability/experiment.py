"""An experiment: what is varied, and what comes of one real run of one method at one place."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

from core.scene import AnyScene
from core.settings import Settings
from core.study.accuracy.record import Opening
from core.study.stability.minimization.kind import Kind
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
    """What is varied and what should hold; any case of it can be run by itself, so that it can be made smaller."""

    @property
    def info(self) -> ExperimentInfo:
        """What it asks, over which axes, of which methods."""

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Run a method of ``info.methods`` at one value of every axis; nothing is assumed, all is run."""

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return what opens in the stepper to look at that very run; ``None``: the stepper has no such stage."""

    @property
    def stage(self) -> str:
        """Where the stepper opens, a name of ``core.records.frame.STAGES``."""

    @property
    def kind(self) -> Kind[Any]:
        """What its cases are made of, and how they get smaller."""

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[AnyScene, Settings]:
        """Return the scene of one cell, and how the method draws it."""

    def judge(self, scene: Any, settings: Settings) -> Verdict:
        """Run any scene of that kind: what is right follows from the scene; ValueError where nobody knows."""

    def test_body(self, scene: Any, settings: Settings) -> str:
        """Return the statements of a test that holds once the method is right for the scene."""

    def wrong_pixel(self, scene: Any, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is wrong, if it is about pixels."""


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
