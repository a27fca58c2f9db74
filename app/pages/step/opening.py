"""Opening on the Step page what another page shows: one method's run, at the place that matters."""

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job
from app.pages.page_bar import StepRequest
from app.pages.step.page import StepPage
from app.session.document import Document
from app.session.opening_document import document_at
from app.session.session import Session
from app.session.tracing import trace_now
from core import Trace
from core.records.sentences import sentences
from widgets.basics.message_bar import Message, MessageKind


@dataclass(frozen=True, eq=False)
class _Ready:
    request: StepRequest
    document: Document
    trace: Trace


class StepOpening(QObject):
    """Traces what is asked for off the GUI thread, then shows it; undo leads back to what was open."""

    message_sent = Signal(object)
    """A ``Message``: why it could not be opened."""
    opened = Signal()
    """It is on the Step page now."""

    def __init__(self, session: Session, page: StepPage, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._page = session, page
        self.job = Job(self)
        self.job.succeeded.connect(self._show)
        self.job.failed.connect(self._refuse)

    @Slot(object)
    def open_request(self, request: StepRequest) -> None:
        """Open what a `StepRequest` names."""

        def work() -> _Ready:
            document = document_at(request.opening, request.title, request.triangle)
            document = replace(document, edits=request.edits)
            return _Ready(request, document, trace_now(document, request.opening.stage))

        self.job.call(work)

    def shut_down(self) -> None:
        """Cancel and wait for the thread."""
        self.job.shut_down()

    @Slot(object)
    def _show(self, ready: _Ready) -> None:
        opening, other = ready.request.opening, ready.request.other
        self._page.timeline.show_playing(False)
        if ready.request.is_asked is not None:
            self._page.set_predicting(ready.request.is_asked)
        self._session.open(ready.document, ready.trace)
        self._page.stepping.set_places()
        self._session.set_stage(opening.stage, ready.request.position or 0)
        pixel = opening.pixel if opening.pixel and self._session.moment.has_pixel(opening.pixel) else None
        if pixel is not None:
            self._session.set_pin(pixel)
        if ready.request.edits:
            self._page.show_view("compare")
            self._page.comparing.begin_at(pixel)
            self._page.editing.show_lent(ready.request.edits)
            self._page.editing.show_right(is_asked=ready.request.hides_right)
        elif other is None:
            self._page.show_view("pixels")
            if pixel is not None and not ready.request.is_asked and ready.request.position is None:
                self._page.stepping.step_into(opening.stage, *pixel)
        else:
            comparing, scene = self._page.comparing, ready.request.other_scene
            differences = opening.settings.differences(other)
            if scene is not None:
                seeks = ready.request.position is None
                comparing.show_mistake(differences, scene, ready.request.other_title, seeks=seeks)
            else:
                comparing.set_differences(differences)
            self._page.show_view("compare")
            if scene is None and pixel is not None:
                comparing.meet_at(pixel)
        self._page.column.show_step()
        self.opened.emit()

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        said = sentences(f"It cannot be stepped: {error}", "The open scene is unchanged")
        self.message_sent.emit(Message(MessageKind.WARNING, said))
