"""What the difference buttons of a plan open: the chosen picture, the reference settings, and where they differ."""

import numpy as np
from PySide6.QtCore import QObject, Slot

from app.export.views import copy_widget
from app.pages.page_bar import Page, StepRequest
from app.pages.plan.jobs import PlanJobs, PlanPictures
from app.pages.plan.presenter import PlanPresenter
from core.explain.stage_texts import family_title
from core.methods import table
from core.records.words import counted
from core.study import Opening
from widgets.charts.study_pictures import PicturesRecord, StudyPictures
from widgets.grid.buffer import GridBuffer


class PlanPicturesPresenter(QObject):
    """Keeps the pictures of one choice, or of all together."""

    def __init__(self, plans: PlanPresenter, jobs: PlanJobs, view: StudyPictures, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._plans, self._jobs, self._view = plans, jobs, view
        self._drawn: PlanPictures | None = None
        plans.shown_changed.connect(self.close)
        jobs.drawing.succeeded.connect(self._show_pictures)
        jobs.drawing.failed.connect(self._show_failure)
        view.step_requested.connect(self.step)
        view.copy_requested.connect(self.copy)
        view.closing_requested.connect(self.close)
        view.hide()

    @Slot(str)
    def open(self, setting: str) -> None:
        """Draw the choice at one stage alone, beside the reference settings."""
        self._draw(setting)

    @Slot()
    def open_all(self) -> None:
        """Draw all that was chosen, beside the reference settings."""
        self._draw("")

    def _draw(self, setting: str) -> None:
        shown = self._plans.shown
        if shown is None or shown.report is None:
            self._page.tell("There is no difference to show yet. Run the analysis first (F5).")
            return
        self._drawn = None
        self._view.show()
        self._view.show_waiting("Drawing the choice and the reference settings …")
        self._jobs.draw(shown.order.scene, shown.plan, setting)

    @Slot()
    def close(self) -> None:
        """Close the pictures."""
        self._jobs.stop_drawing()
        self._drawn = None
        self._view.hide()

    def dismiss(self) -> bool:
        """Close the pictures; return whether there were some, or were about to be."""
        is_open = not self._view.isHidden()
        self.close()
        return is_open

    @Slot(object)
    def _show_pictures(self, drawn: PlanPictures) -> None:
        self._drawn = drawn
        title = self._title(drawn)
        differs = int(np.count_nonzero(drawn.difference))
        largest = int(drawn.difference.max())
        amount = (
            f"{counted(differs, 'pixel')} of {drawn.difference.size:,} differ, by {largest}/255 at most."
            if differs
            else f"none of {drawn.difference.size:,} pixels differs."
        )
        self._view.show_pictures(
            PicturesRecord(
                f"{title}: {amount}",
                (
                    GridBuffer("chosen", drawn.result, "color"),
                    GridBuffer("reference settings", drawn.reference, "color"),
                    # White is no difference at any size of it.
                    GridBuffer("difference", drawn.difference, "signed", unit="/255"),
                ),
                (title, self._before(drawn), "Difference, in 1/255"),
                can_step=True,
            )
        )

    def _title(self, drawn: PlanPictures) -> str:
        if not drawn.setting:
            return "All choices together"
        chosen = getattr(drawn.settings, drawn.setting)
        return f"{family_title(drawn.setting)}: {table.get(drawn.setting, chosen).title}"

    def _before(self, drawn: PlanPictures) -> str:
        shown = self._plans.shown
        is_everything = shown is not None and drawn.before == shown.plan.everything
        return "Reference settings" if is_everything else "Reference settings, except what this choice needs"

    @Slot(object)
    def _show_failure(self, error: Exception) -> None:
        self._view.show_waiting(f"It cannot be drawn: {error}")

    @Slot()
    def step(self) -> None:
        """Open the choice beside the reference settings, A | B, at the pinned pixel or where they differ most."""
        shown, drawn = self._plans.shown, self._drawn
        if shown is None or drawn is None:
            return
        pixel = self._view.pin
        if pixel is None:
            row, column = np.unravel_index(int(drawn.difference.argmax()), drawn.difference.shape)
            pixel = int(column), int(row)
        opening = Opening(shown.order.scene, drawn.settings, "resolve", pixel)
        self._page.step_to(StepRequest(opening, self._title(drawn), drawn.before))

    @Slot()
    def copy(self) -> None:
        """Put the three pictures on the clipboard."""
        if self._drawn is not None:
            copy_widget(self._view.linked)
            self._page.tell("Copied the pictures.")
