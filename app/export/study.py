"""A study as files: numbers as CSV and JSON, charts as SVG and PNG; with the machine, versions, date and settings."""

import csv
from functools import partial
from io import StringIO
from math import isnan
from pathlib import Path

from app.export.sheet import Sheet, sheet_bytes
from app.files.file_writing import write_files
from app.files.study_files import EXTENSION, study_json
from app.pages.compare.charts import TIME, growth_of, numbers_of, scatter_of, title_of
from app.pages.words import machine_sentence, settings_sentence, work_sentence
from core.study.accuracy.record import ErrorMeasure, Point, Study, pareto_front

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
