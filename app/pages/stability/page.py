"""The page of the atlas: experiments, one map for each method, and the case behind a cell."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QHBoxLayout, QSplitter, QVBoxLayout, QWidget

from app.export.atlas import atlas_content, atlas_json
from app.files.atlas_files import EXTENSION, load_atlas
from app.files.kept_results import KeptResults
from app.files.shrunk_files import save_shrunk, shrunk_name
from app.files.state_files import EXTENSION as STATE_EXTENSION
from app.pages.file_page import FilePage, FileWords
from app.pages.page_bar import Handlers
from app.pages.side_columns import SideColumns
from app.pages.stability.case_presenter import StabilityCasePresenter
from app.pages.stability.choices import AtlasResult
from app.pages.stability.jobs import StabilityJobs
from app.pages.stability.presenter import StabilityPresenter
from app.session.session import Session
from core.study.stability import Atlas
from widgets.atlas.case_view import CaseView
from widgets.atlas.stability_controls import StabilityControls
from widgets.atlas.view import AtlasView
from widgets.basics.elided_label import ElidedLabel
from widgets.basics.readout import Readout
from widgets.charts.chart import Chart
from widgets.charts.family_list import FamilyList
from widgets.charts.legend import ChartLegend

FILE_WORDS = FileWords(
    noun="atlas",
    view="maps",
    nothing="run the experiment first (F5)",
    kinds="Maps with claim and machine (*.png);;Drawing (*.svg);;Table of all cells (*.csv);;"
    f"Atlas, to be opened again (*{EXTENSION});;Page as it is seen (*.pdf)",
    export_tip="Write the maps, all cells or the whole atlas to a file (Ctrl+E)",
    copy_tip="Put the maps on the clipboard",
)
CASE_KINDS = f"Scene, to be opened again (*{STATE_EXTENSION});;Python test (*.py)"


class StabilityPage(FilePage):
    """All panes of the Stability page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(FILE_WORDS, KeptResults("atlas", load_atlas), parent)
        self.desk = StabilityJobs(self)
        self.experiments, self.readout = FamilyList(self), Readout("Figures", self)
        self.experiments.setAccessibleName("Experiments")
        self.controls, self.maps, self.case = StabilityControls(self), AtlasView(self), CaseView(self)
        self.curves = Chart("Severity along the axis", self), ChartLegend(self)
        self.shown_text = ElidedLabel(self)
        self.runs = StabilityPresenter(
            session, self.desk, self.experiments, self.controls, self.maps, self.curves, self.readout, self
        )
        self.opened = StabilityCasePresenter(self.runs, self.desk, self.maps, self.curves, self.case, self)
        self.kept.found.connect(self.runs.take_kept)
        self.runs.result_taken.connect(self._keep)
        self.runs.progressed.connect(self.work_progressed)
        self._lay_out()
        self.setFocusProxy(self.maps)
        self.runs.shown_text_changed.connect(self.shown_text.setText)
        for presenter in (self.runs, self.opened):
            presenter.message_sent.connect(self.message_sent)
            presenter.refused.connect(self.edit_refused)
        self.opened.step_requested.connect(self.step_requested)
        self.case.save_requested.connect(self.ask_save_case)

    # Layout.

    def _lay_out(self) -> None:
        self.columns = SideColumns(self.experiments, self.readout, self._main(), (360, 300), self)
        page = QVBoxLayout(self)
        page.setContentsMargins(8, 4, 8, 8)
        page.addWidget(self.columns, 1)

    def _main(self) -> QWidget:
        self.shown_text.setProperty("role", "muted")
        self.shown_text.setAccessibleName("What the maps show")
        top = QWidget(self)
        layout = QVBoxLayout(top)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.controls)
        layout.addWidget(self._seen(), 1)
        layout.addLayout(self._foot())
        self.rows = QSplitter(Qt.Orientation.Vertical, self)
        self.rows.addWidget(top)
        self.rows.addWidget(self.case)
        self.rows.setStretchFactor(0, 3)
        self.rows.setStretchFactor(1, 2)
        self.rows.setSizes([440, 240])
        return self.rows

    def _seen(self) -> QWidget:
        """Return the maps and the curves below them."""
        self.seen = QSplitter(Qt.Orientation.Vertical, self)
        curves = QSplitter(Qt.Orientation.Horizontal, self)
        panes: tuple[QWidget, QWidget] = self.curves
        for pane, stretch in zip(panes, (1, 0), strict=True):
            curves.addWidget(pane)
            curves.setStretchFactor(curves.count() - 1, stretch)
        curves.setSizes([800, 150])
        for pane in (self.maps, curves):
            self.seen.addWidget(pane)
            self.seen.setStretchFactor(self.seen.count() - 1, 1)
        self.seen.setSizes([200, 200])
        self.seen.setAccessibleName("Maps")
        return self.seen

    def _foot(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(self.shown_text, 1)
        row.addWidget(self.export_button)
        row.addWidget(self.copy_button)
        return row

    # As a page of the window.

    def handlers(self) -> Handlers:
        """Return what the keys of this page do."""
        return {
            "run_experiment": self.runs.run,
            "cancel_experiment": self.runs.cancel,
            "next_experiment": lambda: self.runs.show_neighbour(1),
            "previous_experiment": lambda: self.runs.show_neighbour(-1),
            "step_cell": self.opened.step,
            "shrink_cell": self.opened.shrink,
            "save_case": self.ask_save_case,
            "export_view": self.ask_export,
            "copy_view": self.copy,
        }

    def dismiss(self) -> bool:
        """Stop running, or else close the case."""
        if self.desk.is_running:
            self.runs.cancel()
            return True
        is_open = self.runs.choice.chosen is not None
        self.opened.close()
        return is_open

    def main_view(self) -> QWidget:
        """Return what is copied: the maps, and the curves where there are some."""
        return self.seen

    def stop(self) -> None:
        """End all runs, and let what is being written be written."""
        self.desk.shut_down()
        super().stop()

    @Slot(object)
    def _keep(self, result: AtlasResult) -> None:
        self.kept.keep(result.atlas.experiment.name, partial(atlas_json, result.atlas))

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {
            "stability columns": self.columns,
            "stability left": self.columns.left,
            "stability rows": self.rows,
            "stability maps": self.seen,
        }

    # Files.

    def show_file(self, path: str) -> None:
        """Show a saved atlas."""
        self.runs.take_saved(load_atlas(path), Path(path).name)

    def file_stem(self) -> str:
        """Return the name of a file of the atlas that is shown."""
        atlas = self._finished()
        return "" if atlas is None else f"stress-{atlas.experiment.name}"

    def file_content(self, ending: str) -> bytes | None:
        """Return the atlas in a file."""
        atlas = self._finished()
        assert atlas is not None
        return atlas_content(atlas, ending)

    def _finished(self) -> Atlas | None:
        result = self.runs.result
        return None if result is None or self.runs.is_partial else result.atlas

    @Slot()
    def ask_save_case(self) -> None:
        """Ask where the small case is to go, and write it there."""
        found = self.opened.shrunk
        if found is None:
            self.message_sent.emit("Shrink a failing cell first (S): the smallest case is worth a file.")
            return
        stem = shrunk_name(found.order.experiment.info.name, found.order.place.key)
        self.ask_path("Save case", f"{stem}{STATE_EXTENSION}", CASE_KINDS, self.save_case_to)

    def save_case_to(self, path: str) -> None:
        """Write the small case as a scene or as a Python test, by the ending of the file."""
        found = self.opened.shrunk
        assert found is not None
        title = f"{found.order.experiment.info.name}: {found.order.place.key}"
        self.tell_written(path, lambda: save_shrunk(Path(path), found.shrunk, title), "saved", "case")
