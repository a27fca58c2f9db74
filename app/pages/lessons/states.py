"""What a step of a lesson is about: its states traced ahead, what the pane shows, and whether its task is done."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from threading import Lock
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job
from app.pages.exercises.answers import numbers_of
from app.pages.lessons.question import LessonQuestion
from app.session.document import Document, TeachingRaster
from app.session.moment import Change, Cursor, Moment, Step, cursor_at
from app.session.printed_runs import settings_as_printed
from app.session.session import Session
from app.session.tracing import trace_now
from core import Settings, Trace
from core.explain.step_tables import largest_tables
from core.records.steps import Level
from core.trace.incremental.draft import Draft
from core.trace.run_to import END, START
from lessons.course.catalogue import Course, Lesson
from lessons.course.quoted import Situation
from lessons.course.state import State
from lessons.course.tasks import is_done
from lessons.course.unmet import unmet
from lessons.exercises.question import Question
from widgets.exercises.records import LessonStepRecord, Standing

if TYPE_CHECKING:
    from app.pages.step.page import StepPage
    from lessons.course.record import UntilPart


# What the pane of a lesson shows of a step, of what comes before the first one, and of the end.


TASKS = {
    "look": "",
    "predict": "Predict",
    "do": "Do it",
    "break": "Break it",
    "measure": "Measure",
}
"""What a step wants to be done, by its kind, where it has no sentence of its own for it."""
OPENS = {
    "compare": "Open it on the Compare page",
    "stability": "Open it on the Stability page",
    "plan": "Open the Plan page",
}
"""What a link of a step to be measured says, by the page that it leads to."""
COURSES = {
    "Zwicker": "Zwicker’s course",
    "Jubair": "Jubair’s course",
    "Pellacini": "Pellacini’s course",
    "LMU": "the course at the LMU",
}
"""Courses whose questions lessons answer, by how a lesson's file names them."""
_COURSE = re.compile(rf"\b({'|'.join(COURSES)})(?:, ([^:?]*))?: ")
_TOGETHER = re.compile(r"(?<=\d,) (?=[-−]?[\d./]+[,)])| (?=[=<>≥≤≠·/] )|(?<= [=<>≥≤≠·/]) ")
"""Spaces at which no line ends: in ``(2, 1, 0)``, ``8 · 4 / 2`` and in ``E0 = 0``."""


def paragraphs(text: str | None) -> str:
    """Return a text of a file, whose lines are those of its author, as paragraphs."""
    parts = (" ".join(part.split()) for part in (text or "").split("\n\n"))
    return _TOGETHER.sub("\N{NO-BREAK SPACE}", "\n".join(parts))


def step_record(
    lesson: Lesson, number: int, standings: Sequence[Standing], *, was_done: bool
) -> LessonStepRecord:
    """Return a step; ``was_done``: when it was opened, its task had been done already."""
    step = lesson.steps[number]
    return LessonStepRecord(
        title=lesson.title,
        text=paragraphs(step.text),
        number=number,
        standings=tuple(standings),
        lead=paragraphs(lesson.question) if number == 0 else "",
        task=paragraphs(step.task) or TASKS[step.kind],
        links=((step.show, OPENS[step.show.partition("/")[0]]),) if step.show else (),
        was_done=was_done and bool(TASKS[step.kind]),
    )


def recall_record(
    lesson: Lesson, course: Course, question: Question, standings: Sequence[Standing]
) -> LessonStepRecord:
    """Return the exercise of an earlier lesson that is asked before the first step."""
    draft, template = question.draft, question.template
    asking = (each for each in course.lessons.values() if each.head.get("recall") == template.name)
    about = course.recalled(lesson if lesson.part.recall == template.name else next(asking, lesson))
    whence = f"lesson “{about.title}”" if about else f"exercise “{template.title}”"
    return LessonStepRecord(
        title=lesson.title,
        text="\n".join(filter(None, (draft.text, numbers_of(draft)))),
        number=-1,
        standings=tuple(standings),
        lead=f"First, a question from the {whence}. To skip it, choose Begin.",
        next_title="Begin",
        has_previous=False,
    )


def answered(text: str) -> str:
    """Return the questions that one can answer at the end, each with the course that asks it, as ``Zwicker:`` says."""
    before, *parts = _COURSE.split(text)
    if not parts or before:
        return text
    said = []
    for name, place, question in zip(parts[::3], parts[1::3], parts[2::3], strict=True):
        where = f", {place.rstrip(')')}" if place else ""
        question = question.strip()
        said.append(f"{question[:1].upper()}{question[1:]} (from {COURSES[name]}{where})")
    return "\n".join(said)


def end_record(lesson: Lesson, following: Lesson | None, standings: Sequence[Standing]) -> LessonStepRecord:
    """Return the end: what one can answer now, exercises, and the question of the next lesson."""
    from lessons.exercises.catalogue import TEMPLATES  # The walk has imported it, off the GUI thread.

    part = lesson.part
    said = [f"You can now answer: {answered(paragraphs(part.answers))}" if part.answers else ""]
    if following is not None:
        said.append(f"Next lesson: {following.title}")
        said.append(paragraphs(following.question if part.next is None else part.next.text))
    return LessonStepRecord(
        title=lesson.title,
        text="\n".join(filter(None, said)) or "This is the end of the lesson.",
        number=len(lesson.steps),
        standings=tuple(standings),
        links=tuple((f"exercise/{name}", f"Exercise: {TEMPLATES[name].title}") for name in part.exercises),
        next_title="Next lesson",
        has_next=following is not None,
    )


