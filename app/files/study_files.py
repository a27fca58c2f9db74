"""A study as a file (JSON), written whole and opened again; a saved study shows the numbers of the day it was made."""

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from app.files.saved_records import SavedRecordError, read_record
from app.files.state_files import readable_json
from app.files.state_models import Count, Record
from core.settings import Settings, settings_from_texts, settings_record
from core.study.accuracy.record import Axis, ErrorMeasure, Point, Study, WorkKind

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
    """A ``core.study.accuracy.record.Axis``."""

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
