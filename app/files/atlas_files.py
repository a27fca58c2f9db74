"""An atlas that was saved as JSON opens again: it shows the runs of the day it was made."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from app.files.saved_records import SavedRecordError, read_record
from app.files.state_models import Count, Record
from core.records.arrays import Floats
from core.study.stability import Atlas, Axis, ExperimentInfo, Outcome, StabilityMap

PROGRAM = "rasterscope stress"
VERSION = 1
"""Of the format; files of others are refused."""
EXTENSION = ".json"


class AtlasFileError(ValueError):
    """An atlas file cannot be opened; the message is one sentence."""


class AxisRecord(Record):
    """A ``core.study.stability.Axis``."""

    name: str
    title: str
    unit: str
    values: Annotated[tuple[float, ...], Field(min_length=1)]
    is_logarithmic: bool


class MapRecord(Record):
    """A ``core.study.stability.StabilityMap``."""

    method: str
    title: str
    outcome: list[list[Count]]
    severity: list[list[float | None]]
    """``None``: no number."""
    remarks: tuple[tuple[str, ...], ...] = ()
    """Files of earlier versions of the program have none."""
    seconds: tuple[list[float | None], ...] = ()
    """Of maps that were timed; ``None``: no number."""


class AtlasFileRecord(Record):
    """A whole atlas file."""

    program: Literal["rasterscope stress"]
    version: Literal[1]
    experiment: Annotated[str, Field(min_length=1)]
    title: str
    question: str
    claim: str
    axes: Annotated[tuple[AxisRecord, ...], Field(min_length=1, max_length=2)]
    seed: Count
    machine: dict[str, str]
    outcomes: list[str]
    """Names of the outcomes, in the order of their numbers in the maps."""
    maps: Annotated[tuple[MapRecord, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _fits_together(self) -> "AtlasFileRecord":
        known = {outcome.name.lower() for outcome in Outcome}
        for name in self.outcomes:
            if name not in known:
                raise ValueError(f"an outcome must be one of {', '.join(sorted(known))}, got {name}")
        rows = len(self.axes[1].values) if len(self.axes) > 1 else 1
        columns = len(self.axes[0].values)
        for each in self.maps:
            optional = (each.remarks or each.outcome, each.seconds or each.outcome)
            for cells in (each.outcome, each.severity, *optional):
                if len(cells) != rows or any(len(row) != columns for row in cells):
                    raise ValueError(f"maps must have {rows} rows of {columns} cells, {each.method} has not")
            if any(number >= len(self.outcomes) for row in each.outcome for number in row):
                raise ValueError(
                    f"outcomes must be below {len(self.outcomes)}, {each.method} has a larger one"
                )
        if len({each.method for each in self.maps}) < len(self.maps):
            raise ValueError("every method must have one map, one has two")
        return self


def load_atlas(path: str | Path) -> Atlas:
    """Open an atlas file; AtlasFileError if it cannot be opened; the message is one sentence that names the field."""
    path = Path(path)
    try:
        return _atlas(read_record(path, AtlasFileRecord, PROGRAM, "an atlas", VERSION))
    except SavedRecordError as problem:
        raise AtlasFileError(f"{path.name} cannot be opened: {problem}") from problem


def _numbers(cells: Sequence[list[float | None]]) -> Floats:
    """Return numbers of cells, (rows, columns) float64; NaN where there is none."""
    return np.array([[np.nan if value is None else value for value in row] for row in cells], float, ndmin=2)


def _atlas(record: AtlasFileRecord) -> Atlas:
    numbers = np.array([Outcome[name.upper()] for name in record.outcomes], np.uint8)
    maps = tuple(
        StabilityMap(
            each.method,
            each.title,
            numbers[np.array(each.outcome, np.int64)],
            _numbers(each.severity),
            each.remarks,
            _numbers(each.seconds),
        )
        for each in record.maps
    )
    info = ExperimentInfo(
        name=record.experiment,
        title=record.title,
        question=record.question,
        axes=tuple(Axis(**axis.model_dump()) for axis in record.axes),
        methods=tuple(each.method for each in record.maps),
        claim=record.claim,
    )
    return Atlas(info, maps, record.seed, record.machine)
