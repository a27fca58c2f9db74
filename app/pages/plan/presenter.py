"""The Plan page's analysis: what was asked, chosen and measured, and whether it is still for this scene."""

from dataclasses import dataclass, replace

from PySide6.QtCore import Slot

from app.pages.background_task import BackgroundTask, WorkWords
from app.pages.page_bar import Page
from app.pages.plan.jobs import PlanJobs, PlanOrder
from app.pages.plan.words import (
    EMPTY,
    about,
    advice_html,
    applied_text,
    details,
    findings_html,
    headline,
    rows_of,
)
from app.session.moment import Change
from app.session.session import Session
from core.settings import Settings
from core.study import Plan, PlanReport, Tolerance, reference_settings
from widgets.basics.message_bar import Progress
from widgets.plan.controls import PlanControls
from widgets.plan.rows import PlanRows
from widgets.plan.summary import PlanFindings, PlanSummary, SummaryRecord


@dataclass(frozen=True, eq=False)
class PlanShown:
    """What is shown: a plan, and once it is measured its report."""

    order: PlanOrder
    plan: Plan
    report: PlanReport | None = None


WORDS = WorkWords(
    "The analysis was cancelled", "The scene could not be analysed", "the previous plan is unchanged"
)


class PlanPresenter(BackgroundTask):
    """Analyses the open scene and shows what it needs; marks results of an earlier scene."""

    def __init__(
        self,
        session: Session,
        jobs: PlanJobs,
        controls: PlanControls,
        summaries: tuple[PlanSummary, PlanFindings],
        rows: PlanRows,
        page: Page,
    ) -> None:
        super().__init__(jobs.analysing, controls, WORDS, page)
        self._session, self._jobs = session, jobs
        self._controls, self._summaries, self._rows = controls, summaries, rows
        self._order: PlanOrder | None = None
        """What is being analysed."""
        self._asked: PlanOrder | None = None
        """What was analysed last."""
        self._before: PlanShown | None = None
        """What comes back if that comes to nothing."""
        self.shown: PlanShown | None = None
        self._replaced: Settings | None = None
        """What the scene was drawn with before the plan that is shown was applied; ``None``: it was not."""
        controls.start_requested.connect(self.analyse)
        controls.cancel_requested.connect(self.cancel)
        controls.applying_requested.connect(self.apply)
        summaries[0].undo_requested.connect(self.take_back)
        session.changed.connect(self._follow)
        self.refresh()

    @property
    def is_stale(self) -> bool:
        """Whether what is shown is of an earlier scene, or of something else to be seen in it."""
        if self.shown is None:
            return False
        document = self._session.document
        if self.shown.order.scene is not document.scene:
            return True
        is_applied = document.settings == self.shown.plan.settings
        return (
            not is_applied
            and reference_settings(document.scene, document.settings) != self.shown.plan.everything
        )

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.DOCUMENT in what:
            self.refresh()

    # Analysing.

    @Slot()
    def analyse(self) -> None:
        """Plan for the open scene, and measure the plan."""
        document, controls = self._session.document, self._controls
        exact = Tolerance.exact()
        tolerance = (
            exact if controls.is_exact else Tolerance(controls.color_box.value(), controls.pixels_box.value())
        )
        order = PlanOrder(
            document.scene,
            document.settings,
            tolerance,
            controls.rounds_box.value(),
            document.title or "scene",
        )
        self._jobs.analysing.cancel()
        self._order, self._before = order, self.shown
        controls.show_progress(Progress("Analysing the scene", 0, 0))
        self._jobs.analyse(order)

    @Slot(object)
    def _take_part(self, plan: Plan) -> None:
        assert self._order is not None
        self._show(PlanShown(self._order, plan))

    @Slot(object)
    def _take_result(self, report: PlanReport) -> None:
        assert self._asked is not None
        self._show(PlanShown(self._asked, report.plan, report))
        self._session.set_plan(report)
        self._page.tell(f"Analysed {self._asked.title}.")

    def _put_back(self) -> None:
        """Show what was found before."""
        self._asked, self._order = self._order, None
        if self._asked is not None:
            self._show(self._before)

    # Showing.

    def _show(self, shown: PlanShown | None) -> None:
        self.shown, self._replaced = shown, None
        self.refresh()
        self.shown_changed.emit()

    @Slot()
    def refresh(self) -> None:
        """Show the plan, and whether it is of the scene that is open."""
        shown = self.shown
        for summary in self._summaries:
            summary.show_record(None if shown is None else self._record(shown))
        if shown is None:
            self._rows.show_rows((), EMPTY)
            self._controls.show_usable(False, False)
            return
        self._rows.show_rows(rows_of(shown.plan, shown.report))
        is_usable = shown.report is not None and not self.is_stale
        self._controls.show_usable(is_usable, is_usable)

    def _record(self, shown: PlanShown) -> SummaryRecord:
        plan, report, order = shown.plan, shown.report, shown.order
        stale = ""
        if self.is_stale:
            stale = (
                f"This plan is for an earlier scene, {order.title}. Run the analysis again (F5)."
                if order.scene is not self._session.document.scene
                else "The settings have changed since. Run the analysis again (F5)."
            )
        facts = plan.findings.facts
        settings = self._session.document.settings
        is_applied = self._replaced is not None and settings == plan.settings
        return SummaryRecord(
            applied=applied_text(self._replaced, settings) if is_applied and self._replaced else "",
            headline=headline(plan, report),
            details="" if report is None else details(plan, report),
            is_within=None if report is None else report.is_within,
            about=about(order.title, order.scene.size, order.tolerance),
            stale=stale,
            findings=findings_html(plan.findings),
            findings_note=f"({len(facts)})",
            advice=advice_html(plan.tessellations, plan.findings.corner_count),
            can_draw=report is not None,
        )

    # Applying.

    @Slot()
    def apply(self) -> None:
        """Take the chosen settings over, in one step that undo takes back."""
        shown = self.shown
        if shown is None or shown.report is None:
            self._page.tell("There is nothing to apply yet. Run the analysis first (F5).")
            return
        if self.is_stale:
            self._page.refuse("The scene has changed. Run the analysis again (F5).")
            return
        document = self._session.latest
        if document.settings == shown.plan.settings:
            self._page.tell("The scene has these settings already.")
            return
        try:
            self._session.edit(replace(document, settings=shown.plan.settings))
        except (ValueError, MemoryError) as error:
            self._page.refuse(f"The plan cannot be stepped: {error} The settings are unchanged.")
        else:
            self._replaced = document.settings
            self.refresh()
            # What has changed stands in the summary: the hint must fit beside the names of the pages.
            self._page.tell("Applied the plan. Ctrl+Z restores the old settings.")

    @Slot()
    def take_back(self) -> None:
        """Draw the scene again with what it had before the plan was applied."""
        before, self._replaced = self._replaced, None
        if before is not None:
            self._session.edit(replace(self._session.latest, settings=before))
            self._page.tell("The settings from before the plan are back.")
            self.refresh()
