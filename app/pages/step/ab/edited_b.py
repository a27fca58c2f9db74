"""B as it runs the edited listings of a document: tried first, so that a text that cannot run changes nothing."""

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.pages.step.ab.bounded_run import BoundedRun
from app.pages.step.ab.side_b import SideB
from app.session.document import Document
from app.session.tracing import QUICK_SECONDS, trace_now
from core import Trace

if TYPE_CHECKING:
    from core.edits import Edit  # As in app.session.document.


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

    @property
    def is_running(self) -> bool:
        """Whether a text is being tried in the background."""
        return self._trial.is_running

    def cancel(self) -> None:
        """Try no further."""
        self._trial.cancel()

    def stop(self) -> None:
        """Try no further, and wait for the thread."""
        self._trial.stop()

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
        from app.session.edited_run import settings_of, title_of  # Wanted by few, long after the start.

        title = title_of(edits)
        if not awake:
            self.side = SideB({}, title, edits=edits)
            return ""
        try:
            other = settings_of(replace(document, edits=awake))[1]
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
    from app.session.edited_run import settings_of

    return trace_now(replace(document, settings=settings_of(document)[1]), stage)
