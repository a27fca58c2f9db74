"""Runs experiments off the GUI thread: whole grids, single cells to be looked at, and the shrinker."""

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal, Slot

from app import __version__
from app.stability_choices import AtlasResult
from app.workers import Job, Progress
from core import Frame, render
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.study import Opening, machine
from core.study.stability import Axis, Experiment, Verdict, stress
from core.study.stability.coverage.precision_dial import DialReading, precision_dial
from core.study.stability.shrink import Shrunk, shrink_cell
from widgets.atlas_records import CellPlace

MOST_DIALLED = 64
"""Triangles of a scene that are looked through for one on which the number formats disagree."""
MOST_PIXELS = 1 << 20
"""Of a picture that is drawn beside the maps; a larger one is only opened in the stepper."""


@dataclass(frozen=True, eq=False)
class StressOrder:
    """What is to be run."""

    experiment: Experiment
    axes: tuple[Axis, ...]
    seed: int


@dataclass(frozen=True, eq=False)
class CellRun:
    """One finished cell of the present run."""

    place: CellPlace
    verdict: Verdict


@dataclass(frozen=True, eq=False)
class CaseOrder:
    """One cell to be looked at."""

    experiment: Experiment
    place: CellPlace
    values: tuple[float, ...]
    seed: int


@dataclass(frozen=True, eq=False)
class CaseFound:
    """One cell, run once more: what came of it, what opens, and the picture."""

    order: CaseOrder
    verdict: Verdict
    opening: Opening | None
    frame: Frame | None
    """``None``: there is nothing to be drawn, or the method refused."""


@dataclass(frozen=True, eq=False)
class ShrunkFound:
    """A cell made small."""

    order: CaseOrder
    shrunk: Shrunk
    opening: Opening
    frame: Frame | None


@dataclass(frozen=True, eq=False)
class _Row:
    serial: int
    cells: tuple[CellRun, ...]


class StabilityDesk(QObject):
    """At most one run of a grid, one look at a cell and one shrinking at a time; the newest counts."""

    cells_run = Signal(object)
    """A tuple of `CellRun`: one row of a map of the present run."""
    progressed = Signal(object, str)
    ran = Signal(object)
    """The finished `AtlasResult`."""
    running_failed = Signal(object)
    """The exception."""
    running_ended = Signal()
    """Done, failed or cancelled."""
    case_found = Signal(object)
    """A `CaseFound`."""
    case_failed = Signal(object)
    shrunk_found = Signal(object)
    """A `ShrunkFound`."""
    shrinking_failed = Signal(object)
    dial_read = Signal(object)
    """A tuple of ``DialReading``."""
    dial_failed = Signal(object)
    _row_run_in_thread = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._serial = 0
        self._running, self._looking, self._shrinking, self._reading = (Job(self) for _ in range(4))
        self._running.progressed.connect(self.progressed)
        self._running.succeeded.connect(self.ran)
        self._running.failed.connect(self.running_failed)
        self._running.ended.connect(self.running_ended)
        self._looking.succeeded.connect(self.case_found)
        self._looking.failed.connect(self.case_failed)
        self._shrinking.succeeded.connect(self.shrunk_found)
        self._shrinking.failed.connect(self.shrinking_failed)
        self._reading.succeeded.connect(self.dial_read)
        self._reading.failed.connect(self.dial_failed)
        self._row_run_in_thread.connect(self._take_row)

    @property
    def is_running(self) -> bool:
        """Whether a grid is being run."""
        return self._running.is_running

    @property
    def is_shrinking(self) -> bool:
        """Whether a case is being made small."""
        return self._shrinking.is_running

    def run(self, order: StressOrder) -> None:
        """Run an experiment; rows of cells come as they are done."""
        self._serial += 1
        serial, last = self._serial, len(order.axes[0].values) - 1

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> AtlasResult:
            row: list[CellRun] = []

            def cell_done(method: str, column: int, number: int, verdict: Verdict) -> None:
                place = CellPlace(method, column, number)
                row.append(CellRun(place, verdict))
                if column == last:
                    self._row_run_in_thread.emit(_Row(serial, tuple(row)))
                    row.clear()

            atlas = stress(
                order.experiment,
                seed=order.seed,
                axes=order.axes,
                progress=progress,
                is_cancelled=is_cancelled,
                machine=machine(__version__),
                cell_done=cell_done,
            )
            return AtlasResult(atlas)

        self._running.start(work)

    @Slot()
    def cancel(self) -> None:
        """Stop running; nothing comes of it."""
        self._serial += 1
        self._running.cancel()

    @Slot(object)
    def _take_row(self, row: _Row) -> None:
        if row.serial == self._serial and self.is_running:
            self.cells_run.emit(row.cells)

    def look(self, order: CaseOrder) -> None:
        """Run one cell once more and draw it."""

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> CaseFound:
            experiment, method = order.experiment, order.place.key
            verdict = experiment.run(method, order.values, order.seed)
            opening = experiment.opening(method, order.values, order.seed)
            frame = None if opening is None else drawn(opening.scene, opening.settings)
            return CaseFound(order, verdict, opening, frame)

        self._shrinking.cancel()
        self._looking.start(work)

    def shrink(self, order: CaseOrder, stage: str) -> None:
        """Make one cell small; ``stage`` is where it is to be opened."""

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> ShrunkFound:
            method = order.place.key
            shrunk = shrink_cell(
                order.experiment, method, order.values, order.seed, is_cancelled=is_cancelled
            )
            opening = Opening(shrunk.scene, shrunk.settings, stage, shrunk.pixel)
            return ShrunkFound(order, shrunk, opening, drawn(shrunk.scene, shrunk.settings))

        self._shrinking.start(work)

    def read_dial(self, scene: ClipScene, pixel: tuple[int, int]) -> None:
        """Evaluate a pixel in every number format."""

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> tuple[DialReading, ...]:
            return readings_at(scene, pixel, is_cancelled)

        self._reading.start(work)

    @Slot()
    def stop_looking(self) -> None:
        """Wait for no single cell any more."""
        self._reading.cancel()
        self._looking.cancel()
        self._shrinking.cancel()

    def shut_down(self) -> None:
        """Cancel everything and wait for the threads."""
        self._serial += 1
        for job in (self._running, self._looking, self._shrinking, self._reading):
            job.shut_down()


def readings_at(
    scene: ClipScene, pixel: tuple[int, int], is_cancelled: Callable[[], bool]
) -> tuple[DialReading, ...]:
    """Return the readings of the first triangle on which the formats disagree, or else of the first one."""
    first: tuple[DialReading, ...] = ()
    for triangle in range(min(len(scene.clip), MOST_DIALLED)):
        readings = precision_dial(scene, pixel, triangle)
        first = first or readings
        if any(not reading.is_right for reading in readings):
            return readings
        if is_cancelled():
            break
    return first


def drawn(scene: AnyScene, settings: Settings) -> Frame | None:
    """Return the picture of a case; ``None``: a method does not take the scene, or it is too large to be looked at."""
    if scene.size[0] * scene.size[1] > MOST_PIXELS:
        return None
    try:
        return render(scene, settings)
    except ValueError:
        return None
