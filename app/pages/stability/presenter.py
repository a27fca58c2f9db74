"""The Stability page's experiments: which one is shown, its maps as they are run, and the figures of a cell."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Slot

from app.export.atlas_text import WORDS
from app.pages.page_bar import Page
from app.pages.result_presenter import ResultPresenter, ResultWords
from app.pages.stability.choices import AtlasResult, ExperimentChoice, choices_of_all
from app.pages.stability.jobs import CellRun, StabilityJobs, StressOrder
from app.pages.stability.records import (
    atlas_record,
    blank_cells,
    cell_text,
    cells_of,
    counts_sentence,
    experiment_text,
    has_curves,
    method_titles,
    place_on_curve,
    place_sentence,
    severity_chart,
    values_at,
)
from app.session.moment import Change
from app.session.session import Session
from core.explain.number_text import number_text
from core.records.arrays import Floats
from core.study.stability import Atlas, ExperimentInfo, Outcome, Verdict
from core.study.stability.open_scene import NAME as OPEN_SCENE
from core.study.stability.open_scene import watertightness
from core.study.stability.stress import axes_at
from widgets.atlas.records import UNKNOWN, CellPlace
from widgets.atlas.stability_controls import StabilityControls
from widgets.atlas.view import AtlasView
from widgets.basics.accessible import announce
from widgets.basics.labels import Readout
from widgets.charts.chart import Chart
from widgets.charts.family_list import FamilyList
from widgets.charts.legend import ChartLegend
from widgets.charts.records import ChartEmpty, ChartPicture

NOTHING = (
    "One map for each method appears here. Run (F5) takes a few seconds to a minute; cells appear row by row."
)
WORK_WORDS = ResultWords(
    cancelled="Running was cancelled",
    failed="It could not be run",
    kept="the previous maps are unchanged",
    running="is still being run",
    unknown="This version has no such experiment. A saved atlas can be viewed, but not run again.",
    again="run again (F5)",
)


class StabilityPresenter(ResultPresenter[ExperimentChoice]):
    """Keeps the choices and atlases of all experiments and shows those of one."""

    def __init__(
        self,
        session: Session,
        jobs: StabilityJobs,
        experiments: FamilyList,
        controls: StabilityControls,
        maps: AtlasView,
        curves: tuple[Chart, ChartLegend],
        readout: Readout,
        page: Page,
    ) -> None:
        choices = choices_of_all() | {OPEN_SCENE: open_scene_choice(session)}
        super().__init__(jobs.running, WORK_WORDS, choices, experiments, controls, readout, page)
        self._session, self._jobs, self._controls, self._maps = session, jobs, controls, maps
        self._curves, self._legend = curves
        self._running_info: ExperimentInfo | None = None
        self._cells: dict[str, NDArray[np.int16]] = {}
        """Of the run that is going on."""
        self._verdicts: dict[CellPlace, Verdict] = {}
        self._hover: CellPlace | None = None
        controls.resolution_chosen.connect(self._choose_resolution)
        maps.cell_hovered.connect(self._point_at)
        maps.cell_left.connect(self._point_away)
        self._curves.point_hovered.connect(self._point_at_curve)
        self._legend.series_hovered.connect(self._curves.show_pointed)
        for pane in curves:
            pane.series_left.connect(self._point_away)
        session.changed.connect(self._take_document)
        self.refresh()

    @Slot(Change)
    def _take_document(self, what: Change) -> None:
        """Make the experiment on the open scene one on the scene that is open now, unless it has been run."""
        is_unused = self._choices[OPEN_SCENE].result is None
        if Change.DOCUMENT in what and is_unused and self._running != OPEN_SCENE:
            self._choices[OPEN_SCENE] = open_scene_choice(self._session)
            if self._current == OPEN_SCENE:
                self.refresh()

    # What is shown.

    @property
    def result(self) -> AtlasResult | None:
        """What has been run of it, or opened."""
        return self.choice.result

    @property
    def info(self) -> ExperimentInfo:
        """The experiment with the axes of the maps that are shown."""
        if self.is_partial and self._running_info is not None:
            return self._running_info
        return self.choice.info if self.result is None else self.result.atlas.experiment

    @property
    def cells(self) -> Mapping[str, NDArray[np.int16]]:
        """Kinds of the cells that are shown; empty: there are no maps."""
        if self.is_partial:
            return self._cells
        return {} if self.result is None else cells_of(self.result.atlas.maps)

    def seed(self) -> int:
        """Return the seed of the maps that are shown."""
        return self.choice.seed if self.result is None or self.is_partial else self.result.atlas.seed

    def _point_nowhere(self) -> None:
        """Forget the cell that is pointed at."""
        self._hover = None

    def _show_controls(self) -> None:
        choice = self.choice
        self._controls.show_sentences(choice.info.question, f"Claim: {choice.info.claim}")
        self._controls.show_choices(choice.resolutions, choice.resolution, choice.seed, choice.can_run)

    def _show_result(self) -> None:
        cells = self.cells
        if cells:
            self._maps.show_atlas(atlas_record(self.info, cells))
        else:
            self._maps.show_empty(NOTHING)
        self._maps.show_chosen(self.choice.chosen)
        self._show_curves()
        self._show_readout()

    def _show_curves(self) -> None:
        """Draw severity against the axis, where there is one axis alone."""
        info = self.info
        for pane in (self._curves, self._legend):
            pane.setVisible(has_curves(info))
        if not has_curves(info):
            return
        picture = severity_chart(info.axes[0], self._severities(), method_titles(info.methods))
        if isinstance(picture, ChartEmpty):
            self._curves.show_empty(picture)
        else:
            self._curves.show_picture(picture)
        self._legend.show_series(picture.series if isinstance(picture, ChartPicture) else ())
        self._legend.setVisible(isinstance(picture, ChartPicture))

    def _severities(self) -> dict[str, Floats]:
        """Return by method the severities (N,) along the first axis, NaN where nothing has been run."""
        if self.result is not None and not self.is_partial:
            return {each.method: each.severity[0] for each in self.result.atlas.maps}
        found = {key: np.full(cells.shape[1], np.nan) for key, cells in self.cells.items()}
        for place, verdict in self._verdicts.items() if self.is_partial else ():
            found[place.key][place.column] = verdict.severity
        return found

    def _partial_text(self) -> str:
        return "Running; cells appear row by row."

    def _result_texts(self) -> list[str]:
        assert self.result is not None
        return [counts_sentence(self.result), f"Seed {self.result.atlas.seed}."]

    # The cell that is pointed at.

    @Slot(object)
    def _point_at(self, place: CellPlace) -> None:
        self._hover = place
        self._show_readout()

    @Slot(str, int)
    def _point_at_curve(self, method: str, index: int) -> None:
        self._point_at(place_on_curve(self.info, method, index))

    @Slot()
    def _point_away(self) -> None:
        self._hover = None
        self._show_readout()

    def _show_readout(self) -> None:
        place = self._hover or self.choice.chosen
        key, column = ("", -1) if place is None else (place.key, place.column)
        self._curves.show_pointed(key, column)
        self._legend.show_pointed(key)
        if place is None or not self.is_shown(place):
            self._readout.show_text(experiment_text(self.choice))
            self._maps.canvas.setAccessibleDescription("")
            return
        severity, remark = self._figures(place)
        kind = int(self.cells[place.key][place.row, place.column])
        title = method_titles(self.info.methods)[place.key]
        text = cell_text(self.info, place, kind, severity, remark, title)
        self._readout.show_text(text)
        outcome = "not run yet" if kind == UNKNOWN else WORDS[Outcome(kind)]
        where = place_sentence(self.info, values_at(self.info, place))
        spoken = f"{title}, {where}: {outcome}"
        if severity:
            spoken += f", severity {number_text(severity, 3)}"
        self._maps.canvas.setAccessibleDescription(spoken)
        announce(self._maps.canvas, spoken)

    def is_shown(self, place: CellPlace) -> bool:
        """Return whether the maps that are shown have such a cell."""
        cells = self.cells.get(place.key)
        return cells is not None and place.row < cells.shape[0] and place.column < cells.shape[1]

    def _figures(self, place: CellPlace) -> tuple[float, str]:
        """Return severity and remark of a cell, as far as they are known."""
        if self.is_partial:
            verdict = self._verdicts.get(place)
            return (0.0, "") if verdict is None else (verdict.severity, verdict.remark)
        result = self.result
        assert result is not None
        each = next(each for each in result.atlas.maps if each.method == place.key)
        return float(each.severity[place.row, place.column]), each.remark(place.column, place.row)

    def choose(self, place: CellPlace | None) -> None:
        """Keep a cell as the chosen one of this experiment."""
        self.choice.chosen = place
        self._maps.show_chosen(place)
        self._show_readout()

    # Choosing.

    @Slot(str)
    def _choose_resolution(self, name: str) -> None:
        self.choice.resolution = name
        self.tell_shown()

    # Running.

    def _prepare(self) -> Callable[[], None]:
        """Return what runs the experiment that is shown on the chosen grid."""
        choice = self.choice
        if choice.name == OPEN_SCENE:
            made = open_scene_choice(self._session)
            choice.info, choice.experiment = made.info, made.experiment
        assert choice.experiment is not None
        axes = axes_at(choice.info.axes, choice.resolution)
        self._running_info = replace(choice.info, axes=axes)
        self._cells, self._verdicts = blank_cells(self._running_info), {}
        choice.chosen = None
        return partial(self._jobs.run, StressOrder(choice.experiment, axes, choice.seed))

    def _come_to_nothing(self) -> None:
        """Choose no cell any more: the previous maps are shown again."""
        self.choice.chosen = self._hover = None
        self._maps.show_chosen(None)
        self._show_readout()
        self.shown_changed.emit()

    def _keep_part(self, part: tuple[CellRun, ...]) -> None:
        for each in part:
            place = each.place
            self._cells[place.key][place.row, place.column] = int(each.verdict.outcome)
            self._verdicts[place] = each.verdict

    @Slot()
    def _show_parts(self) -> None:
        """Show the cells that have been run so far; the figures of the cell that is pointed at wait."""
        self._maps.show_atlas(atlas_record(self.info, self.cells))
        self._show_curves()

    @Slot(object)
    def _take_result(self, result: AtlasResult) -> None:
        super()._take_result(result)
        self.shown_changed.emit()

    def _done_text(self, result: AtlasResult) -> str:
        return f"Ran {self._choices[result.name].title.lower()}: {counts_sentence(result)}"

    # Saved atlases.

    def _result_of(self, content: Atlas, path: str = "", is_kept: bool = False) -> AtlasResult:
        return AtlasResult(content, path, is_kept)

    def _unknown_choice(self, result: AtlasResult) -> ExperimentChoice:
        return ExperimentChoice(result.atlas.experiment, None)


def open_scene_choice(session: Session) -> ExperimentChoice:
    """Return the experiment on the scene that is open now."""
    document = session.document
    experiment = watertightness(document.scene, document.title)
    return ExperimentChoice(experiment.info, experiment)
