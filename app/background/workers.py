"""Work off the GUI thread, with progress and cancel; a result that nobody waits for any more is dropped."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, QThread, Signal, Slot

Progress = Callable[[float | None, str], None]
Work = Callable[[Progress, Callable[[], bool]], Any]
PartWork = Callable[[Progress, Callable[[], bool], Callable[[Any], None]], Any]
"""Work that gives parts of its result as they are done."""
Expected = tuple[type[Exception], ...]


_until: float | None = None
"""When waiting for work that is shut down ends; ``None``: when the work has ended."""
_left: list[object] = []
"""What had not ended by then. A thread must not be deleted while it runs."""


@contextmanager
def ending_within(seconds: float) -> Iterator[None]:
    """Wait at most so long for all work together that is shut down in the block; see `is_work_left`."""
    global _until
    _until = monotonic() + seconds
    try:
        yield
    finally:
        _until = None


def seconds_to_end() -> float | None:
    """Return how long may be waited for work that is shut down now; ``None``: until it has ended."""
    return None if _until is None else max(_until - monotonic(), 0.0)


def leave(work: object) -> None:
    """Keep work that goes on although it was shut down."""
    _left.append(work)


def is_work_left() -> bool:
    """Return whether work goes on that was shut down: then Python would wait for it at the end of the process."""
    return bool(_left)


class _Worker(QThread):
    progressed = Signal(object, str)
    part_done = Signal(object)
    succeeded = Signal(object)
    failed = Signal(object)

    def __init__(self, work: PartWork, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._work = work

    def run(self) -> None:
        """Do the work; whatever it raises goes to the GUI thread."""
        # The thread stays with its job, what it was given to work on does not.
        work = self._work
        del self._work
        try:
            result = work(self.progressed.emit, self.isInterruptionRequested, self.part_done.emit)
        except Exception as error:
            self.failed.emit(error)
        else:
            self.succeeded.emit(result)


class Job(QObject):
    """At most one piece of work at a time; starting another cancels the one before."""

    progressed = Signal(object, str)
    """Fraction done (``None``: not known) and what is being done."""
    part_done = Signal(object)
    """A part of the result, of work that was started in parts."""
    succeeded = Signal(object)
    failed = Signal(object)
    """The exception, if it is one of those expected; any other is a mistake of the program, and is raised."""
    ended = Signal()
    """Done, failed or cancelled."""

    def __init__(self, parent: QObject | None = None, expected: Expected = (ValueError, MemoryError)) -> None:
        super().__init__(parent)
        self._expected = expected
        self._worker: _Worker | None = None
        self._retired: list[_Worker] = []

    @property
    def is_running(self) -> bool:
        """Whether a result is being waited for."""
        return self._worker is not None

    def call(self, work: Callable[[], Any]) -> None:
        """Begin work that tells no progress and ends by itself."""
        self.start_in_parts(lambda *_: work())

    def start(self, work: Work) -> None:
        """Begin ``work(progress, is_cancelled)``."""
        self.start_in_parts(lambda progress, is_cancelled, _: work(progress, is_cancelled))

    def start_in_parts(self, work: PartWork) -> None:
        """Begin ``work(progress, is_cancelled, part_done)``."""
        self.cancel()
        worker = _Worker(work, self)
        self._worker = worker
        worker.progressed.connect(self._progress)
        worker.part_done.connect(self._take_part)
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
        """Cancel, and wait until every thread has ended; see `ending_within`."""
        self.cancel()
        for worker in self._retired:
            seconds = seconds_to_end()
            if not (worker.wait() if seconds is None else worker.wait(round(1000 * seconds))):
                worker.setParent(None)
                leave(worker)
        self._retired.clear()

    @Slot(object, str)
    def _progress(self, fraction: object, doing: str) -> None:
        if self.sender() is self._worker:
            self.progressed.emit(fraction, doing)

    @Slot(object)
    def _take_part(self, part: object) -> None:
        if self.sender() is self._worker:
            self.part_done.emit(part)

    @Slot(object)
    def _succeed(self, result: object) -> None:
        if self.sender() is self._worker:
            self._finish()
            self.succeeded.emit(result)

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        if self.sender() is self._worker:
            self._finish()
            if not isinstance(error, self._expected):
                raise error
            self.failed.emit(error)

    def _finish(self) -> None:
        if self._worker is not None:
            self._retired.append(self._worker)
            self._worker = None
            self.ended.emit()

    @Slot()
    def _retire(self) -> None:
        for worker in self._retired:
            if not worker.isRunning():
                worker.deleteLater()
        self._retired = [worker for worker in self._retired if worker.isRunning()]


class JobGroup(QObject):
    """The jobs of a page: each does at most one piece of work at a time, and the newest counts."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._jobs: list[Job] = []

    def add_job(self, expected: Expected = (ValueError, MemoryError)) -> Job:
        """Return another job of the page."""
        self._jobs.append(Job(self, expected))
        return self._jobs[-1]

    @property
    def is_running(self) -> bool:
        """Whether any result is being waited for."""
        return any(job.is_running for job in self._jobs)

    def shut_down(self) -> None:
        """Cancel everything and wait for the threads."""
        for job in self._jobs:
            job.shut_down()
