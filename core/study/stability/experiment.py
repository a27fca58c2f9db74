"""An experiment: scenes made from a place on its axes, every method's picture of them, and what is right for each.

What is right is worked out anew for whatever is left of a scene, so every failing cell can be made smaller.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields
from functools import lru_cache
from typing import Any

import numpy as np

from core.records.arrays import Flags
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.study.accuracy.family import Work, settings_of, timed_block
from core.study.accuracy.frame_task import SceneWork
from core.study.accuracy.record import Opening, Outcome, Verdict
from core.study.accuracy.timing import Load
from core.study.stability.case_text import scene_text, settings_text
from core.study.stability.kinds import TRIANGLES
from core.study.stability.minimization import Kind
from core.study.stability.record import ExperimentInfo


class Case(SceneWork):
    """A scene of one kind, and what is right for it: the same for all methods."""

    def assertions(self, settings: Settings, made: Any, wrong: Flags) -> str:
        """Return the statements of a test of ``frame``, the picture, which fail where ``wrong`` (H, W) bool is set."""
        raise NotImplementedError

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test that holds once the method is right for the scene."""
        made = self.start(settings)()
        assertions = self.assertions(settings, made, self.judge(settings, made).wrong)
        return f"{scene_text(self.scene)}\nframe = render(scene, {settings_text(settings)})\n{assertions}"


@dataclass(frozen=True, eq=False)
class Experiment(ExperimentInfo):
    """Work that is made at any place of some axes, and judged; of scenes parts, pixels and digits can be left out."""

    make: Callable[[tuple[float, ...], int], Any]
    """The work at a place of the axes, for a seed; or a scene, of which `case_of` knows what is right."""
    case_of: Callable[..., Case] = Case
    """What is right for any scene of the kind; a ``ValueError`` where that is not known."""
    base: Settings = field(default_factory=Settings)
    """What the methods share."""
    kind: Kind = TRIANGLES
    """What the scenes are made of, and how they get smaller."""

    __hash__ = object.__hash__
    """An experiment is itself alone: others may ask the same of another scene."""

    def __eq__(self, other: object) -> bool:
        return self is other

    @property
    def info(self) -> ExperimentInfo:
        """What it asks."""
        return ExperimentInfo(**{each.name: getattr(self, each.name) for each in fields(ExperimentInfo)})

    def work(self, place: tuple[float, ...], seed: int) -> Work:
        """Return the work at a place, made anew."""
        made = self.make(place, seed)
        return made if isinstance(made, Work) else self.part(made)

    def part(self, scene: Any) -> Case:
        """Return any scene of the kind with what is right for it: ValueError where nobody knows."""
        return self.case_of(scene)

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Run a method of ``methods`` at one value of every axis; nothing is assumed, all is run."""
        try:
            return _work(self, place, seed).run(settings_of(self.base, method)).verdict
        except ValueError as problem:
            return Verdict(Outcome.REFUSED, np.nan, str(problem))

    def time(self, method: str, place: tuple[float, ...], seed: int) -> float:
        """Return the seconds of that run, the least of a block; NaN where the method does not take the work."""
        try:
            return timed_block(_work(self, place, seed), settings_of(self.base, method), Load())[1]
        except ValueError:
            return np.nan

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return what opens in the stepper to look at that very run; ``None``: it is refused there too."""
        settings = settings_of(self.base, method)
        try:
            work = _work(self, place, seed)
            return work.opening(settings, work.start(settings)())
        except ValueError:
            return None

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[AnyScene, Settings]:
        """Return what is made smaller of the scene of one cell, and how the method draws it."""
        work = _work(self, place, seed)
        if not isinstance(work, Case):
            raise ValueError(f"nothing of {self.name} can be made smaller")
        return self.kind.as_case(work.scene), settings_of(self.base, method)

    def judge(self, scene: AnyScene, settings: Settings) -> Verdict:
        """Run any scene of the kind; ValueError where nobody knows what is right."""
        return self.part(scene).run(settings).verdict


@lru_cache(maxsize=1024)
def _work(experiment: Experiment, place: tuple[float, ...], seed: int) -> Work:
    """Return the work of one place: its reference is worked out once for all methods."""
    return experiment.work(place, seed)


class ExperimentTable:
    """Experiments by name, in the order of registration."""

    def __init__(self) -> None:
        self._experiments: dict[str, Experiment] = {}

    def __iter__(self) -> Iterator[Experiment]:
        return iter(self._experiments.values())

    def add(self, experiment: Experiment) -> None:
        """Register ``experiment``; a name that is taken is refused with ValueError."""
        name = experiment.name
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


def check_in_view_volume(scene: ClipScene) -> None:
    """Refuse triangles that are cut at the near or the far plane, or reach behind the eye.

    Raises ValueError if there is one.
    """
    z, w = scene.clip[..., 2], scene.clip[..., 3]
    bad = ((w <= 0) | (np.abs(z) > w)).any(axis=1)
    if bad.any():
        raise ValueError(
            f"every corner must be between the near and the far plane, triangle {int(np.argmax(bad))} is not"
        )
