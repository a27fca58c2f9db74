"""Runs of B, at once as long as that is quick, else in the background; typed texts are tried first."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job
from app.session.document import Document
from app.session.tracing import QUICK_SECONDS, trace_now
from core import Trace

if TYPE_CHECKING:
    from core.edits.edit import Edit
from app.pages.step.ab.side_b import SideB

QUICK_TRIAL_SECONDS = 0.2
"""How long the window may wait for a text; what takes longer begins anew in the background."""


class BoundedRun(QObject):
    """Does one piece of work at a time; another one, or `cancel`, ends it."""

    done = Signal(object)
    """The result."""
    failed = Signal(object)
    """The ValueError or MemoryError; `core.lanes.problem.Problem` where the text is to blame."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._job = Job(self, succeeded=self.done, failed=self.failed)

    def do(self, work: Callable[[], Any], *, is_long: bool = False) -> None:
        """Begin work that runs typed texts; what ``is_long`` goes to the background at once."""
        from core.lanes.run import bounded  # Wanted by few, long after the start.

        self.cancel()
        if not is_long:
            began = perf_counter()
            try:
                with bounded(QUICK_TRIAL_SECONDS, lambda: perf_counter() - began > QUICK_TRIAL_SECONDS):
                    result = work()
            except (ValueError, MemoryError) as error:
                if perf_counter() - began < QUICK_TRIAL_SECONDS:
                    self.failed.emit(error)
                    return
            else:
                self.done.emit(result)
                return
        self._job.start(lambda _progress, is_cancelled: _stoppable(work, is_cancelled))

    def cancel(self) -> None:
        """Wait for nothing; what runs ends within some statements of its text."""
        self._job.cancel()


def _stoppable(work: Callable[[], Any], is_cancelled: Callable[[], bool]) -> Any:
    from core.lanes.problem import LISTING
    from core.lanes.run import bounded

    with bounded(LISTING.seconds, is_cancelled):
        return work()


class EditedB(QObject):
    """Finds what B is beside a document with edits, and tries another text."""

    ran = Signal(object)
    """A text that was tried runs: the document whose side B runs it."""
    failed = Signal(object)
    """Why it does not: the exception."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.side: SideB | None = None
        """What B is; ``None``: the document has no edits, and none is begun."""
        self.begun: Edit | None = None
        """The listing that stands in the editor, unchanged: B is a copy of A until it is changed."""
        self._trying: Document | None = None
        self._tried: tuple[Document, Trace] | None = None
        self._trial = BoundedRun(self)
        self._trial.done.connect(self._take)
        self._trial.failed.connect(self.failed)

    def cancel(self) -> None:
        """Try no further."""
        self._trial.cancel()

    def find(self, document: Document) -> str:
        """Find what B is beside a document; return why it cannot be drawn, empty: it can.

        Edits that the scene would pass over sleep: B is without them.
        """
        self.side = None
        awake = tuple(
            edit for edit in document.edits if not edit.passed_over(document.settings, document.scene)
        )
        edits = awake or (() if self.begun is None else (self.begun,))
        if not edits:
            return ""
        # Wanted by few, long after the start.
        from app.session.listing_runs import settings_as_edited, title_as_edited

        title = title_as_edited(edits)
        if not awake:
            self.side = SideB({}, title, edits=edits)
            return ""
        try:
            other = settings_as_edited(replace(document, edits=awake))[1]
        except ValueError as error:
            self.side = SideB({}, title, edits=awake)
            return f"B cannot be drawn: {error}"
        self.side = SideB(document.settings.differences(other), title, edits=awake)
        return ""

    def try_edit(self, document: Document, stage: str) -> None:
        """Run the edited listings of a document as B would; `ran` or `failed` follows."""
        self._trying = document
        is_long = document.estimated_seconds > QUICK_SECONDS
        self._trial.do(partial(_traced, document, stage), is_long=is_long)

    def run_of(self, document: Document) -> Trace | None:
        """Return the run of B beside a document that was tried last."""
        return self._tried[1] if self._tried is not None and self._tried[0] is document else None

    @Slot(object)
    def _take(self, trace: Trace) -> None:
        assert self._trying is not None
        self._tried, self._trying = (self._trying, trace), None
        self.ran.emit(self._tried[0])


def _traced(document: Document, stage: str) -> Trace:
    """Trace a stage with the edited listings of a document; raises ValueError where one of them cannot run."""
    from app.session.listing_runs import settings_as_edited

    return trace_now(replace(document, settings=settings_as_edited(document)[1]), stage)


class DrawnB(QObject):
    """Draws B: its run up to the stage that is shown."""

    drawn = Signal(object)
    """The trace of B."""
    failed = Signal(object)
    """Why it cannot be drawn: the exception."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._job = Job(self, succeeded=self.drawn, failed=self.failed)
        self._bounded = BoundedRun(self)
        self._bounded.done.connect(self.drawn)

    def draw(self, other: Document, stage: str, *, is_typed: bool) -> None:
        """Draw a document up to a stage; `drawn` or `failed` follows, before this returns where it is quick."""
        is_long = other.estimated_seconds > QUICK_SECONDS
        if is_typed:
            self._bounded.do(partial(trace_now, other, stage), is_long=is_long)
        elif is_long:
            self._job.call(partial(_drawn, other, stage))
        else:
            try:
                trace = _drawn(other, stage)
            except ValueError as error:
                self.failed.emit(error)
                return
            self.drawn.emit(trace)

    def cancel(self) -> None:
        """Draw no further."""
        self._job.cancel()
        self._bounded.cancel()


def _drawn(other: Document, stage: str) -> Trace:
    other.check_length()
    trace = other.make_trace()
    trace.stage(stage)
    return trace
