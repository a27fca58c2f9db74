"""What is chosen for each family of the Compare page, and what has been measured of it, while the window lives."""

from dataclasses import dataclass, field

from app.pages.compare.charts import TIME, cost_title, costs_of
from app.pages.result_page import Choice, Result
from core.study import study_families
from core.study.accuracy.family import StudyFamily
from core.study.accuracy.record import Axis, Study, WorkKind
from core.study.accuracy.speed_accuracy import ROUNDS
from widgets.charts.dial_control import DialChoice
from widgets.charts.family_list import FamilyEntry
from widgets.charts.study_controls import StudyChoices


@dataclass(eq=False, kw_only=True)
class FamilyChoice(Choice[Study]):
    """One family: its choices, and the last study of it."""

    works: tuple[WorkKind, ...]
    family: StudyFamily | None = None
    """``None``: a saved study of a family that this version does not have."""
    work: str
    dials: dict[tuple[str, str], float] = field(default_factory=dict)
    """By work and dial; those that are left out stand at their defaults."""
    measure: str = ""
    cost: str = TIME
    rounds: int = ROUNDS
    grow: bool = True
    """Whether growth is measured too; a picture of the page may do without."""

    @property
    def work_kind(self) -> WorkKind:
        """The chosen work."""
        return next((work for work in self.works if work.name == self.work), self.works[0])

    def dial_value(self, dial: Axis) -> float:
        """Return where a dial of the chosen work stands."""
        return self.dials.get((self.work, dial.name), dial.default)

    @property
    def dial_values(self) -> dict[str, float]:
        """All dials of the chosen work."""
        return {dial.name: self.dial_value(dial) for dial in self.work_kind.dials}

    @property
    def measures(self) -> list[tuple[str, str]]:
        """Names and titles of the errors."""
        source = self.result.content.measures if self.result else self.family.measures if self.family else ()
        return [(m.name, f"{m.title} ({m.unit})" if m.unit else m.title) for m in source]

    @property
    def is_changed(self) -> bool:
        """Whether other work is chosen now than the result was measured on."""
        if self.result is None:
            return False
        study = self.result.content
        return (study.work.name, dict(study.dials), study.seed) != (self.work, self.dial_values, self.seed)

    @property
    def entry(self) -> FamilyEntry:
        """The row of the list."""
        note = f"{len(self.works)} kinds of work" if len(self.works) > 1 else self.works[0].title
        if self.result is not None:
            note += f"\nMeasured {self.result.content.machine.get('date', '')}".rstrip()
        is_of_scene = self.family is not None and self.family.takes_scene
        return FamilyEntry(self.name, self.title, note, self.result is not None, ends_group=is_of_scene)

    def take(self, result: Result[Study]) -> None:
        """Keep a result; one that was opened from a file, or is of an earlier start, sets the controls too."""
        super().take(result)
        study = result.content
        if study.work.name not in {work.name for work in self.works}:
            self.works = (*self.works, study.work)
        if result.path or result.is_kept:
            self.work, self.seed = study.work.name, study.seed
            self.dials |= {(self.work, name): value for name, value in study.dials.items()}
        if self.measure not in {measure.name for measure in study.measures}:
            self.measure = study.measures[0].name
        if self.cost not in costs_of(study.points):
            self.cost = TIME


def choices_of_all() -> dict[str, FamilyChoice]:
    """Return every family that can be studied, the whole pipeline on the open scene first."""
    families = sorted(study_families(), key=lambda family: not family.takes_scene)
    return {
        family.name: FamilyChoice(
            name=family.name,
            title="Whole pipeline on the open scene" if family.takes_scene else family.title,
            families=family.varies,
            works=family.works,
            family=family,
            work=family.works[0].name,
            measure=family.measures[0].name,
        )
        for family in families
    }


def choice_of_saved(study: Study) -> FamilyChoice:
    """Return the choice of a family that this version does not have."""
    return FamilyChoice(
        name=study.family, title=study.title, can_run=False, works=(study.work,), work=study.work.name
    )


def controls_of(choice: FamilyChoice) -> StudyChoices:
    """Return what stands above the charts."""
    work = choice.work_kind
    points = choice.result.content.points if choice.result else ()
    unit = choice.result.content.work.unit if choice.result else work.unit
    return StudyChoices(
        works=[(kind.name, kind.title) for kind in choice.works],
        work=work.name,
        dials=tuple(
            DialChoice(dial.name, dial.title, dial.unit, dial.values, choice.dial_value(dial))
            for dial in work.dials
        ),
        measures=choice.measures,
        measure=choice.measure,
        costs=[(cost, cost_title(cost, unit)) for cost in costs_of(points)],
        cost=choice.cost,
        rounds=choice.rounds,
        seed=choice.seed,
        can_measure=choice.can_run,
    )
