"""The page that charts speed against accuracy: families, work, two charts, their numbers, pictures of points."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QHBoxLayout, QSplitter, QTabWidget, QVBoxLayout, QWidget

from app.export.study import study_content
from app.files.kept_results import KeptResults
from app.files.study_files import EXTENSION, load_study, study_json
from app.pages.compare.jobs import StudyJobs, StudyResult
from app.pages.compare.pictures_presenter import StudyPicturesPresenter
from app.pages.compare.presenter import StudyPresenter
from app.pages.file_page import FilePage, FileWords
from app.pages.page_bar import Handlers
from app.pages.side_columns import SideColumns
from app.session.session import Session
from core.study.accuracy.record import Study
from widgets.basics.elided_label import ElidedLabel
from widgets.basics.readout import Readout
from widgets.charts.chart import Chart
from widgets.charts.family_list import FamilyList
from widgets.charts.legend import ChartLegend
from widgets.charts.study_controls import StudyControls
from widgets.charts.study_pictures import StudyPictures
from widgets.charts.study_table import StudyTable

FILE_WORDS = FileWords(
    noun="study",
    view="charts",
    nothing="measure first (F5)",
    kinds="Chart with its figures (*.png);;Drawing (*.svg);;Table of the numbers (*.csv);;"
    f"Study, to be opened again (*{EXTENSION});;Page as it is seen (*.pdf)",
    export_tip="Write the charts, the numbers or the whole study to a file (Ctrl+E)",
    copy_tip="Put the charts, or the numbers with all their digits, on the clipboard",
)


class ComparePage(FilePage):
    """All panes of the Compare page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(FILE_WORDS, KeptResults("study", load_study), parent)
        self.desk = StudyJobs(self)
        self.families, self.readout = FamilyList(self), Readout("Figures", self)
        self.controls = StudyControls(self)
        self.scatter, self.growth = Chart("Error against cost", self), Chart("Cost against size", self)
        self.legend, self.table, self.pictures = ChartLegend(self), StudyTable(self), StudyPictures(self)
        self.shown_text = ElidedLabel(self)
        charts = (self.scatter, self.growth)
        self.studies = StudyPresenter(
            session,
            self.desk,
            self.families,
            self.controls,
            charts,
            self.legend,
            self.table,
            self.readout,
            self,
        )
        self.opened = StudyPicturesPresenter(
            self.studies, self.desk, (*charts, self.legend), self.table, self.pictures, self
        )
        self.kept.found.connect(self.studies.take_kept)
        self.studies.result_taken.connect(self._keep)
        self.studies.progressed.connect(self.work_progressed)
        self._lay_out()
        self.setFocusProxy(self.scatter)
        self.studies.shown_text_changed.connect(self.shown_text.setText)
        for presenter in (self.studies, self.opened):
            presenter.message_sent.connect(self.message_sent)
            presenter.refused.connect(self.edit_refused)
        self.opened.step_requested.connect(self.step_requested)

    # Layout.

    def _lay_out(self) -> None:
        self.columns = SideColumns(self.families, self.readout, self._main(), (300, 360), self)
        page = QVBoxLayout(self)
        page.setContentsMargins(8, 4, 8, 8)
        page.setSpacing(8)
        page.addWidget(self.columns, 1)

    def _main(self) -> QWidget:
        self.charts = QSplitter(Qt.Orientation.Horizontal, self)
        for pane, stretch in ((self.scatter, 3), (self.legend, 1), (self.growth, 2)):
            self.charts.addWidget(pane)
            self.charts.setStretchFactor(self.charts.count() - 1, stretch)
        self.charts.setSizes([560, 170, 340])
        self.shown_text.setProperty("role", "muted")
        self.shown_text.setAccessibleName("What the charts show")
        self.tabs = QTabWidget(self)
        self.tabs.setDocumentMode(True)
        self.tabs.tabBar().setDrawBase(False)
        self.tabs.addTab(self.charts, "Charts")
        self.tabs.addTab(self.table, "Numbers")
        self.tabs.setCornerWidget(self._buttons())
        top = QWidget(self)
        layout = QVBoxLayout(top)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.controls)
        layout.addWidget(self.tabs, 1)
        layout.addWidget(self.shown_text)
        self.rows = QSplitter(Qt.Orientation.Vertical, self)
        self.rows.addWidget(top)
        self.rows.addWidget(self.pictures)
        self.rows.setStretchFactor(0, 3)
        self.rows.setStretchFactor(1, 2)
        self.rows.setSizes([440, 280])
        return self.rows

    def _buttons(self) -> QWidget:
        corner = QWidget(self)
        row = QHBoxLayout(corner)
        row.setContentsMargins(0, 0, 0, 4)
        row.setSpacing(8)
        for button in (self.export_button, self.copy_button):
            row.addWidget(button)
        return corner

    # As a page of the window.

    def handlers(self) -> Handlers:
        """Return what the keys of this page do."""
        return {
            "measure": self.studies.measure,
            "measure_scene": self.studies.measure_scene,
            "cancel_measuring": self.studies.cancel,
            "next_family": lambda: self.studies.show_neighbour(1),
            "previous_family": lambda: self.studies.show_neighbour(-1),
            "next_error": self.studies.show_next_measure,
            "next_cost": self.studies.show_next_cost,
            "show_numbers": self.toggle_numbers,
            "fit_charts": self.fit_charts,
            "step_run": self.opened.step,
            "step_divergence": self.opened.step_to_divergence,
            "copy_pictures": self.opened.copy,
            "export_view": self.ask_export,
            "copy_view": self.copy,
        }

    def dismiss(self) -> bool:
        """Stop measuring, or else choose no mark any more."""
        if self.desk.is_measuring:
            self.studies.cancel()
            return True
        is_open = bool(self.opened.chosen)
        self.opened.clear()
        return is_open

    def main_view(self) -> QWidget:
        """Return what is copied: the charts."""
        return self.charts

    def stop(self) -> None:
        """End measuring and drawing, and let what is being written be written."""
        self.desk.shut_down()
        super().stop()

    @Slot(object)
    def _keep(self, result: StudyResult) -> None:
        self.kept.keep(result.study.family, partial(study_json, result.study))

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {
            "compare columns": self.columns,
            "compare left": self.columns.left,
            "compare charts": self.charts,
            "compare rows": self.rows,
        }

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

    # Files.

    def show_file(self, path: str) -> None:
        """Show a saved study."""
        self.studies.take_saved(load_study(path), Path(path).name)

    def file_stem(self) -> str:
        """Return the name of a file of the study that is shown."""
        study = self._finished()
        return "" if study is None else f"study-{study.family}-{study.work.name}"

    def file_content(self, ending: str) -> bytes | None:
        """Return the study in a file; the charts have the chosen axes."""
        study, choice = self._finished(), self.studies.choice
        assert study is not None
        return study_content(study, choice.measure, ending, choice.cost)

    def _finished(self) -> Study | None:
        result = self.studies.result
        return None if result is None or self.studies.is_partial else result.study

    @Slot()
    def copy(self) -> None:
        """Put the charts on the clipboard as a picture, or the numbers as text."""
        if self.tabs.currentIndex():
            self.table.copy()
            self.message_sent.emit("Copied the numbers.")
        else:
            super().copy()
