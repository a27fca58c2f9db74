"""Run an experiment over its whole grid, one real run for every cell; and make a failing cell as small as it can be.

Delta debugging: leave something out, or make it simpler; keep what still fails in the same way. First parts go, half
of them at a time, then single ones; then the picture is halved; then every number gets as few digits as it can. What
is right is found anew for everything that is tried. The same cell always shrinks alike.

References
----------
A. Zeller, R. Hildebrandt, *Simplifying and isolating failure-inducing input*, 2002.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from math import sqrt

import numpy as np

from core.scene import AnyScene
from core.settings import Settings
from core.study.case_text import case_text
from core.study.cases import Atlas, StabilityMap, minimize
from core.study.experiment import Experiment, experiments
from core.study.family import Assignment, StudyFamily, Task, chosen_dials
from core.study.record import Axis, Opening, Outcome, StudyCancelledError, Verdict

# Run an experiment over its whole grid, coarse or fine: one real run for every cell of every method.


RESOLUTIONS = ("coarse", "normal", "fine")
FEWEST = 4
"""Values below which an axis is not made coarser."""


def stress(
    experiment: str | Experiment,
    *,
    seed: int = 0,
    axes: tuple[Axis, ...] | None = None,
    progress: Callable[[float, str], None] | None = None,
    is_cancelled: Callable[[], bool] | None = None,
    machine: Mapping[str, str] | None = None,
    cell_done: Callable[[str, int, int, Verdict], None] | None = None,
    with_times: bool = False,
) -> Atlas:
    """Run every method of an experiment at every place of its axes.

    Parameters
    ----------
    experiment : str or Experiment
        One of `core.study.experiment.experiments`, or another one, as of `study_experiment`.
    seed : int
        What is random in the experiment follows from it.
    axes : tuple of Axis, optional
        Other values for the experiment's axes, in their order.
    progress : callable, optional
        Called with the fraction done and the method at work.
    is_cancelled : callable, optional
        Asked after every cell.
    machine : mapping, optional
        Kept in the atlas.
    cell_done : callable, optional
        Called after every run with the method, the column and the row of the cell, and what came of it.
    with_times : bool
        Time every cell too.

    Raises
    ------
    ValueError
        For an experiment that is not there, or axes that are not the experiment's.
    StudyCancelledError
        As soon as ``is_cancelled()``.
    """
    if isinstance(experiment, str):
        experiment = experiments.get(experiment)
    chosen = experiment.axes if axes is None else axes
    if [axis.name for axis in chosen] != [axis.name for axis in experiment.axes]:
        wanted, got = (", ".join(axis.name for axis in each) for each in (experiment.axes, chosen))
        raise ValueError(f"axes of {experiment.name} must be {wanted}, got {got or 'none'}")
    columns = len(chosen[0].values)
    places = [place[::-1] for place in product(*(axis.values for axis in reversed(chosen)))]
    maps = []
    for number, method in enumerate(experiment.methods):
        verdicts, seconds = [], []
        for cell, place in enumerate(places):
            if is_cancelled is not None and is_cancelled():
                raise StudyCancelledError(f"{experiment.title} was cancelled")
            verdicts.append(experiment.run(method, place, seed))
            if with_times:
                seconds.append(experiment.time(method, place, seed))
            if cell_done is not None:
                cell_done(method, cell % columns, cell // columns, verdicts[-1])
            if progress is not None and cell % max(columns // 2, 1) == 0:
                progress((number + cell / len(places)) / len(experiment.methods), method)
        maps.append(_map(method, verdicts, seconds, columns))
    return Atlas(replace(experiment.info, axes=chosen), tuple(maps), seed, dict(machine or {}))


def _map(method: str, verdicts: list[Verdict], seconds: list[float], columns: int) -> StabilityMap:
    """Return the map of a method, from what came of its cells, row by row; ``seconds`` may be empty."""
    return StabilityMap(
        method,
        method,
        np.array([each.outcome for each in verdicts], np.uint8).reshape(-1, columns),
        np.array([each.severity for each in verdicts], float).reshape(-1, columns),
        tuple(
            tuple(each.remark for each in verdicts[first : first + columns])
            for first in range(0, len(verdicts), columns)
        ),
        np.array(seconds).reshape(-1, columns),
    )


def study_experiment(
    family: StudyFamily,
    across: Sequence[str],
    work: str | None = None,
    dials: Mapping[str, float] | None = None,
    *,
    scene: AnyScene | None = None,
    settings: Settings | None = None,
) -> Experiment:
    """Return a study as an experiment, to be run at every value of one or two of its dials.

    Parameters
    ----------
    across : sequence of str
        The dials that become axes, from left to right and upwards; the others stay at ``dials``, or their defaults.
    work, dials, scene, settings : optional
        As of ``core.study.measure``.

    Raises
    ------
    ValueError
        For a work, dial or value that there is not, or another number of axes.
    """
    kind, base = family.work(work), family.base if settings is None else settings
    fixed = chosen_dials(kind, dials)
    found = {axis.name: axis for axis in kind.dials}
    if not 1 <= len(set(across)) == len(across) <= 2 or not set(across) <= set(found):
        known, got = ", ".join(found) or "none", ", ".join(across) or "none"
        raise ValueError(f"axes of {kind.name} must be one or two of {known}, got {got}")

    def make(place: tuple[float, ...], seed: int) -> Task:
        values = fixed | dict(zip(across, place, strict=True))
        return family.make(Assignment(kind.name, values, seed, base, scene))

    others = (axis for axis in kind.dials if axis.name not in across)
    stays = [f"{axis.title}: {fixed[axis.name]:g}{f' {axis.unit}' if axis.unit else ''}." for axis in others]
    return Experiment(
        f"{family.name}-{kind.name}",
        f"{family.title}: {kind.title}",
        " ".join(["How wrong, and how fast, is each method?", *stays]),
        tuple(replace(found[name], is_logarithmic=True) for name in across),
        tuple(each.method for each in family.candidates(base)),
        "No method is promised to be right here. The maps show what was measured.",
        make,
        base=base,
    )


def count_outcomes(atlas: Atlas) -> dict[str, dict[str, int]]:
    """Return by method how many cells ended in which way; ways that none ended in are left out."""
    return {
        each.method: {outcome.name: each.count(outcome) for outcome in Outcome if each.count(outcome)}
        for each in atlas.maps
    }


def axes_at(axes: tuple[Axis, ...], resolution: str) -> tuple[Axis, ...]:
    """Return axes with other values.

    Parameters
    ----------
    axes : tuple of Axis
        As the experiment gives them.
    resolution : str
        One of `RESOLUTIONS`. ``coarse``: every other value, with both ends. ``fine``: one more in the middle between
        each two, the geometric middle on a logarithmic axis; between whole numbers a whole number, if there is one.

    Raises
    ------
    ValueError
        For a resolution that is not there.
    """
    if resolution not in RESOLUTIONS:
        raise ValueError(f"resolution must be one of {', '.join(RESOLUTIONS)}, got {resolution}")
    if resolution == "coarse":
        return tuple(replace(axis, values=_every_other(axis.values)) for axis in axes)
    if resolution == "fine":
        return tuple(replace(axis, values=_with_middles(axis)) for axis in axes)
    return axes


def _every_other(values: tuple[float, ...]) -> tuple[float, ...]:
    if len(values) < FEWEST:
        return values
    kept = values[::2]
    return kept if kept[-1] == values[-1] else (*kept, values[-1])


def _with_middles(axis: Axis) -> tuple[float, ...]:
    values: list[float] = []
    is_whole = all(float(value).is_integer() for value in axis.values)
    for low, high in zip(axis.values, axis.values[1:], strict=False):
        middle = sqrt(low * high) if axis.is_logarithmic else (low + high) / 2.0
        if is_whole:
            middle = float(round(middle))
        values += [low] if middle in (low, high) else [low, middle]
    return (*values, axis.values[-1])


# The shrinker: a failing cell is made as small as it can be and still fail, in parts, pixels and digits.


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
        One of `core.study.experiment.experiments`, or another one.
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
    StudyCancelledError
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
