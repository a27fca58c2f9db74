"""The measurement of the window from beginning to end: open, act, and report the answers as figures."""

import csv
import gc
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from io import StringIO
from pathlib import Path

import numpy as np
from PySide6.QtGui import QGuiApplication

from app.background import Collecting
from app.bench.report import Machine, aligned, this_machine
from app.bench.window_script import QUICK, WHOLE, Sample, Script, opened_window
from app.bench.workloads import lights_of, lit_sphere, mesh_of, view_of
from app.files.file_access import write_file
from app.files.open_any import Opened, open_any
from app.session.document import open_document
from app.window.appearance import the_application
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import LIGHT

# The answers of the window as figures: a table for a person, a CSV file for a spreadsheet.


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
    title = f"{size[0]}x{size[1]}, {', '.join(dict.fromkeys(s.scene for s in samples))}"
    return "\n".join([title, *aligned(rows), *_lesson_line(samples)])


def _lesson_line(samples: Iterable[Sample]) -> list[str]:
    """Return how much the next step of a lesson costs, counted in the fixed work that was timed beside it."""
    answers = [sample.answer for sample in samples if sample.action == "lesson"]
    if not answers:
        return []
    times = [answer.processor / answer.fixed for answer in answers]
    median, high = np.percentile(times, [50, 95]).tolist()
    return [
        f"next step of a lesson: {median:.1f} times the fixed work, {high:.1f} times at the 95th percentile"
    ]


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


# The measurement of the window from beginning to end: open, act, report, write.


SIZES = ((1280, 800), (1920, 1080))
LARGE_MESH = "large-mesh"
SCENES = ("single-triangle", "near-plane", "textured-floor", "cube", "sphere", LARGE_MESH)
FILE_NAME = "window.csv"


def opened_scene(name: str) -> Opened:
    """Open a built-in scene or a file, or a sphere of 81,920 triangles."""
    if name != LARGE_MESH:
        return open_any(name)
    sphere = lit_sphere()
    scene = view_of(sphere, mesh_of(sphere), lights_of(sphere))
    return Opened(open_document(scene, "Sphere of 81,920 triangles"))


def measure_window(
    scenes: Sequence[str], sizes: Iterable[tuple[int, int]], folder: Path | None, is_quick: bool
) -> int:
    """Measure windows of some sizes with some scenes, print a table for each, and write ``window.csv``."""
    gc.freeze()  # these as when the window is started
    application = the_application()
    collecting = Collecting(application)
    apply_theme(application, LIGHT)
    machine, display = this_machine(), QGuiApplication.platformName()
    print(
        f"{machine.sentence()}; display {display}\n"
        "Milliseconds from an input until nothing is left to do or to paint; stall: the longest time without taking "
        "input;\nprocessor: what the window's thread worked; fixed work: the same computation before every input.",
        flush=True,
    )
    opened = {name: opened_scene(name) for name in scenes}
    windows: dict[tuple[int, int], list[Sample]] = {}
    for size in sizes:
        samples: list[Sample] = []
        shown = size
        for name in scenes:
            print(f"{size[0]}x{size[1]} {name}", file=sys.stderr, flush=True)
            with opened_window(opened[name], size) as window:
                script = Script(window, name, QUICK if is_quick else WHOLE)
                script.run()
                shown = window.width(), window.height()
            samples += script.samples
        windows[shown] = samples
        print(f"\n{table_text(samples, shown)}", flush=True)
    if folder is not None:
        write_file(folder / FILE_NAME, csv_text(windows, machine, display).encode())
    collecting.stop()
    return 0
