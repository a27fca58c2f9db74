"""What is chosen for each experiment of the Stability page, and what has been run of it, while the window lives."""

from dataclasses import dataclass

from app.pages.result_page import Choice, Result
from core.records.words import counted
from core.study.stability import Atlas, Axis, Experiment, ExperimentInfo, experiments
from core.study.stability.open_scene import NAME as OPEN_SCENE
from core.study.stability.stress import axes_at
from widgets.atlas.records import CellPlace
from widgets.charts.family_list import FamilyEntry

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
