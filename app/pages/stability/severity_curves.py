"""How wrong each method is along the one axis of an experiment, as a chart and as a drawing."""

from collections.abc import Mapping, Sequence

import numpy as np

from app.export.study_axes import LogAxis, axis_of, ticks
from app.export.study_chart import LINES
from app.export.study_labels import spread_apart
from app.export.svg_shapes import GRID, QUIET, TEXT, circle, line, polyline, text
from app.pages.compare.words import digits
from core.records.arrays import Floats
from core.study.stability import Atlas, Axis, ExperimentInfo
from widgets.charts.records import ChartAxis, ChartEmpty, ChartPicture, ChartSeries

SEVERITY = "Severity, how wrong a run is"
BELOW_ZERO = "This axis has values below 0, which have no place on a logarithmic axis: the maps show them."
NOTHING_RUN = (
    "How wrong each method is along the axis, one line for each; it comes with the cells of the map."
)
LEFT, RIGHT, HEIGHT, ZERO_GAP, NAME_WIDTH = 84, 700, 220, 26, 22
"""Pixels of the drawing."""


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


def severity_svg(atlas: Atlas, top: float) -> tuple[list[str], float]:
    """Return the same as shapes that begin at ``top``, and where they end."""
    axis, bottom = atlas.experiment.axes[0], top + 24 + HEIGHT
    if min(axis.values) < 0:
        return [], top
    lines = {each.method: each.severity[0] for each in atlas.maps}
    across = axis_of(list(axis.values), LEFT, RIGHT)
    sizes = [float(value) for values in lines.values() for value in values if value > 0]
    up = axis_of(sizes, bottom - ZERO_GAP, top + 24)
    unit = f" ({axis.unit})" if axis.unit else ""
    parts = [
        text(24, top + 12, f"{SEVERITY}; 0 is right", size=12),
        *_grid(across, up if sizes else None, top + 24, bottom),
        text(RIGHT, bottom + 36, f"{axis.title}{unit}", size=11, color=QUIET, anchor="end"),
    ]
    places = {
        method: [
            (across.place(where), bottom if value == 0 else up.place(float(value)))
            for where, value in zip(axis.values, values, strict=True)
            if np.isfinite(value)
        ]
        for method, values in lines.items()
    }
    return [*parts, *_lines(places, top + 24, bottom + 10)], bottom + 52


def _grid(across: LogAxis, up: LogAxis | None, top: float, bottom: float) -> list[str]:
    """Return the lines and numbers of both axes; ``up`` is ``None`` where every severity is 0."""
    parts = [
        line(LEFT, bottom, RIGHT, bottom, TEXT, 1),
        text(LEFT - 8, bottom + 4, "0", size=11, weight=600, anchor="end"),
    ]
    for value in ticks(across):
        x = across.place(value)
        parts.append(line(x, top, x, bottom + 6, GRID, 1))
        parts.append(text(x, bottom + 20, digits(value, 1), size=10, anchor="middle"))
    for value, y in [] if up is None else [(value, up.place(value)) for value in ticks(up)]:
        parts.append(line(LEFT, y, RIGHT, y, GRID, 1))
        parts.append(text(LEFT - 8, y + 4, digits(value, 2), size=10, anchor="end"))
    return parts


def _lines(places: Mapping[str, Sequence[tuple[float, float]]], top: float, bottom: float) -> list[str]:
    """Return the line of every method through its places, with its name between ``top`` and ``bottom``."""
    parts, ends = [], []
    for number, (method, through) in enumerate(places.items()):
        color, dashes = LINES[number % len(LINES)], "" if number < len(LINES) else "5 3"
        if through:
            parts.append(polyline(through, color, 1.8, dashes=dashes))
            parts += [circle(x, y, 2.5, color, filled=True) for x, y in through]
            ends.append((through[-1], method, color))
    heights = spread_apart([place[1] for place, _, _ in ends], 14, top, bottom)
    for ((x, y), method, color), height in zip(ends, heights, strict=True):
        parts.append(line(x + 4, y, RIGHT + 18, height, color, 0.8))
        parts.append(text(RIGHT + NAME_WIDTH, height + 4, method, size=11))
    return parts
