"""Tracing off the GUI thread where it would hold up the window: one at a time, and of those that wait the last."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job, Progress
from app.session.document import Document
from core import Trace
from core.numeric.watched import watched
from core.resolved import resolve
from core.trace.incremental.draft import draft

QUICK_SECONDS = 0.3
"""What is estimated to take longer is traced off the GUI thread."""
RESTING_SECONDS = 0.05
"""The same for what a drag has left out, and for undo and redo: nobody follows those with the pointer."""


@dataclass(frozen=True, eq=False)
class Order:
    """A document to be traced, and the gesture that it belongs to."""

    document: Document
    gesture: str
    stage: str
    direction: int = 0
    """-1: it comes from undoing, 1: from redoing, 0: it is a new edit."""


@dataclass(frozen=True, eq=False)
class Traced:
    """A document with its trace; the picture and the stage in question are ready."""

    order: Order
    trace: Trace


def trace_now(document: Document, stage: str) -> Trace:
    """Trace a document and one of its stages, and draw its picture, so that nothing can fail later.

    Raises ValueError if the document has more steps than can be held, or a method does not serve the scene.
    """
    document.check_length()
    trace = document.make_trace()
    trace.stage(stage)
    assert trace.source.picture is not None
    if resolve(trace.source.settings).sampling.count == 1:
        # What the chapters count: of a large mesh it would hold up the window.
        assert trace.source.depth_tests is not None
    return trace


def trace_drag(document: Document, stage: str, earlier: Trace) -> Trace:
    """Trace the triangle in focus, and one of its stages, of a document that differs from the one of ``earlier`` in it.

    Raises ValueError if a method does not serve the scene.
    """
    trace = draft(document.traced_scene, earlier)
    trace.stage(stage)
    return trace


def _traced(order: Order, progress: Progress, is_cancelled: Callable[[], bool]) -> Traced:
    """Trace what was ordered; building a tree reports how far it is, and ends where nobody waits."""
    with watched(progress, is_cancelled):
        return Traced(order, trace_now(order.document, order.stage))


class Tracing(QObject):
    """Runs orders one after another; of those that wait only the last is kept."""

    traced = Signal(object)
    """A `Traced`."""
    failed = Signal(object)
    """The exception; nothing has changed."""
    busy_changed = Signal(str)
    """What is being waited for, empty: nothing."""
    progressed = Signal(object, str)
    """Fraction done (``None``: not known) of what is being done."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._job = Job(
            self, (Exception,), succeeded=self._succeed, failed=self._fail, progressed=self.progressed
        )
        self._waiting: Order | None = None
        self._newest: Order | None = None

    @property
    def is_busy(self) -> bool:
        """Whether a trace is being waited for."""
        return self._job.is_running

    @property
    def newest(self) -> Order | None:
        """What was ordered last of what is not done yet; ``None``: nothing is waited for."""
        return self._newest

    def start(self, order: Order) -> None:
        """Trace as soon as what is being traced now is done."""
        self._newest = order
        if self._job.is_running:
            self._waiting = order
            return
        self._job.start(partial(_traced, order))
        self.busy_changed.emit(f"Tracing {order.document.title or 'the scene'}")

    @Slot()
    def cancel(self) -> None:
        """Stop waiting; what is open stays as it is."""
        self._waiting = self._newest = None
        if self._job.is_running:
            self._job.cancel()
            self.busy_changed.emit("")

    def shut_down(self) -> None:
        """Cancel and wait for the thread."""
        self._waiting = self._newest = None
        self._job.shut_down()

    @Slot(object)
    def _succeed(self, traced: Traced) -> None:
        self.traced.emit(traced)
        self._go_on()

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self._go_on()
        self.failed.emit(error)

    def _go_on(self) -> None:
        waiting, self._waiting, self._newest = self._waiting, None, None
        self.busy_changed.emit("")
        if waiting is not None:
            self.start(waiting)
