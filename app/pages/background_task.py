"""Work that a page does in the background: drawn as it goes on, then done, cancelled or failed."""

from dataclasses import dataclass
from typing import Any, Protocol

from PySide6.QtCore import QEvent, QObject, QTimer, Signal, Slot
from PySide6.QtWidgets import QWidget

from app.background.workers import Job
from app.pages.page_bar import Page, percent_done
from widgets.basics.message_bar import Progress


@dataclass(frozen=True)
class WorkWords:
    """What is said of work that comes to nothing."""

    cancelled: str
    """As ``Measuring was cancelled``."""
    failed: str
    """As ``It could not be measured``."""
    kept: str
    """As ``the previous results are unchanged``."""


class ShowsProgress(Protocol):
    """The controls that start and cancel the work."""

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far it is; ``None``: nothing is being done."""


class BackgroundTask(QObject):
    """Follows one job: what came before stays, and comes back unless a result takes its place."""

    shown_changed = Signal()
    """Something else is shown: what was chosen in it is gone."""

    def __init__(self, job: Job, controls: ShowsProgress, words: WorkWords, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._job, self._progress_shown, self._words = job, controls, words
        self._told: Progress | None = None
        job.progressed.connect(self._show_progress)
        job.part_done.connect(self._take_part)
        job.succeeded.connect(self._take_result)
        job.failed.connect(self._fail)
        job.ended.connect(self._end)

    @property
    def is_running(self) -> bool:
        """Whether a result is being waited for."""
        return self._job.is_running

    @Slot()
    def cancel(self) -> None:
        """Stop; what there was before is shown again."""
        if self._job.is_running:
            self._job.cancel()
            self._come_to_nothing()
            self._page.tell(f"{self._words.cancelled}; {self._words.kept}.")

    @Slot(object, str)
    def _show_progress(self, fraction: float | None, doing: str) -> None:
        self._tell_progress(percent_done(fraction, self._doing(doing)))

    def _tell_progress(self, progress: Progress | None) -> None:
        """Show how far it is, on the page and to those who listen: each percent once, not each of a thousand cases."""
        if progress is not None and progress == self._told:
            return
        self._told = progress
        self._progress_shown.show_progress(progress)
        self._page.work_progressed.emit(progress)

    def _doing(self, doing: str) -> str:
        """Return the words for the work in progress."""
        return doing

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self._come_to_nothing()
        kept = self._words.kept
        self._page.refuse(f"{self._words.failed}: {error} {kept[:1].upper()}{kept[1:]}.")

    @Slot()
    def _end(self) -> None:
        """Go back to what was there before; a result or a reason may follow."""
        self._tell_progress(None)
        self._put_back()

    def _take_part(self, part: Any) -> None:
        """Show a part of the result."""
        raise NotImplementedError

    def _take_result(self, result: Any) -> None:
        """Show the result; ``ended`` has come before, and has restored what was shown earlier."""
        raise NotImplementedError

    def _put_back(self) -> None:
        """Show again what there was before."""
        raise NotImplementedError

    def _come_to_nothing(self) -> None:
        """Forget what was chosen in work that was cancelled or failed; there may be nothing to choose in it."""


PAUSE = 250
"""Milliseconds between the end of one drawing and the beginning of the next."""


class PacedDrawing(QObject):
    """Says when to draw: at once after a pause, else when the pause is over; of a hidden page, when it is shown."""

    due = Signal()
    """It is to be drawn now."""

    def __init__(self, page: QWidget) -> None:
        super().__init__(page)
        self._page = page
        self._is_owed = False
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE)
        self._pause.timeout.connect(self._draw_what_is_owed)
        page.installEventFilter(self)

    def ask(self) -> None:
        """Something new has come."""
        self._is_owed = True
        self._draw_what_is_owed()

    def settle(self) -> None:
        """Owe nothing: everything has just been drawn."""
        self._is_owed = False

    @Slot()
    def _draw_what_is_owed(self) -> None:
        if self._is_owed and not self._pause.isActive() and self._page.isVisible():
            self._is_owed = False
            self.due.emit()
            self._pause.start()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Draw what came while the page was hidden."""
        if event.type() == QEvent.Type.Show:
            self._draw_what_is_owed()
        return False