# The states of a lesson on the Step page: traced off the GUI thread, the next one ahead, each one entry of
# undo.


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
        self._wanting = Job(self, succeeded=self._take, failed=self.refused)
        self._preparing = Job(self, succeeded=self._look_at, failed=self._leave_out)

    @property
    def is_working(self) -> bool:
        """Whether a state that is wanted is being traced."""
        return self._wanting.is_running

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
            self._page.inspector.ahead.look_at(
                Step(made.trace, made.cursor), partial(self._prepare_beside, made)
            )

    def _prepare_beside(self, made: OpenState) -> None:
        """Prepare what stands beside the step that comes next."""
        if made.state.panes:
            self._page.scene.prepare(made.document)
        if made.second is not None:
            self._page.comparing.prepare(made.trace, made.cursor, *made.second)

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
            with page.main_area.arranged_once():
                if panes and set(panes) != set(page.desk_panes()):
                    page.show_desk_panes(panes)  # Before the pictures of A | B find their places.
                self._show_view(state)
        if state.pixel is not None and state.other is not None:
            page.comparing.meeting.meet_at(state.pixel)
        page.column.show_step()

    def _show_view(self, state: State) -> None:
        """Show A | B where the state has a B, else its view, or the one of its stage."""
        page = self._page
        if state.printed:
            at = state.place.at
            page.comparing.show_printed(state.printed, seeks=at == START, stays=at not in (START, END))
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
    return settings_as_printed(state.printed, Document(state.scene, raster, state.settings))


def _second(
    document: Document, stage: str, other: Settings, known: tuple[OpenState, ...]
) -> tuple[Document, Trace] | None:
    """Trace what B draws up to a stage, or go on with what is ``known``; ``None`` where it cannot: A | B says why."""
    beside = (each.second for each in known if each.document is document)
    made = next((each for each in beside if each is not None and each[0].settings == other), None)
    try:
        if made is None:
            second = replace(document, settings=other)
            second.check_length()
            made = second, second.make_trace()
        made[1].stage(stage)
    except ValueError:
        return None
    return made


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
    largest_tables(run.stage(state.stage))  # What the window gives room to.
    cursor = cursor_at(state.place, run, Level.PIXEL)
    second = None if other is None else _second(document, cursor.stage, other, known)
    return OpenState(state, document, run, cursor, second, asked)


# Whether the task of a lesson's step is done: asked of what is open after each change, off the GUI thread.


WATCHED = Change.DOCUMENT | Change.EDITS | Change.CURSOR | Change.PIN


@dataclass(frozen=True, eq=False)
class _Answer:
    until: "UntilPart"
    unmet: str
    """What does not hold yet, where something has been tried."""
    is_done: bool


class LessonWatch(QObject):
    """Watches one task at a time; of changes that come while one is looked at, only the last is looked at next."""

    done = Signal()
    """The task is done now."""
    undone = Signal()
    """It was, and what is open now no longer does it."""
    tried = Signal(str)
    """What does not hold yet of what was changed, in a sentence; empty: nothing was, or nothing is to be said."""

    def __init__(self, session: Session, parent: QObject) -> None:
        super().__init__(parent)
        self._session = session
        self._until: UntilPart | None = None
        self._start: Situation | None = None
        self._is_done = self._is_tried = False
        self._is_stale = False
        """Whether something has changed since the look that is being taken."""
        self._job = Job(self, succeeded=self._take)
        session.changed.connect(self._follow)

    def begin(self, until: "UntilPart") -> None:
        """Watch for a task that begins with what is open now."""
        self._until, self._start = until, situation_of(self._session.moment)
        self._is_done = self._is_stale = self._is_tried = False
        self._job.cancel()

    def end(self) -> None:
        """Watch for nothing any more."""
        self._until = self._start = None
        self._job.cancel()

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if self._until is not None and what & WATCHED:
            self._is_stale = True
            self._is_tried = self._is_tried or bool(what & (Change.DOCUMENT | Change.EDITS))
            self._look()

    def _look(self) -> None:
        """Look at what is open now, unless a look is being taken, or a corner is still being dragged."""
        until, start, moment = self._until, self._start, self._session.moment
        is_dragged = isinstance(moment.trace.source, Draft)
        if until is None or start is None or is_dragged or self._job.is_running:
            return
        self._is_stale = False
        self._job.call(partial(_answer, until, situation_of(moment), start, self._is_tried))

    @Slot(object)
    def _take(self, answer: _Answer) -> None:
        if answer.until is not self._until:
            return
        if answer.is_done != self._is_done:
            self._is_done = answer.is_done
            (self.done if answer.is_done else self.undone).emit()
        elif not answer.is_done:
            self.tried.emit(answer.unmet)
        if self._is_stale:
            self._look()


def _answer(until: "UntilPart", now: Situation, start: Situation, is_tried: bool) -> _Answer:
    is_met = is_done(until, now, start)
    return _Answer(until, "" if is_met or not is_tried else unmet(until, now, start), is_met)


def situation_of(moment: Moment) -> Situation:
    """Return what conditions are asked about."""
    cursor = moment.cursor
    return Situation(moment.trace, cursor.stage, cursor.position, moment.pin, edits=moment.document.edits)
