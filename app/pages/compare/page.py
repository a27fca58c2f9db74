"""The page that charts speed against accuracy, and the pictures that a click on a point opens."""

from dataclasses import replace
from functools import partial
from operator import attrgetter
from typing import Any

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QSplitter, QTabWidget, QWidget

from app import __version__
from app.background import PartWork
from app.pages.compare import figures
from app.pages.compare.charts import growth_of, numbers_of, scatter_of, title_of
from app.pages.compare.jobs import chosen_points, drawn_points, measured, plan_candidates
from app.pages.compare.study_files import EXTENSION, load_study, study_content, study_stem
from app.pages.experiment_page import OpenedPictures, splitter
from app.pages.result_page import ResultKind, ResultPage
from app.session.moment import Change
from app.session.session import Session
from core.records.words import counted
from core.study.family import Candidate
from core.study.record import Point, Study, machine
from core.study.speed_accuracy import measure
from core.study.whole_picture import PIPELINE, SAMPLED_COLOR
from widgets.basics.controls import row_layout
from widgets.experiments.case_pictures import StudyPictures
from widgets.experiments.chart import Chart
from widgets.experiments.controls import StudyControls
from widgets.experiments.series import (
    MOST_NAMED,
    ChartEmpty,
    ChartLegend,
    ChartPicture,
    StudyTable,
    TableRecord,
)

KIND: ResultKind[Study, figures.FamilyChoice] = ResultKind(
    page="Compare",
    cancelled="Measuring was cancelled",
    failed="It could not be measured",
    kept="the previous results are unchanged",
    running="is still being measured",
    unknown="This version has no such family. A saved study can be viewed, but not measured again.",
    again="measure again (F5)",
    noun="study",
    view="charts",
    nothing="measure first (F5)",
    endings="Chart with its figures (*.png);;Drawing (*.svg);;Table of the numbers (*.csv);;"
    f"Study, to be opened again (*{EXTENSION});;Current view (*.pdf)",
    export_tip="Write the charts, the numbers or the whole study to a file (Ctrl+E)",
    copy_tip="Put the charts, or the numbers with all their digits, on the clipboard",
    load=load_study,
    content=lambda study, choice, ending: study_content(study, choice.measure, ending, choice.cost),
    stem=study_stem,
    name_of=attrgetter("family"),
    saved_choice=figures.choice_of_saved,
    sentences=figures.study_sentences,
    so_far=lambda study: (
        f"{figures.study_sentences(study)[0]} {counted(len(study.points), 'method')} measured so far."
    ),
    done=lambda title, _: f"Measured {title.lower()}.",
)
NOTHING = (
    "Error against cost, one mark for each method, appears here. Measure (F5) takes a few seconds to half a minute; "
    "marks appear as they are measured."
)
NO_GROWTH = "How cost grows with the size of the work appears here, one line for each method."
GROWTH_COMES = ChartEmpty("Measured after the points of the other chart.")
HINT = "Click a mark for its pictures; Ctrl+click another one to compare the two."
FIRST = "line"
"""The family that is shown first: its methods are few, and a student knows them."""
LETTERS = ("A", "B")


