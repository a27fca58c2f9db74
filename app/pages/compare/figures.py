"""What is chosen and has been measured of each family: as controls, as the figures of a method, as a table."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from html import escape
from math import isinf, isnan

from app.pages.compare.charts import TIME, cost_title, costs_of, title_of
from app.pages.result_page import Choice, Result
from app.pages.words import (
    best_sentences,
    digits,
    interval_text,
    machine_sentence,
    place_text,
    settings_sentence,
    time_text,
    with_unit,
    work_sentence,
)
from core.methods import table
from core.records.words import counted
from core.study.families import study_families
from core.study.family import StudyFamily
from core.study.record import Axis, ErrorMeasure, Point, Study, WorkKind, ranks
from core.study.speed_accuracy import ROUNDS
from widgets.experiments.controls import DialChoice, FamilyEntry, StudyChoices
from widgets.experiments.series import Cell, TableRecord

# What is chosen for each family of the Compare page, and what has been measured of it, while the window
# lives.


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


# The figures of a study in words: of one method, of the whole, and as a table.


def error_text(value: float, measure: ErrorMeasure) -> str:
    """Return an error with its unit."""
    if isnan(value):
        return "not defined"
    return with_unit("∞" if isinf(value) else digits(value, 4), measure.unit)


def point_text(study: Study, point: Point) -> str:
    """Return everything that is known of one method, as rich text."""
    parts = [
        f"<b>{escape(title_of(point, [each.method for each in study.points]))}</b>",
        escape(point.method),
    ]
    if point.refused:
        parts.append(f"Not measured: {escape(point.refused)}")
    elif not point.is_measured:
        parts.append("Not measured yet.")
    else:
        rows = [
            (f"time per {study.work.unit}", time_text(point.median)),
            ("least", time_text(point.least)),
            ("interval of the median", interval_text(point.interval)),
            ("place by time", place_text(ranks(study.points)[point.method])),
            ("rounds", f"{len(point.seconds)} of {counted(point.unit_count, study.work.unit)} each"),
        ]
        rows += [
            (measure.title, error_text(point.errors[measure.name], measure))
            for measure in study.measures
            if measure.name in point.errors
        ]
        rows += [(name, f"{count:,}") for name, count in point.counts.items()]
        parts.append(_rows(rows))
        parts += [escape(reason) for reason in dict.fromkeys(point.reasons.values())]
    parts += method_notes(point)
    return _paragraphs(parts)


def method_notes(point: Point) -> list[str]:
    """Return what the table of methods says of a point: exact for what, breaking where, from which source."""
    notes = []
    for part in point.method.split():
        family, _, name = part.partition("=")
        if family not in table.families or name not in table.names(family):
            notes.append(f"{escape(part)} is not a method of this version.")
            continue
        method = table.get(family, name)
        notes.append(f"Exact for {escape(method.exact_for)}.")
        if method.breaks_where:
            notes.append(f"Breaks: {escape(method.breaks_where)}.")
        notes.append(f"Source: {escape(method.source)}.")
    return notes


def study_text(study: Study, path: str = "") -> str:
    """Return what was measured, on what, and what is not in the chart, as rich text."""
    parts = [f"<b>{escape(study.title)}</b>", f"{escape(work_sentence(study))}."]
    if path:
        parts.append(
            f"A saved study, {escape(path)}. Its numbers were measured on the machine and day below."
        )
    parts.append(
        "Point at a mark to read its figures. Click it to see its picture; Ctrl+click another one to compare."
    )
    refused = [point for point in study.points if point.refused]
    if refused:
        parts.append("Not measured:")
        names = [each.method for each in study.points]
        parts += [f"<b>{escape(title_of(point, names))}</b>. {escape(point.refused)}" for point in refused]
    reasons = dict.fromkeys(reason for point in study.points for reason in point.reasons.values())
    parts += [escape(reason) for reason in reasons]
    parts += [escape(sentence) for sentence in best_sentences(study)]
    parts.append(f"{escape(settings_sentence(study))}.")
    if study.machine:
        parts.append(f"{escape(machine_sentence(study))}.")
    return _paragraphs(parts)


def study_sentences(study: Study) -> list[str]:
    """Return what was measured, and how many methods refused it."""
    refused = sum(bool(point.refused) for point in study.points)
    said = [f"{counted(refused, 'method')} refused this work."] if refused else []
    return [f"{work_sentence(study)}; seed {study.seed}.", *said]


def family_text(choice: FamilyChoice) -> str:
    """Return what can be compared of a family, as rich text."""
    works = "".join(f"<li>{work.title}</li>" for work in choice.works)
    errors = "".join(f"<li>{title}</li>" for _, title in choice.measures)
    return (
        f"<b>{choice.title}</b><p>All methods of this family do the same work; each is timed and compared with an "
        f"exact reference.</p>Work:<ul style='margin-left:-24px'>{works}</ul>"
        f"Errors:<ul style='margin-left:-24px'>{errors}</ul>"
    )


def table_of(study: Study) -> TableRecord:
    """Return the numbers of all methods; each cell has the full value too."""
    costs = costs_of(study.points)[1:]
    head = ["Method", f"Time per {study.work.unit}", "Least", "Interval from", "Interval to", "Place by time"]
    head += [
        f"{measure.title} ({measure.unit})" if measure.unit else measure.title for measure in study.measures
    ]
    head += [cost[:1].upper() + cost[1:] for cost in costs]
    head.append("Note")
    places = ranks(study.points)
    rows = tuple(_row(study, point, costs, places) for point in study.points)
    return TableRecord(tuple(head), tuple(point.method for point in study.points), rows)


def _row(
    study: Study, point: Point, costs: list[str], places: Mapping[str, tuple[int, int]]
) -> tuple[Cell, ...]:
    name = Cell(title_of(point, [each.method for each in study.points]))
    if not point.is_measured:
        empty = Cell("–")
        return (
            name,
            *[empty] * (5 + len(study.measures) + len(costs)),
            Cell(point.refused or "Not measured."),
        )
    times = (point.median, point.least, *point.interval)
    place = places[point.method]
    return (
        name,
        *(Cell(time_text(seconds), seconds, repr(seconds)) for seconds in times),
        Cell(place_text(place), sum(place) / 2),
        *(_error_cell(point.errors.get(measure.name, float("nan"))) for measure in study.measures),
        *(_count_cell(point.counts.get(cost)) for cost in costs),
        Cell(" ".join(dict.fromkeys(point.reasons.values()))),
    )


def _error_cell(value: float) -> Cell:
    return (
        Cell("–")
        if isnan(value)
        else Cell("∞" if isinf(value) else digits(value, 4), value, repr(float(value)))
    )


def _count_cell(count: int | None) -> Cell:
    return Cell("–") if count is None else Cell(f"{count:,}", float(count), str(count))


def _rows(rows: Iterable[tuple[str, str]]) -> str:
    cells = (
        f"<tr><td>{escape(name[:1].upper() + name[1:])}&nbsp;</td><td align='right'>{escape(value)}</td></tr>"
        for name, value in rows
    )
    return f"<table cellspacing='2'>{''.join(cells)}</table>"


def _paragraphs(parts: Iterable[str]) -> str:
    return "".join(
        part if part.startswith("<table") else f"<p style='margin:4px 0'>{part}</p>" for part in parts
    )
