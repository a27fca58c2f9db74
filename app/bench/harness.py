"""Run workloads: every contender of every library is prepared, checked, and then timed in turn with the others.

What the process does stands in `app.bench.first_picture`.
"""

import gc
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from types import ModuleType

import numpy as np

from app.bench import (
    matplotlib_peer,
    numba_peer,
    opencv_peer,
    opengl_peer,
    ours,
    ours_child,
    ours_shared,
    pillow_peer,
    records,
    skimage_peer,
    trimesh_peer,
    typed_text,
    vtk_peer,
)
from app.bench.first_picture import ARRAYS, PIXELS
from app.bench.reference import Difference, Reference, compare, make_reference
from app.bench.workloads import Workload
from core.study.record import collector_off

# The first picture of a fresh process: the interpreter's start, the imports, and what a library does only
# once.


CHILD = "app.bench.first_picture"
"""The module that runs in the process."""
ROOT = Path(__file__).resolve().parents[2]


def cold_contender(module: ModuleType, work: records.ColdStart) -> records.Contender | None:
    """Return a library drawing in processes of their own, or ``None`` if it does not draw triangles."""
    warm: records.Contender | None = module.contender(work.triangles)
    if warm is None:
        return None
    return replace(warm, prepare=lambda stack: prepare(module.__name__, work.triangles, stack))


def prepare(module: str, work: records.WindowTriangles, stack: ExitStack) -> records.Prepared:
    """Write the triangles where the processes will find them."""
    folder = Path(stack.enter_context(TemporaryDirectory(prefix="rasterscope-bench-")))
    for name in ARRAYS:
        np.save(folder / f"{name}.npy", getattr(work, name))
    pixels = folder / PIXELS
    width, height = work.size
    command = [sys.executable, "-P", "-m", CHILD, module, str(folder), str(width), str(height)]
    environment = dict(os.environ, PYTHONPATH=str(ROOT))
    # The run that checks the picture leaves compiled files behind, as installing does for the other libraries.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)

    def run() -> records.Bytes:
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines()
            raise records.UnavailableError(lines[-1] if lines else f"exit code {done.returncode}")
        drawn: records.Bytes = np.load(pixels)
        return drawn

    return records.Prepared(run)


# The libraries that take part, each a module with ``LIBRARY``, ``DISTRIBUTION`` and ``contender(work)``.


LIBRARIES: tuple[ModuleType, ...] = (
    *(ours, ours_shared, ours_child, vtk_peer, opengl_peer, numba_peer, opencv_peer),
    *(pillow_peer, skimage_peer, matplotlib_peer, trimesh_peer, typed_text),
)
"""All of them, ours first. VTK ends every EGL context that was opened before its own: it must begin before OpenGL."""


def contender_of(library: ModuleType, work: records.Work) -> records.Contender | None:
    """Return a library drawing a workload, or ``None`` where it has no way to."""
    if isinstance(work, records.ColdStart):
        return cold_contender(library, work)
    if isinstance(work, records.TypedPicture) and library not in (ours, typed_text):
        return None
    found: records.Contender | None = library.contender(work)
    return found


def version_of(library: ModuleType) -> str:
    """Return name and version of the distribution that a library comes from; for ours, of what it is built on."""
    try:
        return f"{library.DISTRIBUTION} {version(library.DISTRIBUTION)}"
    except PackageNotFoundError:
        return f"{library.DISTRIBUTION} (not installed)"


# Time several calls fairly: in turn, in one process, warm, with the garbage collector off.


SHORT = 0.030
"""Seconds: a shorter call is warmed up in every round by one untimed call, and then timed more than once."""
SHORT_CALLS = 4


@dataclass(frozen=True)
class Times:
    """What was measured of one contender, in milliseconds."""

    median: float
    least: float
    lower_quartile: float
    upper_quartile: float
    count: int
    """Timed calls."""


def time_in_turn(calls: dict[str, Callable[[], object]], rounds: int) -> dict[str, Times]:
    """Call everything ``rounds`` times in turn and return the times by name.

    Every round begins with another contender, so that none always finds the caches as the same one left them.
    """
    seconds: dict[str, list[float]] = {name: [] for name in calls}
    names = list(calls)
    for turn in range(rounds):
        first = turn % max(len(names), 1)
        for name in names[first:] + names[:first]:
            gc.collect()
            with collector_off():
                seconds[name] += _time_round(calls[name])
    return {name: summary(values) for name, values in seconds.items()}


def _time_round(call: Callable[[], object]) -> list[float]:
    """Return the seconds of a long call, or of several short ones after an untimed one."""
    first = _seconds(call)
    if first >= SHORT:
        return [first]
    return [_seconds(call) for _ in range(SHORT_CALLS)]


