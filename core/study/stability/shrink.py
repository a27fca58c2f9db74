"""The shrinker: a failing cell is made as small as it can be and still fail, in parts, pixels and digits.

Delta debugging: leave something out, or make it simpler; keep what still fails in the same way. First parts go, half
of them at a time, then single ones; then the picture is halved; then every number gets as few digits as it can. What
is right is found anew for everything that is tried. The same cell always shrinks alike.

References
----------
A. Zeller, R. Hildebrandt, *Simplifying and isolating failure-inducing input*, 2002.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from core.scene import AnyScene
from core.settings import Settings
from core.study.accuracy.record import Opening, Verdict
from core.study.stability.case_text import case_text
from core.study.stability.experiment import Experiment, experiments
from core.study.stability.minimization import minimize

MOST_RUNS = 3000
"""Runs after which shrinking stops with what it has."""


@dataclass(frozen=True, eq=False)
class Shrunk:
    """What is left of a failing cell."""

    scene: AnyScene
    """What opens in the stepper and is saved; of a segment an outlined triangle whose first edge it is."""
    settings: Settings
    verdict: Verdict
    sentence: str
    """What the method does to it."""
    stage: str
    """Where it opens in the stepper, a name of ``core.records.frame.STAGES``."""
    pixel: tuple[int, int] | None
    """Column and row of the first pixel that is wrong; ``None``: it is about no pixel."""
    run_count: int
    """Runs that it took."""
    test: str
    """The text of a Python file with one test, which fails as long as the method does."""

    @property
    def opening(self) -> Opening:
        """What opens in the stepper."""
        return Opening(self.scene, self.settings, self.stage, self.pixel)


def shrink_cell(
    experiment: str | Experiment,
    method: str,
    place: tuple[float, ...],
    seed: int = 0,
    *,
    most_runs: int = MOST_RUNS,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> Shrunk:
    """Make one failing cell as small as it can be and still fail in the same way.

    Parameters
    ----------
    experiment : str or Experiment
        One of `core.study.stability.experiment.experiments`, or another one.
    method : str
        One of its methods.
    place : tuple of float
        A value of every axis.
    is_cancelled : callable, optional
        Asked before every run.

    Raises
    ------
    ValueError
        If the cell is right, or refused.
    StressCancelledError
        As soon as ``is_cancelled()``.
    """
    if isinstance(experiment, str):
        experiment = experiments.get(experiment)
    if method not in experiment.methods:
        known = ", ".join(experiment.methods)
        raise ValueError(f"method of {experiment.name} must be one of {known}, got {method}")
    scene, settings = experiment.case(method, place, seed)
    kind = experiment.kind
    found = minimize(kind, scene, partial(experiment.judge, settings=settings), most_runs, is_cancelled)
    small = kind.put_together(found.parts)
    sentence = f"{method} at {kind.words(found.parts)}: {found.verdict.remark}."
    title = "_".join([experiment.name, *(part.partition("=")[2] for part in method.split())])
    case = experiment.part(small)
    test = case_text(title, sentence, case.test_body(settings))
    pixel = case.wrong_pixel(settings, case.start(settings)())
    return Shrunk(small, settings, found.verdict, sentence, case.stage, pixel, found.run_count, test)
