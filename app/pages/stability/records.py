"""From an atlas to what the page shows: maps, curves of severity, the figures of a cell, the picture of a case."""

from collections.abc import Sequence
from dataclasses import replace
from html import escape
from math import isnan

import numpy as np

from app.export.failures import MARKS, WORDS
from app.pages.stability.jobs import CaseFound, ExperimentChoice, RowRun
from app.pages.words import machine_words
from core import Frame
from core.explain.number_text import number_text
from core.explain.stage_texts import family_title
from core.framebuffer.display import to_display
from core.records.words import counted
from core.scene import ClipScene
from core.study.cases import Atlas, ExperimentInfo, StabilityMap
from core.study.record import Axis, Opening, Outcome, Verdict
from widgets.experiments.case_pictures import CaseRecord
from widgets.experiments.maps import UNKNOWN, AtlasAxis, AtlasMap, AtlasRecord, CellKind, CellPlace
from widgets.experiments.series import ChartAxis, ChartEmpty, ChartPicture, ChartSeries
from widgets.grid.layers import GridBuffer


def blank_atlas(info: ExperimentInfo, axes: tuple[Axis, ...], seed: int) -> Atlas:
    """Return an atlas of an experiment on these axes without a cell that has been run."""
    shape = len(axes[1].values) if len(axes) > 1 else 1, len(axes[0].values)
    remarks = (("",) * shape[1],) * shape[0]
    maps = tuple(
        StabilityMap(method, method, np.full(shape, UNKNOWN, np.uint8), np.full(shape, np.nan), remarks)
        for method in info.methods
    )
    return Atlas(replace(info, axes=axes), maps, seed)


def with_row(atlas: Atlas, run: RowRun) -> Atlas:
    """Return an atlas with a row that has been run; the cells of its map are set in their place."""
    maps = list(atlas.maps)
    number = atlas.experiment.methods.index(run.method)
    each, remarks = maps[number], list(maps[number].remarks)
    each.outcome[run.row] = [verdict.outcome for verdict in run.verdicts]
    each.severity[run.row] = [verdict.severity for verdict in run.verdicts]
    remarks[run.row] = tuple(verdict.remark for verdict in run.verdicts)
    maps[number] = replace(each, remarks=tuple(remarks))
    return replace(atlas, maps=tuple(maps))


def map_of(atlas: Atlas, method: str) -> StabilityMap:
    """Return the map of a method."""
    return next(each for each in atlas.maps if each.method == method)


def atlas_record(atlas: Atlas) -> AtlasRecord:
    """Return what the maps show."""
    axes, titles = atlas.experiment.axes, method_titles(atlas.experiment.methods)
    up = axis_record(axes[1]) if len(axes) > 1 else None
    maps = tuple(AtlasMap(each.method, titles[each.method], each.outcome) for each in atlas.maps)
    return AtlasRecord(cell_kinds(), axis_record(axes[0]), up, maps)


def axis_record(axis: Axis) -> AtlasAxis:
    """Return one axis with its values as texts."""
    title = f"{axis.title} ({axis.unit})" if axis.unit else axis.title
    return AtlasAxis(title, tuple(number_text(value) for value in axis.values), axis.is_logarithmic)


def method_titles(methods: tuple[str, ...]) -> dict[str, str]:
    """Return what each method is called: its names alone where all are of the same families."""
    families = {tuple(part.split("=", 1)[0] for part in method.split()) for method in methods}
    if len(families) > 1:
        return {method: _settings_text(method) for method in methods}
    return {method: ", ".join(part.split("=", 1)[1] for part in method.split()) for method in methods}


def _settings_text(method: str) -> str:
    """Return a method's settings in words: ``Fill: spans, Edge functions: float32``."""
    parts = (part.split("=", 1) for part in method.split())
    return ", ".join(f"{family_title(family)}: {name}" for family, name in parts)


def values_at(info: ExperimentInfo, place: CellPlace) -> tuple[float, ...]:
    """Return the value of every axis at a cell."""
    return tuple(
        axis.values[index] for axis, index in zip(info.axes, (place.column, place.row), strict=False)
    )


def first_failure(atlas: Atlas, method: str) -> CellPlace | None:
    """Return the first cell, row by row, at which a method fails; ``None``: there is none."""
    kinds = map_of(atlas, method).outcome
    fails = ~np.isin(kinds, (Outcome.RIGHT, Outcome.REFUSED, UNKNOWN))
    row, column = divmod(int(fails.argmax()), kinds.shape[1])
    return CellPlace(method, column, row) if fails.any() else None


def place_on_curve(info: ExperimentInfo, method: str, index: int) -> CellPlace:
    """Return the cell of a point of a curve along the only axis; a negative ``index`` counts from its end."""
    return CellPlace(method, index % len(info.axes[0].values), 0)


