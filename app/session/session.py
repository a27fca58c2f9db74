"""The only mutable state of the program: what is open and its edits; and, as `Stepping`, where it is looked at."""

from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.session.document import Document, edits_beside, with_settings
from app.session.history import History, held_arrays
from app.session.moment import NOTHING, Change, Cursor, Moment, Pixel, Step, cursor_for, kept_at_pixel, placed
from app.session.stepping import Stepping
from app.session.tracing import QUICK_SECONDS, RESTING_SECONDS, Order, Traced, Tracing, trace_drag, trace_now
from core import Settings, Trace
from core.trace.incremental.draft import Draft

if TYPE_CHECKING:
    from core.study.planner.records import PlanReport

REST_MS = 150
"""A drag rests where it has not moved for so long, in milliseconds."""


class Session(Stepping):
    """What is open, and the ways from one document to the next: each brings its Moment."""

    edit_failed = Signal(object)
    """Why an edit that was traced in the background came to nothing: the exception."""

    def __init__(self, document: Document, parent: QObject | None = None) -> None:
        document = edits_beside(document)
        cursor = cursor_for(document.scene, Cursor())
        super().__init__(Moment(document.make_trace(), cursor, document=document), parent)
        self.tracing = Tracing(self)
        """What traces large documents in the background."""
        self.tracing.traced.connect(self._take_traced)
        self.tracing.failed.connect(self._refuse)
        self._history = History(document, held_arrays)
        self._left: tuple[Document, Cursor, Pixel | None] | None = None
        """The document that was left last for another one, with the cursor and the pin that it had."""
        self._plan: PlanReport | None = None
        self._resting = QTimer(self)
        """Runs from the last move of a drag until it rests."""
        self._resting.setSingleShot(True)
        self._resting.setInterval(REST_MS)
        self._resting.timeout.connect(self.come_to_rest)

    @property
    def latest(self) -> Document:
        """What the next edit starts from: what is still being traced, as all edits before it; else what is open."""
        newest = self.tracing.newest
        return self.document if newest is None else newest.document

    @property
    def plan(self) -> "PlanReport | None":
        """What the open scene needs; ``None``: it has not been measured, or another scene is open."""
        return self._plan if self._plan is not None and self._plan.scene is self.document.scene else None

    def set_plan(self, plan: "PlanReport") -> None:
        """Say what a scene needs."""
        self._plan = plan
        self.changed.emit(Change.PLAN)

    # Editing.

    def open(
        self,
        document: Document,
        trace: Trace | None = None,
        cursor: Cursor | None = None,
        *,
        pin: Pixel | None = None,
        is_predicting: bool | None = None,
    ) -> None:
        """Show another document, with its trace if that is there already, at a cursor; undo leads back to this place.

        ``is_predicting``: whether what comes next is hidden from now on; ``None``: as before. Raises ValueError if the
        document cannot be traced; nothing changes.
        """
        self.tracing.cancel()
        run, document = document, edits_beside(document)
        if trace is None or run is not document:
            trace = trace_now(document, (cursor or self.cursor).stage)
        self._left = self.document, self.cursor, self.pin
        self._history.put(document)
        also = Change.OPENED | Change.PIN
        if is_predicting not in (None, self.is_predicting):
            self._moment = replace(self._moment, is_predicting=bool(is_predicting))
            also |= Change.PREDICTING
        self._moment = replace(
            self._moment, cursor=cursor_for(document.scene, self.cursor), pin=pin, hover=None
        )
        if cursor is not None:
            cursor = placed(cursor, trace, cursor.position)
            self._remember(cursor)
        self._document_replaced(trace, cursor, also)

    def edit(self, document: Document, gesture: str = "") -> None:
        """Take over an edited document; edits of one ``gesture`` are undone together.

        Every gesture has a name of its own. What takes long is traced in the background, and taken over when that is
        done: also when the gesture has ended by then, as the last part of it. Raises ValueError if it cannot be traced;
        nothing changes.
        """
        if document is not self.latest:
            self._put(document, gesture)

    def edit_traced(self, document: Document, trace: Trace) -> None:
        """Take over an edited document with its trace, see ``trace_now``."""
        self.tracing.cancel()
        self._take(document, "", trace)

    def drag(self, document: Document, gesture: str) -> None:
        """Take over a part of a gesture that changes the triangle in focus: until it rests, only that one is traced.

        Raises ValueError if it cannot be traced; nothing changes.
        """
        source = self.trace.source
        is_same_run = all(
            getattr(document, name) == getattr(source, name)
            for name in ("settings", "triangle", "region", "before", "lanes")
        )
        if document.triangle is None or not is_same_run:
            self.edit(document, gesture)
            return
        self.tracing.cancel()
        self._take(document, gesture, trace_drag(document, self.cursor.stage, self.trace))
        self._resting.start()

    @Slot()
    def come_to_rest(self) -> None:
        """Trace what a drag has left out; a scene that cannot be drawn is as it was before the drag."""
        self._resting.stop()
        if not isinstance(self.trace.source, Draft):
            return
        document, gesture, stage = self.document, self._history.gesture, self.cursor.stage
        if document.estimated_seconds > RESTING_SECONDS:
            self.tracing.start(Order(document, gesture, stage))
            return
        try:
            trace = trace_now(document, stage)
        except ValueError as error:
            self._refuse(error)
            return
        self._document_replaced(trace)

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        """Say why something could not be traced; a drag that came to rest there is taken back."""
        if isinstance(self.trace.source, Draft) and self.tracing.newest is None:
            self.take_back(self._history.gesture)
        self.edit_failed.emit(error)

    def take_back(self, gesture: str) -> None:
        """End a gesture as if it had not been; redo does it after all."""
        self.tracing.cancel()
        if self._history.is_within(gesture):
            self.undo()

    def set_setting(self, family: str, value: str | int) -> None:
        """Choose a method (or the block size); raises ValueError if the scene cannot be drawn with it."""
        settings: Settings = replace(self.latest.settings, **{family: value})  # type: ignore[arg-type]
        if settings != self.latest.settings:
            self._put(with_settings(self.latest, settings))

    def undo(self) -> None:
        """Take the last edit back, with what is still being traced of it; or one that is being traced, alone."""
        newest = self.tracing.newest
        if newest is not None and newest.direction == 0:
            self.tracing.cancel()
            if not newest.gesture or not self._history.is_within(newest.gesture):
                return
        self._go_in_history(-1)

    def redo(self) -> None:
        """Do it again."""
        self._go_in_history(1)

    def _go_in_history(self, direction: int) -> None:
        document, stage = self._history.neighbour(direction), self.cursor.stage
        if document is None:
            return
        if not self._is_same_run(document) and document.estimated_seconds > RESTING_SECONDS:
            self.tracing.start(Order(document, "", stage, direction))
            return
        self.tracing.cancel()
        if self._is_same_run(document):
            self._move_in_history(direction)
            self._become(Change.EDITS, document=document)
            return
        self._take_neighbour(direction, trace_now(document, stage))

    def _is_same_run(self, document: Document) -> bool:
        """Return whether a document differs from the open one in its edited listings only: they run in side B."""
        is_named_alike = (document.title, document.path) == (self.document.title, self.document.path)
        return document.edits != self.document.edits and is_named_alike and document.has_run_of(self.document)

    def _move_in_history(self, direction: int) -> Document:
        return self._history.undo() if direction < 0 else self._history.redo()

    def _take_neighbour(self, direction: int, trace: Trace) -> None:
        before, cursor, also = self.document, None, Change.RETURNED
        after = self._move_in_history(direction)
        if (before.title, before.path) != (after.title, after.path):
            also |= Change.OPENED | Change.PIN
            left, self._left = self._left, (before, self.cursor, self.pin)
            if left is not None and left[0] is after:
                _, cursor, pin = left
                self._moment = replace(self._moment, pin=pin)
        self._document_replaced(trace, cursor, also)

    @property
    def can_undo(self) -> bool:
        """Whether an edit can be taken back."""
        return self._history.can_undo or self.tracing.newest is not None

    @property
    def can_redo(self) -> bool:
        """Whether one can be done again."""
        return self._history.can_redo

    def _put(self, document: Document, gesture: str = "") -> None:
        stage = self.cursor.stage
        if self._is_same_run(document):
            self._history.put(document, gesture)
            self._become(Change.EDITS, document=document)
            return
        if document.estimated_seconds > QUICK_SECONDS:
            document.check_length()
            self.tracing.start(Order(document, gesture, stage))
            return
        # An edit that is ready takes the place of one that is still being traced.
        self.tracing.cancel()
        self._take(document, gesture, trace_now(document, stage))

    @Slot(object)
    def _take_traced(self, traced: Traced) -> None:
        order = traced.order
        if order.direction == 0:
            self._take(order.document, order.gesture, traced.trace)
        elif self._history.neighbour(order.direction) is order.document:
            self._take_neighbour(order.direction, traced.trace)

    def _take(self, document: Document, gesture: str, trace: Trace) -> None:
        self._history.put(document, gesture)
        self._document_replaced(trace)

    def _document_replaced(self, trace: Trace, cursor: Cursor | None = None, also: Change = NOTHING) -> None:
        """Show the present document of the history, and what stays of the present moment."""
        before = self._moment
        was_at_end = before.is_stage_done and before.steps.count > 0
        if cursor is None and was_at_end:
            cursor = placed(before.cursor, trace, None)
        cursor = cursor or kept_at_pixel(before.cursor, before.stage_trace, before.row, trace)
        bare = Step(trace, cursor)
        pin, hover = (
            None if pixel is None or not bare.has_pixel(pixel) else pixel
            for pixel in (before.pin, before.hover)
        )
        also |= NOTHING if pin == before.pin else Change.PIN
        self._become(
            Change.DOCUMENT | also,
            document=self._history.present,
            trace=trace,
            cursor=cursor,
            pin=pin,
            hover=hover,
        )
