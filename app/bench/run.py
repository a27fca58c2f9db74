"""The benchmark from beginning to end: run, report, draw the chart, write files.

It is written as plain SVG. A bar begins at 1: to the right the core is faster, to the left the other library.
"""

import csv
import os
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from io import StringIO
from math import ceil, floor, log10
from pathlib import Path
from typing import BinaryIO
from xml.sax.saxutils import escape

from app.bench.harness import LIBRARIES, Entry, Result, run_workload
from app.bench.report import (
    Machine,
    foot_text,
    goal_of,
    head_text,
    prototype_text,
    ratio_to,
    result_text,
    this_machine,
)
from app.bench.threads import THREADS
from app.bench.workloads import WORKLOADS, Workload
from app.files.file_access import whole_file, write_file

# The results as a CSV file: one row for each contender on each workload.


COLUMNS = (
    *("workload", "title", "width", "height", "primitives", "fragments", "pixels"),
    *("library", "version", "detail", "kind", "does_less", "missing"),
    *("median_ms", "min_ms", "lower_quartile_ms", "upper_quartile_ms", "timed_calls"),
    *("times_ours", "goal", "prototype", "verdict", "pixels_different", "colours_different"),
    *("date", "processor", "cores", "system", "python", "numpy", "program", "threads", "rounds"),
)


def results_text(results: list[Result], machine: Machine, rounds: int) -> str:
    """Return every result as CSV, with what it was measured on, in rows that stand alone."""
    text = StringIO()
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    threads = " ".join(f"{name}={count}" for name, count in THREADS.items())
    here = asdict(machine) | {"threads": threads, "rounds": rounds}
    for result in results:
        for row in result_rows(result):
            writer.writerow(row | here)
    return text.getvalue()


def result_rows(result: Result) -> list[dict[str, object]]:
    """Return the rows of one workload."""
    common: dict[str, object] = {"workload": result.workload.name, "title": result.workload.title}
    if result.size is None:
        common["primitives"] = result.counts.primitives
    else:
        common |= dict(zip(("width", "height"), result.size, strict=True)) | asdict(result.counts)
    rows = []
    for entry in result.entries:
        times, ratio = entry.times, ratio_to(entry, result.ours)
        row = common | {
            "library": entry.contender.library,
            "version": entry.version,
            "detail": entry.detail,
            "kind": entry.contender.kind,
            "does_less": entry.contender.less,
            "median_ms": f"{times.median:.4f}",
            "min_ms": f"{times.least:.4f}",
            "lower_quartile_ms": f"{times.lower_quartile:.4f}",
            "upper_quartile_ms": f"{times.upper_quartile:.4f}",
            "timed_calls": times.count,
            "pixels_different": entry.difference.covered,
            "colours_different": entry.difference.colored,
        }
        if ratio is not None:
            row["times_ours"] = f"{ratio:.4f}"
            goal = goal_of(result.workload.name, entry.contender.library, entry.detail)
            if goal is not None:
                wanted = "" if goal.wanted is None else f"{goal.wanted:g}"
                row |= {"goal": wanted, "prototype": prototype_text(goal), "verdict": goal.verdict(ratio)}
        rows.append(row)
    return rows + [common | {"library": each.library, "missing": each.reason} for each in result.missing]


# The chart: for each workload, how many times as long as the core every other library takes, on a log
# scale.


TEXT, QUIET = "#202020", "#606060"
WIDTH, MARGIN, GAP = 1000, 24, 36
HEAD, FOOT = 92, 46
TITLE_HEIGHT, ROW, GROUP_GAP = 36, 16, 28
NAME_WIDTH, FIGURE_WIDTH = 84, 48
COLUMN_WIDTH = (WIDTH - 2 * MARGIN - GAP) / 2
FASTER, SLOWER, LINE = "#0072B2", "#D55E00", "#D8D8D8"
"""Colours that colour-blind people tell apart; the side of the line tells the same."""
SCALE = 2
"""Pixels of a PNG file for one of the chart, so that it stays sharp on dense screens."""


@dataclass(frozen=True)
class Scale:
    """The logarithmic axis of one column, over whole powers of ten."""

    left: float
    """Pixels where it begins; ``right``: where it ends."""
    right: float
    lowest: int
    highest: int

    def place(self, ratio: float) -> float:
        """Return where a ratio is, in pixels from the left edge of the chart."""
        share = (log10(ratio) - self.lowest) / (self.highest - self.lowest)
        return self.left + min(max(share, 0.0), 1.0) * (self.right - self.left)