def place_sentence(info: ExperimentInfo, values: tuple[float, ...]) -> str:
    """Return the values of all axes in words."""
    parts = (
        f"{axis.title.lower()} {number_text(value)}{f' {axis.unit}' if axis.unit else ''}"
        for axis, value in zip(info.axes, values, strict=True)
    )
    return ", ".join(parts)


def experiment_text(choice: ExperimentChoice) -> str:
    """Return what is known of an experiment, as rich text."""
    info = choice.info if choice.result is None else choice.result.content.experiment
    axes = "".join(
        f"<li>{escape(axis.title)}: {number_text(axis.values[0])} to {number_text(axis.values[-1])}"
        f"{escape(f' {axis.unit}' if axis.unit else '')}, {counted(len(axis.values), 'value')}</li>"
        for axis in info.axes
    )
    methods = "".join(f"<li>{escape(line)}</li>" for line in method_lines(choice))
    order = "in the order of the maps" if choice.result is None else "most failures first"
    parts = [
        f"<b>{escape(info.title)}</b><p>Axes:</p><ul style='margin-left:-24px'>{axes}</ul>",
        f"Methods, {order}:<ul style='margin-left:-24px'>{methods}</ul>",
    ]
    result = choice.result
    if result is not None:
        origin = f"Opened from {escape(result.path)}. " if result.path else ""
        parts.append(
            f"<p>{origin}Seed {result.content.seed}. {escape(machine_words(result.content.machine))}</p>"
            "<p>Point at a cell to read its outcome. Click it to see the case; double-click to step it.</p>"
        )
    return "".join(parts)


def method_lines(choice: ExperimentChoice) -> tuple[str, ...]:
    """Return the methods; of an experiment that has been run with what was measured, most failures first."""
    if choice.result is None:
        return tuple(method_titles(choice.info.methods).values())
    fails = failure_counts(choice.result.content)
    size = {each.method: each.outcome.size for each in choice.result.content.maps}
    worst = sorted(fails, key=lambda method: -fails[method])
    titles = method_titles(tuple(fails))
    return tuple(f"{titles[method]}: {fails[method]:,} of {size[method]:,} fail" for method in worst)


def cell_text(atlas: Atlas, place: CellPlace) -> str:
    """Return the figures of one cell, as rich text."""
    info, each = atlas.experiment, map_of(atlas, place.key)
    kind, severity = int(each.outcome[place.row, place.column]), float(each.severity[place.row, place.column])
    lines = [f"<b>{escape(method_titles(info.methods)[place.key])}</b>"]
    for axis, value in zip(info.axes, values_at(info, place), strict=True):
        unit = f" {escape(axis.unit)}" if axis.unit else ""
        lines.append(f"{escape(axis.title)}: <b>{number_text(value)}</b>{unit}")
    if kind == UNKNOWN:
        lines.append("Not run yet.")
    else:
        lines.append(f"Outcome: <b>{WORDS[Outcome(kind)]}</b>")
        if severity and not isnan(severity):
            lines.append(f"Severity: <b>{number_text(severity)}</b>")
        remark = each.remark(place.column, place.row)
        if remark:
            lines.append(f"{escape(remark[:1].upper() + remark[1:])}.")
    return "<p>" + "</p><p>".join(lines) + "</p>"


def spoken_cell(atlas: Atlas, place: CellPlace) -> str:
    """Return what a screen reader says of one cell."""
    info, each = atlas.experiment, map_of(atlas, place.key)
    kind, severity = int(each.outcome[place.row, place.column]), float(each.severity[place.row, place.column])
    where = place_sentence(info, values_at(info, place))
    outcome = "not run yet" if kind == UNKNOWN else WORDS[Outcome(kind)]
    amount = f", severity {number_text(severity, 3)}" if severity and kind != UNKNOWN else ""
    return f"{method_titles(info.methods)[place.key]}, {where}: {outcome}{amount}"


def case_record(found: CaseFound) -> CaseRecord:
    """Return what is shown of a cell, as it was run or made small."""
    info, opening, shrunk = found.order.experiment.info, found.opening, found.shrunk
    if shrunk is None:
        heading = f"{found.order.place.key} at {place_sentence(info, found.order.values)}"
        verdict = verdict_sentence(found.verdict.outcome, found.verdict.remark)
    else:
        heading = f"{info.title}: smallest case of {found.order.place.key}"
        verdict = f"{shrunk.sentence} It took {counted(shrunk.run_count, 'run')}."
    is_refused = shrunk is None and found.verdict.outcome is Outcome.REFUSED
    if found.frame is None and opening is not None and not is_refused:
        size = "{:,} × {:,}".format(*opening.scene.size)
        verdict += f" Its picture has {size} pixels: open it in the stepper to see the part that matters."
    return CaseRecord(
        heading,
        verdict,
        buffers=None if found.frame is None else case_buffers(found.frame),
        pixel=None if opening is None or found.frame is None else opening.pixel,
        has_formats=opening is not None and has_formats(opening),
        can_step=opening is not None,
        can_shrink=shrunk is None and is_failure(found.verdict) and found.order.experiment.can_shrink,
        can_save=shrunk is not None,
    )


