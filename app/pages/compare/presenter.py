"""The Compare page's measuring: which family, on what work, its charts and numbers as they come."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtCore import Slot

from app.pages.compare.charts import growth_of, numbers_of, scatter_of
from app.pages.compare.choices import FamilyChoice, choice_of_saved, choices_of_all, controls_of
from app.pages.compare.figures import point_text, study_text, table_of
from app.pages.compare.jobs import StudyJobs, StudyOrder, StudyResult, chosen_points, plan_candidates
from app.pages.page_bar import Page
from app.pages.result_presenter import ResultPresenter, ResultWords
from app.pages.words import work_sentence
from app.session.moment import Change
from app.session.session import Session
from core.records.words import counted
from core.settings import Settings
from core.study.accuracy.record import Point, Study
from core.study.accuracy.whole_picture import PIPELINE, SAMPLED_COLOR
from widgets.basics.labels import Readout
from widgets.charts.chart import Chart
from widgets.charts.family_list import FamilyList
from widgets.charts.legend import ChartLegend
from widgets.charts.records import MOST_NAMED, ChartEmpty, ChartPicture
from widgets.charts.study_controls import StudyControls
from widgets.charts.study_table import StudyTable, TableRecord

NOTHING = (
    "Error against cost, one mark for each method, appears here. Measure (F5) takes a few seconds to half a minute; "
    "marks appear as they are measured."
)
NO_GROWTH = "How cost grows with the size of the work appears here, one line for each method."
FIRST = "line"
"""The family that is shown first: its methods are few, and a student knows them."""
GROWTH_COMES = ChartEmpty("Measured after the points of the other chart.")
WORK_WORDS = ResultWords(
    cancelled="Measuring was cancelled",
    failed="It could not be measured",
    kept="the previous results are unchanged",
    running="is still being measured",
    unknown="This version has no such family. A saved study can be viewed, but not measured again.",
    again="measure again (F5)",
)


@dataclass(frozen=True)
class Measurement:
    """A study that is being measured: its own record, whatever family is shown meanwhile."""

    study: Study
    """What has been measured so far."""
    numbers: Mapping[str, int]
    """Number of every method in the charts, in the order that they are listed in."""

    def with_point(self, point: Point) -> "Measurement":
        """Return the measurement with a point added, or replaced."""
        points = {each.method: each for each in self.study.points} | {point.method: point}
        in_order = sorted(points.values(), key=lambda each: self.numbers[each.method])
        return replace(self, study=replace(self.study, points=tuple(in_order)))


class StudyPresenter(ResultPresenter[FamilyChoice]):
    """Keeps the choices and results of all families and shows those of one."""

    def __init__(
        self,
        session: Session,
        jobs: StudyJobs,
        families: FamilyList,
        controls: StudyControls,
        charts: tuple[Chart, Chart],
        legend: ChartLegend,
        numbers: StudyTable,
        readout: Readout,
        page: Page,
    ) -> None:
        super().__init__(
            jobs.measuring, WORK_WORDS, choices_of_all(), families, controls, readout, page, FIRST
        )
        self._session, self._jobs, self._controls = session, jobs, controls
        self._charts, self._legend, self._table = charts, legend, numbers
        self._measurement: Measurement | None = None
        """What runs, or ran last."""
        self._pointed = ""
        self._chosen = ""
        controls.work_chosen.connect(self._choose_work)
        controls.dial_chosen.connect(self._choose_dial)
        controls.measure_chosen.connect(self._choose_measure)
        controls.cost_chosen.connect(self._choose_cost)
        controls.rounds_chosen.connect(self._choose_rounds)
        for chart in (*charts, legend):
            chart.series_hovered.connect(self._point_at)
            chart.series_left.connect(self._point_away)
        session.changed.connect(self._follow)
        self.refresh()

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.PLAN in what:
            self.refresh()

    # What is shown.

    @property
    def result(self) -> StudyResult | None:
        """What has been measured of it, or opened."""
        return self.choice.result

    @property
    def study(self) -> Study | None:
        """The study that is shown: a finished one, or as much as has been measured so far."""
        if self.is_partial:
            return self._partial
        return None if self.result is None else self.result.study

    @property
    def _partial(self) -> Study | None:
        """What has been measured so far of what runs; ``None``: no point yet."""
        measured = self._measurement
        return measured.study if measured is not None and measured.study.points else None

    def point(self, method: str) -> Point | None:
        """Return a point of the study that is shown."""
        points = () if self.study is None else self.study.points
        return next((point for point in points if point.method == method), None)

    def _point_nowhere(self) -> None:
        """Forget the points that are pointed at and chosen."""
        self._pointed = self._chosen = ""

    def show_next_measure(self) -> None:
        """Show the next error on the vertical axis."""
        names = [name for name, _ in self.choice.measures]
        self._choose_measure(names[(names.index(self.choice.measure) + 1) % len(names)])

    def show_next_cost(self) -> None:
        """Show the next cost on the horizontal axis: time, or a count of work."""
        names = [name for name, _ in controls_of(self.choice).costs]
        self._choose_cost(names[(names.index(self.choice.cost) + 1) % len(names)])

    def _show_controls(self) -> None:
        self._controls.show_choices(controls_of(self.choice))

    def _show_result(self) -> None:
        study, choice = self.study, self.choice
        scatter: ChartPicture | ChartEmpty
        growth: ChartPicture | ChartEmpty
        if study is None:
            scatter = ChartEmpty("Measuring …" if self.is_partial else NOTHING)
            growth = ChartEmpty(NO_GROWTH)
            self._table.show_table(TableRecord((), (), ()))
        else:
            running = self._measurement if self.is_partial else None
            numbers = numbers_of(study.points) if running is None else running.numbers
            scatter = scatter_of(study, choice.measure, choice.cost, numbers, self._ringed(study))
            growth = (
                GROWTH_COMES if self.is_partial and choice.grow else growth_of(study, choice.cost, numbers)
            )
            self._table.show_table(table_of(study))
        for chart, picture in zip(self._charts, (scatter, growth), strict=True):
            if isinstance(picture, ChartEmpty):
                chart.show_empty(picture)
            else:
                chart.show_picture(picture)
        self._show_legend(scatter)
        self._show_readout()

    def _show_legend(self, scatter: ChartPicture | ChartEmpty) -> None:
        """Show the list of names beside a chart that is too crowded to hold them all."""
        is_crowded = isinstance(scatter, ChartPicture) and len(scatter.series) > MOST_NAMED
        self._legend.setVisible(is_crowded)
        if isinstance(scatter, ChartPicture) and is_crowded:
            self._legend.show_series(scatter.series, scatter.front)

    def _ringed(self, study: Study) -> tuple[str, ...]:
        """Return the points that a plan chose for the scene that was measured."""
        plan, result = self._session.plan, self.result
        is_of_plan = plan is not None and (
            self.is_partial or (result is not None and result.scene is plan.scene)
        )
        return chosen_points(study, plan.plan if plan is not None and is_of_plan else None)

    def _partial_text(self) -> str:
        study = self._partial
        if study is None:
            return ""
        return f"{_work_text(study)} {counted(len(study.points), 'method')} measured so far."

    def _result_texts(self) -> list[str]:
        assert self.result is not None
        study = self.result.study
        refused = sum(bool(point.refused) for point in study.points)
        return [_work_text(study)] + [f"{counted(refused, 'method')} refused this work."] * bool(refused)

    def choose(self, method: str) -> None:
        """Keep the figures of a method in the readout while nothing else is pointed at; empty: of none."""
        self._chosen = method
        self._show_readout()

    @Slot(str)
    def _point_at(self, method: str) -> None:
        self._pointed = method
        self._show_pointed()

    @Slot()
    def _point_away(self) -> None:
        self._pointed = ""
        self._show_pointed()

    def _show_pointed(self) -> None:
        for chart in (*self._charts, self._legend):
            chart.show_pointed(self._pointed)
        self._show_readout()

    def _show_readout(self) -> None:
        study = self.study
        if study is None:
            self._readout.show_text(_about(self.choice))
            return
        point = self.point(self._pointed) or self.point(self._chosen)
        path = self.result.path if self.result is not None and not self.is_partial else ""
        self._readout.show_text(study_text(study, path) if point is None else point_text(study, point))

    # Choosing.

    @Slot(str)
    def _choose_work(self, name: str) -> None:
        self.choice.work = name
        self.refresh()

    @Slot(str, float)
    def _choose_dial(self, name: str, value: float) -> None:
        self.choice.dials[self.choice.work, name] = value
        self.tell_shown()

    @Slot(str)
    def _choose_measure(self, name: str) -> None:
        self.choice.measure = name
        self.refresh()

    @Slot(str)
    def _choose_cost(self, name: str) -> None:
        self.choice.cost = name
        self.refresh()

    @Slot(int)
    def _choose_rounds(self, rounds: int) -> None:
        self.choice.rounds = rounds

    # Measuring.

    def _prepare(self) -> Callable[[], None]:
        """Return what measures the family that is shown on the chosen work."""
        choice = self.choice
        assert choice.family is not None
        order = StudyOrder(
            choice.name, choice.work, choice.dial_values, choice.rounds, choice.seed, grow=choice.grow
        )
        settings = choice.family.base
        if choice.family.takes_scene:
            document = self._session.document
            settings = document.settings
            order = replace(
                order, scene=document.scene, settings=settings, scene_title=document.title or "scene"
            )
            plan = self._session.plan
            if plan is not None:
                others = choice.family.candidates(settings)
                order = replace(order, extra=plan_candidates(plan.plan, settings, others))
        methods = [each.method for each in (*choice.family.candidates(settings), *order.extra)]
        numbers = {method: number for number, method in enumerate(methods)}
        self._measurement = Measurement(_unmeasured(choice, order), numbers)
        return partial(self._jobs.measure, order)

    def measure_scene(self) -> None:
        """Measure the whole pipeline on the open scene; beside a plan with an error that does not mind samples."""
        self.show_named(PIPELINE.name)
        if self._session.plan is not None and self._session.document.settings.polygon_mode == "fill":
            self.choice.measure = SAMPLED_COLOR.name
        self.start()

    def _keep_part(self, part: Point) -> None:
        assert self._measurement is not None
        self._measurement = self._measurement.with_point(part)

    def _done_text(self, result: StudyResult) -> str:
        return f"Measured {self._choices[result.name].title.lower()}."

    # Saved studies.

    def _result_of(self, content: Study, path: str = "", is_kept: bool = False) -> StudyResult:
        return StudyResult(content, path=path, is_kept=is_kept)

    def _unknown_choice(self, result: StudyResult) -> FamilyChoice:
        return choice_of_saved(result.study)


def _work_text(study: Study) -> str:
    return f"{work_sentence(study)}; seed {study.seed}."


def _unmeasured(choice: FamilyChoice, order: StudyOrder) -> Study:
    """Return a study of what is about to be measured, without any point."""
    assert choice.family is not None
    return Study(
        family=choice.name,
        title=choice.family.title,
        work=choice.work_kind,
        dials=order.dials,
        seed=order.seed,
        measures=choice.family.measures,
        points=(),
        settings=order.settings or Settings(),
        scene=order.scene_title,
    )


def _about(choice: FamilyChoice) -> str:
    """Return what can be compared here, as rich text."""
    works = "".join(f"<li>{work.title}</li>" for work in choice.works)
    errors = "".join(f"<li>{title}</li>" for _, title in choice.measures)
    return (
        f"<b>{choice.title}</b><p>All methods of this family do the same work; each is timed and compared with an "
        f"exact reference.</p>Work:<ul style='margin-left:-24px'>{works}</ul>"
        f"Errors:<ul style='margin-left:-24px'>{errors}</ul>"
    )
