"""The page “What does this scene need?”: tolerance, choices with reasons and numbers, and what they differ in."""

from dataclasses import replace
from functools import partial

from PySide6.QtCore import QTimer, Slot
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QSplitter, QWidget

from app.pages.experiment_page import ExperimentPage, OpenedPictures, WorkWords
from app.pages.plan.plans import EMPTY, PlanShown, applied_text, drawn_choice, planned, rows_of, summary_of
from app.session.moment import Change
from app.session.session import Session
from core.settings import Settings
from core.study.planner.records import Tolerance
from core.study.planner.reference_settings import reference_settings
from widgets.experiments.case_pictures import StudyPictures
from widgets.experiments.plan import PlanControls, PlanFindings, PlanRows, PlanSummary

WORDS = WorkWords(
    "Plan", "The analysis was cancelled", "The scene could not be analysed", "the previous plan is unchanged"
)


class PlanPage(ExperimentPage):
    """Analyses the open scene and shows what it needs; marks results of an earlier scene."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(WORDS, parent)
        self._session = session
        self.controls: PlanControls = PlanControls(self)
        self.summary, self.rows = PlanSummary(self), PlanRows(self)
        self.findings, self.pictures = PlanFindings(self), StudyPictures(self)
        self.opened = OpenedPictures(self.pictures, self)
        self.shown: PlanShown | None = None
        self._finished: PlanShown | None = None
        """What comes back if an analysis comes to nothing."""
        self._replaced: Settings | None = None
        """What the scene was drawn with before the plan that is shown was applied; ``None``: it was not."""
        self.pictures.hide()
        self.refresh()
        self.lay_out(self.findings, ((self.summary, 0), (self.rows, 1)), self.pictures, spacing=8)
        self.setFocusProxy(self.controls.start_button)
        self.pictures.closing_requested.connect(self.close_opened)
        self.rows.picture_requested.connect(self.open)
        self.summary.picture_requested.connect(self.open)
        self.summary.undo_requested.connect(self.take_back)
        self.controls.applying_requested.connect(self.apply)
        self.controls.chart_requested.connect(self.show_on_chart)
        session.changed.connect(self._follow)

    @property
    def is_stale(self) -> bool:
        """Whether what is shown is of an earlier scene, or of something else to be seen in it."""
        return bool(self._stale_text())

    def _stale_text(self) -> str:
        shown, document = self.shown, self._session.document
        if shown is None:
            return ""
        if shown.scene is not document.scene:
            return f"This plan is for an earlier scene, {shown.title}. Run the analysis again (F5)."
        seen = shown.plan.settings, shown.plan.everything
        if document.settings == seen[0] or reference_settings(document.scene, document.settings) == seen[1]:
            return ""
        return "The settings have changed since. Run the analysis again (F5)."

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.DOCUMENT in what:
            self.refresh()
            self._look()

    def showEvent(self, event: QShowEvent) -> None:
        """Look at a scene of which nothing is known yet, once the page has the keyboard."""
        super().showEvent(event)
        QTimer.singleShot(0, self, self._look)

    def hideEvent(self, event: QHideEvent) -> None:
        """Look no longer: only an analysis that was asked for goes on."""
        super().hideEvent(event)
        if self.controls.keeps_start:
            self.work.cancel()

    # Analysing.

    @Slot()
    def _look(self) -> None:
        """Plan without measuring, unless something was or is being measured, or the scene is asked about."""
        is_known = self.shown is not None and (self.shown.report is not None or not self.is_stale)
        is_measuring = self.is_running and not self.controls.keeps_start
        is_free = self.isVisible() and not is_measuring and not self._session.is_asked_about
        if is_free and not is_known and self._session.document.scene.corner_count:
            self._begin(0)

    @Slot()
    def start(self) -> None:
        """Plan for the open scene, and measure the plan."""
        self._begin(self.controls.rounds_box.value())

    def _begin(self, rounds: int) -> None:
        document, controls = self._session.document, self.controls
        color, pixels = controls.color_box.value(), controls.pixels_box.value()
        tolerance = Tolerance.exact() if controls.is_exact else Tolerance(color, pixels)
        title = document.title or "scene"
        self.work.cancel()
        self.controls.keeps_start = not rounds
        self.begin(
            partial(planned, document.scene, title, document.settings, tolerance, rounds),
            "Analysing the scene",
        )

    @Slot(object)
    def _take_part(self, part: PlanShown) -> None:
        self._show(part)

    @Slot(object)
    def _take_result(self, result: PlanShown) -> None:
        self._finished = result
        self._show(result)
        if result.report is not None:
            self._session.set_plan(result.report)
            self.tell(f"Analysed {result.title}.")

    def _put_back(self) -> None:
        """Show what was found before."""
        self._show(self._finished)

    # Showing.

    def _show(self, shown: PlanShown | None) -> None:
        self.shown, self._replaced = shown, None
        self.refresh()
        self.close_opened()

    @Slot()
    def refresh(self) -> None:
        """Show the plan, and whether it is of the scene that is open."""
        shown, settings = self.shown, self._session.document.settings
        record = None
        if shown is not None:
            is_applied = self._replaced is not None and settings == shown.plan.settings
            applied = applied_text(self._replaced, settings) if is_applied and self._replaced else ""
            record = summary_of(shown, applied, self._stale_text())
        self.summary.show_record(record)
        self.findings.show_record(record)
        self.rows.show_rows(() if shown is None else rows_of(shown.plan, shown.report), EMPTY)
        self.controls.show_usable(shown is not None and shown.report is not None and not self.is_stale)

    # The pictures of a choice.

    @Slot()
    @Slot(str)
    def open(self, setting: str = "") -> None:
        """Draw the choice at one stage alone, or all that was chosen, beside the reference settings."""
        shown = self.shown
        if shown is None or shown.report is None:
            self.tell("There is no difference to show yet. Run the analysis first (F5).")
            return
        doing = "Drawing the choice and the reference settings …"
        self.opened.open(doing, partial(drawn_choice, shown.scene, shown.plan, setting))

    @Slot()
    def close_opened(self) -> bool:
        """Close the pictures; return whether there were some, or were about to be."""
        was_open = not self.pictures.isHidden()
        self.opened.close()
        return was_open

    # Applying.

    @Slot()
    def apply(self) -> None:
        """Take the chosen settings over, in one step that undo takes back."""
        shown = self.shown
        if shown is None or shown.report is None:
            self.tell("There is nothing to apply yet. Run the analysis first (F5).")
            return
        if self.is_stale:
            self.refuse("The scene has changed. Run the analysis again (F5).")
            return
        document = self._session.latest
        if document.settings == shown.plan.settings:
            self.tell("The scene has these settings already.")
            return
        try:
            self._session.edit(replace(document, settings=shown.plan.settings))
        except (ValueError, MemoryError) as error:
            self.refuse(f"The plan cannot be stepped: {error} The settings are unchanged.")
        else:
            self._replaced = document.settings
            self.refresh()
            # What has changed stands in the summary: the hint must fit beside the names of the pages.
            self.tell("Applied the plan. Ctrl+Z restores the old settings.")

    @Slot()
    def take_back(self) -> None:
        """Draw the scene again with what it had before the plan was applied."""
        before, self._replaced = self._replaced, None
        if before is not None:
            self._session.edit(replace(self._session.latest, settings=before))
            self.tell("The settings from before the plan are back.")
            self.refresh()

    @Slot()
    def show_on_chart(self) -> None:
        """Measure the choice among all others of the scene, on the Compare page."""
        if self.shown is None or self.shown.report is None or self.is_stale:
            self.tell("There is no plan for this scene yet. Run the analysis first (F5).")
            return
        self.action_requested.emit("page_compare")
        self.action_requested.emit("measure_scene")

    # As a page of the window.

    def main_view(self) -> QWidget:
        """Return what is exported and copied: the choices with what they come to."""
        return self.panes

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {"plan columns": self.columns, "plan panes": self.panes}
