"""An experiment on what covered pixels show: a scene made from a place on the axes, drawn, and judged as a picture."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from core.pipeline import render
from core.records.arrays import Flags, Floats
from core.scene import AnyScene
from core.settings import Settings
from core.study.accuracy.family import settings_of
from core.study.accuracy.frame_task import first_pixel
from core.study.accuracy.record import Opening
from core.study.stability.experiment import Verdict
from core.study.stability.record import ExperimentInfo, Outcome


@dataclass(frozen=True, eq=False)
class Judgement:
    """What came of one picture, and where."""

    verdict: Verdict
    wrong: Flags
    """(H, W) bool, the pixels that are wrong."""


class Case(ABC):
    """One place on the axes: a scene, and what is right for it. The same for all methods."""

    scene: AnyScene

    @abstractmethod
    def judge(self, settings: Settings) -> Judgement:
        """Draw the scene, and compare the picture with the reference.

        Raises
        ------
        ValueError
            If a method does not take the scene.
        """


@dataclass(frozen=True, eq=False)
class CaseExperiment:
    """Scenes that every method draws."""

    info: ExperimentInfo
    make: Callable[[tuple[float, ...], int], Case]
    """The case at a place of the axes, for a seed."""
    stage: str
    """Where the stepper opens."""
    base: Settings = field(default_factory=Settings)
    """What the methods share."""

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Draw the scene of one place with one method, and judge it."""
        judgement = self._judge(method, place, seed)
        return judgement.verdict if isinstance(judgement, Judgement) else judgement

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return the scene with these settings, at the first pixel that is wrong; ``None``: it is refused there too."""
        judgement = self._judge(method, place, seed)
        if not isinstance(judgement, Judgement):
            return None
        scene = _case(self, place, seed).scene
        return Opening(scene, settings_of(self.base, method), self.stage, first_pixel(judgement.wrong))

    def _judge(self, method: str, place: tuple[float, ...], seed: int) -> Judgement | Verdict:
        case = _case(self, place, seed)
        try:
            return case.judge(settings_of(self.base, method))
        except ValueError as problem:
            return Verdict(Outcome.REFUSED, np.nan, str(problem))


@lru_cache(maxsize=512)
def _case(experiment: CaseExperiment, place: tuple[float, ...], seed: int) -> Case:
    """Return the case of one place: its reference is worked out once for all methods."""
    return experiment.make(place, seed)


def judge_colors(
    shown: Floats, wanted: Floats, tolerance: float, where: Flags | None = None, of_mean: bool = False
) -> Judgement:
    """Compare colours, and say how far they are off, in 1/255 of linear light.

    Parameters
    ----------
    shown, wanted : (H, W, C) float64
        Linear colours.
    tolerance : float
        In 1/255: so much is taken as right.
    where : (H, W) bool, optional
        The pixels that count; all by default.
    of_mean : bool
        Whether the mean over the pixels decides, rather than the largest difference.
    """
    difference = 255 * np.abs(shown - wanted).max(axis=2)
    counts = np.ones(difference.shape, bool) if where is None else where
    if np.isnan(difference[counts]).any():
        unknown = counts & np.isnan(difference)
        remark = f"{int(unknown.sum())} pixels of {int(counts.sum())} are not a number"
        return Judgement(Verdict(Outcome.NOT_A_NUMBER, np.nan, remark), unknown)
    largest, mean = float(difference[counts].max()), float(difference[counts].mean())
    severity = mean if of_mean else largest
    remark = f"colours are off by {mean:.3g}/255 in the mean and {largest:.3g}/255 at most"
    if severity <= tolerance:
        verdict = Verdict(Outcome.RIGHT, severity, f"{remark}: within {tolerance:g}/255")
        return Judgement(verdict, np.zeros(counts.shape, bool))
    return Judgement(Verdict(Outcome.WRONG_PICTURE, severity, remark), counts & (difference > tolerance))


def judge_order(wrong: Flags, what: str) -> Judgement:
    """Say how many pixels, (H, W) bool, show ``what`` should be hidden."""
    count = int(np.count_nonzero(wrong))
    if not count:
        return Judgement(Verdict(Outcome.RIGHT, 0.0, f"all {wrong.size} pixels show what is nearest"), wrong)
    return Judgement(
        Verdict(Outcome.WRONG_ORDER, float(count), f"{count} pixels of {wrong.size} show {what}"), wrong
    )


def drawn_colors(scene: AnyScene, settings: Settings) -> Floats:
    """Draw a scene, and return its colours (H, W, 4) float64."""
    return render(scene, settings).color.astype(np.float64)
