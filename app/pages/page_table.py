"""Which pages the window has, in the order of the bar, and what one of them opens on the Step page."""

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QWidget

from app.background import Job
from app.files.file_access import DRAWN_ENDINGS, open_input
from app.pages.page_bar import Page, PageKind, StepRequest
from app.pages.step.page import StepPage
from app.session.document import Document, document_at
from app.session.session import Session
from app.session.tracing import trace_now
from core import Trace
from core.records.words import sentences
from widgets.basics.message_bar import Message, MessageKind

# Opening on the Step page what another page shows: one method's run, at the place that matters.


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
        self.job = Job(self, succeeded=self._show, failed=self._refuse)

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
                comparing.meeting.meet_at(pixel)
        self._page.column.show_step()
        self.opened.emit()

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        said = sentences(f"It cannot be stepped: {error}", "The open scene is unchanged")
        self.message_sent.emit(Message(MessageKind.WARNING, said))


# Which pages the window has: one row for each, in the order of the bar.


def _make_step(session: Session, parent: QWidget) -> Page:
    return StepPage(session, parent)


def _make_start(session: Session, parent: QWidget) -> Page:
    from app.pages.start_page import StartPage  # Not every start shows it.

    return StartPage(session, parent)


def _make_compare(session: Session, parent: QWidget) -> Page:
    from app.pages.compare.page import ComparePage  # pyqtgraph takes a moment: not before the page is shown.

    return ComparePage(session, parent)


def _make_stability(session: Session, parent: QWidget) -> Page:
    from app.pages.stability.page import (
        StabilityPage,  # All experiments come along: not before the page is shown.
    )

    return StabilityPage(session, parent)


def _make_plan(session: Session, parent: QWidget) -> Page:
    from app.pages.plan.page import PlanPage  # As above.

    return PlanPage(session, parent)


def _make_exercises(session: Session, parent: QWidget) -> Page:
    from app.pages.exercises.page import ExercisesPage  # All exercises come along, as above.

    return ExercisesPage(session, parent)


PAGE_KINDS = (
    PageKind(
        "start", "Start", "What this is, recent files and scenes (Alt+0)", _make_start, hides_itself=True
    ),
    PageKind(
        "step", "Step", "Step through the pipeline, pixel by pixel (Alt+1)", _make_step, hides_itself=True
    ),
    PageKind(
        "compare",
        "Compare",
        "Chart speed against accuracy for every family (Alt+2)",
        _make_compare,
        (".json",),
        b'"rasterscope study"',
    ),
    PageKind(
        "stability",
        "Stability",
        "See where methods fail: one map per method, one real run per cell (Alt+3)",
        _make_stability,
        (".json",),
        b'"rasterscope stress"',
    ),
    PageKind("plan", "Plan", "Find the cheapest methods that this scene needs (Alt+4)", _make_plan),
    PageKind(
        "exercises",
        "Exercises",
        "Answer on the picture (Alt+5)",
        _make_exercises,
        (".toml", *DRAWN_ENDINGS),
        hides_itself=True,
    ),
)
HEAD = 256
"""Bytes at the beginning of a file that name the program it is of."""


def page_of_file(path: str) -> str:
    """Return the name of the page that shows a file; empty: it is a scene or a state.

    Of several pages that take its ending it is the one that the file names; the first, if it names none.
    """
    kinds = [kind for kind in PAGE_KINDS if kind.endings and path.lower().endswith(kind.endings)]
    if len(kinds) > 1:
        head = _head(path)
        kinds = [kind for kind in kinds if kind.signature in head] or kinds
    return kinds[0].name if kinds else ""


def _head(path: str) -> bytes:
    """Return the beginning of a file; nothing where it cannot be read: the page that opens it says why."""
    try:
        with open_input(path) as file:
            return file.read(HEAD)
    except OSError:
        return b""


def page_endings() -> list[str]:
    """Return the endings of all files that a page shows."""
    return sorted({ending for kind in PAGE_KINDS for ending in kind.endings})