def is_failure(verdict: Verdict) -> bool:
    """Return whether a run went wrong; a method that refuses, with a reason, does not."""
    return verdict.outcome not in (Outcome.RIGHT, Outcome.REFUSED)


def has_formats(opening: Opening) -> bool:
    """Return whether the pixels of a case can be tested in every number format: triangles in clip space, filled."""
    is_filled = opening.settings.polygon_mode == "fill" and opening.stage in ("edges", "raster")
    return is_filled and isinstance(opening.scene, ClipScene)


def verdict_sentence(outcome: Outcome, remark: str) -> str:
    """Return what came of a run in one sentence."""
    word = WORDS[outcome]
    said = word[:1].upper() + word[1:]
    return f"{said}: {remark}." if remark else f"{said}."


def case_buffers(frame: Frame) -> tuple[GridBuffer, GridBuffer]:
    """Return the picture, and how often each pixel is covered: 0, 1 or twice at least."""
    highest = max(2.0, float(frame.cover_count.max(initial=0)))
    return (
        GridBuffer("picture", to_display(frame.color).pixels, "color"),
        GridBuffer("times covered", frame.cover_count, "scalar", range=(0.0, highest)),
    )


def failure_counts(atlas: Atlas) -> dict[str, int]:
    """Return how many cells of each method fail; what was refused, with a reason, does not."""
    return {
        each.method: each.outcome.size - each.count(Outcome.RIGHT) - each.count(Outcome.REFUSED)
        for each in atlas.maps
    }


def counts_sentence(atlas: Atlas) -> str:
    """Return in words how many cells of which method fail."""
    fails = failure_counts(atlas)
    total = sum(fails.values())
    worst = max(fails, key=lambda method: fails[method])
    cells = sum(each.outcome.size for each in atlas.maps)
    if not total:
        return f"None of {cells:,} runs fails."
    title = method_titles(tuple(fails))[worst]
    return f"{total:,} of {cells:,} runs fail; {title} most often, {fails[worst]:,} times."


WHITE, BLACK = "#ffffff", "#000000"
LOOKS = {
    Outcome.RIGHT: (("#E8EEF2", "#2f3940"), (BLACK, "#a5adb4")),
    Outcome.HOLE: (("#0072B2", "#2f94d1"), (WHITE, BLACK)),
    Outcome.DOUBLE_HIT: (("#D55E00", "#f07b23"), (BLACK, BLACK)),
    Outcome.WRONG_ORDER: (("#CC79A7", "#d98cb8"), (BLACK, BLACK)),
    Outcome.NOT_A_NUMBER: ((BLACK, WHITE), (WHITE, BLACK)),
    Outcome.OVERFLOW: (("#8A7A00", "#d8c400"), (BLACK, BLACK)),
    Outcome.WRONG_PICTURE: (("#882255", "#c4548c"), (WHITE, BLACK)),
    Outcome.REFUSED: (("#BBBBBB", "#5a6066"), (BLACK, WHITE)),
}
"""Fills and inks of cells, each on a light and on a dark background: what is right keeps back, what is wrong is seen.

Colours that colour-blind people tell apart (M. Okabe, K. Ito, 2008); wine (P. Tol, 2021) where they have green.
Nothing that fails is green: a map of green cells would be read as one where all is well.
"""


def cell_kinds() -> tuple[CellKind, ...]:
    """Return the look of every outcome, in the order of `Outcome`."""
    marks = MARKS | {Outcome.RIGHT: "·"}
    return tuple(CellKind(WORDS[outcome], marks[outcome], *LOOKS[outcome]) for outcome in Outcome)


SEVERITY = "Severity, how wrong a run is"
BELOW_ZERO = "This axis has values below 0. A logarithmic axis cannot show them; the maps do."
NOTHING_RUN = "Severity along the axis, one line for each method. It appears with the cells of the map."


def has_curves(info: ExperimentInfo) -> bool:
    """Return whether an experiment has one axis, so that severity can be drawn against it."""
    return len(info.axes) == 1


def severity_chart(axis: Axis, maps: Sequence[StabilityMap]) -> ChartPicture | ChartEmpty:
    """Return the chart of severity, of maps of one row, at the values of their axis; NaN has no place."""
    if min(axis.values) < 0:
        return ChartEmpty(BELOW_ZERO)
    titles = method_titles(tuple(each.method for each in maps))
    series = tuple(
        ChartSeries(each.method, titles[each.method], number, np.array(axis.values), each.severity[0])
        for number, each in enumerate(maps)
        if not np.isnan(each.severity).all()
    )
    if not series:
        return ChartEmpty(NOTHING_RUN)
    return ChartPicture(ChartAxis(axis.title, axis.unit), ChartAxis(SEVERITY), series, is_named=False)
