"""A study as files: written whole as JSON and opened again; its numbers as CSV, its charts as SVG and PNG."""

import csv
from functools import partial
from io import StringIO
from math import isnan
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from app.export.sheet import Sheet, sheet_bytes
from app.files.file_access import write_files
from app.files.saved_records import SavedRecordError, read_record
from app.files.state_files import readable_json
from app.files.state_models import Count, Record
from app.pages.compare.charts import TIME, growth_of, numbers_of, scatter_of, title_of
from app.pages.words import machine_sentence, settings_sentence, work_sentence
from core.setting_texts import settings_from_texts, settings_record
from core.settings import Settings
from core.study.record import Axis, ErrorMeasure, Point, Study, WorkKind, pareto_front

# A study as a file (JSON), written whole and opened again; a saved study shows the numbers of the day it
# was made.


VERSION: Literal[1] = 1
"""Of the format; files of others are refused."""
EXTENSION = ".json"

Seconds = Annotated[float, Field(ge=0)]


class StudyFileError(ValueError):
    """A study file cannot be opened; the message is one sentence."""


class MeasureRecord(Record):
    """A ``core.study.ErrorMeasure``."""

    name: str
    title: str
    unit: str


class DialRecord(Record):
    """A ``core.study.record.Axis``."""

    name: str
    title: str
    unit: str
    values: Annotated[tuple[float, ...], Field(min_length=1)]
    default: float
    is_cost: bool
    setting: str = ""


class WorkRecord(Record):
    """A ``core.study.WorkKind``."""

    name: str
    title: str
    unit: str
    dials: tuple[DialRecord, ...]


class PointRecord(Record):
    """A ``core.study.Point``."""

    method: str
    title: str
    seconds: tuple[Seconds, ...]
    unit_count: Count
    counts: dict[str, Count]
    errors: dict[str, Annotated[float, Field(ge=0)] | None]
    """``None``: not defined."""
    reasons: dict[str, str]
    refused: str


class GrowthRecord(Record):
    """The points at one value of the cost dial."""

    value: float
    points: tuple[PointRecord, ...]


class StudyRecord(Record):
    """A whole study file."""

    program: Literal["rasterscope study"]
    version: Literal[1]
    family: str
    title: str
    scene: str
    work: WorkRecord
    dials: dict[str, float]
    seed: int
    settings: dict[str, str | int]
    machine: dict[str, str]
    measures: Annotated[tuple[MeasureRecord, ...], Field(min_length=1)]
    points: tuple[PointRecord, ...]
    growth: tuple[GrowthRecord, ...]

    @model_validator(mode="after")
    def _fits_together(self) -> "StudyRecord":
        wanted, found = {dial.name for dial in self.work.dials}, set(self.dials)
        if wanted != found:
            names = ", ".join(sorted(wanted)) or "none"
            raise ValueError(
                f"dials must be those of its work ({names}), got {', '.join(sorted(found)) or 'none'}"
            )
        measures = [measure.name for measure in self.measures]
        for points in (self.points, *(each.points for each in self.growth)):
            methods = [point.method for point in points]
            for name, values in (("measure", measures), ("method", methods)):
                if len(set(values)) < len(values):
                    raise ValueError(f"every {name} must be there once, one is there twice")
            for point in points:
                if unknown := set(point.errors) - set(measures):
                    raise ValueError(
                        f"errors must be those of the measures, {point.method} has {min(unknown)}"
                    )
        return self


def study_json(study: Study) -> str:
    """Return the text of a study file."""
    record = StudyRecord(
        program="rasterscope study",
        version=VERSION,
        family=study.family,
        title=study.title,
        scene=study.scene,
        work=_work_record(study.work),
        dials=dict(study.dials),
        seed=study.seed,
        settings=settings_record(study.settings),
        machine=dict(study.machine),
        measures=tuple(MeasureRecord(**vars(measure)) for measure in study.measures),
        points=tuple(_point_record(point) for point in study.points),
        growth=tuple(
            GrowthRecord(value=float(value), points=tuple(_point_record(point) for point in points))
            for value, points in study.growth.items()
        ),
    )
    return readable_json(record.model_dump(mode="json")) + "\n"


