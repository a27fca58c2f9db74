"""What a choice in a result opens below it: made off the GUI thread, shown, copied, and stepped."""

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Slot

from app.background.workers import JobGroup
from app.export.views import copy_widget
from app.pages.page_bar import Page, StepRequest
from widgets.charts.study_pictures import PicturesRecord, StudyPictures
from widgets.grid.linked_grids import Pixel


@dataclass(frozen=True, eq=False)
class DrawnPictures:
    """Three pictures, and what they lead to."""

    record: PicturesRecord
    request: Callable[[Pixel | None], StepRequest | str]
    """Returns what opens in the stepper at the pinned pixel, or a sentence: why nothing does."""
    divergence: Callable[[], StepRequest | str] | None = None
    """Finds where two runs part ways, or says that they do not; ``None``: there is one run."""


class OpenedPictures(QObject):
    """At most one drawing of pictures and one search in them at a time."""

    def __init__(self, view: StudyPictures, jobs: JobGroup, page: Page) -> None:
        super().__init__(page)
        self._view, self._page = view, page
        self._drawn: DrawnPictures | None = None
        self.drawing, self._searching = jobs.add_job(), jobs.add_job()
        self.drawing.succeeded.connect(self._show)
        self.drawing.failed.connect(self._show_failure)
        self._searching.succeeded.connect(self._take_divergence)
        self._searching.failed.connect(self._tell_no_divergence)
        view.step_requested.connect(self.step)
        view.divergence_requested.connect(self.step_to_divergence)
        view.copy_requested.connect(self.copy)

    def open(self, doing: str, draw: Callable[[], DrawnPictures]) -> None:
        """Draw, and say meanwhile what is being done."""
        self.say(doing)
        self._view.show()
        self.drawing.call(draw)

    def say(self, text: str) -> None:
        """Show no pictures, and say why, or how to get some."""
        self.drawing.cancel()
        self._searching.cancel()
        self._drawn = None
        self._view.show_waiting(text)

    def close(self) -> None:
        """Close the pictures."""
        self.say("")
        self._view.hide()

    @Slot(object)
    def _show(self, drawn: DrawnPictures) -> None:
        self._drawn = drawn
        self._view.show_pictures(drawn.record)

    @Slot(object)
    def _show_failure(self, error: Exception) -> None:
        self._view.show_waiting(f"It cannot be drawn: {error}")

    # Where they lead.

    @Slot()
    def step(self) -> None:
        """Open the run on the Step page, at the pinned pixel or where it is wrong first."""
        if self._drawn is None:
            self._page.tell("Click a point first: its run opens in the stepper.")
        else:
            self._follow(self._drawn.request(self._view.pin))

    @Slot()
    def step_to_divergence(self) -> None:
        """Open both runs on the Step page, where they first part ways."""
        if self._drawn is None or self._drawn.divergence is None:
            self._page.tell("Select two points first: click one, then Ctrl+click another.")
        else:
            self._view.show_busy("Searching for the first divergence …")
            self._searching.call(self._drawn.divergence)

    @Slot(object)
    def _take_divergence(self, found: StepRequest | str) -> None:
        self._show_again()
        self._follow(found)

    @Slot(object)
    def _tell_no_divergence(self, error: Exception) -> None:
        self._show_again()
        self._page.refuse(f"They cannot be traced: {error}")

    def _show_again(self) -> None:
        if self._drawn is not None:
            self._show(self._drawn)

    def _follow(self, found: StepRequest | str) -> None:
        if isinstance(found, str):
            self._page.tell(found)
        else:
            self._page.step_to(found)

    @Slot()
    def copy(self) -> None:
        """Put the three pictures on the clipboard."""
        if self._drawn is not None:
            copy_widget(self._view.linked)
            self._page.tell("Copied the pictures.")
