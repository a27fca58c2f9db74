"""The page “What does this scene need?”: tolerance, choices with reasons and numbers, and the difference they make."""

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QSplitter, QWidget

from app.pages.plan.jobs import PlanJobs
from app.pages.plan.pictures_presenter import PlanPicturesPresenter
from app.pages.plan.presenter import PlanPresenter
from app.pages.result_page import WorkPage
from app.session.session import Session
from widgets.charts.study_pictures import StudyPictures
from widgets.plan.controls import PlanControls
from widgets.plan.rows import PlanRows
from widgets.plan.summary import PlanFindings, PlanSummary


class PlanPage(WorkPage):
    """All panes of the Plan page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.jobs = PlanJobs(self)
        self.controls, self.summary, self.rows = PlanControls(self), PlanSummary(self), PlanRows(self)
        self.findings, self.pictures = PlanFindings(self), StudyPictures(self)
        self.plans = PlanPresenter(
            session, self.jobs, self.controls, (self.summary, self.findings), self.rows, self
        )
        self.opened = PlanPicturesPresenter(self.plans, self.jobs, self.pictures, self)
        self.join(self.jobs, self.plans, self.opened)
        above = ((self.summary, 0), (self.rows, 1))
        self.lay_out(self.findings, self.controls, above, self.pictures, spacing=8)
        self.setFocusProxy(self.controls.start_button)
        self.rows.picture_requested.connect(self.opened.open)
        self.summary.picture_requested.connect(self.opened.open_all)
        self.controls.chart_requested.connect(self.show_on_chart)

    # As a page of the window.

    def main_view(self) -> QWidget:
        """Return what is exported and copied: the choices with what they come to."""
        return self.panes

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {"plan columns": self.columns, "plan panes": self.panes}

    @Slot()
    def show_on_chart(self) -> None:
        """Measure the choice among all others of the scene, on the Compare page."""
        if self.plans.shown is None or self.plans.shown.report is None or self.plans.is_stale:
            self.tell("There is no plan for this scene yet. Run the analysis first (F5).")
            return
        self.action_requested.emit("page_compare")
        self.action_requested.emit("measure_scene")
