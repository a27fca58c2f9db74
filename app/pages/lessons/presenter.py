"""Lessons on the Step page: opening and closing them, what was open before, and what is kept."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal, Slot
from PySide6.QtWidgets import QApplication, QWidget

from app.background import Job, end_work
from app.files.state_files import State
from app.pages.step.inspector_presenter import FIRST_MS
from app.pages.step.kept_look import show_state, state_of
from core import Trace

if TYPE_CHECKING:
    from app.pages.lessons.question import JudgedAnswer, LessonAttempts, LessonProgress
    from app.pages.lessons.walk import LessonWalk
    from app.pages.step.page import StepPage
    from lessons.course.catalogue import Course, Lesson
    from widgets.exercises.records import Standing


WAY_BACK, BEGINNING = "lesson/return", "lesson/start"
"""Names of the entries that lead back to the lesson that was open last, and to the start of the one that is open."""
NONE_OPEN = "No lesson is open. The Start page (Alt+0) lists them."


@dataclass(frozen=True, eq=False)
class _Desk:
    """What was open before a lesson."""

    state: State
    trace: Trace


@dataclass(frozen=True, eq=False)
class Found:
    """A lesson that was read."""

    course: "Course"
    lesson: "Lesson"
    step: int | None
    progress: "LessonProgress"


class LessonPresenter(QObject):
    """Opens lessons; their pane is made with the first one."""

    place_changed = Signal()
    """A lesson is shown now, or another step of it, or none any more."""

    def __init__(self, page: "StepPage") -> None:
        super().__init__(page)
        self._page = page
        self._walk: LessonWalk | None = None
        self.attempts: LessonAttempts
        """What is kept; made with the first lesson."""
        self._desk: _Desk | None = None
        self.keeps_attempts = True
        """Whether what is done is kept for the user."""
        self.last: tuple[Lesson | str, int] | None = None
        """The lesson that was shown last, and its step."""
        self._shown_before: dict[tuple[str, str], Sequence[Standing]] = {}
        """How far each lesson is, by its name and the user, since the program was started."""
        self._course: Course | None = None
        """The lessons that can be opened; ``None``: they were not read yet."""
        self._has_texts = False
        """Whether all steps of the lessons were read, too."""
        self._reading = Job(self, (ValueError, OSError), succeeded=self._list, failed=self._refuse_list)
        self._job = Job(self, (ValueError, OSError, MemoryError), succeeded=self._begin, failed=self._refuse)
        self._wanted: tuple[Lesson | str, int | None] | None = None
        """What is opened once the window is painted."""
        self._painted = QTimer(self, singleShot=True, interval=FIRST_MS)
        self._painted.timeout.connect(self._open_wanted)

    @property
    def walk(self) -> "LessonWalk | None":
        """The lesson that is open."""
        walk = self._walk
        return None if walk is None or walk.lesson is None else walk

    @property
    def is_open(self) -> bool:
        """Whether a lesson is open."""
        return self.walk is not None

    @property
    def is_asking(self) -> bool:
        """Whether a lesson has a question open."""
        return self.walk is not None and self.walk.answers.is_open

    def unfocused_answer(self) -> QWidget | None:
        """Return what takes the answer to the open question; ``None``: the picture takes it, or it has the keyboard."""
        walk, focus = self.walk, QApplication.focusWidget()
        if walk is None or (focus is not None and walk.view.is_of_answer(focus)):
            return None
        stop = walk.task.answer_stop()
        return None if stop is walk.task.grid else stop

    def asked_on(self, page: str) -> str:
        """Return what the open step asks on another page of the window, to which it leads; empty: nothing."""
        walk = self.walk
        if walk is None or walk.lesson is None or walk.step is None:
            return ""
        if (walk.step.show or "").split("/")[0] != page:
            return ""
        asked = " ".join(f"{walk.step.text} {walk.step.task or ''}".split())
        return f"The lesson “{walk.lesson.title}”: {asked} Go on with it on the Step page."

    @property
    def is_before_a_class(self) -> bool:
        """Whether a lesson is presented: what is to be read goes before what could be clicked."""
        return self._page.is_presenting and self.walk is not None

    @property
    def is_working(self) -> bool:
        """Whether a lesson is being read, or something in it is being worked on."""
        is_opening = self._painted.isActive() or self._job.is_running
        if self._walk is None:
            return is_opening
        return is_opening or self._walk.is_working or self.attempts.is_working

    @property
    def kept(self) -> State | None:
        """What was open before the lesson, with the lesson over it; ``None``: no lesson is open."""
        desk, walk = self._desk, self.walk
        if desk is None or walk is None or walk.lesson is None:
            return None
        place = (walk.lesson.name, walk.number) if walk.is_listed else None
        return replace(desk.state, look=desk.state.look.model_copy(update={"lesson": place}))

    def desk_panes(self) -> list[str]:
        """Return the panes that are shown at the desk, or come back when the lesson is closed."""
        panes = None if self._desk is None else self._desk.state.look.panes
        return self._page.desk_panes() if panes is None else panes

    def stop(self) -> None:
        """End all work."""
        self._painted.stop()
        end_work(self)
        if self._walk is not None:
            self.attempts.stop()

    @property
    def path(self) -> str:
        """File of the lesson that is open; empty: none is."""
        walk = self.walk
        return "" if walk is None or walk.lesson is None else str(walk.lesson.path)

    def listed(self) -> list[tuple[str, str]]:
        """Return name and title of what can be opened of lessons: the way back, then each of them.

        Without the lessons where they were not read yet (`read`).
        """
        lessons = () if self._course is None else self._course.lessons.values()
        listed = [(str(lesson.path), lesson.title) for lesson in lessons]
        if self.is_open:
            return [(BEGINNING, "Start of this lesson"), *listed]
        return listed if self.last is None else [(WAY_BACK, self._back_title(*self.last)), *listed]

    def about(self) -> dict[str, str]:
        """Return the texts of the lessons that were read, by the names of their entries."""
        lessons = () if self._course is None or not self._has_texts else self._course.lessons.values()
        return {
            str(lesson.path): " ".join([lesson.question, *(step["text"] for step in lesson.written_steps())])
            for lesson in lessons
        }

    @property
    def place(self) -> str:
        """Name of the lesson that is open and which of its steps is shown; empty: none is."""
        walk = self.walk
        return "" if walk is None or walk.lesson is None else _place(walk.lesson, walk.number)

    def _back_title(self, lesson: "Lesson | str", number: int) -> str:
        """Return what leads back to a lesson's step is called."""
        if isinstance(lesson, str):
            found = None if self._course is None else self._course.lessons.get(lesson)
            if found is None:
                return "Back to the lesson"
            lesson = found
        return f"Back to: {_place(lesson, number)}"

    def read(self) -> None:
        """Read the lessons, to be listed with their texts, unless they are known."""
        if not self._has_texts:
            self._reading.call(_whole_course)

    @Slot(object)
    def _refuse_list(self, error: Exception) -> None:
        self._page.refuse(f"The lessons cannot be listed: {error}.")

    @Slot(object)
    def _list(self, course: "Course") -> None:
        self._course, self._has_texts = course, True

    # Opening and closing.

    @Slot(str)
    def open(self, lesson: "Lesson | str", step: int | None = None) -> None:
        """Open a lesson, or that of a name, at one of its steps from 0; ``None``: at its beginning.

        What is open now comes back when the lesson is closed. A window that opens is painted first.
        """
        self._wanted = lesson, step
        if self._page.window().isVisible():
            self._open_wanted()
        else:
            self._painted.start()

    @Slot()
    def _open_wanted(self) -> None:
        self._painted.stop()
        wanted, self._wanted = self._wanted, None
        if wanted is not None:
            self._job.call(partial(found_lesson, *wanted))

    def forget_wanted(self) -> None:
        """Open no lesson that is still waited for: something else is opened."""
        self._painted.stop()
        self._wanted = None
        self._job.cancel()

    def open_path(self, path: str) -> None:
        """Open the lesson of a file, or go to one of the places that are `listed`."""
        if path == WAY_BACK:
            self.return_here()
        elif path == BEGINNING:
            self.start_over()
        else:
            self._job.call(lambda: found_lesson(Path(path), None))

    @Slot(object)
    def _begin(self, found: Found) -> None:
        page, walk = self._page, self._walk or self._make()
        if not self.is_open:
            self._desk = _Desk(state_of(page, 100), page.session.trace)
        self._course = found.course
        self.attempts.user = found.progress.user
        if found.progress.trouble:
            page.refuse(found.progress.trouble)
        page.column.show_card(False)
        page.timeline.takes_leaps = False
        recall = found.progress.recall if self._is_kept else found.lesson.part.recall or ""
        walk.begin(found.course, found.lesson, found.step, self._standings(found), recall)

    def _standings(self, found: Found) -> "Sequence[Standing]":
        """Return how far one is with a lesson: in front of a class nothing is kept but what was shown since."""
        key = found.lesson.name, found.progress.user
        if self._page.is_presenting and key in self._shown_before:
            return self._shown_before[key]
        return found.progress.standings

    def _make(self) -> "LessonWalk":
        """Make what shows lessons."""
        from app.pages.lessons.question import LessonAttempts
        from app.pages.lessons.walk import LessonWalk

        self._walk, self.attempts = walk, attempts = LessonWalk(self._page), LessonAttempts(self)
        self.set_presenting(self._page.is_presenting)
        attempts.failed.connect(self._page.edit_refused)
        walk.task.left.connect(self._leave)
        walk.begun_in_vain.connect(self._put_away)
        walk.place_changed.connect(self._remember)
        walk.task_ended.connect(self._keep)
        walk.view.close_requested.connect(self.close)
        return walk

    @property
    def _is_kept(self) -> bool:
        """Whether somebody learns for himself."""
        return self.keeps_attempts and not self._page.is_presenting

    @Slot(int, float, object)
    def _keep(self, number: int, score: float, judged: "JudgedAnswer | None") -> None:
        """Keep what became of a step."""
        walk = self.walk
        if walk is not None and walk.lesson is not None and self._is_kept:
            self.attempts.keep(walk.lesson, number, score, judged)

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._page.refuse(f"The lesson cannot be opened: {error}. The open scene is unchanged.")

    @Slot()
    def _remember(self) -> None:
        walk = self.walk
        if walk is not None and walk.lesson is not None:
            self.last = walk.lesson, walk.number
            self._shown_before[walk.lesson.name, self.attempts.user] = walk.standings
            self.place_changed.emit()

    @Slot()
    def close(self) -> None:
        """Close the lesson: what was open before it is open again."""
        desk = self._desk
        if self.walk is not None and desk is not None:
            self._put_away()
            show_state(self._page, desk.state, desk.trace)
            self.place_changed.emit()

    @Slot()
    def _leave(self) -> None:
        """Close the lesson, since something else was opened."""
        desk = self._desk
        if desk is not None:
            self._put_away()
            self._page.grids.show_look(desk.state.look.grid)
            if desk.state.look.panes is not None:
                self._page.show_desk_panes(desk.state.look.panes)
            key = (
                "F5 lists it at the top."
                if self._page.is_presenting
                else "Ctrl+Home opens it again at this step."
            )
            self._page.tell(f"The lesson is closed. {key}")
            self.place_changed.emit()

    @Slot()
    def _put_away(self) -> None:
        """Take the pane away."""
        assert self._walk is not None
        self._desk = None
        self._walk.end()
        self._page.side.show_lesson(None)
        self._page.column.show_card(True)
        self._page.timeline.takes_leaps = True

    # By key.

    def _do(self, act: "Callable[[LessonWalk], object]") -> None:
        """Do something in the lesson that is open, or say that none is."""
        walk = self.walk
        if walk is None:
            self._page.tell(NONE_OPEN)
        else:
            act(walk)

    def next(self) -> None:
        """Go to the next step."""
        self._do(lambda walk: walk.next())

    def back(self) -> None:
        """Go to the previous step."""
        self._do(lambda walk: walk.back())

    def return_here(self) -> None:
        """Open the step as it was at first; without a lesson, the one that was open last."""
        if self.walk is None and self.last is not None:
            self.open(*self.last)
        else:
            self._do(lambda walk: walk.return_here())

    def check(self) -> None:
        """Check the answer."""
        self._do(lambda walk: walk.answers.check())

    def reveal(self) -> None:
        """Show what is right."""
        self._do(lambda walk: walk.task.reveal())

    def advance(self) -> None:
        """Go on in front of a class: show an answer or a solution first."""
        self._do(lambda walk: walk.task.reveal() if walk.task.is_unsolved else walk.next())

    def retreat(self) -> None:
        """Go back in front of a class: hide an answer or a solution first; from a beginning, to the lesson before."""

        def act(walk: "LessonWalk") -> None:
            before = walk.preceding
            if walk.task.shows_solution:
                walk.return_here()
            elif walk.number > walk.first or before is None:
                walk.back()
            else:
                self.open(before.name, len(before.steps))

        self._do(act)

    def set_presenting(self, is_presenting: bool) -> None:
        """Show which button a clicker presses, or the desk's own."""
        if self._walk is not None:
            self._walk.view.set_presenting(is_presenting)

    def begin_anew(self) -> None:
        """Begin the lesson once more: what was done of it counts no longer."""

        def act(walk: "LessonWalk") -> None:
            if walk.lesson is not None:
                self.attempts.begin_anew(walk.lesson)
                walk.begin_anew()

        self._do(act)

    def start_over(self) -> None:
        """Go to the first step."""
        self._do(lambda walk: walk.go(walk.first))


