"""Run an experiment over its whole grid, coarse or fine: one real run for every cell of every method."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import product
from math import sqrt

import numpy as np

from core.study.accuracy.record import Axis, Outcome, Verdict
from core.study.stability.experiment import Experiment, experiments
from core.study.stability.record import Atlas, StabilityMap, StressCancelledError

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
) -> Atlas:
    """Run every method of an experiment at every place of its axes.

    Parameters
    ----------
    experiment : str or Experiment
        One of `core.study.stability.experiment.experiments`, or another one.
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

    Raises
    ------
    ValueError
        For an experiment that is not there, or axes that are not the experiment's.
    StressCancelledError
        As soon as ``is_cancelled()``.
    """
    if isinstance(experiment, str):
        experiment = experiments.get(experiment)
    chosen = experiment.axes if axes is None else axes
    if [axis.name for axis in chosen] != [axis.name for axis in experiment.axes]:
        wanted, got = (", ".join(axis.name for axis in each) for each in (experiment.axes, chosen))
        raise ValueError(f"axes of {experiment.name} must be {wanted}, got {got or 'none'}")
    columns = len(chosen[0].values)
    rows = len(chosen[1].values) if len(chosen) > 1 else 1
    places = [place[::-1] for place in product(*(axis.values for axis in reversed(chosen)))]
    maps = []
    for number, method in enumerate(experiment.methods):
        outcome, severity = np.zeros(len(places), np.uint8), np.zeros(len(places))
        remarks = []
        for cell, place in enumerate(places):
            if is_cancelled is not None and is_cancelled():
                raise StressCancelledError(f"{experiment.title} was cancelled")
            verdict = experiment.run(method, place, seed)
            outcome[cell], severity[cell] = int(verdict.outcome), verdict.severity
            remarks.append(verdict.remark)
            if cell_done is not None:
                cell_done(method, cell % columns, cell // columns, verdict)
            if progress is not None and cell % max(columns // 2, 1) == 0:
                progress((number + cell / len(places)) / len(experiment.methods), method)
        said = tuple(tuple(remarks[row * columns : (row + 1) * columns]) for row in range(rows))
        shape = rows, columns
        maps.append(StabilityMap(method, method, outcome.reshape(shape), severity.reshape(shape), said))
    return Atlas(replace(experiment.info, axes=chosen), tuple(maps), seed, dict(machine or {}))


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
