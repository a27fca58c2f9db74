"""A stability experiment as files: every cell as CSV, all of it as JSON, the maps as SVG and PNG."""

import csv
from functools import partial
from io import StringIO
from math import isnan
from pathlib import Path

from app.export.sheet import MARGIN, WIDTH, Sheet, sheet_bytes
from app.files.atlas_files import AxisRecord
from app.files.file_writing import write_files
from app.files.state_files import readable_json
from app.pages.stability.records import atlas_record, has_curves, severity_chart
from app.pages.words import machine_words
from core.records.arrays import Floats
from core.study.stability import Atlas, Outcome
from widgets.atlas.view import AtlasView

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


def _numbers(cells: Floats) -> list[list[float | None]]:
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
                    "severity": _numbers(each.severity),
                    "remarks": [list(row) for row in each.remarks],
                }
                | ({"seconds": _numbers(each.seconds)} if each.seconds.size else {})
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
