"""What long work shows: its progress, once it takes a moment, and its cancelling."""

from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.background.workers import Job
from app.session.tracing import Tracing
from widgets.basics.message_bar import MessageBar, Progress

PROGRESS_AFTER = 300
"""Milliseconds before the progress of long work is shown."""


class WorkProgress(QObject):
    """Shows the opening of a file and the tracing of an edit in the message bar."""

    opening_cancelled = Signal()
    edit_cancelled = Signal()

    def __init__(
        self, opening: Job, tracing: Tracing, messages: MessageBar, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._opening, self._tracing, self._messages = opening, tracing, messages
        self._title = ""
        """What is waited for, as ``Opening teapot.obj``."""
        self._slow = QTimer(self)
        self._slow.setSingleShot(True)
        self._slow.setInterval(PROGRESS_AFTER)
        self._slow.timeout.connect(self._show_slow)
        opening.progressed.connect(self._show_progress)
        opening.ended.connect(self._end)
        tracing.busy_changed.connect(self._show_busy)
        messages.cancel_requested.connect(self.cancel)

    @property
    def is_busy(self) -> bool:
        """Whether anything is waited for."""
        return self._opening.is_running or self._tracing.is_busy

    def begin(self, doing: str) -> None:
        """Show what is being done, if that takes a moment."""
        self._title = doing
        self._slow.start()

    @Slot()
    def cancel(self) -> None:
        """Stop waiting; the open scene is unchanged."""
        if self._tracing.is_busy:
            self._tracing.cancel()
            self.edit_cancelled.emit()
        if self._opening.is_running:
            self._opening.cancel()
            self.opening_cancelled.emit()

    @Slot(object, str)
    def _show_progress(self, fraction: float | None, doing: str) -> None:
        if not self._slow.isActive():
            done = 0 if fraction is None else round(fraction * 100)
            text = f"{self._title}: {doing}" if doing else self._title
            self._messages.show_progress(Progress(text, done, 0 if fraction is None else 100))

    @Slot()
    def _show_slow(self) -> None:
        if self.is_busy:
            self._messages.show_progress(Progress(self._title, 0, 0))

    @Slot(str)
    def _show_busy(self, doing: str) -> None:
        if doing:
            self.begin(doing)
        elif not self._opening.is_running:
            self._end()

    @Slot()
    def _end(self) -> None:
        self._slow.stop()
        self._messages.show_progress(None)
