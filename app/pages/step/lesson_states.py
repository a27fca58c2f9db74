"""The states of a lesson on the Step page: traced off the GUI thread, the next one ahead, each one entry of undo."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from threading import Lock
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job
from app.pages.step.lesson_question import LessonQuestion
from app.session.cursor import Cursor, cursor_at
from app.session.document import Document, TeachingRaster
from app.session.moment import Step
from app.session.printed_run import settings_of
from app.session.tracing import trace_now
from core import Settings, Trace
from core.records.steps import Level
from core.trace.run_to import START
from lessons.course.state import State

if TYPE_CHECKING:
    from app.pages.step.page import StepPage

KEPT = 3
"""Documents that are kept with their traces: of the step that is shown, of the next one, and of what is revealed."""
PANES = ("inspector", "run")
"""Panes that are shown beside those that a state names."""


@dataclass(frozen=True, eq=False)
class OpenState:
    """A state that is traced, and what is asked about it."""

    state: State
    document: Document
    trace: Trace
    cursor: Cursor
    second: tuple[Document, Trace] | None
    """What side B draws, with its trace; ``None``: it has no B, or none that can be drawn."""
    asked: LessonQuestion | None = None


Wanted = tuple[State, LessonQuestion | None]


class LessonStates(QObject):
    """Traces states and shows them; states of one scene and the same settings share a document."""

    refused = Signal(object)
    """Why a state cannot be opened: the exception."""

    def __init__(self, page: "StepPage") -> None:
        super().__init__(page)
        self._page = page
        self._known: tuple[OpenState, ...] = ()
        """The newest last."""
        self._alone = Lock()
        """Held while a state is traced: who wants what is being prepared takes that."""
        self._show: Callable[[OpenState], None] | None = None
        self._wanting, self._preparing = Job(self), Job(self)
        self._wanting.succeeded.connect(self._take)
        self._wanting.failed.connect(self.refused)
        self._preparing.succeeded.connect(self._look_at)
        self._preparing.failed.connect(self._leave_out)

    @property
    def is_working(self) -> bool:
        """Whether a state that is wanted is being traced."""
        return self._wanting.is_running

    def stop(self) -> None:
        """End all work."""
        self._wanting.shut_down()
        self._preparing.shut_down()

    def forget(self) -> None:
        """Forget what was traced, and want nothing any more."""
        self._wanting.cancel()
        self._preparing.cancel()
        self._known = ()

    def want(self, make: Callable[[], Wanted], show: Callable[[OpenState], None]) -> None:
        """Trace a state, and hand it to ``show``, unless another one is wanted by then."""
        self._show = show
        self._wanting.call(partial(self._open, make))

    def prepare(self, make: Callable[[], Wanted | None]) -> None:
        """Trace a state that may be wanted next."""
        self._preparing.call(partial(self._open, make))

    def _open(self, make: Callable[[], Wanted | None]) -> OpenState | None:
        """Trace a state, in a thread of its own."""
        with self._alone:
            wanted = make()
            if wanted is None:
                return None
            made = opened(*wanted, self._known)
            others = tuple(each for each in self._known if each.document is not made.document)
            self._known = (*others, made)[-KEPT:]
            return made

    @Slot(object)
    def _take(self, made: OpenState) -> None:
        if self._show is not None:
            self._show(made)

    @Slot(object)
    def _look_at(self, made: OpenState | None) -> None:
        if made is not None:
            page = self._page
            fill = partial(page.scene.prepare, made.document) if made.state.panes else lambda: None
            page.inspector.ahead.look_at(Step(made.trace, made.cursor), fill)

    @Slot(object)
    def _leave_out(self, error: Exception) -> None:
        """Say nothing: who goes to that step is told."""

    def show(self, shown: OpenState, *, is_hidden: bool, panes: Sequence[str] = ()) -> None:
        """Show a state, and hide what comes after it if it ``is_hidden``: one entry of undo, or none.

        ``panes`` are shown beside it; none: those that are there.
        """
        page, state, session = self._page, shown.state, self._page.session
        page.timeline.show_playing(False)
        page.grids.look_only_at(shown.cursor.stage, state.buffer)
        page.comparing.look_only_at(shown.cursor.stage, state.buffer)
        before = session.moment
        with page.comparing.held(shown.second):
            if session.document is shown.document:
                session.jump(shown.cursor, state.pixel, is_hidden)
            else:
                session.open(
                    shown.document, shown.trace, shown.cursor, pin=state.pixel, is_predicting=is_hidden
                )
                page.stepping.set_places()
                page.views.look_from({})
            page.grids.focus_on(max(session.moment.triangle, 0))
            if session.moment is before:
                page.grids.show_again()
            page.main_area.views_by_hand.clear()
            if panes and set(panes) != set(page.desk_panes()):
                page.show_desk_panes(panes)  # Before the pictures of A | B find their places.
            self._show_view(state)
        if state.pixel is not None and state.other is not None:
            page.comparing.meet_at(state.pixel)
        page.column.show_step()

    def _show_view(self, state: State) -> None:
        """Show A | B where the state has a B, else its view, or the one of its stage."""
        page = self._page
        if state.printed:
            page.comparing.show_printed(state.printed, seeks=state.place.at == START)
        elif state.other is not None:
            page.comparing.set_differences(state.settings.differences(state.other))
        if state.printed or state.edits or state.other is not None:
            page.show_view(state.view or "compare")
        elif state.view:
            page.show_view(state.view)
        else:
            page.show_own_view()


def _both_settings(state: State) -> tuple[Settings, Settings | None]:
    """Return the settings of A and B: beside a listing as printed, those under which both run the same listing."""
    if not state.printed:
        return state.settings, state.other
    raster = TeachingRaster(*state.scene.size)
    return settings_of(state.printed, Document(state.scene, raster, state.settings))


def _second(document: Document, stage: str, other: Settings) -> tuple[Document, Trace] | None:
    """Trace what B draws up to a stage; ``None`` where it cannot: A | B says why."""
    second = replace(document, settings=other)
    try:
        second.check_length()
        run = second.make_trace()
        run.stage(stage)
    except ValueError:
        return None
    return second, run


def opened(state: State, asked: LessonQuestion | None, known: tuple[OpenState, ...]) -> OpenState:
    """Trace a state, or take the trace of a ``known`` one that has the same; ValueError where it cannot be opened."""
    mine, other = _both_settings(state)
    for each in known:
        same = each.state.scene is state.scene and each.state.triangle == state.triangle
        if same and each.document.settings == mine and each.document.edits == state.edits:
            document, run = each.document, each.trace
            break
    else:
        raster = TeachingRaster(*state.scene.size)
        document = Document(state.scene, raster, mine, state.triangle, title=state.title, edits=state.edits)
        run = trace_now(document, state.stage)
    run.stage(state.stage)
    cursor = cursor_at(state.place, run, Level.PIXEL)
    second = None if other is None else _second(document, cursor.stage, other)
    return OpenState(state, document, run, cursor, second, asked)
