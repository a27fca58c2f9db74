"""Runs of what a user has typed: at once as long as that is quick, else in the background, and they can be stopped."""

from collections.abc import Callable
from time import perf_counter
from typing import Any

from PySide6.QtCore import QObject, Signal

from app.background.workers import Job

QUICK_SECONDS = 0.2
"""How long the window may wait for a text; what takes longer begins anew in the background."""


class BoundedRun(QObject):
    """Does one piece of work at a time; another one, or `cancel`, ends it."""

    done = Signal(object)
    """The result."""
    failed = Signal(object)
    """The ValueError or MemoryError; `core.lanes.problem.Problem` where the text is to blame."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._job = Job(self)
        self._job.succeeded.connect(self.done)
        self._job.failed.connect(self.failed)

    @property
    def is_running(self) -> bool:
        """Whether something runs in the background."""
        return self._job.is_running

    def do(self, work: Callable[[], Any], *, is_long: bool = False) -> None:
        """Begin work that runs typed texts; what ``is_long`` goes to the background at once."""
        from core.lanes.run import bounded  # Wanted by few, long after the start.

        self.cancel()
        if not is_long:
            began = perf_counter()
            try:
                with bounded(QUICK_SECONDS, lambda: perf_counter() - began > QUICK_SECONDS):
                    result = work()
            except (ValueError, MemoryError) as error:
                if perf_counter() - began < QUICK_SECONDS:
                    self.failed.emit(error)
                    return
            else:
                self.done.emit(result)
                return
        self._job.start(lambda _progress, is_cancelled: _stoppable(work, is_cancelled))

    def cancel(self) -> None:
        """Wait for nothing; what runs ends within some statements of its text."""
        self._job.cancel()

    def stop(self) -> None:
        """Cancel, and wait for the thread."""
        self._job.shut_down()


def _stoppable(work: Callable[[], Any], is_cancelled: Callable[[], bool]) -> Any:
    from core.lanes.limits import LISTING
    from core.lanes.run import bounded

    with bounded(LISTING.seconds, is_cancelled):
        return work()
