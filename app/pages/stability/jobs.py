"""Runs experiments off the GUI thread: whole grids, single cells, and the shrinker."""

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Slot

from app import __version__
from app.background.turns import turns
from app.background.workers import JobGroup, Progress
from app.pages.stability.choices import AtlasResult
from core import Frame, render
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.study import Opening, machine
from core.study.stability import Axis, Experiment, StressCancelledError, Verdict, stress
from core.study.stability.coverage.covered_pixels import CoverageExperiment, Wanted, as_given, once_everywhere
from core.study.stability.coverage.dial_pixel import PixelInFormats, pixel_in_formats
from core.study.stability.shrink import Shrunk, shrink_cell
from widgets.atlas.records import CellPlace

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
    """One cell to open."""

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
    frame: Frame | None


class StabilityJobs(JobGroup):
    """At most one run of a grid, one look at a cell, one shrinking and one reading at a time."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.running = self.add_job()
        """Gives a tuple of `CellRun` for every row of a map, and in the end an `AtlasResult`."""
        self.looking = self.add_job()
        """Gives a `CaseFound`."""
        self.shrinking = self.add_job((ValueError, MemoryError, StressCancelledError))
        """Gives a `ShrunkFound`."""
        self.reading = self.add_job()
        """Gives a ``PixelInFormats``."""

    def run(self, order: StressOrder) -> None:
        """Run an experiment; rows of cells come as they are done."""
        last = len(order.axes[0].values) - 1

        def work(
            progress: Progress,
            is_cancelled: Callable[[], bool],
            row_done: Callable[[tuple[CellRun, ...]], None],
        ) -> AtlasResult:
            row: list[CellRun] = []

            def cell_done(method: str, column: int, number: int, verdict: Verdict) -> None:
                place = CellPlace(method, column, number)
                row.append(CellRun(place, verdict))
                if column == last:
                    row_done(tuple(row))
                    row.clear()

            with turns.take("Stability", progress, is_cancelled):
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

        self.running.start_in_parts(work)

    def look(self, order: CaseOrder) -> None:
        """Run one cell once more and draw it."""

        def work() -> CaseFound:
            experiment, method = order.experiment, order.place.key
            verdict = experiment.run(method, order.values, order.seed)
            opening = experiment.opening(method, order.values, order.seed)
            frame = None if opening is None else drawn(opening.scene, opening.settings)
            return CaseFound(order, verdict, opening, frame)

        self.shrinking.cancel()
        self.looking.call(work)

    def shrink(self, order: CaseOrder) -> None:
        """Make one cell small."""

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> ShrunkFound:
            method = order.place.key
            shrunk = shrink_cell(
                order.experiment, method, order.values, order.seed, is_cancelled=is_cancelled
            )
            return ShrunkFound(order, shrunk, drawn(shrunk.scene, shrunk.settings))

        self.shrinking.start(work)

    def read_dial(self, scene: ClipScene, settings: Settings, pixel: tuple[int, int], wanted: Wanted) -> None:
        """Look at a pixel of a run in every number format."""

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> PixelInFormats:
            return pixel_in_formats(scene, settings, pixel, wanted, is_cancelled)

        self.reading.start(work)

    @Slot()
    def stop_looking(self) -> None:
        """Wait for no single cell any more."""
        for job in (self.reading, self.looking, self.shrinking):
            job.cancel()


def wanted_cover(experiment: Experiment, is_part: bool) -> Wanted:
    """Return how often pixels are to be covered by the triangles of an experiment, or by ``is_part`` of a mesh."""
    wanted = experiment.wanted if isinstance(experiment, CoverageExperiment) else as_given
    return as_given if is_part and wanted is once_everywhere else wanted


def drawn(scene: AnyScene, settings: Settings) -> Frame | None:
    """Return the picture of a case; ``None``: a method does not take the scene, or it is too large to show."""
    if scene.size[0] * scene.size[1] > MOST_PIXELS:
        return None
    try:
        return render(scene, settings)
    except ValueError:
        return None