class ComparePage(ResultPage[Study, figures.FamilyChoice]):
    """Measures the families of methods; shows each method as a point, and what one or two points drew."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(KIND, figures.choices_of_all(), FIRST, parent)
        self._session = session
        self.controls: StudyControls = StudyControls(self)
        self.scatter, self.growth = Chart("Error against cost", self), Chart("Cost against size", self)
        self.legend, self.table, self.pictures = ChartLegend(self), StudyTable(self), StudyPictures(self)
        self.opened = OpenedPictures(self.pictures, self)
        self._unmeasured: Study | None = None
        """What runs or ran last, without its points."""
        self._numbers: dict[str, int] = {}
        """Number of each of its methods in the charts, in the order that they are listed in."""
        self.chosen: tuple[str, ...] = ()
        """Methods whose pictures are opened: A, or A and B."""
        self.refresh()
        self._show_opened()
        above = ((self._tabs(), 1), (self.shown_text, 0))
        self.lay_out(self.list_column((300, 360)), above, self.pictures)
        self.setFocusProxy(self.scatter)
        self.controls.dial_chosen.connect(self._choose_dial)
        for chart in self._linked:
            chart.series_hovered.connect(self._point_at)
            chart.series_left.connect(self._point_away)
            chart.series_chosen.connect(self.choose)
        self.table.row_chosen.connect(self._choose_row)
        self.pictures.closing_requested.connect(self._hide_pictures)
        session.changed.connect(self._follow)

    @property
    def _linked(self) -> tuple[Chart | ChartLegend, ...]:
        """What shows the methods, with the same one pointed at."""
        return self.scatter, self.growth, self.legend

    def _tabs(self) -> QWidget:
        panes = ((self.scatter, 3, 540), (self.legend, 1, 230), (self.growth, 2, 300))
        self.charts = splitter(Qt.Orientation.Horizontal, panes, self)
        self.tabs = QTabWidget(self, documentMode=True)
        self.tabs.tabBar().setDrawBase(False)
        self.tabs.addTab(self.charts, "Charts")
        self.tabs.addTab(self.table, "Numbers")
        corner = QWidget(self)
        row = row_layout(corner, 8, margins=(0, 0, 0, 4))
        for button in (self.reference_button, self.export_button, self.copy_button):
            row.addWidget(button)
        self.tabs.setCornerWidget(corner)
        return self.tabs

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.PLAN in what:
            self.refresh()

    # What is shown.

    def point(self, method: str) -> Point | None:
        """Return a point of the study that is shown."""
        points = () if self.content is None else self.content.points
        return next((point for point in points if point.method == method), None)

    def _show_controls(self) -> None:
        self.controls.show_choices(figures.controls_of(self.choice))

    def _show_result(self) -> None:
        study, choice = self.content, self.choice
        scatter: ChartPicture | ChartEmpty
        growth: ChartPicture | ChartEmpty
        if study is None:
            scatter = ChartEmpty("Measuring …" if self.is_partial else NOTHING)
            growth = ChartEmpty(NO_GROWTH)
            self.table.show_table(TableRecord((), (), ()))
        else:
            numbers = self._numbers if self.is_partial else numbers_of(study.points)
            scatter = scatter_of(study, choice.measure, choice.cost, numbers, self._ringed(study))
            growth = (
                GROWTH_COMES if self.is_partial and choice.grow else growth_of(study, choice.cost, numbers)
            )
            self.table.show_table(figures.table_of(study))
        self.scatter.show_picture(scatter)
        self.growth.show_picture(growth)
        self._show_legend(scatter)
        self._show_readout()

    def _show_legend(self, scatter: ChartPicture | ChartEmpty) -> None:
        """Show the list of names beside a chart that is too crowded to hold them all."""
        is_crowded = isinstance(scatter, ChartPicture) and len(scatter.series) > MOST_NAMED
        self.legend.setVisible(is_crowded)
        if isinstance(scatter, ChartPicture) and is_crowded:
            self.legend.show_series(scatter.series, scatter.front)

    def _ringed(self, study: Study) -> tuple[str, ...]:
        """Return the points that a plan chose for the scene that was measured."""
        plan, result = self._session.plan, self.choice.result
        is_of_plan = plan is not None and (
            self.is_partial or (result is not None and result.scene is plan.scene)
        )
        return chosen_points(study, plan.plan if plan is not None and is_of_plan else None)

    @Slot(str)
    def _point_at(self, method: str) -> None:
        self._pointed = method
        self._show_pointed()

    @Slot()
    def _point_away(self) -> None:
        self._point_at("")

    def _show_pointed(self) -> None:
        for chart in self._linked:
            chart.show_pointed(self._pointed)
        self._show_readout()

    def _show_readout(self) -> None:
        """Show the figures of the method that is pointed at, or of the one that was chosen last."""
        study, result = self.content, self.choice.result
        if study is None:
            self.readout.show_text(figures.family_text(self.choice))
            return
        points = [self.point(method) for method in (self._pointed, *self.chosen[-1:])]
        point = next((each for each in points if each is not None), None)
        path = result.path if result is not None and not self.is_partial else ""
        self.readout.show_text(
            figures.study_text(study, path) if point is None else figures.point_text(study, point)
        )

    # Choosing.

    @Slot(str, object)
    def _choose(self, name: str, value: Any) -> None:
        super()._choose(name, value)
        if name in ("work", "measure", "cost"):
            self.refresh()

    @Slot(str, float)
    def _choose_dial(self, name: str, value: float) -> None:
        self.choice.dials[self.choice.work, name] = value
        self._show_text()

    def show_next_measure(self) -> None:
        """Show the next error on the vertical axis."""
        names = [name for name, _ in self.choice.measures]
        self._choose("measure", names[(names.index(self.choice.measure) + 1) % len(names)])

    def show_next_cost(self) -> None:
        """Show the next cost on the horizontal axis: time, or a count of work."""
        names = [name for name, _ in figures.controls_of(self.choice).costs]
        self._choose("cost", names[(names.index(self.choice.cost) + 1) % len(names)])

    def toggle_numbers(self) -> None:
        """Show the table instead of the charts, or the charts again."""
        self.tabs.setCurrentIndex(1 - self.tabs.currentIndex())
        (self.table if self.tabs.currentIndex() else self.scatter).setFocus(
            Qt.FocusReason.ShortcutFocusReason
        )

    def fit_charts(self) -> None:
        """Show everything in both charts."""
        self.scatter.fit()
        self.growth.fit()

    # Measuring.

    def _prepare(self) -> PartWork:
        """Return what measures the family that is shown on the chosen work."""
        choice, family = self.choice, self.choice.family
        assert family is not None
        scene, settings, title = None, family.base, ""
        extra: tuple[Candidate, ...] = ()
        if family.takes_scene:
            document, plan = self._session.document, self._session.plan
            scene, settings, title = document.scene, document.settings, document.title or "scene"
            if plan is not None:
                extra = plan_candidates(plan.plan, settings, family.candidates(settings))
        methods = [each.method for each in (*family.candidates(settings), *extra)]
        self._numbers = {method: number for number, method in enumerate(methods)}
        work, dials, seed = choice.work_kind, choice.dial_values, choice.seed
        self._partial = None
        self._unmeasured = Study(
            choice.name, family.title, work, dials, seed, family.measures, (), settings=settings, scene=title
        )
        run = partial(
            measure,
            choice.name,
            work.name,
            dials,
            scene=scene,
            settings=None if scene is None else settings,
            scene_title=title,
            extra=extra,
            rounds=choice.rounds,
            grow=choice.grow,
            seed=seed,
            machine=machine(__version__),
        )
        return partial(measured, run, scene)

    def measure_scene(self) -> None:
        """Measure the whole pipeline on the open scene; beside a plan with an error that does not mind samples."""
        self.show_named(PIPELINE.name)
        if self._session.plan is not None and self._session.document.settings.polygon_mode == "fill":
            self.choice.measure = SAMPLED_COLOR.name
        self.start()

    def _keep_part(self, part: Point) -> None:
        """Add a point to what has been measured so far, or replace it."""
        study = self._partial or self._unmeasured
        assert study is not None
        points = {each.method: each for each in study.points} | {part.method: part}
        in_order = sorted(points.values(), key=lambda each: self._numbers[each.method])
        self._partial = replace(study, points=tuple(in_order))

    # The points that are opened.

    @Slot(str, bool)
    def choose(self, method: str, is_added: bool = False) -> None:
        """Open the pictures of a point; ``is_added``: beside the one that is open."""
        result, point = self.choice.result, self.point(method)
        if self.is_partial or result is None or point is None:
            self.tell("Pictures are available when the measurement is finished.")
            return
        first = self.chosen[:1] if is_added and method not in self.chosen[:1] else ()
        self._show_chosen((*first, method))
        self.pictures.show()
        study = result.content
        if point.refused:
            self.opened.say(f"{point.title} drew nothing: {point.refused}")
        elif study.scene and result.scene is None:
            self.opened.say(
                f"This study was saved without its scene, {study.scene}. Open that scene and measure it."
            )
        else:
            points = tuple(found for each in self.chosen if (found := self.point(each)) is not None)
            names = " and ".join(title_of(each, [other.method for other in study.points]) for each in points)
            self.opened.open(f"Drawing {names} …", partial(drawn_points, result, points))

    @Slot(str)
    def _choose_row(self, method: str) -> None:
        self.choose(method)

    def _show_chosen(self, methods: tuple[str, ...]) -> None:
        """Mark points as A and B; the figures of the last stay in the readout while no other is pointed at."""
        self.chosen = methods
        for chart in self._linked:
            chart.show_marks(dict(zip(methods, LETTERS, strict=False)))
        self._show_readout()

    def _show_opened(self) -> None:
        """Choose no point; the pane keeps its place, so that no mark moves when one is chosen."""
        self._show_chosen(())
        self.opened.say(HINT)

    def close_opened(self) -> bool:
        """Choose no point; return whether there was one."""
        was_open = bool(self.chosen)
        self._show_opened()
        return was_open

    @Slot()
    def _hide_pictures(self) -> None:
        """Choose no point and leave the room to the charts, until a point is chosen again."""
        self._show_opened()
        self.pictures.hide()

    # Files.

    def main_view(self) -> QWidget:
        """Return what is copied: the charts."""
        return self.charts

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {
            "compare columns": self.columns,
            "compare left": self.left,
            "compare charts": self.charts,
            "compare rows": self.panes,
        }

    @Slot()
    def copy(self) -> None:
        """Put the charts on the clipboard as a picture, or the numbers as text."""
        if self.tabs.currentIndex():
            self.table.copy()
            self.tell("Copied the numbers.")
        else:
            super().copy()
