"""The page “What does this scene need?”: tolerance, choices with reasons and numbers, and the difference they make."""

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from app.pages.page_bar import Handlers, Page
from app.pages.plan.jobs import PlanJobs
from app.pages.plan.pictures_presenter import PlanPicturesPresenter
from app.pages.plan.presenter import PlanPresenter
from app.session.session import Session
from widgets.charts.study_pictures import StudyPictures
from widgets.plan.controls import PlanControls
from widgets.plan.rows import PlanRows
from widgets.plan.summary import PlanFindings, PlanSummary


class PlanPage(Page):
    """All panes of the Plan page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.desk = PlanJobs(self)
        self.controls, self.summary, self.rows = PlanControls(self), PlanSummary(self), PlanRows(self)
        self.findings, self.pictures = PlanFindings(self), StudyPictures(self)
        self.plans = PlanPresenter(
            session, self.desk, self.controls, (self.summary, self.findings), self.rows, self
        )
        self.opened = PlanPicturesPresenter(self.plans, self.desk, self.pictures, self)
        self._lay_out()
        self.setFocusProxy(self.controls.look_button)
        self.rows.picture_requested.connect(self.opened.open)
        self.summary.picture_requested.connect(self.opened.open_all)
        self.controls.chart_requested.connect(self.show_on_chart)
        for presenter in (self.plans, self.opened):
            presenter.message_sent.connect(self.message_sent)
            presenter.refused.connect(self.edit_refused)
        self.opened.step_requested.connect(self.step_requested)
        self.plans.progressed.connect(self.work_progressed)

    def _lay_out(self) -> None:
        above = QWidget(self)
        column = QVBoxLayout(above)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        for widget in (self.controls, self.summary):
            column.addWidget(widget)
        column.addWidget(self.rows, 1)
        self.panes = QSplitter(Qt.Orientation.Vertical, self)
        self.panes.addWidget(above)
        self.panes.addWidget(self.pictures)
        self.panes.setStretchFactor(0, 3)
        self.panes.setStretchFactor(1, 2)
        self.panes.setSizes([440, 280])
        self.columns = QSplitter(Qt.Orientation.Horizontal, self)
        self.columns.addWidget(self.findings)
        self.columns.addWidget(self.panes)
        self.columns.setStretchFactor(1, 1)
        self.columns.setSizes([264, 1000])
        self.findings.setMinimumWidth(160)
        page = QVBoxLayout(self)
        page.setContentsMargins(8, 4, 8, 8)
        page.addWidget(self.columns, 1)

    # As a page of the window.

    def handlers(self) -> Handlers:
        """Return what the keys of this page do."""
        return {
            "look": self.plans.look,
            "cancel_look": self.plans.cancel,
            "apply_plan": self.plans.apply,
            "plan_difference": self.opened.open_all,
            "plan_chart": self.show_on_chart,
            "plan_findings": self.findings.toggle_findings,
        }

    def dismiss(self) -> bool:
        """Stop looking, or else close the pictures."""
        if self.desk.is_looking:
            self.plans.cancel()
            return True
        is_open = self.opened.is_open
        self.opened.close()
        return is_open

    def main_view(self) -> QWidget:
        """Return what is exported and copied: the choices with what they come to."""
        return self.panes

    def stop(self) -> None:
        """End looking and drawing."""
        self.desk.shut_down()

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {"plan columns": self.columns, "plan panes": self.panes}

    @Slot()
    def show_on_chart(self) -> None:
        """Measure the choice among all others of the scene, on the Compare page."""
        if self.plans.shown is None or self.plans.shown.report is None or self.plans.is_stale:
            self.message_sent.emit("There is no choice for this scene yet: look first (F5).")
            return
        self.action_requested.emit("page_compare")
        self.action_requested.emit("measure_scene")
