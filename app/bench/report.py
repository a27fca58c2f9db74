"""The results as text, against the goals, with the machine they were measured on.

The prototypes were measured on two cores, against llvmpipe on two threads; everything else ran on one.
"""

import platform
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from app import __version__
from app.bench.harness import Entry, Result
from app.bench.threads import THREADS
from core.fast_path.workers.band_workers import usable_cores
from core.study.record import processor_name

# What is aimed at: how many times as long another library should take as the core, and what a prototype
# reached.


@dataclass(frozen=True)
class Goal:
    """Peer time divided by our time."""

    wanted: float | None
    """``None``: no more than the prototype's figure is aimed at."""
    prototype: tuple[float, ...]
    """What was measured, one figure or a range."""

    def verdict(self, ratio: float) -> str:
        """Return how far ``ratio`` comes: ``goal``, ``prototype`` or ``below``."""
        if self.wanted is not None and ratio >= self.wanted:
            return "goal"
        return "prototype" if ratio >= self.prototype[0] else "below"


GOALS = {
    ("A1", "OpenCV"): Goal(0.4, (0.26,)),
    ("A1", "Pillow"): Goal(0.9, (0.59,)),
    ("A1", "scikit-image"): Goal(650, (430,)),
    ("A2", "numba"): Goal(1.6, (1.0,)),
    ("B", "OpenGL"): Goal(1.5, (1.0,)),
    ("B", "numba"): Goal(3, (1.1, 2.1)),
    ("B", "OpenCV"): Goal(None, (1.3,)),
    ("B", "Pillow"): Goal(None, (1.3,)),
    ("B", "scikit-image"): Goal(None, (36,)),
    ("B", "matplotlib"): Goal(None, (3.7,)),
    ("C", "OpenGL"): Goal(2, (1.1, 1.4)),
    ("C", "numba"): Goal(3, (1.3, 1.9)),
    ("C", "OpenCV"): Goal(6, (3.8,)),
    ("C", "Pillow"): Goal(6, (4.0,)),
    ("C", "scikit-image"): Goal(None, (51,)),
    ("C", "matplotlib"): Goal(None, (8,)),
    ("D", "OpenGL"): Goal(1.3, (0.91,)),
    ("D", "VTK"): Goal(2.2, (1.45,)),
    ("D", "numba"): Goal(None, (1.4,)),
    ("D", "matplotlib"): Goal(40, (25,)),
    ("E", "OpenGL"): Goal(0.6, (0.39,)),
    ("E", "VTK"): Goal(0.7, (0.43,)),
    ("E", "OpenCV"): Goal(None, (0.09,)),
    ("E", "Pillow"): Goal(2.8, (1.8,)),
    ("E", "scikit-image"): Goal(5.5, (3.5,)),
    ("J", "OpenGL"): Goal(1.0, (0.5,)),
    ("K1", "trimesh"): Goal(0.83, (0.32,)),
    ("K2", "trimesh"): Goal(0.83, (0.22,)),
    ("K3", "trimesh"): Goal(0.33, (0.11,)),
    ("F", "OpenCV"): Goal(0.65, (0.41,)),
    ("F", "Pillow"): Goal(1, (0.62,)),
    ("F", "scikit-image"): Goal(7, (4.6,)),
}
"""Goals by workload and library."""

SHARED_GOALS = {("D", "OpenGL"): Goal(2, (1.1, 1.2))}
"""Goals of the core on two processes."""


def goal_of(workload: str, library: str, detail: str, is_shared: bool = False) -> Goal | None:
    """Return the goal against a library, of one or of two processes; there is none against a graphics card."""
    if library == "OpenGL" and "llvmpipe" not in detail:
        return None
    return (SHARED_GOALS if is_shared else GOALS).get((workload, library))


# What the measurements were made on.


@dataclass(frozen=True)
class Machine:
    """The machine, the versions and the day."""

    date: str
    processor: str
    cores: int
    system: str
    python: str
    numpy: str
    program: str

    def sentence(self) -> str:
        """Return all of it in one line."""
        return (
            f"{self.processor}, {self.cores} cores, {self.system}; Python {self.python}, NumPy {self.numpy}, "
            f"Rasterscope {self.program}; {self.date}"
        )


