"""Whether the task of a lesson's step is done: asked of what is open after each change, off the GUI thread."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job
from app.session.moment import Change, Moment
from app.session.session import Session
from core.trace.incremental.draft import Draft
from lessons.course.conditions import is_done
from lessons.course.quoted import Situation

if TYPE_CHECKING:
    from lessons.course.record import UntilPart

WATCHED = Change.DOCUMENT | Change.EDITS | Change.CURSOR | Change.PIN


@dataclass(frozen=True, eq=False)
class _Answer:
    until: "UntilPart"
    is_done: bool


class LessonWatch(QObject):
    """Watches one task at a time; of changes that come while one is looked at, only the last is looked at next."""

    done = Signal()
    """The task is done now."""
    undone = Signal()
    """It was, and what is open now no longer does it."""

    def __init__(self, session: Session, parent: QObject) -> None:
        super().__init__(parent)
        self._session = session
        self._until: UntilPart | None = None
        self._start: Situation | None = None
        self._is_done = False
        self._is_stale = False
        """Whether something has changed since the look that is being taken."""
        self._job = Job(self)
        self._job.succeeded.connect(self._take)
        session.changed.connect(self._follow)

    @property
    def is_working(self) -> bool:
        """Whether a change is being looked at."""
        return self._job.is_running

    def stop(self) -> None:
        """End all work."""
        self.end()
        self._job.shut_down()

    def begin(self, until: "UntilPart") -> None:
        """Watch for a task that begins with what is open now."""
        self._until, self._start = until, situation_of(self._session.moment)
        self._is_done = self._is_stale = False
        self._job.cancel()

    def end(self) -> None:
        """Watch for nothing any more."""
        self._until = self._start = None
        self._job.cancel()

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if self._until is not None and what & WATCHED:
            self._is_stale = True
            self._look()

    def _look(self) -> None:
        """Look at what is open now, unless a look is being taken, or a corner is still being dragged."""
        until, start, moment = self._until, self._start, self._session.moment
        is_dragged = isinstance(moment.trace.source, Draft)
        if until is None or start is None or is_dragged or self._job.is_running:
            return
        self._is_stale = False
        now = situation_of(moment)
        self._job.call(lambda: _Answer(until, is_done(until, now, start)))

    @Slot(object)
    def _take(self, answer: _Answer) -> None:
        if answer.until is not self._until:
            return
        if answer.is_done != self._is_done:
            self._is_done = answer.is_done
            (self.done if answer.is_done else self.undone).emit()
        if self._is_stale:
            self._look()


def situation_of(moment: Moment) -> Situation:
    """Return what conditions are asked about."""
    cursor = moment.cursor
    return Situation(moment.trace, cursor.stage, cursor.position, moment.pin, edits=moment.document.edits)
