"""The Stability page's experiments: which one is shown, its maps as they are run, and the figures of a cell."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Signal, Slot
from PySide6.QtWidgets import QWidget

from app.background.background_task import ListedWork, WorkWords
from app.background.paced_drawing import PacedDrawing
from app.export.atlas_text import WORDS
from app.pages.compare.words import machine_words
from app.pages.stability.choices import AtlasResult, ExperimentChoice, choices_of_all, entry_of
from app.pages.stability.jobs import CellRun, StabilityJobs, StressOrder
from app.pages.stability.records import (
    atlas_record,
    blank_cells,
    cell_text,
    cells_of,
    counts_sentence,
    experiment_text,
    method_titles,
    place_on_curve,
    place_sentence,
    values_at,
)
from app.pages.stability.severity_curves import has_curves, severity_chart
from app.session.session import Session
from core.records.arrays import Floats
from core.study.stability import Atlas, ExperimentInfo, Outcome, Verdict
from core.study.stability.open_scene import NAME as OPEN_SCENE
from core.study.stability.open_scene import watertightness
from core.study.stability.stress import axes_at
from widgets.atlas.records import UNKNOWN, CellPlace
from widgets.atlas.stability_controls import StabilityControls
from widgets.atlas.view import AtlasView
from widgets.basics.message_bar import Progress
from widgets.basics.readout import Readout
from widgets.charts.chart import Chart
from widgets.charts.family_list import FamilyList
from widgets.charts.legend import ChartLegend
from widgets.charts.records import ChartEmpty, ChartPicture

NOTHING = (
    "One map for each method, one cell for each place: what came of a real run there. Press Run (F5); "
    "cells appear as they are run."
)
WORK_WORDS = WorkWords(
    "Running was cancelled",
    "It could not be run",
    "the maps of before are as they were",
    "is still being run",
)


class StabilityPresenter(ListedWork[ExperimentChoice]):
    """Keeps the choices and atlases of all experiments and shows those of one."""

    result_taken = Signal(object)
    """An `AtlasResult` that has just been run."""

    def __init__(
        self,
        session: Session,
        desk: StabilityJobs,
        experiments: FamilyList,
        controls: StabilityControls,
        maps: AtlasView,
        curves: tuple[Chart, ChartLegend],
        readout: Readout,
        page: QWidget,
    ) -> None:
        choices = choices_of_all() | {OPEN_SCENE: open_scene_choice(session)}
        super().__init__(desk.running, controls, WORK_WORDS, choices, page)
        self._session, self._desk, self._pace = session, desk, PacedDrawing(page)
        self._list, self._controls, self._maps, self._readout = experiments, controls, maps, readout
        self._curves, self._legend = curves
        self._running_info: ExperimentInfo | None = None
        self._cells: dict[str, NDArray[np.int16]] = {}
        """Of the run that is going on."""
        self._verdicts: dict[CellPlace, Verdict] = {}
        self._hover: CellPlace | None = None
        experiments.family_chosen.connect(self.show_experiment)
        controls.resolution_chosen.connect(self._choose_resolution)
        controls.seed_chosen.connect(self._choose_seed)
        controls.running_requested.connect(self.run)
        controls.cancel_requested.connect(self.cancel)
        maps.cell_hovered.connect(self._point_at)
        maps.cell_left.connect(self._point_away)
        self._curves.point_hovered.connect(self._point_at_curve)
        self._legend.series_hovered.connect(self._curves.show_pointed)
        for pane in curves:
            pane.series_left.connect(self._point_away)
        session.document_changed.connect(self._take_document)
        self._pace.due.connect(self._show_cells)
        self.refresh()

    @Slot()
    def _take_document(self) -> None:
        """Make the experiment on the open scene one on the scene that is open now, unless it has been run."""
        if self._choices[OPEN_SCENE].result is None and self._running != OPEN_SCENE:
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

    @Slot(str)
    def show_experiment(self, name: str) -> None:
        """Show another experiment."""
        self._show_named(name)

    def _point_nowhere(self) -> None:
        """Forget the cell that is pointed at."""
        self._hover = None

    def refresh(self) -> None:
        """Show the experiment, its controls and its maps."""
        choice = self.choice
        self._list.show_families([entry_of(each) for each in self._choices.values()], self._current)
        self._controls.show_sentences(choice.info.question, f"Claim: {choice.info.claim}")
        can_run = choice.experiment is not None or choice.name == OPEN_SCENE
        self._controls.show_choices(choice.resolutions, choice.resolution, choice.seed, can_run)
        self._show_maps()

    def _show_maps(self) -> None:
        self._pace.settle()
        cells = self.cells
        if cells:
            self._maps.show_atlas(atlas_record(self.info, cells))
        else:
            self._maps.show_empty(NOTHING)
        self._maps.show_chosen(self.choice.chosen)
        self._show_curves()
        self._show_readout()
        self.shown_text_changed.emit(self._shown_text())

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

    def _severities(self) -> dict[str, Floats]:
        """Return by method the severities (N,) along the first axis, NaN where nothing has been run."""
        if self.result is not None and not self.is_partial:
            return {each.method: each.severity[0] for each in self.result.atlas.maps}
        found = {key: np.full(cells.shape[1], np.nan) for key, cells in self.cells.items()}
        for place, verdict in self._verdicts.items() if self.is_partial else ():
            found[place.key][place.column] = verdict.severity
        return found

    def _shown_text(self) -> str:
        result = self.result
        if self.is_partial:
            return "Being run; cells appear row by row."
        if result is None:
            return ""
        parts = [counts_sentence(result), f"Seed {result.atlas.seed}."]
        if result.is_kept:
            parts.append("Kept from an earlier start.")
        if self.choice.experiment is not None and not self.choice.is_set_as(result.atlas):
            parts.append("The controls are set otherwise by now: run to see that.")
        if result.atlas.machine:
            parts.append(f"{machine_words(result.atlas.machine)}.")
        return " ".join(parts)

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
        self._maps.canvas.setAccessibleDescription(f"{title}, {where}: {outcome}")

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
        self.shown_text_changed.emit(self._shown_text())

    @Slot(int)
    def _choose_seed(self, seed: int) -> None:
        self.choice.seed = seed
        self.shown_text_changed.emit(self._shown_text())

    # Running.

    @Slot()
    def run(self) -> None:
        """Run the experiment that is shown on the chosen grid."""
        choice = self.choice
        if choice.name == OPEN_SCENE and self._running != OPEN_SCENE:
            made = open_scene_choice(self._session)
            choice.info, choice.experiment = made.info, made.experiment
        experiment = choice.experiment
        if experiment is None:
            self.refused.emit(
                "This version has no such experiment: a saved atlas can be looked at, not run again."
            )
            return
        if not self._is_free():
            return
        axes = axes_at(choice.info.axes, choice.resolution)
        self._running, self._running_info = choice.name, replace(choice.info, axes=axes)
        self._cells, self._verdicts = blank_cells(self._running_info), {}
        choice.chosen = self._hover = None
        self._tell_progress(Progress("Preparing", 0, 0))
        self._show_maps()
        self.shown_changed.emit()
        self._desk.run(StressOrder(experiment, axes, choice.seed))

    def _come_to_nothing(self) -> None:
        """Choose no cell any more: the maps of before are shown again."""
        self.choice.chosen = self._hover = None
        self._maps.show_chosen(None)
        self._show_readout()
        self.shown_changed.emit()

    @Slot(object)
    def _take_part(self, cells: tuple[CellRun, ...]) -> None:
        for each in cells:
            place = each.place
            self._cells[place.key][place.row, place.column] = int(each.verdict.outcome)
            self._verdicts[place] = each.verdict
        if self.is_partial:
            self._pace.ask()

    @Slot()
    def _show_cells(self) -> None:
        """Show the cells that have been run by now."""
        self._maps.show_atlas(atlas_record(self.info, self.cells))
        self._show_curves()

    @Slot(object)
    def _take_result(self, result: AtlasResult) -> None:
        choice = self._choices[result.atlas.experiment.name]
        choice.result = result
        self.refresh()
        self.shown_changed.emit()
        self.message_sent.emit(f"Ran {choice.info.title.lower()}: {counts_sentence(result)}")
        self.result_taken.emit(result)

    def _put_back(self) -> None:
        """Show the maps of before."""
        self._running, self._running_info = "", None
        self._cells, self._verdicts = {}, {}
        self.refresh()

    # Saved atlases.

    def take_saved(self, atlas: Atlas, path: str) -> None:
        """Show an atlas that was opened from a file, as the result of its experiment."""
        self._take(AtlasResult(atlas, path=path))
        self._turn_to(atlas.experiment.name)

    @Slot(object)
    def take_kept(self, atlas: Atlas) -> None:
        """Show an atlas of an earlier start as the result of its experiment, unless there is another by now."""
        name = atlas.experiment.name
        if name in self._choices and self._choices[name].result is None and self._running != name:
            self._take(AtlasResult(atlas, is_kept=True))
            self.refresh()

    def _take(self, result: AtlasResult) -> None:
        info = result.atlas.experiment
        choice = self._choices.setdefault(info.name, ExperimentChoice(info, None))
        choice.result, choice.seed, choice.chosen = result, result.atlas.seed, None
        if info.name == OPEN_SCENE:  # A file does not hold its scene, and another one may be open now.
            choice.info, choice.experiment = info, None


def open_scene_choice(session: Session) -> ExperimentChoice:
    """Return the experiment on the scene that is open now."""
    document = session.document
    experiment = watertightness(document.scene, document.title)
    return ExperimentChoice(experiment.info, experiment)