def _work_record(work: WorkKind) -> WorkRecord:
    dials = (DialRecord.model_validate(dial, from_attributes=True) for dial in work.dials)
    return WorkRecord(name=work.name, title=work.title, unit=work.unit, dials=tuple(dials))


def _point_record(point: Point) -> PointRecord:
    return PointRecord(
        method=point.method,
        title=point.title,
        seconds=tuple(point.seconds.tolist()),
        unit_count=point.unit_count,
        counts=dict(point.counts),
        errors={name: None if np.isnan(value) else float(value) for name, value in point.errors.items()},
        reasons=dict(point.reasons),
        refused=point.refused,
    )


def load_study(path: str | Path) -> Study:
    """Open a study file; StudyFileError if it cannot be opened; the message is one sentence that names the field."""
    path = Path(path)
    try:
        return _study(read_record(path, StudyRecord, "rasterscope study", "a study", VERSION))
    except SavedRecordError as problem:
        raise StudyFileError(f"{path.name} cannot be opened: {problem}") from problem


def _study(record: StudyRecord) -> Study:
    return Study(
        family=record.family,
        title=record.title,
        work=WorkKind(
            record.work.name,
            record.work.title,
            record.work.unit,
            tuple(Axis(**dial.model_dump()) for dial in record.work.dials),
        ),
        dials=record.dials,
        seed=record.seed,
        measures=tuple(ErrorMeasure(**measure.model_dump()) for measure in record.measures),
        points=tuple(_point(point) for point in record.points),
        growth={each.value: tuple(_point(point) for point in each.points) for each in record.growth},
        machine=record.machine,
        settings=_settings(record.settings),
        scene=record.scene,
    )


def _settings(texts: dict[str, str | int]) -> Settings:
    try:
        return settings_from_texts({name: str(value) for name, value in texts.items()})
    except ValueError as problem:
        raise SavedRecordError(f"settings: {problem}") from problem


def _point(record: PointRecord) -> Point:
    return Point(
        method=record.method,
        title=record.title,
        seconds=np.array(record.seconds),
        unit_count=record.unit_count,
        counts=record.counts,
        errors={name: np.nan if value is None else value for name, value in record.errors.items()},
        reasons=record.reasons,
        refused=record.refused,
    )


# A study as files: numbers as CSV and JSON, charts as SVG and PNG; with the machine, versions, date and
# settings.


ENDINGS = (".svg", ".png", ".csv", EXTENSION)
"""Of the files that a study is written to."""
CHART_HEIGHT = 460
EXPLANATION = (
    "A mark stands at the median of the times, its bar from the least to the end of the interval that holds the true "
    "median. The order of methods whose intervals overlap is undecided. The dashed line is the Pareto front: no other "
    "method beats a method on it in both."
)
FIXED = ("method", "title", "rounds", "unit", "units")
TIMES = ("median_seconds_per_unit", "least", "interval_low", "interval_high")


def study_stem(study: Study) -> str:
    """Return what the files of a study are called, without their endings."""
    return f"study-{study.family}-{study.work.name}"


