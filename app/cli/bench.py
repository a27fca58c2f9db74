"""``rasterscope bench``: the core against other libraries, on the same triangles; and how fast the window answers.

NumPy is imported only after the numbers of threads are set: it asks for them once.
"""

import argparse
from pathlib import Path

from app.bench.threads import set_threads
from app.cli.commands import MOST_ROUNDS, whole_number
from app.usage import UsageError
from lessons.os_errors import os_error_reason

DESCRIPTION = """Draw the workloads with the core and with every other library that is installed, check the
pictures, time them in turn, and write a table. The libraries are in the extra bench. With --window: step, scrub, point,
drag and turn in a real window, and measure how long each answer takes."""
EXAMPLES = """examples:
  rasterscope bench
  rasterscope bench --quick --workload B C
  rasterscope bench -o docs         (writes benchmark.csv, benchmark.svg and benchmark.png there)
  rasterscope bench --window -o docs          (writes window.csv there)
  rasterscope bench --window --quick --scene cube --size 1280x800

Exit code: 0 measured, 1 a picture of the core was wrong, or something failed, 2 wrong usage.
"""
ROUNDS, QUICK_ROUNDS = 9, 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument(
        "--workload",
        metavar="NAME",
        nargs="+",
        default=[],
        help="only these: A1 A2 B C D E F G H I J K1 K2 K3 L1 L2 L3 L4",
    )
    parser.add_argument(
        "--rounds", metavar="N", type=whole_number(1, MOST_ROUNDS), help=f"rounds of measurement ({ROUNDS})"
    )
    parser.add_argument(
        "--quick", action="store_true", help=f"a short trial run: {QUICK_ROUNDS} rounds, fewer steps"
    )
    parser.add_argument("--window", action="store_true", help="measure the window in place of the core")
    parser.add_argument(
        "--scene", metavar="FILE", nargs="+", default=[], help="with --window: only these scenes or files"
    )
    parser.add_argument(
        "--size",
        metavar="WxH",
        nargs="+",
        default=[],
        help="with --window: sizes of the window (1280x800 1920x1080)",
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="folder for table and chart, made if missing; default: none"
    )


def made_folder(folder: Path) -> Path:
    """Return the folder, made if there is none, or raise UsageError where it cannot be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise UsageError(
            f"argument -o: the folder {folder} cannot be made: {os_error_reason(problem)}"
        ) from problem
    return folder


def run(options: argparse.Namespace) -> int:
    """Measure; 0 if the core drew what it should."""
    if options.quick and options.rounds is not None:
        raise UsageError("argument --quick: not allowed with --rounds")
    folder = None if options.output is None else made_folder(Path(options.output))
    set_threads()
    if options.window:
        return measure_window(options, folder)
    if options.scene or options.size:
        raise UsageError("--scene and --size: only with --window")
    from app.bench.run import chosen_workloads, run_benchmark

    try:
        workloads = chosen_workloads(options.workload)
    except ValueError as problem:
        raise UsageError(f"argument --workload: {problem}") from problem
    rounds = QUICK_ROUNDS if options.quick else options.rounds or ROUNDS
    return run_benchmark(workloads, rounds, folder)


def measure_window(options: argparse.Namespace, folder: Path | None) -> int:
    """Measure the window."""
    if options.workload or options.rounds is not None:
        raise UsageError("argument --window: not allowed with --workload or --rounds")
    from app.cli.commands import is_display_missing, load_qt
    from app.cli.screenshot import window_size_from_text

    try:
        sizes = [window_size_from_text(size) for size in options.size]
    except argparse.ArgumentTypeError as problem:
        raise UsageError(f"argument --size: {problem}") from problem
    if is_display_missing():
        raise ValueError("there is no display to open a window on")
    load_qt()
    from app.bench import window as windows

    return windows.measure_window(
        options.scene or windows.SCENES, sizes or windows.SIZES, folder, options.quick
    )
