"""An atlas as files: JSON that opens again, every cell as CSV, the maps as SVG and PNG."""

import csv
from collections.abc import Sequence
from functools import partial
from io import StringIO
from math import isnan
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from app.export.sheet import MARGIN, WIDTH, Sheet, sheet_bytes
from app.files.file_access import write_files
from app.files.saved_records import SavedRecordError, read_record
from app.files.state_files import readable_json
from app.files.state_models import Count, Record
from app.pages.stability.records import atlas_record, has_curves, severity_chart
from app.pages.words import machine_words
from core.records.arrays import Floats
from core.study.cases import Atlas, ExperimentInfo, StabilityMap
from core.study.record import Axis, Outcome
from widgets.experiments.map_view import AtlasView

# An atlas that was saved as JSON opens again: it shows the runs of the day it was made.


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


# A stability experiment as files: every cell as CSV, all of it as JSON, the maps as SVG and PNG.


ENDINGS = (".csv", ".json", ".svg", ".png")
"""Of the files that an atlas is written to."""
CURVES_HEIGHT = 300


def atlas_stem(atlas: Atlas) -> str:
    """Return what the files of an atlas are called, without their endings."""
    return f"stress-{atlas.experiment.name}"


def atlas_csv(atlas: Atlas) -> str:
    """Return a table with a row for every cell of every method, in rows that stand alone."""
    axes = atlas.experiment.axes
    names = ["experiment", "seed", "method", *(axis.name for axis in axes), "outcome", "severity", "remark"]
    is_timed = all(each.seconds.size for each in atlas.maps)
    names += ["seconds"] * is_timed
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*names, *atlas.machine])
    machine = list(atlas.machine.values())
    for each in atlas.maps:
        for row, values in enumerate(each.outcome.tolist()):
            for column, value in enumerate(values):
                place = [repr(axis.values[k]) for axis, k in zip(axes, (column, row), strict=False)]
                severity = _shown(each.severity[row, column])
                seconds = [_shown(each.seconds[row, column])] if is_timed else []
                cells = [atlas.experiment.name, atlas.seed, each.method, *place, Outcome(value).name.lower()]
                writer.writerow([*cells, severity, each.remark(column, row), *seconds, *machine])
    return text.getvalue()


def _shown(value: float) -> str:
    """Return a number of a cell; nothing for one that is not known."""
    return "" if isnan(value) else repr(float(value))


def _numbers_of_cells(cells: Floats) -> list[list[float | None]]:
    """Return the numbers of cells (rows, columns) as JSON has them; one that is not known is null."""
    return [[None if isnan(value) else value for value in row] for row in cells.tolist()]


def atlas_json(atlas: Atlas) -> str:
    """Return everything that an atlas holds; a severity that is no number is null."""
    info = atlas.experiment
    return readable_json(
        {
            "program": "rasterscope stress",
            "version": 1,
            "experiment": info.name,
            "title": info.title,
            "question": info.question,
            "claim": info.claim,
            "axes": [
                {name: getattr(axis, name) for name in AxisRecord.model_fields}
                | {"values": list(axis.values)}
                for axis in info.axes
            ],
            "seed": atlas.seed,
            "machine": dict(atlas.machine),
            "outcomes": [outcome.name.lower() for outcome in Outcome],
            "maps": [
                {
                    "method": each.method,
                    "title": each.title,
                    "outcome": each.outcome.tolist(),
                    "severity": _numbers_of_cells(each.severity),
                    "remarks": [list(row) for row in each.remarks],
                }
                | ({"seconds": _numbers_of_cells(each.seconds)} if each.seconds.size else {})
                for each in atlas.maps
            ],
        }
    )


def atlas_content(atlas: Atlas, ending: str) -> bytes | None:
    """Return the content of a file with one of `ENDINGS`; ``None``: there is no such kind of file."""
    if ending == ".csv":
        return atlas_csv(atlas).encode()
    if ending == ".json":
        return atlas_json(atlas).encode() + b"\n"
    return sheet_bytes(lambda: atlas_sheet(atlas), ending) if ending in ENDINGS else None


def atlas_sheet(atlas: Atlas) -> Sheet:
    """Return the maps as the Stability page draws them, with curves where there is one axis, claim and machine."""
    info = atlas.experiment
    sheet = Sheet(info.title, info.question)
    maps = AtlasView(sheet)
    maps.show_atlas(atlas_record(atlas))
    maps.show_whole(WIDTH - 2 * MARGIN)
    sheet.add(maps)
    if has_curves(info):
        sheet.draw(severity_chart(info.axes[0], atlas.maps), CURVES_HEIGHT)
    sheet.write([info.claim, f"Seed {atlas.seed}. {machine_words(atlas.machine)}"])
    return sheet


def export_atlas(atlas: Atlas, folder: Path) -> list[Path]:
    """Write an experiment into a folder as CSV, JSON, SVG and PNG; files of the same name are replaced.

    Raises OSError if a file cannot be written; the message is one sentence.
    """
    return write_files(folder, atlas_stem(atlas), ENDINGS, partial(atlas_content, atlas))
