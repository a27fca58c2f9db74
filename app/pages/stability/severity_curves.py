"""How wrong each method is along the one axis of an experiment, as a chart."""

from collections.abc import Mapping

import numpy as np

from core.records.arrays import Floats
from core.study.stability import Axis, ExperimentInfo
from widgets.charts.records import ChartAxis, ChartEmpty, ChartPicture, ChartSeries

SEVERITY = "Severity, how wrong a run is"
BELOW_ZERO = "This axis has values below 0, which have no place on a logarithmic axis: the maps show them."
NOTHING_RUN = (
    "How wrong each method is along the axis, one line for each; it comes with the cells of the map."
)


def has_curves(info: ExperimentInfo) -> bool:
    """Return whether an experiment has one axis, so that severity can be drawn against it."""
    return len(info.axes) == 1


def severity_chart(
    axis: Axis, severities: Mapping[str, Floats], titles: Mapping[str, str]
) -> ChartPicture | ChartEmpty:
    """Return the chart of the severities (N,) of methods at the N values of an axis; NaN has no place."""
    if min(axis.values) < 0:
        return ChartEmpty(BELOW_ZERO)
    numbers = {method: number for number, method in enumerate(titles)}
    series = tuple(
        ChartSeries(method, titles[method], numbers[method], np.array(axis.values), values)
        for method, values in severities.items()
        if not np.isnan(values).all()
    )
    if not series:
        return ChartEmpty(NOTHING_RUN)
    return ChartPicture(ChartAxis(axis.title, axis.unit), ChartAxis(SEVERITY), series, is_named=False)