def study_csv(study: Study) -> str:
    """Return a table with a row for every method, in rows that stand alone.

    Empty cells: not measured, or not defined; ``refused`` and ``not_defined`` say why. Points at other values of the
    cost dial follow with that value in the dial's column.
    """
    counts = sorted({name for point in study.points for name in point.counts})
    errors = [measure.name for measure in study.measures]
    dials = [dial.name for dial in study.work.dials]
    fronts = [f"on_front_{name}" for name in errors]
    machine = list(study.machine)
    context = {"family": study.family, "work": study.work.name, "scene": study.scene, "seed": study.seed}
    settings = {f"setting_{name}": value for name, value in vars(study.settings).items()}
    columns = [*context, *(f"dial_{name}" for name in dials), *FIXED, *TIMES, *errors, *fronts, *counts]
    columns += ["not_defined", "refused", *machine, *settings]
    text = StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    common = context | {f"dial_{name}": study.dials[name] for name in dials} | dict(study.machine) | settings
    front_of = {name: pareto_front(study.points, name) for name in errors}
    for point in study.points:
        on_front = {
            f"on_front_{name}": int(point in front) for name, front in front_of.items() if point.is_measured
        }
        writer.writerow(common | on_front | point_cells(study, point))
    cost = next((dial.name for dial in study.work.dials if dial.is_cost), None)
    for value, points in study.growth.items():
        if cost is not None and value != study.dials[cost]:
            for point in points:
                writer.writerow(common | {f"dial_{cost}": value} | point_cells(study, point))
    return text.getvalue()


def point_cells(study: Study, point: Point) -> dict[str, object]:
    """Return the cells of one method."""
    cells: dict[str, object] = {"method": point.method, "title": point.title, "refused": point.refused}
    if not point.is_measured:
        return cells
    times = (point.median, point.least, *point.interval)
    cells |= {"rounds": len(point.seconds), "unit": study.work.unit, "units": point.unit_count}
    cells |= dict(zip(TIMES, map(repr, times), strict=True))
    cells |= {name: "" if isnan(value) else repr(value) for name, value in point.errors.items()}
    cells |= dict(point.counts)
    cells["not_defined"] = " ".join(f"{name}: {reason}" for name, reason in point.reasons.items())
    return cells


def study_content(study: Study, measure: str | None, ending: str, cost: str = TIME) -> bytes | None:
    """Return the content of a file with one of `ENDINGS`; ``None``: there is no such kind of file.

    ``measure`` is the error of the chart, as in `export_study`, and ``cost`` what it is drawn against.
    """
    if ending == ".csv":
        return study_csv(study).encode()
    if ending == EXTENSION:
        return study_json(study).encode()
    if ending not in ENDINGS:
        return None
    return sheet_bytes(lambda: study_sheet(study, chosen_measure(study, measure), cost), ending)


def chosen_measure(study: Study, name: str | None) -> ErrorMeasure:
    """Return the error of a name, or the first; ValueError for one that the study does not have."""
    for measure in study.measures:
        if name in (None, measure.name):
            return measure
    known = ", ".join(measure.name for measure in study.measures)
    raise ValueError(f"error of {study.family} must be one of {known}, got {name}")


def study_sheet(study: Study, measure: ErrorMeasure, cost: str = TIME) -> Sheet:
    """Return both charts as the Compare page draws them, with what is left out and where it was measured."""
    sheet = Sheet(f"{study.title}: accuracy against cost", f"{work_sentence(study)}.")
    numbers = numbers_of(study.points)
    sheet.draw(scatter_of(study, measure.name, cost, numbers), CHART_HEIGHT)
    if len(study.growth) > 1:
        sheet.draw(growth_of(study, cost, numbers), CHART_HEIGHT)
    names = [point.method for point in study.points]
    for point in study.points:
        reason = point.refused or point.reasons.get(measure.name, "")
        if reason:
            sheet.write([f"Not shown: {title_of(point, names)}. {reason}"])
    sheet.write([EXPLANATION, f"{settings_sentence(study)}.", machine_sentence(study)])
    return sheet


def export_study(study: Study, folder: Path, measure: str | None = None) -> list[Path]:
    """Write a study into a folder as CSV, JSON, SVG and PNG; files of the same name are replaced.

    Parameters
    ----------
    measure : str, optional
        The error of the chart; the first by default.

    Raises
    ------
    OSError
        If a file cannot be written; the message is one sentence.
    """
    return write_files(folder, study_stem(study), ENDINGS, partial(study_content, study, measure))
