"""Work off the GUI thread, one long piece at a time, and memory collected and given back where it hurts nobody."""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, QThread, QTimer, Signal, Slot

from core.numeric.large_arrays import give_back
from core.numeric.watched import watched

# Work off the GUI thread, with progress and cancel; a result that nobody waits for any more is dropped.


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
            with watched(None, self.isInterruptionRequested):
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

    def __init__(
        self, parent: QObject | None = None, expected: Expected = (ValueError, MemoryError), **told: Any
    ) -> None:
        """Do nothing yet; ``told``: by the name of a signal, what it is connected with."""
        super().__init__(parent)
        self._expected = expected
        self._worker: _Worker | None = None
        self._retired: list[_Worker] = []
        for name, receiver in told.items():
            getattr(self, name).connect(receiver)

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


def is_working(owner: QObject) -> bool:
    """Return whether an object, or one that belongs to it, waits for a result."""
    return any(job.is_running for job in owner.findChildren(Job))


def end_work(owner: QObject) -> None:
    """Cancel the work of an object and of all that belong to it, and wait for the threads; see `ending_within`."""
    for job in owner.findChildren(Job):
        job.shut_down()


# One piece of long work at a time, whatever page asked for it: at once each would falsify the times of the
# other.


LOOK_SECONDS = 0.05
"""How often work that waits looks whether it is still wanted."""


class CancelledWaitError(Exception):
    """The work was cancelled before its turn came."""


class Turns:
    """Lets work begin when the work before it has ended; meanwhile it names the page that it waits for."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._page = ""

    @contextmanager
    def take(self, page: str, progress: Progress, is_cancelled: Callable[[], bool]) -> Iterator[None]:
        """Wait for the turn of ``page``, then hold it; raises CancelledWaitError if it is not wanted any more."""
        while not self._lock.acquire(timeout=LOOK_SECONDS):
            if is_cancelled():
                raise CancelledWaitError(f"The {page} page does not wait any more.")
            # Cancelled work of the same page may be in its last run.
            waits = "Preparing" if self._page == page else f"Waiting until the {self._page} page is done"
            progress(None, waits)
        self._page = page
        try:
            yield
        finally:
            self._lock.release()


turns = Turns()
"""Of the whole program."""


# Garbage collected in the GUI thread only, for the collector deletes what it finds in the thread that it
# runs in.


LOOK_MS = 200
"""How often is looked whether there may be enough garbage."""


class Collecting(QObject):
    """Collects as often as Python would, but between two events of the GUI thread.

    Python collects in whatever thread makes one object too many, half of the time a worker: a widget or a timer in a
    ring of references would be deleted there while the GUI thread uses it.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._most = gc.get_threshold()
        gc.set_threshold(0)  # Not ``disable``: who times something turns the collector off and on again.
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._collect)
        self._timer.start(LOOK_MS)

    def stop(self) -> None:
        """Let Python collect by itself again."""
        self._timer.stop()
        gc.set_threshold(*self._most)

    @Slot()
    def _collect(self) -> None:
        """Collect the oldest generation of which all younger ones, and it, are over their limit."""
        if not gc.isenabled():
            return
        oldest = -1
        for count, most in zip(gc.get_count(), self._most, strict=True):
            if count <= most:
                break
            oldest += 1
        if oldest >= 0:
            gc.collect(oldest)


# Giving freed memory back to the system, a moment after what takes much of it.


PAUSE = 500
"""Milliseconds without such work: not between the moves of a drag."""


class Freeing(QObject):
    """Gives memory back off the GUI thread, where it may take a tenth of a second."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._job = Job(self, expected=())
        self._pause = QTimer(self, singleShot=True, interval=PAUSE)
        self._pause.timeout.connect(self._start)

    @property
    def is_waiting(self) -> bool:
        """Whether memory is still to be given back."""
        return self._pause.isActive() or self._job.is_running

    @Slot()
    def ask(self) -> None:
        """Give back soon: something large was replaced."""
        self._pause.start()

    def shut_down(self) -> None:
        """Give nothing back any more."""
        self._pause.stop()
        self._job.shut_down()

    @Slot()
    def _start(self) -> None:
        self._job.call(give_back)
