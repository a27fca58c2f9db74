"""Run workloads: every contender is prepared, checked, and then timed in turn with the others."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from types import ModuleType

from app.bench.contender import Contender, Prepared
from app.bench.libraries import contender_of, version_of
from app.bench.records import MeshFile, Work
from app.bench.reference import Difference, Reference, compare, make_reference
from app.bench.scenes import Workload
from app.bench.timing import Times, time_in_turn

Note = Callable[[str], None]


@dataclass(frozen=True)
class Entry:
    """One library on one workload."""

    contender: Contender
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

    contender: Contender
    version: str
    prepared: Prepared
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
    size = None if isinstance(work, MeshFile) else (width, height)
    return Result(workload, size, counts, tuple(entries), tuple(missing))


def _make_ready(
    library: ModuleType, work: Work, reference: Reference, stack: ExitStack
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