def chart_svg(results: list[Result], machine: Machine) -> str:
    """Return the chart; workloads that the core did not draw as the reference are named below it."""
    drawn = [result for result in results if compared(result)]
    columns = split(drawn)
    height = HEAD + max((column_height(column) for column in columns), default=0) + FOOT
    lowest, highest = decades(drawn)
    parts = [head(), legend()]
    for number, column in enumerate(columns):
        left = MARGIN + number * (COLUMN_WIDTH + GAP)
        scale = Scale(left + NAME_WIDTH, left + COLUMN_WIDTH - FIGURE_WIDTH, lowest, highest)
        parts += draw_column(column, left, scale)
    parts.append(text(MARGIN, height - 14, machine.sentence(), size=10, color=QUIET))
    wrong = [result.workload.name for result in results if not result.is_right]
    if wrong:
        words = f"Not compared, because Rasterscope did not draw the reference: {', '.join(wrong)}."
        parts.append(text(MARGIN, height - 30, words, size=10, color=SLOWER))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
        f'viewBox="0 0 {WIDTH} {height}" font-family="DejaVu Sans, Verdana, sans-serif">\n'
        f'<rect width="{WIDTH}" height="{height}" fill="#FFFFFF"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


def compared(result: Result) -> list[tuple[Entry, float]]:
    """Return the other libraries of a workload with their ratios, or nothing where ours did not draw it right."""
    if not result.is_right:
        return []
    others = [entry for entry in result.entries if entry.contender.kind != "ours"]
    ratios = [(entry, ratio_to(entry, result.ours)) for entry in others]
    return [(entry, ratio) for entry, ratio in ratios if ratio is not None]


def decades(results: list[Result]) -> tuple[int, int]:
    """Return the powers of ten that the axis begins and ends with; 1 is always inside, and so are the goals."""
    marks = [ratio for result in results for _, ratio in compared(result)]
    goals = [wanted_ratio(result, entry) for result in results for entry, _ in compared(result)]
    marks += [goal for goal in goals if goal is not None]
    lowest = floor(log10(min(marks, default=1.0)))
    return min(lowest, -1), max(ceil(log10(max(marks, default=1.0))), 1)


def wanted_ratio(result: Result, entry: Entry) -> float | None:
    """Return the goal against a library, if there is one."""
    goal = goal_of(result.workload.name, entry.contender.library, entry.detail)
    return None if goal is None else goal.wanted


def group_height(result: Result) -> int:
    """Return the height of one workload in pixels."""
    return TITLE_HEIGHT + ROW * len(compared(result)) + GROUP_GAP


def column_height(results: list[Result]) -> int:
    """Return the height of a column."""
    return sum(group_height(result) for result in results)


def split(results: list[Result]) -> list[list[Result]]:
    """Return two columns, in order, whose heights differ least."""
    cuts = range(len(results) + 1)
    cut = min(cuts, key=lambda k: abs(column_height(results[:k]) - column_height(results[k:])))
    return [results[:cut], results[cut:]]


def head() -> str:
    """Return the title and what the bars mean."""
    title = text(
        MARGIN, 32, "How many times as long as Rasterscope other libraries take", size=18, weight=600
    )
    meaning = text(
        MARGIN,
        52,
        "Median time divided by that of Rasterscope (NumPy alone, one thread), logarithmic scale.",
        size=12,
        color=QUIET,
    )
    return f"{title}\n{meaning}"


def legend() -> str:
    """Return what the colours and marks mean."""
    entries = [
        (FASTER, 1.0, "Rasterscope is faster"),
        (SLOWER, 1.0, "the other is faster"),
        (QUIET, 0.4, "pale: it does less (no depth test, for instance)"),
    ]
    parts, left = [], float(MARGIN)
    for color, opacity, words in entries:
        parts.append(
            f'<rect x="{left:g}" y="66" width="14" height="10" fill="{color}" fill-opacity="{opacity:g}"/>'
        )
        parts.append(text(left + 20, 75, words, size=11))
        left += 44 + 6.2 * len(words)
    parts.append(line(left + 6, 64, left + 6, 78, TEXT, 2))
    parts.append(text(left + 14, 75, "goal", size=11))
    return "\n".join(parts)


def draw_column(results: list[Result], left: float, scale: Scale) -> list[str]:
    """Return the groups of a column from top to bottom."""
    parts: list[str] = []
    top = float(HEAD)
    for result in results:
        parts += draw_group(result, left, top, scale)
        top += group_height(result)
    return parts


def draw_group(result: Result, left: float, top: float, scale: Scale) -> list[str]:
    """Return one workload: its title, its axis, and a bar for each library, the slowest last."""
    ours = result.ours
    assert ours is not None
    facts = f"{ours.times.median:.3g} ms, {result.facts}"
    parts = [
        text(left, top + 13, result.workload.name, size=12, weight=600),
        text(left + 28, top + 13, result.workload.title, size=12, weight=600),
        text(left, top + 28, f"Rasterscope: {facts}", size=10, color=QUIET),
    ]
    bars = sorted(compared(result), key=lambda pair: pair[1])
    first = top + TITLE_HEIGHT
    end = first + ROW * len(bars)
    for power in range(scale.lowest, scale.highest + 1):
        x = scale.place(10.0**power)
        parts.append(line(x, first, x, end, QUIET if power == 0 else LINE, 1))
        parts.append(text(x, end + 11, f"{10.0**power:g}", size=9, color=QUIET, anchor="middle"))
    for number, (entry, ratio) in enumerate(bars):
        parts += draw_bar(result, entry, ratio, left, first + ROW * number, scale)
    return parts


