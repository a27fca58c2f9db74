"""What the Stability page does off the GUI thread: runs whole grids and single cells, and makes them small."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from app import __version__
from app.background.workers import Progress
from app.pages.result_page import Result
from core import Frame, render
from core.scene import AnyScene
from core.settings import Settings
from core.study import Opening, machine
from core.study.stability import Atlas, Axis, Experiment, Verdict, stress
from core.study.stability.coverage.covered_pixels import CoverageExperiment, Wanted, as_given, once_everywhere
from core.study.stability.shrink import Shrunk, shrink_cell
from widgets.atlas.records import CellPlace

MOST_PIXELS = 1 << 20
"""Of a picture that is drawn beside the maps; a larger one is only opened in the stepper."""


@dataclass(frozen=True, eq=False)
class RowRun:
    """One finished row of a map of the present run."""

    method: str
    row: int
    verdicts: tuple[Verdict, ...]


@dataclass(frozen=True)
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
    shrunk: Shrunk | None = None
    """What it was made small to, which opens and is drawn instead; ``None``: it is shown as it was run."""


def run_grid(
    experiment: Experiment,
    axes: tuple[Axis, ...],
    seed: int,
    progress: Progress,
    is_cancelled: Callable[[], bool],
    row_done: Callable[[RowRun], None],
) -> Result[Atlas]:
    """Run an experiment; rows of cells come as they are done."""
    verdicts: list[Verdict] = []

    def cell_done(method: str, column: int, row: int, verdict: Verdict) -> None:
        verdicts.append(verdict)
        if len(verdicts) == len(axes[0].values):
            row_done(RowRun(method, row, tuple(verdicts)))
            verdicts.clear()

    atlas = stress(
        experiment,
        seed=seed,
        axes=axes,
        progress=progress,
        is_cancelled=is_cancelled,
        machine=machine(__version__),
        cell_done=cell_done,
    )
    return Result(atlas)


def run_case(order: CaseOrder) -> CaseFound:
    """Run one cell once more and draw it."""
    experiment, case = order.experiment, (order.place.key, order.values, order.seed)
    verdict, opening = experiment.run(*case), experiment.opening(*case)
    frame = None if opening is None else drawn(opening.scene, opening.settings)
    return CaseFound(order, verdict, opening, frame)


def shrink_case(found: CaseFound, progress: Progress, is_cancelled: Callable[[], bool]) -> CaseFound:
    """Make one cell small."""
    order = found.order
    shrunk = shrink_cell(
        order.experiment, order.place.key, order.values, order.seed, is_cancelled=is_cancelled
    )
    return replace(found, opening=shrunk.opening, frame=drawn(shrunk.scene, shrunk.settings), shrunk=shrunk)


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
