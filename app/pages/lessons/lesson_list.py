"""Fills the list of lessons: their titles, how far the learner is, and where to begin or go on."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.background import Job
from app.pages.lessons.presenter import found_lesson
from widgets.lessons.lesson_list import LessonEntry, LessonList, LessonPart

if TYPE_CHECKING:
    from lessons.attempts.record import Attempt
    from lessons.course.catalogue import Course


OTHERS = "Other lessons"
"""Title of those that are not in the order of learning: a lecturer's own."""
EXPLORATIONS = "With two minutes to spend"
"""Title of single steps."""
REST_MS = 1000
"""Time after the list is there, in milliseconds, from which the user is taken to read it."""


@dataclass(frozen=True)
class LessonPlace:
    """Where the learner goes on."""

    name: str
    title: str
    step: int
    """From 0."""
    is_new: bool
    """Whether no lesson has been begun."""
    after: str = ""
    """Title of the finished lesson that it follows; empty: it is the first that is not finished."""
    first: str = ""
    """Title of the first that is not finished, where it is another."""

    @property
    def button(self) -> str:
        """What a button says that leads there."""
        return f"{'Go on' if self.step else 'Begin'}: {self.title}"

    @property
    def sentence(self) -> str:
        """What the list says of it."""
        if self.is_new:
            return (
                "You are new here? A lesson opens the program at the right place and asks you something. "
                f"Begin with “{self.title}”."
            )
        if self.step:
            return f"You stopped in “{self.title}”: step {self.step + 1} is next."
        if not self.after:
            return f"The first lesson not done is “{self.title}”."
        passed_over = f" The first lesson not done is “{self.first}”." if self.first else ""
        return f"After “{self.after}” comes “{self.title}”.{passed_over}"


@dataclass(frozen=True)
class LessonsShown:
    """All that is shown of the lessons."""

    by_learning: tuple[LessonPart, ...]
    by_stage: tuple[LessonPart, ...]
    place: LessonPlace | None
    """``None``: there is nothing left."""
    opens: Mapping[str, tuple[str, int]]
    """By the name of a card, the lesson and the step that it opens."""
    problems: tuple[str, ...]
    """Of lessons that were skipped."""


class LessonsPresenter(QObject):
    """Reads the lessons off the GUI thread and shows them."""

    lesson_requested = Signal(str, int)
    """Name and step, from 0, of a lesson that is to be opened."""
    place_changed = Signal()
    """The list is there, or the learner goes on elsewhere."""
    refused = Signal(str)

    def __init__(self, view: LessonList, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._view = view
        self._shown: LessonsShown | None = None
        self._is_by_stage = False
        self.job = Job(self, (OSError, ValueError), succeeded=self._take, failed=self._refuse)
        self.preparing = Job(self, (OSError, ValueError))
        """Reads the lesson in which the learner goes on, and all that shows it: then it opens at once."""
        self.rest = QTimer(self, singleShot=True, interval=REST_MS)
        self.rest.timeout.connect(self._prepare)
        view.lesson_chosen.connect(self._open)
        view.order_chosen.connect(self._choose_order)

    def refresh(self) -> None:
        """Read the lessons, and what was done of them."""
        self.job.call(read_lessons)

    @property
    def place(self) -> LessonPlace | None:
        """Where the learner goes on; ``None``: nothing is left, or not read yet."""
        return None if self._shown is None else self._shown.place

    @Slot()
    def go_on(self) -> None:
        """Open the lesson in which the learner goes on."""
        if self.place is not None:
            self.lesson_requested.emit(self.place.name, self.place.step)

    @Slot(object)
    def _take(self, shown: LessonsShown) -> None:
        before, self._shown = self._shown, shown
        if shown != before:
            self._show()
            self.place_changed.emit()
            self.rest.start()
        if shown.problems:
            more = f" ({len(shown.problems) - 1} more)" if shown.problems[1:] else ""
            self.refused.emit(f"A lesson was skipped: {shown.problems[0]}{more}")

    @Slot()
    def _prepare(self) -> None:
        if self.place is not None:
            self.preparing.call(partial(found_lesson, self.place.name, None))

    @Slot(object)
    def _refuse(self, problem: Exception) -> None:
        self.refused.emit(f"The lessons cannot be listed: {problem}.")

    @Slot(str)
    def _open(self, name: str) -> None:
        if self._shown is not None:
            self.lesson_requested.emit(*self._shown.opens[name])

    @Slot(bool)
    def _choose_order(self, is_by_stage: bool) -> None:
        self._is_by_stage = is_by_stage
        self._show()

    def _show(self) -> None:
        if self._shown is not None:
            parts = self._shown.by_stage if self._is_by_stage else self._shown.by_learning
            lead = "All lessons are done. Each can be walked again."
            self._view.show_lessons(parts, self.place.sentence if self.place else lead)


def read_lessons() -> LessonsShown:
    """Read all lessons, and how far the learner is; OSError where the folders or attempts cannot be read."""
    from app.files.kept_work import learner
    from app.files.user_folders import attempt_file, whole_course

    return shown_lessons(whole_course(), attempt_file().attempts(learner()))


def shown_lessons(course: "Course", attempts: "tuple[Attempt, ...]") -> LessonsShown:
    """Return what is shown of a course to a learner with these attempts."""
    from core.stages.declared import stage_of
    from lessons.attempts.record import Standing, first_unfinished, is_of_lesson, next_place, standings
    from lessons.course.catalogue import chapters, explorations

    lessons = course.lessons
    place = next_place(attempts, course)
    entries: dict[str, LessonEntry] = {}
    opens: dict[str, tuple[str, int]] = {}
    for name, lesson in lessons.items():
        found = standings(attempts, lesson)
        done, seen = (tuple(each is of for each in found) for of in (Standing.DONE, Standing.SEEN))
        is_next = place is not None and place.lesson is lesson
        entries[name] = LessonEntry(name, lesson.title, lesson.question, lesson.minutes, done, seen, is_next)
        is_between = Standing.OPEN in found and entries[name].is_begun
        opens[name] = name, found.index(Standing.OPEN) if is_between else 0
    tried = []
    for each in explorations():
        if each.lesson in lessons:
            name = f"{each.lesson}/{each.step + 1}"
            tried.append(name)
            opens[name] = each.lesson, each.step
            entries[name] = LessonEntry(name, each.title, f"From “{lessons[each.lesson].title}”.", 2, ())
    titles = chapters()
    listed = {name for names in titles.values() for name in names}
    titles |= {OTHERS: [name for name in lessons if name not in listed], EXPLORATIONS: tried}
    stages = {
        stage_of(stage).short_title: [lesson.name for lesson in its] for stage, its in course.by_stage.items()
    }
    by_learning, by_stage = (
        tuple(
            LessonPart(title, tuple(entries[name] for name in names if name in entries))
            for title, names in parts.items()
            if any(name in entries for name in names)
        )
        for parts in (titles, stages)
    )
    goes_on = None
    if place is not None:
        is_new = not any(map(is_of_lesson, attempts))
        after, first = place.after, first_unfinished(attempts, course)
        goes_on = LessonPlace(
            place.lesson.name,
            place.lesson.title,
            place.step,
            is_new,
            after="" if after is None else after.title,
            first="" if first is None or first is place.lesson else first.title,
        )
    return LessonsShown(by_learning, by_stage, goes_on, opens, course.problems)
