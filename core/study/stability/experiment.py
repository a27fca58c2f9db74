"""An experiment: scenes made from a place on its axes, every method's picture of them, and what is right for each.

What is right is worked out anew for whatever is left of a scene, so every failing cell can be made smaller.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from core.records.arrays import Flags
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.study.accuracy.family import settings_of
from core.study.accuracy.frame_task import first_pixel
from core.study.accuracy.record import Opening
from core.study.stability.case_text import scene_text, settings_text
from core.study.stability.kinds import TRIANGLES
from core.study.stability.minimization import Kind
from core.study.stability.record import ExperimentInfo, Outcome, Verdict


@dataclass(frozen=True, eq=False)
class Judgement:
    """What came of one picture, and where."""

    verdict: Verdict
    wrong: Flags = field(default_factory=lambda: np.zeros((0, 0), bool))
    """(H, W) bool, the pixels that are wrong; empty: it is about no pixels."""


class Case(ABC):
    """A scene of one kind, and what is right for it: the same for all methods."""

    scene: Any

    @abstractmethod
    def judge(self, settings: Settings) -> Judgement:
        """Draw the scene, and compare the picture with the reference.

        Raises ValueError if a method does not take the scene.
        """

    def assertions(self, settings: Settings, wrong: Flags) -> str:
        """Return the statements of a test of ``frame``, the picture, which fail where ``wrong`` (H, W) bool is set."""
        raise NotImplementedError

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test that holds once the method is right for the scene."""
        assertions = self.assertions(settings, self.judge(settings).wrong)
        return f"{scene_text(self.scene)}\nframe = render(scene, {settings_text(settings)})\n{assertions}"

    def wrong_pixel(self, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is wrong, if it is about pixels."""
        return first_pixel(self.judge(settings).wrong)

    def opening(self, settings: Settings, stage: str, pixel: tuple[int, int] | None) -> Opening | None:
        """Return what opens in the stepper at the first ``pixel`` that is wrong; ``None``: there is nothing to see."""
        return Opening(self.scene, settings, stage, pixel)


@dataclass(frozen=True, eq=False)
class Experiment:
    """Scenes that every method draws, of which parts, pixels and digits can be left out."""

    info: ExperimentInfo
    """What it asks, over which axes, of which methods."""
    make: Callable[[tuple[float, ...], int], AnyScene]
    """The scene at a place of the axes, for a seed."""
    case_of: Callable[[Any], Case]
    """What is right for any scene of the kind; a ``ValueError`` where that is not known."""
    stage: str
    """Where the stepper opens, a name of ``core.records.frame.STAGES``."""
    base: Settings = field(default_factory=Settings)
    """What the methods share."""
    kind: Kind = TRIANGLES
    """What the scenes are made of, and how they get smaller."""
    whole: Callable[[Any], Case] | None = None
    """What is right for a scene as it is made, where more is known of it than of a part; ``None``: as of any."""

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Run a method of ``info.methods`` at one value of every axis; nothing is assumed, all is run."""
        try:
            return _case(self, place, seed).judge(settings_of(self.base, method)).verdict
        except ValueError as problem:
            return Verdict(Outcome.REFUSED, np.nan, str(problem))

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return what opens in the stepper to look at that very run; ``None``: it is refused there too."""
        case, settings = _case(self, place, seed), settings_of(self.base, method)
        try:
            return case.opening(settings, self.stage, case.wrong_pixel(settings))
        except ValueError:
            return None

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[AnyScene, Settings]:
        """Return what is made smaller of the scene of one cell, and how the method draws it."""
        return self.kind.as_case(_case(self, place, seed).scene), settings_of(self.base, method)

    def judge(self, scene: AnyScene, settings: Settings) -> Verdict:
        """Run any scene of that kind: what is right follows from the scene; ValueError where nobody knows."""
        return self.case_of(scene).judge(settings).verdict

    def test_body(self, scene: AnyScene, settings: Settings) -> str:
        """Return the statements of a test that holds once the method is right for the scene."""
        return self.case_of(scene).test_body(settings)

    def wrong_pixel(self, scene: AnyScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is wrong, if it is about pixels."""
        return self.case_of(scene).wrong_pixel(settings)


@lru_cache(maxsize=1024)
def _case(experiment: Experiment, place: tuple[float, ...], seed: int) -> Case:
    """Return the case of one place: its reference is worked out once for all methods."""
    return (experiment.whole or experiment.case_of)(experiment.make(place, seed))


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
