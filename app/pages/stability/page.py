"""The page of the atlas: experiments, one map for each method, and the case behind a cell."""

from functools import partial
from operator import attrgetter
from pathlib import Path

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QSplitter, QWidget

from app.background import PartWork
from app.export.failures import save_shrunk, shrunk_name
from app.files.state_files import EXTENSION as STATE_EXTENSION
from app.pages.experiment_page import splitter
from app.pages.result_page import Result, ResultKind, ResultPage
from app.pages.stability.atlas_files import EXTENSION, atlas_content, atlas_stem, load_atlas
from app.pages.stability.case_presenter import CasePresenter
from app.pages.stability.jobs import CaseOrder, ExperimentChoice, RowRun, choice_of, choices_of_all, run_grid
from app.pages.stability.records import (
    atlas_record,
    blank_atlas,
    cell_text,
    counts_sentence,
    experiment_text,
    first_failure,
    has_curves,
    method_titles,
    place_on_curve,
    place_sentence,
    severity_chart,
    spoken_cell,
    values_at,
    with_row,
)
from app.session.moment import Change
from app.session.session import Session
from core.study.cases import Atlas, ExperimentInfo
from core.study.fragment_cases import NAME as OPEN_SCENE
from core.study.fragment_cases import watertightness
from widgets.basics.accessibility import announce
from widgets.basics.controls import row_layout
from widgets.experiments.case_pictures import CaseView
from widgets.experiments.chart import Chart
from widgets.experiments.controls import StabilityControls
from widgets.experiments.map_view import AtlasView
from widgets.experiments.maps import CellPlace
from widgets.experiments.series import ChartLegend, ChartPicture

KIND: ResultKind[Atlas, ExperimentChoice] = ResultKind(
    page="Stability",
    cancelled="Running was cancelled",
    failed="It could not be run",
    kept="the previous maps are unchanged",
    running="is still being run",
    unknown="This version has no such experiment. A saved atlas can be viewed, but not run again.",
    again="run again (F5)",
    noun="atlas",
    view="maps",
    nothing="run the experiment first (F5)",
    endings="Maps with claim and machine (*.png);;Drawing (*.svg);;Table of all cells (*.csv);;"
    f"Atlas, to be opened again (*{EXTENSION});;Current view (*.pdf)",
    export_tip="Write the maps, all cells or the whole atlas to a file (Ctrl+E)",
    copy_tip="Put the maps on the clipboard",
    load=load_atlas,
    content=lambda atlas, _, ending: atlas_content(atlas, ending),
    stem=atlas_stem,
    name_of=attrgetter("experiment.name"),
    saved_choice=lambda atlas: choice_of(atlas.experiment, None),
    sentences=lambda atlas: [counts_sentence(atlas), f"Seed {atlas.seed}."],
    so_far=lambda _: "Running; cells appear row by row.",
    done=lambda title, atlas: f"Ran {title.lower()}: {counts_sentence(atlas)}",
)
CASE_KINDS = f"Scene, to be opened again (*{STATE_EXTENSION});;Python test (*.py)"
NOTHING = (
    "One map for each method appears here. Run (F5) takes a few seconds to a minute; cells appear row by row."
)


