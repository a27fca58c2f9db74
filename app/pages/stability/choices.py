"""What is chosen for each experiment of the Stability page, and what has been run of it, while the window lives."""

from collections.abc import Mapping
from dataclasses import dataclass

from core.records.words import counted
from core.study.stability import Atlas, Experiment, ExperimentInfo, experiments
from core.study.stability.open_scene import NAME as OPEN_SCENE
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
    is_example: bool = False
    """Whether it came with the program."""

    @property
    def name(self) -> str:
        """Experiment of the atlas."""
        return self.atlas.experiment.name

    @property
    def machine(self) -> Mapping[str, str]:
        """Where it was run."""
        return self.atlas.machine


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
    def families(self) -> tuple[str, ...]:
        """The families of methods that differ in it."""
        pairs = (pair for method in self.info.methods for pair in method.split())
        return tuple(dict.fromkeys(pair.partition("=")[0] for pair in pairs))

    @property
    def resolutions(self) -> list[tuple[str, str]]:
        """Names and titles of the grids, with their sizes."""
        rows = []
        for name, title in TITLES.items():
            sizes = [str(len(axis.values)) for axis in axes_at(self.info.axes, name)]
            rows.append((name, f"{title} ({' × '.join(sizes)})"))
        return rows

    @property
    def can_run(self) -> bool:
        """Whether this version has the experiment; one on the open scene is made anew for it."""
        return self.experiment is not None or self.name == OPEN_SCENE

    @property
    def is_changed(self) -> bool:
        """Whether another grid or seed is chosen now than the result was run on."""
        if self.result is None or self.experiment is None:
            return False
        atlas, axes = self.result.atlas, axes_at(self.info.axes, self.resolution)
        return atlas.seed != self.seed or atlas.experiment.axes != axes

    def entry(self) -> FamilyEntry:
        """Return the row of the list."""
        note = f"{self.info.question}\n{counted(len(self.info.methods), 'method')}"
        if self.result is not None:
            note += f"\nRun {self.result.machine.get('date', '')}".rstrip()
        return FamilyEntry(self.name, self.title, note, self.result is not None)

    def take(self, result: AtlasResult) -> None:
        """Keep a result; one that was opened from a file, or is of an earlier start, sets the controls too."""
        self.result = result
        if not (result.path or result.is_kept):
            return
        self.seed, self.chosen = result.atlas.seed, None
        if self.name == OPEN_SCENE:  # A file does not hold its scene, and another one may be open now.
            self.info, self.experiment = result.atlas.experiment, None


def choices_of_all() -> dict[str, ExperimentChoice]:
    """Return every experiment that there is."""
    return {each.info.name: ExperimentChoice(each.info, each) for each in experiments}