def draw_bar(result: Result, entry: Entry, ratio: float, left: float, top: float, scale: Scale) -> list[str]:
    """Return one library: its name, its bar with the quartiles, its goal and its figure."""
    assert result.ours is not None
    start, end = scale.place(1.0), scale.place(ratio)
    color = FASTER if ratio >= 1 else SLOWER
    opacity = 0.4 if entry.contender.less else 1.0
    spread = [
        scale.place(quartile / result.ours.times.median)
        for quartile in (entry.times.lower_quartile, entry.times.upper_quartile)
    ]
    middle = top + ROW / 2
    parts = [
        text(left + NAME_WIDTH - 8, middle + 4, entry.contender.library, size=11, anchor="end"),
        f'<rect x="{min(start, end):.1f}" y="{top + 3:g}" width="{max(abs(end - start), 1):.1f}" '
        f'height="{ROW - 6}" fill="{color}" fill-opacity="{opacity:g}"/>',
        line(spread[0], middle, spread[1], middle, TEXT, 1),
    ]
    wanted = wanted_ratio(result, entry)
    if wanted is not None:
        x = scale.place(wanted)
        parts.append(line(x, top + 1, x, top + ROW - 1, TEXT, 2))
    parts.append(text(scale.right + FIGURE_WIDTH, middle + 4, figure(ratio), size=11, anchor="end"))
    return parts


def figure(ratio: float) -> str:
    """Return a ratio with two digits or more."""
    places = min(max(1 - floor(log10(ratio)), 0), 4)
    return f"{ratio:.{places}f}×"


def text(
    x: float, y: float, words: str, *, size: int, color: str = TEXT, weight: int = 400, anchor: str = "start"
) -> str:
    """Return a line of text whose foot is at ``y``."""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" font-weight="{weight}" fill="{color}" '
        f'text-anchor="{anchor}">{escape(words)}</text>'
    )


def line(x1: float, y1: float, x2: float, y2: float, color: str, width: float) -> str:
    """Return a straight line."""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" '
        f'stroke-width="{width:g}"/>'
    )


def write_png(file: BinaryIO, svg: str) -> None:
    """Draw an SVG text and write it as PNG."""
    # Qt draws it, without a display; the benchmark itself needs no Qt.
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtCore import QByteArray
    from PySide6.QtGui import QGuiApplication, QImage, QPainter
    from PySide6.QtSvg import QSvgRenderer

    from app.export.views import png_bytes

    application = QGuiApplication.instance() or QGuiApplication(["rasterscope"])
    renderer = QSvgRenderer(QByteArray(svg.encode("utf-8")))
    image = QImage(renderer.defaultSize() * SCALE, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    renderer.render(painter)
    painter.end()
    file.write(png_bytes(image))
    del application


# The benchmark from beginning to end: run, report, write files.


FILE_NAME = "benchmark"


def chosen_workloads(names: Sequence[str]) -> list[Workload]:
    """Return the workloads of these names, or all; an unknown name raises ValueError."""
    known = {workload.name: workload for workload in WORKLOADS}
    for name in names:
        if name not in known:
            raise ValueError(f"workload must be one of {', '.join(known)}, got {name}")
    return [workload for workload in WORKLOADS if not names or workload.name in names]


def run_benchmark(workloads: Sequence[Workload], rounds: int, folder: Path | None) -> int:
    """Measure and write; return 1 if the core did not draw what it should, else 0.

    Parameters
    ----------
    rounds : int
        Times that every contender has its turn.
    folder : Path, optional
        Where ``benchmark.csv``, ``.svg`` and ``.png`` go, those that are there are replaced.
    """
    machine = this_machine()
    print(head_text(machine), flush=True)
    results = []
    for workload in workloads:
        results.append(run_workload(workload, LIBRARIES, rounds, note_progress))
        clear_progress()
        print(f"\n{result_text(results[-1])}", flush=True)
    print(f"\n{foot_text(results)}")
    if folder is not None:
        write_files(folder, results, machine, rounds)
    return verdict(results)


def verdict(results: Sequence[Result]) -> int:
    """Say on stderr where the core did not draw what it should; return the exit code."""
    wrong = [each.workload.name for each in results if not each.is_right]
    if wrong:
        print(f"Rasterscope did not draw the reference on: {', '.join(wrong)}", file=sys.stderr)
    return 1 if wrong else 0


def write_files(folder: Path, results: list[Result], machine: Machine, rounds: int) -> None:
    """Write the table and the chart."""
    svg = chart_svg(results, machine)
    write_file(folder / f"{FILE_NAME}.csv", results_text(results, machine, rounds).encode("utf-8"))
    write_file(folder / f"{FILE_NAME}.svg", svg.encode("utf-8"))
    with whole_file(folder / f"{FILE_NAME}.png") as file:
        write_png(file, svg)


def note_progress(doing: str) -> None:
    """Write what is being done over the line before, where somebody watches."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{doing}", end="", file=sys.stderr, flush=True)


def clear_progress() -> None:
    """Take the last note away."""
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)
