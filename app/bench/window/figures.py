"""The answers of the window as figures: a table for a person, a CSV file for a spreadsheet."""

import csv
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from io import StringIO

import numpy as np

from app.bench.machine import Machine
from app.bench.report import aligned
from app.bench.window.script import Sample

HEADINGS = (
    *("action", "stage", "inputs", "median", "95 %", "longest", "stall"),
    *("processor", "95 %", "fixed work", "95 %"),
)
EVERY_STAGE = "all"
COLUMNS = (
    *("width", "height", "scene", "action", "stage", "level", "inputs", "median_ms", "p95_ms", "longest_ms"),
    *("stall_ms", "processor_median_ms", "processor_p95_ms", "fixed_median_ms", "fixed_p95_ms"),
    *("date", "processor", "cores", "system", "python", "numpy", "program", "display"),
)


@dataclass(frozen=True)
class Figures:
    """Some answers together, in milliseconds."""

    inputs: int
    median_ms: float
    p95_ms: float
    longest_ms: float
    stall_ms: float
    """The longest of all."""
    processor_median_ms: float
    processor_p95_ms: float
    fixed_median_ms: float
    fixed_p95_ms: float


def figures_of(samples: Iterable[Sample]) -> Figures:
    """Return what some answers come to."""
    answers = [sample.answer for sample in samples]
    times = 1000 * np.array([(each.wall, each.processor, each.fixed, each.stall) for each in answers])
    (wall, processor, fixed, _), (wall_95, processor_95, fixed_95, _) = np.percentile(
        times, [50, 95], axis=0
    ).tolist()
    longest, _, _, stall = times.max(axis=0).tolist()
    return Figures(len(answers), wall, wall_95, longest, stall, processor, processor_95, fixed, fixed_95)


def grouped(
    samples: Iterable[Sample], key: Callable[[Sample], tuple[str, ...]]
) -> dict[tuple[str, ...], Figures]:
    """Return the figures of the samples with the same key, in the order in which the keys first come."""
    groups: dict[tuple[str, ...], list[Sample]] = {}
    for sample in samples:
        groups.setdefault(key(sample), []).append(sample)
    return {name: figures_of(group) for name, group in groups.items()}


def table_text(samples: list[Sample], size: tuple[int, int]) -> str:
    """Return the table of one window: every action in all stages, and in each of them."""
    every = grouped(samples, lambda sample: (sample.action, EVERY_STAGE))
    by_stage = grouped(samples, lambda sample: (sample.action, sample.stage))
    rows: list[tuple[str, ...]] = [HEADINGS]
    for action, _ in every:
        names = [name for name in by_stage if name[0] == action]
        rows += [_row(name, by_stage[name]) for name in names if len(names) > 1]
        rows.append(_row((action, EVERY_STAGE), every[action, EVERY_STAGE]))
    return "\n".join(
        [f"{size[0]}x{size[1]}, {', '.join(dict.fromkeys(s.scene for s in samples))}", *aligned(rows)]
    )


def _row(name: tuple[str, ...], figures: Figures) -> tuple[str, ...]:
    inputs, *times = asdict(figures).values()
    return (*name, f"{inputs:,}", *(f"{time:.1f}" for time in times))


def csv_text(windows: dict[tuple[int, int], list[Sample]], machine: Machine, display: str) -> str:
    """Return the figures of every scene, action, stage and level as CSV, in rows that stand alone."""
    text = StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    here = asdict(machine) | {"display": display}
    for (width, height), samples in windows.items():
        found = grouped(samples, lambda sample: (sample.scene, sample.action, sample.stage, sample.level))
        for names, figures in found.items():
            row: dict[str, object] = {"width": width, "height": height}
            row |= dict(zip(("scene", "action", "stage", "level"), names, strict=True))
            numbers = {name: round(value, 3) for name, value in asdict(figures).items()}
            writer.writerow(row | numbers | here)
    return text.getvalue()
