"""The page of the atlas: experiments, one map for each method, and the case behind a cell."""

from pathlib import Path

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QSplitter, QWidget

from app.export.atlas import atlas_content
from app.files.atlas_files import EXTENSION, load_atlas
from app.files.shrunk_files import save_shrunk, shrunk_name
from app.files.state_files import EXTENSION as STATE_EXTENSION
from app.pages.result_page import FileWords, ResultPage, splitter
from app.pages.stability.case_presenter import StabilityCasePresenter
from app.pages.stability.choices import AtlasResult
from app.pages.stability.jobs import StabilityJobs
from app.pages.stability.presenter import StabilityPresenter
from app.session.session import Session
from widgets.atlas.case_view import CaseView
from widgets.atlas.stability_controls import StabilityControls
from widgets.atlas.view import AtlasView
from widgets.basics.controls import row_layout
from widgets.charts.chart import Chart
from widgets.charts.legend import ChartLegend

FILE_WORDS = FileWords(
    noun="atlas",
    view="maps",
    nothing="run the experiment first (F5)",
    kinds="Maps with claim and machine (*.png);;Drawing (*.svg);;Table of all cells (*.csv);;"
    f"Atlas, to be opened again (*{EXTENSION});;Current view (*.pdf)",
    export_tip="Write the maps, all cells or the whole atlas to a file (Ctrl+E)",
    copy_tip="Put the maps on the clipboard",
)
CASE_KINDS = f"Scene, to be opened again (*{STATE_EXTENSION});;Python test (*.py)"


class StabilityPage(ResultPage):
    """All panes of the Stability page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(FILE_WORDS, load_atlas, parent)
        self.jobs = StabilityJobs(self)
        self.entries.setAccessibleName("Experiments")
        self.controls, self.maps, self.case = StabilityControls(self), AtlasView(self), CaseView(self)
        self.curves = Chart("Severity along the axis", self), ChartLegend(self)
        self.results: StabilityPresenter = StabilityPresenter(
            session, self.jobs, self.entries, self.controls, self.maps, self.curves, self.readout, self
        )
        self.opened = StabilityCasePresenter(self.results, self.jobs, self.maps, self.curves, self.case, self)
        self.join_results(self.jobs, self.results, self.opened)
        curves = splitter(
            Qt.Orientation.Horizontal, ((self.curves[0], 1, 800), (self.curves[1], 0, 150)), self
        )
        self.seen = splitter(Qt.Orientation.Vertical, ((self.maps, 1, 200), (curves, 1, 200)), self)
        self.seen.setAccessibleName("Maps")
        above = ((self.seen, 1), (self._foot(), 0))
        self.lay_out(self.list_column((360, 300)), self.controls, above, self.case)
        self.setFocusProxy(self.maps)
        self.case.save_requested.connect(self.ask_save_case)

    def _foot(self) -> QWidget:
        foot = QWidget(self)
        row = row_layout(foot, 8)
        row.addWidget(self.shown_text, 1)
        row.addWidget(self.reference_button)
        row.addWidget(self.export_button)
        row.addWidget(self.copy_button)
        return foot

    # As a page of the window.

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

    # Files.

    def stem_of(self, result: AtlasResult) -> str:
        """Return the name of a file of an atlas."""
        return f"stress-{result.name}"

    def content_of(self, result: AtlasResult, ending: str) -> bytes | None:
        """Return an atlas as the content of a file."""
        return atlas_content(result.atlas, ending)

    @Slot()
    def ask_save_case(self) -> None:
        """Ask where the small case is to go, and write it there."""
        found = self.opened.shrunk
        if found is None:
            self.tell("Shrink a failing cell first (S). Only the smallest case can be saved.")
            return
        stem = shrunk_name(found.order.experiment.info.name, found.order.place.key)
        self.ask_path("Save case", f"{stem}{STATE_EXTENSION}", CASE_KINDS, self.save_case_to)

    def save_case_to(self, path: str) -> None:
        """Write the small case as a scene or as a Python test, by the ending of the file."""
        found = self.opened.shrunk
        assert found is not None
        title = f"{found.order.experiment.info.name}: {found.order.place.key}"
        self.tell_written(path, lambda: save_shrunk(Path(path), found.shrunk, title), "saved", "case")
