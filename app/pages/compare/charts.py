"""From a study to its two charts: error against cost, and how cost grows with the work."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from core.explain.stage_texts import family_title
from core.methods import table
from core.study.record import ErrorMeasure, Point, Study, best_values, pareto_front
from core.study.speed_accuracy import cost_dial
from widgets.experiments.series import MOST_NAMED, ChartAxis, ChartEmpty, ChartPicture, ChartSeries

TIME = "time"
"""The cost that is time on this machine; every other one is a name of `Point.counts`."""


def costs_of(points: Sequence[Point]) -> list[str]:
    """Return what the methods can be charged with: time, then all counts."""
    counts = dict.fromkeys(name for point in points for name in point.counts)
    return [TIME, *counts]


def cost_title(cost: str, unit: str) -> str:
    """Return what a person reads: ``Time per line``, ``Pixels tested``."""
    return f"Time per {unit}" if cost == TIME else cost[:1].upper() + cost[1:]


def cost_value(point: Point, cost: str) -> float:
    """Return the cost of a measured point, NaN where it has none."""
    if cost == TIME:
        return point.median if point.is_measured else np.nan
    return float(point.counts[cost]) if point.is_measured and cost in point.counts else np.nan


def bar_of(point: Point) -> tuple[float, float]:
    """Return the ends of a measured point's bar: its least time, and the end of the interval of the median."""
    return point.least, point.interval[1]


def numbers_of(points: Sequence[Point]) -> dict[str, int]:
    """Return the number of every method, which is its colour and shape in all charts."""
    return {point.method: number for number, point in enumerate(points)}


def title_of(point: Point, methods: Iterable[str]) -> str:
    """Return what a point is called; its family stands before it where the ``methods`` are of several."""
    families = {method.split("=", 1)[0] for method in methods}
    family, _, name = point.method.partition("=")
    is_plain = name in (table.names(family) if family in table.families else ())
    if len(families) > 1 and is_plain and point.title == table.get(family, name).title:
        return f"{family_title(family)}: {point.title}"
    return point.title


def scatter_of(
    study: Study, measure_name: str, cost: str, numbers: Mapping[str, int], ringed: tuple[str, ...] = ()
) -> ChartPicture | ChartEmpty:
    """Return the chart of an error against a cost, with the front of the methods that no other beats in both.

    Parameters
    ----------
    numbers : mapping of str to int
        Every method's number, those included that are still to be measured.
    ringed : tuple of str
        Methods that stand out: what a plan chose.
    """
    measure = next((measure for measure in study.measures if measure.name == measure_name), study.measures[0])
    series = tuple(
        ChartSeries(
            point.method,
            title_of(point, numbers),
            numbers[point.method],
            np.array([cost_value(point, cost)]),
            np.array([point.errors[measure.name]]),
            np.array([bar_of(point)]) if cost == TIME else None,
        )
        for point in study.points
        if not np.isnan(cost_value(point, cost)) and not np.isnan(point.errors.get(measure.name, np.nan))
    )
    if not series:
        return ChartEmpty(_why_empty(study.points, measure, cost))
    front = pareto_front(study.points, measure.name, "" if cost == TIME else cost)
    return ChartPicture(
        cost_axis(cost, study.work.unit),
        ChartAxis(measure.title, measure.unit),
        series,
        tuple(point.method for point in front),
        ringed,
    )


def _why_empty(points: Sequence[Point], measure: ErrorMeasure, cost: str) -> str:
    measured = [point for point in points if point.is_measured]
    if not measured:
        return "Every method refused this work. The figures on the left give the reasons."
    reasons = dict.fromkeys(point.reasons.get(measure.name, "") for point in measured)
    return " ".join([f"“{measure.title}” is not defined for this work.", *filter(None, reasons)])


def cost_axis(cost: str, unit: str) -> ChartAxis:
    """Return the axis of a cost."""
    return ChartAxis(cost_title(cost, unit), "s" if cost == TIME else "")


def growth_of(study: Study, cost: str, numbers: Mapping[str, int]) -> ChartPicture | ChartEmpty:
    """Return the chart of a cost against the dial that it grows with, one line for each method."""
    dial = cost_dial(study.work)
    if dial is None:
        return ChartEmpty(f"“{study.work.title}” has no size that could grow. Choose another work.")
    if len(study.growth) < 2:
        return ChartEmpty(f"How cost grows with “{dial.title.lower()}” has not been measured.")
    best = {each.method: each.value for each in best_values(study)} if cost == TIME else {}
    series = tuple(
        found
        for point in study.points
        if (found := _growing(study.growth, point, title_of(point, numbers), numbers, cost)) is not None
    )
    series = tuple(
        replace(each, best=int(np.flatnonzero(each.x == best[each.key])[0])) if each.key in best else each
        for each in series
    )
    if not series:
        return ChartEmpty("Every method refused this work. The figures on the left give the reasons.")
    axes = ChartAxis(dial.title, dial.unit), cost_axis(cost, study.work.unit)
    return ChartPicture(*axes, series, is_named=len(series) <= MOST_NAMED)


def _growing(
    growth: Mapping[float, tuple[Point, ...]], point: Point, title: str, numbers: Mapping[str, int], cost: str
) -> ChartSeries | None:
    """Return the line of one method; ``None``: it has no numbers."""
    found: list[tuple[float, float, tuple[float, float]]] = []
    for value in sorted(growth):
        here = next((each for each in growth[value] if each.method == point.method), None)
        if here is not None and not np.isnan(cost_value(here, cost)):
            found.append((value, cost_value(here, cost), bar_of(here)))
    if not found:
        return None
    return ChartSeries(
        point.method,
        title,
        numbers[point.method],
        np.array([value for value, _, _ in found]),
        np.array([amount for _, amount, _ in found]),
        y_spread=np.array([spread for _, _, spread in found]) if cost == TIME else None,
    )