def _place(lesson: "Lesson", number: int) -> str:
    """Return a lesson's title and which of its steps a number is; of what comes before or after, the title."""
    count = len(lesson.steps)
    return f"{lesson.title}, step {number + 1} of {count}" if 0 <= number < count else lesson.title


def _whole_course() -> "Course":
    """Read the lessons with the texts of their steps: off the GUI thread."""
    from app.files.user_folders import whole_course

    course = whole_course()
    for lesson in course.lessons.values():
        lesson.written_steps()
    return course


def found_lesson(wanted: "Lesson | str | Path", step: int | None) -> Found:
    """Read the lessons, and import all that shows them: off the GUI thread.

    Raises ValueError for no lesson, or a broken one, and OSError for a file or folder that cannot be read.
    """
    import app.pages.lessons.walk  # noqa: F401
    from app.files.user_folders import whole_course
    from app.pages.lessons.question import progress_in
    from lessons.course.catalogue import FOLDER, read_lesson

    course = whole_course()
    if isinstance(wanted, str):
        lesson = course.named(wanted)
    elif isinstance(wanted, Path):
        listed = course.lessons.get(wanted.stem)
        lesson = listed if listed is not None and listed.path == wanted else read_lesson(wanted)
    else:
        lesson = wanted
    if lesson.path.parent != FOLDER:
        # It comes with all studies: not for what ships with the program.
        from lessons.course.validation import validate

        validate(lesson, {*course.lessons, lesson.name})
    return Found(course, lesson, step, progress_in(lesson, course))