class StabilityPage(ResultPage[Atlas, ExperimentChoice]):
    """Runs experiments; shows each as maps, and the case behind one of their cells."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        choices = choices_of_all() | {OPEN_SCENE: open_scene_choice(session)}
        super().__init__(KIND, choices, next(iter(choices)), parent)
        self._session = session
        self.entries.setAccessibleName("Experiments")
        self.controls: StabilityControls = StabilityControls(self)
        self.maps, self.case = AtlasView(self), CaseView(self)
        self.curves = Chart("Severity along the axis", self), ChartLegend(self)
        self._chart, self._legend = self.curves
        self.opened = CasePresenter(self.case, self)
        self.refresh()
        curves = splitter(Qt.Orientation.Horizontal, ((self._chart, 1, 800), (self._legend, 0, 150)), self)
        self.seen = splitter(Qt.Orientation.Vertical, ((self.maps, 1, 200), (curves, 1, 200)), self)
        self.seen.setAccessibleName("Maps")
        above = ((self.seen, 1), (self._foot(), 0))
        self.lay_out(self.list_column((360, 300)), above, self.case)
        self.setFocusProxy(self.maps)
        self.maps.cell_hovered.connect(self._point_at)
        self.maps.cell_left.connect(self._point_away)
        self.maps.cell_chosen.connect(self.choose)
        self.maps.cell_opened.connect(self._open_cell)
        self._chart.point_hovered.connect(self._point_at_curve)
        self._chart.point_chosen.connect(self._choose_on_curve)
        self._legend.series_hovered.connect(self._chart.show_pointed)
        self._legend.series_chosen.connect(self.choose_failure)
        for pane in self.curves:
            pane.series_left.connect(self._point_away)
        self.case.closing_requested.connect(self.close_opened)
        self.case.save_requested.connect(self.ask_save_case)
        session.changed.connect(self._follow)

    def _foot(self) -> QWidget:
        foot = QWidget(self)
        row = row_layout(foot, 8)
        row.addWidget(self.shown_text, 1)
        row.addWidget(self.reference_button)
        row.addWidget(self.export_button)
        row.addWidget(self.copy_button)
        return foot

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        """Make the experiment on the open scene one on the scene that is open now, unless it has been run."""
        is_unused = self._choices[OPEN_SCENE].result is None
        if Change.DOCUMENT in what and is_unused and self._running != OPEN_SCENE:
            self._choices[OPEN_SCENE] = open_scene_choice(self._session)
            if self._current == OPEN_SCENE:
                self.refresh()

    # What is shown.

    @property
    def info(self) -> ExperimentInfo:
        """The experiment with the axes of the maps that are shown."""
        return self.choice.info if self.content is None else self.content.experiment

    def _show_controls(self) -> None:
        choice = self.choice
        self.controls.show_sentences(choice.info.question, f"Claim: {choice.info.claim}")
        self.controls.show_choices(choice.resolutions, choice.resolution, choice.seed, choice.can_run)

    def _show_result(self) -> None:
        self._show_parts()
        self.maps.show_chosen(self.choice.chosen)
        self._show_readout()

    @Slot()
    def _show_parts(self) -> None:
        """Show the cells that have been run so far; the figures of the cell that is pointed at wait."""
        if self.content is None:
            self.maps.show_empty(NOTHING)
        else:
            self.maps.show_atlas(atlas_record(self.content))
        has = has_curves(self.info)
        self._chart.setVisible(has)
        self._legend.setVisible(has)
        if has:
            picture = severity_chart(self.info.axes[0], () if self.content is None else self.content.maps)
            self._chart.show_picture(picture)
            self._legend.show_series(picture.series if isinstance(picture, ChartPicture) else ())
            self._legend.setVisible(isinstance(picture, ChartPicture))

    # The cell that is pointed at.

    @Slot(object)
    def _point_at(self, place: CellPlace | None) -> None:
        self._pointed = place
        self._show_readout()

    @Slot(str, int)
    def _point_at_curve(self, method: str, index: int) -> None:
        self._point_at(place_on_curve(self.info, method, index))

    @Slot()
    def _point_away(self) -> None:
        self._point_at(None)

    def _show_readout(self) -> None:
        place = self._pointed or self.choice.chosen
        key, column = ("", -1) if place is None else (place.key, place.column)
        self._chart.show_pointed(key, column)
        self._legend.show_pointed(key)
        if self.content is None or place is None or not self._is_shown(place):
            self.readout.show_text(experiment_text(self.choice))
            self.maps.canvas.setAccessibleDescription("")
            return
        self.readout.show_text(cell_text(self.content, place))
        spoken = spoken_cell(self.content, place)
        self.maps.canvas.setAccessibleDescription(spoken)
        announce(self.maps.canvas, spoken)

    def _is_shown(self, place: CellPlace) -> bool:
        """Return whether the maps that are shown have such a cell."""
        shapes = (
            [each.outcome.shape for each in self.content.maps if each.method == place.key]
            if self.content
            else []
        )
        return any(place.row < rows and place.column < columns for rows, columns in shapes)

    # Running.

    def _prepare(self) -> PartWork:
        """Return what runs the experiment that is shown on the chosen grid."""
        choice = self.choice
        if choice.name == OPEN_SCENE:
            made = open_scene_choice(self._session)
            choice.info, choice.experiment = made.info, made.experiment
        assert choice.experiment is not None
        self._partial, choice.chosen = blank_atlas(choice.info, choice.axes, choice.seed), None
        return partial(run_grid, choice.experiment, choice.axes, choice.seed)

    def _come_to_nothing(self) -> None:
        """Choose no cell any more: the previous maps are shown again."""
        self._pointed = None
        self.close_opened()

    def _keep_part(self, part: RowRun) -> None:
        assert self._partial is not None
        self._partial = with_row(self._partial, part)

    @Slot(object)
    def _take_result(self, result: Result[Atlas]) -> None:
        super()._take_result(result)
        self._show_opened()

    # The cell that is opened.

    def _order(self, place: CellPlace) -> CaseOrder | None:
        """Return a cell to be run once more; ``None``: this version has no such experiment."""
        experiment = self.choice.experiment
        seed = self.choice.seed if self.content is None else self.content.seed
        return None if experiment is None else CaseOrder(experiment, place, values_at(self.info, place), seed)

    @Slot(object)
    def choose(self, place: CellPlace) -> None:
        """Run the cell once more and show it."""
        self._show_chosen(place)
        info, order = self.info, self._order(place)
        title = method_titles((*info.methods, place.key))[place.key]
        heading = f"{title} at {place_sentence(info, values_at(info, place))}"
        if order is None:
            self.opened.say(heading, _no_experiment(info.name))
        elif place.key not in order.experiment.info.methods:
            self.opened.say(heading, "This version has no such method: the case cannot be run.")
        else:
            self.opened.look(heading, order)

    @Slot(str, int)
    def _choose_on_curve(self, method: str, index: int) -> None:
        self.choose(place_on_curve(self.info, method, index))

    @Slot(str, bool)
    def choose_failure(self, method: str) -> None:
        """Show the first cell, row by row, at which a method fails."""
        place = None if self.content is None else first_failure(self.content, method)
        if place is None:
            self.tell(f"No cell of {method} fails here.")
        else:
            self.choose(place)

    @Slot(object)
    def _open_cell(self, place: CellPlace) -> None:
        """Open a cell in the stepper, as soon as it has been run."""
        if self.choice.chosen != place:
            self.choose(place)
        self.opened.step_when_found()

    def _show_chosen(self, place: CellPlace | None) -> None:
        self.choice.chosen = place
        self.maps.show_chosen(place)
        self._show_readout()

    def _show_opened(self) -> None:
        """Show the case of the cell that was chosen of this experiment before, unless it is shown already."""
        chosen, found = self.choice.chosen, self.opened.found
        if chosen is None or not self._is_shown(chosen):
            self.close_opened()
        elif found is None or found.order != self._order(chosen):
            self.choose(chosen)

    @Slot()
    def close_opened(self) -> bool:
        """Close the case and choose no cell; return whether there was one."""
        was_open = self.choice.chosen is not None
        self.opened.close()
        self._show_chosen(None)
        return was_open

    # Files.

    def main_view(self) -> QWidget:
        """Return what is copied: the maps, and the curves where there are some."""
        return self.seen

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {
            "stability columns": self.columns,
            "stability left": self.left,
            "stability rows": self.panes,
            "stability maps": self.seen,
        }

    @Slot()
    def ask_save_case(self) -> None:
        """Ask where the small case is to go, and write it there."""
        found = self.opened.found
        if found is None or found.shrunk is None:
            self.tell("Shrink a failing cell first (S). Only the smallest case can be saved.")
            return
        stem = shrunk_name(found.order.experiment.info.name, found.order.place.key)
        self.ask_path("Save case", f"{stem}{STATE_EXTENSION}", CASE_KINDS, self.save_case_to)

    def save_case_to(self, path: str) -> None:
        """Write the small case as a scene or as a Python test, by the ending of the file."""
        found = self.opened.found
        assert found is not None
        assert found.shrunk is not None
        shrunk, title = found.shrunk, f"{found.order.experiment.info.name}: {found.order.place.key}"
        self.tell_written(path, lambda: save_shrunk(Path(path), shrunk, title), "saved", "case")


def open_scene_choice(session: Session) -> ExperimentChoice:
    """Return the experiment on the scene that is open now."""
    experiment = watertightness(session.document.scene, session.document.title)
    return choice_of(experiment.info, experiment)


def _no_experiment(name: str) -> str:
    """Return why a cell of a saved atlas cannot be run."""
    if name == OPEN_SCENE:
        return "An atlas is saved without its scene. Open that scene and run the experiment to see its cases."
    return "This version has no such experiment: the case cannot be run."
