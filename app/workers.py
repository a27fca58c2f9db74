"""Work off the GUI thread, with progress and cancel; a result that nobody waits for any more is dropped."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QThread, Signal, Slot

Progress = Callable[[float | None, str], None]
Work = Callable[[Progress, Callable[[], bool]], Any]


class _Worker(QThread):
    progressed = Signal(object, str)
    succeeded = Signal(object)
    failed = Signal(object)

    def __init__(self, work: Work, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._work = work

    def run(self) -> None:
        """Do the work; whatever it raises goes to the GUI thread."""
        try:
            result = self._work(self.progressed.emit, self.isInterruptionRequested)
        except Exception as error:
            self.failed.emit(error)
        else:
            self.succeeded.emit(result)


class Job(QObject):
    """At most one piece of work at a time; starting another cancels the one before."""

    progressed = Signal(object, str)
    """Fraction done (``None``: not known) and what is being done."""
    succeeded = Signal(object)
    failed = Signal(object)
    """The exception."""
    ended = Signal()
    """Done, failed or cancelled."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._worker: _Worker | None = None
        self._retired: list[_Worker] = []

    @property
    def is_running(self) -> bool:
        """Whether a result is being waited for."""
        return self._worker is not None

    def start(self, work: Work) -> None:
        """Begin ``work(progress, is_cancelled)``."""
        self.cancel()
        worker = _Worker(work, self)
        self._worker = worker
        worker.progressed.connect(self._progress)
        worker.succeeded.connect(self._succeed)
        worker.failed.connect(self._fail)
        worker.finished.connect(self._retire)
        worker.start()

    @Slot()
    def cancel(self) -> None:
        """Stop waiting; the worker ends as soon as its work looks."""
        if self._worker is not None:
            worker, self._worker = self._worker, None
            worker.requestInterruption()
            self._retired.append(worker)
            self.ended.emit()

    def shut_down(self) -> None:
        """Cancel and wait until every thread has ended."""
        self.cancel()
        for worker in self._retired:
            worker.wait()
        self._retired.clear()

    @Slot(object, str)
    def _progress(self, fraction: object, doing: str) -> None:
        if self.sender() is self._worker:
            self.progressed.emit(fraction, doing)

    @Slot(object)
    def _succeed(self, result: object) -> None:
        if self.sender() is self._worker:
            self._finish()
            self.succeeded.emit(result)

    @Slot(object)
    def _fail(self, error: object) -> None:
        if self.sender() is self._worker:
            self._finish()
            self.failed.emit(error)

    def _finish(self) -> None:
        if self._worker is not None:
            self._retired.append(self._worker)
            self._worker = None
            self.ended.emit()

    @Slot()
    def _retire(self) -> None:
        self._retired = [worker for worker in self._retired if worker.isRunning()]
