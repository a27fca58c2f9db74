"""What is chosen for each experiment of the Stability page, and what has been run of it, while the window lives."""

from dataclasses import dataclass

from core.explain.number_text import counted
from core.study.stability import Atlas, Experiment, ExperimentInfo, experiments
from core.study.stability.stress import axes_at
from widgets.atlas.records import CellPlace
from widgets.charts.family_list import FamilyEntry

TITLES = {"coarse": "Coarse", "normal": "Normal", "fine": "Fine"}


@dataclass(frozen=True, eq=False)
class AtlasResult:
    """An atlas, and where it is from."""

    atlas: Atlas
    path: str = ""
    """The file it was opened from; empty: it was run here."""
    is_kept: bool = False
    """Whether it is of an earlier start of the window."""


@dataclass(eq=False)
class ExperimentChoice:
    """One experiment: its choices, and the last atlas of it."""

    info: ExperimentInfo
    experiment: Experiment | None
    """``None``: a saved atlas of an experiment that this version does not have."""
    resolution: str = "normal"
    seed: int = 0
    result: AtlasResult | None = None
    chosen: CellPlace | None = None

    @property
    def name(self) -> str:
        """Name of the experiment."""
        return self.info.name

    @property
    def title(self) -> str:
        """What it is called in the list."""
        return self.info.title

    @property
    def resolutions(self) -> list[tuple[str, str]]:
        """Names and titles of the grids, with their sizes."""
        rows = []
        for name, title in TITLES.items():
            sizes = [str(len(axis.values)) for axis in axes_at(self.info.axes, name)]
            rows.append((name, f"{title} ({' × '.join(sizes)})"))
        return rows

    def is_set_as(self, atlas: Atlas) -> bool:
        """Return whether an atlas is one of what is chosen now."""
        axes = axes_at(self.info.axes, self.resolution)
        return atlas.seed == self.seed and atlas.experiment.axes == axes


def choices_of_all() -> dict[str, ExperimentChoice]:
    """Return every experiment that there is."""
    return {each.info.name: ExperimentChoice(each.info, each) for each in experiments}


def entry_of(choice: ExperimentChoice) -> FamilyEntry:
    """Return the row of the list."""
    note = f"{choice.info.question}\n{counted(len(choice.info.methods), 'method')}"
    if choice.result is not None:
        note += f"\nRun {choice.result.atlas.machine.get('date', '')}".rstrip()
    return FamilyEntry(choice.info.name, choice.info.title, note, choice.result is not None)
