"""The page that charts speed against accuracy: families, work, two charts, their numbers, pictures of points."""

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QSplitter, QTabWidget, QWidget

from app.export.study import study_content
from app.files.study_files import EXTENSION, load_study
from app.pages.compare.jobs import StudyJobs, StudyResult
from app.pages.compare.pictures_presenter import StudyPicturesPresenter
from app.pages.compare.presenter import StudyPresenter
from app.pages.result_page import FileWords, ResultPage, splitter
from app.session.session import Session
from widgets.basics.controls import row_layout
from widgets.charts.chart import Chart
from widgets.charts.legend import ChartLegend
from widgets.charts.study_controls import StudyControls
from widgets.charts.study_pictures import StudyPictures
from widgets.charts.study_table import StudyTable

FILE_WORDS = FileWords(
    noun="study",
    view="charts",
    nothing="measure first (F5)",
    kinds="Chart with its figures (*.png);;Drawing (*.svg);;Table of the numbers (*.csv);;"
    f"Study, to be opened again (*{EXTENSION});;Current view (*.pdf)",
    export_tip="Write the charts, the numbers or the whole study to a file (Ctrl+E)",
    copy_tip="Put the charts, or the numbers with all their digits, on the clipboard",
)


class ComparePage(ResultPage):
    """All panes of the Compare page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(FILE_WORDS, load_study, parent)
        self.jobs, self.controls = StudyJobs(self), StudyControls(self)
        self.scatter, self.growth = Chart("Error against cost", self), Chart("Cost against size", self)
        self.legend, self.table, self.pictures = ChartLegend(self), StudyTable(self), StudyPictures(self)
        charts = (self.scatter, self.growth)
        self.results: StudyPresenter = StudyPresenter(
            session,
            self.jobs,
            self.entries,
            self.controls,
            charts,
            self.legend,
            self.table,
            self.readout,
            self,
        )
        self.opened = StudyPicturesPresenter(
            self.results, self.jobs, (*charts, self.legend), self.table, self.pictures, self
        )
        self.join_results(self.jobs, self.results, self.opened)
        above = ((self._tabs(), 1), (self.shown_text, 0))
        self.lay_out(self.list_column((300, 360)), self.controls, above, self.pictures)
        self.setFocusProxy(self.scatter)

    def _tabs(self) -> QWidget:
        panes = ((self.scatter, 3, 540), (self.legend, 1, 230), (self.growth, 2, 300))
        self.charts = splitter(Qt.Orientation.Horizontal, panes, self)
        self.tabs = QTabWidget(self)
        self.tabs.setDocumentMode(True)
        self.tabs.tabBar().setDrawBase(False)
        self.tabs.addTab(self.charts, "Charts")
        self.tabs.addTab(self.table, "Numbers")
        corner = QWidget(self)
        row = row_layout(corner, 8, margins=(0, 0, 0, 4))
        for button in (self.reference_button, self.export_button, self.copy_button):
            row.addWidget(button)
        self.tabs.setCornerWidget(corner)
        return self.tabs

    # As a page of the window.

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

    def stem_of(self, result: StudyResult) -> str:
        """Return the name of a file of a study."""
        return f"study-{result.study.family}-{result.study.work.name}"

    def content_of(self, result: StudyResult, ending: str) -> bytes | None:
        """Return a study as the content of a file; the charts have the chosen axes."""
        choice = self.results.choice
        return study_content(result.study, choice.measure, ending, choice.cost)

    @Slot()
    def copy(self) -> None:
        """Put the charts on the clipboard as a picture, or the numbers as text."""
        if self.tabs.currentIndex():
            self.table.copy()
            self.tell("Copied the numbers.")
        else:
            super().copy()