def _seconds(call: Callable[[], object]) -> float:
    start = perf_counter()
    call()
    return perf_counter() - start


def summary(seconds: list[float]) -> Times:
    """Return the median and the spread of times in seconds."""
    least, lower, median, upper = np.percentile(np.array(seconds) * 1000, [0, 25, 50, 75]).tolist()
    return Times(median, least, lower, upper, len(seconds))


# Run workloads: every contender is prepared, checked, and then timed in turn with the others.


Note = Callable[[str], None]


@dataclass(frozen=True)
class Entry:
    """One library on one workload."""

    contender: records.Contender
    version: str
    detail: str
    difference: Difference
    times: Times


@dataclass(frozen=True)
class Missing:
    """A library that could not take part, and why."""

    library: str
    reason: str


@dataclass(frozen=True)
class Counts:
    """The work in a workload."""

    primitives: int
    fragments: int
    pixels: int


@dataclass(frozen=True)
class Result:
    """One workload, drawn by all."""

    workload: Workload
    size: tuple[int, int] | None
    """(width, height) of the picture; ``None``: a file is read."""
    counts: Counts
    entries: tuple[Entry, ...]
    missing: tuple[Missing, ...]

    @property
    def facts(self) -> str:
        """What is drawn or read, in a few words."""
        if self.size is None:
            return f"{self.counts.primitives:,} triangles"
        width, height = self.size
        return f"{width} x {height}, {self.counts.fragments:,} fragments"

    @property
    def ours(self) -> Entry | None:
        """The core's entry, if it could draw."""
        return next((entry for entry in self.entries if entry.contender.kind == "ours"), None)

    @property
    def shared(self) -> Entry | None:
        """The core's entry with more than one process, if there is one."""
        return next((entry for entry in self._all_ours if entry is not self.ours), None)

    @property
    def is_right(self) -> bool:
        """Whether the core drew the reference, by however many processes."""
        return bool(self._all_ours) and all(entry.difference.is_none for entry in self._all_ours)

    @property
    def _all_ours(self) -> list[Entry]:
        return [entry for entry in self.entries if entry.contender.kind == "ours"]


@dataclass(frozen=True)
class _Ready:
    """A contender that has drawn once."""

    contender: records.Contender
    version: str
    prepared: records.Prepared
    difference: Difference


def run_workload(workload: Workload, libraries: Sequence[ModuleType], rounds: int, note: Note) -> Result:
    """Draw one workload with every library that can; ``note`` gets a text for every step."""
    note(f"{workload.name}: reference")
    work = workload.make()
    reference = make_reference(work)
    ready: list[_Ready] = []
    missing: list[Missing] = []
    entries: list[Entry] = []
    with ExitStack() as stack:
        for library in libraries:
            note(f"{workload.name}: checking {library.LIBRARY}")
            outcome = _make_ready(library, work, reference, stack)
            if isinstance(outcome, Missing):
                missing.append(outcome)
            elif outcome is not None:
                ready.append(outcome)
        note(f"{workload.name}: timing {len(ready)} contenders")
        times = time_in_turn({each.contender.library: each.prepared.run for each in ready}, rounds)
        for each in ready:
            if _still_draws(each, reference):
                detail, measured = each.prepared.tell(), times[each.contender.library]
                entries.append(Entry(each.contender, each.version, detail, each.difference, measured))
            else:
                missing.append(Missing(each.contender.library, "while it was timed it drew another picture"))
    height, width = reference.covered.shape
    counts = Counts(reference.primitive_count, reference.fragment_count, reference.pixel_count)
    size = None if isinstance(work, records.MeshFile) else (width, height)
    return Result(workload, size, counts, tuple(entries), tuple(missing))


def _make_ready(
    library: ModuleType, work: records.Work, reference: Reference, stack: ExitStack
) -> _Ready | Missing | None:
    """Let a library draw once and compare; ``None`` where it has no way to draw this."""
    contender = contender_of(library, work)
    if contender is None:
        return None
    try:
        prepared = contender.prepare(stack)
        difference = compare(prepared.picture(prepared.run()), contender.is_top_down, reference)
    except ImportError as error:
        return Missing(contender.library, f"not installed ({error})")
    except Exception as error:  # A failing library is reported; the others go on.
        reason = " ".join(str(error).split()) or type(error).__name__
        return Missing(contender.library, reason)
    return _Ready(contender, version_of(library), prepared, difference)


def _still_draws(ready: _Ready, reference: Reference) -> bool:
    """Return whether the picture is still the one that was checked, and not what an earlier call left in memory."""
    prepared, contender = ready.prepared, ready.contender
    before = prepared.picture(prepared.run())
    if before.flags.writeable:
        before.fill(0)
    pixels = prepared.picture(prepared.run())
    return compare(pixels, contender.is_top_down, reference) == ready.difference
