"""Experiments of the Stability page: what is chosen for each, and running grids, cells and the shrinker."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from app import __version__
from app.background import Progress
from app.pages.result_page import Choice, Result
from core import Frame, render
from core.coverage.measured_cover import CoverageExperiment, Wanted, as_given, once_everywhere
from core.records.words import counted
from core.scene import AnyScene
from core.settings import Settings
from core.study.cases import Atlas, ExperimentInfo
from core.study.experiment import Experiment
from core.study.fragment_cases import NAME as OPEN_SCENE
from core.study.record import Axis, Opening, Verdict, machine
from core.study.stability import experiments, stress
from core.study.stress import Shrunk, axes_at, shrink_cell
from widgets.experiments.controls import FamilyEntry
from widgets.experiments.maps import CellPlace

# What is chosen for each experiment of the Stability page, and what has been run of it, while the window
# lives.


TITLES = {"coarse": "Coarse", "normal": "Normal", "fine": "Fine"}


@dataclass(eq=False, kw_only=True)
class ExperimentChoice(Choice[Atlas]):
    """One experiment: its choices, and the last atlas of it."""

    info: ExperimentInfo
    experiment: Experiment | None = None
    """``None``: a saved atlas of an experiment that this version does not have."""
    resolution: str = "normal"
    chosen: CellPlace | None = None

    @property
    def axes(self) -> tuple[Axis, ...]:
        """The axes of the chosen grid."""
        return axes_at(self.info.axes, self.resolution)

    @property
    def resolutions(self) -> list[tuple[str, str]]:
        """Names and titles of the grids, with their sizes."""
        rows = []
        for name, title in TITLES.items():
            sizes = [str(len(axis.values)) for axis in axes_at(self.info.axes, name)]
            rows.append((name, f"{title} ({' × '.join(sizes)})"))
        return rows

    @property
    def is_changed(self) -> bool:
        """Whether another grid or seed is chosen now than the result was run on."""
        if self.result is None or self.experiment is None:
            return False
        atlas = self.result.content
        return atlas.seed != self.seed or atlas.experiment.axes != self.axes

    @property
    def entry(self) -> FamilyEntry:
        """The row of the list."""
        note = f"{self.info.question}\n{counted(len(self.info.methods), 'method')}"
        if self.result is not None:
            note += f"\nRun {self.result.content.machine.get('date', '')}".rstrip()
        return FamilyEntry(self.name, self.title, note, self.result is not None)

    def take(self, result: Result[Atlas]) -> None:
        """Keep a result; one that was opened from a file, or is of an earlier start, sets the controls too."""
        super().take(result)
        if not (result.path or result.is_kept):
            return
        self.seed, self.chosen = result.content.seed, None
        if self.name == OPEN_SCENE:  # A file does not hold its scene, and another one may be open now.
            self.info, self.experiment = result.content.experiment, None


def choice_of(info: ExperimentInfo, experiment: Experiment | None) -> ExperimentChoice:
    """Return the choice of an experiment; ``None``: this version has it no longer."""
    pairs = (pair for method in info.methods for pair in method.split())
    families = tuple(dict.fromkeys(pair.partition("=")[0] for pair in pairs))
    return ExperimentChoice(
        name=info.name,
        title=info.title,
        families=families,
        can_run=experiment is not None,
        info=info,
        experiment=experiment,
    )


def choices_of_all() -> dict[str, ExperimentChoice]:
    """Return every experiment that there is."""
    return {each.info.name: choice_of(each.info, each) for each in experiments}


# What the Stability page does off the GUI thread: runs whole grids and single cells, and makes them small.


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
