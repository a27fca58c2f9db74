"""The benchmark from beginning to end: run, report, write files."""

import sys
from collections.abc import Sequence
from pathlib import Path

from app.bench.chart import chart_svg, write_png
from app.bench.harness import Result, run_workload
from app.bench.libraries import LIBRARIES
from app.bench.machine import Machine, this_machine
from app.bench.report import foot_text, head_text, result_text
from app.bench.results_file import results_text
from app.bench.scenes import WORKLOADS, Workload
from app.files.file_writing import whole_file, write_file

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
