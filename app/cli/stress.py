"""``rasterscope stress``: where methods fail, as maps of real runs; and failing cases made small."""

import argparse
from itertools import product
from pathlib import Path

from app import __version__
from app.cli.arguments import progress_line
from app.cli.commands import MOST_SEED, load_qt, output_folder, whole_number
from app.export.failures import atlas_text, export_shrunk
from app.usage import UsageError
from core.study.cases import Atlas
from core.study.experiment import Experiment
from core.study.record import Outcome, machine
from core.study.stability import experiments, stress
from core.study.stress import shrink_cell

DESCRIPTION = (
    """Run every method of an experiment over a grid of parameters, and print the outcome of every run."""
)
EXAMPLES = """examples:
  rasterscope stress --list
  rasterscope stress slivers
  rasterscope stress shared-edges -o results
  rasterscope stress slivers --shrink coverage=float32 -o results

-o writes stress-EXPERIMENT .csv, .json, .svg and .png into a folder. --shrink reduces the first
failing cell to the smallest case that still fails (few triangles, short numbers) and prints it as a test. With -o it
also writes the test (.py) and the scene (.rasterscope).
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument(
        "experiment", metavar="EXPERIMENT", nargs="?", help="experiment to run; --list shows all"
    )
    parser.add_argument(
        "--list", action="store_true", help="list the experiments with their axes, methods and claims"
    )
    parser.add_argument("--times", action="store_true", help="time every run too")
    parser.add_argument("--shrink", metavar="METHOD", help="shrink the first failing cell of this method")
    parser.add_argument(
        "--seed", metavar="N", type=whole_number(0, MOST_SEED), default=0, help="seed of the random cases (0)"
    )
    parser.add_argument("-o", "--output", metavar="DIR", help="folder for tables and maps; default: none")


def run(options: argparse.Namespace) -> int:
    """Run the experiment, print and write."""
    if options.list:
        print("\n".join(list_text()))
        return 0
    if options.experiment is None:
        raise UsageError("EXPERIMENT is required; --list shows all")
    folder = output_folder(options)
    if folder is not None and options.shrink is None:
        load_qt()
    try:
        experiment = experiments.get(options.experiment)
        if options.shrink is not None:
            _check_method(experiment, options.shrink)
    except ValueError as problem:
        raise UsageError(str(problem)) from problem
    if options.shrink is not None:
        return run_shrink(experiment, options.shrink, options.seed, folder)
    with progress_line() as progress:
        atlas = stress(
            experiment,
            seed=options.seed,
            progress=progress,
            machine=machine(__version__),
            with_times=options.times,
        )
    show_atlas(atlas, folder)
    return 0


def show_atlas(atlas: Atlas, folder: Path | None) -> None:
    """Print maps, and write them."""
    print("\n".join(atlas_text(atlas)))
    if folder is not None:
        from app.pages.stability.atlas_files import export_atlas  # Maps need Qt, their text does not.

        for path in export_atlas(atlas, folder):
            print(f"wrote {path}")


def list_text() -> list[str]:
    """Return all experiments with their axes, methods and claims."""
    lines = []
    for experiment in experiments:
        info = experiment.info
        lines.append(f"{info.name:<24}{info.title}")
        for axis in info.axes:
            unit = f" ({axis.unit})" if axis.unit else ""
            ends = f"{axis.values[0]:g} to {axis.values[-1]:g}"
            lines.append(f"    {axis.name}: {axis.title}{unit}, {ends}, {len(axis.values)} values")
        lines += [f"    methods: {', '.join(info.methods)}", f"    {info.claim}"]
    return lines


def _check_method(experiment: Experiment, method: str) -> None:
    """Refuse, with a sentence, a method that the experiment does not run."""
    info = experiment.info
    if method not in info.methods:
        raise ValueError(f"--shrink takes a method of {info.name}: {', '.join(info.methods)}; got {method}")


def run_shrink(experiment: Experiment, method: str, seed: int, folder: Path | None) -> int:
    """Shrink the first failing cell of a method, print the test, and write it with its scene."""
    place = first_failure(experiment, method, seed)
    if place is None:
        print(f"{method} does not fail anywhere in {experiment.info.name}.")
        return 0
    shrunk = shrink_cell(experiment.info.name, method, place, seed)
    axes = ", ".join(
        f"{axis.title.lower()} {value:g}" for axis, value in zip(experiment.info.axes, place, strict=True)
    )
    print(
        f"{experiment.info.title}: {axes}.\n{shrunk.sentence} It took {shrunk.run_count} runs.\n\n{shrunk.test}"
    )
    if folder is not None:
        for path in export_shrunk(shrunk, experiment.info.name, method, folder):
            print(f"wrote {path}")
    return 0


def first_failure(experiment: Experiment, method: str, seed: int) -> tuple[float, ...] | None:
    """Return the first place, row by row, at which a method fails; ``None``: there is none."""
    axes = experiment.info.axes
    for place in product(*(axis.values for axis in reversed(axes))):
        verdict = experiment.run(method, place[::-1], seed)
        if verdict.outcome not in (Outcome.RIGHT, Outcome.REFUSED):
            return place[::-1]
    return None