def this_machine() -> Machine:
    """Return what is measured on here and now."""
    return Machine(
        date=datetime.now(UTC).strftime("%Y-%m-%d"),
        processor=processor_name(),
        cores=usable_cores(),
        system=f"{platform.system()} {platform.machine()}",
        python=platform.python_version(),
        numpy=np.__version__,
        program=__version__,
    )


# The results as text: a table for each workload.


VERDICTS = {"goal": "reached", "prototype": "at least the prototype", "below": "below the prototype"}
HEADINGS = (
    *("contender", "median", "quartiles", "min", "x ours", "goal", "prototype", "", "pixels", "colours"),
    "does less than ours",
)
LEFT_ALIGNED = (0, 7, 10)


def head_text(machine: Machine) -> str:
    """Return what stands above the tables."""
    threads = ", ".join(f"{name}={count}" for name, count in THREADS.items())
    return (
        f"{machine.sentence()}\n{threads}\n"
        "Milliseconds, contenders in turn in one process; x ours: their median / ours; pixels: covered on one side "
        "only;\ncolours: off by more than 2 of 255."
    )


def result_text(result: Result) -> str:
    """Return the table of one workload."""
    title = f"{result.workload.name}  {result.workload.title}: {result.facts}"
    if result.size is not None:
        title += f", {result.counts.primitives:,} primitives, {result.counts.pixels:,} pixels"
    ours = result.ours
    rows = [HEADINGS, *(entry_row(result.workload.name, entry, ours) for entry in result.entries)]
    told = [
        f"  {entry.contender.library}: {entry.detail}"
        for entry in (ours, result.shared)
        if entry and entry.detail
    ]
    missing = [f"  {each.library} did not take part: {each.reason}" for each in result.missing]
    return "\n".join([title, *aligned(rows), *told, *shared_lines(result), *missing])


def shared_lines(result: Result) -> list[str]:
    """Return how far the core comes with more than one process, for each library that there is such a goal against."""
    shared, lines = result.shared, []
    for entry in result.entries:
        goal = goal_of(result.workload.name, entry.contender.library, entry.detail, is_shared=True)
        ratio = ratio_to(entry, shared)
        if shared is not None and goal is not None and ratio is not None:
            lines.append(
                f"  {shared.contender.library}: {entry.contender.library} takes {ratio:.2f} times as long, "
                f"goal {goal.wanted:g}, prototype {prototype_text(goal)}: {VERDICTS[goal.verdict(ratio)]}"
            )
    return lines


def entry_row(workload: str, entry: Entry, ours: Entry | None) -> tuple[str, ...]:
    """Return the cells of one contender."""
    times, goal = entry.times, goal_of(workload, entry.contender.library, entry.detail)
    ratio = ratio_to(entry, ours)
    return (
        entry.contender.library,
        f"{times.median:.2f}",
        f"{times.lower_quartile:.2f}–{times.upper_quartile:.2f}",
        f"{times.least:.2f}",
        "" if ratio is None or entry is ours else f"{ratio:.2f}",
        "" if goal is None or goal.wanted is None else f"{goal.wanted:g}",
        "" if goal is None else prototype_text(goal),
        "" if goal is None or ratio is None else VERDICTS[goal.verdict(ratio)],
        f"{entry.difference.covered:,}",
        f"{entry.difference.colored:,}",
        entry.contender.less,
    )


def ratio_to(entry: Entry, ours: Entry | None) -> float | None:
    """Return how many times as long a contender takes as ours."""
    return None if ours is None else entry.times.median / ours.times.median


def prototype_text(goal: Goal) -> str:
    """Return a figure or a range."""
    return "–".join(f"{figure:g}" for figure in goal.prototype)


def aligned(rows: list[tuple[str, ...]]) -> list[str]:
    """Return rows of cells as lines whose columns are aligned."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [
            cell.ljust(width) if k in LEFT_ALIGNED else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append(("  " + "  ".join(cells)).rstrip())
    return lines


def foot_text(results: list[Result]) -> str:
    """Return what drew: every library's version, and what it says that it draws with."""
    drew: dict[str, str] = {}
    for entry in (entry for result in results for entry in result.entries):
        if entry.contender.kind != "ours":
            account = ", ".join(filter(None, [entry.version, entry.detail]))
            drew[entry.contender.library] = max(drew.get(entry.contender.library, ""), account, key=len)
    return "\n".join(f"{library}: {account}" for library, account in drew.items())
